"""Models by name and by path, in a checkout and installed."""

from __future__ import annotations

from pathlib import Path

import pytest

import rotordyn
from rotordyn.case import library
from rotordyn.errors import InvalidInput

ROOT = Path(__file__).parents[3]


def test_checkout_comes_first() -> None:
    assert library.models_root() == ROOT / "models"


def test_packaged_copy_serves_where_there_is_no_checkout(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    packaged = tmp_path / "site/rotordyn/_data/models/bearings"
    packaged.mkdir(parents=True)
    (packaged / "own.yaml").write_text("name: own\n")
    monkeypatch.setattr(library, "_PACKAGE", tmp_path / "site/rotordyn")
    assert library.find("bearings", "own", tmp_path / "case.yaml") == packaged / "own.yaml"


def test_path_is_relative_to_the_file_that_names_it(tmp_path: Path) -> None:
    case = tmp_path / "cases/case.yaml"
    assert library.find("bearings", "../b.yaml", case) == tmp_path / "cases/../b.yaml"
    assert library.find("bearings", "b.yaml", case) == tmp_path / "cases/b.yaml"
    assert library.find("bearings", "/abs/b", case) == Path("/abs/b")


def test_unknown_name_lists_the_known() -> None:
    with pytest.raises(InvalidInput, match=r"allowed: 6012, .*did you mean vex7"):
        library.find("bearings", "VEX7O", Path("case.yaml"))


@pytest.mark.parametrize("kind", library.KINDS)
def test_every_kind_has_models_that_cite_their_source(kind: str) -> None:
    names = library.known(kind)
    assert names
    for name in names:
        assert "source" in (ROOT / "models" / kind / f"{name}.yaml").read_text()


@pytest.mark.parametrize("name", library.known("bearings"))
def test_every_bearing_model_is_read(name: str, tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        f"bearing: {name}\nspeeds: [0 rpm]\nanalyses: {{bearing: {{loads: [100 N]}}}}\n"
    )
    assert rotordyn.load(path).bearing is not None


def test_model_within_a_model_is_found_beside_it(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    model = (ROOT / "models/bearings/vex70.yaml").read_text()
    (tmp_path / "parts/b.yaml").write_text(model.replace("bearing_steel", "./steel.yaml"))
    steel = (ROOT / "models/materials/bearing_steel.yaml").read_text()
    (tmp_path / "parts/steel.yaml").write_text(steel.replace("bearing steel", "mine"))
    path = tmp_path / "case.yaml"
    path.write_text(
        "bearing: parts/b.yaml\nspeeds: [0 rpm]\nanalyses: {bearing: {loads: [100 N]}}\n"
    )
    bearing = rotordyn.load(path).bearing
    assert bearing is not None
    assert bearing.ring_material.name == "mine"
