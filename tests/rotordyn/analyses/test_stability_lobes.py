"""Stability lobes of a spindle: its own receptance at every speed, feed, faults, warnings."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from types import MappingProxyType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.signal import find_peaks

import rotordyn
from rotordyn.analyses.stability_lobes import converged, flips, limit_depth, solve, turning_limit
from rotordyn.analyses.stability_lobes.modal import Change
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.page import page
from rotordyn.analyses.stability_lobes.pockets import KEPT, MOST, PROMINENT, pockets
from rotordyn.analyses.stability_lobes.spec import Interval
from rotordyn.analyses.stability_lobes.summary import (
    SEEN,
    SKIPPED,
    _skipped,
    accuracy,
    numbers,
    summary,
    warnings,
)
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.case.archive import archived, restored
from rotordyn.errors import InvalidInput, RotordynError
from rotordyn.results.described import Shown
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
LOSSY = MACHINE.replace("  points:", "  damping: {loss_factor: 0.02}\n  points:")


def test_a_speed_without_a_solution_says_why():
    machine = rotordyn.load("deep_groove_lobes").variants["at_speed"]
    cutter = ["9000 rpm", "110000 rpm"]
    given = {"speeds": ["0 rpm", "110000 rpm"], "analyses.stability_lobes.speeds": cutter}
    results = rotordyn.run(machine.vary(given))
    found = results["stability_lobes"]
    assert np.isnan(found.depth.values).tolist() == [False, True]
    assert found.cutting_outcome.values[0] == ""
    why = str(found.cutting_outcome.values[1])
    assert "preload lost" in why
    words = "stability_lobes: no limit at 1 of 2 speeds of the cutter, first at 110000 rpm: "
    assert words + why in results.warnings


@pytest.fixture
def case(tmp_path):
    def write(machine=MACHINE, **given):
        asked = {**ASKED, **given}
        lines = "".join(f"    {key}: {value}\n" for key, value in asked.items())
        path = tmp_path / "case.yaml"
        path.write_text(machine + lines, encoding="utf-8")
        return rotordyn.load(path)

    return write


def tip_of(case, feed=0.0):
    scene = Scene(case.spindle, case.conditions, np.array(case.speeds), 3000.0, ("tip",))
    return Tip(scene, "tip", feed, 3000.0)


@pytest.mark.long
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


@pytest.mark.parametrize("stiff", ["1e8 N/m", "4e7 N/m"])
def test_modes_sum_to_the_receptance(case, stiff):
    """Of one complex plane, and of two planes held unlike."""
    loaded = case().vary({"spindle.supports.front.stiffness.zz": stiff})
    tip = tip_of(loaded, 0.3)
    omega = 2.0 * math.pi * np.tile(np.linspace(20.0, 3000.0, 200), (2, 1))
    known = tip.receptance(omega)
    size = np.abs(known).max()
    for row in range(2):
        own = tip.modes.at(row).receptance(omega[row])
        np.testing.assert_allclose(own, known[row], atol=1e-11 * size)
    sums = tip.modes.of(np.arange(2), float(omega.max())).receptance(omega)
    np.testing.assert_allclose(sums, known, atol=1e-8 * size)


TURNING_DAMPING = "  damping: {rotor: [1 %], internal: 100 %}\n  points:"


@pytest.mark.parametrize("front", ["1e8", "4e7"])
def test_a_change_as_a_whole_is_that_of_a_changed_machine(case, front):
    """All stiffness and damping of supports and of the shaft at 18000 rpm, in one complex plane and
    in two: the gyroscopic effect stays, what damping in the shaft adds to the stiffness is
    damping."""
    machine = MACHINE.replace("zz: 1e8", f"zz: {front}", 1).replace("  points:", TURNING_DAMPING)
    damping, stiff = f"{600 * 0.7 * math.sqrt(1.2)} N s/m", 1.2 * float(front)
    changed = machine.replace("yy: 1e8", "yy: 1.2e8").replace("zz: 1e8", "zz: 1.2e8")
    changed = changed.replace(f"zz: {front}", f"zz: {stiff}", 1).replace("210 GPa", "252 GPa")
    changed = changed.replace("600 N s/m", damping).replace("1 %", "0.7 %")
    omega = 2.0 * math.pi * np.linspace(20.0, 2500.0, 100)
    one, other = (tip_of(case(own)) for own in (machine, changed))
    found = one.changed(np.array([1]), Change(np.array([1.2]), np.array([0.7])))
    known = other.at(1).receptance(omega[None])
    size = np.abs(known).max()
    assert np.abs(one.at(1).receptance(omega[None]) - known).max() > 0.1 * size
    # the elements are as fine as the stiffness asks
    np.testing.assert_allclose(found.receptance(omega[None]), known, atol=2e-5 * size)


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
    """Refused at once where there is none at all, and when solved where it damps nothing."""
    loaded = case()

    def with_damping(value):
        ways = [f"{k}.damping.{way}" for k in ("front", "rear") for way in ("yy", "zz")]
        return loaded.vary({f"spindle.supports.{way}": value for way in ways})

    with pytest.raises(InvalidInput, match=r"the machine is undamped, so that no cut"):
        with_damping("0 N s/m")
    with pytest.raises(InvalidInput, match=r"the mode at .* is undamped, .* give damping"):
        rotordyn.run(with_damping("1e-9 N s/m"))


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
        (
            {"pitch": "[100 deg, 120 deg, 140 deg]"},
            "given 3 in number; allowed: 2, one for each tooth",
        ),
        ({"pitch": "[170 deg, 180 deg]"}, "given 350° in total; allowed: 360°"),
        ({"pitch": "[0 deg, 360 deg]"}, "angle out of range"),
    ],
)
def test_faults(case, given, sentence):
    with pytest.raises(RotordynError, match=sentence):
        case(**given)


SLENDER = MACHINE.replace("start: 0 mm", "start: -40 mm").replace(
    "sections: [", "sections: [{length: 40 mm, outer_diameter: 8 mm}, "
)


def unchecked(*_):
    """In place of the comparison with finer models."""
    return 0.0


def test_modes_above_the_band_are_found_where_they_limit(tmp_path, monkeypatch):
    """A slender tool: its own mode, at 3.6 kHz, is beyond a band of 900 Hz."""
    found = {}
    for highest in ("900 Hz", "12 kHz"):
        asked = ASKED | {"max_frequency": highest, "radial": "400 MPa", "milling": "down"}
        path = tmp_path / "tool.yaml"
        path.write_text(SLENDER.replace("tip: 0", "tip: -40") + f"    {asked}\n")
        with monkeypatch.context() as patch:
            if highest == "12 kHz":
                patch.setattr(converged, "_change", unchecked)
            found[highest] = rotordyn.run(rotordyn.load(path))
    low, high = (each["stability_lobes"] for each in found.values())
    assert float(low["modelled"]) > 900.0
    assert float(high["modelled"]) == 12000.0
    assert float(low["error"]) <= 0.05
    assert low["depth"].values == pytest.approx(high["depth"].values, rel=0.05)
    assert (low["chatter"].values > 3000.0).all()
    assert "limits within" in found["900 Hz"].summary
    monkeypatch.setattr(converged, "DOUBLINGS", 0)  # as a model that stays too coarse
    path.write_text(path.read_text().replace("12 kHz", "900 Hz"))
    coarse = rotordyn.run(rotordyn.load(path))
    assert np.abs(coarse["stability_lobes"]["depth"].values / low["depth"].values - 1.0).max() > 0.2
    (said,) = [each for each in coarse.warnings if "raise max_frequency" in each]
    assert "modes above 900 Hz" in said


LONG = MACHINE.replace("start: 0 mm", "start: -1600 mm").replace("tip: 0", "tip: -1600")
LONG = LONG.replace("sections: [", "sections: [{length: 1600 mm, outer_diameter: 24 mm}, ")
LONG = LONG.replace("  points:", "  damping: {rotor: [2 %]}\n  points:")


def test_a_bar_whose_first_mode_is_very_soft_has_limits(tmp_path):
    """1.6 m long: the modes by which it chatters have less than a hundredth of the receptance of
    the first, at 7 Hz, and the limit is 2000 times the depth that is certain to be stable. Zero
    order against dense samples of the receptance; all harmonics in a full slot nearly the same."""
    slot = ASKED | {"milling": "slot", "immersion": 1.0, "max_frequency": "1000 Hz"}
    asked = "  frf: {frequencies: {from: 3 Hz, to: 1000 Hz, step: 0.02 Hz}, pairs: ["
    asked += "{response: tip.y, excitation: tip.y}, {response: tip.z, excitation: tip.y}]}\n"
    found = []
    for method in ("zero-order", "multi-frequency"):
        path = tmp_path / "long.yaml"
        text = LONG.replace("  stability_lobes:\n", asked + "  stability_lobes:\n")
        path.write_text(text + f"    {slot | {'method': method}}\n")
        found.append(rotordyn.run(rotordyn.load(path)))
    mean = 0.5 * np.array([[200e6, 600e6], [-600e6, 200e6]])  # by (feed, normal) of two teeth
    for k, depth in enumerate(found[0]["stability_lobes"]["depth"].values):
        receptance = found[0]["frf"]["receptance"].isel(speed=k)
        direct, across = (receptance.isel(pair=j).values for j in (0, 1))
        back = np.exp(-2j * np.pi * receptance.frequency.values * 30.0 / (9000.0 * (k + 1)))
        whole = np.moveaxis(np.array([[direct, across], [-across, direct]]), -1, 0)
        values = np.linalg.eigvals((back - 1.0)[:, None, None] * (whole @ mean))
        values = np.take_along_axis(values, values.imag.argsort(axis=1), axis=1)
        low, high = values[:-1], values[1:]
        crossed = (low.imag * high.imag < 0.0) & (np.abs(high - low) < 0.1 * np.abs(low))
        share = low.imag / (low.imag - high.imag)
        real = np.where(crossed, low.real + share * (high.real - low.real), 0.0)
        assert depth == pytest.approx(1.0 / real.max(), rel=1e-3)
    other = found[1]["stability_lobes"]["depth"].values
    assert np.isfinite(other).all()


def test_each_finer_model_is_solved_once(tmp_path, monkeypatch):
    """At its speed, for all sources of the workpiece and however often the model is refined."""
    asked = ASKED | {"max_frequency": "900 Hz", "milling": "down", "workpiece": "al7075"}
    del asked["tangential"], asked["radial"]
    path = tmp_path / "tool.yaml"
    path.write_text(SLENDER.replace("tip: 0", "tip: -40") + f"    {asked}\n")
    models = []

    def tip(scene, *rest):
        models.append((scene.finer, *scene.speed))
        return Tip(scene, *rest)

    monkeypatch.setattr(solve, "Tip", tip)
    found = rotordyn.run(rotordyn.load(path))["stability_lobes"]
    assert float(found["modelled"]) > 900.0
    assert len({finer for finer, *_ in models}) > 2
    assert len(models) == len({*models})


@pytest.mark.parametrize(("modelled", "most"), [(3000.0, 48e3), (4000.0, 64e3), (20e3, 80e3)])
def test_finer_models_end_beyond_60_khz(tmp_path, monkeypatch, modelled, most):
    """Sixteen times the frequency requested, or the first power of two beyond 60 kHz."""
    asked = []

    def depth(self, scene, row, doublings, number):
        asked.append(modelled * 2.0 ** (scene.finer + doublings))
        return math.nan

    monkeypatch.setattr(converged._Finer, "depth", depth)
    path = tmp_path / "tool.yaml"
    path.write_text(MACHINE + f"    {ASKED | {'max_frequency': f'{modelled:g} Hz'}}\n")
    rotordyn.run(rotordyn.load(path))
    assert max(asked) == most


def test_a_mode_far_above_all_others_is_found(tmp_path, monkeypatch):
    """Of a stubby tool on hardly damped springs; a model of twice the band does not have it."""
    stub = (
        SLENDER.replace("-40 mm", "-35 mm").replace("tip: 0", "tip: -35").replace("600 N", "240 N")
    )
    stub = stub.replace(
        "length: 40 mm, outer_diameter: 8 mm", "length: 35 mm, outer_diameter: 12.7 mm"
    )
    found = []
    for highest in ("900 Hz", "25 kHz"):
        asked = ASKED | {"max_frequency": highest, "teeth": 3, "diameter": "9 mm"}
        path = tmp_path / "stub.yaml"
        path.write_text(stub + f"    {asked}\n")
        with monkeypatch.context() as patch:
            if highest == "25 kHz":
                patch.setattr(converged, "_change", unchecked)
            found.append(rotordyn.run(rotordyn.load(path))["stability_lobes"])
    low, high = found
    assert float(low["modelled"]) > 1800.0
    assert low["depth"].values == pytest.approx(high["depth"].values, rel=0.05)


def test_a_band_below_all_modes_is_refused(case):
    with pytest.raises(InvalidInput, match="raise max_frequency"):
        rotordyn.run(case(max_frequency="20 Hz"))


SWEPT = "{from: 6000 rpm, to: 18000 rpm, count: 9}"


def lobes(case):
    return rotordyn.run(case)["stability_lobes"]


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("rpm", "damping"), [(30.0, 1.2e4), (30.0, 1.6e4), (60.0, 2e4), (3000.0, 2e4)]
)
def test_slow_turning_with_process_damping(case, rpm, damping):
    """Against dense samples: in a slow turn the phase passes through a peak a hundred times."""
    loaded = case(
        teeth=0,
        tangential="null",
        radial="null",
        turning="{force: 2 GPa, force_angle: 0 deg}",
        process_damping=f"{damping} N/m",
        speeds=f"[{rpm} rpm]",
    )
    speed = rpm * math.pi / 30.0
    scene = Scene(loaded.spindle, loaded.conditions, np.array(loaded.speeds), 3000.0, ("tip",))
    tip = Tip(scene.at(np.array([speed])), "tip", 0.0, 3000.0).at(0)
    omega = np.arange(10.0, float(tip.tops[0]), 0.002 * speed)
    moved = tip.receptance(omega[None])[0][:, 0, 0]
    rubbing = damping / (0.5 * loaded.analyses["stability_lobes"].diameter * speed)
    z = moved * (2e9 * np.expm1(-2.0j * math.pi * omega / speed) - 1j * omega * rubbing)
    at = np.flatnonzero(z.imag[:-1] * z.imag[1:] < 0.0)
    share = z.imag[at] / (z.imag[at] - z.imag[at + 1])
    largest = (z.real[at] + share * (z.real[at + 1] - z.real[at])).max()
    assert lobes(loaded).depth.values[0] == pytest.approx(1.0 / largest, rel=1e-3)


def test_slow_turning_with_a_loss_factor(case):
    """The receptance is no sum of modes: known at fewer frequencies than there are waves in a turn
    (7214), against splines through other ones and dense samples."""
    loaded = case(
        LOSSY,
        teeth=0,
        tangential="null",
        radial="null",
        turning="{force: 2 GPa, force_angle: 0 deg}",
        speeds="[20 rpm]",
    )
    speed = 20.0 * math.pi / 30.0
    scene = Scene(loaded.spindle, loaded.conditions, np.array(loaded.speeds), 3000.0, ("tip",))
    tip = Tip(scene.at(np.array([speed])), "tip", 0.0, 3000.0).at(0)
    known = np.linspace(1.0, float(tip.tops[0]), 9000)
    moved = CubicSpline(known, tip.receptance(known[None])[0][:, 0, 0])
    omega = np.arange(known[0], known[-1], 0.005 * speed)
    z = moved(omega) * 2e9 * np.expm1(-2.0j * math.pi * omega / speed)
    at = np.flatnonzero(z.imag[:-1] * z.imag[1:] < 0.0)
    share = z.imag[at] / (z.imag[at] - z.imag[at + 1])
    largest = (z.real[at] + share * (z.real[at + 1] - z.real[at])).max()
    assert lobes(loaded).depth.values[0] == pytest.approx(1.0 / largest, rel=1e-3)


def test_turning_is_that_of_the_oriented_receptance(case):
    """Motion towards the tool by a force that leans towards the cutting speed."""
    loaded = case(
        teeth=0,
        tangential="null",
        radial="null",
        turning="{force: 2 GPa, force_angle: 50 deg, direction: 30 deg}",
        speeds=SWEPT,
    )
    result = lobes(loaded)
    speeds = result.cutting_speed.values
    scene = Scene(loaded.spindle, loaded.conditions, np.array(loaded.speeds), 3000.0, ("tip",))
    n = np.array([-math.sin(math.radians(30.0)), math.cos(math.radians(30.0))])  # in y and z
    along = np.array([-n[1], n[0]])  # the spindle turns from y to z
    lean = math.cos(math.radians(50.0)) * n + math.sin(math.radians(50.0)) * along
    tip = Tip(scene.at(speeds), "tip", 0.0, 3000.0)
    for row, speed in enumerate(speeds):
        one = tip.at(row)

        def oriented(omega, one=one):
            whole = one.receptance(omega[None])[0][:, ::-1, ::-1]  # normal y, feed z
            return np.einsum("i,fij,j->f", n, whole, lean)

        found = turning_limit(oriented, 2e9, speed)
        assert result.depth.values[row] == pytest.approx(found.depth, rel=1e-5)
    removal = result.depth.values * 1e-4 * 0.02 * speeds
    np.testing.assert_allclose(result.removal.values, removal)


def test_a_band_of_stiffness_misses_no_lobe(case):
    """At low speeds several pass one speed within it; of stiffness c the receptance is that at
    ω/√c over c, but for process damping."""
    turned = dict(teeth=0, tangential="null", radial="null", turning="{force: 2 GPa}")
    slow = case(**turned, speeds="[1000 rpm]", interval="{stiffness: 10 %}")
    result = lobes(slow)
    speeds = result.cutting_speed.values
    scene = Scene(slow.spindle, slow.conditions, np.array(slow.speeds), 3000.0, ("tip",))
    tip, lean = Tip(scene.at(speeds), "tip", 0.0, 3000.0), math.radians(60.0)
    for row, speed in enumerate(speeds):
        one, depth = tip.at(row), []
        for c in np.linspace(0.9, 1.1, 81):

            def oriented(omega, one=one, c=c):
                whole = one.receptance(omega[None] / math.sqrt(c))[0] / c  # feed, normal
                return math.cos(lean) * whole[:, 0, 0] - math.sin(lean) * whole[:, 0, 1]

            depth.append(turning_limit(oriented, 2e9, speed).depth)
        assert result.least.values[row] == pytest.approx(min(depth), rel=0.02)
        assert result.most.values[row] == pytest.approx(max(depth), rel=0.05)


@pytest.mark.long
def test_band_holds_the_limits_of_changed_machines(case):
    """Stiffness and damping at the ends of their intervals, and the share of the coefficients."""
    result = lobes(case(speeds=SWEPT, interval="{stiffness: 10 %, damping: 20 %}"))
    assert (result.least.values < result.depth.values).all()
    assert (result.most.values > result.depth.values).all()
    softer = MACHINE.replace("1e8 N/m", "0.9e8 N/m").replace("210 GPa", "189 GPa")
    weaker = f"{600 * math.sqrt(0.9) * 0.8} N s/m"
    changed = lobes(case(softer.replace("600 N s/m", weaker), speeds=SWEPT)).depth.values
    assert (changed >= result.least.values * (1.0 - 1e-4)).all()
    assert (changed <= result.most.values * (1.0 + 1e-4)).all()


@pytest.mark.long
def test_the_least_of_a_band_is_the_least_of_machines_within_the_interval(case):
    """Runs of the machine with its values changed one by one, on unlike supports that couple the
    planes: their damping ratios do not follow the damping alone, and at 11250 rpm limits between
    two modes are half as deep over 2 % of the stiffness."""

    def machine(stiffness, damping):
        k, c = stiffness, damping * math.sqrt(stiffness)
        return f"""
