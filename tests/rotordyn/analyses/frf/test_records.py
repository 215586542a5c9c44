"""Measured responses: read back from what was written, units, and one sentence for each fault."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import pyuff

import rotordyn
from rotordyn.analyses.frf import summary as frf_summary
from rotordyn.analyses.frf.figures import headline_curves
from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.frf.summary import summary as measured_lines
from rotordyn.analyses.frf.summary import warnings as measured_warnings
from rotordyn.errors import InvalidInput
from rotordyn.job import deliver, solve
from rotordyn.results.described import Shown
from rotordyn.study.machines import lean

pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
PAIR = "left_disc.y / right_disc.y"
HEAD = "spindle: friswell_two_discs\noverride: {supports.left.damping: {yy: 200 N s/m}}\n"
ASKED = """speeds: [0 rpm, 1000 rpm]
analyses:
  frf:
    quantity: %s
    frequencies: {from: 1 Hz, to: 60 Hz, step: 0.5 Hz}
    pairs:
      - {response: left_disc.y, excitation: right_disc.y}
      - {response: left_disc.y, excitation: left_disc.y}
    slices: [0 rpm, 1000 rpm]
"""
MEASURED = "    measured: [{file: %s, response: left_disc.y, excitation: right_disc.y%s}]\n"


def case(folder: Path, quantity: str = "receptance", measured: str = "") -> rotordyn.Case:
    path = folder / "case.yaml"
    path.write_text(HEAD + ASKED % quantity + measured)
    return rotordyn.load(path)


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Results of every quantity, each with its frf.uff."""
    folders = {}
    for quantity in ("receptance", "mobility", "inertance"):
        folder = tmp_path_factory.mktemp(quantity)
        folders[quantity] = folder / "out"
        deliver(case(folder, quantity), folders[quantity])
    return folders


@pytest.mark.parametrize("quantity", ["receptance", "mobility", "inertance"])
@pytest.mark.parametrize("seen", ["receptance", "inertance"])
def test_own_uff_comes_back_whatever_it_is_laid_over(
    tmp_path: Path, written: dict[str, Path], quantity: str, seen: str
) -> None:
    """Record 3 is the first pair at 1000 rpm; the response laid over is the computed one."""
    file = written[seen] / "frf.uff"
    asked = MEASURED % (file, ", record: 3, speed: 1000 rpm, name: tap")
    result = solve(case(tmp_path, quantity, asked)).results["frf"]
    at, values = _slice(result, 1000.0)
    same = np.isclose(result.measured_frequency[0], at, rtol=1e-12)  # peaks differ by quantity
    assert same.sum() > 200
    np.testing.assert_allclose(result.measured_response[0, same], values[same], rtol=1e-9)
    assert result.measured == ("tap",)
    assert result.measured_pair == (PAIR,)
    assert result.frac[0] == pytest.approx(1.0, abs=1e-9)
    known = np.isfinite(result.measured_peak[0])
    assert known.sum() >= 2
    alike = 1e-6 if seen == quantity else 1e-4  # samples about peaks of another quantity
    np.testing.assert_allclose(result.computed_peak, result.measured_peak, rtol=alike)
    amplitudes = result.computed_peak_amplitude, result.measured_peak_amplitude
    np.testing.assert_allclose(*amplitudes, rtol=10.0 * alike)


@pytest.mark.parametrize("quantity", ["receptance", "mobility", "inertance"])
def test_own_table_comes_back(tmp_path: Path, written: dict[str, Path], quantity: str) -> None:
    """Of several columns those that name the pair; printed units are read."""
    result = solve(case(tmp_path, quantity)).results["frf"]
    record = read_record(written[quantity] / "frf_1000rpm.csv", PAIR, None)
    assert record.quantity == quantity
    np.testing.assert_allclose(record.values, _slice(result, 1000.0)[1], rtol=2e-6)


def _slice(result: FrequencyResponse, rpm: float) -> tuple[np.ndarray, np.ndarray]:
    """The first pair at a speed, at the frequencies of the case and about the modes."""
    row = int(np.abs(result.slice_speed - rpm * math.pi / 30.0).argmin())
    known = np.isfinite(result.slice_frequency[row])
    return result.slice_frequency[row, known], result.slice_value[row, 0, known]


