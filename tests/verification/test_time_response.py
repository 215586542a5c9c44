"""Motion over time: against integration of other equations, steady responses, static states."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from bearings import AngularContactBallBearing
from rotordyn.analyses.bearing_loads.solve import solve as loads_answer
from rotordyn.analyses.bearing_loads.spec import BearingLoadsSpec
from rotordyn.analyses.frf.solve import solve as frf_answer
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.forces import impulse, marked, mean_inputs, values
from rotordyn.analyses.time_response.march import Step, _nodal_inputs, march
from rotordyn.analyses.time_response.nonlinear import Nonlinear
from rotordyn.analyses.time_response.peaks import longest
from rotordyn.analyses.time_response.solve import _steady_start
from rotordyn.analyses.time_response.solve import solve as solve_time_response
from rotordyn.analyses.time_response.spec import ForceOverTime, TimeResponseSpec
from rotordyn.analyses.time_response.summary import accuracy, summary, warnings
from rotordyn.analyses.unbalance.solve import solve as unbalance_answer
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unlimited import unlimited
from rotordyn.errors import InvalidInput
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad, Unbalance
from rotordyn.scene.scene import Scene
from rotordyn.scene.spec import Setting
from tests.oracles.coaxial import COAXIAL, OUTER
from tests.oracles.rotors import STEEL, STEPPED, support, uniform
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
CONTROL = {"kinematics": "outer"}
ALONE = {**CONTROL, "axial_stiffening": False}  # no force along the shaft stiffens it


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
    body, each bearing solved for its load at its ring; ``force`` along y at x = 0."""
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
            there = seat.bearing.equilibrium(displacement=still + turn * at, speed=speed, **CONTROL)
            carried = turn * there.load
            carried[:3] += seat.radial_damping * moving[:3]
            f -= carried
            f[3:] -= np.array([-lever * carried[2], lever * carried[1]])
        sideways = float(values(force, np.array(t)))
        f += [0.0, sideways, 0.0, 0.0, -body.centre * sideways]
        gyroscopic = body.polar * speed * np.array([v[4], -v[3]])
        return np.concatenate([v, f[:3] / body.mass, (f[3:] - gyroscopic) / body.diametral])

    found = solve_ivp(rate, (0.0, time[-1]), np.zeros(10), "DOP853", time, rtol=1e-7, atol=1e-12)
    return np.asarray(found.y[:5].T)


@pytest.mark.few(1)
@pytest.mark.parametrize("rpm", [pytest.param(30000.0, marks=pytest.mark.long), 0.0])
def test_a_rigid_rotor_moves_as_newtons_and_eulers_equations_say(rpm: float) -> None:
    """A blow of 3 kN, ten times the preload: balls of both bearings lose their contact."""
    blow = push(3000.0, pulse=4e-4)
    spec = TimeResponseSpec(7e-4, 8000.0, ("nose", "end"), (blow,))
    scene = seen(short(), spec, rpm, rotor="rigid", accuracy=1e-7, **ALONE)
    found = solve_time_response(scene, spec)
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


