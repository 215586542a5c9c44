"""The benchmarks of one bearing run, and measure what they state (benchmarks/bearing)."""

from __future__ import annotations

import pytest

from bearings.contact import hertz
from bearings.geometry import geometry
from bearings.ring.tolerances import TOLERANCE
from benchmarks.bearing.hertz_fits import contacts, measure_hertz
from benchmarks.bearing.methods import measure_methods
from benchmarks.bearing.path_steps import measure_path_steps
from benchmarks.bearing.reference import Reference
from benchmarks.bearing.speed import lost_from_unloaded, measure_speed
from benchmarks.bearing.subject import LOAD, SPEED, VEX70
from benchmarks.bearing.tolerance import TOLERANCES, measure_tolerance
from docs.generate.bearing_times import bearing_parts


def test_the_reference_solves_the_same_bearing() -> None:
    """Plain equations in more digits: no function in common with the solver."""
    bearing = VEX70
    state = bearing.equilibrium(load=LOAD, speed=SPEED, compiled=False)
    load, k = Reference(bearing, SPEED).load_and_stiffness(state.displacement, state.ball_centre)
    assert load == pytest.approx(LOAD, abs=1e-9)
    assert state.stiffness() == pytest.approx(k, rel=1e-9, abs=1e-3)


@pytest.mark.long
def test_every_way_to_solve_finds_the_same() -> None:
    lines = measure_speed(count=2, repeats=1)
    assert len(lines) == 20
    for line in lines:
        assert line["error"] < 1e-9, line["way"]
        assert line["error_k"] is None or line["error_k"] < 1e-6, line["way"]
    assert {line["target"] for line in lines if line["target"]} == {60.0, 300.0, 1.0, 6.0}


def test_a_plain_solve_from_the_unloaded_geometry_loses_balls() -> None:
    assert 1 <= lost_from_unloaded() < 25


def test_the_five_methods_differ_in_k_alone() -> None:
    lines = {line["number"]: line for line in measure_methods(copies=2, repeats=1)}
    assert lines[1]["k_apart"] == pytest.approx(lines[2]["k_apart"], rel=1e-6)
    assert lines[1]["k_apart"] > 1e-3
    assert max(lines[n]["k_apart"] for n in (3, 4, 5)) < 1e-8


@pytest.mark.long
def test_a_tighter_newton_leaves_less() -> None:
    lines = measure_tolerance(count=6, repeats=1)
    for start in ("warm", "cold"):
        errors = [line["error_k"] for line in lines if line["start"] == start]
        assert len(errors) == len(TOLERANCES)
        assert errors[0] > 1e-4 > 1e-10 > errors[TOLERANCES.index(TOLERANCE)]


@pytest.mark.long
def test_path_steps_too_coarse_lose_states() -> None:
    found = measure_path_steps(bearings=2, repeats=1)
    assert found["states"] == 100 >= found["certain"] > 90
    lost = {(line["varied"], line["value"]): line["refused"] for line in found["lines"]}
    assert lost["shortest path step", 0.5] > lost["largest rotation [rad]", 0.15] == 0


def test_fits_err_as_they_are_known_to() -> None:
    """Brewe and Hamrock (1977): 3 % in k, as they state for κ and the integrals' product."""
    lines = {line["way"]: line for line in measure_hertz(repeats=1)}
    exact, fit = lines["exact, `bearings.contact.hertz`"], lines["Brewe and Hamrock 1977"]
    assert max(exact["k"].values()) < 1e-13
    assert 0.01 < fit["k"]["0.52"] < 0.02
    assert max(fit["k"][f] for f in ("0.54", "0.56")) < 0.008
    assert max(fit["load"]) > 1e-3 > 1e-11 > max(exact["load"])


def test_contacts_are_put_back() -> None:
    before = geometry(VEX70.grooves).inner.stiffness
    with contacts(lambda *case: hertz.HertzContact(1.0, 2.0, 1.0, 1.0, 1.0)):
        assert geometry(VEX70.grooves).inner.stiffness == 1.0
    assert geometry(VEX70.grooves).inner.stiffness == before


def test_all_tables_can_be_written() -> None:
    speed = dict(task="x", way="y", state=70.0, ball=2.8, error=1e-12, error_k=None)
    first = {"what": "x", "imported": 0.1, "first": 1.0, "second": 0.1}
    found = {
        "busy": None,
        "first_call": [first],
        "speed": [{**speed, "target": 60.0, "per": "state"}],
        "lost_from_unloaded": 0,
        "methods": measure_methods(copies=2, repeats=1),
        "tolerance": [],
        "path_steps": {"lines": [], "states": 0, "certain": 0, "exist": 0},
        "hertz": measure_hertz(repeats=1),
    }
    parts = bearing_parts(found)
    assert len(parts) == 6
    assert "60 µs a state: **missed by 17 %**" in parts["bearing"]
    assert all(text.startswith("| ") for text in parts.values())
