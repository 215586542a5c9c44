"""UFF 58 records read back by pyuff: exact values, nodes, directions and data types."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import pyuff

import rotordyn
from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.frf.result import InertanceResult, MobilityResult
from rotordyn.analyses.frf.uff import write_uff
from rotordyn.job import deliver
from rotordyn.machine.rotor import Place
from tests.rotordyn.figures import samples

pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
NAMES = ("Oc2", "Oc1", "a", "b", "O2", "O3")
PLACES = {name: Place("spindle", 0.01 * k) for k, name in enumerate(NAMES)}


def _read(path):
    file = pyuff.UFF(str(path))
    kinds = list(file.get_set_types())
    assert kinds[:2] == [164, 2411]
    assert set(kinds[2:]) == {58}
    return [file.read_sets(k) for k in range(2, file.get_n_sets())]


def test_one_exact_record_per_slice_and_pair(tmp_path, results):
    frf = results["frf"]
    assert write_uff(tmp_path / "frf.uff", frf, case="sample", places=PLACES) == 12
    sets = _read(tmp_path / "frf.uff")
    slices = np.flatnonzero(frf.is_slice)
    for place, record in enumerate(sets):
        wanted = frf.receptance[slices[place // 4], place % 4]
        np.testing.assert_array_equal(record["data"], wanted)
        np.testing.assert_allclose(record["x"], frf.frequency, rtol=1e-12)


@pytest.mark.parametrize("even", [True, False])
def test_heads_say_how_many_bytes_follow(tmp_path, results, even):
    """Data cut after the length in the header: each is followed by the end of its record."""
    path, frf = tmp_path / "frf.uff", results["frf"]
    frequency = np.linspace(100.0, 1100.0, len(frf.frequency)) ** (1.0 if even else 1.01)
    write_uff(path, replace(frf, frequency=frequency), case="sample", places=PLACES)
    content, at = path.read_bytes(), 0
    slices = np.flatnonzero(frf.is_slice)
    for place in range(12):
        at = content.index(b"    58b", at)
        size = int(content[at + 31 : at + 43])
        for _ in range(12):
            at = content.index(b"\n", at) + 1
        numbers = np.frombuffer(content[at : at + size]).reshape(len(frequency), -1)
        wanted = frf.receptance[slices[place // 4], place % 4]
        np.testing.assert_array_equal(numbers[:, -2] + 1j * numbers[:, -1], wanted)
        at += size
        assert content[at:].lstrip(b"\n")[:6] == b"    -1"


def test_fields_of_a_record(tmp_path, results):
    write_uff(tmp_path / "frf.uff", results["frf"], case="sample", places=PLACES)
    record = _read(tmp_path / "frf.uff")[11]
    assert (record["func_type"], record["ord_data_type"]) == (4, 6)
    assert (record["rsp_node"], record["rsp_dir"]) == (6, 2)
    assert (record["ref_node"], record["ref_dir"]) == (1, 2)
    assert record["abscissa_spec_data_type"] == 18
    assert record["ordinate_spec_data_type"] == 8
    assert record["orddenom_spec_data_type"] == 13
    assert record["z_axis_value"] == pytest.approx(24000.0)
    assert "O3.y / Oc2.y" in record["id1"]
    assert "m/N" in record["id1"]
    assert "sample" in record["id2"]
    assert "24000 rpm" in record["id3"]


def test_rotations_have_their_own_directions(tmp_path, results):
    pairs = ("Oc2.thz / Oc2.y", "Oc2.y / Oc2.thx", "O2.x / Oc2.z", "O3.thy / O3.thy")
    turned = replace(results["frf"], pair=pairs)
    write_uff(tmp_path / "frf.uff", turned, case="sample", places=PLACES)
    found = [(r["rsp_dir"], r["ref_dir"]) for r in _read(tmp_path / "frf.uff")[:4]]
    assert found == [(6, 2), (2, 4), (1, 3), (5, 5)]


def test_text_form_keeps_twelve_digits(tmp_path, results):
    frf = results["frf"]
    write_uff(tmp_path / "frf.uff", frf, case="sample", places=PLACES, binary=False)
    np.testing.assert_allclose(
        _read(tmp_path / "frf.uff")[0]["data"], frf.receptance[0, 0], rtol=1e-11
    )


def test_even_axis_is_stored_as_even(tmp_path, results):
    even = np.arange(300) * 2.0 + 10.0
    slices = np.broadcast_to(even, (len(results["frf"].slice_speed), 300))
    frf = replace(results["frf"], frequency=even, slice_frequency=slices)
    write_uff(tmp_path / "frf.uff", frf, case="sample", places=PLACES)
    record = _read(tmp_path / "frf.uff")[0]
    assert record["abscissa_spacing"] == 1
    np.testing.assert_array_equal(record["x"], frf.frequency)


def test_a_speed_without_solution_has_no_record(tmp_path, results):
    values = results["frf"].slice_value.copy()
    values[-1] = np.nan
    broken = replace(results["frf"], slice_value=values)
    assert write_uff(tmp_path / "frf.uff", broken, case="sample", places=PLACES) == 8


@pytest.mark.parametrize(
    ("kind", "code", "unit"), [(MobilityResult, 11, "m/s"), (InertanceResult, 12, "m/s^2")]
)
def test_velocity_and_acceleration_have_their_own_data_types(tmp_path, kind, code, unit):
    frf = samples.frf_of(kind, 5, 40)
    write_uff(tmp_path / "frf.uff", frf, case="sample", places=PLACES)
    record = _read(tmp_path / "frf.uff")[0]
    assert record["ordinate_spec_data_type"] == code
    assert record["ordinate_axis_units_lab"].strip() == f"[{unit}]"
    assert record["id1"].startswith(f"{kind.kind} Oc2.y / Oc2.y [(m/s")
    np.testing.assert_array_equal(record["data"], frf.response[0, 0])


def test_units_are_si_and_points_are_nodes_on_the_axis(tmp_path, results):
    write_uff(tmp_path / "frf.uff", results["frf"], case="sample", places=PLACES)
    file = pyuff.UFF(str(tmp_path / "frf.uff"))
    units, nodes, record = (file.read_sets(k) for k in range(3))
    assert (units["units_code"], units["length"], units["force"]) == (1, 1.0, 1.0)
    np.testing.assert_array_equal(nodes["node_nums"], [1, 2, 3, 4, 5, 6])
    np.testing.assert_allclose(nodes["x"], [place.x for place in PLACES.values()], rtol=1e-15)
    assert not np.any([nodes["y"], nodes["z"]])
    assert record["rsp_node"] in nodes["node_nums"]


def test_a_single_frequency_leaves_no_record_and_a_note(tmp_path):
    path = tmp_path / "one.yaml"
    path.write_text(
        "spindle: friswell_two_discs\nspeeds: [0 rpm]\nanalyses:\n  frf:\n    frequencies: [9 Hz]\n"
        "    pairs: [{response: left_disc.y, excitation: left_disc.y}]\n    slices: [0 rpm]\n"
    )
    deliver(rotordyn.load(path), tmp_path / "out", figures=False)
    assert not (tmp_path / "out" / "frf.uff").exists()
    (note,) = rotordyn.open(tmp_path / "out").notes
    assert note.startswith("frf.uff omitted: one frequency, but a record needs two or more")


def test_our_own_reader_takes_it_back(tmp_path, results):
    frf = results["frf"]
    write_uff(tmp_path / "frf.uff", frf, case="sample", places=PLACES)
    record = read_record(tmp_path / "frf.uff", frf.pair[1], 2)
    assert record.quantity == "receptance"
    np.testing.assert_array_equal(record.values, frf.receptance[0, 1])


@pytest.mark.parametrize("binary", [True, False])
def test_headers_are_ascii_whatever_the_names(tmp_path, results, binary):
    frf = replace(results["frf"], pair=("Fräser.y / Oc2.y", *results["frf"].pair[1:]))
    places = {**PLACES, "Fräser": Place("spindle", 0.1)}
    write_uff(tmp_path / "frf.uff", frf, case="Spindel für µm", places=places, binary=binary)
    head = (tmp_path / "frf.uff").read_bytes().split(b"NONE")[0]
    assert head.isascii()
    assert "for um" not in head.decode()
    assert r"f\xfcr um" in head.decode()
    assert len(_read(tmp_path / "frf.uff")) == 12
