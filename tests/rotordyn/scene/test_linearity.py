"""Loads of bearings beside those of their tangents, in linear analyses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from bearings.ring.request import solved
from rotordyn.analyses import Lubrication
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.analyses.section_forces.solve import solve as statics
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.section_forces.summary import warnings as static_warnings
from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.analyses.unbalance.runs import _departure
from rotordyn.analyses.unbalance.solve import solve as orbits
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.summary import warnings as orbit_warnings
from rotordyn.equation.seat import HALF_TURN_ABOUT_Y
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.growth import static_growth
from rotordyn.scene.linearity import REPORTED, departure, tangent_warnings
from rotordyn.scene.loads import PointLoad, Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import RPM, conditions, mfw2310

SPEED = 12000.0 * RPM


def under(force: float, axial: float = 0.0) -> SectionForcesResult:
    """The flagship under forces at its nose."""
    scene = Scene(mfw2310(), conditions(), np.array([0.0, SPEED]))
    return statics(scene, SectionForcesSpec(loads=(PointLoad("nose_face", Fx=axial, Fy=force),)))


def whirling(unbalance: float) -> UnbalanceResult:
    """The same with an unbalance there."""
    scene = Scene(mfw2310(), conditions(), np.array([0.5, 1.0]) * SPEED, 2000.0)
    return orbits(scene, UnbalanceSpec(("nose_face",), (Unbalance("nose_face", unbalance),)))


def test_the_departure_is_that_of_each_bearing_alone() -> None:
    machine, given = mfw2310(), conditions()
    scene, found = Scene(machine, given, np.array([SPEED])), under(3000.0, -1000.0)
    still = statics(scene, SectionForcesSpec(loads=(PointLoad("nose_face", Fy=1e-3),)))
    for k, (seat, (balls, column)) in enumerate(
        zip(machine.seats, scene.preload.seat_states(), strict=True)
    ):
        turn = HALF_TURN_ABOUT_Y if seat.thrust < 0 else np.ones(5)
        parts = [0, 1, 2, 4, 5]
        added = -turn * (found.reaction[1, k] - still.reaction[0, k])[parts]
        tangent = balls.complete_stiffness[0, column]
        there = balls.displacement[0, column] + np.linalg.solve(tangent, added)
        law = seat.bearing.equilibrium(
            displacement=there,
            speed=SPEED,
            kinematics=given.kinematics,
            moment_sharing=given.moment_sharing,
            static_growth=static_growth(machine, seat),
            growth=float(scene.preload.seat_growth()[0, k]),
        )
        lever = np.array([1.0, 1.0, 1.0, *[2.0 / seat.bearing.pitch_diameter] * 2])
        miss = np.linalg.norm(lever * (law.load - balls.load[0, column] - added))
        share = miss / np.linalg.norm(lever * added)
        assert found.departure[1, k] == pytest.approx(share, rel=1e-3)


def test_it_falls_with_the_load() -> None:
    """The law has a second derivative: half the load, half the departure."""
    most = [np.nanmax(under(force).departure[1]) for force in (50.0, 100.0)]
    assert most[1] / most[0] == pytest.approx(2.0, rel=0.05)
    turned = [np.nanmax(whirling(size).departure[1]) for size in (2e-6, 4e-6)]
    assert turned[1] / turned[0] == pytest.approx(2.0, rel=0.05)


def test_loads_beyond_the_tangents_are_reported() -> None:
    assert not static_warnings(under(100.0))
    assert not [each for each in orbit_warnings(whirling(2e-6)) if "displaced so far" in each]
    (said,) = static_warnings(under(8000.0))
    assert said.startswith("section_forces: bearings are displaced so far")
    assert "a by " in said
    (said,) = [each for each in orbit_warnings(whirling(2e-3)) if "displaced so far" in each]
    assert "rpm: a by" in said


LIFTED, CRUSHED = np.array([-1.7e-3, 1.24e-3, -0.11e-3, 4.67e-3, 17.0e-3]), np.eye(5)[0] * 5e-3


@pytest.mark.parametrize(
    ("aside", "outcome"), [(LIFTED, "no equilibrium"), (CRUSHED, "overloaded")]
)
@pytest.mark.parametrize("harmonic", [False, True])
def test_rings_without_a_state_depart_by_any_share(
    aside: NDArray[np.float64], outcome: str, harmonic: bool
) -> None:
    """In whichever phase of the motion; other phases do not hide it."""
    scene = Scene(mfw2310(), conditions(), np.array([SPEED]))
    balls, column = scene.preload.seat_states()[0]
    preload = balls.rows(np.ix_([0], [column]))
    displaced = solved(preload.operation.at(preload.displacement[:, :, None] + aside))
    assert displaced.outcome == outcome
    moved = np.zeros((1, len(scene.spindle.seats), 5), complex if harmonic else float)
    moved[0, 0] = aside
    apart = departure(scene, moved)
    assert apart[0, 0] == np.inf
    assert (apart[0, 1:] == 0.0).all()
    (warning,) = tangent_warnings("unbalance", ("a", *"bcde"), scene.speed, apart)
    assert "first at 12000 rpm: a is overloaded or has no equilibrium" in warning


def test_a_bearing_without_load_that_comes_under_load_is_reported() -> None:
    """A pull unloads the front bearings; a force on the nose then presses the shaft into them."""
    scene = Scene(mfw2310(), conditions(axial_force=-2500.0), np.array([0.0]))
    assert (scene.shaft_force.push[0, :2] == 0.0).all()
    light, heavy = (
        statics(scene, SectionForcesSpec(loads=(PointLoad("nose_face", Fy=force),)))
        for force in (1000.0, 3000.0)
    )
    assert (light.departure[0, :2] == 0.0).all()
    assert not heavy.reaction[0, :2, 1].any()
    assert (heavy.departure[0, :2] == np.inf).all()
    assert (heavy.departure[0, 2:] < REPORTED).all()
    (said,) = static_warnings(heavy)
    assert "a is overloaded or has no equilibrium, or comes under load" in said


def test_beside_films_nothing_is_compared() -> None:
    oil = Lubrication(32e-6, 5.4e-6, 50.0)
    films = Scene(mfw2310(), conditions(films=oil), np.array([SPEED]))
    found = statics(films, SectionForcesSpec(loads=(PointLoad("nose_face", Fy=8000.0),)))
    assert np.isnan(found.departure).all()
    assert not static_warnings(found)


def test_a_resonance_between_the_speeds_of_the_case_is_reported() -> None:
    """There it is that of the peak alone, and the same on a slow run past it."""
    machine = mfw2310()
    body, points = PointMass("rotor", 0.25, 40.0, 0.04, 0.04), machine.points | {"middle": 0.25}
    machine = replace(machine, masses=(*machine.masses, body), points=points)
    spec = UnbalanceSpec(("middle",), (Unbalance("middle", 4e-5),))
    found = orbits(
        Scene(machine, conditions(), np.array([9000.0, 21000.0]) * RPM, 2000.0),
        replace(spec, run_down=(30.0,)),
    )
    seats = len(machine.seats)
    assert np.nanmax(found.departure) < 0.8 * REPORTED
    np.testing.assert_allclose(found.fine_departure[[0, -1]], found.departure, rtol=1e-6)
    peak = orbits(Scene(machine, conditions(), found.peak_speed[0, :1], 2000.0), spec)
    there = found.fine_speed == found.peak_speed[0, 0]
    assert found.fine_departure[there, :seats] == pytest.approx(peak.departure[:, :seats], rel=1e-3)
    assert found.run_departure[0, :seats] == pytest.approx(peak.departure[0, :seats], rel=0.03)
    assert np.nanmax(peak.departure) > 2.0 * REPORTED
    steady, run = (each for each in orbit_warnings(found) if "displaced so far" in each)
    worst = 100.0 * np.nanmax(found.fine_departure, axis=0)
    assert f"e by {worst[seats - 1]:.0f} %" in steady
    at = np.sort(found.run_force_peak_speed[0, :seats])[[0, -1]] / RPM
    where = f"on the run down in 30 s, from about {at[0]:.0f} to {at[1]:.0f} rpm: bearings are"
    assert run.startswith(f"unbalance: at the largest forces of bearings {where}")
    assert "first at" not in run


@pytest.mark.parametrize("ratio", [2.0, -2.0])
def test_a_further_rotor_out_of_balance_moves_rings_at_its_own_speed(ratio: float) -> None:
    """Loads depart most where the shaft moves most: at half the speed of its resonance."""
    machine = mfw2310()
    body, points = PointMass("rotor", 0.25, 40.0, 0.04, 0.04), machine.points | {"middle": 0.25}
    quill = Shaft(0.2, (Section(0.1, 0.02, 0.0, machine.shaft.sections[0].material),))
    stiff = {("y", "y"): 1e9, ("z", "z"): 1e9}
    holds = tuple(
        LinearSupport(name, x, stiff, {}, holds="quill", against="spindle")
        for name, x in (("one", 0.21), ("other", 0.29))
    )
    machine = replace(
        machine,
        masses=(*machine.masses, body),
        points=points,
        rotors=(Rotor("quill", ratio, quill, points={"end": 0.3}),),
        supports=(
            *machine.supports,
            *holds,
            LinearSupport("along", 0.25, {("x", "x"): 1e8}, {}, holds="quill", against="ground"),
        ),
    )
    spec = UnbalanceSpec(("middle",), (Unbalance("quill.end", 1e-5),))
    found = orbits(Scene(machine, conditions(), np.linspace(4e3, 12e3, 3) * RPM, 2000.0), spec)
    moved, apart = found.fine_major_axis[:, 0], np.nanmax(found.fine_departure, axis=1)
    assert moved.max() > 3.0 * moved[[0, -1]].max()
    resonance, most = found.fine_speed[moved.argmax()], found.fine_speed[apart.argmax()]
    assert most == pytest.approx(resonance, rel=0.01)


def test_on_a_run_down_each_motion_is_compared_at_its_own_speed() -> None:
    """Forces of one bearing are largest at the first instant, of all others at the last one."""
    machine, seats = mfw2310(), len(mfw2310().seats)
    speed = np.array([20000.0, 12000.0, 4000.0]) * RPM
    force = np.array([3.0, 2.0, 1.0])[:, None] * np.ones(seats)
    force[:, 1:] = force[::-1, 1:]
    rings = np.array([2e-6, 0.0, 4e-6])[:, None, None] * np.ones((3, seats, 5), dtype=complex)
    scene = Scene(machine, conditions(), np.sort(speed))
    single = [departure(scene.at(speed[[k]]), rings[[k]])[0] for k in (0, 2)]
    found = _departure(scene, speed, force, rings)
    np.testing.assert_allclose(found, np.maximum(*single), rtol=1e-9)
