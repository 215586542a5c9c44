"""How the surface moves: rigid sections, the nodes' own displacements, orbits that turn forward."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.job import solve
from rotordyn.surface.motion import (
    STEEPEST,
    at_phase,
    displacement,
    drawn_scale,
    reach,
    section_motion,
)
from rotordyn.surface.orbit import orbit, phases, turning
from rotordyn.surface.rotor import orbit_stations, rotor_surface
from tests.oracles.spindles import RPM, case, mfw2310


@cache
def modes() -> CampbellResult:
    """The flagship at rest and at speed."""
    speeds, asked = (0.0, 12000 * RPM), {"campbell": CampbellSpec(3000.0)}
    found = solve(case().vary({"speeds": speeds, "analyses": asked})).results["campbell"]
    assert isinstance(found, CampbellResult)
    return found


def test_rigid_motion_keeps_all_distances_to_first_order() -> None:
    """u = t + θ × r at the nodes is u = t + θ × r everywhere."""
    spindle, rng = mfw2310(), np.random.default_rng(3)
    surface, node = rotor_surface(spindle), np.linspace(-0.0918, 0.4364, 17)
    t, theta = rng.normal(size=(2, 3)) + 1j * rng.normal(size=(2, 3))
    at_node = np.stack([node, 0.0 * node, 0.0 * node], axis=1)
    shape = np.concatenate([t + np.cross(theta, at_node), np.tile(theta, (17, 1))], axis=1)
    moved = displacement(surface, spindle.shaft, node, shape)
    np.testing.assert_allclose(moved, t + np.cross(theta, surface.points), rtol=0.0, atol=1e-11)
    one, other = rng.integers(len(surface.points), size=(2, 500))
    apart = surface.points[one] - surface.points[other]
    stretch = np.einsum("ij,ij->i", apart, moved[one] - moved[other])
    size = np.linalg.norm(apart, axis=1) * np.abs(moved).max()
    assert np.abs(stretch).max() < 1e-12 * size.max()


def test_rings_of_points_carry_the_displacements_of_their_node() -> None:
    """Mean: translation; first harmonics around the axis: tilt and twist, as the results have."""
    spindle, found = mfw2310(), modes()
    surface = rotor_surface(spindle)
    for shape in found.shape[-1]:
        moved = displacement(surface, spindle.shaft, found.node, shape)
        for x, (u, v, w, thx, thy, thz) in zip(found.node, shape, strict=True):
            ring = np.flatnonzero(np.abs(surface.station - x) < 1e-9)
            if not ring.size:
                continue
            _, y, z = surface.points[ring].T
            square = (y**2 + z**2).mean() / 2.0
            along, up, side = moved[ring].T
            assert moved[ring].mean(axis=0) == pytest.approx([u, v, w], abs=1e-9)
            assert (along * z).mean() / square == pytest.approx(thy, abs=1e-7)
            assert -(along * y).mean() / square == pytest.approx(thz, abs=1e-7)
            assert (side * y).mean() / square == pytest.approx(thx, abs=1e-7)
            assert -(up * z).mean() / square == pytest.approx(thx, abs=1e-7)


def test_torsion_turns_a_positive_angle_from_y_to_z() -> None:
    spindle = mfw2310()
    surface, node = rotor_surface(spindle), np.array([-0.0918, 0.4364])
    moved = displacement(surface, spindle.shaft, node, np.eye(6)[[3, 3]].astype(complex))
    _, y, z = surface.points.T
    np.testing.assert_allclose(moved, np.stack([0.0 * y, -z, y], axis=1), rtol=0.0, atol=1e-15)


def test_reach_is_the_largest_distance_of_a_period() -> None:
    rng = np.random.default_rng(5)
    moved = rng.normal(size=(200, 3)) + 1j * rng.normal(size=(200, 3))
    sampled = [np.linalg.norm(at_phase(moved, t), axis=1) for t in phases(4000)]
    assert reach(moved) == pytest.approx(np.max(sampled, axis=0), rel=2e-6)


def test_drawn_displacement_is_the_length_requested_unless_sections_tilt_too_far() -> None:
    spindle, found = mfw2310(), modes()
    surface = rotor_surface(spindle)
    for mode, kind in enumerate(found.kind):
        shape = found.shape[0, mode]
        moved = displacement(surface, spindle.shaft, found.node, shape)
        small, large = (drawn_scale(moved, shape, length) for length in (1e-3, 1.0))
        assert small * reach(moved).max() == pytest.approx(1e-3)
        if kind != "axial":
            assert large * reach(shape[:, 3:]).max() == pytest.approx(STEEPEST)
    assert drawn_scale(0.0 * moved, 0.0 * shape, 1.0) == 1.0


@pytest.mark.parametrize("whirl", [1, -1])
def test_a_forward_whirl_turns_counter_clockwise_seen_from_plus_x(whirl: int) -> None:
    """From y to z; the modes' own word for their whirl, and their path, agree at each station."""
    spindle, found = mfw2310(), modes()
    stations = np.array(orbit_stations(spindle))
    chosen = [k for k in range(len(found.mode)) if found.whirl[-1, k] == whirl]
    assert len(chosen) >= 3
    for mode in chosen:
        shape = found.shape[-1, mode]
        for motion in section_motion(spindle.shaft, found.node, shape, stations):
            _, y, z = orbit(motion, 24).T
            angle = np.unwrap(np.arctan2(z, y))
            assert np.sign(angle[-1] - angle[0]) == whirl
            assert turning(motion) == whirl


def test_motion_along_a_line_turns_neither_way() -> None:
    for motion in ([0, 1, 0], [0, 1 + 1j, 2 + 2j], [1, 0, 0], [1j, 1e-9, 1e-9]):
        assert turning(np.array(motion, complex)) == 0
