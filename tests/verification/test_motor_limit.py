"""The depth of cut that a motor drives, against work by revolution in closed form."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.stability_lobes.figures.lobes import lobes_figure
from rotordyn.analyses.stability_lobes.page import page
from rotordyn.analyses.stability_lobes.summary import numbers, summary, warnings
from rotordyn.errors import InvalidInput
from rotordyn.job.solving import solve
from rotordyn.machine.motor import Motor
from rotordyn.results.described import Shown

RPM = np.array([2000.0, 4000.0, 6000.0, 8000.0])
MACHINE = """
title: A bar on two supports
spindle:
  title: A bar
  MOTOR
  shaft:
    start: 0 mm
    material: {name: steel, young_modulus: 210 GPa, density: 7850 kg/m^3, poisson_ratio: 0.3}
    sections: [{length: 300 mm, outer_diameter: 50 mm}]
  points: {tip: 0 mm}
  supports:
    - name: front
      x: 80 mm
      stiffness: {yy: 150 N/um, zz: 150 N/um}
      damping: {yy: 4000 N s/m, zz: 4000 N s/m}
    - name: rear
      x: 260 mm
      stiffness: {yy: 150 N/um, zz: 150 N/um}
      damping: {yy: 4000 N s/m, zz: 4000 N s/m}
speeds: [0 rpm, 8000 rpm]
analyses:
  stability_lobes:
    point: tip
    diameter: 40 mm
    feed_per_tooth: 0.15 mm
    max_frequency: 3000 Hz
    method: zero-order
    speeds: [2000 rpm, 4000 rpm, 6000 rpm, 8000 rpm]
"""
MILLING = """
    teeth: 3
    tangential: 600 MPa
    radial: 200 MPa
    milling: down
    immersion: 0.4
