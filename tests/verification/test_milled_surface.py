"""Forced vibration of stable milling against closed forms and motion over time."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

import rotordyn
from rotordyn.analyses.stability_lobes import forced as forced_vibration
from rotordyn.analyses.stability_lobes import limit_depth, milled, planned_cut
from rotordyn.analyses.stability_lobes.contact import Contact
from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.analyses.stability_lobes.figures import headline_curves
from rotordyn.analyses.stability_lobes.figures.milled_surface import surface_figure
from rotordyn.analyses.stability_lobes.forced import Forced, _Loop
from rotordyn.analyses.stability_lobes.forces import Forces
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import PlannedCut, StabilityLobesSpec, Turning
from rotordyn.analyses.stability_lobes.summary import numbers, summary, warnings
from rotordyn.errors import InvalidInput
from rotordyn.job.solving import solve
from rotordyn.results.described import Shown

KT, KR, KTE, KRE = 7e8, 2.5e8, 2e4, 1.5e4
MASS, NATURAL, RATIO = (
    np.array([0.04, 0.05]),
    2.0 * math.pi * np.array([900.0, 1100.0]),
    np.array([0.05, 0.06]),
)
STIFF = MASS * NATURAL**2
DEPTH, FEED, DIAMETER, SPEED = 2e-4, 1e-4, 0.02, 2.0 * math.pi * 150.0
STEPS = 1200  # of a revolution


def tip(omega):
    """Two modes, one in feed and one in normal."""
    found = np.zeros((len(omega), 2, 2), dtype=complex)
    for k in range(2):
        lost = 2j * RATIO[k] * NATURAL[k] * omega
        found[:, k, k] = 1.0 / MASS[k] / (NATURAL[k] ** 2 - omega**2 + lost)
    return found


def over_time(cut, edges, rubbing, turns=16, slices=40, steps=STEPS):
    """Position of the tip (steps, 2) over the last of some revolutions from rest, the largest
    force and the mean torque over the radius: each tooth in slices along its edge, each step exact
    under the force at its middle. Unlike teeth take off what the deepest of all before them left,
    or nothing."""
    pitches = np.array(cut.pitches or [2.0 * math.pi / cut.teeth] * cut.teeth)
    behind = -np.concatenate([[0.0], np.cumsum(pitches[1:])])
    feeds = FEED * cut.teeth * pitches / (2.0 * math.pi)
    lag = cut.lag * (np.arange(slices) + 0.5) / slices if cut.lag else np.zeros(1)
    ago = np.round(pitches / (2.0 * math.pi) * steps).astype(int)
    step = 2.0 * math.pi / SPEED / steps
    system = np.zeros((4, 4))
    system[:2, 2:], system[2:, :2] = np.eye(2), -np.diag(NATURAL**2)
    system[2:, 2:] = -np.diag(2.0 * RATIO * NATURAL)
    ahead = expm(system * step)
    by_force = np.linalg.solve(system, ahead - np.eye(4))[:, 2:] / MASS
    angle = 2.0 * math.pi * (np.arange(steps) + 0.5) / steps
    at = np.mod(angle[:, None, None] + behind[:, None] - lag, 2.0 * math.pi)
    share = ((at > cut.entry) & (at < cut.exit)) * DEPTH / len(lag)
    s, c = np.sin(at), np.cos(at)
    normal = np.stack([s, c], axis=-1)
    force = -np.stack(
        [cut.tangential * c + cut.radial * s, cut.radial * c - cut.tangential * s], axis=-1
    )
    by_chip = (share[..., None, None] * force[..., :, None] * normal[..., None, :]).sum(axis=2)
    alone = np.einsum("njik,j->ni", by_chip * np.array([1.0, 0.0]), feeds)
    # the feed is along x: its chip is that of a motion (f, 0)
    edge = -np.stack([edges[0] * c + edges[1] * s, edges[1] * c - edges[0] * s], axis=-1)
    alone = alone + (share[..., None] * edge).sum(axis=(1, 2))
    flank = -rubbing * (share[..., None, None] * normal[..., :, None] * normal[..., None, :]).sum(
        axis=(1, 2)
    )
    uneven = len({*np.round(pitches, 9)}) > 1
    before = (np.arange(cut.teeth)[:, None] - np.arange(cut.teeth)) % cut.teeth
    since, passed = np.cumsum(feeds[before], axis=1), np.cumsum(ago[before], axis=1)
    out = np.array(cut.runout or [0.0] * cut.teeth)
    higher = out[:, None] - out[np.roll(before, -1, axis=1)]
    state, path, largest = np.zeros(4), np.zeros((turns * steps + 1, 2)), 0.0
    torque = cut.tangential * np.einsum("njl,njl,j->n", share, s, feeds)
    torque += edges[0] * share.sum(axis=(1, 2))
    for n in range(turns * steps):
        place = n % steps
        here = state[:2] + 0.5 * step * state[2:]
        total = alone[place] + flank[place] @ state[2:]
        if cut.runout or uneven:
            moved = here - 0.5 * (path[n - passed] + path[n - passed + 1])  # not yet passed: 0
            chip = np.einsum("jmi,jli->jml", moved, normal[place]) + higher[..., None]
            chip = (chip + since[..., None] * s[place][:, None]).min(axis=1)
            cuts = share[place] * (chip > 0.0)
            torque[place] = (cuts * (cut.tangential * chip + edges[0])).sum()
            total = np.einsum("jl,jl,jli->i", cuts, chip, force[place])
            total += np.einsum("jl,jli->i", cuts, edge[place])
            total -= rubbing * np.einsum("jl,jli,jlk->ik", cuts, *[normal[place]] * 2) @ state[2:]
        state = ahead @ state + by_force @ total
        path[n + 1] = state[:2]
        largest = max(largest, math.hypot(*total)) if n >= (turns - 1) * steps else 0.0
    return path[-steps - 1 :], largest, torque.mean()


UNEVEN = tuple(np.radians([100.0, 120.0, 140.0]))
PAIR = tuple(np.radians([150.0, 210.0]))
FOUR = (0.0, 9.4e-6, 1.9e-6, 9.1e-6)
OUT = (2e-5, -2e-5, 0.0)


@pytest.mark.parametrize(
    ("cut", "edges", "rubbing"),
    [
        (Cut(2, KT, KR, 0.0, math.pi / 2), (0.0, 0.0), 0.0),
        (Cut(3, KT, KR, math.pi / 2, math.pi, 0.6), (KTE, KRE), 0.0),
        (Cut(4, KT, KR, 0.0, math.pi, pitches=tuple(np.radians([70, 110] * 2))), (0.0, KRE), 0.0),
        (Cut(3, KT, KR, 0.0, math.pi / 2, 0.4, UNEVEN), (KTE, KRE), 0.0),
        (Cut(2, KT, KR, math.pi / 2, math.pi), (0.0, 0.0), 8e5 / (SPEED * DIAMETER / 2)),
        (Cut(3, KT, KR, 0.0, math.pi, 0.4, UNEVEN), (0.0, 0.0), 2e4 / (SPEED * DIAMETER / 2)),
        (Cut(2, KT, KR, math.pi / 2, math.pi, 0.0, PAIR), (0.0, 0.0), 8e5 / (SPEED * DIAMETER / 2)),
        (Cut(2, KT, KR, 0.0, math.pi, runout=(0.0, 3e-5)), (0.0, 0.0), 0.0),
        (Cut(3, KT, KR, 0.0, math.pi, 0.4, UNEVEN, OUT), (0.0, 0.0), 1e5 / (SPEED * DIAMETER / 2)),
        (Cut(3, KT, KR, 0.0, math.pi, 0.4, UNEVEN, OUT), (KTE, KRE), 0.0),
        (Cut(4, KT, KR, 0.0, math.pi / 2, runout=FOUR), (KTE, KRE), 0.0),
        (Cut(3, KT, KR, 0.0, 2.0, runout=(0.0, 5e-5, -1.2e-4)), (0.0, 0.0), 0.0),
    ],
    ids=[
        *("up", "helix and edges", "pattern", "uneven helix", "flanks", "uneven, helix, flanks"),
        *(
            "uneven and flanks",
            "run-out",
            "all at once",
            "edges and helix",
            "edges",
            "a tooth that does not cut",
        ),
    ],
)
def test_motion_and_walls_against_a_simulation_over_time(cut, edges, rubbing):
    forces = Forces(cut, DEPTH, FEED, *edges)
    walls = [wall for wall, there in (("up", cut.entry == 0.0), ("down", cut.exit > 3.0)) if there]
    found = Forced(forces, DIAMETER, SPEED, 2.0 * math.pi * 12e3, rubbing).solve(tip, walls)
    steps = 3600 if cut.runout and any(edges) and not cut.lag else STEPS  # edges begin at once
    path, largest, torque = over_time(cut, edges, rubbing, steps=steps)
    assert found.error < 1e-3
    assert found.force == pytest.approx(largest, rel=5e-3 if cut.lag else 1e-3)  # slices
    assert found.torque == pytest.approx(0.5 * DIAMETER * torque, rel=2e-3)
    near = 3e-3 * np.ptp(path, axis=0).max()
    assert found.deflection == pytest.approx(path[1:].mean(axis=0), abs=near)
    assert found.peak_to_peak == pytest.approx(np.ptp(path, axis=0), abs=near)
    every = np.linspace(0.0, 2.0 * math.pi, steps + 1)
    pitches = cut.pitches or (2.0 * math.pi / cut.teeth,) * cut.teeth
    behind = -np.concatenate([[0.0], np.cumsum(pitches[1:])])
    out = np.array(cut.runout or [0.0] * cut.teeth)
    for k, wall in enumerate(walls):
        angle = (0.0 if wall == "up" else math.pi) + np.linspace(0.0, cut.lag, 41)
        left = (-1.0 if wall == "up" else 1.0) * np.interp(
            np.mod(angle - behind[:, None], 2.0 * math.pi), every, path[:, 1]
        )
        left = (left - out[:, None]).min(axis=0)  # the deepest tooth
        assert found.least[k] == pytest.approx(left.min(), abs=near)
        assert found.most[k] == pytest.approx(left.max(), abs=near)


@pytest.mark.parametrize("teeth", [2, 3, 4])
def test_mean_forces_and_power_of_a_slot_in_closed_form(teeth):
    """Altintas, Manufacturing Automation: mean forces of a slot; the power is Ktc times the removal
    rate and that of the edges."""
    found = milled(
        *(tip, DEPTH, FEED, teeth, KT, KR),
        speed=SPEED,
        diameter=DIAMETER,
        tangential_edge=KTE,
        radial_edge=KRE,
    )
    x = -teeth * DEPTH * (FEED * KR / 4.0 + KRE / math.pi)
    y = teeth * DEPTH * (FEED * KT / 4.0 + KTE / math.pi)
    assert found.deflection == pytest.approx([x / STIFF[0], y / STIFF[1]], rel=1e-12)
    removal = DEPTH * DIAMETER * FEED * teeth * SPEED / (2.0 * math.pi)
    edges = KTE * DEPTH * 0.5 * DIAMETER * SPEED * teeth / 2.0
    assert found.power == pytest.approx(KT * removal + edges, rel=1e-12)


@pytest.mark.parametrize("runout", [(), (2e-5, -3e-5, 0.0), (0.0, 2e-5, -6e-5)])
def test_harmonics_are_those_of_the_force_over_a_revolution(runout):
    """Of edges on a helix, whose force has no steps."""
    cut = Cut(3, KT, KR, 0.3, 2.1, 0.7, UNEVEN, runout)
    forces = Forces(cut, DEPTH, FEED, KTE, KRE)
    angle = 2.0 * math.pi * np.arange(16384) / 16384
    over = forces.at(angle)
    spectrum = np.fft.rfft(over[:, :2], axis=0) / len(angle)
    order = np.arange(40.0)
    found = forces.harmonics(order)
    np.testing.assert_allclose(found, spectrum[:40], atol=1e-6 * np.abs(spectrum).max())
    assert forces.mean_torque() == pytest.approx(over[:, 2].mean(), rel=1e-6)


@pytest.mark.parametrize(
    ("pitches", "runout"),
    [
        ((), (2e-5, -3e-5, 0.0)),
        (UNEVEN, OUT),
        (UNEVEN, (0.0, 9e-5, -1.5e-4)),
        ((), (0.0, -1e-3, 0.0)),
    ],
)
def test_chips_are_what_teeth_before_left(pitches, runout):
    """Of a rigid machine: the surface at every angle is kept, lowered by the teeth as they pass."""
    cut = Cut(3, KT, KR, 0.0, 2.5, 0.0, pitches, runout)
    gaps = np.array(pitches or [2.0 * math.pi / 3] * 3)
    forces, angle = Forces(cut, DEPTH, FEED), np.linspace(1e-3, 2.499, 997)
    surface, travelled = np.full_like(angle, -np.inf), 0.0
    for turn in range(6):
        for tooth in range(3):
            travelled += FEED * 3.0 * gaps[tooth] / (2.0 * math.pi)
            reach = travelled * np.sin(angle) + runout[tooth]
            taken, surface = np.maximum(reach - surface, 0.0), np.maximum(surface, reach)
            if turn < 5:
                continue
            own = [chip for chip in forces.chips if chip.tooth == tooth]
            thickness = np.zeros_like(angle)
            for chip in own:
                inside = (angle > chip.entry) & (angle < chip.exit)
                thickness[inside] += chip.feed * np.sin(angle[inside]) + chip.height
            np.testing.assert_allclose(thickness, taken, atol=1e-12)
    assert any(chip.gap > 2.5 for chip in forces.chips), (
        "some chip is left by the last tooth but one"
    )


@pytest.mark.parametrize("exit", [math.pi, 2.0, 0.3])
@pytest.mark.parametrize("teeth", [2, 3, 4])
def test_no_run_out_changes_what_is_taken_off(teeth, exit):
    """Of any size, whole multiples of the feed among them: sharp teeth do the same work."""
    random = np.random.default_rng(teeth)
    plain = Forces(Cut(teeth, KT, KR, 0.0, exit), DEPTH, FEED).mean_torque()
    for scale in (0.2, 1.0, 3.0):
        for whole in (False, True):
            out = scale * FEED * random.uniform(-1.0, 1.0, teeth)
            out = np.round(out / FEED) * FEED if whole else out
            cut = Cut(teeth, KT, KR, 0.0, exit, runout=tuple(out.tolist()))
            assert Forces(cut, DEPTH, FEED).mean_torque() == pytest.approx(plain, rel=1e-9)


def test_run_out_alike_is_none_and_moves_the_wall():
    asked = (tip, DEPTH, FEED, 3, KT, KR, 0.0, 2.0, SPEED, DIAMETER)
    plain, out = milled(*asked), milled(*asked, runout=(4e-6, 4e-6, 4e-6))
    assert out.force == pytest.approx(plain.force, rel=1e-12)
    assert out.peak_to_peak == pytest.approx(plain.peak_to_peak, rel=1e-12)
    assert out.most == pytest.approx(plain.most - 4e-6, rel=1e-9)
    half = milled(*asked[:3], 4, *asked[4:], runout=(0.0, 5e-6, 0.0, 5e-6))
    whole = milled(*asked[:3], 4, *asked[4:], runout=(0.0, 5e-6, 0.0, 5e-6 + 1e-11))
    assert half.peak_to_peak == pytest.approx(
        whole.peak_to_peak, rel=1e-4
    )  # a pattern of two and of four


def test_a_rigid_tip_feels_the_forces_of_unlike_teeth():
    """Its vibration is none, by which nothing can be divided."""
    asked = (DEPTH, FEED, 3, KT, KR, 0.0, 2.0, SPEED, DIAMETER)
    found = milled(lambda omega: 0.0 * tip(omega), *asked, runout=OUT)
    stiff = milled(lambda omega: 1e-9 * tip(omega), *asked, runout=OUT)
    assert (found.peak_to_peak == 0.0).all()
    assert found.error == found.departure == 0.0
    assert found.force == pytest.approx(stiff.force, rel=1e-6)
    assert found.most == pytest.approx([-2e-5])


@pytest.mark.parametrize("immersion", [1e-2, 1e-3])
def test_forces_of_a_short_arc_are_seen_where_they_begin(immersion):
    """Down-milling, where the chip is thickest as a straight edge enters: a run-out of next to
    nothing changes nothing."""
    entry = math.acos(2.0 * immersion - 1.0)
    asked = (tip, DEPTH, FEED, 3, KT, KR, entry, math.pi, SPEED, DIAMETER)
    out = milled(*asked, runout=(0.0, 2e-9, 1e-9))
    assert out.force == pytest.approx(milled(*asked).force, rel=2e-3)


def test_an_idle_tooth_is_as_none():
    """Two of three teeth, uneven, of which the feed is that of the pitches."""
    feed, pitches = 1e-4, tuple(np.radians([120.0, 240.0]))
    asked = {"speed": SPEED, "diameter": DIAMETER, "exit": 2.0}
    three = milled(tip, DEPTH, feed, 3, KT, KR, runout=(0.0, 0.0, -1e-3), **asked)
    two = milled(tip, DEPTH, 1.5 * feed, 2, KT, KR, pitch=(pitches[1], pitches[0]), **asked)
    assert three.force == pytest.approx(two.force, rel=1e-9)
    assert three.peak_to_peak == pytest.approx(two.peak_to_peak, rel=1e-9)
    assert three.most == pytest.approx(two.most, rel=1e-9)
    assert Forces(Cut(3, KT, KR, 0.0, 2.0, runout=(0.0, 0.0, -1e-3)), DEPTH, feed).idle == {2}
    assert Forces(Cut(4, KT, KR, 0.0, 2.0, runout=(0.0, -1e-3) * 2), DEPTH, feed).idle == {1}


def operation(teeth, runout=(), pitch=()):
    spec = StabilityLobesSpec(
        *("tip", DIAMETER, teeth, KT, KR),
        immersion=0.9,
        milling="up",
        pitch=pitch,
        feed_per_tooth=FEED,
        cut=PlannedCut(DEPTH, runout=runout),
    )
    return Operation(spec, KT, KR)


@pytest.mark.parametrize(
    ("teeth", "runout", "pitch", "left"),
    [
        (3, (0.0, 0.0, -1e-3), (), (240, 120)),
        (3, (-1e-3, 0.0, 0.0), (100, 120, 140), (220, 140)),
        (3, (-1e-3, 0.0, -1e-3), (), ()),
        (4, (0.0, -1e-3) * 2, (), (180, 180)),
        (4, (-1e-3, 0.0, -1e-3, 0.0), (80, 90, 95, 95), (170, 190)),
        (4, (0.0, -2e-5, 0.0, 1e-5), (80, 90, 95, 95), (80, 90, 95, 95)),
    ],
)
def test_limits_are_those_of_teeth_that_cut(teeth, runout, pitch, left):
    """Where run-out keeps teeth out of the cut, the others take what they leave."""
    found = operation(teeth, runout, tuple(np.radians(pitch))).cut
    assert found.runout == ()
    same = replace(found, teeth=len(left) or 1, pitches=tuple(np.radians(left)))
    assert found.teeth == same.teeth
    turned = [np.roll(found.gaps, k) for k in range(len(found.gaps))]
    assert any(np.allclose(same.gaps, each, rtol=1e-12) for each in turned)


def test_a_cut_with_an_idle_tooth_is_stable_up_to_its_limit(monkeypatch):
    """Over time, with all teeth: a motion from rest settles below the limit, and not above."""
    speed = 2.0 * math.pi * 172.0
    cut, every = operation(3, (0.0, 0.0, -1e-3)).cut, operation(3).cut
    own, other = (
        limit_depth(
            tip, c.teeth, KT, KR, c.entry, c.exit, speed, pitch=c.pitches and tuple(c.pitches)
        )
        for c in (cut, every)
    )
    assert own.depth > 1.2 * other.depth
    monkeypatch.setitem(globals(), "SPEED", speed)
    whole = replace(every, runout=(0.0, 0.0, -1e-3))
    apart = {}
    for share in (0.9, 1.1):
        monkeypatch.setitem(globals(), "DEPTH", share * own.depth)
        one, next_ = (over_time(whole, (0.0, 0.0), 0.0, turns=n)[0] for n in (24, 25))
        apart[share] = np.abs(next_ - one).max() / np.ptp(one)
    assert apart[0.9] < 0.02
    assert apart[1.1] > 0.5


def test_forces_by_a_motion_are_those_of_each_angle():
    """Of chips and flanks, with teeth in cut on a part of their way: products over the revolution,
    tooth by tooth, against those of harmonics."""
    cut = Cut(3, KT, KR, 0.0, 2.4, 0.0, UNEVEN, (0.0, 3e-5, -7e-5))
    forces, rubbing, points = Forces(cut, DEPTH, FEED), 2e5, 1 << 15
    forced = Forced(forces, DIAMETER, SPEED, SPEED * 60.0, rubbing)
    order = np.arange(61.0)
    motion = np.zeros((121, 2), dtype=complex)  # orders from −60 up
    random = np.random.default_rng(1)
    half = random.normal(size=(5, 2)) + 1j * random.normal(size=(5, 2))
    motion[61:66], motion[55:60] = half, half[::-1].conj()
    found = sum(each(motion) for each in _Loop(forced, order, tip(order * SPEED))._loops())

    angle = 2.0 * math.pi * (np.arange(points) + 0.5) / points
    every = np.arange(-60.0, 61.0)

    def at(angle, rate=False):
        turned = np.exp(1j * np.multiply.outer(angle, every)) * (1j * every * SPEED if rate else 1)
        return (turned @ motion).real

    total = np.zeros((points, 2))
    ends = [(chip.tooth, chip.entry, chip.exit, chip.gap) for chip in forces.chips]
    for tooth, entry, leaving, gap in ends:
        own = np.mod(angle + cut.behind[tooth], 2.0 * math.pi)
        inside = (own > entry) & (own < leaving)
        s, c = np.sin(own), np.cos(own)
        away = np.stack([s, c], axis=-1)
        thickness = ((at(angle) - at(angle - gap)) * away).sum(axis=1)
        flank = rubbing * (at(angle, rate=True) * away).sum(axis=1)
        push = np.stack([KT * c + KR * s, KR * c - KT * s], axis=-1) * thickness[:, None]
        total += DEPTH * inside[:, None] * (push + flank[:, None] * away)
    spectrum = (np.exp(-1j * np.multiply.outer(every[50:71], angle)) @ total) / points
    np.testing.assert_allclose(found[50:71], spectrum, atol=2e-4 * np.abs(spectrum).max())


def test_slow_milling_leaves_what_the_force_bends():
    """Far below the modes the tip follows the force: straight edges enter without one, and leave
    the cut of down-milling without a chip; on a helix lower parts of other teeth bend it."""
    stiff = {"speed": 1.0, "diameter": DIAMETER, "highest": 500.0}
    for ends in ((0.0, 1.0), (2.0, math.pi)):
        straight = milled(tip, DEPTH, FEED, 2, KT, KR, *ends, **stiff)
        assert straight.least == pytest.approx(0.0, abs=2e-3 * np.abs(straight.peak_to_peak).max())
    helix = math.atan(0.8 * DIAMETER / 2.0 / DEPTH)
    curved = milled(tip, DEPTH, FEED, 2, KT, KR, 0.0, 1.0, helix=helix, **stiff)
    forces = Forces(Cut(2, KT, KR, 0.0, 1.0, 0.8), DEPTH, FEED)
    error = -forces.at(np.linspace(0.0, 0.8, 200))[:, 1] / STIFF[1]
    assert curved.least[0] == pytest.approx(error.min(), rel=1e-3)
    assert curved.most[0] == pytest.approx(error.max(), abs=1e-3 * abs(error.min()))


def test_process_damping_rubs_by_the_cutting_speed():
    cut = Cut(2, KT, KR, 2.0, math.pi)
    given = DEPTH, FEED, 2, KT, KR, 2.0, math.pi, SPEED, DIAMETER
    found = milled(tip, *given, highest=3000.0, process_damping=3e4)
    rubbing, top = 3e4 / (0.5 * DIAMETER * SPEED), 2.0 * math.pi * 3000.0
    known = Forced(Forces(cut, DEPTH, FEED), DIAMETER, SPEED, top, rubbing).solve(tip, ["down"])
    assert found.peak_to_peak == pytest.approx(known.peak_to_peak)
    assert found.most == pytest.approx(known.most)
    without = milled(tip, *given, highest=3000.0)
    assert np.abs(found.peak_to_peak / without.peak_to_peak - 1.0).max() > 1e-3
    with pytest.raises(InvalidInput, match="process_damping: given -1 N/m; allowed: from 0"):
        milled(tip, *given, process_damping=-1.0)


def test_walls_are_left_where_a_cut_ends_nearly_at_them():
    """π as it is written by hand."""
    known = milled(tip, DEPTH, FEED, 2, KT, KR, 2.0, math.pi, SPEED, DIAMETER)
    for exit in (3.14159, 3.1416):
        found = milled(tip, DEPTH, FEED, 2, KT, KR, 2.0, exit, SPEED, DIAMETER)
        assert found.most == pytest.approx(known.most)
    inside = milled(tip, DEPTH, FEED, 2, KT, KR, 2.0, 3.13, SPEED, DIAMETER)
    assert inside.most.size == 0
    known = milled(tip, DEPTH, FEED, 2, KT, KR, 0.0, 1.0, SPEED, DIAMETER)
    for entry in (-4e-4, 4e-4):
        found = milled(tip, DEPTH, FEED, 2, KT, KR, entry, 1.0, SPEED, DIAMETER)
        assert found.most == pytest.approx(known.most)


def test_largest_force_is_that_of_a_straight_edge_at_its_end():
    """Down-milling: the chip is thickest where the tooth enters."""
    found = milled(tip, DEPTH, FEED, 2, KT, KR, 2.0, math.pi, SPEED, DIAMETER)
    assert found.force == pytest.approx(DEPTH * FEED * math.sin(2.0) * math.hypot(KT, KR), rel=1e-6)


def test_turning_all_by_a_right_angle_turns_the_answer():
    """A tip with the modes of feed and normal exchanged, seen from there: nothing else knows the
    directions."""
    cross = np.array([[0.0, 1.0], [-1.0, 0.0]])

    def other(omega):
        return cross @ tip(omega) @ cross.T

    one = milled(other, DEPTH, FEED, 3, KT, KR, 0.0, 2.0, SPEED, DIAMETER)
    force = Forces(Cut(3, KT, KR, 0.0, 2.0), DEPTH, FEED).harmonics(np.zeros(1))[0].real
    assert one.deflection == pytest.approx(force / STIFF[::-1], rel=1e-12)


def test_more_harmonics_change_nothing(solved, monkeypatch):
    wanted = {"cut": "{depth: 1 mm}", "speeds": "[4000 rpm, 11000 rpm]"}
    usual = lobes(solved(**wanted))
    monkeypatch.setattr(planned_cut, "HARMONICS", 24.0)
    finer = lobes(solved(**wanted))
    near = 2e-3 * usual.tip_vibration.max()
    for name in ("surface_error_most", "tip_vibration"):
        np.testing.assert_allclose(getattr(usual, name), getattr(finer, name), atol=near)


def test_an_edge_that_hardly_lags_is_straight():
    straight, hardly = (
        milled(tip, DEPTH, FEED, 2, KT, KR, 2.0, math.pi, SPEED, DIAMETER, math.radians(helix))
        for helix in (0.0, 1e-12)
    )
    assert hardly.force == pytest.approx(straight.force, rel=1e-9)
    assert hardly.most == pytest.approx(straight.most, rel=1e-9)


def test_vibration_that_takes_teeth_out_of_the_cut(monkeypatch):
    """In a resonance of the pattern of uneven teeth, of which linear forces give nine tenths,
    against the simulation over time."""
    cut = Cut(4, 6e8, 2e8, 0.0, 1.0, 0.0, tuple(np.radians([70.0, 110.0] * 2)))
    for name, value in (("DEPTH", 4 * DEPTH), ("FEED", 2e-5), ("SPEED", 2.0 * math.pi * 450.0)):
        monkeypatch.setitem(globals(), name, value)
    forced = Forced(Forces(cut, DEPTH, FEED), DIAMETER, SPEED, 2.0 * math.pi * 12e3)
    found = forced.solve(tip, ["up"])
    path, largest, _ = over_time(cut, (0.0, 0.0), 0.0, turns=40, steps=2400)
    assert found.error < 1e-3
    assert found.peak_to_peak[0] == pytest.approx(np.ptp(path[:, 0]), rel=5e-3)
    assert found.force == pytest.approx(largest, rel=1e-2)
    order = 2.0 * np.arange(math.ceil(forced.top / (2.0 * SPEED)) + 1.0)
    own = tip(order * SPEED)
    force = _Loop(forced, order, own).solve(forced.forces.harmonics(order))
    moved = np.einsum("kij,kj->ki", own, force)[:, 0]
    linear = np.ptp(np.fft.irfft(moved, 1024) * 1024)
    assert linear / found.peak_to_peak[0] == pytest.approx(0.908, abs=0.01)
    assert found.departure > 0.09


def test_shorter_steps_settle_what_whole_ones_do_not_and_the_best_is_kept(monkeypatch):
    """Towards a limit; the change is relative to the vibration as it is, here less than the linear
    one."""
    pitch = tuple(np.radians([60.0, 75.0, 105.0, 120.0]))
    cut = (4, 7e8, 2e8, 0.0, 1.2, 1250.0)
    limit = limit_depth(tip, *cut, pitch=pitch).depth
    found = milled(tip, 0.8 * limit, FEED, *cut, DIAMETER, pitch=pitch)
    assert found.error < 1e-3
    assert 0.6 < found.departure < 0.7
    sharp = Forces(Cut(*cut[:-1], pitches=pitch), 0.8 * limit, FEED).mean_torque()
    assert found.torque == pytest.approx(0.5 * DIAMETER * sharp, rel=1e-12), "they do the same work"
    last = milled(tip, 0.95 * limit, FEED, *cut, DIAMETER, pitch=pitch)
    monkeypatch.setattr(forced_vibration, "ROUNDS", 1)
    first = milled(tip, 0.95 * limit, FEED, *cut, DIAMETER, pitch=pitch)
    assert last.error <= first.error


def test_flanks_of_teeth_that_leave_the_work_push_by_their_velocity():
    """Forces of a motion that is given, of teeth that run out and partly leave, and what they have
    beyond those of unmoved ends: angle by angle, a straight edge with what the deepest left."""
    cut = Cut(3, KT, KR, 0.0, 2.4, 0.0, UNEVEN, (0.0, 3e-5, -7e-5))
    contact = Contact(Forces(cut, DEPTH, FEED, KTE, KRE), SPEED, 4e3)
    order, random = np.arange(21.0), np.random.default_rng(2)
    moved = np.zeros((21, 2), dtype=complex)
    moved[1:5] = 1e-5 * (random.normal(size=(4, 2)) + 1j * random.normal(size=(4, 2)))

    def at(angle, by=1.0):
        return (2.0 * np.exp(1j * np.multiply.outer(angle, order)) @ (by * moved)).real

    angle = 2.0 * math.pi * (np.arange(2000) + 0.5) / 2000
    rate = at(angle, 1j * order[:, None] * SPEED)
    total, linear = np.zeros((2, 2000, 2))
    for tooth in range(3):
        own = np.mod(angle + cut.behind[tooth], 2.0 * math.pi)
        away = np.stack([np.sin(own), np.cos(own)], axis=-1)
        along = np.stack([away[:, 1], -away[:, 0]], axis=-1)

        def push(cuts, thick, away=away, along=along):
            radial = KR * thick + KRE + 4e3 * (rate * away).sum(axis=1)
            whole = (KT * thick + KTE)[:, None] * along + radial[:, None] * away
            return DEPTH * cuts[:, None] * whole

        left, gap = [], 0.0
        for k in range(3):
            gap += UNEVEN[tooth - k]
            out = cut.runout[tooth] - cut.runout[tooth - k - 1]
            chip = 3.0 * FEED * gap / (2.0 * math.pi) * away[:, 0] + out
            left.append(chip + ((at(angle) - at(angle - gap)) * away).sum(axis=1))
            for one in contact.forces.chips:
                if one.tooth == tooth and abs(one.gap - gap) < 1e-9:
                    linear -= push((own > one.entry) & (own < one.exit), left[-1])
        thick = np.min(left, axis=0)
        total -= push((own > cut.entry) & (own < cut.exit) & (thick > 0.0), thick)
    beyond = contact.of(order, moved)
    np.testing.assert_allclose(beyond.over, total - linear, atol=1e-9 * np.abs(total).max())
    assert np.abs(beyond.over).max() > 0.1 * np.abs(total).max()
    found = contact.largest(order, moved, beyond)
    assert found == pytest.approx(np.hypot(*total.T).max(), rel=1e-9)


def test_vibration_that_does_not_settle_is_not_taken_for_right():
    """Next to the limit, where linear forces make it 36 times as large as the feed."""
    pitch = tuple(np.radians([60.0, 75.0, 105.0, 120.0]))
    cut = (4, 7e8, 2e8, 0.0, 1.2, 1250.0)
    depth = 0.98 * limit_depth(tip, *cut, pitch=pitch).depth
    found = milled(tip, depth, FEED, *cut, DIAMETER, pitch=pitch)
    assert found.error > 0.01
    assert np.isfinite(found.peak_to_peak).all()


def test_forced_vibration_grows_without_bound_towards_a_fold():
    """There vibration repeats with the pattern of the teeth, as the forces do: the depth at which
    1/vibration is zero is the limit of stability, which another solver finds."""
    pitch = tuple(np.radians([60.0, 75.0, 105.0, 120.0]))
    cut = (4, 7e8, 2e8, 0.0, 1.2, 1250.0)
    limit = limit_depth(tip, *cut, pitch=pitch)
    assert limit.kind == "fold"
    depths = limit.depth * np.array([0.99, 0.995])
    stiff = []
    for depth in depths:  # of teeth that never leave the cut
        forces = Forces(Cut(4, 7e8, 2e8, 0.0, 1.2, pitches=pitch), depth, FEED)
        forced = Forced(forces, DIAMETER, 1250.0, 2.0 * math.pi * 10e3)
        order = np.arange(math.ceil(forced.top / 1250.0) + 1.0)
        own = tip(order * 1250.0)
        force = _Loop(forced, order, own).solve(forces.harmonics(order))
        stiff.append(depth / np.abs(np.einsum("kij,kj->ki", own, force)).max())
    there = depths[0] + np.diff(depths)[0] * stiff[0] / (stiff[0] - stiff[1])
    assert there == pytest.approx(limit.depth, rel=1e-4)


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"depth": 0.0}, "depth: given 0; allowed: above 0"),
        ({"feed_per_tooth": -1e-4}, "feed_per_tooth: given -0.0001; allowed: above 0"),
        ({"helix": 2.0}, "helix: given 114.592°"),
        ({"entry": 2.0, "exit": 1.0}, "entry and exit"),
        ({"speed": 1e-4}, "harmonics of the teeth in the band"),
        ({"runout": (1e-6,)}, r"runout: given \(1e-06,\); allowed: one for each of 2 teeth"),
        ({"runout": (1e-6, math.nan)}, "runout must be numbers"),
    ],
)
def test_cuts_that_there_are_not(given, why):
    with pytest.raises(InvalidInput, match=why):
        milled(**{"receptance": tip, "depth": DEPTH, "feed_per_tooth": FEED, **given})


ASKED = {
    "point": "tip",
    "teeth": 2,
    "diameter": "40 mm",
    "tangential": "600 MPa",
    "radial": "200 MPa",
    "milling": "down",
    "immersion": 0.4,
    "feed_per_tooth": "0.15 mm",
    "max_frequency": "3000 Hz",
    "method": "zero-order",
    "speeds": "{from: 3000 rpm, to: 18000 rpm, step: 2500 rpm}",
}
RPM = np.arange(3000.0, 18001.0, 2500.0)
MACHINE = """
title: A shaft on springs
spindle:
  title: A shaft
  shaft:
    start: 0 mm
    material: {name: steel, young_modulus: 210 GPa, density: 7850 kg/m^3, poisson_ratio: 0.3}
    sections: [{length: 400 mm, outer_diameter: 40 mm}]
  points: {tip: 0 mm}
  supports:
    - name: front
      x: 100 mm
      stiffness: {yy: 1e8 N/m, zz: 6e7 N/m}
      damping: {yy: 900 N s/m, zz: 900 N s/m}
    - name: rear
      x: 350 mm
      stiffness: {yy: 1e8 N/m, zz: 1e8 N/m}
      damping: {yy: 900 N s/m, zz: 900 N s/m}
