"""The shipped cases as they are read: values in SI, machine whole, nothing heavy imported."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pytest

import rotordyn
from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.growth import (
    ComputedShortening,
    InterferenceFit,
    PrescribedShortening,
    QuadraticInSpeed,
)

ROOT = Path(__file__).parents[3]
RPM = math.pi / 30.0
HEAVY = ("scipy", "numba", "matplotlib", "pyvista", "xarray", "pandas", "h5netcdf", "rich")


@pytest.fixture(scope="module")
def mfw() -> rotordyn.Case:
    return rotordyn.load(ROOT / "cases/mfw2310.yaml")


@pytest.mark.parametrize("path", sorted((ROOT / "cases").glob("*.yaml")), ids=lambda p: p.stem)
def test_every_shipped_case_is_read(path: Path) -> None:
    case = rotordyn.load(path)
    assert case.name == path.stem
    assert case.title
    assert (case.spindle is None) != (case.bearing is None)
    assert case.analyses
    assert case.files[0] == path


def test_speeds_meet_both_ends(mfw: rotordyn.Case) -> None:
    assert len(mfw.speeds) == 49
    assert mfw.speeds[0] == 0.0
    assert mfw.speeds[-1] == 24000 * RPM
    assert mfw.speeds[1] == pytest.approx(500 * RPM, rel=1e-14)


def test_questions(mfw: rotordyn.Case) -> None:
    assert list(mfw.analyses) == ["preload", "campbell", "frf", "stiffness"]
    assert mfw.analyses["preload"] == PreloadSpec()
    assert mfw.analyses["campbell"] == CampbellSpec(4000.0, (3,))
    frf, stiffness = mfw.analyses["frf"], mfw.analyses["stiffness"]
    assert isinstance(frf, FrfSpec)
    assert (len(frf.frequencies), frf.frequencies[0], frf.frequencies[-1]) == (2000, 2.0, 4000.0)
    assert tuple(map(str, frf.pairs[0])) == ("Oc2.y", "Oc2.y")
    assert isinstance(stiffness, StiffnessSpec)
    assert stiffness.second_stop == {"front": 45e-6}
    assert (mfw.conditions.kinematics, mfw.conditions.moment_sharing) == ("outer", "equal")


def test_machine(mfw: rotordyn.Case) -> None:
    spindle = mfw.spindle
    assert spindle is not None
    assert spindle.name == "mfw2310"
    assert spindle.shaft.start == pytest.approx(-0.0918, abs=1e-15)
    assert spindle.shaft.end == pytest.approx(0.4364, abs=1e-12)
    assert [s.name for s in spindle.shaft.sections[:4]] == [
        "amb_target",
        "tool_shank",
        "hsk_flange",
        "nose",
    ]
    assert spindle.points["Oc2"] == -0.0524
    assert spindle.points["nose_face"] == 0.0
    assert spindle.rotor_damping == (0.01, 0.02, 0.05)
    assert sum(mass.mass for mass in spindle.masses) == pytest.approx(1.44 + 0.6 + 2.19)
    motor = spindle.shaft.section_at(0.2)
    assert (motor.name, motor.material.density) == ("motor", 8130.0)


def test_bearings_and_sleeves(mfw: rotordyn.Case) -> None:
    spindle = mfw.spindle
    assert spindle is not None
    assert [seat.name for seat in spindle.seats] == list("abcde")
    assert [seat.thrust for seat in spindle.seats] == [1, 1, -1, -1, -1]
    assert [seat.model for seat in spindle.seats] == ["VEX 70"] * 3 + ["VEX 60"] * 2
    assert {seat.bearing.outer_conformity for seat in spindle.seats} == {0.571}
    assert {seat.radial_damping for seat in spindle.seats} == {2000.0}
    assert spindle.seats[0].growth.static == pytest.approx(43.2e-6)
    assert spindle.seats[0].growth.centrifugal == QuadraticInSpeed(7.3e-6, 24000 * RPM)
    front, rear = spindle.sleeves
    assert (front.bearings, rear.bearings) == (("c",), ("d", "e"))
    assert (front.spring.preload, front.spring.stiffness) == (574.0, 6.2e6)
    assert front.stop_travel == 52.2e-6
    assert rear.stop_travel == math.inf
    assert isinstance(spindle.shortening, PrescribedShortening)
    assert spindle.shortening.shift == {"c": -0.305e-6, "d": -42.8e-6, "e": -42.8e-6}


def test_references_travel_with_the_case(mfw: rotordyn.Case) -> None:
    found = {(r.quantity, r.subject, r.kind): r for r in mfw.references}
    stiffness = found["radial_stiffness", "nonlinear", "published"]
    assert stiffness.values == pytest.approx((142e6, 138e6, 110e6, 84e6, 73.5e6))
    assert stiffness.speeds == pytest.approx([n * RPM for n in (0, 6000, 12000, 18000, 24000)])
    assert found["bending_frequency", "", "published"].speeds == (0.0,) * 4
    assert all(reference.remark and reference.source for reference in mfw.references)


def test_computed_growth_and_shortening() -> None:
    spindle = rotordyn.load(ROOT / "cases/mfw2310_computed.yaml").spindle
    assert spindle is not None
    assert spindle.shortening == ComputedShortening(0.0386)
    fits = [seat.growth.fitted for seat in spindle.seats]
    assert fits == [InterferenceFit(0.07, 2e-5)] * 3 + [InterferenceFit(0.06, 2e-5)] * 2


def test_single_bearing() -> None:
    case = rotordyn.load(ROOT / "cases/vex70.yaml")
    assert case.bearing is not None
    assert case.bearing.outer_conformity == 0.54
    assert case.analyses == {"bearing": BearingMapSpec((250.0, 500.0, 1000.0, 1220.0, 2000.0))}


def test_linear_supports() -> None:
    spindle = rotordyn.load(ROOT / "cases/lalanne_ferraris.yaml").spindle
    assert spindle is not None
    for support in spindle.supports:
        assert support.stiffness == {("y", "y"): 70e6, ("z", "z"): 50e6}
        assert support.damping == {("y", "y"): 700.0, ("z", "z"): 500.0}
    assert [support.x for support in spindle.supports] == [0.0, 1.3]


NAMED = "{yy: 70 N/um, yz: 9 MN/m, zy: -8 kN/mm, zz: 50e6 N/m, thz_thz: 3 kN m/rad, y_thz: 7 N}"
WHOLE = """
    dof: [z, thz, y]
    matrix:
      - [50 N/um, 0, -8 kN/mm]
      - [0, 3 kN m/rad, 0]
      - [9 N/um, 7 N/rad, 70 N/um]
