"""Equilibria under growing loads, followed from the unloaded one until they lose stability."""

from __future__ import annotations

from typing import Literal, NamedTuple

from pyrod._core import Options
from pyrod._effects import largest_turn
from pyrod._immutable import Array
from pyrod._optional import need
from pyrod._solve import solve
from pyrod.equilibrium import Equilibrium
from pyrod.errors import NotConverged
from pyrod.loads import sampled_load, scaled_load
from pyrod.scene import Scene

Kind = Literal["bifurcation", "limit point", "none"]

FASTER = 2.0
"""How much faster than before, or slower, a shape may change; beyond, it is another one."""
BEND = 0.2
"""How far the lowest eigenvalue may be from where the two before point, relative to it."""
ROUNDING = 1e-6
"""A turn [rad], or an eigenvalue relative to that of the unloaded scene, that means nothing."""
ZERO = 1e-10
"""An eigenvalue of which not even the sign means anything, relative to the same."""
SMALL = 0.05
"""An eigenvalue that went to zero, relative to that of the unloaded scene."""


class State(NamedTuple):
    """An equilibrium under loads times a factor."""

    factor: float
    result: Equilibrium

    @property
    def eigenvalue(self) -> float:
        """The lowest of the second variation."""
        assert self.result.lowest_eigenvalue is not None
        return self.result.lowest_eigenvalue


class Loss(NamedTuple):
    """Where stability is lost on a grid."""

    kind: Kind
    at: State  #: there; of limit points, just below; if there is none, under the largest loads
    index_after: int | None  #: just above; None if there is no such equilibrium


class Path:
    """A scene on its own edges, some of whose loads grow.

    Raises
    ------
    ValueError : the unloaded scene is not in a stable equilibrium, or the loads have no potential.
    """

    def __init__(
        self, scene: Scene, growing: frozenset[int], options: Options, start: Array | None
    ) -> None:
        self._scene, self._growing, self._options = scene, growing, options
        self._loads = [sampled_load(load, scene.rods) for load in scene.loads]
        self.start = State(0.0, self.solved(0.0, start))
        self._refuse_start()

    def scene(self, factor: float) -> Scene:
        """The scene under these loads."""
        loads = [
            scaled_load(load, factor) if i in self._growing else load
            for i, load in enumerate(self._loads)
        ]
        s = self._scene
        return Scene(s.rods, s.supports, loads, s.space, s.joints)

    def solved(self, factor: float, start: Equilibrium | Array | None) -> Equilibrium:
        """The equilibrium to which Newton's method leads from another."""
        scene = self.scene(factor)
        return solve(scene, self._options, start=start, stable=False, eigenvalue=True)

    def _refuse_start(self) -> None:
        result = self.start.result
        if result.neutral:
            raise ValueError(
                f"scene: without the loads it can move without a change of energy "
                f"({result.free_motion}), so its stability has no threshold; hold that motion"
            )
        if result.index > 0:
            raise ValueError(
                f"scene: it is unstable without the loads already (index {result.index})"
            )

    def loss(self, upper: float, step: float, rtol: float) -> Loss:
        """Where stability is lost, below an upper factor."""
        states, above = self._followed(upper, step, rtol)
        last = states[-1]
        if above is not None:
            return self._crossing(last, above, rtol)
        if last.factor >= upper:
            return Loss("none", last, None)
        if last.eigenvalue > SMALL * self.start.eigenvalue:
            raise RuntimeError(
                f"the equilibria could be followed up to a factor of {last.factor:.6g} only, where "
                "they are stable; give rods more edges"
            )
        return Loss("limit point", last, None)

    def _followed(self, upper: float, step: float, rtol: float) -> tuple[list[State], State | None]:
        """Stable states one after the other, and the first unstable one; None: there is none."""
        states, smallest = [self.start], rtol * step
        while states[-1].factor < upper and step > max(smallest, rtol * states[-1].factor):
            target = min(states[-1].factor + step, upper)
            new = self._next(states, target)
            if new is None:
                step = (target - states[-1].factor) / 2
            elif new.result.index > 0:
                return states, new
            else:
                states = [states[-1], new]
                step *= 2
        return states, None

    def _next(self, states: list[State], factor: float) -> State | None:
        """The equilibrium under larger loads, if it goes on from those before.

        The first has only one before it, and is compared with one halfway.
        """
        if len(states) == 1:
            middle = self._tried(factor / 2, self.start)
            if middle is None or middle.result.index > 0:
                return None
            states = [self.start, middle]
        before, last = states
        new = self._tried(factor, last)
        return new if new and _goes_on(before, last, new, self.start.eigenvalue) else None

    def _tried(self, factor: float, start: State) -> State | None:
        """The equilibrium to which Newton's method leads, if it leads to one."""
        try:
            new = State(factor, self.solved(factor, start.result))
        except NotConverged:
            return None
        if new.result.index < 0:
            raise ValueError(
                "loads: they have no potential, so that stability is not a matter of energy; "
                "moments have one in a planar scene only"
            )
        return new

    def _crossing(self, below: State, above: State, rtol: float) -> Loss:
        """Where the lowest eigenvalue is zero."""
        for state in (below, above):
            if abs(state.eigenvalue) < ZERO * self.start.eigenvalue:
                return Loss("bifurcation", state, above.result.index)
        optimize = need("scipy.optimize", "all")
        known = {state.factor: state for state in (below, above)}

        def eigenvalue(factor: float) -> float:
            if factor not in known:
                near = min(known.values(), key=lambda state: abs(state.factor - factor))
                known[factor] = State(factor, self.solved(factor, near.result))
            return known[factor].eigenvalue

        factor = optimize.brentq(
            eigenvalue, below.factor, above.factor, xtol=rtol * above.factor, rtol=max(rtol, 1e-14)
        )
        if abs(eigenvalue(factor)) > SMALL * self.start.eigenvalue:
            raise RuntimeError(
                f"at a factor of {factor:.6g} the equilibria jump to others, which are unstable"
            )
        return Loss("bifurcation", known[factor], above.result.index)


def _goes_on(before: State, last: State, new: State, scale: float) -> bool:
    """Whether three states lie on one path: shape and eigenvalue change as they did before.

    ``scale`` : the eigenvalue of the unloaded scene.
    """
    part = (new.factor - last.factor) / (last.factor - before.factor)
    expected = last.eigenvalue + part * (last.eigenvalue - before.eigenvalue)
    if abs(new.eigenvalue - expected) > max(BEND * last.eigenvalue, ROUNDING * scale):
        return False
    turn, expected = _turn(last, new), part * _turn(before, last)
    return expected / FASTER - ROUNDING <= turn <= expected * FASTER + ROUNDING


def _turn(a: State, b: State) -> float:
    pairs = zip(a.result.rods, b.result.rods, strict=True)
    return max(largest_turn(one, other) for one, other in pairs)
