"""Prints the bytes per solve that stay in use, over ten thousand solves of a kind."""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import pyrod

SOLVES = 10_000
STRIP = pyrod.Section(4.0, 1.0, 2.0)
CLAMPS = [pyrod.Clamp(), pyrod.Clamp((0.1, 0, 0.8), at="end")]


FIELDS = (
    *("arena", "ordblks", "smblks", "hblks", "hblkhd"),
    *("usmblks", "fsmblks", "uordblks", "fordblks", "keepcost"),
)


class Mallinfo2(ctypes.Structure):
    """What glibc says of its memory."""

    _fields_ = [(name, ctypes.c_size_t) for name in FIELDS]


LIBC = ctypes.CDLL(None)
LIBC.mallinfo2.restype = Mallinfo2


def in_use() -> int:
    """Bytes that were asked for and not given back."""
    gc.collect()
    info = LIBC.mallinfo2()
    return info.uordblks + info.hblkhd


def rod(n: int | None = 8) -> pyrod.Rod:
    return pyrod.Rod.straight(1.0, n, STRIP)


def looked_at(result: pyrod.Equilibrium) -> None:
    """Makes the arrays that are made when they are asked for."""
    for one in result.rods:
        assert np.isfinite(one.positions).all()
        assert np.isfinite(one.moment).all()


def cantilever() -> None:
    looked_at(pyrod.solve(pyrod.Scene(rod(), pyrod.Clamp(), pyrod.Force((3, 1, 0)))))


def span() -> None:
    looked_at(pyrod.solve(pyrod.Scene(rod(), CLAMPS), eigenvalue=True))


def frame() -> None:
    rods = [rod(4), rod(4).placed((0, 0, 1), tangent=(1, 0, 0), normal=(0, 0, 1))]
    corner = pyrod.Joint(((0, "end"), (1, "start")))
    held = pyrod.Clamp(at=(0, "start"))
    load = pyrod.Force((0, 0, -1), at=(1, "end"))
    looked_at(pyrod.solve(pyrod.Scene(rods, held, load, joints=corner)))


def ladder() -> None:
    scene = pyrod.Scene(rod(None), pyrod.Clamp(), pyrod.Force((1, 0, 0)))
    looked_at(pyrod.solve(scene, tol=1e-3))


def not_converged() -> None:
    options = pyrod.Options(max_iterations=1)
    with pytest.raises(pyrod.NotConverged):
        pyrod.solve(pyrod.Scene(rod(), CLAMPS), options)


def refused() -> None:
    with pytest.raises(ValueError, match="2"):
        pyrod.Scene(rod(), pyrod.Clamp(), pyrod.Force((1, 0, 0), at=2.0))


def many() -> None:
    """Ten scenes at a time: called a tenth as often."""
    scene = pyrod.Scene(rod(), pyrod.Clamp(), pyrod.Force((3, 1, 0)))
    for result in pyrod.solve_many([scene] * 10, threads=2):
        looked_at(result)


POOL = ThreadPoolExecutor(2)


def threads() -> None:
    for done in [POOL.submit(cantilever) for _ in range(10)]:
        done.result()


def leaking() -> None:
    """To see that this file would see it."""
    LIBC.malloc(ctypes.c_size_t(64))


KINDS: dict[str, tuple[Callable[[], None], int]] = {
    f.__name__: (f, 10 if f in (many, threads) else 1)
    for f in (
        cantilever, span, frame, ladder, not_converged, refused, many, threads, leaking
    )
}  # fmt: skip


def main() -> None:
    """The median of five stretches: what grows once is a cache, a leak is in all of them."""
    solve, at_once = KINDS[sys.argv[1]]
    marks = []
    for _ in range(6):
        for _ in range(SOLVES // 5 // at_once):
            solve()
        marks.append(in_use())
    print(5 / SOLVES * np.median(np.diff(marks)))


if __name__ == "__main__":
    main()
