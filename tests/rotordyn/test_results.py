"""What a run gives back: datasets, words, figures, a folder, and the folder read back."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import rotordyn
from rotordyn.analyses import CampbellSpec, FrfSpec, PreloadSpec, ShapesInSpaceSpec
from rotordyn.case.archive import archived, restored
from rotordyn.case.case import Case
from rotordyn.cli import main
from rotordyn.errors import InvalidInput, OutputRefused
from rotordyn.report.manifest import FORMAT
from rotordyn.results.declaration import declared
from rotordyn.view import apart
from tests.oracles.spindles import RPM, case, pairs

pytestmark = pytest.mark.usefixtures("draft")

TIMES = ("stages", "figures", "versions")


def small() -> Case:
    """The flagship at three speeds: real and complex results, and a machine with everything."""
    analyses = {
        "preload": PreloadSpec(),
        "campbell": CampbellSpec(1000.0, teeth=(3,)),
        "frf": FrfSpec(tuple(np.linspace(10, 900, 30)), pairs("Oc2.y/Oc2.y"), (0.0,)),
    }
    whole = replace(case(), speeds=(0.0, 12000 * RPM, 24000 * RPM), analyses=analyses)
    return replace(whole, title="Fischer <script>alert(1)</script>")


@pytest.fixture(scope="module")
def results() -> rotordyn.Results:
    return rotordyn.run(small())


@pytest.fixture(scope="module")
def folder(results: rotordyn.Results, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return results.save(tmp_path_factory.mktemp("saved") / "out")


@pytest.fixture(scope="module")
def opened(folder: Path) -> rotordyn.Results:
    return rotordyn.open(folder)


def test_is_a_mapping_of_datasets_made_once(results: rotordyn.Results) -> None:
    assert list(results) == ["preload", "campbell", "frf"]
    assert "frf" in results
    assert "stiffness" not in results
    assert isinstance(results["campbell"], xr.Dataset)
    assert results["campbell"] is results["campbell"]
    with pytest.raises(KeyError, match="no results modal: there are preload, campbell, frf"):
        results["modal"]


def test_datasets_hold_the_arrays_of_the_results_themselves(results: rotordyn.Results) -> None:
    held = results.parts[""].results["frf"].receptance
    assert np.shares_memory(results["frf"].receptance.values, held)


def test_nothing_is_made_before_it_is_requested(tmp_path: Path) -> None:
    """A run loads neither xarray nor what draws; saving numbers needs neither."""
    code = (
        "import sys, rotordyn\n"
        "results = rotordyn.run(rotordyn.load('lalanne_ferraris'))\n"
        "list(results), repr(results), results.summary, results.warnings\n"
        "results.save(sys.argv[1], figures=False)\n"
        "stored = rotordyn.open(sys.argv[1])\n"
        "list(stored), repr(stored), stored.summary, stored._repr_html_()\n"
        "print(*sorted({'xarray', 'matplotlib', 'pandas'} & set(sys.modules)))\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path / "out")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == ""


def test_saved_folder_is_that_of_the_command(tmp_path: Path) -> None:
    """Byte for byte, times aside: a case alone and one that compares."""
    for name in ("mfw2310_sag", "vex70_steel_or_hybrid"):
        by_command, saved = tmp_path / name / "command", tmp_path / name / "saved"
        assert main(["run", name, "-o", str(by_command), "--quiet"]) == 0
        assert rotordyn.run(rotordyn.load(name)).save(saved) == saved
        one, other = _contents(by_command), _contents(saved)
        assert set(one) == set(other)
        assert [path for path in one if one[path] != other[path]] == []


def _contents(folder: Path) -> dict[str, object]:
    """Every file by its place: bytes, or what they hold where times are among them."""
    found: dict[str, object] = {}
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        place = path.relative_to(folder).as_posix()
        if path.name == "run.json":
            record = json.loads(path.read_text(encoding="utf-8"))
            found[place] = {key: each for key, each in record.items() if key not in TIMES}
        elif path.suffix == ".nc":
            content = path.read_bytes()
            start = content.index(b"Z rotordyn ") - len("2000-01-01T00:00:00")
            found[place] = content[:start] + content[start + 19 :]
        else:
            found[place] = path.read_bytes()
    return found


def test_foreign_folder_is_refused(results: rotordyn.Results, tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("mine")
    for one in (results, rotordyn.open(results.save(tmp_path / "own", figures=False))):
        with pytest.raises(OutputRefused):
            one.save(tmp_path)
    assert (tmp_path / "thesis.tex").read_text() == "mine"


def test_opened_is_what_was_saved(results: rotordyn.Results, opened: rotordyn.Results) -> None:
    assert list(opened) == list(results)
    for name in results:
        xr.testing.assert_identical(opened[name], results[name])
        assert opened[name].encoding == {}
    assert opened.summary == results.summary
    assert opened.warnings == results.warnings
    assert opened.notes == results.notes
    assert opened.unsolved == results.unsolved
    assert repr(opened) == repr(results)


def test_opened_knows_its_case(results: rotordyn.Results, opened: rotordyn.Results) -> None:
    """Every value of it; files by folder and name alone."""
    assert replace(opened.case, files=()) == replace(results.case, files=())
    assert opened.case.digest == results.case.digest


def test_every_kind_of_value_is_kept() -> None:
    kept = (1.0, math.inf, -math.inf, 1.5 - 2.0j, "x", None, True, 3, {("y", "z"): 0.1}, (1, (2,)))
    assert restored(json.loads(json.dumps(archived(kept), allow_nan=False))) == kept
    with pytest.raises(TypeError, match="no description holds set"):
        archived({1, 2})


def test_opened_results_are_rebuilt_bit_for_bit(
    results: rotordyn.Results, opened: rotordyn.Results
) -> None:
    for name, result in results.parts[""].results.items():
        back = opened.parts[""].results[name]
        assert type(back) is type(result)
        for field in declared(result):
            one, other = getattr(result, field), getattr(back, field)
            assert type(one) is type(other), field
            np.testing.assert_array_equal(np.asarray(one), np.asarray(other), err_msg=field)


def test_same_figures_from_memory_from_a_folder_and_in_the_files(
    results: rotordyn.Results, opened: rotordyn.Results, folder: Path, tmp_path: Path
) -> None:
    files = {path.stem for path in folder.glob("*.png")}
    assert set(results.figures) == set(opened.figures) == files
    for source in (results, opened):
        source.plot("campbell").savefig(tmp_path / "one.png")
        assert (tmp_path / "one.png").read_bytes().startswith(b"\x89PNG")
    drawn = [source.plot("frf_amplitude_phase")._repr_png_() for source in (results, opened)]
    assert drawn[0] == drawn[1]


def test_figures_leave_the_users_matplotlib_alone(results: rotordyn.Results) -> None:
    """Whatever the user has set, the figure is the same, and nothing of it changes."""
    import matplotlib

    plain = results.plot("campbell")
    assert isinstance(plain, matplotlib.figure.Figure)
    own = {"axes.facecolor": "black", "font.size": 30.0, "text.parse_math": True}
    with matplotlib.rc_context(own):
        before, backend = dict(matplotlib.rcParams), matplotlib.get_backend()
        dark = results.plot("campbell")
        assert dict(matplotlib.rcParams) == before
        assert matplotlib.get_backend() == backend
    assert dark._repr_png_() == plain._repr_png_()


def test_plot_names_what_there_is(results: rotordyn.Results) -> None:
    with pytest.raises(InvalidInput, match=r"no figure bode: there are .*campbell, "):
        results.plot("bode")
    with pytest.raises(InvalidInput, match=r"plot takes the name of a figure: there are "):
        results.plot()


def test_shapes_in_space_are_figures_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apart, "PROGRAM", ("-c", "raise SystemExit(1)"))
    spec = CampbellSpec(62.0, shapes_3d=ShapesInSpaceSpec())
    rotor = replace(rotordyn.load("lalanne_ferraris"), speeds=(0.0,), analyses={"campbell": spec})
    results = rotordyn.run(rotor)
    assert "shapes_3d_0rpm" in results.figures
    with pytest.raises(InvalidInput, match=r"shapes_3d_0rpm cannot be drawn: .* render in 3D"):
        results.plot("shapes_3d_0rpm")


@pytest.mark.long
def test_variants_are_opened_compared(tmp_path: Path) -> None:
    results = rotordyn.run(rotordyn.load("friswell_internal_damping"))
    opened = rotordyn.open(results.save(tmp_path / "out", figures=False))
    assert list(opened) == list(results)
    assert opened.figures == results.figures
    assert opened.plot("campbell")._repr_png_() == results.plot("campbell")._repr_png_()
    assert opened.warnings == results.warnings != ()


def test_an_opened_folder_stays_open_in_another_directory(
    folder: Path, results: rotordyn.Results, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder.parent)
    opened = rotordyn.open(folder.name)
    monkeypatch.chdir(tmp_path)
    xr.testing.assert_identical(opened["preload"], results["preload"])


def test_the_case_of_an_opened_folder_is_that_of_the_run(opened: rotordyn.Results) -> None:
    assert opened.case == small()
    assert opened.case != small().vary({"conditions.axial_force": 1.0})


@pytest.mark.parametrize("given", [None, b"x", 3])
def test_a_folder_to_save_in_is_named(
    given: Any, results: rotordyn.Results, opened: rotordyn.Results
) -> None:
    for each in (results, opened):
        with pytest.raises(InvalidInput, match="save: folder must be text or a Path, got"):
            each.save(given)


def test_copy_of_an_opened_folder(folder: Path, tmp_path: Path) -> None:
    copied = rotordyn.open(folder).save(tmp_path / "copy")
    assert _files(copied) == _files(folder)
    assert rotordyn.open(copied).save(copied) == copied


def _files(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*.*")}


def test_what_is_no_results_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(
        InvalidInput, match=r"is no results folder: it holds no run\.json of rotordyn"
    ):
        rotordyn.open(tmp_path)


def test_a_folder_that_changes_is_noticed(folder: Path, tmp_path: Path) -> None:
    copied = rotordyn.open(folder).save(tmp_path / "copy")
    record = json.loads((copied / "run.json").read_text(encoding="utf-8"))
    stored = rotordyn.open(copied)
    (copied / "results.nc").write_bytes(b"")
    with pytest.raises(InvalidInput, match="has been replaced since it was opened: open it again"):
        stored["frf"]
    (copied / "results.nc").unlink()
    with pytest.raises(
        InvalidInput, match=r"incomplete although it has its run\.json .*: run the case"
    ):
        rotordyn.open(copied)
    record["rotordyn_results"] = FORMAT + 1
    (copied / "run.json").write_text(json.dumps(record), encoding="utf-8")
    with pytest.raises(InvalidInput, match=r"in a form that rotordyn \S+ does not read"):
        rotordyn.open(copied)


def test_a_case_of_another_version_still_gives_its_numbers(folder: Path, tmp_path: Path) -> None:
    copied = rotordyn.open(folder).save(tmp_path / "copy")
    for old, new in (('"Spindle"', '"Spindel"'), ('"speeds"', '"rates"')):
        text = (folder / "case.json").read_text(encoding="utf-8")
        (copied / "case.json").write_text(text.replace(old, new), encoding="utf-8")
        stored = rotordyn.open(copied)
        assert stored["campbell"].sizes["speed"] == 3
        assert "script" in stored._repr_html_()
        with pytest.raises(InvalidInput, match=r"the case in .* cannot be read .*rotordyn\.load"):
            stored.plot("campbell")


def test_notebooks_see_escaped_tables(results: rotordyn.Results, opened: rotordyn.Results) -> None:
    spindle = replace(results.case.spindle, title="<script>")
    in_a_cell = replace(results.case, title="", spindle=spindle)
    for shown in (results, opened, results.case, spindle, in_a_cell):
        html = shown._repr_html_()
        assert html.startswith("<table>")
        assert "<script" not in html
        assert "&lt;script&gt;" in html


def test_one_line_says_what_it_is(results: rotordyn.Results) -> None:
    line = repr(results)
    assert line.startswith("<Results of mfw2310 (Fischer")
    assert "preload, campbell, frf" in line
    assert "\n" not in line
