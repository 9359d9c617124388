"""Where a path of stable equilibria comes to an end, from the eigenvalues before."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from pyrod._state import State

APART = 1.02
"""Eigenvalues that are nearer to each other, relatively, tell too little."""
UNSEEN = 0.01
"""Of the way from the last equilibrium to the limit point: an error that is always told."""


def fold_of(states: list[State], unbalanced: float) -> tuple[float, float]:
    """The factor at the limit point, and its error.

    Along a smooth path the factor has a maximum where the eigenvalue is zero: there it is a power
    series of the eigenvalue without a linear term. Of all four neighbours in a row those are taken
    that agree best with the three last of them, and with the four before, and are balanced best:
    near the limit point the solver's rounding is seen.

    ``unbalanced`` : the change of the factor that a residual of 1 may stand for.
    """
    fits = [
        (_at_zero(four), _at_zero(four[1:]), unbalanced * max(s.result.residual for s in four))
        for four in _fours(_falling(states))
    ]
    last = states[-1].factor
    found = last + _to_zero(states)
    error = abs(found - last) + unbalanced * states[-1].result.residual
    for (before, _, _), (four, three, rounding) in pairwise(fits):
        spread = max(abs(four - three), abs(four - before)) + rounding
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


def _fours(states: list[State]) -> list[list[State]]:
    return [states[i : i + 4] for i in range(len(states) - 3)]


def _at_zero(states: list[State]) -> float:
    """The factor at a zero eigenvalue, of a polynomial through the states."""
    scale = states[0].eigenvalue
    x = np.array([state.eigenvalue / scale for state in states])
    powers = [0, *range(2, len(states) + 1)]
    base = states[-1].factor  # only the differences are fitted
    rise = [state.factor - base for state in states]
    return base + float(np.linalg.solve(x[:, None] ** powers, rise)[0])


def _to_zero(states: list[State]) -> float:
    """From the last state to where the square of the eigenvalue is zero, if that falls evenly."""
    falling = _falling(states)
    if len(falling) < 2:
        return np.inf
    before, last = falling[-2:]
    return (last.factor - before.factor) / ((before.eigenvalue / last.eigenvalue) ** 2 - 1)
