"""A single bearing over load and speed."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import bearings
from rotordyn.analyses.bearing.figures.contacts import contacts_figure
from rotordyn.analyses.bearing.result import MomentMapResult, RadialMapResult, motion
from rotordyn.analyses.bearing.solve import solve, tangent_error
from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.bearing.summary import warnings
from rotordyn.analyses.known import matches
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.reference import Reference
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.heat_flow import MountedHeatFlow
from rotordyn.scene.lubrication import Lubrication
from tests.oracles.known_bearings import RPM, VEX70
from tests.oracles.known_grooves import QJ218, R24_14, four_point

OIL = Lubrication(32e-6, 5.4e-6, 50.0)
FLOW = MountedHeatFlow(3.0, 6.0, 30.0, 25.0, 30.0, balls_oil=1.0)
SPEED = np.array([0.0, 15000.0, 30000.0]) * RPM


def test_each_entry_is_the_bearing_alone() -> None:
    found = solve(VEX70, Conditions(), SPEED, BearingMapSpec((250.0, 1220.0), 2e-6))
    assert (found.outcome == "").all()
    *words, moved = motion(found)
    assert words == ["axial deflection", "µm"]
    for row, speed in enumerate(SPEED):
        for column, load in enumerate((250.0, 1220.0)):
            alone = VEX70.equilibrium(load=[load, 0, 0, 0, 0], speed=speed, static_growth=2e-6)
            assert found.deflection[row, column] == pytest.approx(alone.displacement[0], rel=1e-9)
            assert moved[row, column] * 1e-6 == pytest.approx(alone.displacement[0], rel=1e-9)
            assert found.inner_load[row, column] == pytest.approx(alone.inner_load[0], rel=1e-9)
            assert found.stiffness[row, column, 0] == pytest.approx(
                alone.stiffness("complete"), rel=1e-7, abs=1e-3
            )
            assert found.control[row, column] == alone.control[0]
            assert found.inner_spin_to_roll[row, column] == pytest.approx(
                alone.inner_spin_to_roll[0], rel=1e-9
            )
            assert found.outer_required_friction[row, column] == pytest.approx(
                alone.outer_required_friction[0], rel=1e-9
            )


def test_known_stiffness_at_30000_rpm() -> None:
    """Noël (2013), Fig. 2.21 with the physical sign: 23.9 and 32.6 N/µm at 1000 N, hybrid."""
    found = solve(VEX70, Conditions(moment_sharing="hybrid"), SPEED[2:], BearingMapSpec((1000.0,)))
    equal = solve(VEX70, Conditions(), SPEED[2:], BearingMapSpec((1000.0,)))
    values = [np.diag(f.stiffness[0, 0, 0])[:2] / 1e6 for f in (found, equal)]
    expected = np.array([23.9, 32.6])
    assert min(np.abs(v / expected - 1).max() for v in values) < 5e-3


def test_tangents_side_by_side() -> None:
    names = ("frozen", "complete", "difference")
    found = solve(VEX70, Conditions(), SPEED, BearingMapSpec((250.0, 1000.0), tangents=names))
    assert found.tangent == names
    for place, name in enumerate(names):
        state = VEX70.equilibrium(load=[250.0, 0, 0, 0, 0], speed=SPEED[2])
        alone = bearings.stiffness(state, name)
        assert found.stiffness[2, 0, place] == pytest.approx(alone, rel=1e-6, abs=1.0)
    frozen, exact = (tangent_error(found, name, "x") for name in ("frozen", "difference"))
    complete = found.stiffness[..., 1, 0, 0]
    assert frozen == pytest.approx(found.stiffness[..., 0, 0, 0] / complete - 1.0)
    assert (frozen[0] == 0.0).all()
    assert np.abs(exact).max() < 1e-6 < np.abs(frozen[2]).min()


def test_a_published_error_is_beside_the_largest_computed_one() -> None:
    known = Reference("frozen_error", "published", "x", (SPEED[2],), (0.16,))
    spec = BearingMapSpec((250.0, 1000.0), tangents=("complete", "frozen"))
    found = solve(VEX70, Conditions(kinematics="outer"), SPEED, spec)
    (match,) = matches([known], {"bearing": found}, None)
    assert match.values == pytest.approx((0.125,), abs=6e-4)
    alone = solve(VEX70, Conditions(), SPEED, BearingMapSpec((250.0,)))
    assert matches([known], {"bearing": alone}, None) == []


def test_control_that_the_kinematics_assumes_is_checked() -> None:
    """At 30 000 rpm the outer race controls; inner control contradicts Jones' criterion there."""
    for kinematics, agrees in (("outer", True), ("inner", False), ("hybrid", True)):
        found = solve(
            VEX70, Conditions(kinematics=kinematics), SPEED[2:], BearingMapSpec((1220.0,))
        )
        assert found.control.tolist() == [["outer"]]
        assert found.control_agrees.tolist() == [[agrees]]


