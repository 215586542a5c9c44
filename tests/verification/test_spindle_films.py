"""Oil films in the state of a spindle: against the single bearing, against statics of a ball."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from bearings import Lubricant
from bearings.film import film
from bearings.on_film import on_film, race_separation
from rotordyn.errors import InvalidInput
from rotordyn.scene.lubrication import Lubrication
from rotordyn.scene.scene import Scene
from tests.oracles.known_grooves import R24_14, four_point

OILED = Lubrication(viscosity_40=32e-6, viscosity_100=5.4e-6, temperature=50.0)
SPEED = np.array([0.0, 8e3, 16e3, 24e3]) * math.pi / 30.0


@pytest.fixture(scope="module")
def case():
    return rotordyn.load("mfw2310")


def scene(case, films=OILED, **given):
    conditions = replace(case.conditions, films=films, **given)
    return Scene(case.spindle, conditions, SPEED, 2000.0, ())


@pytest.mark.parametrize("seat", [0, 2, 3])
def test_bearings_of_a_spindle_are_single_ones_on_films(case, seat):
    """At the place and ring growth that the spindle gives them: positions of its bodies, and what
    rotation does to shaft and rings of the machine without films."""
    wet, dry = scene(case), scene(case, None).preload.network.arrangement.bearings
    state = wet.preload
    every = state.network.arrangement.bearings
    row = next(k for k, each in enumerate(every) if seat in each.seats)
    still = next(each for each in dry if seat in each.seats)
    place = np.zeros((len(SPEED), 5))
    place[:, 0] = (state.net.position @ state.network.incidence.T)[:, row]
    place[:, 0] += still.thrust * still.shortening
    bearing = case.spindle.seats[seat]
    alone = on_film(
        bearing.bearing,
        OILED.oil,
        OILED.temperature,
        displacement=place,
        speed=SPEED,
        static_growth=bearing.growth.static,
        growth=still.growth,
        law=bearing.law(case.conditions.law),
    )
    np.testing.assert_allclose(state.seat_load()[:, seat], alone.state.load[:, 0], rtol=1e-7)
    stiff = np.abs(alone.stiffness).max()
    np.testing.assert_allclose(wet.tangents[:, seat], alone.stiffness, atol=1e-7 * stiff)


def test_films_raise_preload_and_stiffness_and_none_is_at_rest(case):
    wet, dry = scene(case), scene(case, None)
    load, bare = wet.preload.seat_load(), dry.preload.seat_load()
    np.testing.assert_allclose(load[0], bare[0], rtol=1e-9)
    assert (load[1:] > 1.01 * bare[1:]).all()
    assert (wet.tangents[1:, :, 1, 1] > 1.01 * dry.tangents[1:, :, 1, 1]).all()
    np.testing.assert_allclose(wet.preload.films.without, bare, rtol=1e-12)


def test_films_beyond_the_formula_of_inlet_heating_are_reported(case):
    thick = replace(OILED, viscosity_40=20e-3, viscosity_100=0.5e-3, temperature=40.0)
    for oil, said in ((OILED, False), (thick, True)):
        found = scene(case, oil)
        assert (found.preload.films.growth[1:] == 0.0).any() == said
        words = "films are taken as 0 from 8000 rpm on"
        assert any(words in each for each in found.warnings) == said


def test_loads_across_the_axis_act_on_films(case):
    """A weight of nothing leaves the state as it is, a real one its axial sum nearly."""
    still, weighed = scene(case), scene(case, gravity="-y")
    assert weighed.loaded
    assert weighed.preload.films is not None
    np.testing.assert_allclose(
        weighed.preload.seat_load()[1:], still.preload.seat_load()[1:], rtol=0.05
    )
    assert (weighed.tangents[1:, :, 1, 1] > 1.01 * scene(case, None).tangents[1:, :, 1, 1]).all()


def test_races_move_off_their_films_by_virtual_work():
    """The work of the forces of a race on the way by which films hold it off a ball is that of its
    contacts on the films; a pair in balance moves by h/cos α, not by the sum of both."""
    state = four_point(R24_14).equilibrium(load=[4e3, 9e3, 0.0, 0.0, 0.0], speed=300.0)
    films = film(state, Lubricant(32e-6, 5.4e-6), 60.0)
    moved = race_separation(state, films)
    loaded = state.contact_load > 0.0
    assert {2, 4} <= {*loaded.sum(axis=1)}
    load, thick = (np.where(loaded, each, 0.0) for each in (state.contact_load, films.central))
    ways = np.array([1.0, -1.0, -1.0, 1.0])  # inner right and left, outer right and left
    angle = ways * np.where(loaded, state.contact_angle, 0.0)
    forces = load[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    for own, race in zip(moved, (slice(0, 2), slice(2, 4)), strict=True):
        work = (forces[:, race].sum(axis=1) * own).sum(axis=-1)
        known = (load * thick)[:, race].sum(axis=1)
        np.testing.assert_allclose(work, known, rtol=1e-9)


def test_a_pair_of_contacts_in_balance_moves_by_the_wedge_of_both():
    """h/cos α, not 2 h cos α."""
    state = four_point(R24_14).equilibrium(
        load=[0.0, 9e3, 0.0, 0.0, 0.0], speed=300.0, dynamics="frozen"
    )
    films = film(state, Lubricant(32e-6, 5.4e-6), 60.0)
    ball = int(np.argmax(state.contacts))
    assert state.contacts[ball] == 4
    for own, at in zip(race_separation(state, films), (0, 2), strict=True):
        wedge = films.central[ball, at] / np.cos(state.contact_angle[ball, at])
        assert own[ball] == pytest.approx([wedge, 0.0], rel=1e-6, abs=1e-6 * wedge)


def test_films_are_not_a_number_where_there_is_no_state():
    loads = np.outer([1e3, 1e9], [1.0, 0.0, 0.0, 0.0, 0.0])
    state = four_point(R24_14).equilibrium(load=loads, speed=300.0)
    assert [word == "" for word in state.outcome] == [True, False]
    films = film(state, Lubricant(32e-6, 5.4e-6), 60.0)
    for each in (films.least, films.central, films.growth):
        assert np.isfinite(each[0]).all()
        assert np.isnan(each[1]).all()


FILMS = "films: {viscosity_40: 32 mm^2/s, viscosity_100: 5.4 mm^2/s, temperature: 50 degC}"


@pytest.mark.parametrize(
    ("conditions", "sentence"),
    [
        (f"{{bearings: static, {FILMS}}}", "films: needs bearings at speed"),
        (f"{{tangent: frozen, {FILMS}}}", "films need the complete tangent"),
        (f"{{{FILMS.replace('5.4', '54')}}}", "not below viscosity_40"),
        ("{films: {viscosity_40: 32 mm^2/s, viscosity_100: 5 mm^2/s}}", "temperature"),
    ],
)
def test_faults(tmp_path, conditions, sentence):
    path = tmp_path / "case.yaml"
    path.write_text(
        "title: t\nspindle: mfw2310\nspeeds: [0 rpm, 9000 rpm]\nanalyses: {preload: }\n"
        f"conditions: {conditions}\n",
        encoding="utf-8",
    )
    with pytest.raises(InvalidInput, match=sentence):
        rotordyn.load(path)
