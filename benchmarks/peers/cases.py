"""The cases: exact solutions of tests/reference, each in the models that the solvers know."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from peers.problem import Problem, from_reference

REFERENCE = Path(__file__).parents[2] / "tests" / "reference"


@dataclass(frozen=True)
class Variant:
    """A reference solution; or its data with other stiffnesses, to be solved by `exact.py`."""

    reference: str
    stiffness: tuple[tuple[str, float | None], ...] = ()

    def data(self) -> dict[str, Any]:
        """In the format of tests/reference; without samples if there are none."""
        data = json.loads((REFERENCE / f"{self.reference}.json").read_text())
        if self.stiffness:
            data["stiffness"].update(self.stiffness)
            for key in ("r", "q", "n", "m", "energy"):
                data[key] = None
        return data


RIGID = (("GA1", None), ("GA2", None))
SLENDER = (("GA1", 4e5), ("GA2", 4e5), ("EA", 1e6))
SOFT = (("GA1", 4e3), ("GA2", 4e3), ("EA", 1e4))


@dataclass(frozen=True)
class Case:
    """`models`: inextensible, extensible (no shear), cosserat; soft: that with EA L²/EI = 1e4."""

    title: str
    models: dict[str, Variant]

    def problem(self, model: str) -> Problem:
        return from_reference(self.models[model].data())


def _elastica(F: int) -> Case:
    exact = f"P1_F{F}_a90"
    sampled = F < 100
    return Case(
        f"planar elastica, F L²/EI = {F}",
        {
            "inextensible": Variant(exact),
            "extensible": Variant(exact, (*RIGID, ("EA", 1e6))),
            "cosserat": Variant(f"P4_slender1e6_F{F}_a90") if sampled else Variant(exact, SLENDER),
            "soft": Variant("P4_slender1e4_F10_a90") if F == 10 else Variant(exact, SOFT),
        },
    )


# A pure moment, and a ring, do not stretch or shear: all models have the same solution.
_MOMENT = {
    "inextensible": Variant("P2_turns1"),
    "extensible": Variant("P2_turns1", (*RIGID, ("EA", 1e6))),
    "cosserat": Variant("P2_turns1", SLENDER),
    "soft": Variant("P2_turns1", SOFT),
}

CASES: dict[str, Case] = {
    "elastica-1": _elastica(1),
    "elastica-10": _elastica(10),
    "elastica-100": _elastica(100),
    "roll-up": Case("roll-up, M L/EI = 2π", _MOMENT),
    "bend": Case(
        "45° bend (Bathe and Bolourchi), P = 600",
        {
            "inextensible": Variant("S2_bathe_P600_Jpolar_kirchhoff"),
            "extensible": Variant("S2_bathe_P600_Jpolar_k1", RIGID),
            "cosserat": Variant("S2_bathe_P600_Jpolar_k1"),
        },
    ),
    "precurved": Case(
        "anisotropic precurved cantilever, force and moment",
        {
            "inextensible": Variant("S3_kirchhoff"),
            "extensible": Variant("S3_extensible"),
            "cosserat": Variant("S3_cosserat"),
        },
    ),
    "clamped": Case(
        "clamped-clamped in space, anisotropic, precurved",
        {
            "cosserat": Variant("S4_generic_cosserat"),
            "extensible": Variant("S4_generic_cosserat", RIGID),
        },
    ),
    "ring": Case("ring with one turn of twist", {"inextensible": Variant("S7_ring_Tw1")}),
    "model-cost": Case("all six models on one scene", _elastica(10).models),
    "scaling": Case("n to a million: planar elastica, F L²/EI = 1", _elastica(1).models),
}
