"""UFF 58 records read back by pyuff: exact values, nodes, directions and data types."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import pyuff

from rotordyn.analyses.frf.result import InertanceResult, MobilityResult
from rotordyn.analyses.frf.uff import write_uff
from tests.rotordyn.figures import samples

pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
NODES = {"Oc2": 1, "Oc1": 2, "O2": 5, "O3": 6}


def _read(path):
    file = pyuff.UFF(str(path))
    assert set(file.get_set_types()) == {58}
    return [file.read_sets(k) for k in range(file.get_n_sets())]


def test_one_exact_record_per_slice_and_pair(tmp_path, results):
    frf = results["frf"]
    assert write_uff(tmp_path / "frf.uff", frf, case="sample", nodes=NODES) == 12
    sets = _read(tmp_path / "frf.uff")
    slices = np.flatnonzero(frf.is_slice)
    for place, record in enumerate(sets):
        wanted = frf.receptance[slices[place // 4], place % 4]
        np.testing.assert_array_equal(record["data"], wanted)
        np.testing.assert_allclose(record["x"], frf.frequency, rtol=1e-12)


def test_fields_of_a_record(tmp_path, results):
    write_uff(tmp_path / "frf.uff", results["frf"], case="sample", nodes=NODES)
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
    write_uff(tmp_path / "frf.uff", turned, case="sample", nodes=NODES)
    found = [(r["rsp_dir"], r["ref_dir"]) for r in _read(tmp_path / "frf.uff")[:4]]
    assert found == [(6, 2), (2, 4), (1, 3), (5, 5)]


def test_text_form_keeps_twelve_digits(tmp_path, results):
    frf = results["frf"]
    write_uff(tmp_path / "frf.uff", frf, case="sample", nodes=NODES, binary=False)
    np.testing.assert_allclose(
        _read(tmp_path / "frf.uff")[0]["data"], frf.receptance[0, 0], rtol=1e-11
    )


def test_even_axis_is_stored_as_even(tmp_path, results):
    frf = replace(results["frf"], frequency=np.arange(300) * 2.0 + 10.0)
    write_uff(tmp_path / "frf.uff", frf, case="sample", nodes=NODES)
    record = _read(tmp_path / "frf.uff")[0]
    assert record["abscissa_spacing"] == 1
    np.testing.assert_array_equal(record["x"], frf.frequency)


def test_a_speed_without_solution_has_no_record(tmp_path, results):
    values = results["frf"].receptance.copy()
    values[-1] = np.nan
    broken = replace(results["frf"], receptance=values)
    assert write_uff(tmp_path / "frf.uff", broken, case="sample", nodes=NODES) == 8


@pytest.mark.parametrize(
    ("kind", "code", "unit"), [(MobilityResult, 11, "m/s"), (InertanceResult, 12, "m/s^2")]
)
def test_velocity_and_acceleration_have_their_own_data_types(tmp_path, kind, code, unit):
    frf = samples.frf_of(kind, 5, 40)
    write_uff(tmp_path / "frf.uff", frf, case="sample", nodes=NODES)
    record = _read(tmp_path / "frf.uff")[0]
    assert record["ordinate_spec_data_type"] == code
    assert record["ordinate_axis_units_lab"].strip() == f"[{unit}]"
    assert record["id1"].startswith(f"{kind.kind} Oc2.y / Oc2.y [(m/s")
    np.testing.assert_array_equal(record["data"], frf.response[0, 0])