speeds: [9000 rpm, 18000 rpm]
analyses:
"""
TEETH = ", ".join(f"{each} Hz" for each in (0.1, *range(300, 12_001, 300)))  # pass at 9000 rpm
TABLE = (
    "stiffness: {yy: 1e8 N/m, zz: 6e7 N/m}",
    (
        "speeds: [0 rpm, 18000 rpm]\n"
        "      stiffness: {yy: [1e8 N/m, 3e7 N/m], zz: [6e7 N/m, 2e7 N/m]}"
    ),
)
FRF = f"""  frf:
    frequencies: [{TEETH}]
    matrix: {{responses: [tip.y, tip.z], excitations: [tip.y, tip.z]}}
"""


@pytest.fixture
def solved(tmp_path):
    def run(further="", changed=("", ""), **given):
        asked = {**ASKED, **given}
        lines = "".join(f"    {key}: {value}\n" for key, value in asked.items())
        path = tmp_path / "case.yaml"
        path.write_text(
            MACHINE.replace(*changed) + "  stability_lobes:\n" + lines + further, encoding="utf-8"
        )
        return solve(rotordyn.load(path)).results

    return run


def lobes(results: Any) -> Any:
    return results["stability_lobes"]


def test_a_planned_cut_is_that_of_the_receptances_of_the_machine(solved):
    """Those of the analysis frf at 9000 rpm, at whole multiples of the frequency of the teeth;
    harmonics of the force by FFT. Teeth turn from the normal y to the feed z."""
    found = solved(FRF, TABLE, cut="{depth: 2 mm}", speeds="[4500 rpm, 9000 rpm]", helix="20 deg")
    own, frf = lobes(found), found["frf"]
    lag = 2.0 * 2e-3 * math.tan(math.radians(20.0)) / 0.04
    entry = math.acos(2.0 * 0.4 - 1.0)
    forces = Forces(Cut(2, 6e8, 2e8, entry, math.pi, lag), 2e-3, 1.5e-4)
    angle = math.pi * np.arange(4096) / 4096  # from tooth to tooth
    over = forces.at(angle)[:, 1::-1]  # normal y, feed z
    spectrum = np.fft.rfft(over, axis=0)[:41] / len(angle)
    response = frf.response[0].reshape(2, 2, -1)  # of 9000 rpm
    moved = np.einsum("ijk,kj->ki", response, spectrum)
    mean = moved[0].real
    wall = math.pi + np.linspace(0.0, lag, 30)
    order = 2.0 * np.arange(41.0)
    twice = np.where(order > 0.0, 2.0, 1.0) * moved[:, 0]
    error = (np.exp(1j * wall[:, None] * order) @ twice).real
    near = 5e-3 * np.abs(error).max()
    assert own.tip_deflection[1] == pytest.approx(mean[::-1], rel=2e-3)
    assert own.surface_error_least[1, 0] == pytest.approx(error.min(), abs=near)
    assert own.surface_error_most[1, 0] == pytest.approx(error.max(), abs=near)
    assert own.wall == ("down",)
    assert own.planned_depth == 2e-3
    assert own.cutting_power[1] == pytest.approx(6e8 * 0.4 * 0.04 * 2e-3 * 1.5e-4 * 300.0, rel=1e-9)


def test_without_a_cut_there_is_none_and_above_the_limit_it_is_not_stable(solved):
    none = lobes(solved())
    assert none.milling_speed.size == none.surface_error_most.size == 0
    assert math.isnan(none.planned_depth)
    assert not any("surface" in line for line in summary(none))
    deep = float(np.median(none.depth)) * 1.0001
    some = lobes(solved(cut=f"{{depth: {deep} m}}"))
    assert (some.cut_is_stable == (none.depth > deep)).all()
    assert 0 < some.cut_is_stable.sum() < len(RPM)
    lost = ~some.cut_is_stable
    every = ("surface_error_most", "tip_vibration", "cutting_force", "cutting_power")
    for name in (*every, "planned_removal"):
        missing = np.isnan(getattr(some, name)).reshape(len(RPM), -1).all(axis=1)
        assert (missing == lost).all(), name
    first = f"{RPM[lost.argmax()]:.0f} rpm"
    told = [each for each in warnings(some) if "the planned cut of" in each]
    assert len(told) == 1
    assert f"is not stable at {lost.sum()} of 7 speeds, first at {first}" in told[0]
    everywhere = lobes(solved(cut="{depth: 500 mm}"))
    assert "stable at none of 7 speeds" in "\n".join(summary(everywhere))


def test_words_numbers_and_figure(solved):
    found = lobes(solved(cut="{depth: 0.1 mm}", milling="slot", immersion=1.0))
    told = "\n".join(summary(found)).replace("\xa0", " ")
    assert "cut        0.100 mm deep, 0.15 mm per tooth: stable at all 7 speeds" in told
    assert "up-milled wall" in told
    assert "down-milled wall" in told
    named = {number.name: number.value for number in numbers(found, None)}  # type: ignore[arg-type]
    ends = np.abs([found.surface_error_least, found.surface_error_most])
    assert named["surface error"] == pytest.approx(ends.max() * 1e6, rel=1e-9)
    assert named["cutting power"] == pytest.approx(found.cutting_power.max() / 1e3, rel=1e-9)
    # area of the cut by the feed rate: 0.1 mm · 40 mm · 2 · 0.15 mm · 300 /s of the fastest
    assert named["planned removal"] == pytest.approx(0.1 * 40.0 * 0.3 * 300.0 * 60e-3, rel=1e-9)
    assert found.planned_removal == pytest.approx(1e-9 * 1.2 * RPM / 60.0)
    assert "removes up to 21.6 cm³/min" in told
    figure = surface_figure(found)
    words = [each.get_text() for each in figure.findobj(lambda one: hasattr(one, "get_text"))]
    assert "up-milled wall" in words
    assert "vibration in normal, peak to peak" in words
    # 2500 rpm are wider than the resonances of 1 to 3 percent damping
    (told,) = (each for each in warnings(found) if "too far apart for the resonances" in each)
    width = found.resonance_width[:-1] * found.milling_speed[1:]
    step = width[width > 0.0].min() / 8.0 * 30.0 / math.pi
    assert float(re.findall(r"steps of ([\d.]+) rpm", told)[0]) == pytest.approx(step, rel=6e-3)


def test_resonances_are_as_wide_as_twice_a_damping_ratio(solved):
    """One of those in the Campbell diagram, which a multiple of the frequency of teeth meets."""
    further = "  campbell: {max_frequency: 3000 Hz}\n"
    found = solved(further, cut="{depth: 1 mm}", speeds="[9000 rpm, 11000 rpm, 11100 rpm]")
    ratio, width = found["campbell"].damping_ratio[0], lobes(found).resonance_width
    near = np.abs(2.0 * ratio / width[0] - 1.0)
    assert near.min() < 1e-3
    order = found["campbell"].frequency[0, near.argmin()] / (np.array([9000.0, 11000.0]) / 30.0)
    assert math.floor(order[0]) > math.floor(order[1])
    assert (width[1:] == 0.0).all()
    assert "from 9000 rpm to 11000 rpm" in " ".join(warnings(lobes(found)))
    for wide, told in ((1.08, True), (1.10, False)):  # 2000 rpm are 0.182 of 11 000, 1/6 of 1.09
        as_wide = replace(lobes(found), resonance_width=np.array([wide, 0.0, 0.0]))
        assert any("too far apart for the resonances" in w for w in warnings(as_wide)) == told


def test_the_step_that_is_advised_finds_the_largest_error(solved):
    """Within 2 % of that in steps a sixth as long, wherever they begin; those of a third of the
    width, which are warned of, lose four times as much."""

    def run(step):
        speeds = [f"{rpm:.6g} rpm" for rpm in np.arange(13200.0, 13801.0, step)]
        found = lobes(solved(cut="{depth: 0.2 mm}", speeds=f"[{', '.join(speeds)}]"))
        ends = np.abs([found.surface_error_least, found.surface_error_most]).max(axis=(0, 2))
        told = [each for each in warnings(found) if "too far apart for the resonances" in each]
        return ends, [float(re.findall(r"steps of ([\d.]+) rpm", each)[0]) for each in told]

    _, (advised,) = run(64.0)
    fine, none = run(advised / 6.0)
    assert none == []
    largest, away = fine.max(), {}
    for every in (6, 16):
        away[every] = max(1.0 - fine[k::every].max() / largest for k in range(every))
    assert away[6] < 0.02 < 0.07 < away[16]


def test_teeth_that_pass_faster_than_any_mode_meet_none(solved):
    found = lobes(solved(cut="{depth: 1 um}", teeth=80, speeds="[3000 rpm, 6000 rpm]"))
    assert found.cut_is_stable.all()
    assert (found.resonance_width == 0.0).all()
    assert not any("too far apart for the resonances" in each for each in warnings(found))


def test_errors_that_cut_too_deep_count_by_their_amount(solved):
    found = lobes(solved(cut="{depth: 1 mm}", speeds="[3000 rpm, 5500 rpm]"))
    below = replace(
        found,
        surface_error_least=np.array([[-9e-6], [-2e-6]]),
        surface_error_most=np.array([[-8e-6], [4e-6]]),
    )
    named = {number.name: number.value for number in numbers(below, None)}  # type: ignore[arg-type]
    assert named["surface error"] == pytest.approx(9.0)
    curves = {each.figure: each.y for each in headline_curves(None, Shown("", below, (), None))}
    assert curves["milled_surface"] == pytest.approx([-9.0, 4.0])
    (told,) = (line for line in summary(below) if line.startswith("surface"))
    assert "largest -9.00 to -8.00 µm at 3000 rpm" in told.replace("\xa0", " ")


def test_values_of_a_vibration_that_does_not_settle_are_no_headline_numbers(solved):
    found = lobes(solved(cut="{depth: 1 mm}", speeds="[3000 rpm, 5500 rpm]"))
    for error, known in ((5e-3, True), (2e-2, False)):
        restless = replace(found, vibration_error=np.array([0.0, error]))
        named = {number.name: number for number in numbers(restless, None)}  # type: ignore[arg-type]
        for name in ("surface error", "cutting power"):
            assert math.isfinite(named[name].value) == known
            assert known or named[name].absent == "not converged"


def test_unlike_stable_speeds_are_not_compared(solved):
    """A machine that loses stability where errors are largest would look better."""
    found = lobes(solved(cut="{depth: 1 mm}"))
    lost = found.cut_is_stable.copy()
    lost[2] = False
    some = replace(found, cut_is_stable=lost)
    named = {number.name: number for number in numbers(some, None)}  # type: ignore[arg-type]
    for name in ("surface error", "cutting power", "planned removal"):
        assert math.isnan(named[name].value)
        assert named[name].absent == "not stable"
    unsolved = replace(some, depth=np.where(lost, found.depth, np.nan))
    named = {number.name: number for number in numbers(unsolved, None)}  # type: ignore[arg-type]
    assert named["surface error"].value > 0.0
    shaded = [
        patch
        for axes in surface_figure(some).axes
        for patch in axes.patches
        if patch.get_label() == "cut not stable, or not solved"
    ]
    assert len(shaded) == 2
    low, high = shaded[0].get_x(), shaded[0].get_x() + shaded[0].get_width()
    assert (low, high) == pytest.approx((6750.0, 9250.0))


def test_a_cut_that_the_band_does_not_hold_is_warned_of(solved):
    found = lobes(solved(cut="{depth: 1 mm}"))
    least = np.where(np.arange(len(RPM)) < 2, 0.9e-3, found.depth)
    told = [each for each in warnings(replace(found, least=least)) if "whole band" in each]
    assert len(told) == 1
    assert "at 2 of 7 speeds, first at 3000 rpm" in told[0]
    assert not any("whole band" in each for each in warnings(found))


def test_a_cut_that_the_measured_spindle_does_not_hold_is_warned_of(solved):
    """Of the speeds at which the computed machine has it stable."""
    found = lobes(solved(cut="{depth: 1 mm}"))
    few = np.where(np.arange(len(RPM)) < 3, 1e-3, 1.001e-3)
    stable = np.arange(len(RPM)) > 0
    some = replace(found, measured=few, cut_is_stable=stable, depth=np.where(stable, 2e-3, 0.5e-3))
    (told,) = (each for each in warnings(some) if "on the measured spindle" in each)
    assert (
        f"at 2 of the 6 speeds at which it is on the machine as computed, first at {RPM[1]:.0f}"
        in told
    )
    assert not any("measured spindle" in each for each in warnings(found))


def test_a_wall_that_varies_has_both_ends_and_teeth_that_leave_the_work_are_said(solved):
    found = lobes(solved(cut="{depth: 4 mm}", helix="40 deg", speeds="[3000 rpm]"))
    least, most = found.surface_error_least[0, 0] * 1e6, found.surface_error_most[0, 0] * 1e6
    (told,) = (line for line in summary(found) if line.startswith("surface"))
    ends = re.findall(r"-?[\d.]+", told.replace("\xa0", " "))[:2]
    assert [float(each) for each in ends] == pytest.approx([least, most], abs=0.01)
    assert not any("teeth lose contact" in each for each in warnings(found))
    near = 1.3 * 4e-3  # a margin of 0.3 to the limit
    for field, value, depth, told in (
        ("contact_departure", 0.3, 8e-3, 1),
        ("contact_departure", 0.2, 8e-3, 0),
        ("contact_departure", 0.2, near, 1),
        ("contact_departure", 0.1, near, 0),
        ("vibration_error", 0.02, 8e-3, 1),
    ):
        lost = replace(found, **{field: np.array([value]), "depth": np.array([depth])})
        said = ["teeth lose contact at 1 of 1 speeds" in each for each in warnings(lost)]
        assert sum(said) == told, (field, value, depth)


def test_run_out_of_a_case(solved):
    """In proportion, as deep as the longest tooth, and what is said of teeth without a chip."""
    plain = lobes(solved(cut="{depth: 1 mm}"))
    found = lobes(solved(cut="{depth: 1 mm, runout: [3 um, -2 um]}"))
    assert found.idle_teeth == plain.idle_teeth == 0
    swing = found.tip_vibration[0, 1]
    assert found.surface_error_most[0, 0] == pytest.approx(-3e-6, abs=swing)
    assert found.surface_error_most[0, 0] < plain.surface_error_most[0, 0] - 2e-6
    assert not any("run-out" in each for each in warnings(found))
    found = lobes(solved(cut="{depth: 1 mm, runout: [0 um, -0.2 mm]}"))
    assert found.idle_teeth == 1
    assert sum("by run-out 1 tooth removes no material" in each for each in warnings(found)) == 1
    pairs = lobes(solved(cut="{depth: 1 mm, runout: [0 um, -0.2 mm, 0 um, -0.2 mm]}", teeth=4))
    assert pairs.idle_teeth == 2
    assert any("2 teeth remove no material" in each for each in warnings(pairs))
    alone = lobes(solved(cut="{depth: 1 mm}", teeth=1))
    np.testing.assert_allclose(found.depth, alone.depth, rtol=1e-9)
    assert (np.abs(found.depth / plain.depth - 1.0) > 0.1).any()
    with pytest.raises(InvalidInput, match=r"cut\.runout: given 3 in number; allowed: 2"):
        solved(cut="{depth: 1 mm, runout: [1 um, 2 um, 3 um]}")


LOSSY = "  points:", "  damping: {loss_factor: 0.02}\n  points:"


@pytest.mark.parametrize(
    ("changed", "dull"), [(("", ""), 50.0), pytest.param(LOSSY, 100.0, marks=pytest.mark.long)]
)
def test_edge_forces_that_may_let_a_cut_chatter_are_warned_of(solved, changed, dull):
    """Blunt edges next to the limit, not sharp ones however near; a machine whose receptance is no
    sum of modes, too; then there are no headline numbers."""
    least = lobes(solved(changed=changed)).depth.min()
    for share, edge, told in ((0.85, dull, 1), (0.98, 0.1, 0), (0.8, 0.1, 0), (0.8, 150.0, 1)):
        depth = 1e3 * share * least
        cut = f"{{depth: {depth:.6g} mm, radial_edge: {edge} N/mm}}"
        found = lobes(solved(changed=changed, cut=cut))
        assert found.edges_chatter.any() == bool(told)
        said = [each for each in warnings(found) if "edge forces follow the vibration" in each]
        assert len(said) == told
        error = next(each for each in numbers(found, None) if each.name == "surface error")
        assert np.isnan(error.value) == bool(told)
    assert f"at {found.edges_chatter.sum()} of 7 speeds" in said[0]
    assert error.absent == "not converged"


def test_edges_and_process_damping_of_a_case_reach_the_planned_cut():
    spec = StabilityLobesSpec(
        *("tip", 0.05, 3, 6e8, 2e8),
        process_damping=3e4,
        feed_per_tooth=2e-4,
        cut=PlannedCut(1e-3, KTE, KRE, (1e-6, 0.0, 2e-6)),
    )
    found = Operation(spec, 6e8, 2e8).forced(200.0, 1e4)
    assert found.rubbing == pytest.approx(3e4 / (200.0 * 0.025))
    assert (found.forces.tangential, found.forces.radial) == (KTE, KRE)
    assert (found.forces.depth, found.forces.feed) == (1e-3, 2e-4)
    assert found.forces.cut.runout == (1e-6, 0.0, 2e-6)
    pushed = Operation(spec, 6e8, 2e8).pushed(200.0).cut
    by_radian = 2e-4 * 3 / (2.0 * np.pi)
    assert pushed.edges == pytest.approx((0.5 * KTE / by_radian, 0.5 * KRE / by_radian))


def test_a_planned_cut_beside_turning_is_refused():
    with pytest.raises(InvalidInput, match="cut: of milling: given beside turning"):
        StabilityLobesSpec("tip", diameter=0.05, turning=Turning(2e9), cut=PlannedCut(1e-3))
