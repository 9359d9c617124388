"""
Discrete Cosserat curves on the staggered grid.
"""
from __future__ import annotations
import numpy
import numpy.typing
import typing
__all__: list[str] = ['reconstruct', 'strains']
def reconstruct(edge_lengths: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], K: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], Gamma: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    ...
def strains(edge_lengths: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], start_frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, end_frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
    ...
