"""Milling of a flexible workpiece: its receptance adds to that of the tool."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import rotordyn
from rotordyn.analyses.stability_lobes import limit_depth
from rotordyn.analyses.stability_lobes.modal import of_workpiece
from rotordyn.analyses.stability_lobes.workpiece_mode import WorkpieceMode
from rotordyn.errors import InvalidInput
from tests.verification.test_milled_surface import LOSSY, MACHINE

ASKED = """  frf:
    frequencies: {from: 0.1 Hz, to: 6000.1 Hz, step: 1 Hz}
    matrix: {responses: [tip.y, tip.z], excitations: [tip.y, tip.z]}
  stability_lobes:
    {point: tip, teeth: 2, diameter: 40 mm, tangential: 600 MPa, radial: 200 MPa, milling: up,
     immersion: 0.4, max_frequency: 3000 Hz, FURTHER}
"""
MODES = (
    WorkpieceMode(410.0, 0.02, 4e6),
    WorkpieceMode(1130.0, 0.03, 9e6, math.radians(30.0)),
)
GIVEN = (
    "workpiece_modes: [{frequency: 410 Hz, damping: 2 %, stiffness: 4 N/um}, "
    "{frequency: 1130 Hz, damping: 3 %, stiffness: 9 N/um, direction: 30 deg}]"
)


def receptance(omega):
    """Of these modes in feed and normal."""
    found = np.zeros((len(omega), 2, 2), dtype=complex)
    for mode in MODES:
        way = np.array([math.cos(mode.direction), math.sin(mode.direction)])
        r = omega / (2.0 * math.pi * mode.frequency)
        size = 1.0 / (mode.stiffness * (1.0 - r**2 + 2j * mode.damping * r))
        found += size[:, None, None] * np.outer(way, way)
    return found


@pytest.fixture
def run(tmp_path):
    def solved(*further, changed=("", "")):
        asked = ASKED.replace("FURTHER", ", ".join(further) or "feed: 0 deg")
        path = tmp_path / "case.yaml"
        path.write_text(MACHINE.replace(*changed) + asked, encoding="utf-8")
        return rotordyn.run(rotordyn.load(path))

    return solved


def test_receptance_of_modes():
    omega = np.linspace(0.0, 1e4, 101)
    found = of_workpiece(MODES).receptance(omega)
    np.testing.assert_allclose(found, receptance(omega), rtol=1e-9, atol=1e-20)


@pytest.mark.parametrize("changed", [("", ""), pytest.param(LOSSY, marks=pytest.mark.long)])
def test_limits_are_those_of_both_receptances(run, changed):
    """The machine's as ``frf`` has it, with the workpiece's beside it; with a loss factor the
    receptance is no sum of modes."""
    results = run(GIVEN, changed=changed)
    found, frf = results["stability_lobes"], results["frf"]
    known = 2.0 * math.pi * frf.frequency.values
    ends = 0.0, math.acos(1.0 - 0.8)
    for row, speed in enumerate(found.cutting_speed.values):
        # y by y, y by z, z by y, z by z
        own = CubicSpline(known, frf.receptance.values[row].T)

        def tip(omega, own=own):
            every = own(np.minimum(omega, known[-1])).reshape(-1, 2, 2)
            falling = np.minimum(1.0, (known[-1] / omega) ** 2)  # beyond the band, as a mass
            return every[:, ::-1, ::-1] * falling[:, None, None] + receptance(omega)

        limit = limit_depth(tip, 2, 6e8, 2e8, *ends, speed)
        assert found.depth.values[row] == pytest.approx(limit.depth, rel=1e-4)
    alone = run(changed=changed)["stability_lobes"].depth.values
    assert (np.abs(found.depth.values / alone - 1.0) > 0.03).all()


def test_a_wall_in_front_of_a_tool_that_is_stiff_beside_it(run):
    """Vibration of the wall alone, in closed form for one mode: of all speeds the least depth is
    that of its least real part, by zero order in one direction."""
    soft = "workpiece_modes: [{frequency: 200 Hz, damping: 1 %, stiffness: 0.05 N/um}]"
    speeds = "speeds: {from: 900 rpm, to: 1500 rpm, step: 5 rpm}"
    found = run(soft, "method: zero-order", speeds)["stability_lobes"]
    entry, exit = 0.0, math.acos(1.0 - 0.8)
    at = np.linspace(entry, exit, 20001)
    s, c = np.sin(at), np.cos(at)
    mean = np.trapezoid((2e8 * c - 6e8 * s) * c, at) * 2 / (2.0 * math.pi)  # normal by normal
    stiffness, ratio = 5e4, 0.01
    real = -1.0 / (4.0 * stiffness * ratio * (1.0 + ratio))
    assert mean < 0.0  # the lobes are those of the largest real part
    real = 1.0 / (4.0 * stiffness * ratio * (1.0 - ratio))
    least = 1.0 / (2.0 * -mean * real)
    assert found.depth.values.min() == pytest.approx(least, rel=0.02)


def test_a_planned_cut_moves_the_workpiece(run):
    """Far below all modes the mean force moves it by its flexibility; the summary names it."""
    planned = "cut: {depth: 0.01 mm}"
    results = run(GIVEN, planned)
    found, rigid = results["stability_lobes"], run(planned)["stability_lobes"]
    moved = found.tip_deflection.values - rigid.tip_deflection.values
    at = np.linspace(0.0, math.acos(1.0 - 0.8), 20001)
    s, c = np.sin(at), np.cos(at)
    chip = 1e-4 * s
    force = [
        -np.trapezoid((6e8 * c + 2e8 * s) * chip, at),
        np.trapezoid((6e8 * s - 2e8 * c) * chip, at),
    ]
    mean = np.array(force) * 1e-5 * 2 / (2.0 * math.pi)
    expected = receptance(np.zeros(1)).real[0] @ mean
    np.testing.assert_allclose(moved, np.tile(expected, (2, 1)), rtol=1e-3)
    assert "flexible, modes at 409.9, 1129.5 Hz" in results.summary
    assert "against the workpiece up to" in results.summary
    assert found.workpiece_frequency.values == pytest.approx(
        [f.frequency * math.sqrt(1.0 - f.damping**2) for f in MODES]
    )


def test_the_mode_that_limits_is_said_to_be_that_of_the_workpiece(run):
    soft = "workpiece_modes: [{frequency: 300 Hz, damping: 1 %, stiffness: 0.5 N/um}]"
    said = " ".join(run(soft).summary.split())
    assert "by the mode at 300.0 Hz of the workpiece" in said
    assert "workpiece" not in run().summary


def test_modes_that_there_are_not(run):
    turning = "turning: {force: 2 GPa}, teeth: 0, tangential: null, radial: null"
    with pytest.raises(InvalidInput, match="workpiece_modes: of milling: given beside turning"):
        run(turning, GIVEN)
    for given, why in (
        ("{frequency: 300 Hz, stiffness: 1 N/um}", r"damping: missing key"),
        ("{frequency: 300 Hz, stiffness: 1 N/um, damping: 0 %}", r"damping: .*allowed: above 0 %"),
        ("{frequency: 300 Hz, stiffness: 0 N/um, damping: 1 %}", r"stiffness: .*allowed: above"),
    ):
        with pytest.raises(InvalidInput, match=why):
            run(f"workpiece_modes: [{given}]")