spindle:
  shaft:
    start: 0 mm
    material: &st {{name: st, young_modulus: 206 GPa, density: 7850 kg/m^3, poisson_ratio: 0.29}}
    sections: [{{length: 300 mm, outer_diameter: 50 mm}}]
  discs:
    - {{name: d, x: 260 mm, outer_diameter: 150 mm, inner_diameter: 50 mm, width: 30 mm,
       material: *st}}
  points: {{tip: 0 mm}}
  supports:
    - name: f
      x: 50 mm
      stiffness: {{yy: {40 * k} N/um, zz: {30 * k} N/um, yz: {3 * k} N/um, zy: {-2 * k} N/um}}
      damping: {{yy: {700 * c} N s/m, zz: {900 * c} N s/m}}
    - name: r
      x: 220 mm
      stiffness: {{yy: {30 * k} N/um, zz: {35 * k} N/um}}
      damping: {{yy: {500 * c} N s/m, zz: {300 * c} N s/m}}
conditions: {{rotor: rigid}}
speeds: [0 rpm, 12000 rpm]
analyses:
  stability_lobes:
"""

    speeds = "[5000 rpm, 6750 rpm, 9000 rpm, 11250 rpm]"
    asked = {
        "speeds": speeds,
        "teeth": 3,
        "diameter": "30 mm",
        "tangential": "800 MPa",
        "radial": "300 MPa",
        "milling": "down",
        "immersion": 0.2,
        "max_frequency": "2000 Hz",
    }
    band = lobes(case(machine(1.0, 1.0), interval="{stiffness: 10 %, damping: 20 %}", **asked))
    each = np.array(
        [
            lobes(case(machine(stiffness, damping), **asked)).depth.values
            for stiffness in np.linspace(0.9, 1.1, 41)
            for damping in (0.8, 1.0, 1.2)
        ]
    )
    assert (band.least.values <= 1.002 * each.min(axis=0)).all()
    assert (band.least.values >= 0.98 * each.min(axis=0)).all()  # between those of the runs
    assert (band.most.values >= 0.95 * each.max(axis=0)).all()


def test_band_of_coefficients_divides_the_limits(case):
    result = lobes(case(speeds=SWEPT, interval="{coefficients: 25 %}"))
    np.testing.assert_allclose(result.least.values, result.depth.values / 1.25, rtol=1e-12)
    np.testing.assert_allclose(result.most.values, result.depth.values / 0.75, rtol=1e-12)


@pytest.mark.long
def test_sources_of_a_workpiece_span_a_band(case):
    """Limits of the middle source, and between those of all."""
    named = {"tangential": "null", "radial": "null", "speeds": SWEPT}
    result = lobes(case(workpiece="al7075", **named))
    pairs = (("767 MPa", "169 MPa"), ("600 MPa", "181 MPa"), ("1319 MPa", "789 MPa"))
    each = np.array(
        [lobes(case(tangential=t, radial=r, speeds=SWEPT)).depth.values for t, r in pairs]
    )
    np.testing.assert_allclose(result.depth.values, each[0], rtol=1e-9)
    np.testing.assert_allclose(result.least.values, each.min(axis=0), rtol=1e-9)
    np.testing.assert_allclose(result.most.values, each.max(axis=0), rtol=1e-9)


def test_the_summary_tells_the_coefficients_of_a_workpiece_and_the_least_of_the_band(case):
    named = {"tangential": "null", "radial": "null", "workpiece": "al7075", "speeds": SWEPT}
    results = rotordyn.run(case(**named, method="zero-order"))
    found = results["stability_lobes"]
    said = " ".join(results.summary.split())
    assert "aluminium 7075, Ktc and Krc [MPa]: 767 and 169; from other sources 600 and 181," in said
    row = int(found.least.values.argmin())
    least, rpm = 1e3 * float(found.least[row]), float(found.cutting_speed[row]) * 30.0 / math.pi
    sure = f"band over intervals and sources stable up to {least:.3g} mm, limited at {rpm:.0f} rpm"
    assert sure in said
    plain = rotordyn.run(case(speeds=SWEPT, method="zero-order")).summary
    assert "Ktc" not in plain
    assert "\nband" not in plain


def paged(**given):
    """A result of nine speeds, as far as a page looks at it."""
    depth, nothing = np.linspace(2e-3, 3e-3, 9), np.full(9, np.nan)
    usual = {
        "cutting_speed": np.linspace(6e3, 18e3, 9) * math.pi / 30.0,
        "depth": depth,
        "least": 0.5 * depth,
        "most": 2.0 * depth,
        "at_rest": 1.5 * depth,
        "measured": nothing,
        "even": nothing,
        "loss": ("hopf",) * 9,
        "chatter": np.full(9, 900.0),
        "mode_frequency": np.full(9, 880.0),
        "wall": (),
        "milling_speed": np.zeros(0),
        "cut_is_stable": np.zeros(0, bool),
        "motor": "",
        **dict.fromkeys(("pocket_speed", "pocket_from", "pocket_to"), np.zeros(0)),
        **dict.fromkeys(("pocket_depth", "pocket_removal"), np.zeros(0)),
    }
    return Shown("one", SimpleNamespace(**usual | given), (), None)


def drawn(chart):
    """What a chart shows by its names."""
    return {each["name"]: each["y"] for each in chart.traces if each.get("showlegend", True)}


def test_a_page_shows_all_limits_of_one_machine():
    depth = np.linspace(2e-3, 3e-3, 9)
    flips = np.arange(9) == 4
    one = paged(
        measured=0.9 * depth,
        even=1.1 * depth,
        loss=tuple(np.where(flips, "flip", "hopf").tolist()),
        motor="4 kW",
        motor_depth=0.7 * depth,
    )
    limits, chatter = page(None, [one])
    assert drawn(limits) == {
        "depth of cut": pytest.approx(1e3 * depth),
        "on the measured spindle": pytest.approx(0.9e3 * depth),
        "limit of the motor (4 kW)": pytest.approx(0.7e3 * depth),
        "with the receptance at rest": pytest.approx(1.5e3 * depth),
        "with evenly spaced teeth": pytest.approx(1.1e3 * depth),
        "least of the band": pytest.approx(0.5e3 * depth),
        "largest of the band": pytest.approx(2e3 * depth),
        "period doubling": pytest.approx(np.where(flips, 1e3 * depth, np.nan), nan_ok=True),
    }
    assert drawn(chatter) == {
        "chatter": pytest.approx(np.full(9, 900.0)),
        "nearest mode": pytest.approx(np.full(9, 880.0)),
    }


def test_a_page_of_several_machines_has_the_limits_of_their_motors_and_measured_spindles():
    depth = np.linspace(2e-3, 3e-3, 9)
    one = paged(motor="4 kW", motor_depth=0.7 * depth, measured=0.9 * depth)
    (both,) = page(None, [one, paged()._replace(title="other")])
    names = {each["name"] for each in both.traces}
    measured, motor = "on the measured spindle", "limit of the motor (4 kW)"
    assert names == {"one", "other", f"one, {measured}", f"one, {motor}"}


def test_a_page_shows_a_planned_cut_and_the_pockets():
    rpm, wall = np.linspace(6e3, 18e3, 9), np.full((9, 1), 2e-6)
    least, swing = -1.5 * wall, np.stack([np.arange(9.0), np.arange(9.0) + 1.0], axis=1)
    one = paged(
        wall=("up",),
        direction=("feed", "normal"),
        milling_speed=rpm * math.pi / 30.0,
        cut_is_stable=np.ones(9, bool),
        surface_error_least=least,
        surface_error_most=wall,
        tip_vibration=1e-6 * swing,
        cutting_force=np.full(9, 40.0),
        pocket_speed=np.array([700.0 * math.pi, 500.0 * math.pi]),
        pocket_from=np.array([600.0 * math.pi, 450.0 * math.pi]),
        pocket_to=np.array([800.0 * math.pi, 550.0 * math.pi]),
        pocket_depth=np.array([4e-3, 3.5e-3]),
        pocket_removal=np.array([2e-6, 1e-6]),
    )
    charts = {block.title: block for block in page(None, [one])}
    assert [*charts["up: error of the up-milled wall"].traces[0]["y"]] == pytest.approx([-3.0] * 9)
    vibration = drawn(charts["vibration of the tip from peak to peak"])
    assert vibration == {
        way: pytest.approx(swing[:, k]) for k, way in enumerate(one.result.direction)
    }
    (force,) = charts["largest cutting force"].traces
    assert [*force["y"]] == [40.0] * 9
    assert [*charts["Pockets"].rows] == [
        ("21000", "4.00", "120.0", "18000", "24000"),
        ("15000", "3.50", "60.0", "13500", "16500"),
    ]


@pytest.mark.parametrize(
    ("slow", "constant"),
    [("[3600 rpm, 6000 rpm]", 8e5), pytest.param("[900 rpm]", 2e5, marks=pytest.mark.long)],
)
def test_process_damping_deepens_slow_cuts(case, slow, constant):
    plain, damped = (
        lobes(case(speeds=slow, process_damping=f"{c} N/m")).depth.values for c in (0.0, constant)
    )
    assert (damped > 1.05 * plain).all()


def test_a_cut_too_slow_for_the_finer_model_keeps_the_first(tmp_path):
    """At 150 rpm waves of the tool's own mode are too many; what changes elsewhere is reported."""
    asked = ASKED | {"max_frequency": "900 Hz", "radial": "400 MPa", "milling": "down"}
    path = tmp_path / "tool.yaml"
    slow = SLENDER.replace("tip: 0", "tip: -40").replace("[9000 rpm", "[150 rpm, 9000 rpm")
    path.write_text(slow + f"    {asked}\n")
    found = rotordyn.run(rotordyn.load(path))
    lobes = found["stability_lobes"]
    assert float(lobes["modelled"]) == 900.0
    assert np.isfinite(lobes["depth"].values).all()
    assert any("raise max_frequency" in each for each in found.warnings)


