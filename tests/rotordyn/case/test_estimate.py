"""Bearings in files by what a catalogue prints: read, named an estimate, faults."""

from __future__ import annotations

from pathlib import Path

import pytest

import rotordyn
from bearings import EstimatedBearing, estimate
from rotordyn.analyses import PreloadSpec
from rotordyn.case.schema import json_schema
from rotordyn.errors import InvalidInput

CATALOGUE = Path(__file__).parents[3] / "cases" / "grinding_spindle_catalogue.yaml"
# GMN, catalogue 4000 0813 EN, KH 6014 E
BEARING = """\
name: KH 6014 E
bore_diameter: 70 mm
outside_diameter: 110 mm
contact_angle: 25 deg
ball_material: bearing_steel
estimate: {preloads: [190 N, 570 N], rigidities: [143 N/um, 211 N/um], static_rating: 16.4 kN}
"""
CASE = """\
bearing: ./bearing.yaml
speeds: [0 rpm]
analyses: {bearing: {loads: [200 N]}}
"""


def written(folder: Path, text: str = BEARING) -> Path:
    path = folder / "bearing.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_file_is_what_the_function_gives(tmp_path: Path) -> None:
    found = rotordyn.model("bearings", written(tmp_path))
    assert isinstance(found, EstimatedBearing)
    assert found == estimate(
        bore=0.07,
        outside_diameter=0.11,
        contact_angle=found.contact_angle,
        hybrid=False,
        preloads=[190.0, 570.0],
        rigidities=[143e6, 211e6],
        static_rating=16400.0,
    )


def test_given_data_stays(tmp_path: Path) -> None:
    more = "balls: 24\nball_diameter: 9.525 mm\ninner_shoulder_diameter: 82.6 mm\n"
    found = rotordyn.model("bearings", written(tmp_path, BEARING + more))
    assert (found.balls, found.ball_diameter) == (24, 9.525e-3)
    assert found.inner_shoulder_diameter == pytest.approx(0.0826)


def test_single_bearing_is_named_an_estimate(tmp_path: Path) -> None:
    written(tmp_path)
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    results = rotordyn.run(rotordyn.load(tmp_path / "case.yaml"))
    assert any("estimate from catalogue values" in each for each in results.warnings)
    results.save(tmp_path / "out")
    again = rotordyn.open(tmp_path / "out")
    assert isinstance(again.case.bearing, EstimatedBearing)
    assert again.case.bearing.explained == results.case.bearing.explained


def test_rating_of_a_pair_is_a_warning(tmp_path: Path) -> None:
    written(tmp_path, BEARING.replace("16.4 kN", "16.4 kN, dynamic_rating: 36.5 kN"))
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    results = rotordyn.run(rotordyn.load(tmp_path / "case.yaml"))
    assert any("give that of one bearing" in each for each in results.warnings)


def test_spindle_names_its_estimates() -> None:
    case = rotordyn.load("grinding_spindle_catalogue").vary(
        {"analyses": {"preload": PreloadSpec()}, "speeds": ["0 rpm"]}
    )
    one = rotordyn.run(case.variants["estimated"])
    assert "a (estimate) +" in one.summary
    assert sum("estimate from catalogue values" in each for each in one.warnings) == 1
    assert "KH 6014 E (estimate)" in one.case.spindle._repr_html_()


def test_library_lists_estimates() -> None:
    titles = {each.name: each.title for each in rotordyn.models("bearings")}
    for name, title in titles.items():
        found = rotordyn.model("bearings", name)
        assert title.endswith("(estimate)") == bool(found.estimated), name


FAULTS = [
    (
        ("190 N, 570 N", "190 N"),
        "estimate: no estimate: rigidities must have one value for each of prel",
    ),
    (("16.4 kN", "140 kN"), "catalogue values contradict one another.*static rating C0"),
    (("[143 N/um, 211 N/um]", "[71 N/um, 105 N/um]"), "that of one bearing: give that of the pair"),
    (("outside_diameter: 110 mm\n", ""), "outside_diameter: missing key: an estimate needs it"),
    (("preloads", "preload"), "unknown key: given 'preload'"),
    (("estimate:", "kind: deep_groove\nestimate:"), "kind: no estimate of this kind"),
    (("25 deg", "25 mm"), "contact_angle"),
    (("143 N/um, 211", "143 N, 211"), "rigidities"),
]


def test_what_is_missing_in_a_model_of_several_seats_is_reported_once(tmp_path: Path) -> None:
    shipped = CATALOGUE.read_text(encoding="utf-8")
    lines = [line for line in shipped.splitlines() if "bore_diameter" not in line]
    assert len(lines) == len(shipped.splitlines()) - 1
    path = tmp_path / "case.yaml"
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(InvalidInput, match="bore_diameter: missing key: an estimate") as refused:
        rotordyn.load(path)
    assert str(refused.value).count("an estimate needs it") == 1


@pytest.mark.parametrize(("change", "sentence"), FAULTS)
def test_faults_have_their_place(tmp_path: Path, change: tuple[str, str], sentence: str) -> None:
    text = BEARING.replace(*change)
    assert text != BEARING
    with pytest.raises(InvalidInput, match=sentence):
        rotordyn.model("bearings", written(tmp_path, text))


def test_an_unknown_material_is_the_only_fault(tmp_path: Path) -> None:
    text = BEARING.replace("ball_material: bearing_steel", "ball_material: no_steel")
    with pytest.raises(InvalidInput, match="unknown model: given 'no_steel'") as refusal:
        rotordyn.model("bearings", written(tmp_path, text))
    assert "nan" not in str(refusal.value)


def test_schema_asks_for_an_estimate_or_for_balls() -> None:
    schema = json_schema("bearing")["$defs"]["AngularContactBallBearing"]
    first, second = (each["required"] for each in schema["anyOf"])
    assert "balls" in first
    assert "estimate" in second
    assert "balls" not in second
    assert "rigidities" in json_schema("bearing")["$defs"]["Printed"]["properties"]


@pytest.mark.parametrize(
    ("old", "new"), [("contact_angle: 25", "contact_angle: 89"), ("[190 N,", "[-190 N,")]
)
def test_a_faulty_value_is_reported_once(tmp_path: Path, old: str, new: str) -> None:
    with pytest.raises(InvalidInput) as caught:
        rotordyn.model("bearings", written(tmp_path, BEARING.replace(old, new)))
    assert len(caught.value.faults) == 1
    assert "out of range" in str(caught.value)
