"""Variants answered side by side: the same as each alone, in one folder."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.job import Delivery, deliver, one_variant, restricted, solve, solve_variants
from rotordyn.machine.growth import PrescribedShortening
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.report.netcdf import read_results
from rotordyn.report.side_by_side import comparison_summary
from rotordyn.report.summary import summary
from tests.oracles.spindles import RPM, case, mfw2310, pairs

pytestmark = pytest.mark.usefixtures("draft")

TURNING = {"speeds": (2000 * RPM, 24000 * RPM), "analyses.frf.slices": ()}


def compared(**variants: Case) -> Case:
    """The flagship at two speeds, as it is and with a rigid rotor."""
    base = replace(
        case(),
        speeds=(0.0, 24000 * RPM),
        analyses={
            "preload": PreloadSpec(),
            "campbell": CampbellSpec(3000.0),
            "frf": FrfSpec(tuple(np.linspace(10, 3000, 40)), pairs("Oc2.y/Oc2.y"), (0.0,)),
            "stiffness": StiffnessSpec("Oc2", 500.0, 2, ("full", "diagonal")),
        },
    )
    rigid = replace(base, title="rigid rotor", conditions=replace(base.conditions, rotor="rigid"))
    own = {"flexible": replace(base, title="flexible rotor"), "rigid": rigid}
    return replace(base, variants=own | variants)


def without_preload() -> Case:
    """The rear pair is unloaded at every speed but rest; speeds start above it."""
    far = PrescribedShortening(1000 * RPM, {"d": 300e-6, "e": 300e-6})
    whole = compared()
    return replace(whole.variants["flexible"], title="lost", spindle=mfw2310(shortening=far))


def test_run_names_variant_and_analysis_and_answers_as_each_alone() -> None:
    whole = compared()
    found = rotordyn.run(whole)
    assert set(found) == {f"{v}/{a}" for v in whole.variants for a in whole.analyses}
    for name, variant in whole.variants.items():
        alone = rotordyn.run(variant)
        for analysis, data in alone.items():
            assert data.identical(found[f"{name}/{analysis}"])


def test_folder_holds_tables_of_each_and_figures_of_all(tmp_path: Path) -> None:
    whole = compared()
    delivery = deliver(whole, tmp_path / "out")
    assert delivery.unsolved == ()
    read = read_results(tmp_path / "out" / "results.nc")
    assert set(read) == {f"{v}/{a}" for v in whole.variants for a in whole.analyses}
    first = solve(whole.variants["rigid"]).results["campbell"].frequency
    assert np.array_equal(read["rigid/campbell"]["frequency"].values, first)
    for name in whole.variants:
        assert {p.name for p in (tmp_path / "out" / name).iterdir()} >= {
            "campbell.csv",
            "preload.csv",
            "stiffness.csv",
            "frf.uff",
        }
    drawn = {p.stem for p in (tmp_path / "out").glob("*.png")}
    assert drawn == {
        "campbell",
        "campbell_overlay",
        "frf_curves",
        "frf_maps",
        "frf_surfaces",
        "preload",
        "stiffness",
    }
    record = json.loads((tmp_path / "out" / "run.json").read_text(encoding="utf-8"))
    assert record["settings"]["rigid"]["rotor"] == "rigid"
    assert record["outcomes"]["rigid/campbell"] == {"": [0.0, 24000.0]}


def test_summary_has_a_line_per_variant_and_what_is_known_of_each(tmp_path: Path) -> None:
    text = deliver(compared(), tmp_path / "out", figures=False).summary
    modes = text.split("bending modes")[1].splitlines()
    assert modes[2].startswith("flexible rotor  903.4 → ")
    assert modes[3].startswith("rigid rotor     1082.0 → ")
    known = text.split("published  bending frequency at 0 rpm [Hz]: ")[1:]
    assert [part.splitlines()[:2] for part in known] == [
        ["903, 1350, 1580, 2860", "    flexible rotor: 903.4, 1349, 1586, 2857"],
        ["1096, 1512", "    rigid rotor: 1082, 1522"],
    ]


def test_a_variant_without_solution_is_named_and_the_others_are_answered(tmp_path: Path) -> None:
    whole = compared(lost=without_preload()).vary(TURNING)
    delivery = deliver(whole, tmp_path / "out", figures=False)
    assert delivery.unsolved[0].startswith("variant lost: no speed of the case")
    assert "WARNING: variant lost" in delivery.summary
    assert not (tmp_path / "out" / "lost").exists()
    results = rotordyn.run(whole)
    assert not any(name.startswith("lost/") for name in results)
    assert results.unsolved == delivery.unsolved
    assert results.warnings[0] == delivery.unsolved[0]


def test_nothing_is_written_where_no_variant_has_a_solution(tmp_path: Path) -> None:
    lost = without_preload()
    whole = replace(compared(), variants={"a": lost, "b": lost}).vary(TURNING)
    with pytest.raises(NoSolution, match=r"variant a: .*; variant b: "):
        deliver(whole, tmp_path / "out")
    assert not any(tmp_path.iterdir())


def test_the_summary_has_the_rotor_of_every_variant_once_where_they_are_alike() -> None:
    whole = compared()
    own = dict(whole.variants)
    line = summary(own["rigid"], {}).splitlines()[1]
    assert line.startswith("rotor      ")
    alike = comparison_summary(whole, [(each, {}) for each in own.values()]).splitlines()
    assert alike[1:] == [line]
    long = own["rigid"].vary({"spindle.shaft.sections.tail.length": "90 mm"})
    long = replace(long, title="long")
    rows = comparison_summary(whole, [(own["rigid"], {}), (long, {})]).splitlines()
    assert rows[2] == "rotor"
    for each, row in zip((own["rigid"], long), rows[4:6], strict=True):
        m = rotor_inertia(each.spindle)
        told = [float(cell) for cell in row.removeprefix(each.title).split()]
        wanted = [m.mass, m.centre * 1e3, m.polar, m.diametral]
        assert told == pytest.approx(wanted, rel=1e-3)


def test_of_many_rotors_some_are_shown_by_the_name_of_their_variant() -> None:
    """Also where those shown are alike, and the one that differs is not among them."""
    whole = compared()
    rigid = dict(whole.variants)["rigid"]
    many = [replace(rigid, title=f"v{k:02d}") for k in range(30)]
    many[3] = many[3].vary({"spindle.shaft.sections.tail.length": "90 mm"})
    rows = comparison_summary(whole, [(each, {}) for each in many]).splitlines()
    assert [row.split()[0] for row in rows[4:12:7]] == ["v00", "v29"]
    assert rows[12] == "8 of 30 rotors"


def test_whirls_are_paired_where_the_first_speed_has_no_solution() -> None:
    """With a front spring that has no preload its bearing is idle at rest and loaded by its growth
    at speed."""
    whole = compared()
    flexible = whole.variants["flexible"]
    idle = flexible.vary({"spindle.sleeves.front.spring.preload": 0.0})
    whole = replace(whole, variants={"a": idle})
    result = solve_variants(whole).machines["a"].results["campbell"]
    assert np.isnan(result.frequency[0]).all()
    rows = comparison_summary(whole, [(whole.variants["a"], {"campbell": result})]).splitlines()
    top = dict(zip(result.mode, result.frequency[-1], strict=True))
    pair = sorted(v for name, v in top.items() if name.startswith("bending"))[:2]
    assert any(f"none → {pair[0]:.1f}/{pair[1]:.1f}" in row for row in rows)


def test_whirls_of_twins_are_paired_as_they_turn_at_speed() -> None:
    """On a housing both planes are solved together: at rest pairs whirl either way or not."""
    whole = rotordyn.load("spindle_on_housing")
    asked = {"campbell": CampbellSpec(1000.0, shapes=False)}
    on_body = replace(whole.variants["body"], speeds=(0.0, 24000 * RPM), analyses=asked)
    result = rotordyn.run(on_body)["campbell"]
    alone = replace(whole, variants={"body": on_body}, speeds=on_body.speeds, analyses=asked)
    solved = solve_variants(alone).machines["body"].results["campbell"]
    rows = comparison_summary(alone, [(on_body, {"campbell": solved})]).splitlines()
    pairs_at = [np.sort(f[np.isfinite(f)])[:4] for f in result.frequency.values]
    first, second, third, fourth = pairs_at[1]
    shown = f"{pairs_at[0][0]:.1f} → {first:.1f}/{second:.1f}"
    assert any(shown in row for row in rows)
    assert any(f"{pairs_at[0][2]:.1f} → {third:.1f}/{fourth:.1f}" in row for row in rows)


def test_frac_of_measured_responses_is_reported_of_every_variant() -> None:
    whole = rotordyn.load("tool_holder_joint")
    frf = whole.analyses["frf"]
    assert isinstance(frf, FrfSpec)
    asked = {"frf": replace(frf, slices=(0.0,))}
    own = {
        name: replace(each, speeds=(0.0,), analyses=asked) for name, each in whole.variants.items()
    }
    alone = replace(whole, variants=own, speeds=(0.0,), analyses=asked)
    found = solve_variants(alone).machines
    rows = comparison_summary(alone, [(own[v], found[v].results) for v in own]).splitlines()
    head = next(k for k, row in enumerate(rows) if "made-up tap test at 0 rpm" in row)
    told = [float(row.split()[-1]) for row in rows[head + 1 : head + 3]]
    frac = [float(found[name].results["frf"].frac[0]) for name in own]
    assert told == pytest.approx(frac, abs=6e-4)
    assert frac[1] > 0.8 > 0.5 > frac[0]


def test_variants_of_one_title_are_all_shown(tmp_path: Path) -> None:
    whole = compared()
    flexible = whole.variants["flexible"]
    same = replace(
        whole,
        variants={
            "a": replace(flexible, title="same"),
            "b": replace(whole.variants["rigid"], title="same"),
            "c": replace(flexible, title=" "),
        },
    )
    modes = (
        deliver(same, tmp_path / "out", figures=False)
        .summary.split("bending modes")[1]
        .splitlines()
    )
    assert [line.split("  ")[0] for line in modes[2:5]] == ["same (a)", "same (b)", "c"]


def test_one_variant_is_a_case_of_its_own() -> None:
    whole = compared()
    alone = one_variant(whole, "rigid")
    assert alone.name == f"{whole.name}_rigid"
    assert not alone.variants
    with pytest.raises(InvalidInput, match="variants of this case are flexible, rigid"):
        one_variant(whole, "stiff")
    with pytest.raises(InvalidInput, match="compares nothing"):
        one_variant(alone, "rigid")


def test_restriction_holds_for_every_variant() -> None:
    kept = restricted(compared(), ("campbell",))
    assert [list(v.analyses) for v in kept.variants.values()] == [["campbell"]] * 2


@pytest.fixture(scope="module")
def many(tmp_path_factory: pytest.TempPathFactory) -> Delivery:
    """Fifteen variants, more than are drawn side by side or printed on a screen."""
    whole = restricted(compared(), ("campbell", "frf"))
    one = whole.variants["rigid"]
    variants = {f"v{k}": replace(one, title=f"variant {k}") for k in range(15)}
    return deliver(replace(whole, variants=variants), tmp_path_factory.mktemp("many") / "out")


@pytest.mark.long
def test_many_variants_are_laid_over_one_another_only(many: Delivery) -> None:
    assert {p.stem for p in many.folder.glob("*.png")} == {"campbell_overlay", "frf_curves"}


@pytest.mark.long
def test_of_many_variants_a_screen_shows_a_few_and_names_the_table(many: Delivery) -> None:
    lines = many.summary.splitlines()
    assert len(lines) < 60
    rows = [line.split("  ")[0] for line in lines if line.startswith("variant ")]
    assert (len(rows), rows[0], rows[-1]) == (8, "variant 0", "variant 14")
    assert "8 of 15 variants; all are in variants.csv" in lines
    table = (many.folder / "variants.csv").read_text(encoding="utf-8-sig")
    assert all(f"variant {k}" in table for k in range(15))


def test_race_control_of_variants_is_side_by_side(tmp_path: Path) -> None:
    """The boundaries of two hypotheses in one table and one figure, a map each in its folder."""
    path = tmp_path / "two.yaml"
    path.write_text(
        "bearing: vex70\n"
        "speeds: [6000 rpm, 12000 rpm]\n"
        "analyses: {control: {max_load: 2000 N}}\n"
        "compare:\n"
        "  a: {title: one, conditions: {kinematics: outer}}\n"
        "  b: {title: other, conditions: {kinematics: hybrid}}\n",
        encoding="utf-8",
    )
    deliver(rotordyn.load(path), tmp_path / "out")
    summary = (tmp_path / "out" / "summary.txt").read_text(encoding="utf-8")
    assert "axial load at which race control changes, 6000 → 12000 rpm" in summary
    assert summary.count("none → none") == 4
    assert (tmp_path / "out" / "control.png").exists()
    assert (tmp_path / "out" / "a" / "control_margins.csv").exists()
