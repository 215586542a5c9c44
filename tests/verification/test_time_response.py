"""Motion over time: against integration of other equations, steady responses, static states."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from bearings import AngularContactBallBearing
from rotordyn.analyses.bearing_loads.solve import answer as loads_answer
from rotordyn.analyses.bearing_loads.spec import BearingLoadsSpec
from rotordyn.analyses.frf.solve import answer as frf_answer
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.forces import applied, marked, sizes
from rotordyn.analyses.time_response.march import march
from rotordyn.analyses.time_response.remainder import Remainder
from rotordyn.analyses.time_response.solve import answer
from rotordyn.analyses.time_response.spec import ForceOverTime, TimeResponseSpec
from rotordyn.analyses.time_response.summary import warnings
from rotordyn.analyses.unbalance.solve import answer as unbalance_answer
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad, Unbalance
from rotordyn.scene.scene import Scene
from rotordyn.scene.spec import Setting
from tests.oracles.rotors import STEEL, STEPPED, support
from tests.oracles.spindles import RPM, pairs

Array = NDArray[np.float64]
BEARING = AngularContactBallBearing(
    ball_diameter=8e-3,
    pitch_diameter=45e-3,
    balls=16,
    contact_angle=math.radians(20.0),
    inner_conformity=0.53,
    outer_conformity=0.52,
)
OUTER = {"kinematics": "outer"}
ALONE = {**OUTER, "axial_stiffening": False}  # no force along the shaft stiffens it


def short(
    damping: float = 300.0, spring: Spring | None = None, travel: float = math.inf
) -> Spindle:
    """A short shaft on two bearings in O, the rear one preloaded by 300 N."""
    seats = [
        BearingSeat(name, BEARING, x, thrust, radial_damping=damping, axial_damping=damping)
        for name, x, thrust in (("front", 0.03, 1), ("rear", 0.10, -1))
    ]
    return Spindle(
        "short",
        Shaft(0.0, (Section(0.12, 0.03, 0.0, STEEL),)),
        seats=tuple(seats),
        sleeves=(Sleeve("rear", ("rear",), spring or Spring(300.0, math.inf), travel, mass=0.2),),
        points={"nose": 0.0, "end": 0.12},
    )


def push(force: float | None, **how: Any) -> ForceOverTime:
    return ForceOverTime(**{"at": "nose", "direction": "y", "force": force, **how})


def seen(spindle: Spindle, spec: TimeResponseSpec, rpm: float, **given: Any) -> Scene:
    ports = tuple({spindle.place(at) for at in spec.places})
    speeds = np.atleast_1d(rpm) * RPM
    return Scene(spindle, Conditions(**given), speeds, spec.max_frequency, ports)


# --- other equations ------------------------------------------------------------------------------


def rigid_motion(scene: Scene, force: ForceOverTime, time: Array) -> Array:
    """(x, y, z, θy, θz) of the centre of gravity (t, 5): Newton's and Euler's equations of a rigid
    body, each bearing asked for its load where its ring is; ``force`` along y at x = 0."""
    spindle, speed = scene.spindle, float(scene.speed[0])
    body = rotor_inertia(spindle)
    begun = [balls.displacement[0, at] for balls, at in scene.preload.seat_states()]

    def rate(t: float, state: Array) -> Array:
        q, v = state[:5], state[5:]
        f = np.zeros(5)
        for seat, still in zip(spindle.seats, begun, strict=True):
            lever, side = seat.x - body.centre, float(seat.thrust)
            turn = np.array([side, 1.0, side, 1.0, side])
            at, moving = (
                np.array([u[0], u[1] + lever * u[4], u[2] - lever * u[3], u[3], u[4]])
                for u in (q, v)
            )
            there = seat.bearing.equilibrium(displacement=still + turn * at, speed=speed, **OUTER)
            carried = turn * there.load
            carried[:3] += seat.radial_damping * moving[:3]
            f -= carried
            f[3:] -= np.array([-lever * carried[2], lever * carried[1]])
        sideways = float(sizes(force, np.array(t)))
        f += [0.0, sideways, 0.0, 0.0, -body.centre * sideways]
        gyroscopic = body.polar * speed * np.array([v[4], -v[3]])
        return np.concatenate([v, f[:3] / body.mass, (f[3:] - gyroscopic) / body.diametral])

    found = solve_ivp(rate, (0.0, time[-1]), np.zeros(10), "DOP853", time, rtol=1e-7, atol=1e-12)
    return np.asarray(found.y[:5].T)


@pytest.mark.parametrize("rpm", [0.0, 30000.0])
def test_a_rigid_rotor_moves_as_newtons_and_eulers_equations_say(rpm: float) -> None:
    """A blow of 3 kN, ten times the preload: balls of both bearings lose their contact."""
    blow = push(3000.0, pulse=4e-4)
    spec = TimeResponseSpec(7e-4, 8000.0, ("nose", "end"), (blow,))
    scene = seen(short(), spec, rpm, rotor="rigid", accuracy=1e-7, **ALONE)
    found = answer(scene, spec)
    other = rigid_motion(scene, blow, found.time)
    centre = rotor_inertia(scene.spindle).centre
    for k, x in enumerate((0.0, 0.12)):
        lever = x - centre
        turned = np.stack([0.0 * found.time, lever * other[:, 4], -lever * other[:, 3]], axis=1)
        wanted = other[:, :3] + turned
        apart = np.abs(found.displacement[0, :, k] - wanted).max()
        assert apart < 1e-5 * np.abs(wanted).max()
        linear = np.abs(found.linear_displacement[0, :, k] - wanted).max()
        assert linear > 0.2 * np.abs(wanted).max()
    assert (found.peak_idle[0] > 0).any()


def test_the_error_falls_with_the_fourth_power_of_the_step() -> None:
    spec = TimeResponseSpec(2e-3, 4000.0, ("nose",), (push(900.0, frequency=700.0),))
    scene = seen(short(), spec, 20000.0, **OUTER)
    equation, bearings = Equation.of(scene, spec), Remainder.of(scene)

    def path(count: int) -> Array:
        force = partial(applied, spec, np.zeros((1, 0)))
        moved = march(equation, force, spec.duration / count, count, bearings).watched[0, :, :3]
        return moved[:: 2 * count // 40]

    paths = [path(count) for count in (40, 80, 160, 320)]
    errors = [np.abs(one - other).max() for one, other in pairwise(paths)]
    for coarse, fine in pairwise(errors):
        assert 12.0 < coarse / fine < 20.0


# --- steady responses -----------------------------------------------------------------------------

SUPPORTED = replace(
    STEPPED,
    supports=(
        support("front", 0.0, (8e7, 5e7, 6e6), 6000.0),
        support("rear", 0.2, (6e7, 4e7), 5000.0),
    ),
)


def test_a_sinusoidal_force_ends_in_the_receptance() -> None:
    hertz, late = 340.0, 0.11
    forces = (ForceOverTime("tip", "y", force=50.0, frequency=hertz, phase=0.5 * math.pi),)
    spec = TimeResponseSpec(late + 1.0 / hertz, 2500.0, ("tip", "nose"), forces)
    found = answer(seen(SUPPORTED, spec, 15000.0, accuracy=1e-7), spec)
    asked = pairs("tip.y/tip.y", "tip.z/tip.y", "nose.y/tip.y", "nose.z/tip.y")
    response = frf_answer(
        seen(SUPPORTED, spec, 15000.0, accuracy=1e-7), FrfSpec((hertz, 2500.0), asked)
    ).receptance[0, :, 0]
    time = found.time[found.time > late]
    steady = (50.0 * response * np.exp(2j * math.pi * hertz * time)[:, None]).real
    moved = found.displacement[0, found.time > late][..., 1:].reshape(len(time), 4)
    assert np.abs(moved - steady).max() < 1e-5 * np.abs(steady).max()


def test_an_unbalance_ends_in_the_steady_orbit() -> None:
    acting = (Unbalance("tip", 2e-4, 0.3), Unbalance(0.2, 1e-4, -1.0))
    spec = TimeResponseSpec(0.12, 2500.0, ("tip",), unbalances=acting)
    spindle = marked(SUPPORTED, spec)
    found = answer(seen(spindle, spec, 15000.0, accuracy=1e-7), spec)
    orbit = unbalance_answer(
        seen(spindle, spec, 15000.0, accuracy=1e-7), UnbalanceSpec(("tip",), acting)
    ).displacement[0, 0]
    time = found.time[found.time > 0.11]
    steady = (orbit * np.exp(1j * found.speed[0] * time)[:, None]).real
    moved = found.displacement[0, found.time > 0.11][:, 0, 1:]
    assert np.abs(moved - steady).max() < 1e-5 * np.abs(steady).max()


def test_bearings_under_small_forces_are_linear() -> None:
    spec = TimeResponseSpec(2e-3, 3000.0, ("nose",), (push(1e-2, pulse=4e-4),))
    found = answer(seen(short(), spec, 20000.0, **OUTER), spec)
    apart = np.abs(found.displacement - found.linear_displacement).max()
    assert apart < 1e-5 * found.largest[0, 0]


# --- static states --------------------------------------------------------------------------------

SLOW = (0.0, 4e-3, 0.02)


@pytest.mark.parametrize(("rotor", "apart"), [("rigid", 1e-9), ("flexible", 3e-3)])
def test_a_force_that_grows_slowly_ends_in_the_state_under_it(rotor: str, apart: float) -> None:
    """800 N across the axis at the nose, 20 000 rpm: loads of both bearings, of the static solver
    that knows no time, nor that a flexible shaft gives way along its axis."""
    spindle = short(damping=3000.0)
    ramp = push(None, times=SLOW, forces=(0.0, 800.0, 800.0))
    spec = TimeResponseSpec(0.016, 1000.0, ("nose",), (ramp,))
    found = answer(seen(spindle, spec, 20000.0, rotor=rotor, **ALONE), spec)
    load = (PointLoad("nose", Fy=800.0),)
    under = seen(spindle, spec, 20000.0, rotor=rotor, loads=load, **ALONE)
    static, last = loads_answer(under, BearingLoadsSpec(loss_steps=0)), found.bearing_load[0, -1]
    assert np.hypot(last[:, 1], last[:, 2]) == pytest.approx(static.radial_load[0], rel=apart)
    assert last[:, 0] == pytest.approx(static.axial_load[0], rel=apart)


def test_the_gap_of_a_stop_is_that_of_the_state_under_the_force() -> None:
    """200 N along the axis on a spring of 5 N/µm, slowly: the sleeve ends where the axial state
    has it, and beyond a closer stop that is told."""
    for travel, told in ((60e-6, False), (1e-6, True)):
        spindle = short(6000.0, Spring(300.0, 5e6), travel)
        slow = push(-200.0, direction="x", pulse=0.1)
        spec = TimeResponseSpec(0.1, 1000.0, ("nose",), (slow,))
        found = answer(seen(spindle, spec, 0.0, rotor="rigid", **OUTER), spec)
        pushed = seen(spindle, spec, 0.0, axial_force=-200.0, **OUTER)
        gap = pushed.preload.stop_gaps()[0, 0]
        if not told:
            assert gap < 58e-6
            assert found.stop_gap[0, 0] == pytest.approx(gap, rel=1e-4)
        sentences = [one for one in warnings(found) if "end stop" in one]
        assert len(sentences) == int(told)


# --- what is given --------------------------------------------------------------------------------


def test_the_shapes_of_a_force() -> None:
    time = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0])

    def at(**how: Any) -> list[float]:
        return sizes(push(**{"force": 2.0, **how}), time).round(12).tolist()

    assert at() == [2.0] * 8
    assert at(start=1.0, end=2.5) == [0, 0, 2, 2, 2, 2, 0, 0]
    assert at(frequency=0.5, start=1.0) == [0, 0, 0, 2, 0, -2, 0, 0]
    assert at(frequency=0.5, phase=0.5 * math.pi)[:3] == [2, 0, -2]
    assert at(pulse=1.0) == [0, 2, 0, 0, 0, 0, 0, 0]
    assert at(pulse=1.0, period=2.0, end=3.0) == [0, 2, 0, 0, 0, 2, 0, 0]
    table = {"force": None, "times": (1.0, 2.0, 3.0), "forces": (0.0, 4.0, 2.0)}
    assert at(**table) == [0, 0, 0, 2, 4, 3, 2, 0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"force": None}, "given neither"),
        ({"times": (0.0, 1.0), "forces": (0.0, 1.0)}, "given both"),
        ({"frequency": 1.0, "pulse": 1.0}, "one shape"),
        ({"phase": 1.0}, "only a sinusoidal force"),
        ({"period": 1.0}, "only half sines are repeated"),
        ({"pulse": 2.0, "period": 1.0}, "shorter than the pulse"),
        ({"start": 2.0, "end": 1.0}, "not after the start"),
        ({"force": None, "times": (0.0, 1.0), "forces": (1.0,)}, "not as many"),
        ({"force": None, "times": (1.0, 0.0), "forces": (1.0, 2.0)}, "not in ascending order"),
        ({"direction": "thy"}, "allowed: x, y, z"),
    ],
)
def test_a_force_that_contradicts_itself_is_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        push(**{"force": 1.0, **given})


def test_what_a_machine_contradicts_is_refused() -> None:
    spec = TimeResponseSpec(1e-3, 1000.0, ("nose",), (push(1.0),))

    def said(spindle: Spindle, asked: TimeResponseSpec = spec, **given: Any) -> str:
        setting = Setting(spindle, Conditions(**given), (0.0,))
        return "; ".join(sentence for _, sentence in asked.faults_on(setting))

    assert said(short()) == ""
    assert "fixed frame" in said(short(), formulation="rotating")
    assert "loss factor" in said(replace(short(), loss_factor=0.01))
    assert "tip" in said(short(), replace(spec, points=("tip",)))
    assert "tip" in said(short(), replace(spec, forces=(push(1.0, at="tip"),)))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"forces": ()}, "nothing acts"),
        ({"duration": 900.0, "max_frequency": 1e5}, "instants"),
        ({"forces": (push(1.0, frequency=2000.0),)}, "above max_frequency"),
        ({"forces": (push(1.0, start=0.5),)}, "not within the duration"),
    ],
)
def test_a_question_that_contradicts_itself_is_refused(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        TimeResponseSpec(
            **{
                "duration": 1e-3,
                "max_frequency": 1000.0,
                "points": ("nose",),
                "forces": (push(1.0),),
                **changes,
            }
        )
