"""From a case to Datasets and to a results folder."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import rotordyn
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution, OutputRefused
from rotordyn.job import deliver, restricted, run, solve, unsolved
from rotordyn.machine.growth import PrescribedShortening
from rotordyn.report.netcdf import read_results
from tests.oracles.spindles import RPM, case, mfw2310, pairs

pytestmark = pytest.mark.usefixtures("draft")


def small(**changes: object) -> Case:
    """The flagship at three speeds and few frequencies."""
    analyses = {
        "preload": PreloadSpec(),
        "campbell": CampbellSpec(3000.0),
        "frf": FrfSpec(
            tuple(np.linspace(10, 3000, 40)), pairs("Oc2.y/Oc2.y", "Oc2.z/Oc2.y"), (0.0,)
        ),
        "stiffness": StiffnessSpec("Oc2", 500.0, 2),
    }
    speeds = (0.0, 12000 * RPM, 24000 * RPM)
    return replace(case(), **{"speeds": speeds, "analyses": analyses, **changes})


def losing(rpm: float) -> Case:
    """Preload of the rear pair is lost at ``rpm`` and above."""
    far = PrescribedShortening(rpm * RPM, {"d": 300e-6, "e": 300e-6})
    return small(spindle=mfw2310(shortening=far))


def test_run_returns_datasets_with_complex_values() -> None:
    found = rotordyn.run(small())
    assert set(found) == {"preload", "campbell", "frf", "stiffness"}
    frf = found["frf"]
    assert isinstance(frf, xr.Dataset)
    assert np.iscomplexobj(frf["receptance"])
    assert frf["receptance"].dims == ("speed", "pair", "frequency")
    assert frf["speed_rpm"].values == pytest.approx([0, 12000, 24000])
    assert frf["speed"].attrs["units"] == "rad s-1"
    picked = found["stiffness"]["tangent"].sel(variant="full", speed=0.0)
    assert float(picked) == pytest.approx(142.7e6, rel=5e-3)
    assert np.iscomplexobj(found["campbell"]["shape"])
    assert found["preload"]["axial_load"].sel(bearing="c")[0] == pytest.approx(574.0)


def test_run_solves_as_the_job_does() -> None:
    case = restricted(small(), ("preload",))
    assert rotordyn.run(case)["preload"].identical(run(case)["preload"])


def test_only_what_is_asked() -> None:
    kept = restricted(small(), ("stiffness",))
    assert list(kept.analyses) == ["stiffness"]
    assert set(run(kept)) == {"stiffness"}
    with pytest.raises(InvalidInput, match="preload, campbell, frf, stiffness"):
        restricted(small(), ("stiffness", "modal"))


def test_case_without_a_machine() -> None:
    with pytest.raises(InvalidInput, match="either a spindle or a bearing: given neither"):
        solve(small(spindle=None))


def test_folder_holds_numbers_tables_figures_and_record(tmp_path: Path) -> None:
    delivery = deliver(small(), tmp_path / "out")
    names = {p.name for p in delivery.folder.iterdir()}
    assert {"results.nc", "run.json", "summary.txt", "frf.uff", "preload.csv"} <= names
    for figure in ("machine", "campbell", "frf_map", "frf_surface", "stiffness", "preload"):
        assert f"{figure}.png" in names
    assert all(p.stat().st_size > 0 for p in delivery.folder.iterdir())
    assert list(tmp_path.iterdir()) == [delivery.folder], "nothing beside the folder"
    record = json.loads((delivery.folder / "run.json").read_text(encoding="utf-8"))
    assert set(record["files"]) == names
    assert record["digest"] == case().digest
    assert set(record["outcomes"]) == {"preload", "campbell", "frf", "stiffness"}
    assert max(record["tolerances"].values()) < 1e-8
    assert {"numpy", "h5py", "rotordyn"} <= set(record["versions"])
    assert set(record["stages"]) >= {"preload", "solve frf", "write"}
    assert delivery.unsolved == ()
    assert (delivery.folder / "summary.txt").read_text(encoding="utf-8").strip() in (
        delivery.summary + "\n"
    )


def test_file_holds_what_run_returns(tmp_path: Path) -> None:
    asked = restricted(small(), ("preload", "frf"))
    deliver(asked, tmp_path / "out", figures=False)
    written, direct = read_results(tmp_path / "out" / "results.nc"), run(asked)
    assert set(written) == set(direct)
    for name, computed in direct.items():
        read = written[name]  # from the file, each time
        for variable in computed.data_vars:
            a, b = read[variable].values, computed[variable].values
            if a.dtype.kind in "fc":
                assert np.array_equal(a, b, equal_nan=True), variable
    with xr.open_dataset(tmp_path / "out" / "results.nc", group="frf", engine="h5netcdf") as opened:
        assert {"receptance_re", "receptance_im"} <= set(opened.data_vars)
        assert opened["frequency"].attrs["units"] == "Hz"


def test_two_runs_give_equal_numbers() -> None:
    first, second = run(small()), run(small())
    for name in first:
        xr.testing.assert_equal(first[name], second[name])


def test_second_delivery_replaces_the_first_whole(tmp_path: Path) -> None:
    deliver(restricted(small(), ("preload", "stiffness")), tmp_path / "out", figures=False)
    assert (tmp_path / "out" / "stiffness.csv").exists()
    deliver(restricted(small(), ("preload",)), tmp_path / "out", figures=False)
    assert not (tmp_path / "out" / "stiffness.csv").exists()
    assert (tmp_path / "out" / "preload.csv").exists()


def test_foreign_folder_is_refused_before_anything_is_solved(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("mine")
    seen: list[str] = []
    with pytest.raises(OutputRefused):
        deliver(small(), tmp_path, seen.append)
    assert seen == []
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.tex"]


def test_failure_leaves_nothing_and_keeps_the_old(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = restricted(small(), ("preload",))
    deliver(asked, tmp_path / "out", figures=False)
    before = (tmp_path / "out" / "run.json").read_text(encoding="utf-8")

    def full_disk(*_: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr("rotordyn.report.manifest.write_record", full_disk)
    for target in ("out", "new"):
        with pytest.raises(OSError, match="no space"):
            deliver(asked, tmp_path / target, figures=False)
    assert [p.name for p in tmp_path.iterdir()] == ["out"]
    assert (tmp_path / "out" / "run.json").read_text(encoding="utf-8") == before


def test_no_solution_writes_nothing(tmp_path: Path) -> None:
    lost = losing(100.0).vary({"speeds": (12000 * RPM, 24000 * RPM), "analyses.frf.slices": ()})
    for only in (("preload",), ("campbell",), ("preload", "frf", "stiffness")):
        with pytest.raises(NoSolution, match="unloaded at 12000 rpm"):
            deliver(restricted(lost, only), tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_part_of_the_speeds_is_delivered_and_the_rest_named(tmp_path: Path) -> None:
    delivery = deliver(losing(24000.0), tmp_path / "out", figures=False)
    assert len(delivery.unsolved) == 1
    assert "d, e is unloaded at 24000 rpm" in delivery.unsolved[0]
    text = (delivery.folder / "summary.txt").read_text(encoding="utf-8")
    assert delivery.summary + "\n" == text
    assert any(
        line.startswith("not solved ") and "d, e is unloaded at 24000 rpm" in line
        for line in text.splitlines()
    )
    record = json.loads((delivery.folder / "run.json").read_text(encoding="utf-8"))
    words = record["outcomes"]["frf"]
    assert words[""] == [0.0, 12000.0]
    assert any("unloaded" in word and rpm == [24000.0] for word, rpm in words.items() if word)


def test_unsolved_lists_each_reason_once() -> None:
    reasons = unsolved(solve(losing(24000.0)).results)
    assert len(reasons) == len(set(reasons)) == 1


def test_progress_names_every_question_and_the_figures(tmp_path: Path) -> None:
    seen: list[str] = []
    deliver(restricted(small(), ("preload", "stiffness")), tmp_path / "out", seen.append)
    assert seen == ["preload", "stiffness", "figures"]


def test_pairs_across_motions_are_delivered(tmp_path: Path) -> None:
    """A support couples x, thx and bending: files and figures take any pair."""
    path = tmp_path / "coupled.yaml"
    path.write_text(
        "title: coupled\nspindle: friswell_two_discs\noverride:\n"
        "  supports.left.stiffness:\n    dof: [y, z, x, thx]\n    matrix:\n"
        "      - [1 N/um, 0, 0.2 N/um, 1 kN/rad]\n      - [0, 1 N/um, 0, 0]\n"
        "      - [0.2 N/um, 0, 2 N/um, 0]\n      - [1 kN/rad, 0, 0, 50 kN m/rad]\n"
        "  supports.left.damping: {xx: 500 N s/m, yy: 300 N s/m, thx_thx: 2 N m s/rad}\n"
        "speeds: [0 rpm, 2000 rpm]\nanalyses:\n  campbell: {max_frequency: 150 Hz}\n  frf:\n"
        "    frequencies: {from: 1 Hz, to: 150 Hz, count: 40}\n    pairs:\n"
        "      - {response: left_disc.x, excitation: right_disc.y}\n"
        "      - {response: left_disc.thx, excitation: right_disc.x}\n"
        "      - {response: left_disc.thz, excitation: right_disc.thx}\n"
    )
    delivery = deliver(rotordyn.load(path), tmp_path / "out")
    found = read_results(delivery.folder / "results.nc")
    assert set(found["campbell"]["kind"].values.tolist()) == {"bending", "axial", "torsion"}
    assert (np.abs(found["frf"]["receptance"].values).max(axis=-1) > 0.0).all()
    header = (delivery.folder / "frf_2000rpm.csv").read_text(encoding="utf-8-sig").splitlines()[0]
    for unit in ("left_disc.x / right_disc.y real [µm/N]", "[rad/N]", "[rad/(N·m)]"):
        assert unit in header
    assert (delivery.folder / "frf.uff").stat().st_size > 0
    record = json.loads((delivery.folder / "run.json").read_text(encoding="utf-8"))
    (joined,) = [key for key in record["tolerances"] if key.startswith("bending and")]
    assert record["tolerances"][joined] < 1e-9
    assert record["warnings"] == []