@pytest.mark.parametrize("seed", range(20))
def test_pockets_are_the_prominent_peaks(seed: int) -> None:
    """Those of scipy.signal, which is not loaded for them; on even tops the middle counts. A peak
    to which 80 % of a deeper one hold all the way is part of that."""
    rng = np.random.default_rng(seed)
    depth = rng.integers(0, 6, 40).astype(float) if seed % 2 else rng.random(40)
    least = PROMINENT * depth.max()
    tops, _ = find_peaks(depth, prominence=least)
    deepest: list[int] = []
    for top in tops[np.argsort(-depth[tops], kind="stable")].tolist():
        ways = (depth[min(at, top) : max(at, top) + 1].min() / depth[at] for at in deepest)
        deepest += [] if any(share >= KEPT for share in ways) else [top]
    assert pockets(np.arange(40.0), depth).place.tolist() == deepest[:MOST]


def test_the_way_to_depths_without_limit_is_no_pocket() -> None:
    depth = np.array([np.inf, np.inf, 9.0, 2.0, 5.0, 2.0, 8.0, np.inf, 7.0, 1.0, 3.0, 1.0])
    found = pockets(np.arange(12.0), depth)
    assert found.place.tolist() == [4, 10]
    assert found.low[0] == pytest.approx(3.0 + 2.0 / 3.0)


