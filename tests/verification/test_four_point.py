"""Four-point bearings against an independent formulation, and the equations themselves."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import rotordyn
from bearings import InvalidBearing, stiffness
from tests.oracles.four_point import Drawing, Found, GrooveOracle
from tests.oracles.groove_balance import balanced
from tests.oracles.known_bearings import HYPOTHESES, RPM, SHARINGS
from tests.oracles.known_grooves import (
    QJ218,
    R24_14,
    four_point,
    lever,
    mixed_loads,
)
from tests.oracles.random_kinds import draw

Array = NDArray[np.float64]
BOTH = pytest.mark.parametrize("dynamics", ["frozen", "resultant"])
DRAWN = pytest.mark.parametrize("drawing", [QJ218, R24_14], ids=["QJ218", "R24_14"])


def assert_same(state: Any, index: int, want: Found, unit: Array, tolerance: float) -> None:
    """Ring and balls. A ball that rides the outer race alone moves nothing: its Fc, which hangs on
    the direction the inner race is thought to have from it, is compared to a tenth."""
    top = max(want.contact_load.max(), want.centrifugal_force.max())
    size = np.abs(want.displacement * unit).max()
    moved = (state.displacement[index] - want.displacement) * unit
    assert np.abs(moved).max() < tolerance * size
    lost = ~want.contact_load[:, :2].any(axis=-1)
    load, there = state.contact_load[index], want.contact_load
    assert load[~lost] == pytest.approx(there[~lost], abs=tolerance * top)
    assert load[lost] == pytest.approx(there[lost], rel=0.1)
    balls = len(want.contact_load)
    apart = (state.load[index] - want.load) / unit
    assert np.abs(apart).max() < tolerance * top * balls
    sure = (want.contact_load > 1e-6 * top) | (want.contact_load == 0.0)
    agreed = (state.contact_load[index] > 0.0) == (want.contact_load > 0.0)
    assert agreed[sure].all()
    angle = state.contact_angle[index]
    held = want.contact_load > 1e-3 * top
    assert angle[held] == pytest.approx(want.contact_angle[held], abs=1e2 * tolerance)
    inner = np.hypot(*want.inner_force.T) > 1e-3 * top
    for name in ("centrifugal_force", "gyroscopic_moment"):
        found, there = getattr(state, name)[index], getattr(want, name)
        most = np.abs(there).max()
        assert found[inner] == pytest.approx(there[inner], abs=1e3 * tolerance * most)


@DRAWN
def test_angle_and_axial_play_of_a_drawing_are_refused_with_the_shims_they_mean(
    drawing: Drawing,
) -> None:
    bearing = four_point(drawing)
    angle, axial, _ = bearing.plays
    shims = (bearing.inner_shim + bearing.outer_shim) * 1e3
    with pytest.raises(
        InvalidBearing, match=rf"inner_shim and outer_shim, {shims:.4g} mm together"
    ):
        replace(bearing, contact_angle=angle, axial_play=axial, radial_play=None)


def test_contradicting_data_are_refused_with_the_shims_and_what_each_means() -> None:
    bearing = four_point(QJ218)
    with pytest.raises(InvalidBearing) as caught:
        replace(bearing, contact_angle=None, axial_play=70e-6, radial_play=50e-6)
    said = str(caught.value)
    assert "with inner_shim 0.3574 mm, outer_shim 0.8068 mm: got axial_play 70 µm means" in said
    assert "; radial_play 50 µm means contact_angle" in said


def test_a_lightly_loaded_ball_may_have_two_states_at_one_displacement() -> None:
    """With inner contacts of a few newtons and without: either is in balance, and differences of
    the displacement solve are given only for the one that it finds."""
    bearing, speed = rotordyn.model("bearings", "qj218"), 9962.0 * RPM
    loaded = bearing.equilibrium(load=[360.0, 908.0, -1360.0, -20.5, 27.9], speed=speed)
    ask = dict(displacement=loaded.displacement, speed=speed)
    other, same = bearing.equilibrium(**ask), bearing.equilibrium(**ask, start=loaded)
    assert same.load == pytest.approx(loaded.load, rel=1e-9)
    assert loaded.contacts[0] == 4
    assert other.contacts[0] == 2
    assert (other.contacts[1:] == loaded.contacts[1:]).all()
    assert abs(other.load[1] / loaded.load[1] - 1.0) > 5e-3
    assert np.isnan(stiffness(loaded, "difference")).all()
    assert stiffness(other, "difference") == pytest.approx(other.stiffness(), rel=1e-5, abs=1e-2)


def test_balls_pressed_too_far_at_rest_are_reported_by_how_much() -> None:
    """A play of −Qr · t presses either arch of every ball by Qr: with an even number t is 2."""
    usual = four_point(R24_14)
    arch = (usual.inner_conformity - 0.5) * usual.ball_diameter
    even = replace(usual, balls=2 * (usual.balls // 2), inner_shim=arch, outer_shim=arch)
    for share, fits in ((0.99, True), (1.01, False)):
        pressed = share * 2e-3 * usual.ball_diameter
        given = dict(contact_angle=None, axial_play=None, radial_play=-2.0 * pressed)
        if fits:
            assert replace(even, **given).plays[2] == pytest.approx(-2.0 * pressed)
            continue
        most = 2e-3 * usual.ball_diameter
        said = f"by {pressed * 1e6:.4g} µm at rest, beyond {most * 1e6:.4g} µm"
        with pytest.raises(InvalidBearing, match=said):
            replace(even, **given)


@pytest.mark.few(1)
@BOTH
@DRAWN
def test_random_loads(drawing: Drawing, dynamics: str) -> None:
    """Two, three and four contacts, lost and unloaded balls among them."""
    load, speed = mixed_loads(16, 5)
    how = dict(kinematics="outer", moment_sharing="equal")
    s = four_point(drawing).equilibrium(load=load, speed=speed, dynamics=dynamics, **how)
    assert (s.outcome == "").all()
    assert {2, 3, 4} <= set(np.unique(s.contacts).tolist())
    oracle = GrooveOracle(drawing, **how)
    for i in range(len(load)):
        want = oracle.solve(load=load[i], speed=speed[i], dynamics=dynamics)
        assert_same(s, i, want, oracle.lever, 1e-7)


@pytest.mark.parametrize(("kinematics", "sharing"), list(zip(HYPOTHESES, SHARINGS, strict=True)))
def test_random_loads_of_all_hypotheses(kinematics: str, sharing: str) -> None:
    """Thrust that keeps every ball on its inner race: with geometric and inner control a ball
    loses it with a jump."""
    load, speed = mixed_loads(5, 6)
    load[:, 0] = 40e3 * np.sign(load[:, 0])
    load[:, 1:] *= 0.4
    how = dict(kinematics=kinematics, moment_sharing=sharing)
    s = four_point(QJ218).equilibrium(load=load, speed=0.6 * speed, **how)
    assert (s.outcome == "").all()
    oracle = GrooveOracle(QJ218, **how)
    for i in range(len(load)):
        want = oracle.solve(load=load[i], speed=0.6 * speed[i], dynamics="resultant")
        assert_same(s, i, want, oracle.lever, 1e-7)


@pytest.mark.few(1)
@BOTH
@DRAWN
def test_random_displacements(drawing: Drawing, dynamics: str) -> None:
    """Up to some 3 GPa; every ball on its own."""
    rng = np.random.default_rng(7)
    thrown = rng.uniform(-1.0, 1.0, (12, 5)) * [60e-6, 50e-6, 50e-6, 8e-4, 8e-4]
    thrown[:, 0] += np.sign(thrown[:, 0]) * 0.5 * drawing.axial_play
    speed = rng.uniform(2e3, 14e3, 12) * RPM
    how = dict(kinematics="outer", moment_sharing="equal")
    s = four_point(drawing).equilibrium(displacement=thrown, speed=speed, dynamics=dynamics, **how)
    assert (s.outcome == "").all()
    oracle = GrooveOracle(drawing, **how)
    for i, d in enumerate(thrown):
        want = oracle.solve(displacement=d, speed=speed[i], dynamics=dynamics)
        assert_same(s, i, want, oracle.lever, 1e-7)


@BOTH
def test_mixed_questions(dynamics: str) -> None:
    """Free axial and radial motion, blocked tilts, against the oracle asked the same."""
    nan = math.nan
    load, held = [15e3, 6e3, -2e3, nan, nan], [nan, nan, nan, 2e-4, -3e-4]
    how = dict(kinematics="outer", moment_sharing="equal")
    question = dict(load=load, displacement=held, speed=9000 * RPM, dynamics=dynamics)
    s = four_point(QJ218).equilibrium(**question, **how)
    want = GrooveOracle(QJ218, **how).solve(**question)
    batch = SimpleNamespace(**{n: np.asarray(getattr(s, n))[None] for n in NAMES})
    assert_same(batch, 0, want, lever(QJ218), 1e-7)


NAMES = (
    "displacement",
    "load",
    "contact_load",
    "contact_angle",
    "centrifugal_force",
    "gyroscopic_moment",
)


@BOTH
@DRAWN
def test_balls_and_ring_balance(drawing: Drawing, dynamics: str) -> None:
    """Recomputed from loads and angles; the drawn geometry closes; nothing pulls."""
    load, speed = mixed_loads(60, 8)
    how = dict(kinematics="outer", moment_sharing="equal")
    s = four_point(drawing).equilibrium(load=load, speed=speed, dynamics=dynamics, **how)
    assert (s.outcome == "").all()
    assert (s.residual < 1e-9).all()
    found = balanced(GrooveOracle(drawing, **how), s, dynamics)
    assert found.ball.max() < 1e-9
    assert found.ring.max() < 1e-9
    assert found.gap.max() < 1e-12 * drawing.ball_diameter
    assert found.motion.max() < 1e-9
    assert (s.contact_load >= 0.0).all()
    numbers = (s.load, s.displacement, s.contact_load, s.contact_pressure, s.inner_load)
    assert all(np.isfinite(v).all() for v in (*numbers, s.stiffness("complete")))
    assert (np.isfinite(s.contact_angle) == (s.contact_load > 0.0)).all()
    assert (s.contacts == np.count_nonzero(s.contact_load, axis=-1)).all()


@DRAWN
def test_results_by_race_are_the_resultants(drawing: Drawing) -> None:
    load, speed = mixed_loads(20, 9)
    s = four_point(drawing).equilibrium(load=load, speed=speed)
    side = np.array([1.0, -1.0, -1.0, 1.0])
    angle = np.where(s.contact_load > 0.0, s.contact_angle, 0.0)
    for race, part in (("inner", [0, 1]), ("outer", [2, 3])):
        axial = (s.contact_load * side * np.sin(angle))[..., part].sum(-1)
        radial = (s.contact_load * np.cos(angle))[..., part].sum(-1)
        size = np.hypot(axial, radial)
        found, way = getattr(s, f"{race}_load"), getattr(s, f"{race}_angle")
        assert found == pytest.approx(size, abs=1e-9 * size.max())
        held = size > 1e-6 * size.max()
        assert way[held] == pytest.approx(np.arctan2(axial, radial)[held], abs=1e-8)


def test_pressure_is_hertz() -> None:
    s = four_point(QJ218).equilibrium(load=[20e3, 8e3, 0.0, 0.0, 0.0])
    want = GrooveOracle(QJ218).pressure(s.contact_load)
    assert s.contact_pressure == pytest.approx(want, rel=1e-8)


def test_unloaded_balls_at_rest_carry_nothing() -> None:
    s = four_point(R24_14).equilibrium(load=[2e3, 12e3, 0.0, 0.0, 0.0])
    bare = s.contacts == 0
    assert bare.any()
    assert (s.contact_load[bare] == 0.0).all()
    assert np.isnan(s.contact_angle[bare]).all()
    assert (s.inner_load[bare] == 0.0).all()


def test_a_ball_without_inner_load_sits_in_the_outer_arch() -> None:
    """On both arcs, Fc/(2 cos α) each."""
    s = four_point(R24_14).equilibrium(displacement=np.zeros(5), speed=9000 * RPM)
    assert (s.contacts == 2).all()
    assert (s.contact_load[:, :2] == 0.0).all()
    angle = s.contact_angle[:, 2:]
    each = s.centrifugal_force[:, None] / (2.0 * np.cos(angle))
    assert s.contact_load[:, 2:] == pytest.approx(each, rel=1e-9)
    arch = math.asin(0.5 * 0.21e-3 / (0.0124 * 20.638e-3))
    assert (angle < arch).all()
    assert angle == pytest.approx(arch, abs=0.01)


@DRAWN
@pytest.mark.parametrize("given", ["contact_angle", "axial_play", "radial_play"])
def test_each_of_the_three_data_gives_the_same_bearing(drawing: Drawing, given: str) -> None:
    """Along the axis a ball goes from one shim to the other: Ep = 2 BD sin αf − gi − go."""
    known = four_point(drawing)
    angle, axial, _ = known.plays
    distance = (drawing.inner_conformity + drawing.outer_conformity - 1.0) * drawing.ball_diameter
    shims = drawing.inner_shim + drawing.outer_shim
    assert angle == pytest.approx(drawing.contact_angle, rel=1e-12)
    assert axial == pytest.approx(2.0 * distance * math.sin(angle) - shims, rel=1e-12)
    value = dict(zip(("contact_angle", "axial_play", "radial_play"), known.plays, strict=True))
    again = four_point(drawing, **{given: value[given]})
    assert again.plays == pytest.approx(known.plays, rel=1e-9)


PLAYS = [150e-6, 300e-6]  # the free contact angle exceeds the outer arch from 130 µm on


@BOTH
@pytest.mark.parametrize("rpm", [0.0, 10000.0])
@pytest.mark.parametrize("play", PLAYS)
def test_the_centred_bearing_carries_nothing(play: float, rpm: float, dynamics: str) -> None:
    """Of any play, at rest and at speed; the balls of an arch of 24° sit in it."""
    b = four_point(R24_14, axial_play=play)
    s = b.equilibrium(displacement=np.zeros(5), speed=rpm * RPM, dynamics=dynamics)
    size = max(float(s.contact_load.max()), 1.0)
    assert np.abs(s.load / lever(R24_14)).max() < 1e-9 * size * R24_14.balls
    assert s.contact_load.any() == (rpm > 0.0)


@BOTH
@pytest.mark.parametrize("rpm", [0.0, 10000.0])
def test_a_preloaded_bearing_is_loaded_and_free_of_load_when_centred(
    rpm: float, dynamics: str
) -> None:
    """Negative play: all four contacts bear, and the sums vanish."""
    b = four_point(R24_14, radial_play=-20e-6)
    s = b.equilibrium(displacement=np.zeros(5), speed=rpm * RPM, dynamics=dynamics)
    assert (s.contacts == 4).all()
    assert s.contact_load.min() > 100.0
    unit = lever(R24_14)
    assert np.abs(s.load / unit).max() < 1e-9 * s.contact_load.max() * R24_14.balls
    drawn = replace(R24_14, contact_angle=b.free_angle)
    want = GrooveOracle(drawn).solve(displacement=np.zeros(5), speed=rpm * RPM, dynamics="frozen")
    if dynamics == "frozen":
        top = want.contact_load.max()
        assert s.contact_load == pytest.approx(want.contact_load, abs=1e-8 * top)
    k = s.stiffness("complete") / unit / unit[:, None]
    assert np.linalg.eigvalsh(0.5 * (k + k.T)).min() > 0.0


@pytest.mark.few(2)
@pytest.mark.parametrize("number", [48, 94, 130, 139, 153])
def test_balls_against_the_straight_wall_of_a_groove_are_in_balance(number: int) -> None:
    """Beyond 90° a wall presses a ball along the axis; friction acts at the groove of that wall."""
    asked = draw("four point", number, 50)
    state = asked.solve()
    found = balanced(asked.oracle, state, asked.dynamics, asked.shift)
    walls = (state.contact_load > 0.0) & (np.cos(state.contact_angle) < 1e-12)
    chosen = (state.outcome == "") & walls.any(axis=(-1, -2))
    assert chosen.any()
    for fault in (found.ball, found.ring, found.motion):
        assert fault[chosen].max() < 1e-9
    assert found.gap[chosen].max() < 1e-12 * asked.bearing.ball_diameter
