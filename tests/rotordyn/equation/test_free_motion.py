"""Motions solved as one complex plane: seen in both planes, and what couples these."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.frf.solve import solve
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.equation.free_motion import free_motions, stiffness_with_signs
from rotordyn.equation.hysteresis import Signs
from rotordyn.equation.linear import Linear
from rotordyn.numerics.modes import modes
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM, pairs

OMEGA = np.array([40.0, 900.0, 7000.0])
EVEN = (support("front", 0.0, (8e7, 8e7), 300.0), support("rear", 0.2, (6e7, 6e7), 200.0))
SKEW = tuple(replace(s, stiffness={**s.stiffness, ("y", "z"): 5e6, ("z", "y"): -5e6}) for s in EVEN)
ROTOR = replace(STEPPED, points={"tip": -0.05, "mid": 0.11})


def bending(supports: tuple, rpm: float) -> Linear:
    spindle = replace(ROTOR, supports=supports)
    scene = Scene(spindle, Conditions(), np.array([rpm * RPM]), 1000.0, (-0.05, 0.11))
    (k,) = scene.with_motions(("bending",))
    return scene.linear(k)


@pytest.mark.parametrize("supports", [EVEN, SKEW], ids=["even", "skew"])
def test_one_complex_plane_is_both_planes_in_one_real_system(supports: tuple) -> None:
    linear = bending(supports, 9000.0)
    assert linear.axisymmetric
    found = free_motions(linear)
    both = modes(linear.stiffness, linear.damping)
    upper = both.pole[0][both.pole[0].imag > 0.0]
    apart = np.abs(np.sort_complex(found.pole[0])[:, None] - upper).min(axis=1)
    assert (apart < 1e-9 * np.abs(np.sort_complex(found.pole[0]))).all()
    assert found.pole.shape[1] == len(upper)
    k, d = linear.stiffness[0], linear.damping[0]
    balance = [
        (s**2 * v + s * d @ v + k @ v) / np.abs(k @ v).max()
        for s, v in zip(found.pole[0], found.vector[0].T, strict=True)
    ]
    assert np.abs(balance).max() < 1e-9
    turning = found.vector[0].T.reshape(-1, 2, linear.size // 2)
    ways = np.where(found.whirl[0] > 0, -1j, 1j)
    np.testing.assert_allclose(turning[:, 1], ways[:, None] * turning[:, 0], rtol=1e-12)
    rows = np.random.default_rng(2).normal(size=(4, linear.size // 2))
    out = np.concatenate([rows, 0.0 * rows], axis=1)
    into = np.concatenate([0.0 * rows, rows[::-1]], axis=1)
    for response, excitation in ((out, out[::-1]), (out, into), (into, out), (into, into)):
        ours = found.receptance(OMEGA, response, excitation)
        theirs = both.receptance(OMEGA, response, excitation)
        assert np.abs(ours - theirs).max() < 1e-9 * np.abs(theirs).max()


def test_left_and_right_vectors_sum_up_to_the_receptance() -> None:
    """Σ v l / (iω − λ) and, of Im λ > 0, the conjugate."""
    found = free_motions(bending(EVEN, 9000.0))
    pole, vector, left = (each[0] for each in (found.pole, found.vector, found.left))
    row, own = vector[[0]], left[:, [0]]
    total = [
        (row @ (own / (1j * w - pole)[:, None]))[0, 0]
        + (row.conj() @ (own.conj() / (1j * w - pole.conj())[:, None]))[0, 0]
        for w in OMEGA
    ]
    unit = np.eye(1, vector.shape[0])
    assert total == pytest.approx(found.receptance(OMEGA, unit, unit)[0, 0], rel=1e-9)


def test_planes_apart_answer_each_other_with_nothing() -> None:
    """Not even rounding, at rest on supports that do not couple them; else they do answer."""
    for supports, rpm, apart in ((EVEN, 0.0, True), (EVEN, 3000.0, False), (SKEW, 0.0, False)):
        spindle = replace(ROTOR, supports=supports)
        scene = Scene(spindle, Conditions(), np.array([rpm * RPM]), 1000.0, (-0.05, 0.11))
        spec = FrfSpec((100.0, 900.0), pairs("tip.z/tip.y", "mid.y/tip.z"))
        found = solve(scene, spec)
        assert (found.receptance == 0.0).all() == apart
        assert (found.receptance != 0.0).all() != apart
        assert not (apart and found.error.any())


@pytest.mark.parametrize(
    "supports", [EVEN, SKEW, EVEN[:1] + SKEW[1:]], ids=["even", "skew", "both"]
)
def test_under_a_force_that_grows_poles_sum_up_as_at_real_frequencies(supports: tuple) -> None:
    """Σ v w/(s − λ) and its conjugate poles at s = (0.2 + i) ω, in one complex plane and in two."""
    linear = bending(supports, 9000.0)
    found = free_motions(linear)
    rows = np.array([linear.row("spindle", x, way) for x in (-0.05, 0.11) for way in ("y", "z")])
    omega = OMEGA * (1.0 - 0.2j)
    responses, excitations = np.repeat(rows, 4, axis=0), np.tile(rows, (4, 1))
    given = found.receptance(omega, responses, excitations)[0]
    s, pole = 1j * omega[:, None], found.pole[0]
    residue = (responses @ found.vector[0]) * (found.left[0] @ excitations.T).T
    swings = pole.imag > 0.0
    summed = residue @ (1.0 / (s - pole)).T
    summed += residue[:, swings].conj() @ (1.0 / (s - pole[swings].conj())).T
    np.testing.assert_allclose(given, summed, rtol=1e-8, atol=1e-9 * np.abs(summed).max())


@pytest.mark.parametrize("uneven", [0.0, 2e7])
@pytest.mark.parametrize(("number", "free"), [(0, 4), (1, 2), (2, 0)])
def test_motions_that_nothing_holds_are_counted_in_both_planes(
    uneven: float, number: int, free: int
) -> None:
    """Each takes two poles, also where planes differ: four motions of a free shaft across its axis,
    two about one support."""
    held = tuple(
        replace(s, stiffness={("y", "y"): 8e7, ("z", "z"): 8e7 + uneven}, damping={})
        for s in EVEN[:number]
    )
    found = free_motions(bending(held, 0.0))
    assert found.whirling == (uneven == 0.0 or number == 0)
    assert found.free_count == pytest.approx(2.0 * free)


@pytest.mark.parametrize("way", [1, -1])
def test_lossy_supports_answer_ahead_of_the_motion(way: int) -> None:
    """Each spring k as k (1 + iη) of motions e^(iωt), the conjugate of e^(−iωt)."""
    held = tuple(replace(s, loss_factor=0.2) for s in EVEN)
    linear = bending(held, 3000.0)
    found = stiffness_with_signs(linear, Signs(0, 0, way))
    springs = sum(np.asarray(each.stiffness) for each in linear.connections)
    assert found.real == pytest.approx(linear.stiffness)
    assert found.imag == pytest.approx(way * 0.2 * springs)
    plain = bending(EVEN, 3000.0)
    assert stiffness_with_signs(plain, Signs(0, 0, way)) is plain.stiffness


UNEVEN = {
    "stiffness": ("stiffness", {("z", "z"): 6e7}),
    "damping": ("damping", {("z", "z"): 900.0}),
    "cross": ("stiffness", {("y", "z"): 2e7, ("z", "y"): 2e7}),
}


@pytest.mark.parametrize("lossy", [False, True], ids=["", "lossy"])
@pytest.mark.parametrize("rigid", [(), ("y", "z")], ids=["", "rigid"])
@pytest.mark.parametrize("even", [0, -1], ids=["first", "last"])
@pytest.mark.parametrize("what", UNEVEN)
def test_planes_alike_at_one_speed_alone(
    what: str, even: int, rigid: tuple[str, ...], lossy: bool
) -> None:
    """A table that is even at the first or the last speed: motions at that speed by themselves, and
    drawn responses, are those of all speeds."""
    which, entries = UNEVEN[what]
    front = EVEN[0]
    alike = getattr(front, which)
    table = {
        key: tuple(
            alike.get(key, 0.0) if k == even % 3 else value * (1.0 + 0.1 * k) for k in range(3)
        )
        for key, value in entries.items()
    }
    at = np.array([0.0, 6000.0, 12000.0]) * RPM
    front = replace(front, speeds=tuple(at), **{which: {**alike, **table}})
    rear = replace(EVEN[1], stiffness={}, damping={}, rigid=rigid) if rigid else EVEN[1]
    spindle = replace(ROTOR, supports=(front, rear), loss_factor=0.02 * lossy)
    scene = Scene(spindle, Conditions(), at, 1000.0, (-0.05, 0.11))
    (k,) = scene.with_motions(("bending",))
    whole, row = scene.system(k), np.array([even % 3])
    rows = np.array([whole.linear.row("spindle", x, way) for x in (-0.05, 0.11) for way in "yz"])
    every = np.repeat(rows, 4, axis=0), np.tile(rows, (4, 1))
    given = whole.receptance(OMEGA, *every)[row]
    scale = 1e-9 * np.abs(given).max()
    np.testing.assert_allclose(whole.at(row).receptance(OMEGA, *every), given, atol=scale)
    again = free_motions(whole.linear.at(row).scaled(np.ones(1), np.ones(1)))
    np.testing.assert_allclose(again.receptance(OMEGA, *every), given, atol=scale)
    spec = FrfSpec(tuple(np.linspace(50.0, 900.0, 30)), pairs("tip.y/tip.y", "mid.z/tip.y"))
    found = solve(scene, spec)
    drawn = found.slice_value[
        even, :, np.searchsorted(found.slice_frequency[even], spec.frequencies)
    ]
    np.testing.assert_allclose(drawn.T, found.receptance[even], rtol=1e-9)
