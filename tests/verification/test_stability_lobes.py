"""Limits of milling by harmonics against the time domain, and against what is exact."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.stability_lobes import limit_depth, turning_limit
from rotordyn.analyses.stability_lobes.as_modes import as_modes
from rotordyn.analyses.stability_lobes.bessel import spherical_bessel
from rotordyn.analyses.stability_lobes.cutting import Cut
from rotordyn.analyses.stability_lobes.limit import sampled_limit
from rotordyn.analyses.stability_lobes.modal_limit import Process, modal_limit
from rotordyn.analyses.stability_lobes.sampling import along, peaks, resolving
from rotordyn.analyses.stability_lobes.spans import Spans
from rotordyn.analyses.stability_lobes.zero_order import Mean, zero_order
from rotordyn.errors import InvalidInput
from tests.oracles.milling_floquet import Machine, Milling
from tests.oracles.random_milling import harmonic, random_milling

MACHINE = Machine(((600.0, 0.03, 8e6, (1.0, 0.0)), (750.0, 0.02, 6e6, (0.3, 0.9))))
CUT = (2, 9e8, 3e8, 0.0, 1.2)


@pytest.mark.parametrize("seed", [0, 5, 11, 13, 19, 26])
def test_random_machines_and_cuts(seed):
    """Stable just below the limit and at depths further below, unstable just above, of one kind.

    The whole is ``python -m tests.oracles.random_milling 200``.
    """
    cut = random_milling(seed)
    found = harmonic(cut)
    below = found.depth * np.array([0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97, 0.998])
    assert max(cut.radius(depth) for depth in below) < 1.0
    assert cut.radius(1.002 * found.depth) > 1.0
    assert cut.kind(1.002 * found.depth) == found.kind


@pytest.mark.few(1)
@pytest.mark.parametrize(("seed", "closes"), [(176, False), (568, True), (957, True)])
def test_losses_in_a_narrow_range_of_depths(seed, closes):
    """Islands, above which the cut is stable again, and a loss close to a tangency: a scan of the
    time domain in steps of 0.5 % is stable below the limit."""
    cut = random_milling(seed)
    found = harmonic(cut)
    assert cut.radius(1.0005 * found.depth) > 1.0 > cut.radius(0.9995 * found.depth)
    below = np.geomspace(0.3 * found.depth, 0.9995 * found.depth, 240)
    assert max(cut.radius(depth) for depth in below) < 1.0
    above = min(cut.radius(depth) for depth in found.depth * np.linspace(1.001, 1.4, 80))
    assert (above < 1.0) == closes


@pytest.mark.parametrize("seed", [0, 5, 10, 19, 26])
def test_all_harmonics_give_the_limit_of_the_time_domain(seed):
    """What samples of a receptance give, and what its modes give."""
    cut = random_milling(seed)
    found = harmonic(cut)
    omega, top = resolving(cut.machine.receptance)
    own = Cut(cut.teeth, cut.kt, cut.kn, cut.entry, cut.exit)
    process = Process(own, own.turn / cut.speed)
    other = sampled_limit(cut.machine.receptance, peaks(omega, top), top, process)
    assert other.depth == pytest.approx(found.depth, rel=2e-4)
    assert other.kind == found.kind
    assert other.frequency == pytest.approx(found.frequency, rel=1e-3)


def test_a_receptance_with_a_loss_factor_is_no_sum_of_modes():
    """Its limit is that of viscous damping that dissipates as much at the chatter frequency."""

    def lossy(omega):
        found = np.zeros((len(omega), 2, 2), dtype=complex)
        r = omega / (2.0 * math.pi * 600.0)
        found[:, 0, 0] = 1.0 / (8e6 * (1.0 - r**2 + 0.06j))
        return found

    assert as_modes(lossy, 2.0 * math.pi * np.geomspace(50.0, 5000.0, 600)) is None
    found = limit_depth(lossy, *CUT, 900.0)
    ratio = 0.03 * 600.0 / found.frequency
    viscous = Machine(((600.0, ratio, 8e6, (1.0, 0.0)),))
    assert found.depth == pytest.approx(
        limit_depth(viscous.receptance, *CUT, 900.0).depth, rel=1e-2
    )


def test_helical_edges():
    """The limit is that of the cutting forces at that very depth."""
    speed = 1500.0
    helix, diameter = math.radians(30.0), 0.016
    found = limit_depth(MACHINE.receptance, *CUT, speed, helix=helix, diameter=diameter)
    straight = limit_depth(MACHINE.receptance, *CUT, speed)
    assert abs(found.depth / straight.depth - 1.0) > 1e-3

    def radius(share):
        depth = share * found.depth
        return Milling(MACHINE, *CUT, speed, 2.0 * depth * math.tan(helix) / diameter).radius(depth)

    assert max(radius(share) for share in (0.3, 0.7, 0.998)) < 1.0 < radius(1.002)


def test_edges_over_many_pitches_cut_evenly() -> None:
    """Their limit is that of the mean force, from which it departs by the square of pitch over
    depth."""
    steep = {"helix": math.radians(89.99), "diameter": 0.016}
    speed = 1500.0
    found = limit_depth(MACHINE.receptance, *CUT, speed, **steep)
    even = limit_depth(MACHINE.receptance, *CUT, speed, "zero-order")
    assert found.depth == pytest.approx(even.depth, rel=1e-5)
    assert found.frequency == pytest.approx(even.frequency, rel=1e-5)


@pytest.mark.parametrize(("speed", "lag"), [(700.0, 0.0), (1500.0, 0.0), (700.0, 80.0)])
def test_process_damping(speed, lag):
    """Forces by velocity in the time domain, with straight edges and with a helix."""
    rate = 2e5 / (0.008 * speed)
    cut = Cut(*CUT)
    process = Process(cut, cut.turn / speed, lag, Cut(2, 0.0, rate, *CUT[3:]))
    omega, top = resolving(MACHINE.receptance)
    tip = as_modes(MACHINE.receptance, omega)
    found, without = (modal_limit(tip, top, p) for p in (process, process._replace(ploughing=None)))
    assert abs(found.depth / without.depth - 1.0) > 0.01
    given = {"helix": math.atan(0.008 * lag), "diameter": 0.016, "process_damping": 2e5}
    public = limit_depth(MACHINE.receptance, *CUT, speed, **given)
    assert public.depth == pytest.approx(found.depth, rel=1e-9)

    def radius(share):
        depth = share * found.depth
        return Milling(MACHINE, *CUT, speed, lag * depth, rate).radius(depth)

    assert max(radius(share) for share in (0.3, 0.7, 0.9995)) < 1.0 < radius(1.0005)


@pytest.mark.parametrize(("frequency", "speed"), [(0.5, 700.0), (2.2, 700.0), (2.2, 1e6)])
def test_a_machine_that_is_unstable_without_a_cut_has_no_stable_depth(frequency, speed):
    """With a mode of negative damping below the highest frequency, or far above, where the map by
    which depths are tried has none; at a speed of which all depths would be stable, too."""
    omega, top = resolving(MACHINE.receptance)
    tip = as_modes(MACHINE.receptance, omega)
    cut = Cut(*CUT)
    unstable = replace(
        tip,
        pole=np.append(tip.pole, (1e-3 + 1j) * frequency * top),
        shape=np.append(tip.shape, [[1e-6, 0.0]], axis=0),
        participation=np.append(tip.participation, [[1e-6, 0.0]], axis=0),
    )
    process = Process(cut, cut.turn / speed)
    assert math.isinf(modal_limit(tip, top, process).depth) == (speed > 1e5)
    assert modal_limit(unstable, top, process).depth == 0.0


def test_process_damping_in_a_deep_cut_makes_no_machine_stable():
    """Unstable by a mode so high that the map by which depths are tried has none."""
    omega, top = resolving(MACHINE.receptance)
    tip, cut, rubbing = as_modes(MACHINE.receptance, omega), Cut(*CUT), Cut(2, 0.0, 1e5, *CUT[3:])
    pole = (1e-3 + 1j) * 2.3 * top
    unstable = replace(
        tip,
        pole=np.append(tip.pole, pole),
        shape=np.append(tip.shape, [[0.5 / (1j * pole.imag), 0.0]], axis=0),
        participation=np.append(tip.participation, [[1.0, 0.0]], axis=0),
    )
    process = Process(cut, cut.turn / 700.0, ploughing=rubbing)
    assert np.abs(process.floquet(unstable, top, 0.0).multipliers(0.0)).max() > 1.0
    assert modal_limit(unstable, top, process).depth == 0.0


@pytest.mark.parametrize(
    ("teeth", "end", "cutting"), [(2, 1.2, [1]), (3, 2.6, [2, 1]), (4, math.pi, [2])]
)
def test_a_tooth_cuts_one_thickness(teeth, end, cutting):
    """Forces by displacement are forces by chip thickness times this, of half the size in spans
    in which one tooth is cutting."""
    spans = Spans(Cut(teeth, 9e8, 3e8, 0.0, end), 0.004, 2.0 * math.pi * 2000.0)
    forces, chip, *_ = spans.thickness
    exact = spans.cutting
    np.testing.assert_allclose(forces @ chip, exact, rtol=0.0, atol=1e-14 * np.abs(exact).max())
    thin = sum(count * k for (*_, count), k in zip(spans.each, cutting, strict=True))
    assert thin <= len(chip) <= min(thin + 12, 2 * spans.size)


def test_process_damping_at_zero_order():
    """A slot with four teeth, whose forces by displacement and by velocity are constant."""
    cut, speed, rate = Cut(4, 9e8, 3e8, 0.0, math.pi), 900.0, 3e4
    rubbing = Cut(4, 0.0, rate, 0.0, math.pi)
    omega, top = resolving(MACHINE.receptance)
    process = Process(cut, cut.turn / speed, 0.0, rubbing)
    many = modal_limit(as_modes(MACHINE.receptance, omega), top, process)
    mean = Mean(cut.mean()[None], rubbing.mean()[None])
    period = np.array([[process.period]])
    depth, at = zero_order(
        lambda w: MACHINE.receptance(w[0])[None],
        mean,
        period,
        along(omega, top, process.period)[None],
    )
    slot = {"teeth": 4, "tangential": 9e8, "radial": 3e8, "speed": speed, "diameter": 0.01}
    quick = limit_depth(
        MACHINE.receptance, **slot, method="zero-order", process_damping=rate * 0.005 * speed
    )
    assert quick.depth == pytest.approx(depth[0], rel=1e-9)
    assert depth[0] == pytest.approx(many.depth, rel=1e-6)
    assert at[0] / 2.0 / math.pi == pytest.approx(many.frequency, rel=1e-5)


@pytest.mark.few(1)
@pytest.mark.parametrize("rubs", [0.0, 2e-2])
def test_the_largest_of_many_crossings_is_found(rubs):
    """Random modes, some 2000 waves between two cuts, against 24 times as many samples: which
    crossing is the largest cannot be determined by the samples next to it."""
    for seed in range(5):
        random = np.random.default_rng(seed)
        natural, ratio = random.uniform(1.2e3, 1.2e4, 3), 10.0 ** random.uniform(-2.3, -1.2, 3)
        compliance = 10.0 ** random.uniform(-8.0, -7.0, 3)

        def moved(omega, natural=natural, ratio=ratio, compliance=compliance):
            w = omega[..., None]
            own = natural**2 - w**2 + 2.0j * ratio * natural * w
            return (compliance * natural**2 / own).sum(axis=-1)

        top, period = 1.3 * natural.max(), 1e4 / natural.max()
        coarse, fine = (2.0 * math.pi / parts / period for parts in (32, 768))
        mean = Mean(np.array([[[1e9]]]), np.array([[[1e9 / natural.max() * rubs]]]))
        depth, _ = zero_order(
            lambda w, moved=moved: moved(w)[..., None, None],
            mean,
            np.array([[period]]),
            np.arange(coarse, top, coarse)[None],
        )
        omega = np.arange(fine, top, fine)
        z = moved(omega) * (
            1e9 * np.expm1(-1j * omega * period) - 1j * omega * mean.rubbing[0, 0, 0]
        )
        at = np.flatnonzero(z.imag[:-1] * z.imag[1:] < 0.0)
        share = z.imag[at] / (z.imag[at] - z.imag[at + 1])
        largest = (z.real[at] + share * (z.real[at + 1] - z.real[at])).max()
        assert depth[0] == pytest.approx(1.0 / largest, rel=1e-4)


def test_slow_milling_at_zero_order_does_not_depend_on_samples():
    """Motion in two directions, some 1000 waves a tooth period, against 8 times as many samples:
    seeds of 300 whose largest crossing another one exceeds on the line between samples."""
    for seed in (99, 135, 206, 215):
        random = np.random.default_rng(seed)
        natural, ratio = random.uniform(1.2e3, 1.2e4, 2), 10.0 ** random.uniform(-2.3, -1.2, 2)
        compliance = 10.0 ** random.uniform(-8.0, -7.0, 2)
        across = random.uniform(-0.3, 0.3)
        mean = Mean(random.uniform(-1e9, 1e9, (1, 2, 2)), np.zeros((1, 2, 2)))

        def moved(omega, natural=natural, ratio=ratio, compliance=compliance, across=across):
            w = omega[..., None]
            own = natural**2 - w**2 + 2.0j * ratio * natural * w
            x, y = np.moveaxis(compliance * natural**2 / own, -1, 0)
            return np.stack([x, across * x, across * x, y], axis=-1).reshape(*omega.shape, 2, 2)

        period = 5.0e3 / natural.max()
        depth = []
        for parts in (32, 256):
            step = 2.0 * math.pi / parts / period
            omega = np.arange(step, 1.3 * natural.max(), step)
            depth.append(zero_order(moved, mean, np.array([[period]]), omega[None])[0][0])
        assert depth[0] == pytest.approx(depth[1], rel=1e-6), seed


def test_zero_order_is_exact_where_cutting_forces_are_constant():
    """A slot with four teeth."""
    cut = (4, 9e8, 3e8, 0.0, math.pi)
    many = limit_depth(MACHINE.receptance, *cut, 900.0)
    mean = limit_depth(MACHINE.receptance, *cut, 900.0, "zero-order")
    assert many.depth == pytest.approx(mean.depth, rel=1e-6)
    assert many.frequency == pytest.approx(mean.frequency, rel=1e-5)


def test_least_limit_of_turning():
    """One mode: 2 k ζ (1 + ζ) / K at ω √(1 + 2ζ), at the speed of a lobe's lowest point."""
    k, ratio, omega, force = 2e7, 0.03, 2.0 * math.pi * 200.0, 1.5e9

    def receptance(at):
        r = at / omega
        return 1.0 / (k * (1.0 - r**2 + 2j * ratio * r))

    at = omega * math.sqrt(1.0 + 2.0 * ratio)
    phase = 3.0 * math.pi + 2.0 * np.angle(receptance(np.array([at])))[0] + 2.0 * math.pi
    speed = 2.0 * math.pi * at / phase
    found = turning_limit(receptance, force, speed)
    assert found.depth == pytest.approx(2.0 * k * ratio * (1.0 + ratio) / force, rel=1e-8)
    assert found.frequency == pytest.approx(at / 2.0 / math.pi, rel=1e-4)


