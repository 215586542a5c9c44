"""Race control of a single bearing as an answer to a case."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rotordyn.analyses.control.solve as race_control
from bearings.ball.law import Law
from rotordyn.analyses.control.control_map import control_map, quadratic
from rotordyn.analyses.control.solve import fit_words, fitted, solve
from rotordyn.analyses.control.spec import ControlSpec
from rotordyn.errors import NoSolution
from rotordyn.scene.conditions import Conditions
from tests.oracles.known_bearings import RPM, VEX70
from tests.oracles.known_grooves import QJ218, four_point

CLOSE = replace(VEX70, inner_conformity=0.52)
SPEED = np.array([0.0, 5000.0, 10000.0, 15000.0, 20000.0]) * RPM


def test_it_is_the_map_of_the_bearing_under_the_conditions() -> None:
    conditions = Conditions(kinematics="outer", moment_sharing="hybrid")
    found = solve(CLOSE, conditions, SPEED, ControlSpec(9000.0, 20.0, 0.1, 2e-6))
    alone = control_map(
        CLOSE,
        speed=SPEED,
        lowest=20.0,
        highest=9000.0,
        radial=0.1,
        static_growth=2e-6,
        law=Law("outer", "hybrid"),
    )
    np.testing.assert_array_equal(found.boundary_load, alone.boundary)
    np.testing.assert_array_equal(found.inner_margin, alone.inner_margin)
    assert found.boundary == ("inner", "outer")
    assert (found.load[0], found.load[-1]) == pytest.approx((20.0, 9000.0))
    assert found.outcome == ("",) * 5
    assert found.boundary_absence[:, 0].tolist() == [
        "inner race controls at every load that has a solution",
        "outer race controls at no load that has a solution",
    ]
    assert (np.isnan(found.boundary_load) == (found.boundary_absence != "")).all()


def test_the_fit_leaves_out_speeds_without_boundary() -> None:
    found = solve(CLOSE, Conditions(), SPEED, ControlSpec(9000.0))
    fit, misfit = quadratic(SPEED[1:], found.boundary_load[0, 1:])
    assert found.fit[0] == pytest.approx(fit)
    assert found.fit_misfit[0] == pytest.approx(misfit)
    assert np.abs(fitted(found, 0) - found.boundary_load[0])[1:].max() == pytest.approx(misfit)
    words = fit_words(replace(found, fit=np.array([[1e-4, -2e-2, 3.0]] * 2)))
    assert words["inner"].startswith("1.097 n² − 2.09 n + 3 N, n in 1000 rpm, misfit ")


def test_three_speeds_have_no_fit_that_could_miss() -> None:
    found = solve(CLOSE, Conditions(), SPEED[:4], ControlSpec(9000.0))
    assert found.fit_absence == ("fewer than 4 speeds have this boundary",) * 2
    assert np.isnan(found.fit).all()
    assert fit_words(found) == {}


def test_speeds_without_any_state_say_so() -> None:
    inner = Conditions(kinematics="inner")
    found = solve(CLOSE, inner, np.array([1000.0, 30000.0]) * RPM, ControlSpec(100.0))
    assert found.outcome == ("", "no equilibrium at 30000 rpm")
    assert found.boundary_absence[:, 1].tolist() == ["no equilibrium"] * 2
    with pytest.raises(NoSolution, match="no equilibrium"):
        solve(CLOSE, inner, np.array([30000.0]) * RPM, ControlSpec(100.0))


def test_a_third_contact_at_every_load_leaves_no_race_control() -> None:
    """Of a QJ 218 at 6000 rpm up to 2 kN."""
    with pytest.raises(NoSolution, match="no load and speed of the case has race control: third"):
        solve(four_point(QJ218), Conditions(), np.array([6000.0]) * RPM, ControlSpec(2e3))


def test_what_contacts_cannot_bear_is_no_boundary(monkeypatch: pytest.MonkeyPatch) -> None:
    found = solve(CLOSE, Conditions(), SPEED, ControlSpec(9000.0))
    limit = float(found.boundary_pressure[0, 2:4].mean())
    monkeypatch.setattr(race_control, "HIGHEST_PRESSURE", limit)
    less = solve(CLOSE, Conditions(), SPEED, ControlSpec(9000.0))
    assert np.isfinite(less.boundary_load[0]).tolist() == [False, True, True, False, False]
    assert "boundary overloaded" in less.boundary_absence[0, 3]
    assert less.boundary_absence[0, 2] == ""
