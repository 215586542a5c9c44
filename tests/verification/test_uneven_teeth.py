"""Limits of cutters with uneven pitch against the time domain, and against even pitch."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.stability_lobes import limit_depth
from rotordyn.analyses.stability_lobes.as_modes import as_modes
from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.analyses.stability_lobes.limit import sampled_limit
from rotordyn.analyses.stability_lobes.modal_limit import Process, modal_limit
from rotordyn.analyses.stability_lobes.sampling import peaks, resolving
from rotordyn.errors import InvalidInput
from tests.oracles.milling_floquet import Machine
from tests.oracles.random_milling import random_milling
from tests.oracles.uneven_milling import UnevenMilling

MACHINE = Machine(((600.0, 0.03, 8e6, (1.0, 0.0)), (750.0, 0.02, 6e6, (0.3, 0.9))))
FORCES = (9e8, 3e8)
PITCHES = [(70, 110, 70, 110), (84, 92, 90, 94), (100, 120, 140)]  # in degrees
CUTS = [(0.0, 1.2), (0.0, math.pi), (2.5, math.pi)]


def limit(pitch, cut, speed, method="multi-frequency", **more):
    teeth = len(pitch)
    around = tuple(np.radians(pitch))
    return limit_depth(
        MACHINE.receptance, teeth, *FORCES, *cut, speed, method, pitch=around, **more
    )


@pytest.mark.parametrize(
    ("pitch", "seed"), [*zip(PITCHES * 2, (5, 11, 13, 19, 26, 0), strict=True)]
)
def test_random_machines_and_cuts(pitch, seed):
    """Stable below the limit, unstable just above by semi-discretisation in 720 steps, which errs
    by 1e-4; teeth cut in the order of the list."""
    cut = random_milling(seed)
    speed = cut.speed * cut.teeth / len(pitch)
    around = tuple(np.radians(pitch))
    given = cut.kt, cut.kn, cut.entry, cut.exit, speed
    found = limit_depth(cut.machine.receptance, len(pitch), *given, pitch=around)
    truth = UnevenMilling(cut.machine, around[::-1], *given)
    shares = (0.2, 0.5, 0.8, 0.95, 0.999)
    assert max(truth.radius(share * found.depth, 720) for share in shares) < 1.0
    assert truth.radius(1.001 * found.depth, 720) > 1.0


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_limits_without_steps(seed):
    """Of random patterns the limit of semi-discretisation extrapolated to no step."""
    rng, cut = np.random.default_rng([31, seed]), random_milling(seed)
    teeth = int(rng.integers(2, 6))
    steps = rng.multinomial(72 - 6 * teeth, np.full(teeth, 1.0 / teeth)) + 6  # of 5 degrees
    around, speed = tuple(np.radians(5.0 * steps)), cut.speed * cut.teeth / teeth
    given = cut.kt, cut.kn, cut.entry, cut.exit, speed
    found = limit_depth(cut.machine.receptance, teeth, *given, pitch=around)
    truth = UnevenMilling(cut.machine, around[::-1], *given)
    depth, _ = truth.extrapolated(0.3 * found.depth, 1.1 * found.depth, (1440, 2880), 60)
    assert depth == pytest.approx(found.depth, rel=3e-6)


def test_helical_edges():
    """The edges lag by the depth itself."""
    helix, diameter, speed = math.radians(30.0), 0.016, 1500.0
    pitch, cut = (84, 92, 90, 94), (0.0, 1.2)
    found = limit(pitch, cut, speed, helix=helix, diameter=diameter)
    assert abs(found.depth / limit(pitch, cut, speed).depth - 1.0) > 1e-3
    around = tuple(np.radians(pitch[::-1]))
    slope = 2.0 * math.tan(helix) / diameter
    truth = UnevenMilling(MACHINE, around, *FORCES, *cut, speed, slope=slope)
    assert truth.radius(0.999 * found.depth, 720) < 1.0 < truth.radius(1.001 * found.depth, 720)


@pytest.mark.parametrize("cut", CUTS)
@pytest.mark.parametrize("speed", [300.0, 2000.0])
def test_nearly_even_pitch_has_the_limit_of_even_pitch(cut, speed):
    """One is solved over a revolution, the other from tooth to tooth."""
    even = limit_depth(MACHINE.receptance, 4, *FORCES, *cut, speed)
    same = limit((90, 90, 90, 90), cut, speed)
    near = limit((90 + 1e-6, 90 - 1e-6, 90 + 2e-6, 90 - 2e-6), cut, speed)
    assert same == even
    assert near.depth == pytest.approx(even.depth, rel=1e-8)
    assert near.frequency == pytest.approx(even.frequency, rel=1e-6)
    quick = [
        each.depth
        for each in (
            limit_depth(MACHINE.receptance, 4, *FORCES, *cut, speed, "zero-order"),
            limit((90 + 1e-6, 90 - 1e-6, 90 + 2e-6, 90 - 2e-6), cut, speed, "zero-order"),
        )
    ]
    assert quick[1] == pytest.approx(quick[0], rel=1e-6)


@pytest.mark.parametrize("cut", CUTS)
def test_which_tooth_is_named_first_does_not_matter(cut):
    """Of a pattern that repeats within a revolution a part is solved; a slight change of one pitch
    makes it whole."""
    for pitch in PITCHES:
        first = limit(pitch, cut, 900.0)
        shifted = limit((*pitch[1:], pitch[0]), cut, 900.0)
        assert shifted.depth == pytest.approx(first.depth, rel=1e-9)
        assert shifted.kind == first.kind
    repeated = limit((70, 110, 70, 110), cut, 900.0)
    whole = limit((70, 110 - 1e-7, 70, 110 + 1e-7), cut, 900.0)
    assert whole.depth == pytest.approx(repeated.depth, rel=1e-7)


@pytest.mark.parametrize("pitch", PITCHES)
@pytest.mark.parametrize(("cut", "speed"), [(CUTS[0], 900.0), (CUTS[0], 2000.0), (CUTS[2], 900.0)])
def test_all_harmonics_give_the_limit_of_the_modes(pitch, cut, speed):
    """What samples of a receptance give, folds and flips among them."""
    found = limit(pitch, cut, speed)
    own = Cut(len(pitch), *FORCES, *cut, pitches=tuple(np.radians(pitch)))
    omega, top = resolving(MACHINE.receptance)
    process = Process(own, own.turn / speed)
    other = sampled_limit(MACHINE.receptance, peaks(omega, top), top, process)
    assert other.depth == pytest.approx(found.depth, rel=1e-5)
    assert other.frequency == pytest.approx(found.frequency, rel=1e-5)
    assert other.kind == found.kind


@pytest.mark.parametrize(
    ("pitch", "cut", "speed", "kind"),
    [
        ((70, 110, 70, 110), CUTS[2], 3000.0, "fold"),
        ((100, 120, 140), CUTS[0], 2000.0, "fold"),
        ((84, 92, 90, 94), CUTS[0], 1300.0, "hopf"),
    ],
)
def test_a_tip_that_nothing_holds(pitch, cut, speed, kind):
    """Its receptance is endless at rest, next to which folds are: the limit is that of one on soft
    springs."""

    def tip(spring):
        def receptance(omega):
            free = 1.0 / (spring - 50.0 * omega**2 + 500j * omega)
            return MACHINE.receptance(omega) + free[:, None, None] * np.eye(2)

        return receptance

    around = tuple(np.radians(pitch))
    free, held = (
        limit_depth(tip(spring), len(pitch), *FORCES, *cut, speed, pitch=around)
        for spring in (0.0, 1e4)
    )
    assert free.depth == pytest.approx(held.depth, rel=3e-5)
    assert free.kind == held.kind == kind


def test_very_short_spans():
    """Of hardly uneven teeth in all harmonics, and a cut shorter than samples of a revolution."""
    around, cut = tuple(np.radians((89.97, 90.03, 89.99, 90.01))), (0.0, 0.5 * math.pi)
    found = limit_depth(MACHINE.receptance, 4, *FORCES, *cut, 900.0, pitch=around)
    own = Cut(4, *FORCES, *cut, pitches=around)
    omega, top = resolving(MACHINE.receptance)
    process = Process(own, own.turn / 900.0)
    other = sampled_limit(MACHINE.receptance, peaks(omega, top), top, process)
    assert other.depth == pytest.approx(found.depth, rel=1e-6)
    short = limit((170, 190), (0.0, 1e-4), 900.0)
    even = limit_depth(MACHINE.receptance, 2, *FORCES, 0.0, 1e-4, 900.0)
    assert short.depth == pytest.approx(even.depth, rel=0.5)


def test_folds_are_limits():
    """Vibration that repeats with the teeth, at a multiple of the rotation: a multiplier of 1."""
    found = limit((100, 120, 140), (0.0, 1.2), 900.0)
    assert found.kind == "fold"
    times = found.frequency / (900.0 / 2.0 / math.pi)
    assert times == pytest.approx(round(times), rel=1e-9)
    truth = UnevenMilling(MACHINE, tuple(np.radians((140, 120, 100))), *FORCES, 0.0, 1.2, 900.0)
    assert truth.kind(1.001 * found.depth, 720) == "fold"


@pytest.mark.parametrize("pitch", PITCHES)
@pytest.mark.parametrize("cut", CUTS)
def test_zero_order_is_the_largest_crossing(pitch, cut):
    """Of the mean over all delays, sampled 40 times as finely."""
    speed = 900.0
    found = limit(pitch, cut, speed, "zero-order")
    omega = np.arange(0.02, 2.0 * math.pi * 4000.0, 0.05)
    back = np.exp(-1j * omega[:, None] * np.radians(pitch) / speed).mean(axis=1)
    mean = Cut(len(pitch), *FORCES, *cut).mean()
    z = (back - 1.0)[:, None, None] * (MACHINE.receptance(omega) @ mean)
    trace = z[:, 0, 0] + z[:, 1, 1]
    root = np.sqrt(trace**2 - 4.0 * (z[:, 0, 0] * z[:, 1, 1] - z[:, 0, 1] * z[:, 1, 0]))
    largest = 0.0
    for branch in ((trace + root) / 2.0, (trace - root) / 2.0):
        crosses = np.flatnonzero(
            (branch.imag[:-1] * branch.imag[1:] < 0.0)
            & (np.abs(np.diff(branch)) < 0.1 * np.abs(branch[1:]))
        )
        largest = max(largest, branch.real[crosses].max(initial=0.0))
    assert found.depth == pytest.approx(1.0 / largest, rel=1e-3)


def test_process_damping_over_a_revolution():
    """Nearly even pitch, solved over a revolution, against even pitch."""
    omega, top = resolving(MACHINE.receptance)
    tip = as_modes(MACHINE.receptance, omega)
    depth = []
    for pitches in ((), tuple(np.radians((90 + 1e-6, 90 - 1e-6, 90 + 2e-6, 90 - 2e-6)))):
        own = Cut(4, *FORCES, 0.0, 1.2, pitches=pitches)
        rubbing = replace(own, tangential=0.0, radial=2e4)
        depth.append(modal_limit(tip, top, Process(own, own.turn / 700.0, 0.0, rubbing)).depth)
        without = modal_limit(tip, top, Process(own, own.turn / 700.0)).depth
        assert abs(depth[-1] / without - 1.0) > 0.01
    assert depth[1] == pytest.approx(depth[0], rel=1e-8)


@pytest.mark.parametrize(
    ("pitch", "sentence"),
    [
        ((100, 120, 130), "350° in total; allowed: one for each of 3 teeth"),
        ((180, 180), "given 2 angles"),
        ((0.5, 179.5, 180), "given 3 angles from 0.5°"),
    ],
)
def test_pitches_that_there_are_not(pitch, sentence):
    with pytest.raises(InvalidInput, match=sentence):
        limit_depth(MACHINE.receptance, 3, *FORCES, pitch=tuple(np.radians(pitch)))