@pytest.mark.parametrize(("speed", "kind"), [(800.0, "hopf"), (1000.0, "hopf"), (1300.0, "flip")])
@pytest.mark.parametrize("swept", [1e-3, 1e-6])
def test_a_short_cut_is_an_impact(speed, kind, swept):
    """The limit of ever shorter cuts: every tooth gives an impulse, the map of the free motion in
    between is exact (Davies et al. 2000); the error falls with the angle in cut."""
    k, natural, ratio, at = 1e7, 2.0 * math.pi * 500.0, 0.03, 1.2
    period, own = math.pi / speed, natural * math.sqrt(1.0 - ratio**2)
    c, s = math.cos(own * period), math.sin(own * period)
    free = np.array([[c + ratio * natural / own * s, s / own], [-(natural**2) / own * s, 0.0]])
    free[1, 1] = c - ratio * natural / own * s
    free *= math.exp(-ratio * natural * period)
    force = (6e8 * math.cos(at) + 2e8 * math.sin(at)) * math.sin(at) * swept / speed

    def radius(depth):
        pushed = depth * force * natural**2 / k
        whole = np.zeros((3, 3))  # displacement and velocity before, displacement a tooth ago
        whole[:2, :2] = free @ np.array([[1.0, 0.0], [-pushed, 1.0]])
        whole[:2, 2] = free @ np.array([0.0, pushed])
        whole[2, 0] = 1.0
        return np.abs(np.linalg.eigvals(whole)).max()

    def receptance(omega):
        found = np.zeros((len(omega), 2, 2), dtype=complex)
        r = omega / natural
        found[:, 0, 0] = 1.0 / (k * (1.0 - r**2 + 2j * ratio * r))
        return found

    ends = at - 0.5 * swept, at + 0.5 * swept
    found = limit_depth(receptance, 2, 6e8, 2e8, *ends, speed=speed)
    assert found.kind == kind
    assert (
        radius((1.0 - 3.0 * swept) * found.depth) < 1.0 < radius((1.0 + 3.0 * swept) * found.depth)
    )


