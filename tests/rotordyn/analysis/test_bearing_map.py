"""A single bearing over load and speed."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearings import stiffness
from rotordyn.analysis.bearing_map import answer, tangent_error
from rotordyn.analysis.known import matches
from rotordyn.analysis.specs import BearingMapSpec, Conditions
from rotordyn.errors import NoSolution
from rotordyn.machine.reference import Reference
from tests.oracles.known_bearings import RPM, VEX70

SPEED = np.array([0.0, 15000.0, 30000.0]) * RPM


def test_each_entry_is_the_bearing_alone() -> None:
    found = answer(VEX70, Conditions(), SPEED, BearingMapSpec((250.0, 1220.0), 2e-6))
    assert (found.outcome == "").all()
    for row, speed in enumerate(SPEED):
        for column, load in enumerate((250.0, 1220.0)):
            alone = VEX70.equilibrium(load=[load, 0, 0, 0, 0], speed=speed, static_growth=2e-6)
            assert found.deflection[row, column] == pytest.approx(alone.displacement[0], rel=1e-9)
            assert found.inner_load[row, column] == pytest.approx(alone.inner_load[0], rel=1e-9)
            assert found.stiffness[row, column, 0] == pytest.approx(
                alone.stiffness("complete"), rel=1e-7, abs=1e-3
            )
            assert found.control[row, column] == alone.control[0]
            assert found.inner_spin_to_roll[row, column] == pytest.approx(
                alone.inner_spin_to_roll[0], rel=1e-9
            )
            assert found.outer_grip[row, column] == pytest.approx(alone.outer_grip[0], rel=1e-9)


def test_known_stiffness_at_30000_rpm() -> None:
    """Noël (2013), Fig. 2.21 with the physical sign: 23.9 and 32.6 N/µm at 1000 N, hybrid."""
    found = answer(VEX70, Conditions(moment_sharing="hybrid"), SPEED[2:], BearingMapSpec((1000.0,)))
    equal = answer(VEX70, Conditions(), SPEED[2:], BearingMapSpec((1000.0,)))
    values = [np.diag(f.stiffness[0, 0, 0])[:2] / 1e6 for f in (found, equal)]
    expected = np.array([23.9, 32.6])
    assert min(np.abs(v / expected - 1).max() for v in values) < 5e-3


def test_tangents_side_by_side() -> None:
    names = ("frozen", "complete", "difference")
    found = answer(VEX70, Conditions(), SPEED, BearingMapSpec((250.0, 1000.0), tangents=names))
    assert found.tangent == names
    for place, name in enumerate(names):
        alone = stiffness(VEX70.equilibrium(load=[250.0, 0, 0, 0, 0], speed=SPEED[2]), name)
        assert found.stiffness[2, 0, place] == pytest.approx(alone, rel=1e-6, abs=1.0)
    frozen, exact = (tangent_error(found, name, "x") for name in ("frozen", "difference"))
    complete = found.stiffness[..., 1, 0, 0]
    assert frozen == pytest.approx(found.stiffness[..., 0, 0, 0] / complete - 1.0)
    assert (frozen[0] == 0.0).all()
    assert np.abs(exact).max() < 1e-6 < np.abs(frozen[2]).min()


def test_a_published_error_stands_beside_the_largest_of_ours() -> None:
    known = Reference("frozen_error", "published", "x", (SPEED[2],), (0.16,))
    spec = BearingMapSpec((250.0, 1000.0), tangents=("complete", "frozen"))
    found = answer(VEX70, Conditions(kinematics="outer"), SPEED, spec)
    (match,) = matches([known], {"bearing": found}, None)
    assert match.values == pytest.approx((0.125,), abs=6e-4)
    alone = answer(VEX70, Conditions(), SPEED, BearingMapSpec((250.0,)))
    assert matches([known], {"bearing": alone}, None) == []


def test_control_that_the_kinematics_assumes_is_checked() -> None:
    """At 30 000 rpm the outer race controls; inner control contradicts Jones' criterion there."""
    for kinematics, agrees in (("outer", True), ("inner", False), ("hybrid", True)):
        found = answer(
            VEX70, Conditions(kinematics=kinematics), SPEED[2:], BearingMapSpec((1220.0,))
        )
        assert found.control.tolist() == [["outer"]]
        assert found.control_agrees.tolist() == [[agrees]]


def test_a_load_without_state_keeps_its_reason() -> None:
    """Inner control ends with a jump at low load: NaN only beside the outcome, in every tangent."""
    spec = BearingMapSpec((5.0, 2000.0), tangents=("complete", "frozen", "difference"))
    found = answer(VEX70, Conditions(kinematics="inner"), SPEED[2:], spec)
    assert "no equilibrium at 30000 rpm under 5 N" in found.outcome[0, 0]
    assert np.isnan(found.stiffness[0, 0]).all()
    assert np.isnan(found.inner_spin_to_roll[0, 0])
    assert (found.control[0, 0], found.control_agrees[0, 0]) == ("", False)
    assert found.outcome[0, 1] == ""
    assert np.isfinite(found.stiffness[0, 1]).all()


def test_static_bearing_does_not_know_the_speed() -> None:
    found = answer(VEX70, Conditions(bearings="static"), SPEED, BearingMapSpec((500.0,)))
    assert found.deflection.shape == (3, 1)
    assert (found.deflection == found.deflection[0]).all()
    assert (found.centrifugal_force == 0).all()


def test_growth_that_takes_the_whole_contact_angle() -> None:
    """arccos(cos α + Δu0/BD) without a value: nothing can be solved."""
    limit = 0.1 * 9.525e-3 * (1 - math.cos(math.radians(25)))
    with pytest.raises(NoSolution):
        answer(VEX70, Conditions(), SPEED, BearingMapSpec((500.0,), 1.05 * limit))
