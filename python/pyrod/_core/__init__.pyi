"""
The compiled part of pyrod. Use it through the package.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import typing
from . import rotation
from . import section
from . import curve
__all__: list[str] = ['Dimension', 'Job', 'Ladder', 'Loads', 'Model', 'Network', 'Options', 'Rod', 'RodSolution', 'Solution', 'build', 'cantilever_job', 'curve', 'rotation', 'run_all', 'section']
class Model:
    """
    Members:
    
      cosserat
    
      extensible
    
      inextensible
    """
    __members__: typing.ClassVar[dict[str, Model]]
    cosserat: typing.ClassVar[Model]
    extensible: typing.ClassVar[Model]
    inextensible: typing.ClassVar[Model]
    @typing.overload
    def __eq__(self, other: Model) -> bool:
        ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool:
        ...
    def __getstate__(self) -> int:
        ...
    def __hash__(self) -> int:
        ...
    def __index__(self) -> int:
        ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __int__(self) -> int:
        ...
    @typing.overload
    def __ne__(self, other: Model) -> bool:
        ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __str__(self) -> str:
        ...
    @property
    def name(self) -> str:
        ...
    @property
    def value(self) -> int:
        ...
class Rod:
    def __init__(self, edge_lengths: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], bending: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], stretching: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], K0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], jumps: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], sides: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def at_rest(self, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64]]:
        ...
    def energy(self, model: Model, positions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frames: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], start_frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None, end_frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None) -> tuple[float, float, numpy.typing.NDArray[numpy.float64], tuple]:
        ...
    @property
    def arc_lengths(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def length(self) -> float:
        ...
class RodSolution:
    """
    One rod in equilibrium.
    """
    def doubts(self, rod: Rod) -> tuple:
        ...
    @property
    def Gamma(self) -> numpy.ndarray:
        ...
    @property
    def K(self) -> numpy.ndarray:
        ...
    @property
    def K_before(self) -> numpy.ndarray:
        ...
    @property
    def bend_twist_energy(self) -> float:
        ...
    @property
    def force(self) -> numpy.ndarray:
        ...
    @property
    def frames(self) -> numpy.ndarray:
        ...
    @property
    def largest_K(self) -> float:
        ...
    @property
    def largest_force(self) -> float:
        ...
    @property
    def largest_moment(self) -> float:
        ...
    @property
    def load(self) -> numpy.ndarray:
        ...
    @property
    def load_moment(self) -> numpy.ndarray:
        ...
    @property
    def material_force(self) -> numpy.ndarray:
        ...
    @property
    def material_moment(self) -> numpy.ndarray:
        ...
    @property
    def moment(self) -> numpy.ndarray:
        ...
    @property
    def moment_before(self) -> numpy.ndarray:
        ...
    @property
    def positions(self) -> numpy.ndarray:
        ...
    @property
    def stretch_shear_energy(self) -> float:
        ...
    @property
    def vertex_force(self) -> numpy.ndarray:
        ...
    @property
    def vertex_force_before(self) -> numpy.ndarray:
        ...
    @property
    def vertex_frames(self) -> numpy.ndarray:
        ...
class Solution:
    """
    A scene, solved.
    """
    @property
    def advice(self) -> str:
        ...
    @property
    def descents(self) -> int:
        ...
    @property
    def fill(self) -> float:
        ...
    @property
    def index(self) -> int:
        ...
    @property
    def load_steps(self) -> int:
        ...
    @property
    def lowest_eigenvalue(self) -> float:
        ...
    @property
    def mode(self) -> typing.Any:
        ...
    @property
    def multipliers(self) -> int:
        ...
    @property
    def neutral(self) -> bool:
        ...
    @property
    def node_frames(self) -> numpy.ndarray:
        ...
    @property
    def node_positions(self) -> numpy.ndarray:
        ...
    @property
    def reached(self) -> typing.Any:
        ...
    @property
    def reaction_forces(self) -> numpy.ndarray:
        ...
    @property
    def reaction_moments(self) -> numpy.ndarray:
        ...
    @property
    def record(self) -> dict:
        ...
    @property
    def residual(self) -> float:
        ...
    @property
    def rods(self) -> tuple:
        ...
    @property
    def status(self) -> str:
        ...
    @property
    def unknowns(self) -> int:
        ...
class Job:
    """
    A solve that is ready to be run.
    """
    def run(self, trace: collections.abc.Callable | None) -> Solution:
        ...
    @property
    def so_far(self) -> typing.Any:
        """
        Of a climb that runs: grids, edges of the finest, largest error.
        """
class Options:
    """
    What may be tuned in a solve; keywords only.
    """
    def __eq__(self, arg0: typing.Any) -> bool:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *args, **kwargs) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def max_edges(self) -> int:
        """
        edges of all rods together on the finest grid that a tolerance may lead to
        """
    @property
    def max_iterations(self) -> int:
        """
        linear solves of one run before giving up
        """
    @property
    def max_time(self) -> float:
        """
        seconds that the grids of a tolerance may take: none is begun that would end later, if it took as long as the one before
        """
    @property
    def near(self) -> float:
        """
        steps [rad] below which the exact Hessian replaces the convex one
        """
    @property
    def tolerance(self) -> float:
        """
        largest component [rad] of the last full Newton step; the error left is of the order of its square
        """
    @property
    def trust(self) -> float:
        """
        longest step [rad] taken on the word of the exact Hessian
        """
class Dimension:
    """
    Members:
    
      planar
    
      spatial
    """
    __members__: typing.ClassVar[dict[str, Dimension]]
    planar: typing.ClassVar[Dimension]
    spatial: typing.ClassVar[Dimension]
    @typing.overload
    def __eq__(self, other: Dimension) -> bool:
        ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool:
        ...
    def __getstate__(self) -> int:
        ...
    def __hash__(self) -> int:
        ...
    def __index__(self) -> int:
        ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __int__(self) -> int:
        ...
    @typing.overload
    def __ne__(self, other: Dimension) -> bool:
        ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None:
        ...
    def __str__(self) -> str:
        ...
    @property
    def name(self) -> str:
        ...
    @property
    def value(self) -> int:
        ...
class Loads:
    @typing.overload
    def __init__(self, rod: Rod) -> None:
        ...
    @typing.overload
    def __init__(self, rod: Rod, level0: Loads) -> None:
        """
        level0: the loads of the coarsest grid, where places are found.
        """
    def add_distributed_force(self, force_per_length: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def add_distributed_moment(self, moment_per_length: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def add_following_distributed_force(self, force_per_length: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def add_following_distributed_moment(self, moment_per_length: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def add_following_force(self, force: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], at: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def add_following_moment(self, moment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], at: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def add_force(self, force: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], at: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def add_moment(self, moment: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], at: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def end_moment(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def force(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def moment(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
    @property
    def start_moment(self) -> numpy.typing.NDArray[numpy.float64]:
        ...
class Network:
    """
    Rods that meet in nodes.
    """
    def __init__(self) -> None:
        ...
    def add_node(self, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], free: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], turns: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], spring: typing.SupportsFloat | typing.SupportsIndex, torsion_spring: typing.SupportsFloat | typing.SupportsIndex) -> int:
        ...
    def add_rod(self, rod: Rod, model: Model, loads: Loads, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def attach(self, rod: typing.SupportsInt | typing.SupportsIndex, vertex: typing.SupportsInt | typing.SupportsIndex, node: typing.SupportsInt | typing.SupportsIndex, rigid: bool, relative: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], turns: typing.SupportsInt | typing.SupportsIndex, hinge: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None) -> None:
        ...
    def job(self, dimension: Dimension, origin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], start: tuple | None, options: Options, stable: bool, eigenvalue: bool) -> Job:
        ...
class Ladder:
    """
    A scene on ever finer grids.
    """
    @staticmethod
    def of_cantilever(rod: Rod, loads: Loads, make: collections.abc.Callable | None, dimension: Dimension, model: Model, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], corners: bool) -> Ladder:
        ...
    @staticmethod
    def of_network(network: Network, origin: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], loads: collections.abc.Sequence[Loads], make: collections.abc.Callable | None, dimension: Dimension, corners: bool) -> Ladder:
        ...
    def job(self, start: tuple | None, options: Options, stable: bool, eigenvalue: bool, tolerance: typing.SupportsFloat | typing.SupportsIndex) -> Job:
        ...
def build() -> dict:
    """
    Versions of CHOLMOD and Eigen, the compiler, and the instructions that are used.
    """
def cantilever_job(rod: typing.Any, dimension: Dimension, model: Model, position: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], frame: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], loads: typing.Any, start: tuple | None, options: Options) -> Job:
    ...
def run_all(jobs: collections.abc.Sequence[Job], numbers: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], threads: typing.SupportsInt | typing.SupportsIndex, progress: collections.abc.Callable | None) -> list[Solution]:
    ...