def test_two_tops_of_one_plateau_are_one_pocket():
    """The dip between them, 10 %, is within the margin; one of 30 % parts them."""
    speed = np.arange(7.0)
    plateau = np.array([0.1, 1.0, 0.9, 0.98, 0.1, 0.5, 0.1])
    found = pockets(speed, plateau)
    assert found.place.tolist() == [1, 5]
    assert found.high[0] > 3.0
    plateau[2] = 0.7
    assert pockets(speed, plateau).place.tolist() == [1, 3, 5]


def test_pockets_and_their_margins():
    """A triangle of height 2 above 1: 80 % of 2 hold over 0.4 of its half width to both sides."""
    speed = np.linspace(0.0, 10.0, 101)
    depth = 1.0 + np.maximum(1.0 - np.abs(speed - 6.0), 0.0)
    found = pockets(speed, depth)
    assert found.place.tolist() == [60]
    np.testing.assert_allclose([found.low[0], found.high[0]], [5.6, 6.4], rtol=1e-12)
    assert not pockets(speed, np.full(101, np.inf)).place.size


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"turning": "{force: 2 GPa}"}, "of milling: given beside turning"),
        ({"teeth": 0}, "missing key: the number of teeth, or turning"),
        (
            {"teeth": 0, "pitch": "[180 deg, 180 deg]", "turning": "{force: 2 GPa}"},
            "pitch.*of milling: given beside turning",
        ),
        ({"radial": "null"}, "tangential and radial must be given, or workpiece"),
        ({"workpiece": "al7075"}, "workpiece: given beside tangential and radial: leave"),
        (
            {"workpiece": "al7", "tangential": "null", "radial": "null"},
            r"^[^\n]*unknown model: given 'al7'[^\n]*$",
        ),
        ({"interval": "{damping: 95 %}"}, "ratio out of range"),
        ({"process_damping": "-1 N/m"}, "stiffness out of range"),
    ],
)
def test_faults_of_turning_workpieces_and_intervals(case, given, sentence):
    with pytest.raises(RotordynError, match=sentence):
        case(**given)