@pytest.mark.parametrize(
    ("unit", "quantity", "scale"),
    [
        ("m/N", "receptance", 1.0),
        ("µm/N", "receptance", 1e-6),
        ("mm/kN", "receptance", 1e-6),
        ("(mm/s)/N", "mobility", 1e-3),
        ("m/s/N", "mobility", 1.0),
        ("m/s^2/N", "inertance", 1.0),
        ("(m/s²)/N", "inertance", 1.0),
        ("1/kg", "inertance", 1.0),
        ("g/N", "inertance", 9.80665),
        ("gn/kN", "inertance", 9.80665e-3),
        ("MM/S/N", "mobility", 1e-3),
    ],
)
def test_amplitude_and_phase_with_units(
    tmp_path: Path, unit: str, quantity: str, scale: float
) -> None:
    path = tmp_path / "tap.csv"
    path.write_text(f"frequency [kHz],amplitude [{unit}],phase [deg]\n0.01,2,90\n0.02,3,-180\n")
    record = read_record(path, PAIR, None)
    assert record.quantity == quantity
    assert record.frequency == pytest.approx((10.0, 20.0))
    np.testing.assert_allclose(record.values, [2j * scale, -3.0 * scale], atol=1e-15 * scale)


@pytest.mark.parametrize("end", ["uff", "csv"])
def test_a_first_line_at_0_hz_is_omitted(tmp_path: Path, end: str) -> None:
    """Records of analysers begin with the mean, of which no mobility or inertance is known."""
    path = tmp_path / f"tap.{end}"
    if end == "uff":
        uff(path, x=np.array([0.0, 10.0, 20.0]), data=np.array([np.nan, 2.0, 3.0j]))
    else:
        head = "frequency [Hz],real [1/kg],imag [1/kg],coherence"
        path.write_text(f"{head}\n0,7,0,0\n10,2,0,0.9\n20,0,3,1\n")
    record = read_record(path, PAIR, None)
    assert record.frequency == (10.0, 20.0)
    assert record.values == (2.0, 3.0j)
    assert record.coherence == (() if end == "uff" else (0.9, 1.0))


def test_remarks_in_a_table_are_passed_over(tmp_path: Path) -> None:
    path = tmp_path / "tap.csv"
    path.write_text(
        "# a hammer, and a day\n\nfrequency [Hz],real [m/N],imag [m/N]\n#\n1,2,3\n2,2,3\n"
    )
    assert read_record(path, PAIR, None).values == (2.0 + 3.0j, 2.0 + 3.0j)


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("told", [False, True])
def test_columns_between_commas_semicolons_or_tabs(
    tmp_path: Path, separator: str, told: bool
) -> None:
    """Spreadsheets may tell theirs in a line before the header."""
    path = tmp_path / "tap.csv"
    lines = ["frequency [Hz],real [m/N],imag [m/N]", "10,2.5,3", "20,0.5,3"]
    text = "\n".join(lines).replace(",", separator)
    path.write_text(f"sep={separator}\n{text}\n" if told else f"{text}\n")
    assert read_record(path, PAIR, None).values == (2.5 + 3.0j, 0.5 + 3.0j)


def test_rotations_have_units_of_their_own(tmp_path: Path) -> None:
    path = tmp_path / "tap.csv"
    path.write_text("frequency [Hz],real [rad/(N m)],imag [mrad/(N·m)]\n1,2,3\n2,2,3\n")
    record = read_record(path, "left_disc.thz / left_disc.thz", None)
    assert record.quantity == "receptance"
    assert record.values[0] == pytest.approx(2.0 + 0.003j)
    with pytest.raises(InvalidInput, match=r"not a unit of left_disc.y / left_disc.y: given"):
        read_record(path, "left_disc.y / left_disc.y", None)


def uff(path: Path, **changes: object) -> Path:
    fields = {
        "type": 58, "binary": 0, "func_type": 4, "rsp_node": 1, "rsp_dir": 2, "ref_node": 1,
        "ref_dir": 2, "data": np.array([1.0 + 2.0j, 3.0, 4.0]), "x": np.array([10.0, 20.0, 30.0]),
        "id1": "tap", "ordinate_spec_data_type": 12, "orddenom_spec_data_type": 13,
        "ordinate_axis_units_lab": "m/s^2", "orddenom_axis_units_lab": "N",
        "abscissa_spec_data_type": 18, "abscissa_axis_units_lab": "Hz",
    }  # fmt: skip
    pyuff.UFF(str(path)).write_sets([{**fields, **changes}], "add")
    return path