"""


@pytest.mark.parametrize("written", [NAMED, WHOLE], ids=["by entries", "whole"])
def test_matrix_by_entries_and_whole(tmp_path: Path, written: str) -> None:
    """The same support both ways: rows are loads, nothing is made symmetric."""
    path = tmp_path / "case.yaml"
    path.write_text(
        f"spindle: lalanne_ferraris\noverride:\n  supports.left.stiffness: {written}\n"
        "speeds: [0 rpm]\nanalyses: {campbell: {}}\n"
    )
    spindle = rotordyn.load(path).spindle
    assert spindle is not None
    found = {pair: value for pair, value in spindle.supports[0].stiffness.items() if value}
    assert found == {
        ("y", "y"): 70e6, ("z", "z"): 50e6, ("y", "z"): 9e6, ("z", "y"): -8e6,
        ("thz", "thz"): 3e3, ("y", "thz"): 7.0,
    }  # fmt: skip


def test_entry_of_a_whole_matrix_is_overridden_as_a_whole(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: friswell_two_discs\noverride:\n"
        "  supports.left.damping.dof: [x, thx]\n"
        "  supports.left.damping.matrix: [[1 N s/m, 2 N s/rad], [3 N s, 4 N m s/rad]]\n"
        "speeds: [0 rpm]\nanalyses: {campbell: {}}\n"
    )
    spindle = rotordyn.load(path).spindle
    assert spindle is not None
    assert spindle.supports[0].damping == {
        ("x", "x"): 1.0, ("x", "thx"): 2.0, ("thx", "x"): 3.0, ("thx", "thx"): 4.0,
    }  # fmt: skip


def test_digest_follows_every_file(tmp_path: Path) -> None:
    text = (ROOT / "cases/vex70.yaml").read_text()
    model = (ROOT / "models/bearings/vex70.yaml").read_text()
    (tmp_path / "case.yaml").write_text(text.replace("bearing: vex70", "bearing: ./model.yaml"))
    (tmp_path / "model.yaml").write_text(model)
    first = rotordyn.load(tmp_path / "case.yaml")
    assert first.digest == rotordyn.load(tmp_path / "case.yaml").digest
    assert tmp_path / "model.yaml" in first.files
    (tmp_path / "model.yaml").write_text(model.replace("balls: 25", "balls: 24"))
    assert rotordyn.load(tmp_path / "case.yaml").digest != first.digest


def test_nothing_heavy_is_imported() -> None:
    code = (
        "import sys, rotordyn; rotordyn.load(sys.argv[1]);"
        f"print(sorted(set({HEAVY!r}) & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(ROOT / "cases/mfw2310.yaml")],
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
    )
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("guides", "expected"),
    [("", ()), (", guides: [150 mm, 300 mm]", (0.15, 0.3)), (", guides: everywhere", "everywhere")],
)
def test_drawbar_and_formulation(tmp_path: Path, guides: str, expected: object) -> None:
    path = tmp_path / "bar.yaml"
    path.write_text(
        "spindle: mfw2310\n"
        f"override: {{drawbar: {{force: 25 kN, from: 10 mm, to: 420 mm{guides}}}}}\n"
        "conditions: {formulation: fixed-frame softening, axial_stiffening: false}\n"
        "speeds: [0 rpm]\nanalyses: {campbell: {}}\n"
    )
    case = rotordyn.load(path)
    assert case.spindle is not None
    bar = case.spindle.drawbar
    assert bar is not None
    assert (bar.force, bar.start, bar.end) == pytest.approx((25e3, 0.01, 0.42))
    assert bar.guides == expected
    assert case.conditions.formulation == "fixed-frame softening"
    assert not case.conditions.axial_stiffening


def test_a_file_beside_the_case_named_without_its_ending_is_suggested(tmp_path: Path) -> None:
    (tmp_path / "mill.yaml").write_text("title: mine\n", encoding="utf-8")
    path = tmp_path / "case.yaml"
    path.write_text("spindle: mill\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n", encoding="utf-8")
    with pytest.raises(InvalidInput, match=r"given 'mill'; .* \(did you mean mill\.yaml\?\)"):
        rotordyn.load(path)
