"""Equilibria under growing loads, followed from the unloaded one until they lose stability."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

from pyrod._core import Options
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import NotConverged
from pyrod.scene.loads import sampled_load
from pyrod.scene.scene import Scene
from pyrod.solving.job import How
from pyrod.solving.run import unjudged
from pyrod.stability.fold import fold_of
from pyrod.stability.reach import Reach
from pyrod.stability.state import Loss, State, halved, turn_between

FASTER = 2.0
"""How much faster than before, or slower, a shape may change; beyond, it is another one."""
BEND = 0.2
"""How far the lowest eigenvalue may be from where the two before point, relative to it."""
GROWTH = 0.5
"""The longest step, relative to the factor reached: what two modes do between is not seen."""
CLOSE = 0.03
"""The longest step about a loss of stability that another grid has, relative to its factor."""
ROUNDING = 1e-6
"""A turn [rad], or an eigenvalue relative to that of the unloaded scene, that means nothing."""
ZERO = 1e-10
"""An eigenvalue of which not even the sign means anything, relative to the same."""
SMALL = 0.05
"""An eigenvalue that went to zero, relative to that of the unloaded scene."""
SHORTEST = 1e-15
"""The shortest first step, relative to that which was to be the first."""
NEAR = 10
"""Times the last step: the distance of a limit point, if the steps are not too long to tell."""
FAR = 0.01
"""The largest distance of a limit point from the last equilibrium that is found, relative to it."""


class Path:
    """A scene on its own edges, some of whose loads grow.

    Raises
    ------
    ValueError
        The unloaded scene is not in a stable equilibrium, or the loads have no potential.
    """

    def __init__(
        self, scene: Scene, growing: frozenset[int], options: Options, start: Array | None
    ) -> None:
        self._scene, self._growing, self._options = scene, growing, options
        self._loads = [sampled_load(load, scene.rods) for load in scene.loads]
        self.start = State(0.0, self.solved(0.0, start))
        self._refuse_start()

    @property
    def edges(self) -> int:
        """Of all rods together."""
        return sum(rod.edges for rod in self._scene.rods)

    def scene(self, factor: float) -> Scene:
        """The scene under these loads."""
        loads = tuple(
            load.with_acting(factor * load.acting) if i in self._growing else load
            for i, load in enumerate(self._loads)
        )
        return replace(self._scene, loads=loads)

    def solved(self, factor: float, start: Equilibrium | Array | None) -> Equilibrium:
        """The equilibrium to which Newton's method leads from another."""
        how = How(self._options, stable=False, eigenvalue=True, tol=None)
        result = unjudged(self.scene(factor), how, start)
        if not result.converged:
            raise NotConverged(result)
        return result

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

    def loss(self, reach: Reach, rtol: float) -> Loss:
        """Where stability is lost."""
        return self._loss([self.start], reach, reach.first / 16, rtol)

    def loss_near(self, factor: float, known: list[State], reach: Reach, rtol: float) -> Loss:
        """The same, looked for behind stable states known here, closely about a factor."""
        return self._loss(_below(factor, known), reach, CLOSE * factor, rtol, CLOSE * factor)

    def loss_like(self, other: Loss, reach: Reach, rtol: float) -> Loss:
        """The same, looked for about that of a grid of edges twice as long."""
        known = [self.start]
        for near in _below(other.factor, other.states)[1:][-2:]:  # the first has no loads
            state = self._tried(near.factor, halved(near.result))
            if state is None or state.result.index > 0:
                return self.loss(reach, rtol)
            known.append(state)
        return self.loss_near(other.factor, known, reach, rtol)

    def _loss(
        self, states: list[State], reach: Reach, step: float, rtol: float, longest: float = inf
    ) -> Loss:
        behind = self._followed(states, reach, step, rtol, longest)
        if behind is None:
            return Loss("none", states[-1], None, inf, nan, states)
        if isinstance(behind, State):
            return self._crossing(states, behind, rtol)
        return self._end(states, behind, reach)

    def _followed(
        self, states: list[State], reach: Reach, step: float, rtol: float, longest: float
    ) -> State | float | None:
        """Adds stable states, until the first unstable one, or a factor of which none is found.

        Both are told; None: larger loads are not tried.
        """
        shortest = SHORTEST * step
        while not reach.ends(states[-1], self.start):
            last = states[-1]
            target = reach.cut(last.factor, step)
            new = self._next(states[-2:], target)
            if new is None:
                step = (target - last.factor) / 2
                if step <= (rtol * last.factor or shortest):
                    return target
            elif new.result.index > 0:
                return new
            elif reach.is_senseless(new):
                return None
            else:
                states.append(new)
                step = min(2 * step, GROWTH * new.factor, longest)
        return None

    def _end(self, states: list[State], failed: float, reach: Reach) -> Loss:
        """What it means that no equilibrium is found under slightly larger loads."""
        last, (factor, error) = states[-1], fold_of(states, 2 * self.edges / reach.moment)
        bracket, distance = failed - last.factor, factor - last.factor
        gone = last.eigenvalue < SMALL * self.start.eigenvalue
        if distance <= NEAR * bracket or (gone and distance <= FAR * last.factor):
            return Loss("limit point", last, None, factor, error, states)
        if reach.may_end(last.factor):
            return Loss("none", last, None, inf, nan, states)
        raise RuntimeError(
            f"the equilibria could be followed up to a factor of {last.factor:.6g} only, where "
            "they are stable; give rods more edges"
        )

    def _next(self, states: list[State], factor: float) -> State | None:
        """The equilibrium under larger loads, if it goes on from those before.

        The first has only one before it, and is compared with one halfway.
        """
        if len(states) == 1:
            middle = self._tried(factor / 2, self.start.result)
            if middle is None or middle.result.index > 0:
                return None
            states = [self.start, middle]
        before, last = states
        new = self._tried(factor, last.result)
        return new if new and _goes_on(before, last, new, self.start.eigenvalue) else None

    def _tried(self, factor: float, start: Equilibrium | Array) -> State | None:
        """The equilibrium to which Newton's method leads, if it leads to one."""
        try:
            new = State(factor, self.solved(factor, start))
        except NotConverged:
            return None
        if new.result.index < 0:
            raise ValueError(
                "loads: they have no potential, so that stability is not a matter of energy; "
                "moments have one in a planar scene only"
            )
        return new

    def _crossing(self, states: list[State], above: State, rtol: float) -> Loss:
        """Where the lowest eigenvalue is zero."""
        known = {state.factor: state for state in (states[-1], above)}
        for state in known.values():
            if abs(state.eigenvalue) < ZERO * self.start.eigenvalue:
                return self._bifurcation(known, state.factor, states, above)
        if states[-1].eigenvalue < 0:  # by less than the index is told by
            above = states[-1]
            states = [state for state in states if state.eigenvalue > 0]
            known[states[-1].factor] = states[-1]
        optimize = need("scipy.optimize", "all")

        def eigenvalue(factor: float) -> float:
            if factor not in known:
                near = min(known.values(), key=lambda state: abs(state.factor - factor))
                known[factor] = State(factor, self.solved(factor, near.result))
            return known[factor].eigenvalue

        ends = states[-1].factor, above.factor
        factor = optimize.brentq(eigenvalue, *ends, xtol=rtol * above.factor, rtol=max(rtol, 1e-14))
        if abs(eigenvalue(factor)) > SMALL * self.start.eigenvalue:
            raise RuntimeError(
                f"at a factor of {factor:.6g} the equilibria jump to others, which are unstable"
            )
        return self._bifurcation(known, factor, states, above)

    def _bifurcation(
        self, known: dict[float, State], factor: float, states: list[State], above: State
    ) -> Loss:
        """With the error that the eigenvalue there, and its rounding, make by its slope."""
        at = known[factor]
        apart = [s for s in known.values() if abs(s.factor - factor) > 1e-6 * factor]
        other = min(apart, key=lambda state: abs(state.factor - factor), default=above)
        slope = abs(other.eigenvalue - at.eigenvalue) / (abs(other.factor - factor) or inf)
        left = abs(at.eigenvalue) + ZERO * self.start.eigenvalue
        error = left / slope if slope > 0 else above.factor - states[-1].factor
        return Loss("bifurcation", at, above.result.index, factor, error, states)


def _below(factor: float, states: list[State]) -> list[State]:
    """Those a little below, and all before them."""
    return [state for state in states if state.factor < 0.95 * factor]


def _goes_on(before: State, last: State, new: State, scale: float) -> bool:
    """Whether three states lie on one path: shape and eigenvalue change as they did before.

    ``scale`` : the eigenvalue of the unloaded scene.
    """
    part = (new.factor - last.factor) / (last.factor - before.factor)
    expected = last.eigenvalue + part * (last.eigenvalue - before.eigenvalue)
    if abs(new.eigenvalue - expected) > max(BEND * last.eigenvalue, ROUNDING * scale):
        return False
    turn, expected = turn_between(last, new), part * turn_between(before, last)
    return expected / FASTER - ROUNDING <= turn <= expected * FASTER + ROUNDING
