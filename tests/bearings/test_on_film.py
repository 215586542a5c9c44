"""Balls on their films: against bearings of larger balls, against differences of whole states."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import rotordyn
from bearings import STEEL, Lubricant
from bearings import on_film as on_films
from bearings.arrays import Array
from bearings.ball.law import Law
from bearings.geometry import geometry
from bearings.on_film import grown, on_film
from tests.oracles.known_bearings import RPM, VEX70
from tests.oracles.known_grooves import R24_14, four_point

OIL = Lubricant(32e-6, 5.4e-6)
LOAD = np.array([610.0, 0.0, 0.0, 0.0, 0.0])
SPEED = np.array([6e3, 12e3, 18e3]) * RPM


def ridden(**given: Any) -> Any:
    return on_film(VEX70, OIL, 50.0, **({"load": LOAD, "speed": SPEED} | given))


def test_films_are_the_growth_of_balls() -> None:
    """A bearing whose groove radii are smaller by the films, its groove centres where they were."""
    found = ridden()
    for k, speed in enumerate(SPEED):
        hi, ho = found.films.central[k, 0]
        assert 0.3e-6 < hi < ho < 1e-6
        d = VEX70.ball_diameter
        thinner = replace(
            VEX70,
            inner_conformity=VEX70.inner_conformity - hi / d,
            outer_conformity=VEX70.outer_conformity - ho / d,
        )
        along, up = VEX70.free_distance * np.array(
            [np.sin(VEX70.contact_angle), np.cos(VEX70.contact_angle)]
        )
        # free of load the shorter distance lies at the nominal angle; the grooves stay in place
        shorter = thinner.free_distance * np.array(
            [np.sin(VEX70.contact_angle), np.cos(VEX70.contact_angle)]
        )
        alone = thinner.equilibrium(load=LOAD, speed=speed, growth=up - shorter[1])
        assert found.state.inner_load[k] == pytest.approx(alone.inner_load, rel=1e-3)
        assert found.state.inner_angle[k] == pytest.approx(alone.inner_angle, rel=1e-3)
        moved = alone.displacement[0] + shorter[0] - along
        assert found.displacement[k, 0] == pytest.approx(moved, abs=2e-8)
        without = VEX70.equilibrium(load=LOAD, speed=speed).displacement[0]
        assert abs(moved - without) > 4e-7


def test_films_under_radial_load_are_those_of_the_balls_that_carry_it() -> None:
    """5 of 13 balls: the ring moves as one whose every ball has its own film (so slow that both
    races of a ball carry alike; Hertz along the radius)."""
    bearing, force = rotordyn.model("bearings", "6012"), 1000.0
    load, speed, how = [0.0, force, 0.0, 0.0, 0.0], 3000.0 * RPM, "frozen"
    given = {"load": load, "speed": speed, "law": Law(dynamics=how), "heating": False}
    found, g = on_film(bearing, OIL, 50.0, **given), geometry(bearing.grooves)
    assert (found.state.inner_load > 0.0).sum() == 5
    cos = np.cos(2.0 * np.pi * np.arange(bearing.balls) / bearing.balls)
    play = g.free_distance * (1.0 - np.cos(g.free_angle))

    def moved(film: Array) -> float:
        def left(y: float) -> float:
            approach = np.maximum(y * cos - play + film, 0.0)
            return float(g.series_stiffness * (approach**1.5) @ cos - force)

        return float(brentq(left, 0.0, 100e-6, xtol=1e-12))

    films = np.nan_to_num(found.films.central).sum(axis=-1)
    exact = moved(np.zeros(bearing.balls)) - moved(films)
    bare = bearing.equilibrium(load=load, speed=speed, dynamics=how).displacement[1]
    assert bare == pytest.approx(moved(np.zeros(bearing.balls)), rel=5e-3)
    assert bare - found.displacement[1] == pytest.approx(exact, rel=0.03)


def test_films_of_a_fast_bearing_count_by_the_loads_on_their_own_race() -> None:
    """Centrifugal forces load the outer race more evenly than the inner one."""
    load, speed = [300.0, 500.0, 0.0, 0.0, 0.0], 24000.0 * RPM
    found = on_film(VEX70, OIL, 50.0, load=load, speed=speed)
    state, films = found.state, found.films
    inner, outer = (each / each.max() for each in (state.inner_load, state.outer_load))
    assert (outer - inner).max() > 0.1
    mean = np.zeros(2)
    loads = state.inner_load, state.outer_load
    for each, moved in zip(loads, on_films.race_separation(state, films), strict=True):
        mean += np.average(moved, axis=0, weights=each)
    assert np.array(grown(state, films)) == pytest.approx(mean, rel=1e-12)


def test_a_state_that_its_films_take_away_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Next to a fold; without films there is a state, and turns do not go on between the two."""
    given = {"load": [[176.0, 1407.5, 0.0, 0.0, 0.0]], "speed": np.array([22263.6]) * RPM}
    kinematics = "inner"
    assert VEX70.equilibrium(**given, kinematics=kinematics).outcome[0] == ""
    turns = []
    monkeypatch.setattr(on_films, "grown", lambda *of: turns.append(of) or grown(*of))
    oil = Lubricant(220e-6, 20e-6)
    found = on_film(VEX70, oil, 40.0, **given, law=Law(kinematics), heating=False)
    assert found.state.outcome[0] == "no equilibrium"
    assert len(turns) < 5


