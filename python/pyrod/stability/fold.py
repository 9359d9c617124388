"""Where a path of stable equilibria comes to an end, from the eigenvalues before."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from pyrod.stability.state import State, turn_between

APART = 1.02
"""Eigenvalues that are nearer to each other, relatively, tell too little."""
UNSEEN = 0.1
"""Of the way from the last equilibrium to the limit point: an error that is always told."""


def fold_of(states: list[State], unbalanced: float) -> tuple[float, float]:
    """The factor at the limit point, and its error.

    Along a smooth path the factor has a maximum where the eigenvalue is zero: there it is a power
    series of the eigenvalue without a linear term. Of all four neighbours in a row those are taken
    that agree best with the three last of them, and with the four before, and are balanced best:
    near the limit point the solver's rounding is seen.

    ``unbalanced`` : the change of the factor that a residual of 1 may stand for.
    """
    falling = _falling(states)
    rounding = [_rounding(*pair, unbalanced) for pair in pairwise(falling)]
    fits = [
        (_at_zero(falling[i : i + 4]), _at_zero(falling[i + 1 : i + 4]), max(rounding[i : i + 3]))
        for i in range(len(falling) - 3)
    ]
    last = states[-1].factor
    found = last + _to_zero(falling)
    error = abs(found - last) + unbalanced * states[-1].result.residual
    for (before, _, _), (four, three, rounded) in pairwise(fits):
        spread = max(abs(four - three), abs(four - before)) + rounded
        if spread < error:
            found, error = four, spread
    return found, max(error, UNSEEN * abs(found - last))


def _falling(states: list[State]) -> list[State]:
    """From the last backwards, states whose eigenvalues are larger and larger."""
    falling: list[State] = []
    for state in reversed(states):
        if not falling or state.eigenvalue > APART * falling[-1].eigenvalue:
            falling.append(state)
    return falling[::-1]


def _rounding(before: State, state: State, unbalanced: float) -> float:
    """What the factor of a state may be off, as its residual and its last step tell."""
    part = state.left / (turn_between(before, state) or np.inf)
    return unbalanced * state.result.residual + part * abs(state.factor - before.factor)


def _at_zero(states: list[State]) -> float:
    """The factor at a zero eigenvalue, of a polynomial through the states."""
    scale = states[0].eigenvalue
    x = np.array([state.eigenvalue / scale for state in states])
    powers = [0, *range(2, len(states) + 1)]
    base = states[-1].factor  # only the differences are fitted
    rise = [state.factor - base for state in states]
    return base + float(np.linalg.solve(x[:, None] ** powers, rise)[0])


def _to_zero(falling: list[State]) -> float:
    """From the last state to where the square of the eigenvalue is zero, if that falls evenly."""
    if len(falling) < 2:
        return np.inf
    before, last = falling[-2:]
    return (last.factor - before.factor) / ((before.eigenvalue / last.eigenvalue) ** 2 - 1)