@pytest.mark.parametrize(
    ("changes", "quantity", "scale"),
    [
        ({}, "inertance", 1.0),
        ({"ordinate_axis_units_lab": "g"}, "inertance", 9.80665),
        ({"ordinate_axis_units_lab": "mm/s^2"}, "inertance", 1e-3),
        ({"ordinate_axis_units_lab": "M/S**2"}, "inertance", 1.0),
        ({"ordinate_axis_units_lab": "MM/S2", "abscissa_axis_units_lab": "HZ"}, "inertance", 1e-3),
        ({"ordinate_axis_units_lab": "g", "ordinate_spec_data_type": 0}, "inertance", 9.80665),
        ({"ordinate_axis_units_lab": "NONE"}, "inertance", 1.0),
        ({"ordinate_axis_units_lab": "mm/s", "ordinate_spec_data_type": 11}, "mobility", 1e-3),
        ({"ordinate_axis_units_lab": "um", "ordinate_spec_data_type": 0}, "receptance", 1e-6),
        ({"ordinate_axis_units_lab": "mm/s^2", "orddenom_axis_units_lab": ""}, "inertance", 1e-3),
        ({"ordinate_axis_units_lab": "g", "orddenom_axis_units_lab": ""}, "inertance", 9.80665),
        ({"ordinate_axis_units_lab": "g/N", "orddenom_axis_units_lab": ""}, "inertance", 9.80665),
        ({"ordinate_axis_units_lab": "", "orddenom_axis_units_lab": "kN"}, "inertance", 1e-3),
        (
            {
                "ordinate_axis_units_lab": "mm/N",
                "orddenom_axis_units_lab": "NONE",
                "ordinate_spec_data_type": 8,
            },
            "receptance",
            1e-3,
        ),
    ],
)
def test_foreign_records(
    tmp_path: Path, changes: dict[str, object], quantity: str, scale: float
) -> None:
    record = read_record(uff(tmp_path / "tap.uff", **changes), PAIR, None)
    assert record.quantity == quantity
    assert record.frequency == (10.0, 20.0, 30.0)
    np.testing.assert_allclose(record.values, np.array([1.0 + 2.0j, 3.0, 4.0]) * scale)


@pytest.mark.parametrize(
    ("labels", "pair", "scale"),
    [
        (("", ""), PAIR, 1e-3 / 1e-3),
        (("m/s^2", "N"), PAIR, 1.0),
        (("", ""), "left_disc.thz / left_disc.y", 1.0 / 1e-3),
        (("", ""), "left_disc.y / left_disc.thz", 1e-3 / (1e-3 * 1e-3)),
        (("", ""), "left_disc.thz / left_disc.thz", 1.0 / (1e-3 * 1e-3)),
    ],
)
def test_units_of_a_file(tmp_path: Path, labels: tuple[str, str], pair: str, scale: float) -> None:
    """Millimetres and millinewtons; labels of a record are before them."""
    names = dict(zip(("ordinate_axis_units_lab", "orddenom_axis_units_lab"), labels, strict=True))
    ways = [0 if "th" not in end else 6 for end in pair.split(" / ")]
    path = uff(tmp_path / "tap.uff", rsp_dir=ways[0], ref_dir=ways[1], **names)
    factors = {"length": 1e3, "force": 1e3, "temp": 1.0, "temp_offset": 273.15}
    known = {"type": 164, "units_code": 5, "units_description": "mm", "temp_mode": 1, **factors}
    pyuff.UFF(str(path)).write_sets([known], "add")
    values = read_record(path, pair, None).values
    np.testing.assert_allclose(values, scale * np.array([1.0 + 2.0j, 3.0, 4.0]))


@pytest.mark.parametrize(
    ("response", "excitation", "sign"),
    [(2, 2, 1.0), (-2, 2, -1.0), (2, -2, -1.0), (-2, -2, 1.0), (-3, 3, -1.0), (0, -2, 1.0)],
)
def test_opposite_directions_of_a_record_turn_its_sign(
    tmp_path: Path, response: int, excitation: int, sign: float
) -> None:
    path = uff(tmp_path / "tap.uff", rsp_dir=response, ref_dir=excitation)
    values = read_record(path, PAIR, None).values
    np.testing.assert_allclose(values, sign * np.array([1.0 + 2.0j, 3.0, 4.0]))


