"""A groove spans ±90°: what a ball feels where the ring has moved its groove away from it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearings import DeepGrooveBallBearing, FourPointBallBearing, stiffness
from bearings.ball.race import facing
from bearings.geometry import geometry

LOADS = [[0, 500, 0, 0, 0], [0, 300, 400, 0, 0], [50, 500, 0, 0, 0], [0, 500, 0, 0, 5]]


def loose(clearance: float) -> DeepGrooveBallBearing:
    """The inner groove centres come inside the ball centres of the side without load: its reach is
    50 µm, and half the clearance is added to what the ring moves."""
    return DeepGrooveBallBearing(
        ball_diameter=0.01,
        pitch_diameter=0.05,
        balls=9,
        inner_conformity=0.505,
        outer_conformity=0.53,
        radial_clearance=clearance,
    )


@pytest.mark.few(9)
@pytest.mark.parametrize("dynamics", ["frozen", "resultant"])
@pytest.mark.parametrize("speed", [0.0, 10.0, 1000.0])
@pytest.mark.parametrize("clearance", [40e-6, 50e-6, 60e-6, 90e-6, 110e-6, 150e-6])
def test_large_clearance(clearance: float, speed: float, dynamics: str) -> None:
    """Far balls ride the outer race alone, whatever the clearance; light Fc changes little."""
    bearing = loose(clearance)
    s = bearing.equilibrium(load=LOADS, speed=speed, dynamics=dynamics)
    assert (s.outcome == "").all()
    assert (s.inner_load[0, [4, 5]] == 0.0).all()
    back = bearing.equilibrium(displacement=s.displacement, speed=speed, dynamics=dynamics)
    assert back.load == pytest.approx(s.load, abs=1e-6 * 500.0)
    rest = bearing.equilibrium(load=LOADS)
    if speed == 10.0:
        assert s.displacement[2:] == pytest.approx(rest.displacement[2:], abs=2e-7)
    slope = stiffness(s, "difference")
    scale = np.array([1.0, 1.0, 1.0, 40.0, 40.0])
    assert slope * np.outer(scale, scale) == pytest.approx(
        s.complete_stiffness * np.outer(scale, scale), abs=1e-6 * 1e9
    )


def test_the_angle_a_free_ball_faces_is_continuous() -> None:
    """From contact over the whole groove, its centre included; derivatives against differences."""
    groove = geometry(loose(50e-6).grooves).inner_grooves[0]
    grid = np.linspace(-0.999, 0.999, 41) * groove.centre_distance
    axial, radial = (part.ravel() for part in np.meshgrid(grid, 1.7 * grid + 1e-9))
    sin, cos, approach, turn = facing(groove, (axial, radial))
    assert np.isfinite([sin, cos, approach, *turn]).all()
    assert (cos >= 0.0).all()
    step = 1e-9 * groove.centre_distance
    for k, slope in enumerate(turn):
        ways = [[axial, radial], [axial, radial]]
        ways[0][k], ways[1][k] = ways[0][k] + step, ways[1][k] - step
        one, two = (np.arctan2(*facing(groove, (a, r))[:2]) for a, r in ways)
        assert (one - two) / (2.0 * step) == pytest.approx(slope, abs=1e-4 / groove.centre_distance)
    touching = np.linspace(-89.0, 89.0, 90) * math.pi / 180.0
    near = groove.centre_distance * (1.0 - 1e-9)
    there = facing(groove, (near * np.sin(touching), near * np.cos(touching)))
    assert np.arctan2(*there[:2]) == pytest.approx(touching, abs=1e-6)


@pytest.mark.parametrize("speed", [0.0, 41.0, 400.0])
def test_no_ball_is_held_by_the_far_side_of_a_groove(speed: float) -> None:
    """The balls that a loose ring moves away from keep to the outer race; the convex state, which
    exists, is found."""
    bearing = FourPointBallBearing(
        ball_diameter=0.01926384588,
        pitch_diameter=0.119518431,
        balls=15,
        inner_conformity=0.5143168819703343,
        outer_conformity=0.5728360277765495,
        contact_angle=0.788092,
        inner_shim=0.000391257,
    )
    s = bearing.equilibrium(load=[0.0, 0.0, -3347.0, 0.0, 0.0], speed=speed, dynamics="frozen")
    assert (s.outer_load > 0.0).all() or speed == 0.0
    assert np.abs(s.inner_angle).max() <= math.pi / 2.0
    assert s.stiffness() == pytest.approx(s.stiffness().T, rel=1e-6, abs=1.0)