def test_a_load_without_state_keeps_its_reason() -> None:
    """Inner control ends with a jump at low load: NaN only beside the outcome, in every tangent."""
    spec = BearingMapSpec((5.0, 2000.0), tangents=("complete", "frozen", "difference"))
    found = solve(VEX70, Conditions(kinematics="inner"), SPEED[2:], spec)
    assert "no equilibrium at 30000 rpm under 5 N: raise the load" in found.outcome[0, 0]
    assert "or use outer or hybrid kinematics" in found.outcome[0, 0]
    assert np.isnan(found.stiffness[0, 0]).all()
    assert np.isnan(found.inner_spin_to_roll[0, 0])
    assert (found.control[0, 0], found.control_agrees[0, 0]) == ("", False)
    assert found.outcome[0, 1] == ""
    assert np.isfinite(found.stiffness[0, 1]).all()


def test_static_bearing_does_not_depend_on_the_speed() -> None:
    found = solve(VEX70, Conditions(bearings="static"), SPEED, BearingMapSpec((500.0,)))
    assert found.deflection.shape == (3, 1)
    assert (found.deflection == found.deflection[0]).all()
    assert (found.centrifugal_force == 0).all()


def test_growth_that_takes_the_whole_contact_angle() -> None:
    """arccos(cos α + Δu0/BD) without a value: nothing can be solved."""
    limit = 0.1 * 9.525e-3 * (1 - math.cos(math.radians(25)))
    with pytest.raises(NoSolution):
        solve(VEX70, Conditions(), SPEED, BearingMapSpec((500.0,), 1.05 * limit))


def test_radial_loads_over_a_fixed_thrust() -> None:
    """Case 3 of Lacroix (2014), rigid: 20 and 12 kN, angles 22.4° and 57.7°, 228 and 136 µm."""
    spec = BearingMapSpec(radial_loads=(0.0, 12e3), axial_load=20e3)
    bearing = four_point(R24_14)
    found = solve(bearing, Conditions(kinematics="outer"), np.array([1500.0]) * RPM, spec)
    assert isinstance(found, RadialMapResult)
    assert found.contact == ("ir", "il", "or", "ol")
    assert found.ball == pytest.approx(np.arange(20) * math.pi / 10.0)
    assert found.deflection[0, 1] * 1e6 == pytest.approx(228.0, abs=0.8)
    *words, moved = motion(found)
    assert words == ["radial deflection", "µm"]
    assert moved[0, 1] == pytest.approx(136.0, abs=0.8)
    angles = np.degrees(found.contact_angle[0, 1, [0, 10], 0])
    assert angles == pytest.approx([22.4, 57.7], abs=0.06)
    assert found.contacts[0].tolist() == [[2] * 20, [3] * 3 + [2] * 15 + [3] * 2]
    assert found.loaded_ball.tolist() == [[0, 0]]
    load = found.contact_load[0, 1]
    for mirrored in range(1, 10):  # about the plane of the load
        assert load[mirrored] == pytest.approx(load[20 - mirrored], rel=1e-6, abs=1e-3)
    state = bearing.equilibrium(load=[20e3, 12e3, 0, 0, 0], speed=1500.0 * RPM, kinematics="outer")
    assert found.inner_load[0, 1] == pytest.approx(state.inner_load[0], rel=1e-9)
    assert found.ellipse_upper[0, 1] == pytest.approx(
        bearings.truncation(state).upper_end, rel=1e-9, nan_ok=True
    )


