"""Chatter by edge forces whose contact begins and ends as the vibration moves it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.stability_lobes import cutting
from rotordyn.analyses.stability_lobes.as_modes import as_modes
from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.modal_limit import Limit, Process, modal_limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.sampling import resolving
from rotordyn.analyses.stability_lobes.spec import FLIP, HOPF, NONE, PlannedCut, StabilityLobesSpec
from rotordyn.analyses.stability_lobes.tip import Tip
from tests.oracles.milling_floquet import Machine
from tests.oracles.uneven_milling import UnevenMilling
from tests.verification import test_milled_surface as surface

MACHINE = Machine(((811.0, 0.028, 1.1e7, (1.0, 0.2)), (1190.0, 0.028, 7.1e6, (-0.2, 1.0))))
FEED, SPEED = 1e-4, 1330.0
ENDS = {"up": (0.0, 0.85), "down": (math.pi - 0.85, math.pi), "slot": (0.0, math.pi)}


def with_edges(cut, tangential, radial):
    feed = FEED * cut.teeth / (2.0 * math.pi)
    return replace(cut, edges=(tangential / feed, radial / feed))


def limit(cut, speed, receptance=MACHINE.receptance):
    omega, top = resolving(receptance)
    return modal_limit(as_modes(receptance, omega), top, Process(cut, cut.turn / speed)).depth


@dataclass(frozen=True)
class Pushed(UnevenMilling):
    """With a jump of the edge force where a tooth enters or leaves at a normal to the feed."""

    edges: tuple[float, float] = (0.0, 0.0)

    def means(self, low, high, lag):
        found = super().means(low, high, lag)
        for end in (self.entry, self.exit):
            if abs(math.sin(end)) < 1e-9:
                for turn in (-1, 0, 1):
                    at = end + 2.0 * math.pi * turn + 1e-12
                    here = (low <= at) & (at < high)
                    matrix = np.array([[0.0, self.edges[0]], [0.0, self.edges[1]]]) / FEED
                    found += np.where(here, 1.0 / (high - low), 0.0)[:, None, None] * matrix
        return found


@pytest.mark.parametrize("way", ENDS)
@pytest.mark.parametrize("edges", [(0.0, 2e4), (2.5e4, 0.0), (1.5e4, 2e4)])
def test_limits_are_those_of_steps_in_time(way, edges, monkeypatch):
    """Evenly spaced teeth, forces at the end of the cut: distributed forces tend to these."""
    entry, exit = ENDS[way]
    monkeypatch.setattr(cutting, "SPREAD", 0.01)
    plain = Cut(3, 4.1e8, 1e8, entry, exit)
    depth = limit(with_edges(plain, *edges), SPEED)
    pitches = (2.0 * math.pi / 3.0,) * 3
    truth = Pushed(MACHINE, pitches, 4.1e8, 1e8, entry, exit, SPEED, edges=edges)
    assert truth.radius(0.97 * depth, 720) < 1.0 < truth.radius(1.03 * depth, 720)
    assert abs(depth / limit(plain, SPEED) - 1.0) > 0.05


def test_how_far_they_are_spread_hardly_matters(monkeypatch):
    cut = with_edges(Cut(3, 4.1e8, 1e8, *ENDS["down"]), 1.5e4, 2e4)
    usual = limit(cut, SPEED)
    monkeypatch.setattr(cutting, "SPREAD", 0.01)
    assert usual == pytest.approx(limit(cut, SPEED), rel=0.02)


@pytest.mark.parametrize("lag", [0.0, 0.02])
@pytest.mark.parametrize("ends", [(0.0, 0.03), (math.pi - 0.03, math.pi)])
def test_arcs_shorter_than_the_spread_hold_the_whole_force(ends, lag):
    """Over a pitch every end of contact has its jump once; it is linear over each piece."""
    cut = Cut(3, 0.0, 0.0, *ends, lag, edges=(3.0, 5.0))
    low, high = np.array(cut.pieces()).T
    sum_of_it = np.einsum("n,nij->ij", high - low, cut.matrix(0.5 * (low + high)))
    np.testing.assert_allclose(sum_of_it * cut.turn, [[0.0, 3.0], [0.0, 5.0]], rtol=1e-12)


def test_uneven_teeth_each_have_their_feed():
    """Pitches next to even ones, and the mean over a turn of what the ends add."""
    plain = Cut(3, 4.1e8, 1e8, *ENDS["slot"])
    even = with_edges(plain, 1.5e4, 2e4)
    third = 2.0 * math.pi / 3.0
    near = replace(even, pitches=(third + 1e-6, third, third - 1e-6))
    assert limit(near, SPEED) == pytest.approx(limit(even, SPEED), rel=1e-6)
    uneven = replace(even, pitches=tuple(np.radians([100.0, 120.0, 140.0])))
    for lag in (0.0, 0.4):
        own = replace(uneven, lag=lag)
        angle = 2.0 * math.pi * (np.arange(200_000) + 0.5) / 200_000
        each = own.by_gap(angle).mean(axis=1) - replace(own, edges=(0.0, 0.0)).by_gap(angle).mean(
            axis=1
        )
        feed = FEED * 3.0 * np.radians([100.0, 120.0, 140.0]) / (2.0 * math.pi)
        for k, f in enumerate(feed):
            expected = 2.0 * np.array([[0.0, 1.5e4], [0.0, 2e4]]) / f / (2.0 * math.pi)
            np.testing.assert_allclose(each[k], expected, rtol=1e-3, atol=1e-3 * expected.max())
            some = angle[::499]
            np.testing.assert_allclose(own.by_gap(some, k), own.by_gap(some)[k])


def test_edges_do_not_matter_where_chips_begin_and_end_thick():
    cut = Cut(3, 4.1e8, 1e8, 0.5, 2.0)
    assert limit(with_edges(cut, 1.5e4, 2e4), SPEED) == limit(cut, SPEED)


@pytest.mark.long
def test_over_time_a_cut_chatters_next_to_the_limit_that_is_requested(monkeypatch):
    """With teeth that cut behind the normal, too, where vibration takes them there, and of any
    tooth what those before it left: half of what both ways would give limits the depth."""
    speed, edge = 2.0 * math.pi * 172.0, 6e4
    spec = StabilityLobesSpec(
        *("tip", surface.DIAMETER, 3, surface.KT, surface.KR),
        immersion=0.2,
        milling="down",
        feed_per_tooth=FEED,
        cut=PlannedCut(1e-3, 0.0, edge),
    )
    process = Operation(spec, surface.KT, surface.KR).pushed(speed)
    omega, top = resolving(surface.tip)
    depth = modal_limit(as_modes(surface.tip, omega), top, process).depth
    monkeypatch.setattr(surface, "SPEED", speed)
    free = Cut(3, surface.KT, surface.KR, process.cut.entry, math.pi + 0.5, runout=(0.0,) * 3)
    moved = {}
    for share, pushed in ((0.85, edge), (1.1, edge), (1.1, 0.0)):
        monkeypatch.setattr(surface, "DEPTH", share * depth)
        one, other = (surface.over_time(free, (0.0, pushed), 0.0, turns=n)[0] for n in (40, 41))
        moved[share, pushed] = np.abs(other - one).max() / np.ptp(one)
    assert moved[0.85, edge] < 0.02
    assert moved[1.1, edge] > 0.1
    assert moved[1.1, 0.0] < 1e-3


def test_a_cut_whose_period_doubles_with_edges_both_ways_is_warned_of(tmp_path):
    """Over time the walls of this slot alternate; with half of the edge forces, or less depth,
    nothing doubles."""
    path = tmp_path / "slot.yaml"
    path.write_text(SLOT, encoding="utf-8")
    case = rotordyn.load(path)
    for depth, warned in ((0.01726, True), (0.0096, False)):
        found = rotordyn.run(case.vary({"analyses.stability_lobes.cut.depth": f"{depth} mm"}))
        assert bool(found["stability_lobes"].cut_is_stable[0])
        assert any("edge forces follow" in each for each in found.warnings) == warned


def test_edge_forces_both_ways_are_asked_for_period_doubling_at_the_depth_itself(
    tmp_path, monkeypatch
):
    """Those one way for any chatter, somewhat deeper."""
    asked, stable = [], Limits.stable

    def seen(limits, process, depth, kind=NONE):
        edge = process(float(limits.speed[0])).cut.edges[0]
        asked.append((edge, kind, *depth.tolist()))
        return stable(limits, process, depth, kind)

    monkeypatch.setattr(Limits, "stable", seen)
    path = tmp_path / "slot.yaml"
    path.write_text(SLOT, encoding="utf-8")
    rotordyn.run(rotordyn.load(path))
    (half, _, deeper), (whole, _, own) = asked[-2:]
    assert [kind for _, kind, _ in asked[-2:]] == [NONE, FLIP]
    assert whole == pytest.approx(2.0 * half)
    assert own == pytest.approx(0.01726e-3)
    assert deeper == pytest.approx(1.1 * own)


def test_no_period_doubles_below_the_limit_nor_where_that_is_of_another_kind(monkeypatch):
    """Of a receptance that is no sum of modes, whose least limit alone is known."""
    known = [Limit(2e-3, 900.0, HOPF), Limit(2e-3, 900.0, FLIP), Limit(5e-3, 900.0, FLIP)]
    monkeypatch.setattr(Tip, "modes", None)
    monkeypatch.setattr(Tip, "tops", np.ones(3))
    monkeypatch.setattr(Limits, "_sampled_limit", lambda own, tip, row, cut: known[row])
    limits = Limits(Tip(None, "nose", 0.0, 1e4), np.arange(3), np.ones(3))
    depth = np.full(3, 3e-3)
    assert limits.stable(lambda speed: None, depth).tolist() == [False, False, True]
    assert limits.stable(lambda speed: None, depth, FLIP).tolist() == [True, False, True]


SLOT = """\
spindle: deep_groove_rear
conditions: {kinematics: hybrid, moment_sharing: equal}
speeds: [0 rpm, 9600 rpm]
analyses:
  stability_lobes:
    point: nose
    teeth: 4
    diameter: 20 mm
    tangential: 600 MPa
    radial: 200 MPa
    milling: slot
    feed_per_tooth: 0.02874 mm
    workpiece_modes:
      - {frequency: 1197.82 Hz, damping: 3.615 %, stiffness: 0.12249 N/um, direction: 0 deg}
      - {frequency: 1354.05 Hz, damping: 3.528 %, stiffness: 0.2687 N/um, direction: 90 deg}
      - {frequency: 775.97 Hz, damping: 3.179 %, stiffness: 0.07528 N/um, direction: 0 deg}
    cut: {depth: 0.01726 mm, tangential_edge: 10.3 N/mm, radial_edge: 30.5 N/mm}
    max_frequency: 2500 Hz
    speeds: [8261.2 rpm]
"""
