"""Receptance coupling: halves against the whole, a joint against a dense model, and back."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import expm

from rotordyn.analyses.coupling import (
    Ends,
    Section,
    _shear_coefficient,
    beam,
    between_points,
    couple,
    joint_flexibility,
    rotations,
    uncouple,
)
from rotordyn.errors import InvalidInput

OMEGA = 2.0 * np.pi * np.linspace(20.0, 6000.0, 60)
STEEL = {"young": 210e9, "density": 7850.0, "loss_factor": 2e-3}
WHOLE = Section(0.3, 0.04, 0.01, **STEEL)
HALF = WHOLE._replace(length=0.15)
HOLDER = [Section(0.05, 0.012, **STEEL, stiff_diameter=0.0096), Section(0.06, 0.03, **STEEL)]
SPINDLE = [Section(0.1, 0.06, 0.02, **STEEL), Section(0.25, 0.07, 0.02, **STEEL)]


def close(one, other, tolerance):
    size = np.abs(other).max(axis=0)
    return (np.abs(one - other) / np.abs(other)).max() < tolerance or (
        np.abs(one - other) / size
    ).max() < tolerance


def by_matrix_exponential(omega, section, speed):
    """Receptances (4, 4) of a free section between the ends of its transfer matrix by ``expm``, in
    no units."""
    bending = section.young * (1.0 + 1j * section.loss_factor * np.sign(omega - speed))
    d, b = section.outer, section.inner
    area, second = math.pi / 4.0 * (d**2 - b**2), math.pi / 64.0 * (d**4 - b**4)
    kappa = _shear_coefficient(section.poisson, b / d)
    a = np.zeros((4, 4), dtype=complex)
    a[0, 1], a[0, 3] = 1.0, 2.0 * (1.0 + section.poisson) / (kappa * bending * area)
    a[1, 2], a[2, 3] = 1.0 / (bending * second), -1.0
    a[2, 1] = -section.density * second * (omega**2 - 2.0 * omega * speed)
    a[3, 0] = -section.density * area * omega**2
    wave = (section.density * area * omega**2 / (section.young * second)) ** 0.25
    stiff = section.young * second * wave**2
    unit = np.array([1.0, wave, stiff, stiff * wave])
    t = expm(a * section.length * unit / unit[:, None])
    # unknown states of both ends, by forces on them
    held = np.zeros((8, 8), dtype=complex)
    held[:4, :4], held[:4, 4:] = t, -np.eye(4)
    held[[4, 5, 6, 7], [3, 2, 7, 6]] = -1.0, -1.0, 1.0, 1.0
    forced = np.concatenate([np.zeros((4, 4)), np.eye(4)])
    state = np.linalg.solve(held, forced)[[0, 1, 4, 5]]
    return state * unit[[0, 1, 0, 1]][:, None] / unit[[3, 2, 3, 2]]


@pytest.mark.parametrize("speed", [0.0, 2500.0, -4000.0])
@pytest.mark.parametrize(
    "section",
    [
        Section(0.05, 0.012, **STEEL),
        Section(0.002, 0.1, 0.03, **STEEL),
        Section(0.12, 0.1, 0.09),
        Section(0.03, 0.05, loss_factor=0.3),
        Section(0.25, 0.04),
    ],
)
def test_a_section_is_the_exponential_of_its_equations(section, speed):
    """Bending waves times length from 0.16, below which the exponential loses digits, to 5."""
    top = 25.0 * np.sqrt(section.young / section.density * section.outer**2 / 16.0)
    omega = top / section.length**2 * np.geomspace(1e-3, 1.0, 300)
    found = beam(omega, [section], speed)
    for k, own in enumerate(omega):
        exact = by_matrix_exponential(own, section, speed)
        known = [[found.r11[k], found.r12[k]], [found.r21[k], found.r22[k]]]
        size = np.abs(exact).max(axis=1)
        assert (np.abs(np.block(known) - exact) <= 1e-10 * size[:, None]).all()


def test_two_halves_are_the_whole():
    first, second, whole = beam(OMEGA, [HALF]), beam(OMEGA, [HALF]), beam(OMEGA, [WHOLE])
    tip = couple(first, second.r11)
    np.testing.assert_allclose(tip, whole.r11, rtol=1e-9, atol=1e-9 * np.abs(whole.r11).max())


def test_reciprocity_and_symmetry_of_a_free_shaft():
    ends = beam(OMEGA, HOLDER)
    for one, other in ((ends.r11, ends.r11), (ends.r22, ends.r22), (ends.r12, ends.r21)):
        assert close(one, np.swapaxes(other, 1, 2), 1e-9)


def test_free_free_frequencies_of_a_slender_shaft():
    """Bernoulli: (βL)² = 22.3733; shear and rotary inertia take little of a slender shaft's."""
    length, d = 1.0, 0.01
    exact = 22.3732854 * np.sqrt(210e9 * d**2 / 16.0 / 7850.0) / length**2
    omega = exact * np.linspace(0.99, 1.01, 2001)
    size = np.abs(beam(omega, [Section(length, d, loss_factor=1e-4)]).r11[:, 0, 0])
    assert omega[size.argmax()] == pytest.approx(exact, rel=5e-4)