def test_uneven_teeth_are_beside_evenly_spaced_ones(case):
    """Rounded pitches make a full turn; the figure has both."""
    uneven, even = (lobes(case(**given)) for given in ({"pitch": "[160.04 deg, 200 deg]"}, {}))
    np.testing.assert_array_equal(uneven.even, even.depth)
    assert np.isnan(even.even).all()
    assert (np.abs(uneven.depth / uneven.even - 1.0) > 0.02).all()
    listed = lobes(case(pitch="[180 deg, 180 deg]"))
    assert np.isnan(listed.even).all()
    np.testing.assert_array_equal(listed.depth, even.depth)
    turned = lobes(case(pitch="[200 deg, 160.04 deg]"))
    np.testing.assert_allclose(turned.depth, uneven.depth, rtol=1e-9)
    results = rotordyn.run(case(pitch="[160.04 deg, 200 deg]"))
    assert "even pitch evenly spaced teeth would be stable up to" in results.summary
    upper, _, *_ = results.plot("stability_lobes").axes
    assert "with evenly spaced teeth" in [line.get_label() for line in upper.get_lines()]


def test_a_loss_factor_leaves_no_modes_to_change(case):
    with pytest.raises(
        InvalidInput, match="not a sum of modes: leave process_damping and interval"
    ):
        lobes(case(LOSSY, process_damping="1e5 N/m"))


def test_cases_are_kept_with_their_results(case):
    """Workpiece, interval and turning come back from the folder of results."""
    turned = {"teeth": 0, "tangential": "null", "radial": "null", "turning": "{force: 2 GPa}"}
    named = {"workpiece": "al7075", "tangential": "null", "radial": "null"}
    for given in (turned, {**named, "interval": "{damping: 20 %}"}):
        spec = case(**given).analyses["stability_lobes"]
        assert restored(json.loads(json.dumps(archived(spec)))) == spec


def test_lobes_between_speeds_are_reported() -> None:
    """Waves from tooth to tooth are those of the chatter; a lobe passes where they change by 1."""
    case = rotordyn.load("deep_groove_lobes")
    spec = replace(case.analyses["stability_lobes"], max_frequency=2500.0)

    def solved(*rpm: float) -> Any:
        own = replace(spec, speeds=tuple(each * math.pi / 30.0 for each in rpm))
        return rotordyn.run(replace(case, variants={}, analyses={"stability_lobes": own}))

    sparse, dense = solved(4000.0, 5000.0, 9000.0), solved(4000.0, 4010.0, 4020.0)
    told = [each for each in sparse.warnings if "too far apart for the lobes" in each]
    assert len(told) == 1
    result = sparse["stability_lobes"]
    between = result.chatter.values / (2.0 * np.array([4000.0, 5000.0, 9000.0]) / 60.0)
    np.testing.assert_allclose(result.waves.values, between, rtol=1e-12)
    assert "from 4000 to 9000 rpm" in told[0]
    most = max(result.chatter.values[:2]) * 30.0  # waves times speed
    step = 1000.0 * 0.125 / (most * (1.0 / 4000.0 - 1.0 / 5000.0))
    assert f"steps of {step:.1f} rpm" in told[0]
    assert not [each for each in dense.warnings if "too far apart for the lobes" in each]
    assert "at all 3 speeds" in sparse.summary