@pytest.mark.parametrize(("force", "least"), [(900.0, 7.0), (3000.0, 3.5)])
def test_the_error_falls_nearly_with_the_fourth_power_of_the_step(
    force: float, least: float
) -> None:
    """16 for each halving while the law is smooth and steps resolve the modes; less where balls
    lose their contact (3 kN), of which the law has no third derivative."""
    spec = TimeResponseSpec(2e-3, 4000.0, ("nose",), (push(force, frequency=700.0),))
    scene = seen(short(), spec, 20000.0, **CONTROL)
    equation = Equation.of(scene, spec)
    nonlinear = Nonlinear.of(scene, equation)

    def path(count: int) -> Array:
        inputs, still = partial(mean_inputs, spec, equation.speed), 0.0 * equation.damping[:, 0]
        length = spec.duration / count
        moved = march(equation, inputs, length, count, (still, still), nonlinear).points[0]
        return moved[:: 2 * count // 40]

    paths = [path(count) for count in (40, 80, 160, 320, 640)]
    errors = [np.abs(one - other).max() for one, other in pairwise(paths)]
    for coarse, fine in pairwise(errors):
        assert least < coarse / fine < 25.0
    assert (errors[0] / errors[-1]) ** (1 / 3) > 1.3 * least


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
    found = solve_time_response(seen(SUPPORTED, spec, 15000.0, accuracy=1e-7), spec)
    asked = pairs("tip.y/tip.y", "tip.z/tip.y", "nose.y/tip.y", "nose.z/tip.y")
    response = frf_answer(
        seen(SUPPORTED, spec, 15000.0, accuracy=1e-7), FrfSpec((hertz, 2500.0), asked)
    ).receptance[0, :, 0]
    time = found.time[found.time > late]
    steady = (50.0 * response * np.exp(2j * math.pi * hertz * time)[:, None]).real
    moved = found.displacement[0, found.time > late][..., 1:].reshape(len(time), 4)
    assert np.abs(moved - steady).max() < 1e-5 * np.abs(steady).max()


@pytest.mark.parametrize("against", [False, True])
def test_unbalance_alone_is_the_steady_orbit_from_the_beginning(*, against: bool) -> None:
    """On the spindle, and on a rotor that turns against it."""
    rotors = (replace(OUTER, speed_ratio=-1.0),)
    spindle = replace(COAXIAL, rotors=rotors) if against else SUPPORTED
    at = "outer.d2" if against else "tip"
    acting = (Unbalance(at, 2e-4, 0.3), Unbalance(at if against else 0.2, 1e-4, -1.0))
    spec = TimeResponseSpec(0.02, 2500.0, (at,), unbalances=acting)
    spindle = marked(spindle, spec)
    found = solve_time_response(seen(spindle, spec, 15000.0, accuracy=1e-7), spec)
    orbit = unbalance_answer(
        seen(spindle, spec, 15000.0, accuracy=1e-7), UnbalanceSpec((at,), acting)
    )
    turned = np.exp(1j * abs(orbit.speed_ratio) * found.speed[0] * found.time)
    steady = (orbit.displacement[0, 0] * turned[:, None]).real
    moved = found.displacement[0, :, 0, 1:]
    assert np.abs(moved - steady).max() < 1e-5 * np.abs(steady).max()


def hung(stiffness: float, damping: float = 0.0) -> Spindle:
    """A rigid cylinder on two alike supports, of ``stiffness`` and ``damping`` together."""
    each = (0.5 * stiffness, 0.5 * stiffness), 0.5 * damping
    supports = [support(name, x, *each) for name, x in (("A", 0.1), ("B", 0.3))]
    return replace(uniform(0.4, 0.06, supports=supports), points={"middle": 0.2})


@pytest.mark.parametrize("damping", [20.0, 0.0])
def test_an_orbit_wider_than_any_machine_is_no_answer(damping: float) -> None:
    """At a critical speed it is U Ω / c, of which only one up to 0.1 m is followed."""
    stiffness = 8e5
    machine = hung(stiffness, damping)
    omega = math.sqrt(stiffness / rotor_inertia(machine).mass)
    known = 0.09 * damping / omega, 0.11 * damping / omega + 1e-5 * (damping == 0.0)

    def found(size: float, *speeds: float) -> Any:
        spec = TimeResponseSpec(0.05, 200.0, ("middle",), unbalances=(Unbalance("middle", size),))
        return solve_time_response(seen(machine, spec, np.array(speeds) / RPM, rotor="rigid"), spec)

    wide = found(known[1], 0.5 * omega, omega)
    assert wide.outcome[0] == ""
    assert "steady orbit, on which time_response begins, exceeds 100 mm" in wide.outcome[1]
    assert np.isnan([wide.largest[1, 0], wide.largest_time[1, 0], wide.ended[1]]).all()
    assert np.isnan(wide.displacement[1]).all()
    assert not any(wide.ending)
    assert not [*warnings(wide)]
    alone = found(known[1], omega)
    assert not [*summary(alone), *accuracy(alone), *warnings(alone)]
    if damping:
        near = found(known[0], omega)
        assert near.largest[0, 0] == pytest.approx(0.09, rel=1e-6)
        assert near.ended[0] == near.time[-1]


def test_an_orbit_that_no_solver_finds_is_not_one_at_rest() -> None:
    """Where Ω² is the stiffness over the mass to the last digit."""
    spec = TimeResponseSpec(0.05, 200.0, ("middle",), unbalances=(Unbalance("middle", 1e-5),))
    equation: Any = SimpleNamespace(
        stiffness=np.full((2, 1, 1), 4.0),
        damping=np.zeros((2, 1, 1)),
        speed=np.array([[2.0], [1.0]]),
        inputs=np.ones((1, len(spec.ports))),
    )
    displacement, velocity = _steady_start(spec, equation)
    assert np.isinf([displacement[0], velocity[0]]).all()
    assert np.isfinite([displacement[1], velocity[1]]).all()


def test_what_nothing_holds_moves_evenly_and_is_not_called_unstable() -> None:
    """F t₁ (t − t₁/2) / m after a push, up to 0.1 m."""
    machine, force, pushed = hung(1e-15), 240.0, 0.05
    mass = rotor_inertia(machine).mass
    acting = ForceOverTime("middle", "y", force=force, end=pushed)
    spec = TimeResponseSpec(0.12, 200.0, ("middle",), (acting,))
    found = solve_time_response(seen(machine, spec, 0.0, rotor="rigid"), spec)
    reached = 0.1 * mass / (force * pushed) + 0.5 * pushed
    assert found.ended[0] == pytest.approx(reached, abs=found.time[1])
    after = (found.time > pushed) & (found.time < found.ended[0])
    even = force * pushed / mass * (found.time[after] - 0.5 * pushed)
    assert found.displacement[0, after, 0, 1] == pytest.approx(even, rel=1e-9)
    (told,) = warnings(found)
    assert "after which it moves farther than 100 mm" in told
    assert "the supports of the machine" in told


def test_bearings_under_small_forces_are_linear() -> None:
    spec = TimeResponseSpec(2e-3, 3000.0, ("nose",), (push(1e-2, pulse=4e-4),))
    found = solve_time_response(seen(short(), spec, 20000.0, **CONTROL), spec)
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
    found = solve_time_response(seen(spindle, spec, 20000.0, rotor=rotor, **ALONE), spec)
    load = (PointLoad("nose", Fy=800.0),)
    under = seen(spindle, spec, 20000.0, rotor=rotor, loads=load, **ALONE)
    static, last = loads_answer(under, BearingLoadsSpec(loss_steps=0)), found.bearing_load[0, -1]
    assert np.hypot(last[:, 1], last[:, 2]) == pytest.approx(static.radial_load[0], rel=apart)
    assert last[:, 0] == pytest.approx(static.axial_load[0], rel=apart)


def test_the_gap_of_a_stop_is_that_of_the_state_under_the_force() -> None:
    """200 N along the axis on a spring of 5 N/µm, slowly: the sleeve ends where the axial state
    has it, and beyond a closer stop that is reported."""
    for travel, told in ((60e-6, False), (1e-6, True)):
        spindle = short(6000.0, Spring(300.0, 5e6), travel)
        slow = push(-200.0, direction="x", pulse=0.1)
        spec = TimeResponseSpec(0.1, 1000.0, ("nose",), (slow,))
        found = solve_time_response(seen(spindle, spec, 0.0, rotor="rigid", **CONTROL), spec)
        pushed = seen(spindle, spec, 0.0, axial_force=-200.0, **CONTROL)
        gap = pushed.preload.stop_gaps()[0, 0]
        if not told:
            assert gap < 58e-6
            assert found.stop_gap[0, 0] == pytest.approx(gap, rel=1e-4)
        sentences = [one for one in warnings(found) if "end stop" in one]
        assert len(sentences) == int(told)


@pytest.mark.parametrize("force", [30.0, -60.0])
def test_friction_holds_a_sleeve_as_far_as_its_limit(force: float) -> None:
    """A force along the axis, slowly, on a sleeve that 40 N of dry friction hold: all of it goes
    through the sleeve, either way."""
    sleeve = replace(short().sleeves[0], spring=Spring(300.0, 5e6), friction=40.0)
    spindle = replace(short(3000.0), sleeves=(sleeve,))
    spec = TimeResponseSpec(0.05, 1000.0, ("nose",), (push(force, direction="x", pulse=0.05),))
    scene = seen(spindle, spec, 0.0, rotor="rigid", **CONTROL)
    found = solve_time_response(scene, spec)
    front, rear = (
        balls.complete_stiffness[0, at, 0, 0] for balls, at in scene.preload.seat_states()
    )
    through = rear / (front + rear) * abs(force)
    assert abs(scene.preload.friction_force[0, 0]) < 1e-6
    assert found.holding[0, 0] == pytest.approx(through / 40.0, rel=0.03)


@pytest.mark.parametrize(
    ("rpm", "force"), [(8e3, 30.0), (8e3, -30.0), (16e3, 30.0), (20e3, 30.0), (20e3, -30.0)]
)
def test_a_force_adds_to_friction_or_relieves_it(rpm: float, force: float) -> None:
    """A sleeve on which the run-up left friction, up to its limit: under a slow force that is the
    friction of the static state with that force; what only relieves it is not warned of."""
    sleeve = replace(short().sleeves[0], spring=Spring(300.0, 5e6), friction=40.0)
    spindle = replace(short(3000.0), sleeves=(sleeve,))
    spec = TimeResponseSpec(0.05, 1000.0, ("nose",), (push(force, direction="x", pulse=0.05),))
    found = solve_time_response(seen(spindle, spec, rpm, rotor="rigid", **CONTROL), spec)
    left, under = (
        seen(spindle, spec, rpm, axial_force=each, **CONTROL).preload.friction_force[0, 0]
        for each in (0.0, force)
    )
    told = [line for line in warnings(found) if "dry friction, which holds it" in line]
    assert left > 3.0
    if abs(under) < 40.0:
        assert 40.0 * found.holding[0, 0] == pytest.approx(max(left, abs(under)), abs=1e-3)
        assert not told
    else:
        assert found.holding[0, 0] > 1.3
        assert told


@pytest.mark.parametrize("force", [30.0, -30.0])
def test_friction_of_a_mirrored_sleeve_is_relieved_alike(force: float) -> None:
    """x to 0.12 m − x: the sleeve, its spring and what the run-up left point the other way."""
    sleeve = replace(short().sleeves[0], spring=Spring(300.0, 5e6), friction=40.0)
    plain = replace(short(3000.0), sleeves=(sleeve,))
    seats = [replace(s, x=0.12 - s.x, thrust=-s.thrust) for s in plain.seats]
    turned = replace(plain, seats=tuple(reversed(seats)), points={"nose": 0.12, "end": 0.0})
    holding = []
    for spindle, given in ((plain, force), (turned, -force)):
        spec = TimeResponseSpec(0.05, 1000.0, ("nose",), (push(given, direction="x", pulse=0.05),))
        found = solve_time_response(seen(spindle, spec, 20e3, rotor="rigid", **CONTROL), spec)
        holding.append(found.holding[0, 0])
    assert holding[1] == pytest.approx(holding[0], rel=1e-3)


def test_pressures_are_those_of_the_state_under_the_force() -> None:
    spindle, slow = short(3000.0), push(800.0, pulse=0.05)
    spec = TimeResponseSpec(0.05, 1000.0, ("nose",), (slow,))
    found = solve_time_response(seen(spindle, spec, 20000.0, rotor="rigid", **ALONE), spec)
    load = (PointLoad("nose", Fy=800.0),)
    under = seen(spindle, spec, 20000.0, rotor="rigid", loads=load, **ALONE)
    for k, (balls, at) in enumerate(under.preload.seat_states()):
        largest = np.maximum(balls.inner_pressure, balls.outer_pressure)[0, at].max()
        assert found.peak_pressure[0, k] == pytest.approx(largest, rel=1e-4)


def test_balls_that_come_off_where_a_bearing_is_loaded_least_are_counted() -> None:
    spec = TimeResponseSpec(0.05, 1000.0, ("nose",), (push(-3000.0, pulse=0.05, direction="x"),))
    found = solve_time_response(seen(short(3000.0), spec, 0.0, rotor="rigid", **ALONE), spec)
    size = np.linalg.norm(found.bearing_load[0], axis=-1)
    assert size[:, 0].max() == pytest.approx(size[0, 0])  # the front is relieved,
    assert (size[:, 0] < 1e-3).any()  # all of it, while the rear carries the force
    assert found.peak_idle[0].tolist() == [BEARING.balls, 0]
    off = size[:, 0] < 1e-9 * size[0, 0]
    assert found.unloaded_time[0] == pytest.approx([off.sum() * found.time[1], 0.0])
    (said,) = (one for one in warnings(found) if "all balls" in one)
    assert "bearing front lose contact with its inner race at 0 rpm" in said
    assert f"for {found.unloaded_time[0, 0] * 1e3:.3g} ms in total" in said


# --- extremes -------------------------------------------------------------------------------------


@pytest.mark.parametrize("steps", [20, 40, 160])
def test_a_blow_of_100_kn_is_answered_with_any_step(steps: int) -> None:
    spec = TimeResponseSpec(1e-3, 4000.0, ("nose",), (push(1e5, pulse=4e-4),))
    scene = seen(short(), spec, 20000.0, **CONTROL)
    equation = Equation.of(scene, spec)
    inputs, still = partial(mean_inputs, spec, equation.speed), 0.0 * equation.damping[:, 0]
    begun, nonlinear = (still, still), Nonlinear.of(scene, equation)
    path = march(equation, inputs, 1e-3 / steps, steps, begun, nonlinear)
    assert path.ended[0] == 2 * steps + 1


@pytest.mark.parametrize("at_once", [1, 7, 25, 1000])
def test_linear_steps_together_are_those_one_by_one(
    at_once: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Against the exponential of a step and its inputs, at two speeds."""
    monkeypatch.setattr("rotordyn.analyses.time_response.march.AT_ONCE", at_once)
    spec = TimeResponseSpec(1e-3, 4000.0, ("nose",), (push(1e3, pulse=4e-4),))
    equation = Equation.of(seen(short(), spec, [0.0, 20000.0], **CONTROL), spec)
    inputs, still = partial(mean_inputs, spec, equation.speed), 0.0 * equation.damping[:, 0]
    path = march(equation, inputs, 4e-5, 25, (still, still))
    step = Step.of(
        equation.stiffness, equation.damping, equation.inputs, equation.points, length=4e-5
    )
    state = np.concatenate([still, still], axis=1)
    for k in range(25):
        given = _nodal_inputs(inputs, 4e-5, k, 1)[0]
        expected = step.seen(state, given)
        atol = 1e-12 * np.abs(path.points).max()
        np.testing.assert_allclose(path.points[:, 2 * k + 1 : 2 * k + 3], expected, 0.0, atol)
        state = step.end(state, given)


def test_pressures_beyond_what_contacts_bear_are_warned_of() -> None:
    spec = TimeResponseSpec(1e-3, 4000.0, ("nose",), (push(2e4, pulse=4e-4),))
    found = solve_time_response(seen(short(), spec, [0.0, 20000.0], **CONTROL), spec)
    sentences = [one for one in warnings(found) if "contact pressure" in one]
    assert [one.split(":")[0].split()[-1] for one in sentences] == ["front", "rear"]
    assert (found.peak_pressure > 4.2e9).all()


def test_without_checks_there_is_one_march_and_no_error() -> None:
    spec = TimeResponseSpec(1e-3, 4000.0, ("nose",), (push(500.0, pulse=4e-4),))
    scene = seen(short(), spec, 20000.0, **CONTROL)
    checked = solve_time_response(seen(short(), spec, 20000.0, **CONTROL), spec)
    scene.checks.wanted = False
    found = solve_time_response(scene, spec)
    assert np.isnan(found.error).all()
    near = 1e-3 * checked.largest[0, 0]
    assert found.displacement == pytest.approx(checked.displacement, abs=near)


# --- what is given --------------------------------------------------------------------------------


SHAPES: list[dict[str, Any]] = [
    {},
    {"start": 1.0, "end": 2.5},
    {"frequency": 0.7, "start": 0.4, "phase": 0.3},
    {"pulse": 1.1},
    {"pulse": 0.6, "period": 1.3, "end": 3.1, "start": 0.2},
    {"force": None, "times": (0.5, 2.0, 3.0), "forces": (1.0, 4.0, -2.0)},
]


@pytest.mark.parametrize("shape", SHAPES)
def test_the_impulse_of_a_force_is_its_integral(shape: dict[str, Any]) -> None:
    force, edges = push(**{"force": 2.0, **shape}), np.linspace(0.0, 4.0, 400_001)
    middles = 0.5 * (edges[1:] + edges[:-1])
    summed = np.concatenate([[0.0], np.cumsum(values(force, middles)) * (edges[1] - edges[0])])
    assert np.abs(impulse(force, edges) - summed).max() < 5e-5


def test_a_force_that_begins_within_a_step_is_as_accurate() -> None:
    """A jump off the grid of time: steps a twentieth as long do not change the motion by more than
    is reported."""
    sudden = push(100.0, at="tip", start=1.2345e-3, end=4.321e-3)
    paths, errors = [], []
    for highest in (600.0, 12000.0):
        spec = TimeResponseSpec(6e-3, highest, ("tip",), (sudden,))
        scene = Scene(SUPPORTED, Conditions(), np.array([500.0]), 600.0, (-0.05,))
        found = solve_time_response(scene, spec)
        paths.append(found.displacement[0, :, 0, 1:])
        errors.append(found.error[0])
    coarse, fine = paths[0], paths[1][:: (len(paths[1]) - 1) // (len(paths[0]) - 1)]
    assert np.abs(coarse - fine).max() < 1.5 * errors[0] * np.abs(fine).max()
    assert errors[0] < 1e-2


def test_the_shapes_of_a_force() -> None:
    time = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0])

    def at(**how: Any) -> list[float]:
        return values(push(**{"force": 2.0, **how}), time).round(12).tolist()

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
        ({"force": None, "times": (0.0, 1.0), "forces": (1.0,)}, "differ in number"),
        ({"force": None, "times": (1.0, 0.0), "forces": (1.0, 2.0)}, "not in ascending order"),
        ({"force": None, "times": (0.0, 1.0), "forces": (0.0, 1.0), "start": 0.5}, "a table of"),
        ({"direction": "thy"}, "allowed: x, y, z"),
    ],
)
def test_a_force_that_contradicts_itself_is_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        push(**{"force": 1.0, **given})


def test_what_a_machine_contradicts_is_refused() -> None:
    spec = TimeResponseSpec(1e-3, 1000.0, ("nose",), (push(1.0),))

    def said(
        spindle: Spindle, asked: TimeResponseSpec = spec, speeds: Any = (0.0,), **given: Any
    ) -> str:
        setting = Setting(spindle, Conditions(**given), speeds)
        return "; ".join(sentence for _, sentence in asked.faults_on(setting))

    assert said(short()) == ""
    assert "fixed frame" in said(short(), formulation="rotating")
    assert "loss factor" in said(replace(short(), loss_factor=0.01))
    film = SqueezeFilmDamper("film", 0.06, 0.01, 0.01, 0.05, 1e-4, 0.4)
    assert "leave spindle.dampers out" in said(replace(short(), dampers=(film,)))
    assert "tip" in said(short(), replace(spec, points=("tip",)))
    assert "tip" in said(short(), replace(spec, forces=(push(1.0, at="tip"),)))
    turning = replace(spec, unbalances=(Unbalance("nose", 1e-6),))
    closing = replace(spec, stop_stiffness=1e9)
    assert "no sleeve slides freely" in said(short(), closing)
    assert "no sleeve slides freely" in said(short(spring=Spring(300.0, 5e6)), closing)
    stopped = short(spring=Spring(300.0, 5e6), travel=1e-5)
    assert said(stopped, closing) == ""
    without = replace(stopped, sleeves=(replace(stopped.sleeves[0], mass=0.0),))
    assert "sleeve rear has no mass" in said(without, closing)
    rubbing = replace(stopped, sleeves=(replace(stopped.sleeves[0], friction=10.0),))
    assert "no sleeve slides freely" in said(rubbing, closing)
    assert "from 2000 Hz" in said(short(), turning, speeds=(0.0, 4000.0 * math.pi))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"forces": ()}, "no load acts"),
        ({"duration": 900.0, "max_frequency": 1e5}, "instants"),
        ({"forces": (push(1.0, frequency=2000.0),)}, "above max_frequency"),
        ({"forces": (push(1.0, start=0.5),)}, "begins after the end of the duration"),
        ({"forces": (push(1.0, pulse=4e-4),)}, "shorter than a half sine"),
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


@pytest.mark.parametrize("phase", np.linspace(0.0, 0.3, 7).tolist())
def test_peaks_are_those_between_instants(phase: float) -> None:
    """Of a decaying wave of 20 instants in a period, of one that only grows, of one that ends."""
    time, fine = np.linspace(0.0, 2.0, 41), np.linspace(0.0, 2.0, 200_001)
    wave, known = (np.exp(-0.3 * t) * np.sin(2.0 * np.pi * t + phase) for t in (time, fine))
    ended = np.where(np.arange(41) < 4, np.sin(2.0 * np.pi * time), np.nan)
    vectors = np.zeros((1, 41, 3, 3))
    vectors[0, :, :, 1] = -np.stack([wave, time, ended], axis=-1)
    (when,), (size,) = longest(vectors, time)
    assert size[0] == pytest.approx(known.max(), rel=2e-3)
    assert when[0] == pytest.approx(fine[known.argmax()], abs=0.004)
    assert (when[1], size[1]) == (2.0, 2.0)
    assert (when[2], size[2]) == (time[3], pytest.approx(ended[3]))


# --- end stops ------------------------------------------------------------------------------------

STOP = 3e8  # N/m


def along_the_axis(scene: Scene, force: ForceOverTime, time: Array) -> Array:
    """Displacements of shaft and sleeve along the axis (t, 2), both rigid, by Newton's equations of
    two bodies: bearings solved for their load at their rings, a spring, and a stop that only
    pushes."""
    spindle, speed, state = scene.spindle, float(scene.speed[0]), scene.preload
    sleeve, (front, rear) = spindle.sleeves[0], spindle.seats
    gap = float(state.stop_gaps()[0, 0])
    gap = gap if not state.stopped[0, 0] else -float(state.stop_force[0, 0]) / STOP
    begun = np.array([balls.displacement[0, at] for balls, at in state.seat_states()])

    def loads(front: float, rear: float) -> Array:
        there = begun + np.outer([front, rear], [1.0, 0.0, 0.0, 0.0, 0.0])
        found = BEARING.equilibrium(displacement=there, speed=speed, **CONTROL)
        return np.asarray(found.load[:, 0])

    still = loads(0.0, 0.0)
    masses = np.array([rotor_inertia(spindle).mass, sleeve.mass])

    def rate(t: float, q: Array) -> Array:
        x, u, v, w = q
        ahead, back = loads(x, u - x) - still
        ahead += front.axial_damping * v
        back += rear.axial_damping * (w - v)
        # the spring pushes the outer ring of the rear bearing, of thrust -1, towards +x
        pressed = max(-(gap + u), 0.0) - max(-gap, 0.0)
        forces = [
            float(values(force, np.array(t))) - ahead + back,
            -back - sleeve.spring.stiffness * u + STOP * pressed,
        ]
        return np.concatenate([[v, w], np.array(forces) / masses])

    how = dict(method="DOP853", rtol=1e-7, atol=1e-12, max_step=2e-5)
    found = solve_ivp(rate, (0.0, time[-1]), np.zeros(4), t_eval=time, **how)
    return np.asarray(found.y[:2].T)


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("rpm", "force", "travel"),
    [
        (30000.0, 2500.0, 2e-6),
        (0.0, -2500.0, 4e-6),
        (0.0, -6000.0, 12e-6),
        (30000.0, -2500.0, 2e-6),
    ],
)
def test_a_stop_closes_and_opens_as_newtons_equations_say(
    rpm: float, force: float, travel: float
) -> None:
    """At rest a blow closes it, and it opens again; at 30 000 rpm it is closed in the preload
    state, and a blow the other way opens it."""
    blow = push(force, direction="x", pulse=6e-4)
    spindle = short(600.0, Spring(300.0, 5e6), travel)
    spec = TimeResponseSpec(1.5e-3, 8000.0, ("nose",), (blow,), stop_stiffness=STOP)
    scene = seen(spindle, spec, rpm, rotor="rigid", accuracy=1e-4, **ALONE)
    found = solve_time_response(scene, spec)
    moved = along_the_axis(scene, blow, found.time)
    assert (found.gap[0] > 0.0).any()
    assert (found.gap[0] < 0.0).any()
    apart = np.abs(found.displacement[0, :, 0, 0] - moved[:, 0])
    assert apart.max() < 2e-4 * np.abs(moved[:, 0]).max()
    slid = found.gap[0, :, 0] - found.gap[0, 0, 0]
    assert np.abs(slid - moved[:, 1]).max() < 5e-4 * np.abs(moved[:, 1]).max()
    true = STOP * max(-float((found.gap[0, 0, 0] + moved[:, 1]).min()), 0.0)
    assert found.stop_force[0, 0] == pytest.approx(true, rel=0.02)
    assert found.stop_error[0, 0] < 0.02


def blown(force: float, travel: float, stiffness: float | None) -> Any:
    """A short shaft under a blow along its axis, 30 000 rpm."""
    blow = push(force, direction="x", pulse=6e-4)
    spec = TimeResponseSpec(1e-3, 4000.0, ("nose",), (blow,), stop_stiffness=stiffness)
    return solve_time_response(seen(short(600.0, Spring(300.0, 5e6), travel), spec, 30000.0), spec)


def test_stops_that_are_not_reached_or_not_left_change_nothing() -> None:
    """What the stiffness of one that stays closed changes falls with its inverse."""
    far, none = blown(500.0, 1e-3, STOP), blown(500.0, 1e-3, None)
    assert np.abs(far.displacement - none.displacement).max() < 1e-9 * none.largest.max()
    assert far.stop_force == 0.0
    rigid = blown(-300.0, 2e-6, None)
    apart = [
        np.abs(blown(-300.0, 2e-6, k).displacement - rigid.displacement).max() for k in (3e9, 3e10)
    ]
    assert 8.0 < apart[0] / apart[1] < 12.0
    assert apart[1] < 0.01 * rigid.largest.max()


def test_the_error_falls_where_stops_close() -> None:
    """By three for each halving of the step, on average: the force of a stop has a kink."""
    blow = push(-2500.0, direction="x", pulse=6e-4)
    spec = TimeResponseSpec(1.5e-3, 8000.0, ("nose",), (blow,), stop_stiffness=STOP)
    scene = seen(short(600.0, Spring(300.0, 5e6), 4e-6), spec, 0.0, **CONTROL)
    equation = Equation.of(scene, spec)
    nonlinear, still = Nonlinear.of(scene, equation), 0.0 * equation.damping[:, 0]
    inputs = partial(mean_inputs, spec, equation.speed)

    def path(count: int) -> Array:
        length = spec.duration / count
        moved = march(equation, inputs, length, count, (still, still), nonlinear).points[0]
        return moved[:: 2 * count // 60]

    paths = [path(count) for count in (60, 120, 240, 480, 960, 1920)]
    errors = [np.abs(one - other).max() for one, other in pairwise(paths)]
    assert (errors[0] / errors[-1]) ** (1 / 4) > 2.8


def test_what_is_left_after_the_beginning_is_named() -> None:
    """A large unbalance begins off balance, on the orbit of linear bearings, and goes on."""
    spec = TimeResponseSpec(8e-3, 2000.0, ("nose",), unbalances=(Unbalance("nose", 8e-4),))
    found = solve_time_response(seen(short(), spec, 12000.0), spec)
    size = np.linalg.norm(found.displacement[0, :, 0], axis=-1)
    late = size[found.time >= 0.75 * spec.duration]
    assert found.late_largest[0, 0] == pytest.approx(late.max(), rel=0.01)
    assert found.late_largest[0, 0] < 0.95 * found.largest[0, 0]
    assert any("quarter" in line for line in summary(found))
    spec = replace(spec, forces=(push(500.0, pulse=1e-3),), unbalances=())
    gone = solve_time_response(seen(short(), spec, 12000.0), spec)
    assert not any("quarter" in line for line in summary(gone))


def test_an_answer_that_ends_early_says_nothing_of_its_last_quarter() -> None:
    spec = TimeResponseSpec(5e-3, 1000.0, ("nose",), (push(1e6),))
    found = solve_time_response(seen(short(), spec, 0.0), spec)
    assert found.ending[0]
    assert found.ended[0] < spec.duration
    assert np.isnan(found.late_largest[0, 0])
    assert not any("quarter" in line for line in summary(found))


def test_motion_over_time_has_a_limit_without_damping() -> None:
    """Of steady responses alone it is said that they have none."""
    asked: dict[str, Any] = {"time_response": TimeResponseSpec(1e-3, 1e3, ("nose",), (push(1.0),))}
    assert [*unlimited(short(0.0), asked)] == []
    (told,) = unlimited(short(0.0), {**asked, "unbalance": None})
    assert told.startswith("unbalance: the machine is undamped")
    assert told.endswith("give damping.rotor, damping.bearings, or damping of supports")
    turning = TimeResponseSpec(1e-3, 1e3, ("nose",), unbalances=(Unbalance("nose", 1e-6),))
    (told,) = unlimited(short(0.0), {"time_response": turning})  # begins on a steady orbit
    assert told.startswith("time_response: the machine is undamped")
    (told,) = unlimited(uniform(0.3, 0.04), {"unbalance": None})
    assert told.endswith("give damping.rotor, or damping of supports")


def test_an_error_as_large_as_the_motion_is_no_accuracy() -> None:
    """As where the run before the last halving lost its way: it is no share of anything."""
    found = blown(2500.0, 2e-6, STOP)
    unknown = replace(found, error=np.full_like(found.error, 80.0))
    assert accuracy(unknown) == ["response over time not converged"]
    (told,) = set(warnings(unknown)) - set(warnings(found))
    assert "the motion of nose does not converge" in told
    assert "raise max_frequency" in told
    (told,) = set(warnings(replace(found, error=0.4 + 0.0 * found.error))) - set(warnings(found))
    assert "error of 4e-01 of its largest value" in told


@pytest.mark.few(1)
@pytest.mark.parametrize(("mass", "stiffness"), [(0.2, 3e9), (0.05, 3e10)])
def test_knocks_shorter_than_the_steps_are_reported(mass: float, stiffness: float) -> None:
    """The force of a stop is as far from that of small steps as its change says, or told."""
    blow = push(-2500.0, direction="x", pulse=6e-4)
    machine = short(600.0, Spring(300.0, 5e6), 4e-6)
    machine = replace(machine, sleeves=(replace(machine.sleeves[0], mass=mass),))
    found = []
    for highest in (4000.0, 16000.0):
        spec = TimeResponseSpec(1.5e-3, highest, ("nose",), (blow,), stop_stiffness=stiffness)
        found.append(solve_time_response(seen(machine, spec, 0.0), spec))
    coarse, fine = (float(each.stop_force[0, 0]) for each in found)
    assert abs(coarse / fine - 1.0) < 2.0 * found[0].stop_error[0, 0] + 0.01
    told = [line for line in warnings(found[0]) if "stop of sleeve rear has an error of" in line]
    assert bool(told) == (stiffness > 1e10)


def test_what_stops_do_is_reported() -> None:
    """With a stiffness the force of a stop, without one that it would close, or open."""

    def said(found: Any) -> list[str]:
        return [one for one in warnings(found) if "all balls" not in one]

    knocked = blown(2500.0, 2e-6, STOP)
    assert not said(knocked)
    assert any("largest force of the end stop: rear" in line for line in summary(knocked))
    (told,) = said(blown(2500.0, 2e-6, None))
    assert "with a stop_stiffness stops open" in told
    (told,) = said(blown(-2500.0, 9e-6, None))
    assert "beyond its end stop" in told
    assert "with a stop_stiffness they close" in told