def test_mean_of_cutting_forces():
    """The closed mean of Altintas, and that of the forces over the tooth period, with a lag."""
    cut = Cut(3, 6e8, 2e8, 0.3, 2.1)
    phi, ratio = np.array([0.3, 2.1]), 1.0 / 3.0
    alpha = np.array(
        [
            [
                np.cos(2 * phi) - 2 * ratio * phi + ratio * np.sin(2 * phi),
                -np.sin(2 * phi) - 2 * phi + ratio * np.cos(2 * phi),
            ],
            [
                -np.sin(2 * phi) + 2 * phi + ratio * np.cos(2 * phi),
                -np.cos(2 * phi) - 2 * ratio * phi - ratio * np.sin(2 * phi),
            ],
        ]
    )
    known = -3 * 6e8 / (4.0 * math.pi) * 0.5 * (alpha[..., 1] - alpha[..., 0])
    np.testing.assert_allclose(cut.mean(), known, rtol=1e-12)
    lagging = Cut(3, 6e8, 2e8, 0.3, 2.1, 1.7)
    total = np.zeros((2, 2))
    x, w = np.polynomial.legendre.leggauss(40)
    for low, high in lagging.pieces():
        angle = 0.5 * (low + high) + 0.5 * (high - low) * x
        total += np.einsum("q,qij->ij", 0.5 * (high - low) * w, lagging.matrix(angle))
    np.testing.assert_allclose(total / lagging.turn, known, rtol=1e-9)