def test_steps_that_are_not_reported_lose_a_quarter_of_a_lobe_at_most():
    """Turning on one mode of 1 %: least limits of samples, wherever they begin, over the lowest
    point of the lobe."""
    natural, each = 2.0 * math.pi * 600.0, 80

    def one_mode(omega):
        return 1e-7 / (1.0 - (omega / natural) ** 2 + 0.02j * omega / natural)

    waves = 3.0 + np.arange(each + 1) / each
    depth = np.array([turning_limit(one_mode, 2e9, natural / w).depth for w in waves])
    lost = {}
    for share in (SKIPPED, SEEN):
        step = round(share * each)
        lost[share] = max(depth[k::step].min() for k in range(step)) / depth.min()
    for share, most in lost.items():  # the frequency of the chatter moves along the lobe, too
        assert 1.0 < most < 1.0 / math.cos(math.pi * share)
    assert lost[SEEN] < 1.06 < lost[SKIPPED] < 1.2
    for step, told in ((0.99 * SKIPPED, 0), (1.01 * SKIPPED, 1)):
        speed = 600.0 / np.array([3.0, 3.0 - step])  # revolutions a second
        result = SimpleNamespace(
            cutting_speed=2.0 * math.pi * speed,
            chatter=np.full(2, 600.0),
            waves=600.0 / speed,
            loss=("hopf", "hopf"),
        )
        assert len(_skipped(result)) == told


CUTTER = """
spindle: deep_groove_rear
conditions: {{kinematics: hybrid, moment_sharing: equal}}
speeds: [0 rpm, 9000 rpm]
analyses:
  stability_lobes: {{point: nose, teeth: 2, diameter: 40 mm, tangential: 600 MPa, radial: 200 MPa,
    milling: down, immersion: {immersion}, max_frequency: 2500 Hz, speeds: {speeds}}}
"""


@pytest.mark.parametrize("immersion", ["30 %", "5 %"])
def test_period_doubling_between_speeds_is_reported(tmp_path, monkeypatch, immersion):
    """Where a step of 75 rpm passes it over, as deep and at the speed as steps of 6 rpm find it;
    these have it among their limits, and nothing is reported."""
    monkeypatch.setattr(converged, "_change", unchecked)
    found = []
    for speeds in ("[8825 rpm, 8900 rpm]", "{from: 8825 rpm, to: 8900 rpm, count: 13}"):
        path = tmp_path / "milling.yaml"
        text = CUTTER.format(immersion=immersion, speeds=speeds)
        path.write_text(text, encoding="utf-8")
        found.append(rotordyn.run(rotordyn.load(path)))
    coarse, fine = (each["stability_lobes"] for each in found)
    row = int(fine.depth.values.argmin())
    assert fine.loss.values[row] == "flip"
    assert fine.depth.values[row] < 0.95 * coarse.depth.values.min()
    assert coarse.flip_depth.values[0] == pytest.approx(float(fine.depth[row]), rel=0.03)
    rpm = coarse.flip_speed.values[0] * 30.0 / math.pi
    assert rpm == pytest.approx(float(fine.cutting_speed[row]) * 30.0 / math.pi, abs=8.0)
    told = [[w for w in each.warnings if "between speeds period" in w] for each in found]
    assert [len(each) for each in told] == [1, 0]
    depth, beside = (1e3 * float(each) for each in (coarse.flip_depth[0], coarse.depth.min()))
    assert f"at about {rpm:.0f} rpm to {depth:.2f} mm, where adjacent limits are" in told[0][0]
    assert f"{beside:.2f} mm and more: add speeds there" in told[0][0]


def coarse_and_fine(folder, mode, coarse, fine, instead=MappingProxyType({})):
    """Lobes of a flexible workpiece cut at 5 % of immersion at few speeds and at many, and of these
    the row of the least depth, which is one of period doubling."""
    found = []
    for speeds in (coarse, fine):
        asked = f"{speeds}, workpiece_modes: [{{{mode}}}]"
        text = CUTTER.format(immersion="5 %", speeds=asked)
        for old, new in instead.items():
            text = text.replace(old, new)
        path = folder / "milling.yaml"
        path.write_text(text, encoding="utf-8")
        found.append(rotordyn.run(rotordyn.load(path))["stability_lobes"])
    row = int(found[1].depth.values.argmin())
    assert found[1].loss.values[row] == "flip"
    return *found, row


@pytest.mark.parametrize("beyond", [", 8000 rpm", ""])
def test_period_doubling_along_the_feed_lies_above_the_waves_of_a_period(
    tmp_path, monkeypatch, beyond
):
    """In down-milling more than 2.5 waves of 640 Hz, which are those of 7680 rpm, are least stable
    there: in the step before that of this speed, or before all."""
    monkeypatch.setattr(converged, "_change", unchecked)
    mode = "frequency: 640 Hz, damping: 1.5 %, stiffness: 2 N/um, direction: 0 deg"
    speeds = f"[7200 rpm, 7600 rpm{beyond}]", "{from: 7440 rpm, to: 7520 rpm, count: 17}"
    coarse, fine, row = coarse_and_fine(tmp_path, mode, *speeds)
    assert fine.depth.values[row] < 0.8 * coarse.depth.values[:2].min()
    assert coarse.flip_depth.values[0] == pytest.approx(float(fine.depth[row]), rel=0.03)
    assert coarse.flip_speed.values[0] == pytest.approx(float(fine.cutting_speed[row]), rel=1e-3)


def test_period_doubling_far_from_the_waves_of_its_mode_is_found(tmp_path, monkeypatch):
    """At small immersion along the normal, four damping ratios below 2.5 waves, which the mode
    makes at 19386 rpm, below all speeds."""
    monkeypatch.setattr(converged, "_change", unchecked)
    mode = "frequency: 2423.3 Hz, damping: 1.532 %, stiffness: 0.0271 N/um"
    speeds = "[20600 rpm, 21300 rpm]", "{from: 20640 rpm, to: 20840 rpm, count: 11}"
    faster = {"teeth: 2": "teeth: 3", "9000 rpm": "24000 rpm", "2500 Hz": "3000 Hz"}
    coarse, fine, row = coarse_and_fine(tmp_path, mode, *speeds, instead=faster)
    assert fine.depth.values[row] < 0.85 * coarse.depth.values.min()
    assert coarse.flip_depth.values[0] == pytest.approx(float(fine.depth[row]), rel=0.03)


def test_period_doubling_by_half_a_wave_is_found(tmp_path, monkeypatch):
    """In a period of the teeth, which a mode of 140 Hz makes at 8400 rpm: the fastest lobe."""
    monkeypatch.setattr(converged, "_change", unchecked)
    mode = "frequency: 140 Hz, damping: 1.5 %, stiffness: 0.2 N/um"
    speeds = "[7800 rpm, 8200 rpm, 8900 rpm]", "{from: 8490 rpm, to: 8560 rpm, count: 15}"
    coarse, fine, row = coarse_and_fine(tmp_path, mode, *speeds)
    assert fine.depth.values[row] < 0.6 * coarse.depth.values.min()
    assert coarse.flip_depth.values[1] == pytest.approx(float(fine.depth[row]), rel=0.03)
    assert coarse.flip_speed.values[1] == pytest.approx(float(fine.cutting_speed[row]), rel=2e-3)


