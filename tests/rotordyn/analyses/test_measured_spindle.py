"""A tool on a spindle known by measured receptances: beside the whole machine, noise, faults."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses import registry
from rotordyn.analyses.frf.uff import write_uff
from rotordyn.analyses.on_measured import OnMeasured
from rotordyn.analyses.stability_lobes import converged, measured_tip
from rotordyn.analyses.stability_lobes.measured_tip import MeasuredTip
from rotordyn.analyses.stability_lobes.modal import of_workpiece
from rotordyn.analyses.stability_lobes.workpiece_mode import WorkpieceMode
from rotordyn.case.archive import archived, restored
from rotordyn.errors import InvalidInput, RotordynError
from rotordyn.job.solving import solve

MACHINE = """
title: A shaft on springs
spindle:
  title: A shaft
  shaft:
    start: 0 mm
    material: &steel {name: steel, young_modulus: 210 GPa, density: 7850 kg/m^3, poisson_ratio: 0.3}
    sections: [{length: 300 mm, outer_diameter: 60 mm}]
  supports:
    - name: front
      x: 40 mm
      stiffness: {yy: 2e8 N/m, zz: 1.2e8 N/m}
      damping: {yy: 4000 N s/m, zz: 3000 N s/m}
    - name: rear
      x: 250 mm
      stiffness: {yy: 1e8 N/m, zz: 1e8 N/m}
      damping: {yy: 3000 N s/m, zz: 3000 N s/m}
tool:
  material: *steel
"""
BLANK = """
  sections: [{length: 40 mm, outer_diameter: 50 mm}, {length: 25 mm, outer_diameter: 60 mm}]
  points: {tip: -65 mm, inner: -35 mm}
"""
TOOL = """
  sections:
    - {length: 50 mm, outer_diameter: 16 mm}
    - {length: 40 mm, outer_diameter: 30 mm, rear_outer_diameter: 40 mm}
    - {length: 25 mm, outer_diameter: 60 mm}
  points: {tip: -115 mm, behind: -60 mm}