def test_a_rigid_mounting_is_loaded_more() -> None:
    """Rings that keep their place: films of some 1.3 µm together raise the preload."""
    place = VEX70.equilibrium(load=LOAD, speed=SPEED).displacement
    found = ridden(load=None, displacement=place)
    rise = found.state.load[:, 0] / 610.0 - 1.0
    slope = VEX70.equilibrium(load=LOAD, speed=SPEED).complete_stiffness[:, 0, 0] / 610.0
    assert (rise > 0.02).all()
    assert found.displacement[:, 0] == pytest.approx(place[:, 0], abs=1e-12)
    assert (rise > 0.5 * slope * found.axial).all()


@pytest.mark.parametrize("speed", [8e3, 16e3])
@pytest.mark.parametrize("kinematics", ["hybrid", "outer"])
def test_stiffness_is_the_slope_of_whole_states(speed: float, kinematics: str) -> None:
    """Loads a little apart, films found again for each: a few per cent softer than without."""
    law, step = Law(kinematics), 0.5
    loads = LOAD + np.outer([-step, step], [1.0, 0, 0, 0, 0])
    given = {"speed": speed * RPM, "law": law, "heating": False}
    pair, middle = ridden(load=loads, **given), ridden(**given)
    low, high = pair.displacement[:, 0]
    slope = 2.0 * step / (high - low)
    assert middle.stiffness[0, 0] == pytest.approx(slope, rel=3e-3)
    bare = middle.state.complete_stiffness[0, 0]
    assert 0.95 * bare < middle.stiffness[0, 0] < 0.997 * bare


def test_nothing_without_films() -> None:
    """At rest there are none; a bearing of two arcs keeps its tangent."""
    found = ridden(speed=0.0)
    bare = VEX70.equilibrium(load=LOAD)
    assert found.growth == 0.0
    assert found.stiffness == pytest.approx(bare.complete_stiffness)
    arcs = on_film(four_point(R24_14), OIL, 50.0, load=[20e3, 12e3, 0, 0, 0], speed=100.0)
    assert (arcs.stiffness == arcs.state.complete_stiffness).all()


def test_radial_load_converges() -> None:
    steel = replace(VEX70, ball_material=STEEL)
    found = on_film(steel, OIL, 50.0, load=[610, 200, 0, 0, 0], speed=12e3 * RPM)
    assert found.state.load[:2] == pytest.approx([610.0, 200.0])
    assert found.films.central.max() < 1.05 * found.films.central.min() * 1.3
    assert np.isfinite(found.stiffness).all()