def test_period_doubling_is_not_looked_for_where_lobes_are_passed_over(case, monkeypatch):
    """Steps over most of a lobe, at low speeds, where each depth takes long."""
    asked = []

    def doubling(*given):
        asked.append(given)
        return math.inf

    monkeypatch.setattr(flips, "_doubling", doubling)
    monkeypatch.setattr(converged, "_change", unchecked)
    for speeds, some in (("[3000 rpm, 4500 rpm]", False), ("[16000 rpm, 18000 rpm]", True)):
        asked.clear()
        lobes(case(speeds=speeds))
        assert bool(asked) == some


@pytest.mark.parametrize(
    "more",
    [
        {"helix": "30 deg", "diameter": "20 mm"},
        {"pitch": "[170 deg, 190 deg]"},
        {"method": "zero-order"},
    ],
)
def test_period_doubling_is_looked_for_of_straight_and_even_teeth_alone(case, monkeypatch, more):
    """By the modes of the nearer speed."""
    asked = []

    def doubling(tip, row, operation, speed):
        asked.append((row, speed * 30.0 / math.pi))
        return math.inf

    monkeypatch.setattr(flips, "_doubling", doubling)
    monkeypatch.setattr(converged, "_change", unchecked)
    for speeds, nearer in (("[16000 rpm, 18000 rpm]", 1), ("[17850 rpm, 18000 rpm]", 0)):
        asked.clear()
        lobes(case(speeds=speeds))
        rows, rpm = zip(*asked, strict=True)
        first = len(flips.BESIDE)  # of the mode that crosses there; the next one does beyond
        there = int(np.abs(np.array(rpm[:first]) - 17900.0).argmin())
        assert rows[there] == nearer
        assert min(rpm[:first]) < 17900.0 < max(rpm[:first])
        asked.clear()
        lobes(case(speeds=speeds, **more))
    assert not asked


def test_the_cutter_of_a_tool_has_its_diameter() -> None:
    case = rotordyn.load("mfw2310_tools")
    spec = replace(case.analyses["stability_lobes"], speeds=(2000.0,))
    asked = {"stability_lobes": spec}
    for name in ("hsk63_end_mill_10", "hsk63_end_mill_20"):
        one = replace(case.variants[name], analyses=asked)
        found = rotordyn.run(one)["stability_lobes"]
        size = {"hsk63_end_mill_10": 0.010, "hsk63_end_mill_20": 0.020}[name]
        rate = found.depth.values * size * 1e-4 * 3 * 2000.0 / (2.0 * math.pi)
        np.testing.assert_allclose(found.removal.values, rate, rtol=1e-12)
    with pytest.raises(InvalidInput, match=r"diameter: given 0.016 m beside a tool of 20 mm"):
        replace(one, analyses={"stability_lobes": replace(spec, diameter=0.016)})
    bare = rotordyn.load("mfw2310_lobes")
    lobes = replace(bare.analyses["stability_lobes"], diameter=None)
    with pytest.raises(InvalidInput, match=r"missing key: the diameter of the cutter, or cutter_d"):
        replace(bare, variants={}, analyses={"stability_lobes": lobes})


@pytest.mark.parametrize("way", ["turning", "milling"])
def test_coefficients_off_beside_process_damping_are_solved(way: str) -> None:
    """The band is that of the two machines whose coefficients are off; neither divides a limit."""
    case = rotordyn.load("deep_groove_turning" if way == "turning" else "deep_groove_lobes")
    given = case.analyses["stability_lobes"]
    common = {"process_damping": 1e5, "speeds": (100.0, 300.0), "max_frequency": 2500.0}
    spec = replace(given, interval=Interval(coefficients=0.4), **common)

    def limits(factor: float, interval: Interval) -> Any:
        if spec.turning is not None:
            one = {"turning": replace(spec.turning, force=factor * spec.turning.force)}
        else:
            one = {"tangential": factor * spec.tangential, "radial": factor * spec.radial}
        own = replace(spec, interval=interval, **one)
        return rotordyn.run(replace(case, variants={}, analyses={"stability_lobes": own}))[
            "stability_lobes"
        ]

    band = limits(1.0, spec.interval)
    low, high = (limits(factor, Interval()).depth.values for factor in (1.4, 0.6))
    np.testing.assert_allclose(band.least.values, low, rtol=1e-6)
    np.testing.assert_allclose(band.most.values, high, rtol=1e-6)
    assert band.least.values[0] < band.depth.values[0] / 1.4


def test_coefficients_off_on_helical_edges_are_solved() -> None:
    case = rotordyn.load("mfw2310_lobes")
    asked = {"speeds": (900.0,), "helix": math.radians(45.0), "max_frequency": 2000.0}
    spec = replace(case.analyses["stability_lobes"], interval=Interval(coefficients=0.4), **asked)
    assert not Operation(spec, 1.0, 1.0).divides
    assert Operation(replace(spec, helix=0.0), 1.0, 1.0).divides
    turned = Operation(spec, 2.0, 3.0).times(1.4)
    assert (turned.tangential, turned.radial) == pytest.approx((2.8, 4.2))


def counted(depth, **given):
    """Headline numbers of limits (s,) by name."""
    depth = np.array(depth)
    nothing = {"pocket_depth": np.zeros(0), "cut_is_stable": np.zeros(0), "motor": ""}
    usual = {"depth": depth, "measured": np.full(len(depth), np.nan), "least": depth, "most": depth}
    result = SimpleNamespace(**nothing | usual | given)
    return {each.name: each.value for each in numbers(result, None)}


def test_a_least_limit_that_there_is_not_is_without_bound() -> None:
    """Among headline numbers; of speeds without a solution there is none."""
    for depth, least in (([np.inf, np.nan], np.inf), ([np.inf, 2e-3], 2.0), ([np.nan], np.nan)):
        assert counted(depth) == {"least": pytest.approx(least, nan_ok=True)}


def test_least_limits_of_a_measured_spindle_and_of_a_band_are_headline_numbers() -> None:
    """Where one was measured, and where a band is requested."""
    depth = np.array([4e-3, 3e-3])
    measured = counted(depth, measured=np.array([np.nan, 2e-3]))
    assert measured == {"least": 3.0, "measured least": 2.0}
    endless = counted(depth, measured=np.array([np.inf, np.inf]))
    assert endless == {"least": 3.0, "measured least": np.inf}
    banded = counted(depth, least=np.array([1e-3, 2e-3]), most=2.0 * depth)
    assert banded == {"least": 3.0, "least of the band": 1.0}


GROWING = MACHINE.replace("600 N s/m", "20 N s/m").replace(
    "  points:", "  damping: {rotor: [4 %], internal: 100 %}\n  points:"
)
TURNED = {"teeth": 0, "tangential": "null", "radial": "null", "turning": "{force: 2 GPa}"}


