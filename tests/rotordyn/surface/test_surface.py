"""The rotor's surface: closed, of the rotor's volume, with its outside outside."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.surface.body import Surface
from rotordyn.surface.revolution import FACETS
from rotordyn.surface.rotor import SHAFT, holder_surface, orbit_stations, rotor_surface
from tests.oracles.rotors import STEEL, STEPPED
from tests.oracles.spindles import mfw2310


def shaft_of(*diameters: tuple[float, float]) -> Spindle:
    """Sections of 30 mm with these outer and inner diameters [mm]."""
    sections = tuple(Section(0.03, do / 1e3, di / 1e3, STEEL) for do, di in diameters)
    return Spindle("steps", Shaft(-0.04, sections))


STEPS = {
    "solid": shaft_of((50, 0)),
    "hollow": shaft_of((50, 20)),
    "steps outside": shaft_of((50, 20), (70, 20), (40, 20)),
    "steps inside": shaft_of((50, 20), (50, 30), (50, 10)),
    "blind bore": shaft_of((50, 20), (50, 0), (60, 30)),
    "steps on both sides": shaft_of((50, 20), (70, 30), (60, 25)),
    "a tube on a thin rod": shaft_of((60, 40), (30, 0), (60, 40)),
    "the flagship": mfw2310(),
    "stepped": STEPPED,
}
by_name = pytest.mark.parametrize("name", STEPS)


def volume(spindle: Spindle) -> float:
    return sum(
        math.pi / 4.0 * (s.outer_diameter**2 - s.inner_diameter**2) * s.length
        for s in spindle.shaft.sections
    )


def edges(surface: Surface) -> tuple[np.ndarray, np.ndarray]:
    """Every edge with its direction, and how often it is there."""
    ends = surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return np.unique(ends, axis=0, return_counts=True)


@by_name
def test_every_edge_belongs_to_two_triangles_that_run_through_it_both_ways(name: str) -> None:
    found, count = edges(rotor_surface(STEPS[name]))
    assert (count == 1).all()
    assert {tuple(edge) for edge in found} == {tuple(edge) for edge in found[:, ::-1]}


@by_name
def test_volume_is_that_of_the_shaft_with_polygons_for_circles(name: str) -> None:
    for facets in (8, 24, FACETS):
        polygon = facets / (2.0 * math.pi) * math.sin(2.0 * math.pi / facets)
        found = rotor_surface(STEPS[name], facets).volume(SHAFT)
        assert found == pytest.approx(polygon * volume(STEPS[name]), rel=1e-11)


def test_volume_converges_with_the_square_of_the_facets() -> None:
    spindle = STEPS["the flagship"]
    errors = [
        1.0 - rotor_surface(spindle, facets).volume(SHAFT) / volume(spindle)
        for facets in (16, 32, 64)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(2.0, abs=0.02)


def test_no_triangle_is_flat_and_the_mesh_is_of_moderate_size() -> None:
    surface = rotor_surface(STEPS["the flagship"])
    a, b, c = surface.points[surface.triangles].swapaxes(0, 1)
    assert (np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0.0).all()
    assert len(surface.points) < 15_000
    assert np.unique(surface.triangles).size == len(surface.points)


def test_discs_have_their_own_size_and_move_with_their_station() -> None:
    disc = Disc("wheel", 0.01, 0.2, 0.05, 0.03, STEEL)
    surface = rotor_surface(replace(STEPS["steps outside"], discs=(disc,)), 96)
    assert surface.names == (SHAFT, "wheel")
    own = np.unique(surface.triangles[surface.body == 1])
    assert np.unique(surface.station[own]) == pytest.approx([0.01])
    assert np.ptp(surface.points[own], axis=0) == pytest.approx([0.03, 0.2, 0.2])
    assert surface.volume("wheel") == pytest.approx(
        math.pi / 4 * (0.2**2 - 0.05**2) * 0.03, rel=1e-3
    )


def test_a_mass_is_the_cylinder_of_its_inertias() -> None:
    """A steel disc given as a point mass is drawn as that disc."""
    disc = Disc("wheel", 0.01, 0.2, 0.07, 0.03, STEEL)
    spindle = STEPS["steps outside"]
    as_disc = rotor_surface(replace(spindle, discs=(disc,)))
    as_mass = rotor_surface(replace(spindle, masses=(disc.as_point_mass(),)))
    np.testing.assert_allclose(as_mass.points, as_disc.points, rtol=0.0, atol=1e-9)


def test_a_mass_without_such_a_cylinder_is_a_collar() -> None:
    mass = PointMass("dot", 0.01, 1.0)
    surface = rotor_surface(replace(STEPS["steps outside"], masses=(mass,)))
    own = surface.points[np.unique(surface.triangles[surface.body == 1])]
    assert np.hypot(own[:, 1], own[:, 2]).max() == pytest.approx(1.06 * 0.035)


def test_rings_are_where_the_bearings_are() -> None:
    spindle = STEPS["the flagship"]
    rings = holder_surface(spindle)
    assert rings is not None
    assert rings.names == ("a", "b", "c", "d", "e")
    for number, seat in enumerate(spindle.seats):
        own = rings.points[np.unique(rings.triangles[rings.body == number])]
        assert own[:, 0].mean() == pytest.approx(seat.x)
        assert np.hypot(own[:, 1], own[:, 2]).min() > seat.bearing.pitch_diameter / 2.0
    assert holder_surface(STEPS["solid"]) is None


def test_orbits_are_at_ends_and_bearings_and_not_too_close() -> None:
    spindle = STEPS["the flagship"]
    stations = np.array(orbit_stations(spindle))
    assert stations[[0, -1]] == pytest.approx([spindle.shaft.start, spindle.shaft.end])
    length = spindle.shaft.end - spindle.shaft.start
    assert np.diff(stations).min() >= length / 12.0 * (1.0 - 1e-9)
    assert np.diff(stations).max() < length / 4.0
    assert {0.0286, 0.0844, 0.3809} <= set(stations.round(6))