def test_spherical_bessel_functions():
    from scipy.special import spherical_jn

    x = np.array([-700.0, -31.0, -3.2, -1e-9, 0.0, 1e-3, 0.7, 9.99, 25.0, 40.2, 333.0])
    for count in (1, 2, 9, 30):
        known = np.array([spherical_jn(n, np.abs(x)) * np.sign(x) ** n for n in range(count)]).T
        known[x == 0.0] = 0.0
        known[x == 0.0, 0] = 1.0
        np.testing.assert_allclose(spherical_bessel(x, count), known, rtol=1e-9, atol=1e-9)


def test_a_soft_tip_with_a_residual_flexibility_has_its_limit():
    """Such as a modal fit gives: as if a stiff mode far above, in its place, ended it."""

    def tip(omega, far):
        each = (1e4, 60.0, 0.03), (5e6, 800.0, 0.03), (5e6, far, 0.5)
        ratio = omega[:, None] / (2.0 * math.pi * np.array([own for _, own, _ in each]))
        damped = 2j * np.array([ratio_of for *_, ratio_of in each]) * ratio
        value = (1.0 / np.array([k for k, *_ in each]) / (1.0 - ratio**2 + damped)).sum(axis=1)
        return value[:, None, None] * np.eye(2)

    speed = 3000.0 * math.pi / 30.0
    ended, endless = (
        limit_depth(lambda omega, far=far: tip(omega, far), 3, speed=speed, entry=0.0, exit=1.5)
        for far in (12e3, 1e7)
    )
    assert endless.depth == pytest.approx(ended.depth, rel=2e-3)
    assert endless.frequency == pytest.approx(ended.frequency, rel=1e-3)


