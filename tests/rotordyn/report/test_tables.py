"""CSV tables: tidy rows, engineering units in the header, the right number in the right place."""

from __future__ import annotations

import csv
import math
from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.frf.spec import Port
from rotordyn.analyses.registry import analysis
from rotordyn.job import restricted
from rotordyn.report.tables import write_tables
from rotordyn.results.declaration import declared
from tests.rotordyn.figures import samples


@pytest.fixture(scope="module")
def folder(tmp_path_factory, results):
    path = tmp_path_factory.mktemp("csv")
    assert set(write_tables(path, results)) == {p.name for p in path.iterdir()}
    return path


def _rows(path):
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def test_every_layout_and_slice_has_its_file(folder, results):
    every = (layout for name in results for layout in analysis(name).tables)
    planned = {f"{layout.name}.csv" for layout in every if not layout.several}  # one rotor
    none = {"frf_engine_orders.csv", "unbalance_peaks.csv"}  # neither are there
    slices = {f"frf_{n}rpm.csv" for n in (0, 12000, 24000)}
    measured = {"frf_measured.csv", "frf_measured_peaks.csv"}  # nothing was
    assert {p.name for p in folder.iterdir()} == planned - measured - none | slices


def test_preload_has_a_row_per_speed_and_bearing(folder, results):
    rows, result = _rows(folder / "preload.csv"), results["preload"]
    assert len(rows) == 9 * 5
    row = rows[8 * 5 + 2]
    assert (row["speed [rpm]"], row["bearing"], row["outcome"]) == ("24000", "c", "solved")
    assert float(row["axial load [N]"]) == pytest.approx(result.axial_load[8, 2], rel=1e-6)
    assert float(row["stiffness y,y [N/µm]"]) == pytest.approx(
        result.stiffness[8, 2, 1, 1] / 1e6, rel=1e-6
    )
    assert float(row["inner peak pressure [GPa]"]) == pytest.approx(
        result.inner_pressure[8, 2] / 1e9, rel=1e-6
    )
    assert float(row["outer contact angle [deg]"]) == pytest.approx(
        math.degrees(result.outer_angle[8, 2]), rel=1e-6
    )
    assert "stiffness y,thz [N/rad]" in row
    assert "stiffness thz,thz [N·m/rad]" in row


def test_campbell_has_a_column_per_mode(folder, results):
    rows = _rows(folder / "campbell.csv")
    assert len(rows) == 9
    assert float(rows[-1]["damped frequency 2 fw [Hz]"]) == pytest.approx(
        results["campbell"].frequency[-1, 3], rel=1e-6
    )
    assert float(rows[-1]["pole 2 fw imaginary [rad/s]"]) == pytest.approx(
        results["campbell"].pole[-1, 3].imag, rel=1e-6
    )


def test_curves_and_shapes_are_in_printed_units(folder, results):
    curve = _rows(folder / "stiffness_curves.csv")[-1]
    assert float(curve["deflection [µm]"]) == pytest.approx(
        results["stiffness"].deflection[-1, -1, -1] * 1e6, rel=1e-6
    )
    shape = _rows(folder / "campbell_shapes.csv")[0]
    assert float(shape["station [mm]"]) == pytest.approx(-91.8)
    assert "mode shape y imaginary [-]" in shape


def test_a_number_that_does_not_exist_is_an_empty_cell(tmp_path, results):
    result = results["preload"]
    load = np.where(result.speed[:, None] > 0.0, np.nan, np.full_like(result.axial_load, 600.0))
    lost = replace(result, axial_load=load)
    write_tables(tmp_path, {"preload": lost})
    cells = [row["axial load [N]"] for row in _rows(tmp_path / "preload.csv")]
    assert {*cells} == {"600", ""}


def test_slices_less_than_a_turn_apart_have_a_file_each_and_lost_ones_none(tmp_path, results):
    frf = results["frf"]
    speed = np.array([13000.0, 13000.4, 24000.0]) * np.pi / 30
    cut = {
        name: getattr(frf, name)[:3].copy()
        for name, field in declared(frf).items()
        if field.metadata["dims"][:1] in (("speed",), ("slice_speed",)) and name != "outcome"
    }
    cut["slice_value"][2] = complex(np.nan, np.nan)
    cut |= {"speed": speed, "slice_speed": speed, "outcome": ("", "", "lost")}
    write_tables(tmp_path, {"frf": replace(frf, **cut)})
    assert {p.name for p in tmp_path.iterdir()} == {"frf_13000rpm.csv", "frf_13000.4rpm.csv"}


def test_slices_hold_both_parts_of_every_pair(folder, results):
    rows = _rows(folder / "frf_24000rpm.csv")
    held = np.array([float(r["receptance O3.y / Oc2.y imaginary [µm/N]"]) for r in rows])
    wanted = results["frf"].receptance[-1, 3].imag * 1e6
    np.testing.assert_allclose(held, wanted, rtol=1e-6)


def test_section_forces_have_units_of_their_own(folder):
    """Stations in mm at either side of a jump, stresses in MPa, reactions by component."""
    rows = _rows(folder / "section_forces.csv")
    assert {row["station [mm]"] for row in rows} >= {"-91.8", "436.4"}
    assert rows[0]["outer diameter [mm]"] == "70"
    most = max(float(row["von Mises stress [MPa]"]) for row in rows)
    assert most == pytest.approx(samples.section_forces(9).von_mises_stress.max() / 1e6, rel=1e-6)
    (*_, last) = _rows(folder / "section_forces_reactions.csv")
    assert (last["support"], last["station [mm]"]) == ("rear", "436.4")
    assert (last["reaction Fy [N]"], last["reaction Mz [N·m]"]) == ("500", "0")
    (*_, twist) = _rows(folder / "section_forces_twist.csv")
    assert twist["outer diameter at the limit of twist [mm]"] == "39.55"


def test_slices_hold_amplitude_and_phase_too(folder, results):
    rows = _rows(folder / "frf_24000rpm.csv")
    pair = "receptance O3.y / Oc2.y"
    size, angle = (
        np.array([float(r[f"{pair} {what}"]) for r in rows])
        for what in ("amplitude [µm/N]", "phase [deg]")
    )
    wanted = results["frf"].receptance[-1, 3] * 1e6
    turned = size * np.exp(1j * np.radians(angle))
    np.testing.assert_allclose(turned, wanted, rtol=1e-5)


def test_tables_open_in_excel_with_their_units(folder):
    """Excel takes a file for UTF-8 by its mark alone; without it µ becomes two letters."""
    for path in folder.iterdir():
        assert path.read_bytes().startswith(b"\xef\xbb\xbf")


def test_responses_along_engine_orders_have_the_units_of_their_pairs(tmp_path):
    case = rotordyn.load("grinding_spindle")
    push = Port("nose", "y")
    pairs = (push, push), (Port("nose", "thz"), push)
    changes = {"analyses.frf.pairs": pairs, "analyses.frf.engine_orders": (1.0,)}
    changes["speeds"] = (0.0, 400.0 * math.pi)
    case = restricted(case, ("frf",)).vary(changes)
    result = rotordyn.run(case).parts[""].results["frf"]
    write_tables(tmp_path, {"frf": result})
    last, value = _rows(tmp_path / "frf_engine_orders.csv")[-1], result.line_value[-1, 0]
    moved = float(last["response nose.y / nose.y real [µm/N]"])
    assert moved == pytest.approx(value[0].real * 1e6, rel=1e-6)
    turned = float(last["response nose.thz / nose.y real [rad/N]"])
    assert turned == pytest.approx(value[1].real, rel=1e-6)