def test_rigid_body_at_low_frequency():
    """A free shaft is a rigid body there: y/f at an end is −4/(mω²) of a slender one."""
    omega = np.array([1.0])
    mass = 7850.0 * np.pi / 4.0 * 0.01**2
    expected = -4.0 / mass
    assert beam(omega, [Section(1.0, 0.01)]).r11[0, 0, 0] == pytest.approx(expected, rel=1e-3)


def test_a_short_section_is_a_rigid_body_to_rounding():
    """All receptances follow from mass and moment of inertia; its flexibility is 1e-14 of them."""
    omega, length, d = np.array([1e-3, 0.1, 1.0]), 0.02, 0.05
    mass = 7850.0 * math.pi / 4.0 * d**2 * length
    turned = 1.0 / (mass * (length**2 / 12.0 + d**2 / 16.0))
    found = beam(omega, [Section(length, d)])
    for values, one, other in zip(found, (-1, -1, 1, 1), (-1, 1, -1, 1), strict=True):
        first, second = (np.array([side * length / 2.0, 1.0]) for side in (one, other))
        rigid = np.outer(first, second) * turned + np.diag([1.0 / mass, 0.0])
        np.testing.assert_allclose(values * -(omega**2)[:, None, None], [rigid] * 3, rtol=1e-11)


def dense(tool: Ends, base, joint):
    """Both bodies as one set of equations: unknown forces at the joint, eliminated by nothing."""
    found = np.empty_like(tool.r11)
    for k in range(len(found)):
        a = np.zeros((8, 8), dtype=complex)  # tip, joint of tool, joint of base, force
        a[:6, :6] = np.eye(6)
        a[:2, 6:], a[2:4, 6:] = -tool.r12[k], -tool.r22[k]
        a[4:6, 6:] = base[k]
        a[6:, 2:4], a[6:, 4:6], a[6:, 6:] = np.eye(2), -np.eye(2), joint[k]
        right = np.vstack([tool.r11[k], tool.r21[k], np.zeros((4, 2))])
        found[k] = np.linalg.solve(a, right)[:2]
    return found


def test_a_flexible_joint_against_a_dense_model():
    tool, base = beam(OMEGA, HOLDER), beam(OMEGA, SPINDLE).r11
    joint = joint_flexibility(OMEGA, 1e8, 3e5, 200.0, 2.0)
    assert close(couple(tool, base, joint), dense(tool, base, joint), 1e-8)


def test_a_joint_against_a_very_short_soft_section():
    """A section without mass, soft in shear only by its flexibility, is a joint between two."""
    tool, base = beam(OMEGA, HOLDER), beam(OMEGA, SPINDLE).r11
    length, d = 1e-4, 0.03
    soft = Section(length, d, young=2e7, density=1e-3)
    tilt = 2e7 * np.pi / 64.0 * d**4 / length
    shear = 0.886 * 2e7 / 2.6 * np.pi / 4.0 * d**2 / length
    joint = joint_flexibility(OMEGA, shear, tilt)
    through = couple(beam(OMEGA, [*HOLDER, soft]), base)
    joined = couple(tool, base, joint)
    assert np.median(np.abs(through - joined) / np.abs(joined)) < 5e-3


def test_inverse_coupling_closes_the_circle():
    blank, base = beam(OMEGA, [Section(0.04, 0.05, **STEEL)]), beam(OMEGA, SPINDLE).r11
    for joint in (None, joint_flexibility(OMEGA, 5e8, 1e6)):
        back = uncouple(blank, couple(blank, base, joint), joint)
        other = beam(OMEGA, HOLDER)
        tip, again = couple(other, base), couple(other, back)
        assert np.abs(again - tip).max() < 1e-10 * np.abs(tip).max()


def test_translations_at_two_points_of_a_blank_give_the_base():
    """The responses of both together are found otherwise: at the tip of the whole blank, and behind
    it with the front part as a free body beside the rest."""
    front = [Section(0.03, 0.05, **STEEL)]
    rear = [Section(0.02, 0.05, **STEEL), Section(0.026, 0.063, **STEEL)]
    base = beam(OMEGA, SPINDLE).r11
    parts = [beam(OMEGA, each) for each in (front, rear)]
    tip = couple(beam(OMEGA, front + rear), base)
    held = couple(parts[1], base)
    behind = np.linalg.inv(np.linalg.inv(parts[0].r22) + np.linalg.inv(held))
    across = parts[0].r12 @ np.linalg.solve(parts[0].r22 + held, held)
    first, cross, second = (each[:, 0, 0] for each in (tip, across, behind))
    given = np.stack([np.stack([first, cross], -1), np.stack([cross, second], -1)], -2)
    other = beam(OMEGA, HOLDER)
    again, wanted = (couple(other, b) for b in (uncouple(between_points(*parts), given), base))
    assert np.abs(again - wanted).max() < 1e-7 * np.abs(wanted).max()