@pytest.mark.parametrize(
    ("response", "excitation", "words"),
    [
        (3, 2, f"response in direction 3 and its excitation in 2, but {PAIR} has both in one"),
        (2, -1, f"response in direction 2 and its excitation in -1, but {PAIR} has both in one"),
        (5, 2, f"response in direction 5, a rotation, but y of {PAIR} is not one"),
    ],
)
def test_a_record_of_other_directions_is_refused(
    tmp_path: Path, response: int, excitation: int, words: str
) -> None:
    path = uff(tmp_path / "tap.uff", rsp_dir=response, ref_dir=excitation)
    with pytest.raises(InvalidInput, match=words):
        read_record(path, PAIR, None)


def test_a_record_of_one_direction_is_no_response_across(tmp_path: Path) -> None:
    across = "nose.y / nose.z"
    path = uff(tmp_path / "tap.uff", rsp_dir=-3, ref_dir=3)
    with pytest.raises(
        InvalidInput, match=f"excitation in direction 3, but {across} has them in two"
    ):
        read_record(path, across, None)
    path = uff(tmp_path / "other.uff", rsp_dir=2, ref_dir=-1)
    assert read_record(path, across, None).values[1] == pytest.approx(-3.0)


TURNING = {"z_axis_value": 600.0, "z_axis_spec_data_type": 19, "z_axis_axis_units_lab": "rpm"}


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_the_speed_of_a_record_is_that_of_the_response(tmp_path: Path, way: float) -> None:
    """Whichever way it counts: axes of the record are not those of the case."""
    uff(tmp_path / "tap.uff", **TURNING | {"z_axis_value": 600.0 * way})
    for more in ("", ", speed: 600 rpm", ", speed: 62.83 rad/s"):
        asked = MEASURED % ("tap.uff", more)
        (known,) = case(tmp_path, measured=asked).analyses["frf"].measured
        assert known.speed == pytest.approx(20.0 * np.pi)
    with pytest.raises(InvalidInput, match="was measured at 600 rpm by its record: given 0 rpm"):
        case(tmp_path, measured=MEASURED % ("tap.uff", ", speed: 0 rpm"))
    uff(tmp_path / "tip.uff", **TURNING | {"z_axis_axis_units_lab": "turns"})
    (known,) = case(tmp_path, measured=MEASURED % ("tip.uff", "")).analyses["frf"].measured
    assert known.speed == 0.0


@pytest.mark.parametrize("unit", ["Hz", "[HZ]"])
def test_a_speed_in_turns_per_second_counts(tmp_path: Path, unit: str) -> None:
    turning = TURNING | {"z_axis_value": 10.0, "z_axis_axis_units_lab": unit}
    path = uff(tmp_path / "tap.uff", **turning)
    assert read_record(path, PAIR, None).speed == pytest.approx(20.0 * np.pi)


@pytest.mark.parametrize("unit", ["RPM", "[rpm]", "NONE"])
def test_a_speed_by_its_kind_is_in_rpm_however_that_is_written(tmp_path: Path, unit: str) -> None:
    """Kind 19 is rpm by the format itself."""
    path = uff(tmp_path / "tap.uff", **TURNING | {"z_axis_axis_units_lab": unit})
    assert read_record(path, PAIR, None).speed == pytest.approx(20.0 * np.pi)