def test_moments_turn_the_most_loaded_ball_to_the_other_side() -> None:
    spec = BearingMapSpec(moments=(0.0, 800.0), axial_load=20e3, radial_load=5e3)
    found = solve(four_point(R24_14), Conditions(kinematics="outer"), np.zeros(1), spec)
    assert isinstance(found, MomentMapResult)
    assert found.loaded_ball.tolist() == [[0, 10]]
    assert found.contact_load[0, 1, 10].max() == found.contact_load[0, 1].max()
    assert found.contacts[0, 1].max() == 4
    assert found.tilt[0, 1] > found.tilt[0, 0]


def test_a_moment_and_its_reverse_are_mirror_images() -> None:
    """Turned half round about x, Mz and θz change sign with the place of the balls."""
    spec = BearingMapSpec(moments=(-500.0, 500.0), axial_load=20e3)
    found = solve(four_point(R24_14), Conditions(), np.array([3000.0]) * RPM, spec)
    assert found.tilt[0, 0] == pytest.approx(-found.tilt[0, 1], rel=1e-6)
    *words, moved = motion(found)
    assert words == ["tilt", "mrad"]
    assert moved * 1e-3 == pytest.approx(found.tilt)
    turned = np.roll(found.contact_load[0, 0], 10, axis=0)
    assert found.contact_load[0, 1] == pytest.approx(turned, rel=1e-5, abs=0.05)


def test_blocked_tilts() -> None:
    """The ring does not tilt, and is displaced less than with free tilts."""
    loads = dict(radial_loads=(6e3,), axial_load=20e3)
    free, held = (
        solve(four_point(R24_14), Conditions(), np.zeros(1), BearingMapSpec(**loads, tilt=tilt))
        for tilt in ("free", "blocked")
    )
    assert held.tilt[0, 0] == 0.0
    assert abs(free.tilt[0, 0]) > 1e-4
    assert 0.0 < held.radial_deflection[0, 0] < free.radial_deflection[0, 0]


def test_frozen_dynamics_of_a_third_contact() -> None:
    """QJ218 at 5 kN: from 3200 rpm on by an independent code, without gyroscopic moment."""
    spec, frozen = BearingMapSpec((5e3,)), Conditions(dynamics="frozen")
    speed = np.array([3200.0 * 0.99, 3200.0 * 1.01]) * RPM
    found = solve(four_point(QJ218), frozen, speed, spec)
    assert found.contacts[:, 0, 0].tolist() == [2, 3]
    assert (found.gyroscopic_moment == 0.0).all()
    assert found.ball.size == 1  # all alike


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({}, "exactly one list of loads, radial_loads, moments: got none"),
        ({"loads": (1.0,), "moments": (1.0,)}, "got loads and moments"),
        ({"radial_loads": (1.0,), "radial_load": 2.0}, "given by the list radial_loads already"),
        ({"moments": (1.0,), "tilt": "blocked"}, "has no effect on a blocked tilt"),
        ({"moments": (2.0, 1.0)}, r"moments\.2: not in ascending order"),
        ({"loads": (1.0,), "films": True}, "films needs an oil: give lubricant"),
        ({"loads": (1.0,), "heat": "palmgren"}, "heat: heat needs an oil: give lubricant"),
        ({"loads": (1.0,), "heat_flow": FLOW}, "heat_flow needs an oil: give lubricant"),
        ({"loads": (1.0,), "heat_flow": FLOW, "lubricant": OIL, "films": True}, "one of the two"),
        ({"radial_loads": (1.0,), "heat_flow": FLOW, "lubricant": OIL}, "axial loads only"),
        (
            {"loads": (1.0,), "films": True, "lubricant": OIL, "tangents": ("frozen",)},
            "films need the complete tangent",
        ),
    ],
)
def test_loads_that_contradict_one_another(keys: dict[str, Any], said: str) -> None:
    with pytest.raises(InvalidInput, match=said):
        BearingMapSpec(**keys)


def test_one_of_the_two_inertias_alone() -> None:
    found = {
        name: solve(VEX70, Conditions(dynamics=name), SPEED[:2], BearingMapSpec((1000.0,)))
        for name in ("resultant", "centrifugal", "gyroscopic")
    }
    alone = VEX70.equilibrium(load=[1000, 0, 0, 0, 0], speed=SPEED[1], dynamics="centrifugal")
    assert found["centrifugal"].deflection[1, 0] == pytest.approx(alone.displacement[0], rel=1e-9)
    assert (found["centrifugal"].gyroscopic_moment == 0.0).all()
    assert (found["gyroscopic"].centrifugal_force == 0.0).all()
    assert found["gyroscopic"].gyroscopic_moment[1, 0] > 0.0
    rest = [each.deflection[0, 0] for each in found.values()]
    assert rest == pytest.approx([rest[0]] * 3, rel=1e-12)


