"""Tools on our own spindle by coupling, at rest and at speed, against the whole machine; modal fits
against noise."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from docs.generate.coupled_rows import peaks_over_computed
from rotordyn.analyses.coupling import (
    Section,
    amplification,
    beam,
    couple,
    turning_beam,
    uncouple,
)
from rotordyn.analyses.modal_fit import modal_fit
from rotordyn.errors import InvalidInput
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene

OMEGA = 2.0 * math.pi * np.linspace(50.0, 2500.0, 120)
WAYS = (("y", 1.0), ("thz", 1.0), ("z", 1.0), ("thy", -1.0))  # y, dy/dx, z, dz/dx
MEDIAN, ACROSS = 2e-4, 1e-3  # cones in pieces, modes of the reduced spindle cut off
TOOL = "hsk63_end_mill_16"


def receptance(spindle, point, speed, omega=OMEGA):
    """(f, 4, 4) of a point of a whole machine."""
    scene = Scene(spindle, Conditions(), np.array([speed]), 6000.0, (point,))
    system = scene.system(scene.owner(point, "y"))
    place = spindle.place(point)
    rows = np.array([sign * system.linear.row(*place, way) for way, sign in WAYS])
    responses, excitations = np.repeat(rows, 4, axis=0), np.tile(rows, (4, 1))
    found = system.receptance(omega, responses, excitations)[0]
    return np.moveaxis(found.reshape(4, 4, -1), -1, 0)


def sections(tool, pieces=24):
    """Cylinders of a tool; cones in pieces of their mean diameter."""
    found = []
    for own in tool.sections:
        front, rear = own.outer
        many = pieces if front != rear else 1
        for k in range(many):
            outer = front + (rear - front) * (k + 0.5) / many
            material = own.material
            elastic = material.young_modulus, material.density, material.poisson_ratio
            found.append(Section(own.length / many, outer, own.inner[0], *elastic))
    return found


@pytest.fixture(scope="module")
def bare():
    """Damped in its bearings alone: modal damping belongs to modes, which a tool changes."""
    return replace(rotordyn.model("spindles", "mfw2310"), rotor_damping=())


@pytest.mark.parametrize("rpm", [0.0, 24000.0])
def test_a_tool_on_our_own_spindle(bare, rpm):
    """The nose without a tool, and the tool alone give the tip of the whole machine."""
    speed = rpm * math.pi / 30.0
    base = receptance(bare, "nose_face", speed)
    tool = rotordyn.model("tools", TOOL)
    tip = couple(turning_beam(OMEGA, sections(tool), speed), base)
    whole = receptance(bare.with_tool(tool), "tip", speed)
    size = np.abs(whole[:, 0, 0])
    difference = np.abs(tip[:, 0, 0] - whole[:, 0, 0]) / size
    assert np.median(difference) < MEDIAN
    across = np.abs(tip[:, 0, 2] - whole[:, 0, 2]).max() / np.abs(whole[:, 0, 0]).max()
    assert across < ACROSS


def test_whirl_of_a_turning_shaft_at_rest_is_that_of_each_plane():
    parts = [Section(0.1, 0.03), Section(0.05, 0.05)]
    both, one = turning_beam(OMEGA, parts, 0.0), beam(OMEGA, parts)
    np.testing.assert_allclose(both.r12[:, :2, :2], one.r12, rtol=1e-12)
    assert not np.abs(both.r12[:, :2, 2:]).any()


def test_gyroscopic_reciprocity():
    """Exchanging tip and joint reverses the sense of rotation."""
    parts = [Section(0.1, 0.03), Section(0.05, 0.08)]
    one, other = (turning_beam(OMEGA, parts, speed) for speed in (2000.0, -2000.0))
    size = np.abs(one.r12).max()
    back = np.swapaxes(other.r21, 1, 2)
    np.testing.assert_allclose(one.r12, back, atol=1e-9 * size)
    assert np.abs(one.r11[:, 0, 2]).max() > 1e-3 * np.abs(one.r11[:, 0, 0]).max()


FINE = 2.0 * math.pi * np.linspace(100.0, 3000.0, 581)


def test_a_blank_gives_the_spindle_and_a_fit_takes_noise_away(bare):
    """The tip of an end mill, from the tip of a blank on the same spindle with 1 % of noise."""
    known, exact = (
        receptance(bare.with_tool(rotordyn.model("tools", name)), "tip", 0.0, FINE)[:, :2, :2]
        for name in ("hsk63_blank_60", TOOL)
    )
    blank, tool = (
        beam(FINE, sections(rotordyn.model("tools", n))) for n in ("hsk63_blank_60", TOOL)
    )

    def error(tip):
        found = couple(tool, uncouple(blank, tip))[:, 0, 0]
        return np.median(np.abs(found - exact[:, 0, 0]) / np.abs(exact[:, 0, 0]))

    rng = np.random.default_rng(7)
    noise = rng.standard_normal(known.shape) + 1j * rng.standard_normal(known.shape)
    noisy = known * (1.0 + 0.01 / math.sqrt(2.0) * noise)
    fit = modal_fit(FINE, noisy, 6)
    assert fit.misfit == pytest.approx(0.01, rel=0.15)
    assert error(known) < 2e-3
    assert error(fit(FINE)) < 0.6 * error(noisy)


def test_a_coupled_tool_lacks_the_modal_damping_of_the_rotor(bare):
    """Peaks in which the tool itself vibrates are too high by it, and exact without it."""
    tool = rotordyn.model("tools", TOOL)
    exact = np.array(peaks_over_computed(bare, tool, 0.0))
    np.testing.assert_allclose(exact[:, 1:], 1.0, atol=2e-3)
    modal = np.array(peaks_over_computed(rotordyn.model("spindles", "mfw2310"), tool, 0.0))
    assert (modal[:, 2] > 1.2).all()


STEEL = {"young": 210e9, "density": 7850.0, "loss_factor": 2e-2}
SPINDLE = [Section(0.1, 0.06, 0.02, **STEEL), Section(0.25, 0.07, 0.02, **STEEL)]
BLANK = beam(OMEGA, [Section(0.04, 0.05, **STEEL)])


def blank_tip():
    return couple(BLANK, beam(OMEGA, SPINDLE).r11)


def test_amplification_is_that_of_small_errors():
    """By many random changes of all entries; 600 of them give a deviation within 4 % or so."""
    rng, tip = np.random.default_rng(3), blank_tip()
    base = uncouple(BLANK, tip)
    moved = []
    for _ in range(600):
        change = rng.standard_normal(tip.shape) + 1j * rng.standard_normal(tip.shape)
        noisy = tip * (1.0 + 1e-9 / math.sqrt(2.0) * change)
        moved.append((uncouple(BLANK, noisy) - base) / base / 1e-9)
    spread = np.sqrt(np.mean(np.abs(moved) ** 2, axis=0))
    ratio = amplification(BLANK, tip) / spread
    assert abs(np.median(ratio) - 1.0) < 0.01
    assert np.abs(ratio - 1.0).max() < 0.25


@pytest.mark.parametrize(
    ("length", "diameter", "sentence"),
    [
        (0.04, 0.05, ""),
        (0.1, 0.05, ""),
        (0.3, 0.05, "as stiff as the spindle.* take a shorter blank"),
        (
            0.1,
            0.016,
            "so flexible that the noise .* hides the spindle: take a shorter or thicker blank",
        ),
    ],
)
def test_a_blank_that_hides_the_spindle_is_refused(length, diameter, sentence):
    """1 % of noise leaves errors of half of the base and more, known here; less is let pass."""
    blank, base = beam(OMEGA, [Section(length, diameter, **STEEL)]), beam(OMEGA, SPINDLE).r11
    tip, rng = couple(blank, base), np.random.default_rng(4)
    noise = rng.standard_normal(tip.shape) + 1j * rng.standard_normal(tip.shape)
    noisy = tip * (1.0 + 0.01 / math.sqrt(2.0) * noise)
    error = np.abs(uncouple(blank, noisy) / base - 1.0)[:, [0, 1], [0, 1]]
    assert (np.median(error, axis=0).min() > 0.5) == bool(sentence)
    assert np.median(np.abs(uncouple(blank, tip, noise=1e-9) / base - 1.0)) < 1e-6
    if sentence:
        with pytest.raises(InvalidInput, match=sentence):
            uncouple(blank, noisy, noise=0.01)
    else:
        uncouple(blank, noisy, noise=0.01)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"modes": 0}, "at least 1"),
        ({"modes": 40}, "too few frequencies for 40 modes"),
        ({"omega": OMEGA[::-1]}, "they must ascend"),
        ({"values": np.full((len(OMEGA), 2, 2), np.nan)}, "not a finite number"),
        ({"values": np.zeros((len(OMEGA), 2, 2))}, "zero at all frequencies"),
        ({"values": np.ones((3, 2, 2))}, "a value at each of the"),
        ({"coherence": np.full((len(OMEGA), 2, 2), np.nan)}, "from 0 to 1"),
        ({"coherence": np.ones(len(OMEGA))}, "that of the values"),
    ],
)
def test_refusals_of_a_fit(given, sentence):
    with pytest.raises(InvalidInput, match=sentence):
        modal_fit(**{"omega": OMEGA, "values": blank_tip(), "modes": 2, **given})