def test_two_planes_at_once():
    """Matrices of two planes that nothing couples are those of each."""
    tool, base = beam(OMEGA, HOLDER), beam(OMEGA, SPINDLE).r11

    def twice(each):
        found = np.zeros((len(each), 4, 4), dtype=complex)
        found[:, :2, :2], found[:, 2:, 2:] = each, each
        return found

    both, one = couple(Ends(*map(twice, tool)), twice(base)), couple(tool, base)
    largest = np.abs(one).max(axis=(1, 2), keepdims=True)  # small entries are differences of large
    assert (np.abs(both[:, 2:, 2:] - one) < 1e-12 * largest).all()


def test_noise_moves_the_tip_by_as_much():
    """1 % of noise on the tip of a blank of 40 mm leaves less than 16 % in the median."""
    rng = np.random.default_rng(5)
    blank, base = beam(OMEGA, [Section(0.04, 0.05, **STEEL)]), beam(OMEGA, SPINDLE).r11
    tip = couple(blank, base)
    noisy = tip * (1.0 + 0.01 * rng.standard_normal(len(tip)))[:, None, None]
    back, holder = uncouple(blank, noisy), beam(OMEGA, HOLDER)
    exact, found = couple(holder, base)[:, 0, 0], couple(holder, back)[:, 0, 0]
    assert np.median(np.abs(found - exact) / np.abs(exact)) < 0.16


def test_rotations_from_translations():
    """First mode of a cantilever-like holder: slopes within some per cent at 30 mm."""
    base = beam(OMEGA, SPINDLE).r11
    tip, inner = Section(0.03, 0.04, **STEEL), Section(0.06, 0.04, **STEEL)
    free = beam(OMEGA, [tip])
    rest = couple(beam(OMEGA, [inner]), base)
    whole = couple(free, rest)
    hold = np.linalg.solve(free.r22 + rest, free.r21)
    cross = (rest @ hold)[:, 0, 0]  # y₂/f₁
    far = rest - rest @ np.linalg.solve(free.r22 + rest, rest)
    found = rotations(whole[:, 0, 0], cross, 0.03, far[:, 0, 0])
    low = np.less(OMEGA, 2.0 * np.pi * 800.0)
    change = np.abs(found[low, 0, 1] - whole[low, 0, 1]) / np.abs(whole[low, 0, 1])
    assert change.max() < 0.25


def test_refusals():
    tool = beam(OMEGA, HOLDER)
    with pytest.raises(InvalidInput, match="different size"):
        couple(tool, np.zeros((len(OMEGA), 4, 4), dtype=complex))
    with pytest.raises(InvalidInput, match="does not respond to the base"):
        uncouple(tool, tool.r11)
    with pytest.raises(InvalidInput, match="stiffness above 0"):
        joint_flexibility(OMEGA, -1.0, 1.0)
    with pytest.raises(InvalidInput, match="above 0 Hz"):
        beam(np.array([0.0]), HOLDER)
    with pytest.raises(InvalidInput, match="spacing"):
        rotations(tool.r11[:, 0, 0], tool.r12[:, 0, 0], 0.0)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"base": None}, "arrays of complex numbers"),
        ({"base": np.full((len(OMEGA), 2, 2), np.nan)}, "not a finite number"),
        ({"base": np.ones((len(OMEGA), 4, 4))}, "same directions"),
        ({"tool": "hsk"}, "couple: tool must be a Ends"),
        ({"joint": np.ones(3)}, r"joint: given shape \(3,\)"),
        ({"tool": Ends(*[np.zeros((len(OMEGA), 2, 2))] * 4), "base": 0.0}, "undamped resonance"),
    ],
)
def test_refusals_of_couple(given, sentence):
    base = beam(OMEGA, SPINDLE).r11
    known = {"tool": beam(OMEGA, HOLDER), "base": base, **given}
    if isinstance(known["base"], float):
        known["base"] = known["base"] * base
    with pytest.raises(InvalidInput, match=sentence):
        couple(**known)


@pytest.mark.parametrize(
    "section",
    [
        Section(0.0, 0.05),
        Section(0.1, -0.05),
        Section(0.1, 0.05, 0.06),
        Section(0.1, 0.05, poisson=-1.0),
        Section(0.1, 0.05, young=math.nan),
        Section(0.1, 0.05, 0.02, stiff_diameter=0.02),
    ],
)
def test_sections_that_are_none(section):
    with pytest.raises(InvalidInput, match="allowed: length, diameter, young"):
        beam(OMEGA, [section])