def test_films_are_those_of_the_bearing_alone() -> None:
    spec = BearingMapSpec((610.0,), films=True, lubricant=OIL)
    found, bare = (
        solve(VEX70, Conditions(), SPEED[:2], each)
        for each in (spec, BearingMapSpec((610.0,), lubricant=OIL))
    )
    alone = bearings.on_film.on_film(VEX70, OIL.oil, 50.0, load=[610.0, 0, 0, 0, 0], speed=SPEED[1])
    assert found.deflection[1, 0] == pytest.approx(alone.displacement[0], abs=1e-12)
    assert found.stiffness[1, 0, 0] == pytest.approx(alone.stiffness, rel=1e-9)
    assert found.film_growth[0, 0] == 0.0
    assert found.film_growth[1, 0] > 0.5e-6
    assert (bare.film_growth == 0.0).all()


def test_hot_oil_lowers_the_rating_and_says_so() -> None:
    """To 0.42 at 250 °C; lives fall with its cube."""
    cool, hot = (
        solve(VEX70, Conditions(), SPEED[:2], BearingMapSpec((610.0,), lubricant=oil))
        for oil in (OIL, replace(OIL, temperature=250.0))
    )
    assert hot.revolutions == pytest.approx(0.42**3 * cool.revolutions)
    assert any("hotter than 150 °C from 0 rpm on: the dynamic" in each for each in warnings(hot))
    assert not any("hotter" in each for each in warnings(cool))


def test_temperatures_are_those_of_the_bearing_alone() -> None:
    """300 N and 610 N between rigid rings, run-away above the limit; a spring stays cooler."""
    from bearings import heat

    spec = BearingMapSpec((300.0, 610.0), heat_flow=FLOW, lubricant=OIL)
    speed = np.array([0.0, 8e3, 16e3, 24e3]) * RPM
    found = solve(VEX70, Conditions(), speed, spec)
    mounting = heat.Mounting(OIL.oil, FLOW.conductances, FLOW.surroundings)
    alone = heat.heated(VEX70, mounting, speed=speed[2], preload=610.0)
    assert found.ball_temperature[2, 1] == pytest.approx(alone.temperatures.balls[0], abs=1e-3)
    assert found.axial_force[2, 1] == pytest.approx(alone.axial_load[0], rel=1e-5)
    lost = heat.losses(alone.state, OIL.oil, alone.temperatures.balls)
    total = found.contact_heat[2, 1] + found.viscous_heat[2, 1]
    assert total == pytest.approx(float(lost.total[0]), rel=1e-4)
    assert all("run away" in word for word in found.outcome[3])
    assert np.isnan(found.ball_temperature[3]).all()
    assert (found.speed_limit > speed[2]).all()
    assert (found.speed_limit < speed[3]).all()
    soft = replace(spec, heat_flow=replace(FLOW, mounting="spring"))
    cool = solve(VEX70, Conditions(), speed[:3], soft)
    assert (cool.ball_temperature[1:] < found.ball_temperature[1:3]).all()
    assert cool.axial_force == pytest.approx(np.broadcast_to([300.0, 610.0], (3, 2)))
    assert np.isnan(cool.speed_limit).all()


def test_heat_that_cannot_leave_is_refused() -> None:
    with pytest.raises(InvalidInput, match="heat must leave the bearing"):
        replace(FLOW, inner_shaft=0.0, outer_housing=0.0, balls_oil=0.0)


def test_what_numbers_of_contacts_mean_is_above_their_curves() -> None:
    spec = BearingMapSpec(radial_loads=(-3e3, 0.0, 6e3), axial_load=-5e3)
    found = solve(four_point(QJ218), Conditions(), np.array([0.0, 6000.0]) * RPM, spec)
    figure = contacts_figure(found)
    figure.canvas.draw()
    axes = figure.axes[3]
    box = axes.get_legend().get_window_extent().transformed(axes.transData.inverted())
    assert max(line.get_ydata().max() for line in axes.lines) == 15.0
    assert 15.0 < box.y0 < box.y1 < axes.get_ylim()[1]