TABLES = {
    "frequency [Hz],real [m/N]\n1,2\n": "columns missing: given 'frequency .*; allowed: frequency",
    "frequency [Hz],real [m/N],imag [m/N]\n1,2,3\n2,2\n": "line 3 has 2 values where the header",
    "frequency [Hz],real [m/N],imag [m/N]\n1,2,x\n2,2,2\n": "line 2, column 3: not a finite num",
    "# a\n\nfrequency [Hz],real [m/N],imag [m/N]\n1,2,2\n2,nan,2\n": "line 5, column 2: not a",
    "frequency [Hz];real [m/N];imag [m/N]\n1;2;2\n2;0,5;2\n": "line 3, column 2: .*given '0,5';",
    "frequency [Hz],real,imag [m/N]\n1,2,3\n": r"column 'real' has no unit: write it as 'real \[",
    "frequency [rpm],real [m/N],imag [m/N]\n1,2,3\n": "not a unit of frequency: given 'rpm'",
    "frequency [Hz],real [N/m],imag [m/N]\n1,2,3\n": "not a unit of .*: given 'N/m'; allowed: m/N,",
    "frequency [Hz],real [m/N],imag [m/s/N]\n1,2,3\n": "a unit of receptance, imag.* mobility",
    "frequency [Hz],amplitude [m/N],phase [deg]\n1,-2,3\n": "an amplitude below zero: given -2",
    "frequency [Hz],amplitude [m/N],phase [mm]\n1,2,3\n": "not a unit of phase: given 'mm'",
    "frequency [Hz],a real [m/N],b real [m/N],imag [m/N]\n1,2,3,4\n": "2 columns for real: one",
    "frequency [Hz],real [m/N],imag [m/N]\n2,2,2\n1,2,2\n": "csv: frequency 2: not in ascending",
    "frequency [Hz],real [m/N],imag [m/N]\n2,2,2\n": "csv: too few frequencies: given 1; allo",
    "frequency [Hz],amplitude [m/N],phase [deg]\n": "csv: too few frequencies: given 0;",
    "frequency [Hz],real [m/N],imag [m/N]\n-2,2,2\n2,2,2\n": "csv: frequency out of range: given",
    "frequency [Hz],real [m/N],imag [m/N]\n0,2,2\n0,2,2\n1,2,2\n": "csv: frequency out of range",
    "frequency [Hz],real [m/N],imag [m/N]\n1,2,2\n0,2,2\n": "csv: frequency out of range: given 0",
    "frequency [Hz],real [m/N],imag [m/N]\n70,2,2\n90,2,2\n": "fewer than two frequencies in the "
    "band of the case: given 70 to 90 Hz; allowed: 1 to 60 Hz",
    "frequency [Hz],real [m/N],imag [m/N]\n2,0,0\n4,0,0\n": "csv: no response: given zero at every",
    "frequency [Hz],amplitude [mm/N],phase [deg]\n2,2,9\n4,1e300,9\n": r"csv: response out "
    r"of range: its largest value is 1e\+297 m/N at 4 Hz; allowed: 1e-50 to 1e\+50 m/N",
    "frequency [Hz],amplitude [m/N],phase [deg]\n2,1e-200,9\n4,0,9\n": "largest value is 1e-200 "
    "m/N at 2 Hz;",
    "": "the file is empty",
}


@pytest.mark.parametrize("content", TABLES)
def test_faulty_table_is_refused_at_its_key(tmp_path: Path, content: str) -> None:
    (tmp_path / "tap.csv").write_text(content)
    with pytest.raises(InvalidInput, match=TABLES[content]) as caught:
        case(tmp_path, measured=MEASURED % ("tap.csv", ""))
    (fault,) = caught.value.faults
    assert fault.path == "analyses.frf.measured.1.file"
    assert fault.line == 12
    assert fault.message.replace("'", "").startswith("tap.csv: ")


@pytest.mark.parametrize(
    ("changes", "more", "words"),
    [
        ({"func_type": 1}, "", "the record is not a complex frequency response"),
        (
            {"ordinate_spec_data_type": 8},
            "",
            "data type of the record is receptance, .* of inertance",
        ),
        ({"ordinate_axis_units_lab": "V"}, "", "not a unit of .*: given .*V.*N.*; allowed: m/N"),
        ({}, ", record: 2", "no record 2: the file has 1 of type 58"),
        ({}, ", speed: 2000 rpm", "its speed is not within the speeds of the case"),
    ],
)
def test_faulty_record_is_refused(
    tmp_path: Path, changes: dict[str, object], more: str, words: str
) -> None:
    uff(tmp_path / "tap.uff", **changes)
    with pytest.raises(InvalidInput, match=words) as caught:
        case(tmp_path, measured=MEASURED % ("tap.uff", more))
    assert len(caught.value.faults) == 1


def test_other_faults(tmp_path: Path, written: dict[str, Path]) -> None:
    several = written["receptance"] / "frf.uff"
    with pytest.raises(InvalidInput, match="4 records of type 58: give record, 1 to 4"):
        case(tmp_path, measured=MEASURED % (several, ""))
    for name in ("tap.uff", "y" * 300 + "tap.uff"):
        with pytest.raises(InvalidInput, match=r"tap.uff: no such file"):
            case(tmp_path, measured=MEASURED % (name, ""))
    (tmp_path / "tap.uff").write_text("nothing of the kind\n")
    with pytest.raises(
        InvalidInput, match=r"tap.uff: (not a UFF file|the file has no record of type 58)"
    ):
        case(tmp_path, measured=MEASURED % ("tap.uff", ""))
    other = "    measured: [{file: a.csv, response: left_disc.z, excitation: left_disc.y}]\n"
    with pytest.raises(InvalidInput, match=f"not a pair of the case: .*allowed: {PAIR}, left"):
        case(tmp_path, measured=other)


