"""Stability lobes of a spindle: its own receptance at every speed, feed, faults, warnings."""

from __future__ import annotations

import math

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.stability_lobes import limit_depth
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.errors import InvalidInput, RotordynError
from rotordyn.scene.scene import Scene

ASKED = {
    "point": "tip",
    "teeth": 2,
    "diameter": "40 mm",
    "tangential": "600 MPa",
    "radial": "200 MPa",
    "milling": "up",
    "immersion": 0.4,
    "max_frequency": "3000 Hz",
}
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
      stiffness: {yy: 1e8 N/m, zz: 1e8 N/m}
      damping: {yy: 600 N s/m, zz: 600 N s/m}
    - name: rear
      x: 350 mm
      stiffness: {yy: 1e8 N/m, zz: 1e8 N/m}
      damping: {yy: 600 N s/m, zz: 600 N s/m}
speeds: [9000 rpm, 18000 rpm]
analyses:
  stability_lobes:
"""


@pytest.fixture
def case(tmp_path):
    def write(**given):
        asked = {**ASKED, **given}
        lines = "".join(f"    {key}: {value}\n" for key, value in asked.items())
        path = tmp_path / "case.yaml"
        path.write_text(MACHINE + lines, encoding="utf-8")
        return rotordyn.load(path)

    return write


def tip_of(case, feed=0.0):
    scene = Scene(case.spindle, case.conditions, np.array(case.speeds), 3000.0, ("tip",))
    return Tip(scene, "tip", feed, 3000.0)


def test_limits_are_those_of_the_receptance_at_each_speed(case):
    loaded = case()
    result = rotordyn.run(loaded)["stability_lobes"]
    tip = tip_of(loaded)
    ends = 0.0, math.acos(1.0 - 0.8)
    for row, speed in enumerate(loaded.speeds):
        one = tip.at(row)
        found = limit_depth(
            lambda w, one=one: one.receptance(w[None])[0], 2, 6e8, 2e8, *ends, speed
        )
        assert result.depth.values[row] == pytest.approx(found.depth, rel=2e-3)
        assert result.chatter.values[row] == pytest.approx(found.frequency, rel=1e-3)
    per_minute = 0.4 * 0.04 * 1e-4 * 2 * np.array(loaded.speeds) / (2.0 * math.pi)
    np.testing.assert_allclose(result.removal.values, result.depth.values * per_minute)


def test_sense_of_rotation(case):
    """Feed and normal are z and y; the gyroscopic cross receptance is that of the frf analysis."""
    loaded = case()
    tip, omega = tip_of(loaded), 2.0 * math.pi * np.linspace(100.0, 2000.0, 50)
    found = tip.receptance(np.tile(omega, (2, 1)))
    system = tip.scene.system(tip.scene.owner("tip", "y"))
    place = tip.scene.spindle.place("tip")
    y, z = (system.linear.row(*place, way) for way in "yz")
    zy = system.receptance(omega, z[None], y[None])[:, 0]
    np.testing.assert_allclose(found[..., 0, 1], zy, rtol=1e-12)
    assert np.abs(zy).max() > 1e-3 * np.abs(found[..., 0, 0]).max()
    np.testing.assert_allclose(found[..., 1, 0], -zy, rtol=1e-6)


def test_the_feed_does_not_matter_on_an_axisymmetric_machine(case):
    one = rotordyn.run(case())["stability_lobes"].depth.values
    other = rotordyn.run(case(feed="37 deg"))["stability_lobes"].depth.values
    np.testing.assert_allclose(one, other, rtol=1e-6)


def test_zero_order_of_many_speeds_is_that_of_each(case):
    swept = "{from: 6000 rpm, to: 18000 rpm, count: 5}"
    loaded = case(method="zero-order", speeds=swept)
    result = rotordyn.run(loaded)["stability_lobes"]
    whole = Scene(loaded.spindle, loaded.conditions, np.array(loaded.speeds), 3000.0, ("tip",))
    scene = whole.at(result.cutting_speed.values)
    ends = 0.0, math.acos(1.0 - 0.8)
    for row, speed in enumerate(result.cutting_speed.values):
        one = Tip(scene, "tip", 0.0, 3000.0).at(row)
        found = limit_depth(
            lambda w, one=one: one.receptance(w[None])[0], 2, 6e8, 2e8, *ends, speed, "zero-order"
        )
        assert result.depth.values[row] == pytest.approx(found.depth, rel=2e-6)


def test_without_damping_there_are_no_lobes(case):
    loaded = case()
    bare = loaded.vary(
        {
            f"spindle.supports.{k}.damping.{way}": "0 N s/m"
            for k in ("front", "rear")
            for way in ("yy", "zz")
        }
    )
    with pytest.raises(InvalidInput, match=r"nothing damps the mode at .* give damping"):
        rotordyn.run(bare)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"immersion": 1.2}, "ratio out of range"),
        ({"helix": "90 deg"}, "angle out of range"),
        ({"tangential": "-5 MPa"}, "out of range"),
        ({"point": "nose"}, "unknown point"),
        ({"milling": "slot"}, "a slot has the immersion 1"),
        ({"helix": "30 deg", "method": "zero-order"}, "do not depend on it"),
        ({"teeth": 0}, "teeth"),
        ({"speeds": "[30000 rpm]"}, "above the highest speed of the case"),
    ],
)
def test_faults(case, given, sentence):
    with pytest.raises(RotordynError, match=sentence):
        case(**given)


def test_a_band_below_all_modes_is_refused(case):
    with pytest.raises(InvalidInput, match="raise max_frequency"):
        rotordyn.run(case(max_frequency="20 Hz"))