@pytest.mark.parametrize(
    ("machine", "given"),
    [
        (GROWING, {}),
        (GROWING, {"method": "zero-order", "interval": "{stiffness: 10 %, damping: 20 %}"}),
        (GROWING, TURNED),
        (GROWING.replace("zz: 1e8 N/m}", "zz: 1e8 N/m}\n      loss_factor: 0.001"), {}),
    ],
    ids=["multi-frequency", "zero-order", "turning", "loss factor"],
)
def test_a_machine_that_is_unstable_without_a_cut_has_no_stable_depth(case, machine, given):
    """Against the growing mode of the Campbell diagram; modes above it take no part."""
    asked = {"speeds": "[9000 rpm, 60000 rpm]", "max_frequency": "2000 Hz", **given}
    machine = machine.replace("[9000 rpm, 18000", "[9000 rpm, 60000")
    both = "campbell: {max_frequency: 2000 Hz}\n  stability_lobes:"
    results = rotordyn.run(case(machine.replace("stability_lobes:", both), **asked))
    modes, found = results["campbell"], results["stability_lobes"]
    assert (modes.damping_ratio.values[0] > 0.0).all()
    grown = int(np.nanargmin(modes.damping_ratio.values[1]))
    assert modes.damping_ratio.values[1, grown] < -1e-3
    assert found.loss.values.tolist() == ["hopf", "without a cut"]
    assert found.depth.values[0] > 0.0
    assert found.depth.values[1] == found.least.values[1] == found.most.values[1] == 0.0
    hertz = modes.frequency.values[1, grown]
    assert found.chatter.values[1] == pytest.approx(hertz, rel=1e-5)
    assert found.mode_damping.values[1] == pytest.approx(modes.damping_ratio.values[1, grown])
    assert float(found.modelled) == 2000.0
    said = " ".join(results.warnings)
    assert "the machine is unstable without a cut at 1 of 2 speeds of the cutter" in said
    assert "no depth of cut" not in results.summary


@pytest.mark.filterwarnings("error")
def test_a_machine_pushed_away_by_a_support_has_no_stable_depth(case, tmp_path):
    """Its motion does not oscillate, and nothing is left to draw."""
    results = rotordyn.run(case(MACHINE.replace("yy: 1e8 N/m", "yy: -1e7 N/m")))
    found = results["stability_lobes"]
    assert found.depth.values.tolist() == found.chatter.values.tolist() == [0.0, 0.0]
    assert "where a motion that does not oscillate grows" in " ".join(results.warnings)
    assert "no depth is stable" in results.summary
    results.save(tmp_path / "out")


def spoken(**given):
    """The summary of three speeds, the first of them unstable without a cut."""
    nothing = np.full(3, np.nan)
    usual = {
        "cutting_speed": np.array([1000.0, 2000.0, 3000.0]) * math.pi / 30.0,
        "depth": np.array([0.0, 2e-3, np.inf]),
        "loss": ("without a cut", "hopf", ""),
        "mode_frequency": np.array([800.0, 900.0, np.nan]),
        "chatter": np.array([800.0, 905.0, np.nan]),
        "pocket_speed": np.zeros(0),
        "pocket_depth": np.zeros(0),
        "pocket_removal": np.zeros(0),
        "source": np.zeros(0),
        "workpiece_frequency": np.zeros(0),
        "workpiece_mode": np.zeros(0),
        "least": nothing,
        "most": nothing,
        "even": nothing,
        "at_rest": nothing,
        "measured": nothing,
        "cut_is_stable": np.zeros(0),
        "motor": "",
    }
    lines = summary(SimpleNamespace(**usual | given))
    return {line.split()[0]: " ".join(line.split()) for line in lines}


def test_lines_of_limits_leave_speeds_out_that_are_unstable_without_a_cut():
    lines = spoken(
        least=np.array([0.0, 1e-3, np.inf]),
        most=np.array([0.0, 3e-3, np.inf]),
        even=np.array([0.0, 1.5e-3, 4e-3]),
        at_rest=np.array([5e-3, 2.2e-3, np.inf]),
    )
    assert "stable up to 2.00 mm at the other 2 speeds, limited at 2000 rpm" in lines["chatter"]
    assert "at 1 of 3 speeds every depth is stable: at 3000 rpm" in lines["no"]
    assert "stable up to 1.00 mm, limited at 2000 rpm" in lines["band"]
    assert "would be stable up to 1.50 mm" in lines["even"]
    assert "differs most at 1000 rpm: 5.00 mm in place of 0.00 mm" in lines["at"]
    assert "measured" not in lines
    chatter = np.array([910.0, 820.0, np.nan])
    lines = spoken(measured=np.array([0.8e-3, 1e-3, np.inf]), measured_chatter=chatter)
    assert "on the measured spindle is stable up to 0.800 mm, limited at 1000" in lines["measured"]
    assert "(chatter at 910.0 Hz)" in lines["measured"]
    assert lines["measured"].endswith("planned cuts are those of the machine as computed")


def test_of_rates_next_to_the_highest_the_safest_is_named():
    lines = spoken(
        depth=np.array([1.2e-3, 2e-3, 6e-3]),
        loss=("hopf",) * 3,
        motor="3 kW",
        motor_depth=np.array([3e-3, 1.5e-3, 1e-3]),
        motor_removal=np.array([1e-6, 2e-6, 1.999e-6]),
    )
    assert "3 kW: limits the cut before chatter does at 2 of 3 speeds" in lines["motor"]
    assert lines["motor"].endswith("rate 1.00 mm at 3000 rpm (119.9 cm³/min), stable up to 6.00 mm")


@pytest.mark.parametrize(("by_motor", "words"), [(1e-3, "before"), (3e-3, "after")])
def test_of_one_speed_the_motor_limits_the_cut_before_chatter_or_after_it(by_motor, words):
    one = {"cutting_speed": np.array([200.0]), "depth": np.array([2e-3]), "loss": ("hopf",)}
    modes = {"mode_frequency": np.array([800.0]), "chatter": np.array([805.0])}
    rates = {"motor_depth": np.array([by_motor]), "motor_removal": np.array([1e-6])}
    none = dict.fromkeys(("least", "most", "even", "at_rest", "measured"), np.full(1, np.nan))
    lines = spoken(**one, **modes, **rates, **none, motor="3 kW")
    assert f"motor 3 kW: limits the cut {words} chatter does; highest" in lines["motor"]


@pytest.mark.parametrize(
    ("depth", "loss", "first"),
    [
        ([0.0, 0.0, np.nan], ("without a cut", "without a cut", ""), "chatter"),
        ([0.0, np.inf, np.inf], ("without a cut", "", ""), "no"),
    ],
)
def test_that_no_depth_is_stable_is_said_of_every_speed_alone(depth, loss, first):
    lines = spoken(depth=np.array(depth), loss=loss, least=np.zeros(3), most=np.zeros(3))
    assert next(iter(lines)) == first
    assert ("no depth is stable" in lines.get("chatter", "")) == (first == "chatter")
    assert "band" not in lines


def test_a_limit_that_only_a_finer_model_has_is_reported():
    """One that is 0 or infinite with one of both models."""
    result = SimpleNamespace(
        error=math.inf,
        error_asked=0.05,
        modelled=4000.0,
        cutting_outcome=("",),
        loss=("hopf",),
        depth=np.array([1e-3]),
        chatter=np.array([500.0]),
        waves=np.array([1.0]),
        cutting_speed=np.array([500.0]),
        flip_depth=np.full(1, np.nan),
        measured_chatter=np.full(1, np.nan),
        measured_to=math.nan,
        measured_doubt="",
        cut_is_stable=np.zeros(0),
    )
    assert accuracy(result) == ["limits not known by modes up to 4000 Hz"]
    (told,) = warnings(result)
    assert "limits still change from or to no limit with modes above 4000 Hz" in told
    assert converged._difference(0.0, 1e-3) == converged._difference(1e-3, math.inf) == math.inf
    assert converged._difference(0.0, 0.0) == converged._difference(math.inf, math.inf) == 0.0