def test_measured_file_is_part_of_the_digest(tmp_path: Path) -> None:
    table = "frequency [Hz],real [m/N],imag [m/N]\n10,%s,2\n20,3,4\n"
    digests = []
    for value in ("1", "2"):
        (tmp_path / "tap.csv").write_text(table % value)
        found = case(tmp_path, measured=MEASURED % ("tap.csv", ""))
        digests.append(found.digest)
        assert tmp_path / "tap.csv" in found.files
    assert digests[0] != digests[1]


def test_summary_and_figure_show_what_was_measured(tmp_path: Path) -> None:
    """A resonance 5 % higher and half as sharp as computed."""
    result = solve(case(tmp_path)).results["frf"]
    f = np.linspace(5.0, 40.0, 300)
    known = np.isfinite(result.slice_frequency[0])
    curve = result.slice_frequency[0, known], np.abs(result.slice_value[0, 0, known])
    there = np.interp(f / 1.05, *curve) / 2.0
    rows = "".join(f"{a:.6g},{h * 1e6:.9g},0\n" for a, h in zip(f, there, strict=True))
    (tmp_path / "tap.csv").write_text("frequency [Hz],amplitude [um/N],phase [deg]\n" + rows)
    one = case(tmp_path, measured=MEASURED % ("tap.csv", ", name: tap"))
    found = deliver(one, tmp_path / "o", formats=("svg",))
    text = " ".join(found.summary.split())
    assert f"measured tap, receptance {PAIR} at 0 rpm: FRAC 0." in text
    result = solve(case(tmp_path, measured=MEASURED % ("tap.csv", ""))).results["frf"]
    assert result.measured_peak[0, 0] / result.computed_peak[0, 0] == pytest.approx(1.05, rel=0.01)
    ratio = result.measured_peak_amplitude[0, 0] / result.computed_peak_amplitude[0, 0]
    assert ratio == pytest.approx(0.5, rel=0.05)
    assert "tap, measured at 0 rpm" in (tmp_path / "o" / "frf_amplitude_phase.svg").read_text()
    assert (tmp_path / "o" / "frf_measured_peaks.csv").exists()
    assert math.isfinite(result.frac[0])
    assert result.frac[0] < 0.9


@pytest.mark.parametrize(
    ("slices", "drawn"),
    [
        ("[0 rpm, 1000 rpm]", [0.0, 330.0, 1000.0]),
        ("[]", [0.0, 330.0, 1000.0]),
        ("[0 rpm, 100 rpm, 200 rpm]", [0.0, 100.0, 200.0, 330.0]),
    ],
)
def test_the_curve_that_a_measured_one_is_compared_with_is_drawn(
    tmp_path: Path, slices: str, drawn: list[float]
) -> None:
    """At the speed of the measurement, between the slices; a study keeps that speed, too, and a
    comparison shows it where it leaves slices out."""
    rows = "".join(f"{f},{1.0 + f % 3},0\n" for f in range(5, 40))
    (tmp_path / "tap.csv").write_text("frequency [Hz],amplitude [um/N],phase [deg]\n" + rows)
    asked = (ASKED % "receptance").replace("slices: [0 rpm, 1000 rpm]", f"slices: {slices}")
    every = "speeds: {from: 0 rpm, to: 1000 rpm, step: 10 rpm}"
    asked = asked.replace("speeds: [0 rpm, 1000 rpm]", every)
    tap = MEASURED % ("tap.csv", ", name: tap, speed: 330 rpm")
    (tmp_path / "case.yaml").write_text(HEAD + asked + tap)
    few = lean(rotordyn.load(tmp_path / "case.yaml"))
    assert len(few.speeds) < 14
    found = solve(few).results["frf"]
    assert (found.slice_speed * 30.0 / math.pi).tolist() == pytest.approx(drawn)
    curves = headline_curves(None, Shown("", found, (), None))
    titles = {each.title.partition(" at ")[2] for each in curves}
    assert len(titles) == 3
    assert "330 rpm" in titles