def test_receptances_that_end_before_the_chatter_band():
    def ends(omega):
        return np.where(omega[:, None, None] > 3e3, np.nan, MACHINE.receptance(omega))

    with pytest.raises(InvalidInput, match=r"not a finite number at .* modal fit"):
        limit_depth(ends, speed=500.0)
    with pytest.raises(InvalidInput, match="does not decrease"):
        limit_depth(lambda omega: np.full((len(omega), 2, 2), 1e-9 + 0j), speed=500.0)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"entry": 2.0, "exit": 1.0}, "entry before exit"),
        ({"exit": 4.0}, "entry before exit"),
        ({"exit": 1e-12}, "too short to differ from zero"),
        ({"tangential": -1.0}, "cutting coefficients"),
        ({"teeth": 0}, "teeth"),
        ({"helix": math.pi / 2.0, "diameter": 0.01}, "90°"),
        ({"helix": 0.5}, "helix: it needs the diameter"),
        ({"process_damping": 1e4}, "process_damping: it needs the diameter"),
        ({"process_damping": -1.0}, "process_damping: given -1 N/m; allowed: from 0"),
        ({"exit": 3.144}, "entry before exit"),
        ({"method": "first"}, "allowed: multi-frequency, zero-order"),
        ({"speed": 0.0}, "speed"),
    ],
)
def test_refusals(given, sentence):
    with pytest.raises(InvalidInput, match=sentence):
        limit_depth(MACHINE.receptance, **given)


