"""Loss of shafts over both planes: forward and backward whirl each have their own sign."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.hysteresis import Hysteresis, Signs

TURNING, FIXED = 5.0, 3.0


@pytest.mark.parametrize(
    "signs", [Signs(1, 1, 1), Signs(-1, 1, 1), Signs(0, 1, 1), Signs(1, -1, 1)]
)
def test_each_whirl_is_lost_by_its_own_sign(signs: Signs) -> None:
    """Of e^(iωt), forward whirl moves (y, z) by (1, −i), backward whirl by (1, i); in one complex
    plane each is a coordinate of its own."""
    turning = TURNING * np.eye(2)
    across = TURNING * np.array([[0.0, 1.0], [-1.0, 0.0]])
    both = Hysteresis(np.zeros((1, 2, 2)), turning, across).stiffness(signs)[0]
    found = [complex(both[0] @ whirl / whirl[0]) for whirl in np.array([[1, -1j], [1, 1j]])]
    own = {1j * TURNING * signs.forward, 1j * TURNING * signs.backward}
    assert {complex(round(z.real, 9), round(z.imag, 9)) for z in found} == own
    one = Hysteresis(np.full((1, 1, 1), FIXED), np.full((1, 1), TURNING), None)
    assert one.stiffness(signs)[0, 0, 0] == 1j * (FIXED * signs.fixed + TURNING * signs.forward)