"""


@pytest.fixture
def solved(tmp_path):
    def run(cut=MILLING, motor="motor: {power: 1 kW, torque: 2 N m}"):
        path = tmp_path / "case.yaml"
        path.write_text(MACHINE.replace("MOTOR", motor) + cut, encoding="utf-8")
        return solve(rotordyn.load(path)).results["stability_lobes"]

    return run


def torque(rpm, power=1e3, most=2.0):
    return np.minimum(most, power / (rpm * math.pi / 30.0))


def test_the_motor_drives_what_the_removal_rate_takes(solved):
    """The mean power of milling is Ktc times the removal rate (Altintas 2012)."""
    found = solved(motor="motor: {power: 15 kW, torque: 25 N m}")
    by_depth = 600e6 * 0.4 * 0.04 * 0.15e-3 * 3 / (2.0 * math.pi)  # torque over depth [N]
    assert found.motor_depth == pytest.approx(torque(RPM, 15e3, 25.0) / by_depth, rel=1e-12)
    lesser = np.minimum(found.depth, found.motor_depth)
    rate = 0.4 * 0.04 * lesser * 0.15e-3 * 3 * RPM / 60.0
    assert found.motor_removal == pytest.approx(rate, rel=1e-12)
    assert found.motor == "15 kW, 25 N m"
    less = (found.motor_depth < found.depth).sum()
    assert less == 2, "both limit"
    (told,) = (each.replace("\xa0", " ") for each in summary(found) if each.startswith("motor"))
    assert f"before chatter does at {less} of 4 speeds" in told
    row = 3 if rate[3] > 0.999 * rate.max() else int(rate.argmax())
    assert row == 3, "of equal rates the one with the larger margin"
    assert f"{lesser[row] * 1e3:.2f} mm" in told
    assert f"at {RPM[row]:.0f}" in told
    assert told.endswith(f", stable up to {found.depth[row] * 1e3:.2f} mm")
    known = {each.name: each.value for each in numbers(found, None)}
    assert known["removal"] == pytest.approx(rate.max() * 60e6)


def test_rates_equal_but_for_rounding_are_reported_where_the_margin_is_largest(solved):
    """And speeds that are not solved are passed over."""
    found = solved(motor="motor: {power: 1 kW}")
    odd = np.array([math.nan, 1.0, 1.0 - 1e-9, 1.0])
    depth = np.array([math.nan, 1.1, 3.0, 2.0]) * found.motor_depth
    some = replace(found, depth=depth, motor_removal=found.motor_removal * odd)
    (told,) = (each.replace("\xa0", " ") for each in summary(some) if each.startswith("motor"))
    assert "before chatter does at all 3 speeds" in told
    assert "at 6000 rpm" in told
    assert told.endswith(f", stable up to {depth[2] * 1e3:.2f} mm")


def test_edges_of_a_planned_cut_take_their_part(solved):
    """Power of the cut at the depth that the motor drives is that of the motor."""
    edges = MILLING + "    cut: {depth: DEPTH, tangential_edge: 20 N/mm, radial_edge: 9 N/mm}\n"
    first = solved(edges.replace("DEPTH", "1 mm"))
    exact = float(first.motor_depth[3])
    found = solved(edges.replace("DEPTH", f"{exact!r} m"))
    assert found.cut_is_stable[3]
    assert found.cutting_power[3] == pytest.approx(1e3, rel=1e-9)
    assert found.motor_depth == pytest.approx(first.motor_depth, rel=1e-12)
    over = solved(edges.replace("DEPTH", f"{1.001 * exact!r} m"))
    told = [each for each in warnings(over) if "needs more than the motor supplies" in each]
    assert len(told) == 1
    assert "(1 kW, 2 N m) at 1 of 4 speeds, first at 8000 rpm" in told[0]
    assert not [each for each in warnings(first) if "motor" in each]
    unstable = replace(over, cut_is_stable=np.zeros(4, dtype=bool))
    assert not [each for each in warnings(unstable) if "motor" in each]


@pytest.mark.parametrize("angle", [0.0, 35.0, 60.0])
def test_turning_takes_the_part_of_its_force_along_the_cut(solved, angle):
    turning = f"    turning: {{force: 1500 MPa, force_angle: {angle} deg}}\n"
    found = solved(turning)
    along = 1500e6 * math.sin(math.radians(angle)) * 0.15e-3 * 0.02  # torque over depth
    if angle == 0.0:
        assert np.isinf(found.motor_depth).all()
        bare = replace(found, depth=found.motor_depth, motor_removal=found.motor_depth)
        (told,) = (line for line in summary(bare) if line.startswith("motor"))
        assert told.endswith("before chatter does at no speed")
        assert {each.name: each.value for each in numbers(bare, None)}["removal"] == math.inf
        assert found.motor_removal == pytest.approx(found.removal)
    else:
        assert found.motor_depth == pytest.approx(torque(RPM) / along, rel=1e-12)


def test_without_a_motor_nothing_is_said_or_drawn(solved):
    found, driven = solved(motor=""), solved()
    assert np.isnan(found.motor_depth).all()
    assert np.isnan(found.motor_removal).all()
    assert not any(line.startswith("motor") for line in summary(found))
    assert "removal" not in [n.name for n in numbers(found, None)]
    assert found.depth == pytest.approx(driven.depth, rel=1e-12)


def test_power_alone_and_torque_alone():
    for motor, expected in (
        (Motor(power=2e3), [20.0, 5.0]),
        (Motor(torque=8.0), [8.0, 8.0]),
        (Motor(2e3, 8.0), [8.0, 5.0]),
    ):
        assert [motor.torque_at(speed) for speed in (100.0, 400.0)] == pytest.approx(expected)
    assert Motor(torque=8.0).words == "8 N m"
    with pytest.raises(InvalidInput, match="missing key: power, torque or both"):
        Motor()


def test_the_line_of_the_motor_is_drawn(solved, tmp_path):
    found = solved()
    case = rotordyn.load(tmp_path / "case.yaml")
    (upper, *_) = lobes_figure(found, case.analyses["stability_lobes"]).axes
    label = "limit of the motor (1 kW, 2 N m)"
    (line,) = (each for each in upper.lines if each.get_label() == label)
    inside = found.motor_depth * 1e3 <= upper.get_ylim()[1]
    assert inside.any()
    assert line.get_ydata()[inside] == pytest.approx(found.motor_depth[inside] * 1e3)
    shown = Shown("", found, (), case.spindle)
    (chart, *_) = page(case.analyses["stability_lobes"], [shown])
    assert label in [trace.get("name") for trace in chart.traces]
