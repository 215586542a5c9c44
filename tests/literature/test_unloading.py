"""Axial force that unloads one side of a preloaded set over its preload, as catalogues print it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bearings import AngularContactBallBearing
from tests.oracles.known_bearings import DEGREE, VEX70

LIGHT = 20.0  # [N], under which contact angles stay at their free values


def moved(bearing: AngularContactBallBearing, force: float) -> float:
    return float(bearing.equilibrium(load=[force, 0, 0, 0, 0]).displacement[0])


@pytest.mark.parametrize(
    ("loaded", "angle", "behind", "angle_behind", "factor"),
    [
        (1, 25, 1, 25, 2.83),
        (2, 25, 1, 25, 4.16),
        (1, 25, 2, 25, 2.08),
        (3, 25, 1, 25, 5.40),
        (1, 25, 1, 15, 5.9),
    ],
    ids=["pair", "tandem loaded", "tandem behind", "three loaded", "25° against 15°"],
)
def test_unloading_factors(
    loaded: int, angle: float, behind: int, angle_behind: float, factor: float
) -> None:
    """Makers' factors on the preload, rings kept at their distance; ``loaded`` bearings share."""
    front, rear = (replace(VEX70, contact_angle=a * DEGREE) for a in (angle, angle_behind))
    together = moved(front, LIGHT / loaded) + moved(rear, LIGHT / behind)
    alone = front.equilibrium(displacement=[together, 0, 0, 0, 0])
    assert loaded * float(alone.load[0]) / LIGHT == pytest.approx(factor, rel=0.012)