"""
BAND = "{from: 60 Hz, to: 4000 Hz, step: 10 Hz}"
PAIRS = [("tip", "tip"), ("tip", "inner"), ("inner", "inner")]


def pairs(way):
    return [f"{{response: {one}.{way}, excitation: {other}.{way}}}" for one, other in PAIRS]


@pytest.fixture(scope="module")
def tested(tmp_path_factory):
    """A folder with the responses of a blank, in both planes: the UFF file of a run, tables."""
    folder = tmp_path_factory.mktemp("tested")
    respond(folder, BLANK, "tap.uff", "noisy.csv")
    (folder / "blank_tool.yaml").write_text(blank_file(BLANK), encoding="utf-8")
    return folder


def respond(folder, blank, exact, noisy):
    """Responses of the machine with a blank: a UFF file, a table of the same, and one with 1 % of
    noise."""
    every = ", ".join(pairs("y") + pairs("z"))
    asked = f"speeds: [0 rpm]\nanalyses:\n  frf: {{frequencies: {BAND}, pairs: [{every}]}}\n"
    path = folder / "blank.yaml"
    path.write_text(MACHINE + blank + asked, encoding="utf-8")
    loaded = rotordyn.load(path)
    known = solve(loaded).results["frf"]
    write_uff(folder / exact, known, case="blank", places=loaded.spindle.places)
    noise = unit_noise(20, known.receptance[0].shape)
    for file, share in ((f"exact_{noisy}", 0.0), (noisy, 0.01)):
        heads = ["frequency [Hz]"]
        columns = [known.frequency]
        given = known.receptance[0] * (1.0 + share * noise)
        for name, values in zip(known.pair, given, strict=True):
            heads += [f"{name} real [m/N]", f"{name} imaginary [m/N]"]
            columns += [values.real, values.imag]
        rows = [", ".join(heads)]
        rows += [", ".join(f"{value:.12g}" for value in row) for row in np.array(columns).T]
        (folder / file).write_text("\n".join(rows) + "\n", encoding="utf-8")


def unit_noise(seed, shape):
    """Complex normal numbers (…, f) of mean square 1."""
    rng = np.random.default_rng(seed)
    real, imaginary = rng.normal(size=(*shape[:-1], 2, shape[-1])).swapaxes(0, -2)
    return (real + 1j * imaginary) / np.sqrt(2.0)


def blank_file(blank):
    return f"material: {MACHINE.split('&steel ')[1].splitlines()[0]}\n" + "\n".join(
        line[2:] for line in blank.splitlines()
    )


def measured(file="tap.uff", ways="yz", more="", blank="blank: ./blank_tool.yaml, "):
    listed = []
    for k, text in enumerate(pairs("y") + pairs("z")):
        if ("y" if k < 3 else "z") in ways:
            record = f", record: {k + 1}" if file.endswith("uff") else ""
            listed.append(f"{text[:-1]}, file: {file}{record}}}")
    return f"{{{blank}{more}responses: [{', '.join(listed)}]}}"


def case(folder, asked, tool=TOOL, speeds="[0 rpm]", machine=MACHINE):
    path = folder / "case.yaml"
    text = f"{machine}{tool}speeds: {speeds}\nanalyses:\n{asked}"
    path.write_text(text, encoding="utf-8")
    return rotordyn.load(path)


def frf(given, way="y"):
    pair = f"{{response: tip.{way}, excitation: tip.{way}}}"
    return f"  frf: {{frequencies: {BAND}, pairs: [{pair}], measured_spindle: {given}}}\n"


def test_the_speed_of_a_measured_spindle_is_a_slice(tested):
    asked = frf(measured()).replace("pairs:", "slices: [90 rpm], pairs:")
    spec = case(tested, asked, speeds="[0 rpm, 90 rpm]").analyses["frf"]
    assert spec.measured_speeds == (0.0,)
    assert set(registry.analysis("frf").speeds(spec)) == {0.0, spec.slices[0]}


@pytest.mark.parametrize("way", ["y", "z"])
def test_tool_on_the_measured_spindle_is_the_whole_machine(tested, way):
    """By a UFF file without noise, in both planes; computed peaks lie between samples of 10 Hz."""
    given = measured(more="modes: 6, ")
    result = rotordyn.run(case(tested, frf(given, way)))["frf"]
    assert result.frac.values[0] > 0.9999
    known = np.isfinite(result.measured_peak.values[0])
    assert known.sum() >= 2
    ratio = (result.measured_peak.values / result.computed_peak.values)[0, known]
    np.testing.assert_allclose(ratio, 1.0, atol=5e-3)


def test_the_second_point_may_lie_at_the_nose(tested):
    """In the face between blank and spindle, where nothing of the blank is behind it."""
    blank = BLANK.replace("inner: -35 mm", "inner: 0 mm")
    respond(tested, blank, "face.uff", "face.csv")
    (tested / "face_tool.yaml").write_text(blank_file(blank), encoding="utf-8")
    given = measured("face.uff", more="modes: 6, ", blank="blank: ./face_tool.yaml, ")
    result = rotordyn.run(case(tested, frf(given)))["frf"]
    assert result.frac.values[0] > 0.9999
    known = np.isfinite(result.measured_peak.values[0])
    assert known.sum() >= 2
    ratio = (result.measured_peak.values / result.computed_peak.values)[0, known]
    np.testing.assert_allclose(ratio, 1.0, atol=5e-3)


def test_error_by_noise(tested):
    """The estimated error beside that of the noise itself, which is known here; the number of modes
    is found by the evidence."""
    loaded = case(tested, frf(measured("noisy.csv")))
    given = loaded.analyses["frf"].measured_spindle
    noisy = OnMeasured(given, loaded.spindle)
    exact = case(tested, frf(measured(more="modes: 6, "))).analyses["frf"].measured_spindle
    still = OnMeasured(exact, loaded.spindle)
    omega = noisy.omega
    true = np.abs(noisy.tip("y", omega) - still.tip("y", omega))
    assert 0.3 < np.linalg.norm(noisy.error("y", omega)) / np.linalg.norm(true) < 3.0
    assert noisy.fits["y"].misfit == pytest.approx(0.01, rel=0.25)
    result = rotordyn.run(loaded)
    assert "% from noise and" in " ".join(result.summary.split())


OMEGA = 2.0 * np.pi * np.arange(60.0, 4001.0, 10.0)


def on(folder, given):
    """The tool on a measured spindle."""
    loaded = case(folder, frf(given))
    return OnMeasured(loaded.analyses["frf"].measured_spindle, loaded.spindle)


def test_the_floor_of_an_accelerometer_does_not_hide_the_spindle(tested):
    """0.1 % of the peak inertance, which is more than the receptance below 100 Hz: the tip is near
    to that of exact responses, by as much as is said."""

    def with_floor(values):
        square = OMEGA[:, None] ** 2
        floor = 1e-3 * np.abs(values * square).max(axis=0) / square
        noise = [unit_noise(seed, values.T.shape).T for seed in (5, 6)]
        return values + floor * noise[0] + 3e-3 * np.abs(values) * noise[1]

    given = turned(tested, "floor.csv", of=with_floor, source="exact_noisy.csv")
    machine, exact = on(tested, given), on(tested, measured(more="modes: 6, "))
    tip, known = machine.tip("y", OMEGA), exact.tip("y", OMEGA)
    off = np.linalg.norm(tip - known) / np.linalg.norm(known)
    said = np.linalg.norm(machine.error("y", OMEGA)) / np.linalg.norm(tip)
    assert off < 0.05
    assert 0.3 < said / off < 3.0
    assert not machine.doubt("y")


def test_errors_of_calibration_are_those_of_changed_gains_and_phases(tested):
    """Of one response after the other, by 0.01 % and by 0.1 mrad."""
    same = on(tested, measured("exact_noisy.csv", more="modes: 6, "))
    tip = same.tip("y", OMEGA)
    for error in (1e-4, 1e-4j):
        square = np.zeros(len(OMEGA))
        for k in range(3):
            values = same.fits["y"](OMEGA)
            values[:, k] *= 1.0 + error
            square += np.abs(same._tip(values, *same._parts(OMEGA)) - tip) ** 2
        change = np.sqrt(square) / abs(error)
        np.testing.assert_allclose(same.calibration("y", OMEGA) / change, 1.0, atol=0.1)


@pytest.mark.parametrize("delay", [0.0, 2e-5])
def test_a_tip_of_no_passive_structure_is_warned_of(tested, delay, monkeypatch):
    """By channels whose delay of 20 µs differs from that of the force; their noise is small."""
    monkeypatch.setattr(converged, "_change", lambda *_: 0.0)  # no finer models: they take longest
    monkeypatch.setattr(measured_tip, "FURTHER", 2)  # in vain
    given = turned(
        tested,
        "late.csv",
        of=lambda h: h * np.exp(-1j * delay * OMEGA)[:, None],
        source="exact_noisy.csv",
    )
    given = given.replace("{", "{modes: 6, ", 1)
    results = rotordyn.run(case(tested, frf(given)))
    sentence = "the tip is not that of a passive structure"
    assert (sentence in " ".join(results.summary.split())) == (delay > 0.0)
    if delay:
        asked = (
            "  stability_lobes: {point: tip, teeth: 2, diameter: 16 mm, tangential: 600 MPa, "
            "radial: 200 MPa, speeds: [9000 rpm], max_frequency: 5000 Hz, method: zero-order, "
            f"measured_spindle: {given}}}\n"
        )
        with pytest.raises(InvalidInput, match=f"not a sum of damped modes .*; in y {sentence}"):
            rotordyn.run(case(tested, asked, speeds="[0 rpm, 9000 rpm]"))


@pytest.mark.parametrize("way", ["y", "z"])
def test_errors_of_the_peaks_of_the_tip_are_those_of_noise(tested, way):
    """A mode fitted to the smooth tip left errors far below what noise does to its peaks."""
    noisy, exact = (
        rotordyn.run(case(tested, frf(given, way)))["frf"]
        for given in (measured("noisy.csv"), measured(more="modes: 6, "))
    )
    said = noisy.measured_peak_error.values[0]
    off = noisy.measured_peak_amplitude.values[0] / exact.measured_peak_amplitude.values[0] - 1.0
    known = np.isfinite(off)
    assert known.sum() >= 2
    assert 0.3 < np.linalg.norm(said[known]) / np.linalg.norm(off[known]) < 3.0


def test_peaks_of_the_tip_are_found_between_the_frequencies_of_the_measurement(tested):
    """With exact responses those of the machine itself."""
    result = rotordyn.run(case(tested, frf(measured(more="modes: 6, "))))["frf"]
    known = np.isfinite(result.measured_peak.values)
    assert known.any()
    for measured_one, computed in (
        (result.measured_peak, result.computed_peak),
        (result.measured_peak_amplitude, result.computed_peak_amplitude),
    ):
        ratio = measured_one.values[known] / computed.values[known]
        np.testing.assert_allclose(ratio, 1.0, atol=5e-3)


def test_limits_on_the_measured_spindle_are_those_of_the_machine_at_rest(tested, monkeypatch):
    monkeypatch.setattr(converged, "_change", lambda *_: 0.0)  # no finer models: they take longest
    asked = (
        "  stability_lobes: {point: tip, teeth: 2, diameter: 16 mm, tangential: 600 MPa, "
        "radial: 200 MPa, milling: up, immersion: 0.5, max_frequency: 5000 Hz, feed: 20 deg, "
        "speeds: {from: 8000 rpm, to: 20000 rpm, count: COUNT}, method: METHOD, "
        f"measured_spindle: {measured(more='modes: 6, ')}}}\n"
    )
    for method, count in (("zero-order", "7"), ("multi-frequency", "2")):
        own = asked.replace("METHOD", method).replace("COUNT", count)
        loaded = case(tested, own, speeds="[0 rpm, 20000 rpm]")
        results = rotordyn.run(loaded)
        result = results["stability_lobes"]
        ratio = result.measured.values / result.at_rest.values
        np.testing.assert_allclose(ratio, 1.0, atol=0.03)
        assert "the tool on the measured spindle is stable up to" in results.summary


def test_chatter_above_the_measured_frequencies_limits_the_cut_as_the_model_says(
    tested, monkeypatch
):
    """The mode of the tool at 3829 Hz is above a measurement that ends at 2200 Hz."""
    monkeypatch.setattr(converged, "_change", lambda *_: 0.0)  # no finer models: they take longest
    head, *rows = (tested / "exact_noisy.csv").read_text(encoding="utf-8").splitlines()
    below = [row for row in rows if float(row.split(",")[0]) <= 2200.0]
    (tested / "below.csv").write_text("\n".join([head, *below]) + "\n", encoding="utf-8")
    sentence = "the spindle is measured to 2200 Hz, above which the machine as computed at rest"
    for file, last in (("exact_noisy.csv", 4000.0), ("below.csv", 2200.0)):
        asked = (
            "  stability_lobes: {point: tip, teeth: 2, diameter: 16 mm, tangential: 600 MPa, "
            "radial: 200 MPa, milling: up, immersion: 0.5, max_frequency: 5000 Hz, feed: 20 deg, "
            "speeds: {from: 8000 rpm, to: 20000 rpm, count: 7}, method: zero-order, "
            f"measured_spindle: {measured(file, more='modes: 6, ')}}}\n"
        )
        results = rotordyn.run(case(tested, asked, speeds="[0 rpm, 20000 rpm]"))
        result = results["stability_lobes"]
        assert (result.measured.values < 1.01 * result.at_rest.values).all()
        np.testing.assert_allclose(result.measured_chatter.values, 3850.0, atol=70.0)
        assert float(result.measured_to) == pytest.approx(last)
        assert (sentence in " ".join(results.summary.split())) == (last < 3829.0)


def base(seed):
    """Receptance of four modes with loss factors, below 6000 Hz: no sum of damped modes."""
    chance = np.random.default_rng(seed)
    at = np.geomspace(300.0, 4000.0, 4) * chance.uniform(0.8, 1.2, 4)
    stiffness, loss = 10.0 ** chance.uniform(7.0, 8.0, 4), chance.uniform(0.01, 0.02, 4)

    def receptance(omega):
        square = (omega[:, None] / (2.0 * np.pi * at)) ** 2
        return (1.0 / (stiffness * (1.0 - square + 1j * loss))).sum(axis=1)

    return receptance


def tip_of(receptance):
    machine = SimpleNamespace(
        omega=2.0 * np.pi * np.linspace(50.0, 6000.0, 400),
        fits={"y": None},
        tip=lambda _, omega: receptance(omega),
    )
    return MeasuredTip(machine, 0.0)


@pytest.mark.parametrize("share", [3e-3, 1e-3])
def test_peaks_between_the_samples_of_the_band_are_those_of_the_tip(share):
    """A tool of spring k and mass m, without damping, on a base of receptance B that hardly moves:
    1/(1/(1/k + B) − m ω²); samples are 100 and more half widths of its peak apart."""
    spring, own, below = 1e7, 2.0 * np.pi * 4500.0, base(0)

    def receptance(omega):
        return 1.0 / (1.0 / (1.0 / spring + share * below(omega)) - spring * (omega / own) ** 2)

    tip = tip_of(receptance)
    light = tip.poles[0][np.argmin(-tip.poles[0].real / tip.poles[0].imag)]
    assert -light.real < 0.01 * np.diff(tip.omega)[0]
    omega = light.imag + 0.1 * np.arange(-100, 101) * abs(light.real)
    exact = receptance(omega)
    for plane in tip._fit(omega).T:  # the other one is as that which was measured
        assert np.abs(plane - exact).max() < 1e-2 * np.abs(exact).max()


@pytest.mark.parametrize("seed", range(6))
def test_the_last_digit_of_a_measurement_does_not_move_the_modes_of_the_tip(seed):
    """With a loss factor it is no sum of modes: nothing but the fit chooses them."""
    receptance = base(seed)
    found = []
    for share in (1.0, 1.0 + 3e-16):
        tip = tip_of(lambda omega, by=share: by * receptance(omega))
        found.append(tip._fit(tip.omega)[:, 0])
    assert np.abs(found[1] - found[0]).max() < 1e-9 * np.abs(found[0]).max()


def test_modes_far_above_the_band_add_their_static_residual():
    """With modes of a workpiece and without."""
    below, static = base(1), 3e-7
    alone = tip_of(lambda omega: below(omega) + static)
    wall = of_workpiece([WorkpieceMode(800.0, 0.02, 1e7)])
    exact = (below(alone.omega) + static)[:, None, None] * np.eye(2)
    for tip in (alone, replace(alone, workpiece=wall)):
        found = tip.modes.at(0).receptance(alone.omega) - tip.workpiece.receptance(alone.omega)
        assert np.abs(found - exact).max() < 1.1e-2 * np.abs(exact).max()


def test_a_workpiece_that_gives_way_is_beside_the_measured_tip():
    """Its modes are known exactly, and may lie above the band of the measurement."""
    modes = WorkpieceMode(800.0, 0.02, 1e7, 0.4), WorkpieceMode(7000.0, 0.02, 1e8)
    alone = tip_of(base(1))
    both, own = replace(alone, workpiece=of_workpiece(modes)), of_workpiece(modes)
    omega = np.linspace(100.0, 5e4, 200)
    there, here = (tip.modes.at(0).receptance(omega) for tip in (alone, both))
    np.testing.assert_allclose(here - there, own.receptance(omega), atol=1e-9 * np.abs(here).max())
    assert both.tops[0] > 1.2 * own.pole.imag.max() > both.omega[-1]
    assert alone.tops[0] == alone.omega[-1]
    assert np.isin(own.pole, both.poles).all()
    assert both.about_poles(0)[-1] > own.pole.imag[-1]


@pytest.mark.long
def test_points_on_the_nose_need_no_blank(tested):
    """A tool of 0.1 mm on the machine that has the blank for its nose."""
    shaft = MACHINE.replace("  shaft:", "  points: {tip: 0 mm, inner: 30 mm}\n  shaft:")
    nose = "  sections: [{length: 0.1 mm, outer_diameter: 50 mm}]\n  points: {top: -0.1 mm}\n"
    asked = frf(measured(blank=""), "y").replace("tip.y", "top.y", 2)
    machine = case(tested, asked, tool=nose, machine=shaft)
    one = OnMeasured(machine.analyses["frf"].measured_spindle, machine.spindle)
    given = one.measured.responses[0]
    known = np.array(given.real) + 1j * np.array(given.imaginary)
    off = np.linalg.norm(one.tip("y", one.omega) - known) / np.linalg.norm(known)
    assert off < 0.1


def test_it_is_kept_with_its_results(tested):
    spec = case(tested, frf(measured())).analyses["frf"]
    assert restored(json.loads(json.dumps(archived(spec)))) == spec


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (
            measured("noisy.csv", "y").replace("excitation: inner.y", "excitation: inner.z", 1),
            "no column .* tip.y / inner.z|one direction across the axis",
        ),
        (
            measured("tap.uff", "y").replace("excitation: inner.y", "excitation: inner.z", 1),
            "one direction across the axis: given 'tip.y / inner.z'; allowed: both in y, or both",
        ),
        (measured("noisy.csv", "y", "modes: 99, "), "given '99'; allowed: 1 to 60"),
        (measured(ways="y").replace("inner.y", "middle.y"), "unknown point: given 'middle'"),
        (measured(blank="blank: blank_7, "), "unknown model: given 'blank_7'"),
        (measured("none.csv"), "no such file"),
        (
            measured("noisy.csv", "y").replace("tip.y, file", "tip.y, speed: 600 rpm, file", 1),
            "responses.1.speed: .* measured at rest: given '600 rpm'; leave speed out",
        ),
        (
            measured("noisy.csv", "y").split(", {response: inner")[0] + "]}",
            "front / front, front / behind and behind / behind",
        ),
    ],
)
def test_faults(tested, given, sentence):
    with pytest.raises(RotordynError, match=sentence):
        case(tested, frf(given))


@pytest.mark.parametrize("band", ["[500 Hz]", "[20 Hz, 60 Hz]"])
def test_a_band_that_holds_no_two_frequencies_of_the_measurement(tested, band):
    """By the check, at its line, not by a run; two of the case within the measured band do."""
    asked = frf(measured("noisy.csv", "y")).replace(BAND, band)
    with pytest.raises(RotordynError, match=r"yaml:\d+:\d+: analyses\.frf\.frequencies: fewer"):
        case(tested, asked)
    case(tested, asked.replace(band, "[61 Hz, 62 Hz]"))


def test_of_a_faulty_file_its_fault_alone_is_reported(tested):
    (tested / "lost.csv").write_text("nothing\n", encoding="utf-8")
    with pytest.raises(RotordynError, match=r"lost\.csv") as told:
        case(tested, frf(measured("lost.csv", "y")))
    assert "fewer than two" not in str(told.value)


@pytest.mark.parametrize(
    ("kept", "sentence"),
    [(5, "too few frequencies: given 4; allowed: from 6"), (3, "column 2: not a finite number")],
)
def test_a_faulty_table_is_reported_without_what_follows_from_it(tested, kept, sentence):
    rows = (tested / "noisy.csv").read_text(encoding="utf-8").splitlines()[:kept]
    if kept == 3:
        rows[2] = ",".join([rows[2].split(",")[0], "nan", *rows[2].split(",")[2:]])
    (tested / "few.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    with pytest.raises(RotordynError, match=sentence) as found:
        case(tested, frf(measured("few.csv", "y")))
    assert "other frequencies" not in str(found.value)
    assert "nothing" not in str(found.value)


@pytest.mark.parametrize(("off", "taken"), [(1e-7, True), (1e-4, False)])
def test_frequencies_may_differ_by_their_last_digits(tested, off, taken):
    """The second response in kHz and rounded; not by more than a thousandth of their distance."""
    head, *rows = (tested / "noisy.csv").read_text(encoding="utf-8").splitlines()
    cells = [row.split(",") for row in rows]
    other = [",".join([f"{float(row[0]) * (1.0 + off) / 1e3:.9g}", *row[1:]]) for row in cells]
    text = "\n".join([head.replace("[Hz]", "[kHz]"), *other])
    (tested / "other.csv").write_text(text + "\n", encoding="utf-8")
    first, *others = measured("noisy.csv", "y").split("noisy.csv")
    given = f"{first}noisy.csv{others[0]}other.csv{'noisy.csv'.join(others[1:])}"
    if taken:
        case(tested, frf(given))
    else:
        with pytest.raises(RotordynError, match=r"responses\.2: measured at other frequencies"):
            case(tested, frf(given))


@pytest.mark.parametrize(
    ("tool", "sentence"),
    [
        ("  sections: [{length: 1 mm, outer_diameter: 9 mm}]\n  points: {tip: 0 mm}\n", "no pair"),
        (
            TOOL + "  masses: [{name: m, x: -9 mm, mass: 1 kg}]\n",
            "does not model point masses on a tool",
        ),
        (
            TOOL + "  joints: [{name: j, x: -9 mm, radial: 1e8 N/m}]\n",
            "does not model a joint within a tool",
        ),
    ],
)
def test_tools_that_are_not_coupled(tested, tool, sentence):
    with pytest.raises(RotordynError, match=sentence):
        case(tested, frf(measured()), tool=tool)


def test_a_band_that_ends_within_a_peak_is_refused(tested):
    """Rows up to the first peak of the tool alone."""
    rows = (tested / "noisy.csv").read_text(encoding="utf-8").splitlines()
    loaded = case(tested, frf(measured("noisy.csv", more="modes: 4, ")))
    machine = OnMeasured(loaded.analyses["frf"].measured_spindle, loaded.spindle)
    top = int(np.abs(machine.tip("y", machine.omega)).argmax())
    (tested / "short.csv").write_text("\n".join(rows[: top + 2]) + "\n", encoding="utf-8")
    given = measured("short.csv", more="modes: 4, ")
    asked = (
        "  stability_lobes: {point: tip, teeth: 2, diameter: 16 mm, tangential: 600 MPa, radial: "
        f"200 MPa, speeds: [9000 rpm], measured_spindle: {given}}}\n"
    )
    with pytest.raises(InvalidInput, match=r"end at .* Hz, .* measure beyond the peak"):
        rotordyn.run(case(tested, asked, speeds="[0 rpm, 9000 rpm]"))


def turned(folder, name, order=range(6), of=lambda value: value, source="noisy.csv"):
    """The noisy table with its responses in another order and with other values."""
    head, *rows = (folder / source).read_text(encoding="utf-8").splitlines()
    table = np.array([[float(each) for each in row.split(",")] for row in rows])
    values = of(table[:, 1::2] + 1j * table[:, 2::2])[:, list(order)]
    table[:, 1::2], table[:, 2::2] = values.real, values.imag
    lines = [", ".join(f"{each:.12g}" for each in row) for row in table]
    (folder / name).write_text("\n".join([head, *lines]) + "\n", encoding="utf-8")
    return measured(name)


@pytest.mark.parametrize(
    ("order", "of", "sentence"),
    [
        (
            range(6),
            np.conj,
            r"tip\.y / tip\.y is not that of a driving point: .* sign convention e\^\{−iωt\}",
        ),
        (range(6), lambda h: h.imag + 1j * h.real, "real and imaginary columns look exchanged"),
        (range(6), lambda h: 1j * h, "phase of a mobility"),
        ((3, 1, 2, 0, 4, 5), np.asarray, "files of points or directions in y are exchanged"),
        ((1, 0, 2, 3, 4, 5), np.asarray, "files of points or directions in y are exchanged"),
    ],
)
def test_what_was_exchanged_in_a_measurement_is_named(tested, order, of, sentence):
    given = turned(tested, "turned.csv", order, of)
    with pytest.raises(RotordynError, match=sentence):
        case(tested, frf(given))


def test_responses_that_are_not_reciprocal_are_refused(tested):
    """The file of z as the response in y with both points exchanged; its own file is taken."""
    back = "{response: inner.y, excitation: tip.y, file: tap.uff, record: "
    for record, refused in ((5, True), (2, False)):
        given = measured().replace("responses: [", f"responses: [{back}{record}}}, ")
        if refused:
            with pytest.raises(RotordynError, match=r"differ by .* equal at rest by reciprocity"):
                case(tested, frf(given))
        else:
            case(tested, frf(given))


def test_too_few_modes_are_not_blamed_on_the_blank(tested):
    given = measured("noisy.csv", "y", more="modes: 1, ")
    sentence = r"^measured_spindle: modes: given 1, with a misfit .*raise modes, or leave it out"
    with pytest.raises(InvalidInput, match=sentence):
        rotordyn.run(case(tested, frf(given)))


def test_too_few_modes_are_refused_without_much_noise():
    """One mode where the shipped blank needs more: its tip would be wrong, with little noise."""
    variant = rotordyn.load("mfw2310_measured_spindle").variants["hsk63_end_mill_16"]
    spec = variant.analyses["frf"]
    few = replace(spec, measured_spindle=replace(spec.measured_spindle, modes=2))
    with pytest.raises(InvalidInput, match=r"^measured_spindle: modes: given 2, with a misfit"):
        rotordyn.run(replace(variant, analyses={"frf": few}))


def test_a_blank_as_stiff_as_the_spindle_is_refused(tested):
    """Of the length of the spindle: its responses hardly change by what holds it."""
    long = BLANK.replace("40 mm", "300 mm").replace("-65 mm", "-325 mm").replace("-35", "-295")
    respond(tested, long, "long.uff", "long.csv")
    (tested / "long_tool.yaml").write_text(blank_file(long), encoding="utf-8")
    given = measured("long.csv", "y", blank="blank: ./long_tool.yaml, ")
    with pytest.raises(
        InvalidInput,
        match=r"^measured_spindle: .* as stiff as the spindle, .* take a shorter blank",
    ):
        rotordyn.run(case(tested, frf(given)))