def test_process_damping_is_not_known_of_a_loss_factor():
    """Nor omitted: only zero order takes it."""

    def hysteretic(omega):
        one = 1e-7 / (1.0 - (omega / 4000.0) ** 2 + 0.05j)
        return one[:, None, None] * np.eye(2)

    given = {"speed": 900.0, "diameter": 0.02, "process_damping": 1e5}
    with pytest.raises(InvalidInput, match="not a sum of modes"):
        limit_depth(hysteretic, **given)
    assert math.isfinite(limit_depth(hysteretic, **given, method="zero-order").depth)


@pytest.mark.parametrize("exit", [3.1416, 3.1415, 3.141])
def test_ends_of_a_cut_may_be_rounded(exit):
    known = limit_depth(MACHINE.receptance, 2, 9e8, 3e8, 2.0, math.pi, 900.0)
    assert limit_depth(MACHINE.receptance, 2, 9e8, 3e8, 2.0, exit, 900.0) == known


def undamped(omega):
    return MACHINE.receptance(omega).real


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"receptance": lambda w: MACHINE.receptance(w)[:, 0, 0]}, r"of shape \(\d+,\); allowed"),
        ({"receptance": lambda w: MACHINE.receptance(w)[:-1]}, "complex numbers of shape"),
        ({"receptance": lambda w: None}, "object of shape"),
        ({"receptance": 3.0}, "must be a function"),
        ({"receptance": lambda w: 1e9 * MACHINE.receptance(w)}, "displacement per force"),
        ({"receptance": lambda w: 0.0 * MACHINE.receptance(w)}, "displacement per force"),
        ({"receptance": lambda w: MACHINE.receptance(w).conj()}, "adds energy to the tip"),
        ({"receptance": undamped}, "is undamped, and without damping no depth"),
        ({"speed": 0.5}, "waves; allowed: 159: raise the speed"),
        ({"speed": 1e-6, "method": "zero-order"}, "waves; allowed"),
        ({"teeth": 2.5}, "teeth must be a whole number"),
        ({"radial": math.nan}, "radial must be a number"),
        ({"speed": "fast"}, "speed must be a number"),
    ],
)
def test_receptances_and_numbers_that_are_none(given, sentence):
    with pytest.raises(InvalidInput, match=sentence):
        limit_depth(**{"receptance": MACHINE.receptance, "speed": 900.0, **given})


def test_turning_refuses_what_is_not_damped():
    """A motion across the force may have either sign in quadrature, but not none."""
    across = turning_limit(lambda w: -MACHINE.receptance(w)[:, 0, 1], 1e9, 500.0)
    assert math.isfinite(across.depth)
    with pytest.raises(InvalidInput, match="is undamped"):
        turning_limit(lambda w: undamped(w)[:, 0, 0], 1e9, 500.0)
    with pytest.raises(InvalidInput, match="complex numbers of shape"):
        turning_limit(MACHINE.receptance, 1e9, 500.0)
