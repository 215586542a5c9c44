"""Motion past resonances in closed form against integration in time, and what is known of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import rotordyn
from rotordyn.analyses.unbalance.orbit import orbit
from rotordyn.analyses.unbalance.run_up import Parts, Run, blended
from rotordyn.analyses.unbalance.runs import BETWEEN, SHOWN, _peaks, _SpeedRange
from rotordyn.analyses.unbalance.solve import solve
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.steady import displacement_rows, load_of, out_of_balance
from rotordyn.equation.dofs import DIRECTIONS
from rotordyn.errors import RotordynError
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.seat import BearingSeat
from rotordyn.numerics.modes import modes
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.verification.test_time_response import hung

RATED = 2.0 * np.pi / 60.0
ONE = Unbalance("left_disc", 1e-3)


def system(seed, n=3):
    """Random symmetric stiffness, and damping with a gyroscopic part."""
    rng = np.random.default_rng([41, seed])
    turn = np.linalg.qr(rng.standard_normal((n, n)))[0]
    stiffness = turn @ np.diag(rng.uniform(30.0, 300.0, n) ** 2) @ turn.T
    part = rng.standard_normal((n, n))
    damping = 0.05 * (part @ part.T) + 20.0 * (part - part.T)
    return stiffness, damping, rng.standard_normal(n) + 1j * rng.standard_normal(n)


def displacements(n, parts=1):
    """Asked for in each of the ``parts``: the coordinates themselves."""
    return np.broadcast_to(np.eye(n), (parts, n, n)), np.zeros((parts, n, n)), np.zeros(n)


@pytest.mark.parametrize(
    "run", [Run(0.0, 400.0, 3.0), Run(400.0, 50.0, 1.0), Run(20.0, 350.0, 0.2)]
)
@pytest.mark.parametrize("seed", range(3))
def test_constant_matrices_are_exact(seed, run):
    """Against the equation of motion itself, in time; however the way is cut."""
    stiffness, damping, force = system(seed)
    n = len(force)
    known = modes(stiffness[None], damping[None])
    taken = known.pole, known.vector, known.participation, damping[None], stiffness[None], force

    def angle(t):
        return run.first * t + 0.5 * run.acceleration * t**2

    def rates(t, x):
        speed = run.first + run.acceleration * t
        load = force * (speed**2 - 1j * run.acceleration) * np.exp(1j * angle(t))
        return np.concatenate([x[n:], load - damping @ x[n:] - stiffness @ x[:n]])

    dynamic = stiffness + 1j * run.first * damping - run.first**2 * np.eye(n)
    steady = np.linalg.solve(dynamic, run.first**2 * force)
    begin = np.concatenate([steady, 1j * run.first * steady])
    times = np.linspace(0.0, run.duration, 121)
    ways = dict(t_eval=times, rtol=1e-10, atol=1e-12)
    truth = solve_ivp(rates, (0.0, run.duration), begin, "DOP853", **ways).y[:n].T
    truth = truth * np.exp(-1j * angle(times))[:, None]
    for count in (1, 4, 40):
        edges = np.linspace(run.first, run.last, count + 1)
        found = Parts(edges, edges[:1], *taken, steady, *displacements(n)).moved(run, times)
        np.testing.assert_allclose(found, truth, atol=3e-7 * np.abs(truth).max())


def integrated(case, duration, points, nodes):
    """Half axes of orbits (t, points) and of forces (t, connections) of a run up by the equation of
    the slowly varying amplitude, matrices linear between ``nodes`` speeds."""
    spec = case.analyses["unbalance"]
    speed = np.array(case.speeds)
    scene = Scene(
        case.spindle, case.conditions, np.linspace(speed[0], speed[-1], nodes), 200.0, spec.places
    )
    times, total, met = np.linspace(0.0, 1.0, points), 0.0, 0.0
    ratio = case.spindle.ratios[case.spindle.place(spec.acting[0]).rotor]
    alpha = abs(ratio) * (speed[-1] - speed[0]) / duration
    for k in out_of_balance(scene, spec):
        linear = scene.linear(k)
        force = load_of(scene, linear, spec)
        force = force if ratio > 0.0 else force.conj()
        n, top = len(force), abs(ratio) * speed[-1]
        share = np.linspace(0.0, 1.0, nodes)

        def matrix(t, linear=linear, n=n, share=share, top=top):
            row = int(np.clip(np.searchsorted(share, t / duration) - 1, 0, nodes - 2))
            part = (t / duration - share[row]) / (share[row + 1] - share[row])
            K, C = (
                (1.0 - part) * each[row] + part * each[row + 1]
                for each in (linear.stiffness, linear.damping)
            )
            w = abs(ratio) * speed[0] + alpha * t
            held = K + 1j * w * C + (1j * alpha - w**2) * np.eye(n)
            whole = np.block(
                [[np.zeros((n, n)), top * np.eye(n)], [-held / top, -C - 2j * w * np.eye(n)]]
            )
            return np.block([[whole.real, -whole.imag], [whole.imag, whole.real]])

        def rates(t, x, matrix=matrix, force=force, n=n, top=top):
            w = abs(ratio) * speed[0] + alpha * t
            pushed = np.concatenate([np.zeros(n), force * (w**2 - 1j * alpha) / top])
            return matrix(t) @ x + np.concatenate([pushed.real, pushed.imag])

        K, C = linear.stiffness[0], linear.damping[0]
        w = abs(ratio) * speed[0]
        steady = np.linalg.solve(K + 1j * w * C - w**2 * np.eye(n), w**2 * force)
        begin = np.concatenate([steady, np.zeros(n)])
        found = solve_ivp(
            rates,
            (0.0, duration),
            np.concatenate([begin.real, begin.imag]),
            "Radau",
            t_eval=times * duration,
            jac=lambda t, _, matrix=matrix: matrix(t),
            rtol=1e-5,
            atol=1e-12,
        )
        moved, grown = (found.y[a : a + n] + 1j * found.y[a + 2 * n : a + 3 * n] for a in (0, n))
        total = total + np.einsum("pan,nt->tpa", displacement_rows(scene, linear, spec), moved)
        w = abs(ratio) * speed[0] + alpha * times * duration
        both = moved, top * grown + 1j * w * moved
        met = met + np.einsum("kan,ent->etka", relative_rows(linear), both)
    pushed = orbit(*np.moveaxis(forces(scene, share, times, *met), -1, 0)).major
    return orbit(total[..., 0], total[..., 1]).major, pushed


def relative_rows(linear):
    """Of the shaft at every bearing and support to its other side (connections, 6, n)."""

    def row(link, side):
        rotor = getattr(link, side, "spindle" if side == "holds" else "ground")
        if rotor == "ground":
            return np.zeros((6, linear.size))
        return np.array([linear.row(rotor, link.x, way) for way in DIRECTIONS])

    links = linear.structure.spindle.connections
    return np.array([row(each, "holds") - row(each, "against") for each in links])


def forces(scene, share, times, moved, velocity):
    """Of springs and dampers along y and z (t, connections, 2): tangents of bearings, linear
    between the speeds, and what supports are given."""
    pushed = np.zeros((*moved.shape[:2], 2), dtype=complex)
    for k, link in enumerate(scene.spindle.connections):
        if isinstance(link, BearingSeat):
            tangents = scene.state.tangents[:, k]
            held = np.empty((len(times), 6, 6))
            for place in np.ndindex(6, 6):
                held[(..., *place)] = np.interp(times, share, tangents[(..., *place)])
            damping = link.radial_damping * np.ones(2)
        else:
            held = np.zeros((1, 6, 6))
            held[0, 1, 1], held[0, 2, 2] = link.stiffness["y", "y"], link.stiffness["z", "z"]
            damping = np.array([link.damping["y", "y"], link.damping["z", "z"]])
        spring = np.einsum("tab,tb->ta", np.broadcast_to(held, (len(times), 6, 6)), moved[:, k])
        pushed[:, k] = -spring[:, 1:3] - damping * velocity[:, k, 1:3]
    return pushed


def shown(axes):
    """The largest (t, points) from one speed shown to the next."""
    largest = axes[1:].reshape(SHOWN, BETWEEN, -1).max(axis=1)
    return np.concatenate([axes[:1], largest])


def friswell(low=500.0, high=1100.0, **asked):
    """The rotor with two discs past its first critical speeds, softer along y."""
    case = rotordyn.load("friswell_unbalance").variants["uneven"]
    speeds = tuple((np.linspace(low, high, 7) * RATED).tolist())
    length = asked.pop("element_length", None)
    changes = {f"analyses.unbalance.{key}": value for key, value in asked.items()}
    finer = {"conditions.element_length": length}
    return rotordyn.vary(case, {"speeds": speeds, **changes, **finer})


def damped(case):
    """With dampers that resist as much as springs do."""
    resisting = {("y", "y"): 1e4, ("z", "z"): 1e4}
    supports = tuple(replace(each, damping=resisting) for each in case.spindle.supports)
    return replace(case, spindle=replace(case.spindle, supports=supports))


def coaxial(ratio, **asked):
    """Two rotors, the outer one out of balance."""
    case = rotordyn.load("friswell_coaxial")
    only = {"unbalance": case.analyses["unbalance"]}
    speeds = tuple((np.linspace(1000.0, 9000.0, 9) * RATED).tolist())
    changes = {f"analyses.unbalance.{key}": value for key, value in asked.items()}
    turned = {"spindle.rotors.outer.speed_ratio": ratio, "speeds": speeds, "analyses": only}
    return rotordyn.vary(rotordyn.vary(case, turned), changes)


def flagship():
    """Bearings whose stiffness follows the speed, and a stop that closes at 20 240 rpm."""
    case = rotordyn.load("mfw2310_run_up")
    speeds = tuple((np.linspace(0.0, 24000.0, 4) * RATED).tolist())
    return rotordyn.vary(case, {"speeds": speeds, "analyses.unbalance.run_up": (0.5,)})


@pytest.mark.parametrize(
    ("case", "nodes"),
    [
        (friswell(run_up=(1.0,)), 100),
        pytest.param(damped(friswell(run_up=(0.1,))), 100, marks=pytest.mark.long),
        pytest.param(coaxial(1.5, run_up=(0.5,)), 100, marks=pytest.mark.long),
        pytest.param(coaxial(-1.5, run_up=(0.5,)), 100, marks=pytest.mark.long),
        (flagship(), 481),
    ],
    ids=["uneven", "damped", "coaxial", "against", "flagship"],
)
def test_machines_against_the_slowly_varying_amplitude(case, nodes):
    """Whose matrices follow the speed, in either form of both planes. If they changed at once from
    part to part, the last would have errors of 4e-3, and an estimated one of 3e-2."""
    found = rotordyn.run(case)["unbalance"]
    (duration,) = case.analyses["unbalance"].run_up
    truth = map(shown, integrated(case, duration, SHOWN * BETWEEN + 1, nodes))
    for values, expected in zip((found.run_amplitude, found.run_force), truth, strict=True):
        peak = expected.max(axis=0).min()
        np.testing.assert_allclose(values.values[0], expected, rtol=0.0, atol=1e-3 * peak)
    assert found.run_error.values.max() < 2e-3


def test_planes_that_are_one_and_planes_that_are_not():
    """A trace of difference between them makes two of one."""
    even = rotordyn.load("friswell_unbalance").variants["even"]
    speeds = tuple((np.linspace(0.0, 3000.0, 13) * RATED).tolist())
    asked = {"speeds": speeds, "analyses.unbalance.run_up": (2.0,)}
    one = rotordyn.run(rotordyn.vary(even, asked))["unbalance"]
    apart = {"spindle.supports.left.stiffness.yy": 1e6 * (1.0 + 1e-9)}
    two = rotordyn.run(rotordyn.vary(rotordyn.vary(even, asked), apart))["unbalance"]
    np.testing.assert_allclose(two.run_amplitude, one.run_amplitude, rtol=1e-5, atol=1e-12)


def test_errors_fall_with_the_square_of_the_parts():
    case = friswell(0.0, 3000.0)
    spec, speed = case.analyses["unbalance"], np.array(case.speeds)
    scene = Scene(case.spindle, case.conditions, speed, 200.0, spec.places)
    way = _SpeedRange(scene, spec, 1.0)
    truth, *rest = (way.axes(c, 5.0, down=False)[0][:, :2] for c in (480, 30, 60, 120, 240))
    errors = np.array([np.abs(each - truth).max() for each in rest])
    assert (errors[:-1] > 2.0 * errors[1:]).all()
    assert errors[0] > 15.0 * errors[-1]


def test_slow_runs_are_steady():
    """The departure falls with the acceleration, up and down."""
    case = friswell(2000.0, 3000.0, run_up=(200.0, 2000.0), run_down=(2000.0,))
    found = rotordyn.run(case)["unbalance"]
    speed = np.linspace(*found.run_speed.values[[0, -1]], SHOWN * BETWEEN + 1)
    steady = np.interp(speed, found.fine_speed, found.fine_major_axis.values[:, 0])[:, None]
    ways = np.array([shown(steady), shown(steady), shown(steady[::-1])[::-1]])[..., 0]
    apart = np.abs(found.run_amplitude.values[:, :, 0] - ways).max(axis=1) / steady.max()
    assert apart[0] > 5.0 * apart[1]
    assert (apart[1:] < 0.01).all()


@pytest.mark.few(1)
@pytest.mark.parametrize(("ratio", "down"), [(1.5, True), (-1.5, False)])
def test_runs_begin_in_steady_rotation(ratio, down):
    """With a rotor that turns with the spindle, and against it."""
    speeds = tuple((np.array([6000.0, 6010.0]) * RATED).tolist())
    case = coaxial(ratio, **{"run_down" if down else "run_up": (1e4,)})
    found = rotordyn.run(rotordyn.vary(case, {"speeds": speeds}))["unbalance"]
    row = -1 if down else 0
    begin, steady = found.run_amplitude.values[0, row], found.fine_major_axis.values[row]
    np.testing.assert_allclose(begin, steady, rtol=1e-4)


def test_a_run_that_grows_beyond_all_numbers_leaves_the_others():
    machine = rotordyn.load("friswell_internal_damping").variants["viscous"]
    spec = UnbalanceSpec(("left_disc",), (ONE,), run_up=(1.0, 1e5))
    asked = {"analyses": {"unbalance": spec}, "speeds": (100.0, 500.0)}
    results = rotordyn.run(rotordyn.vary(machine, asked))
    found = results["unbalance"]
    assert np.isfinite(found.run_peak.values[0]).all()
    assert np.isnan(found.run_peak.values[1]).all()
    sentence = "the run up in 100000 s has no solution: the motion is unstable"
    assert sentence in " ".join(results.warnings)
    assert (
        "the runs pass speeds at which the machine is unstable: from about " in results.warnings[-1]
    )


def test_a_run_past_a_speed_without_a_state_says_so():
    machine = rotordyn.load("deep_groove_lobes").variants["at_speed"]
    spec = UnbalanceSpec(("nose",), (Unbalance("nose", 1e-4),), run_up=(1.0,))
    asked = {"analyses": {"unbalance": spec}, "speeds": (0.0, 3000.0 * RATED, 110000.0 * RATED)}
    results = rotordyn.run(rotordyn.vary(machine, asked))
    assert results["unbalance"].run_outcome.values[0].startswith("no solution during the run, at ")
    assert np.isfinite(results["unbalance"].amplitude.values[1]).all()


@pytest.mark.long
def test_forces_of_slow_runs_are_steady():
    """Those of bearings on a spindle whose stop closes, and of its highest speed."""
    case = rotordyn.vary(flagship(), {"analyses.unbalance.run_up": (200.0,)})
    found = rotordyn.run(case)["unbalance"]
    steady = found.fine_force_amplitude.values
    np.testing.assert_allclose(found.run_force_peak.values[0], np.nanmax(steady, axis=0), rtol=2e-3)


def test_rigid_supports_carry_what_stiff_ones_do():
    """What acts on them directly, what springs and dampers leave to them, and inertia."""
    acting = Unbalance(0.0, 1e-3), Unbalance("left_disc", 1e-3)
    case, forces = damped(friswell(2000.0, 3000.0, run_up=(0.02,), unbalances=acting)), []
    stiff = {
        "stiffness": {("y", "y"): 1e11, ("z", "z"): 1e11},
        "damping": {("y", "y"): 1e5, ("z", "z"): 1e5},
    }
    for how in ({"stiffness": {}, "damping": {}, "rigid": ("y", "z")}, stiff):
        left = replace(case.spindle.supports[0], **how)
        spindle = replace(case.spindle, supports=(left, *case.spindle.supports[1:]))
        found = rotordyn.run(replace(case, spindle=spindle))["unbalance"]
        forces.append(found.run_force.values[0, 5:])  # the acceleration begins with a jump
    np.testing.assert_allclose(*forces, rtol=0.0, atol=1e-3 * forces[1].max())


def test_given_elements_refine_as_others_do():
    """Their accuracy is not requested; that of the parts is."""
    given = friswell(run_up=(10.0,), element_length=0.25)
    found = rotordyn.run(given)["unbalance"]
    assert found.run_error.values.max() < 2e-3


def test_one_mode_past_its_resonance():
    """Without damping the largest motion over the eccentricity grows with the root of the natural
    frequency squared over the acceleration: 1.46 of it (the largest Fresnel integral)."""
    natural, one = 100.0, np.ones((1, 1, 1))
    known = modes(natural**2 * one, 1e-9 * one)
    taken = known.pole, known.vector, known.participation, known.damping, known.stiffness
    asked = np.ones(1), np.zeros(1), *displacements(1)
    for duration in (40.0, 400.0):
        run = Run(0.0, 200.0, duration)
        parts = Parts(np.array([0.0, 200.0]), np.zeros(1), *taken, *asked)
        largest = np.abs(parts.moved(run, np.linspace(0.0, duration, 40000))).max()
        cycles = natural**2 / run.acceleration
        expected = 0.5 * np.sqrt(2.0 * np.pi) * 1.17 * np.sqrt(cycles)
        assert largest == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("down", [False, True])
@pytest.mark.parametrize("natural", [2913.7, 2914.9])
def test_peaks_narrower_than_the_instants_are_the_steady_ones(natural, down):
    """A run of three years, of which two instants lie within the resonance: e / 2ζ."""
    natural, ratio = natural * RATED, 5e-4
    mass = rotor_inertia(hung(1.0)).mass
    machine = hung(mass * natural**2, 2.0 * ratio * natural * mass)
    asked = {"run_down" if down else "run_up": (1e8,)}
    spec = UnbalanceSpec(("middle",), (Unbalance("middle", 1e-6),), **asked)
    speeds = np.array([0.0, 24000.0]) * RATED
    scene = Scene(machine, Conditions(rotor="rigid"), speeds, 400.0, (machine.place("middle"),))
    found = solve(scene, spec)
    steady = 1e-6 / mass / (2.0 * ratio * np.sqrt(1.0 - ratio**2))
    assert found.run_peak[0, 0] == pytest.approx(steady, rel=1e-3)
    assert found.run_peak_speed[0, 0] == pytest.approx(natural, rel=1e-5)


def test_peaks_at_ends_and_those_without_limit_are_of_instants():
    """At the ends of a run, and where the inverse squares of three instants dip below zero."""
    rising, edge = [1.0, 2.0, 4.0, 7.0, 11.0], [1e-3, 1.0, 1.0, 1e-3, 1e-3]
    axes = np.array([rising, rising[::-1], edge, [0.0] * 5]).T
    for speed in (np.arange(5.0), np.arange(4.0, -1.0, -1.0)):
        height, at = _peaks(speed, axes)
        np.testing.assert_array_equal(height, [11.0, 11.0, 1.0, 0.0])
        np.testing.assert_array_equal(at[:3], speed[[4, 0, 1]])


def undamped(first, last, **runs):
    """A rigid rotor on springs, between shares of its critical speed; that in rad/s, too."""
    machine = hung(8e5)
    natural = np.sqrt(8e5 / rotor_inertia(machine).mass)
    spec = UnbalanceSpec(("middle",), (Unbalance("middle", 1e-5),), **runs)
    speeds = np.array([first, last]) * natural
    scene = Scene(machine, Conditions(rotor="rigid"), speeds, 200.0, (machine.place("middle"),))
    return natural, solve(scene, spec)


@pytest.mark.parametrize("down", [False, True])
def test_a_pole_without_damping_may_lie_on_the_end_of_a_part(down):
    """Of a rigid rotor on springs in the middle of the way; against the equation of motion."""
    natural, found = undamped(0.0, 2.0, **{"run_down" if down else "run_up": (0.5,)})
    first, alpha = (2.0 * natural, -4.0 * natural) if down else (0.0, 4.0 * natural)
    size = 1e-5 / rotor_inertia(hung(8e5)).mass

    def rates(t, x):
        speed, angle = first + alpha * t, first * t + 0.5 * alpha * t**2
        load = size * (speed**2 - 1j * alpha) * np.exp(1j * angle)
        return np.array([x[1], load - natural**2 * x[0]])

    begin = size * first**2 / (natural**2 - first**2)
    start = np.array([begin, 1j * first * begin])
    times = np.linspace(0.0, 0.5, 20001)
    moved = solve_ivp(rates, (0.0, 0.5), start, "DOP853", t_eval=times, rtol=1e-9, atol=1e-12)
    assert found.run_outcome == ("",)
    assert found.run_peak[0, 0] == pytest.approx(np.abs(moved.y[0]).max(), rel=1e-5)


def test_a_pole_on_the_end_of_a_part_is_the_limit_of_poles_beside():
    """Where stiffnesses change on the way."""
    edges = np.linspace(50.0, 150.0, 51)
    middle = 0.5 * (edges[1:] + edges[:-1])
    run, times = Run(50.0, 150.0, 2.0), np.linspace(0.0, 2.0, 200)

    def moved(apart):
        natural = (100.0 + 0.5 * (middle - 101.0) + apart)[:, None, None]
        assert apart != 0.0 or (natural == edges[:-1, None, None]).any()
        known = modes(natural**2, 0.0 * natural)
        pole = 1j * np.sign(known.pole.imag) * natural[:, 0]  # without rounding
        taken = pole, known.vector, known.participation, known.damping, known.stiffness
        begin = np.array([50.0**2 / (natural[0, 0, 0] ** 2 - 50.0**2)])
        asked = np.ones(1), begin, *displacements(1, len(middle))
        return Parts(edges, middle, *taken, *asked).moved(run, times)

    beside = 0.5 * (moved(1e-3) + moved(-1e-3))
    np.testing.assert_allclose(moved(0.0), beside, atol=1e-6 * np.abs(beside).max())


def test_a_run_that_begins_without_steady_motion_says_so():
    """At a critical speed without damping; the other one passes it."""
    _, found = undamped(1.0, 2.0, run_up=(0.5,), run_down=(0.5,))
    assert found.run_outcome[0].startswith(
        "it begins where there is no steady motion (an undamped critical"
    )
    assert np.isnan(found.run_peak[0]).all()
    assert found.run_outcome[1] == ""
    assert 0.0 < found.run_peak[1, 0] < 1e-4


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ({"speeds": (3000.0 * RATED,), "analyses.unbalance.run_up": (1.0,)}, "needs two speeds"),
        ({"analyses.unbalance.run_down": (1.0, 1.0)}, "repeated: given '1 s'"),
        ({"analyses.unbalance.run_up": (-1.0,)}, "duration out of range"),
        (
            {
                "spindle.damping.loss_factor": 0.01,
                "analyses.unbalance.run_up": (1.0,),
            },
            "loss factors are defined for steady vibration alone",
        ),
    ],
)
def test_faults(asked, sentence):
    with pytest.raises(RotordynError, match=sentence):
        rotordyn.vary(friswell(), asked)


@pytest.mark.parametrize(
    ("duration", "damping", "most", "least"),
    [(0.5, 4.0, 1e-3, 1e-5), (20.0, 4.0, 0.06, 1e-3), (20.0, 400.0, 1e-4, 1e-4)],
)
def test_errors_by_matrices_that_follow_the_speed_are_of_second_order(
    duration, damping, most, least
):
    """Two modes whose stiffness and gyroscopic coupling change with the speed, against the equation
    of motion; in a fast run that rings on, in a slow one that follows steady rotation, and in one
    whose modes decay within a part. If the matrices changed at once, or the cuts were not blended,
    errors would be twice ``most`` and more by twenty parts, or twice ``least`` by 160."""
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    force, run = np.array([1.0, 0.3 - 0.2j]), Run(50.0, 250.0, duration)

    def matrices(speed):
        share = np.asarray(speed)[..., None, None] / 200.0
        stiffness = np.diag([150.0**2, 180.0**2]) * (1.0 + 0.5 * share)
        return stiffness, damping * np.eye(2) + 20.0 * share * turn

    def steady(speed):
        K, C = matrices(speed)
        dynamic = K + 1j * speed * C - speed**2 * np.eye(2)
        return np.linalg.solve(dynamic, speed**2 * force)

    def cut(middles, edges):
        known = modes(*matrices(middles))
        taken = known.pole, known.vector, known.participation, known.damping, known.stiffness
        asked = displacements(2, len(middles))
        return Parts(edges, middles, *taken, force, steady(run.first), *asked)

    def rates(t, x):
        speed = run.first + run.acceleration * t
        K, C = matrices(speed)
        turned = 2j * speed * x[2:] + (1j * run.acceleration - speed**2) * x[:2]
        held = K @ x[:2] + C @ (x[2:] + 1j * speed * x[:2])
        return np.concatenate([x[2:], force * (speed**2 - 1j * run.acceleration) - held - turned])

    share = np.linspace(0.0, 1.0, 1441)
    begin = np.concatenate([steady(run.first), np.zeros(2)])
    how = dict(t_eval=share * duration, rtol=1e-9, atol=1e-11)
    truth = solve_ivp(rates, (0.0, duration), begin, "DOP853", **how).y[:2].T
    errors = []
    for count in (20, 40, 80, 160):
        speed = np.linspace(run.first, run.last, 2 * count + 1)
        even = cut(speed[1::2], speed[::2])
        between = cut(speed[::2], speed[[0, *range(1, len(speed), 2), -1]])
        moved = [each.moved(run, share * duration) for each in (even, between)]
        apart = blended(*moved, count * share) - truth
        errors.append(np.abs(apart).max() / np.abs(truth).max())
    assert errors[0] < most
    assert errors[-1] < least
