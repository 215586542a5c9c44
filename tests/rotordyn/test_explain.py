"""What a run says of itself, and what it does not do twice or at all."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.stability_lobes.spec import StabilityLobesSpec
from rotordyn.cli import main
from rotordyn.job.solving import solve, solve_variants

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "cases"
SPEEDS = [0.0, 400.0 * np.pi, 800.0 * np.pi]  # up to 24 000 rpm
LOBES = "stability_lobes"
BODY = {"mesh", "rotor"}


def few_speeds(name: str) -> Any:
    case = rotordyn.load(CASES / f"{name}.yaml")
    return rotordyn.vary(case, {"speeds": SPEEDS})


@pytest.mark.parametrize(
    ("name", "spared"),
    [
        ("mfw2310_preload_springs", [set(), BODY, BODY, BODY, BODY]),
        ("mfw2310_tangents", [set(), BODY | {"preload", "unloaded", "shaft_force"}]),
    ],
)
def test_what_variants_share_is_solved_once(name: str, spared: list[set[str]]) -> None:
    solved = [set(own.seconds) for own in solve_variants(few_speeds(name)).machines.values()]
    for own, missing in zip(solved, spared, strict=True):
        assert solved[0] - own == missing


@pytest.mark.few(1)
@pytest.mark.parametrize("name", ["mfw2310_preload_springs", "mfw2310_decomposition"])
def test_a_variant_in_company_is_the_variant_alone(name: str) -> None:
    case = few_speeds(name)
    together = solve_variants(case).machines
    for variant, one in case.variants.items():
        for analysis, result in solve(one).results.items():
            shared = together[variant].results[analysis]
            for field in fields(result):
                alone, beside = getattr(result, field.name), getattr(shared, field.name)
                if isinstance(alone, np.ndarray) and alone.dtype.kind in "fc":
                    assert np.array_equal(alone, beside, equal_nan=True), (variant, field.name)


def test_sleeves_of_a_variant_move_along_the_axis_on_its_own_springs() -> None:
    """Shafts are shared; axial modes were those of the springs of the first variant."""
    case = few_speeds("mfw2310_preload_springs")
    case = rotordyn.vary(case, {"analyses": {"campbell": CampbellSpec(max_frequency=4000.0)}})
    together = solve_variants(case).machines
    frequencies = []
    for variant, one in case.variants.items():
        alone, beside = solve(one).results["campbell"], together[variant].results["campbell"]
        assert alone.mode == beside.mode
        assert np.array_equal(alone.frequency, beside.frequency)
        frequencies.append(beside.frequency[0, beside.mode.index("axial 1")])
    soft, built, stiff, stiffer, no_stop = frequencies
    assert min(soft - built, built - stiff, stiff - stiffer) > 0.3  # Hz: it takes damping along
    assert no_stop == pytest.approx(built, rel=1e-12)


def test_another_shaft_shares_no_rotor() -> None:
    case = rotordyn.load(CASES / "mfw2310_preload_springs.yaml")
    case = rotordyn.vary(case, {"speeds": SPEEDS})
    name = list(case.variants)[1]
    path = f"variants.{name}.spindle.shaft.sections.hsk_flange.outer_diameter"
    other = rotordyn.vary(case, {path: "64 mm"})
    kept = solve_variants(other).machines[name].results["campbell"]
    alone = solve(other.variants[name]).results["campbell"]
    same = solve(case.variants[name]).results["campbell"]
    assert np.array_equal(kept.frequency, alone.frequency)
    assert not np.array_equal(kept.frequency, same.frequency)


def test_the_plan_names_stages_what_was_spared_and_what_did_not_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ("--only", "campbell", "--no-figures", "--quiet", "--explain")
    assert main(["run", str(CASES / "mfw2310.yaml"), "-o", str(tmp_path / "out"), *options]) == 0
    lines = capsys.readouterr().out.splitlines()
    stages = lines[: lines.index("spared")]
    place = {line.split()[0]: len(line) - len(line.lstrip()) for line in stages[1:]}
    assert place["bending"] > place["solve"] >= place["preload"]
    assert all(line.endswith("ms") for line in stages[1:])
    text = " ".join(" ".join(lines).split())
    assert "bearings a, b are alike and share their load: one of them is solved" in text
    assert "one of 25 is solved" in text
    assert "half the unknowns" in text
    assert "figures: none are requested" in text


def test_a_stage_run_at_other_speeds_alone_is_not_called_skipped() -> None:
    """Lobes ask for the machine at the speeds of the cutter; a second variant finds it known."""
    asked = {"point": "nose_face", "diameter": 0.016, "teeth": 3, "tangential": 7e8, "radial": 2e8}
    spec = StabilityLobesSpec(**asked, method="zero-order", speeds=(2000.0,))
    case = rotordyn.vary(few_speeds("mfw2310_preload_springs"), {"analyses": {LOBES: spec}})
    two = list(case.variants)[:2]
    machines = solve_variants(replace(case, variants={n: case.variants[n] for n in two})).machines
    first, second = machines.values()
    assert {"mesh", "rotor", "subsystems", "tangents"} <= set(first.seconds)
    assert "rotor" not in second.seconds
    for each in (first, second):
        assert not {*each.seconds, "mesh", "rotor"} & set(each.skipped)


def test_no_figures_leaves_numbers_alone(tmp_path: Path) -> None:
    out = tmp_path / "out"
    options = ("--no-figures", "--quiet")
    assert main(["run", str(CASES / "lalanne_ferraris.yaml"), "-o", str(out), *options]) == 0
    names = {path.name for path in out.iterdir()}
    assert {"results.nc", "campbell.csv", "summary.txt"} <= names
    assert not [name for name in names if name.endswith((".png", ".svg", ".pdf"))]
    record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert record["figures"] == {}
    assert record["skipped"]["figures"] == "none are requested"
    assert "draw" not in record["stages"]
