"""A batch of states with different laws has the states of each law solved alone."""

from __future__ import annotations

from dataclasses import asdict, fields
from itertools import product

import numpy as np
import pytest

from bearings import BearingState, Law
from bearings.ball.law import KINEMATICS, MOMENT_SHARING
from bearings.ball.laws import Laws
from bearings.ring.operation import operation
from bearings.ring.request import solved
from tests.oracles.known_bearings import VEX70

LAWS = tuple(Law(*names) for names in product(KINEMATICS, MOMENT_SHARING))
SPEED = np.array([0.0, 1200.0, 3000.0])  # rad/s
ROW = np.repeat(np.arange(len(LAWS)), len(SPEED))


@pytest.mark.parametrize("load", [(1000.0, 0.0, 0.0, 0.0, 0.0), (1000.0, 200.0, 0.0, 0.0, 1.0)])
def test_laws_of_a_batch(load: tuple[float, ...]) -> None:
    """Axial and general loads; solved from nothing, and from states nearby."""
    grid = len(LAWS), len(SPEED)
    law = Laws(LAWS, tuple(ROW.tolist()))

    def batch(force: np.ndarray, start: BearingState | None = None) -> BearingState:
        asked = {"displacement": None, "static_growth": 0.0, "growth": None}
        speed = np.broadcast_to(SPEED, grid)
        points = operation(VEX70.grooves, law, load=force, speed=speed, **asked)
        return solved(points, start)

    force = np.broadcast_to(load, (*grid, 5))
    first = batch(0.9 * force)
    for together in (batch(force), batch(force, first)):
        for k, each in enumerate(LAWS):
            alone = VEX70.equilibrium(load=load, speed=SPEED, **asdict(each))
            here = together.rows(np.array(k))
            assert here.operation.law == each
            assert (here.outcome == alone.outcome).all()
            for name in (field.name for field in fields(alone)[1:]):
                value = getattr(alone, name)
                if value.dtype.kind == "f" and name != "residual":
                    size = max(np.nanmax(np.abs(value)), 1e-300)
                    np.testing.assert_allclose(getattr(here, name), value, 1e-9, 1e-9 * size)
    assert isinstance(law.take([0, 1]), Law)
