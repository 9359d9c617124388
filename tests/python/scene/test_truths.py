"""Yes or no is True or False."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from pyrod import DistributedForce, Force, Joint, Slider


@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("follower", lambda x: Force((1, 0, 0), follower=x)),
        ("follower", lambda x: DistributedForce((1, 0, 0), follower=x)),
        ("clamped", lambda x: Slider((1, 0, 0), clamped=x)),
        ("aligned", lambda x: Joint(["start", "end"], aligned=x)),
    ],
)
def test_other_things_are_refused(name: str, make: Callable[[object], object]) -> None:
    for wrong in ("no", 2, 0.5, [True]):
        with pytest.raises(TypeError, match=f"{name}: expected True or False"):
            make(wrong)
    assert getattr(make(True), name) is True