@pytest.mark.long
def test_a_response_compared_at_another_speed_than_its_own_is_reported(tmp_path: Path) -> None:
    rows = "".join(f"{f},{1.0 + f % 3},0\n" for f in range(5, 40))
    (tmp_path / "tap.csv").write_text("frequency [Hz],amplitude [um/N],phase [deg]\n" + rows)
    for rpm, words in ((400, "400 rpm, computed at 0 rpm"), (1000, "1000 rpm"), (0, "0 rpm")):
        asked = MEASURED % ("tap.csv", f", name: tap, speed: {rpm} rpm")
        found = deliver(case(tmp_path, measured=asked), tmp_path / "o")
        text = " ".join(found.summary.split())
        assert f"measured tap, receptance {PAIR} at {words}: FRAC 0." in text


def test_a_response_of_too_few_points_is_not_compared(tmp_path: Path) -> None:
    (tmp_path / "tap.csv").write_text(
        "frequency [Hz],amplitude [um/N],phase [deg]\n10,1,0\n20,2,0\n30,1,0\n"
    )
    result = solve(case(tmp_path, measured=MEASURED % ("tap.csv", ""))).results["frf"]
    line = measured_lines(result)[-1]
    why = "not compared, 3 of its points lie in the band, 8 are needed"
    assert line == f"measured   measured 1, receptance {PAIR} at 0 rpm: {why}"
    assert [one for one in measured_warnings(result) if why.split(", ")[1] in one]


@pytest.mark.parametrize("kind", ["receptance", "mobility", "inertance"])
def test_a_response_of_no_driving_point_is_reported(kind: str) -> None:
    """An oscillator as it is, with a sensor against the force, and with the sign convention
    e^(-iωt), which the real part of a mobility does not show; between two points anything goes."""
    frequency = np.linspace(1.0, 40.0, 60)
    omega = 2.0 * math.pi * frequency
    by_kind = {"receptance": 1.0 + 0j * omega, "mobility": 1j * omega, "inertance": -(omega**2)}
    values = by_kind[kind] / (4e4 - omega**2 + 8.0j * omega)

    def told(response: Any, pair: str = "a.y / a.y", error: float = math.nan) -> list[str]:
        result: Any = SimpleNamespace(
            kind=kind,
            measured=("tap",),
            measured_pair=(pair,),
            measured_speed=np.zeros(1),
            measured_error=np.array([error]),
            measured_frequency=frequency[None],
            measured_response=response[None],
        )
        return [*frf_summary._driving_points(result)]

    assert not told(values)
    for turned in (-values, *([] if kind == "mobility" else [values.conj()])):
        (said,) = told(turned)
        assert said.startswith(
            f"measured response tap is not that of a driving point: as {kind} it"
        )
        assert "extracts power from the structure: check whether it is another quantity" in said
        assert not told(turned, error=0.1)  # the tip of a tool on a measured spindle
    assert not told(values.conj(), "a.y / b.y")


def test_peaks_of_a_coarse_record_of_the_same_machine_are_its_own(tmp_path: Path) -> None:
    """Lines of 0.5 Hz, the highest of which has a tenth of a peak at rest; at 1000 rpm two peaks
    stand nearer to each other than lines, which is reported."""
    result = solve(case(tmp_path)).results["frf"]
    lines, found = [], []
    for rpm, values in zip((0, 1000), result.receptance[:, 0], strict=True):
        rows = "".join(
            f"{at:.9g},{value.real * 1e6:.9g},{value.imag * 1e6:.9g}\n"
            for at, value in zip(result.frequency, values, strict=True)
        )
        (tmp_path / "tap.csv").write_text("frequency [Hz],real [um/N],imag [um/N]\n" + rows)
        asked = MEASURED % ("tap.csv", f", name: tap, speed: {rpm} rpm")
        found.append(solve(case(tmp_path, measured=asked)).results["frf"])
        lines.append(np.abs(values))
    rest, turning = found
    known = np.isfinite(rest.measured_peak[0])
    assert known.sum() == 2
    assert lines[0].max() < 0.11 * rest.computed_peak_amplitude[0, known].max()
    np.testing.assert_allclose(rest.measured_peak, rest.computed_peak, rtol=5e-5)
    amplitudes = rest.measured_peak_amplitude, rest.computed_peak_amplitude
    np.testing.assert_allclose(*amplitudes, rtol=1e-4)
    assert not [each for each in measured_warnings(rest) if "too far apart" in each]
    (told,) = [each for each in measured_warnings(turning) if "too far apart" in each]
    assert "too far apart for the peaks at 42.5, 44.5 Hz" in told
