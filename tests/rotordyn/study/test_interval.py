"""Ranges over what is uncertain: equal to single runs, honest about what they are."""

from __future__ import annotations

import itertools
import json
import math
import re
import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.case.asked import asked_of
from rotordyn.case.case import Case
from rotordyn.case.uncertain import Uncertain
from rotordyn.errors import InvalidInput
from rotordyn.figures.interval import rules_figure
from rotordyn.job.solving import solve
from rotordyn.job.values import difference, values_of
from rotordyn.report.interval import FAR, interval_doubts, interval_lines
from rotordyn.results.declaration import quantity
from rotordyn.results.headline import Curve
from rotordyn.scene.checks import Checks
from rotordyn.study import interval, quantiles
from rotordyn.study.interval import sampled
from rotordyn.study.machines import Machines, lean

KINEMATICS = ("outer", "hybrid", "inner", "geometric")
SHARING = ("equal", "outer", "inner", "hybrid")
SPRING = "spindle.sleeves.front.spring.preload"


def _case(analyses: tuple[str, ...], rpm: tuple[float, ...], **uncertain: Any) -> Case:
    whole = rotordyn.load("mfw2310")
    specs = {name: whole.analyses[name] for name in analyses}
    if "stiffness" in specs:
        specs["stiffness"] = replace(specs["stiffness"], variants=("full",), second_stop={})
    if "campbell" in specs:
        specs["campbell"] = replace(specs["campbell"], max_frequency=2000.0)
    speeds = tuple(math.pi / 30.0 * each for each in rpm)
    return replace(whole, analyses=specs, speeds=speeds, uncertain=Uncertain(**uncertain))


def _alone(case: Case) -> Any:
    return solve(case, checks=Checks(wanted=False)).results


@pytest.mark.long
def test_combinations_are_what_single_runs_give() -> None:
    """All 16 of kinematics and sharing, on the flagship."""
    asked = {"kinematics": "all", "moment_sharing": "all"}
    case = _case(("preload", "campbell", "stiffness"), (0.0, 24000.0), hypotheses=asked)
    whole = rotordyn.load("mfw2310").analyses["stiffness"].unloaded  # all that states may be asked
    case = replace(case, analyses={**case.analyses, "stiffness": whole})
    found = rotordyn.run(case, interval=True).interval
    plain = replace(case, uncertain=None)
    singles = []
    for law, sharing in itertools.product(KINEMATICS, SHARING):
        changes = {"conditions.kinematics": law, "conditions.moment_sharing": sharing}
        other = rotordyn.vary(plain, changes)
        numbers = values_of(other, _alone(other)).numbers
        singles.append([numbers[str(name)].value for name in found.number.values])
        column = found.by_combination.sel(combination=f"kinematics {law}, moment_sharing {sharing}")
        np.testing.assert_allclose(column, singles[-1], rtol=1e-6)
    assert len(singles) == found.sizes["combination"] == 16
    known = np.isfinite(singles).any(axis=0)
    for end, limit in (("lowest", np.nanmin), ("highest", np.nanmax)):
        np.testing.assert_allclose(
            found.hypotheses.sel(end=end)[known],
            limit(np.array(singles)[:, known], axis=0),
            rtol=1e-6,
        )
    assert found.without.values.tolist() == (np.isnan(singles).sum(axis=0) * known).tolist()
    moved = np.ptp(found.hypotheses.values[known], axis=1) / found.nominal.values[known]
    assert moved.max() > 0.2  # the choice matters


def test_combinations_with_other_dynamics_are_what_single_runs_give() -> None:
    asked = {"kinematics": ("outer", "inner"), "dynamics": ("resultant", "centrifugal")}
    case = _case(("preload",), (0.0, 24000.0), hypotheses=asked)
    found = rotordyn.run(case, interval=True).interval.by_combination
    plain = replace(case, uncertain=None)
    for law, dynamics in itertools.product(*asked.values()):
        other = rotordyn.vary(
            plain, {"conditions.kinematics": law, "conditions.dynamics": dynamics}
        )
        numbers = values_of(other, _alone(other)).numbers
        column = found.sel(combination=f"kinematics {law}, dynamics {dynamics}")
        for name, value in zip(column.number.values, column.values, strict=True):
            assert value == pytest.approx(numbers[str(name)].value, rel=1e-9, nan_ok=True)


def test_bands_of_curves_end_where_those_of_numbers_do() -> None:
    asked = {"moment_sharing": ("inner", "outer")}
    widths = {SPRING: "± 10 %"}
    rpm = tuple(np.linspace(0.0, 24000.0, 17))
    case = _case(("preload", "campbell"), rpm, hypotheses=asked, tolerances=widths)
    held = rotordyn.run(case, interval=True).held_intervals[""]
    row = held.number.index("preload: sum at 24000 rpm")
    points = held.rows_of(next(k for k, c in enumerate(held.curve) if "sum of preloads" in c))
    assert len(points) == 17
    for ends, of_curve in (
        (held.hypotheses, held.curve_hypotheses),
        (held.tolerances, held.curve_tolerances),
    ):
        np.testing.assert_allclose(of_curve[points[-1]], ends[row], rtol=1e-9)
    inside = held.curve_hypotheses[points]
    assert (inside[:, 0] <= held.curve_nominal[points]).all()
    assert (inside[:, 1] >= held.curve_nominal[points]).all()


def test_depths_without_end_differ_by_ratios_and_are_never_below_zero() -> None:
    """Others by what lies between them; where there is no limit there is no ratio."""
    x, ends = np.arange(3.0), {"ceiling": 10.0}
    depth, deeper = np.array([2.0, 4.0, np.inf]), np.array([3.0, 1.0, 5.0])
    base, other = (Curve("lobes", "depth", "mm", x, y, **ends) for y in (depth, deeper))
    ratios = difference(base, other, base)
    np.testing.assert_allclose(ratios, [math.log(1.5), math.log(0.25), np.nan])
    plain = [each._replace(ceiling=np.inf) for each in (base, other)]
    np.testing.assert_allclose(difference(plain[0], plain[1], plain[0])[:2], [1.0, -3.0])
    moved = interval._moved(depth, np.full(3, base.by_ratio), np.full((3, 2), [-9.0, 0.5]))
    assert (moved[:2] > 0.0).all()


def test_rounding_does_not_order_double_peaks() -> None:
    """Both whirls of a mode at rest have one frequency, which of them is named must not depend on
    the last digit."""
    case = _case(("preload", "campbell"), (0.0, 12000.0), tolerances={SPRING: "± 10 %"})
    held = rotordyn.run(case, interval=True).held_intervals[""]
    order, rng = held.varying(), np.random.default_rng(7)
    assert len(order) > 4
    for _ in range(8):
        digit = 1.0 + 1e-12 * rng.standard_normal((len(held.number), 1))
        middle = held.nominal[:, None]
        moved = replace(held, tolerances=middle + (held.tolerances - middle) * digit)
        assert moved.varying() == order


def test_numbers_without_a_limit_at_both_ends_do_not_vary() -> None:
    case = _case(("preload", "campbell"), (0.0, 12000.0), tolerances={SPRING: "± 10 %"})
    held = rotordyn.run(case, interval=True).held_intervals[""]
    first = held.varying()[0]
    endless = np.where(np.arange(len(held.number))[:, None] == first, np.inf, held.tolerances)
    with warnings.catch_warnings(action="error"):
        left = replace(held, tolerances=endless, hypotheses=endless).varying()
    assert first not in left


def test_what_some_machines_lack_is_reported_where_it_is() -> None:
    """By a star in the row of the number, or by its name where it has no row."""
    case = _case(("preload", "campbell"), (0.0, 12000.0), tolerances={SPRING: "± 10 %"})
    held = rotordyn.run(case, interval=True).held_intervals[""]
    count, varying = len(held.number), held.varying()
    (hidden, *_), (seen, *_) = set(range(count)) - set(varying), varying
    for k, begin, star in ((seen, "*", True), (hidden, "note       some of these", False)):
        own = replace(held, without_within=(np.arange(count) == k).astype(int))
        lines = interval_lines(own)
        assert any(line.startswith(begin) for line in lines)
        assert any(line.startswith("*") for line in lines) == star
        assert (own.number[k] in " ".join(interval_doubts(own))) == (not star)
    last = next(line for line in interval_lines(held) if line.startswith("…"))
    assert last.endswith("more numbers: interval.csv")
    few = [k for k in range(count) if k in varying[:1] or k == hidden]
    texts = ("number", "unit", "absent")
    named = {name: tuple(getattr(held, name)[k] for k in few) for name in texts}
    arrays = ("nominal", "hypotheses", "tolerances", "effect", "without", "without_within")
    arrays += ("numerical_error", "interaction")
    two = replace(held, **named, **{name: getattr(held, name)[few] for name in arrays})
    assert "… and 1 more number: interval.csv" in interval_lines(two)


def test_a_range_that_interactions_spoil_is_marked() -> None:
    """And no other; the note names the worst below the same mark, where that has a row."""
    case = _case(("preload", "campbell"), (12000.0,), tolerances={SPRING: "± 10 %"})
    held = rotordyn.run(case, interval=True).held_intervals[""]
    order = held.apart(held.varying())
    assert len(order) > 1
    for share, mark in ((0.3, "~"), (0.1, "note")):
        own = replace(held, interaction=np.where(np.arange(len(held.number)) == order[0], share, 0))
        *rows, note, _ = [line.rstrip() for line in interval_lines(own)]
        assert note.startswith(mark)
        marked = [row for row in rows if "~" in row]
        assert len(marked) == (mark == "~")
        assert all(re.search(r" –  +\S+\.\.\S+~ ", row) for row in marked), "of tolerances"


def test_why_some_machines_lack_a_number_is_what_is_said_of_it() -> None:
    """Of a stop that some do not meet, and of a bearing of which nothing is said."""
    case = _case(
        ("preload",), (0.0, 24000.0), tolerances={"spindle.sleeves.front.stop_travel": "± 90 %"}
    )
    held = rotordyn.run(case, interval=True).held_intervals[""]
    stop = [
        name for name, word in zip(held.number, held.absent, strict=True) if word == "not reached"
    ]
    assert "preload: stop front" in stop
    told = " ".join(interval_doubts(held))
    assert "no such number: not reached; ranges" in told
    unknown = replace(held, absent=("none",) * len(held.number))
    assert "no such number: a bearing unloaded" in " ".join(interval_doubts(unknown))


def test_numbers_without_a_limit_are_lacking_in_no_machine(tmp_path: Path) -> None:
    (tmp_path / "undamped.yaml").write_text(
        """
title: orbits without a limit
spindle: friswell_two_discs
speeds: [500 rpm, 1000 rpm]
analyses:
  unbalance: {points: [left_disc], unbalances: [{at: left_disc, unbalance: 1 kg mm}]}
uncertain: {tolerances: {spindle.supports.*.stiffness.yy: ± 10 %}}
""",
        encoding="utf-8",
    )
    case = rotordyn.load(tmp_path / "undamped.yaml")
    held = rotordyn.run(case, interval=True).held_intervals[""]
    assert np.isinf(held.nominal[0])
    assert not held.without_within.any()


def test_no_run_is_spent_on_a_hypothesis_that_changes_nothing() -> None:
    asked = {"kinematics": "all", "moment_sharing": "all"}
    still = _case(("preload",), (0.0,), hypotheses=asked)
    assert asked_of(still).hypotheses == ()
    frozen = rotordyn.vary(
        _case(("preload",), (0.0, 24000.0), hypotheses=asked),
        {"conditions.dynamics": "centrifugal"},
    )
    assert [each.name for each in asked_of(frozen).hypotheses] == ["kinematics"]


@pytest.mark.parametrize("speeds", ["[0 rpm]", "[0 rpm, 3000 rpm]"])
def test_an_interval_over_nothing_is_refused_before_anything_is_solved(
    tmp_path: Path, speeds: str
) -> None:
    """At rest no ball turns, and a machine without balls has none that could."""
    text = "title: t\nspindle: friswell_two_discs\nspeeds: SPEEDS\nanalyses: {campbell: {}}\n"
    (tmp_path / "case.yaml").write_text(text.replace("SPEEDS", speeds))
    case = replace(rotordyn.load(tmp_path / "case.yaml"), uncertain=Uncertain(as_usual=True))
    with pytest.raises(InvalidInput, match="no uncertain value changes this case"):
        rotordyn.run(case, interval=True)


def test_a_sample_is_advised_where_random_machines_show_that_it_is_needed() -> None:
    """Of the numbers of the benchmark, which thousands of random machines were held against."""
    kept = json.loads(
        (Path(__file__).parents[3] / "benchmarks" / "results.json").read_text("utf-8")
    )
    machines = [each for name, each in kept["intervals"].items() if name != "costs"]
    lines = [line for each in machines for line in each["lines"]]
    off = [line["error"] > 0.05 for line in lines]
    assert [line["interaction"] > FAR for line in lines] == off
    assert 0 < sum(off) < len(off)


def _effect(low: float, high: float, nominal: float = 0.5, levels: int = 0) -> quantiles.Effect:
    share, change = np.array([0.0, nominal, 1.0]), np.array([[low], [0.0], [high]])
    return quantiles.Effect(share, change, nominal, levels)


def _range(*effects: quantiles.Effect) -> Any:
    return quantiles.ranges(np.zeros(1), effects)


def test_words_have_three_values_each_as_often() -> None:
    drawn = _effect(-1.0, 2.0, levels=3).at((np.arange(300) + 0.5) / 300.0)[:, 0]
    assert {*drawn.round(12)} == {-1.0, 0.0, 2.0}
    assert np.mean(drawn) == pytest.approx(1.0 / 3.0)


def test_a_kink_is_met_with_values_in_between() -> None:
    """|x| over [−1, 1] through five points: evenly in [0, 1]."""
    share = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    effect = quantiles.Effect(share, np.abs(2.0 * share - 1.0)[:, None], 0.5)
    np.testing.assert_allclose(_range(effect).usual, [[0.025, 0.975]], atol=0.03)


def test_a_range_ends_at_machines_that_have_the_number() -> None:
    """One tolerance loses the number at an end and lowers it by 3 at the other, another moves it by
    ± 0.5; a machine off by both has 1 more."""
    lost, plain = _effect(math.nan, -3.0), _effect(-0.5, 0.5)
    np.testing.assert_allclose(lost.at(np.array([0.0, 0.75])), [[3.0], [-1.5]])
    found = _range(lost, plain)
    solved = np.array([[math.nan], [-3.0], [-0.5], [0.5], [1.0]])
    ends = np.array([[[math.nan, -3.0], [-0.5, 0.5]]])
    usual = interval._within_solved(found.usual, ends, solved)
    np.testing.assert_allclose(usual, [[found.usual[0, 0], 1.0]])
    mirrored = interval._within_solved(-found.usual[:, ::-1], -ends[..., ::-1], -solved)
    np.testing.assert_allclose(mirrored, -usual[:, ::-1])
    unknown = interval._within_solved(found.usual, np.full((1, 2, 2), math.nan), solved)
    np.testing.assert_allclose(unknown, [[max(found.usual[0, 0], -3.0), 1.0]])
    whole = interval._within_solved(found.usual, np.array([[[3.0, -3.0]]]), solved)
    np.testing.assert_allclose(whole, found.usual)


def test_no_stop_is_met_beyond_the_top_speed() -> None:
    """Which is 1 % above that of the nominal machine, 20 240 rpm."""
    widths = {SPRING: "± 10 %", "spindle.bearings.*.model.contact_angle": "± 0.2 deg"}
    case = _case(("preload",), (0.0, 20442.0), tolerances=widths)
    held = rotordyn.run(case, interval=True).held_intervals[""]
    k = held.number.index("preload: stop front")
    assert held.without_within[k]
    for ends in (held.tolerances[k], held.worst[k]):
        assert ends[0] < held.nominal[k] < ends[1] <= 20442.0


def test_a_tolerance_rules_by_the_end_at_which_the_number_is_there() -> None:
    case = _case(("preload",), (0.0, 12000.0), tolerances={SPRING: "± 10 %"})
    held = rotordyn.run(case, interval=True).held_intervals[""]
    effect = np.array([[[math.nan, -3.0], [-0.5, 0.5], [math.nan, math.nan]]])
    own = replace(held, source=("large", "small", "none"), effect=effect)
    assert own.ruling(0) == [
        ("large", pytest.approx(36.0 / 37.0)),
        ("small", pytest.approx(1 / 37)),
    ]


def test_both_ends_on_one_side_have_a_bar_each_and_titles_are_whole() -> None:
    case = _case(("preload",), (0.0, 12000.0), tolerances={SPRING: "± 10 %"})
    held = rotordyn.run(case, interval=True).held_intervals[""]
    count = len(held.number)
    own = replace(held, effect=np.arange(1.0, count + 1.0)[:, None, None] * [1.0, 3.0])
    own = replace(own, number=("a number with a long name in words, even longer",) * count)
    figure = rules_figure(own)
    figure.canvas.draw()
    for axes in figure.axes:
        small, large = axes.patches
        assert small.get_width() < large.get_width()
        assert small.get_height() < large.get_height()
        assert small.get_zorder() > large.get_zorder()
        titles = [text for text in axes.get_children() if getattr(text, "get_text", str)()]
        assert titles
        assert max(text.get_window_extent().x1 for text in titles) <= figure.bbox.x1


def test_range_over_tolerances_of_a_linear_number_is_within_solved() -> None:
    """Uniform within ± 1: one source covers ± 0.95; two equal ones ± (2 − √0.2), of a triangle
    whose tail beyond x holds (2 − x)²/8; many a normal distribution."""
    one = _range(_effect(-1.0, 1.0))
    np.testing.assert_allclose(one.usual, [[-0.95, 0.95]], atol=2e-3)
    two = _range(*[_effect(-1.0, 1.0)] * 2)
    edge = 2.0 - math.sqrt(0.2)
    np.testing.assert_allclose(two.usual, [[-edge, edge]], atol=0.01)
    many = _range(*[_effect(-1.0, 1.0)] * 12)
    np.testing.assert_allclose(many.usual[0, 1], 1.96 * math.sqrt(12.0 / 3.0), rtol=0.02)
    np.testing.assert_allclose(many.worst, [[-12.0, 12.0]])


def test_a_parabola_is_met_and_one_end_may_be_nominal() -> None:
    """y = x² over x in [−1, 1], nominal 0: y lies evenly in √y, between 0.025² and 0.975²."""
    square = _range(_effect(1.0, 1.0))
    np.testing.assert_allclose(square.usual, [[0.025**2, 0.975**2]], atol=2e-3)
    sided = _range(_effect(0.0, 2.0, nominal=0.0))
    np.testing.assert_allclose(sided.usual, [[0.05, 1.95]], atol=4e-3)


@pytest.mark.parametrize("power", [1.0, 1.5, 3.0, math.inf])
def test_the_power_that_adds_up_is_found(power: float) -> None:
    """Numbers (Σ x)^p, or e^(Σ x), of six sources: no interaction, and the quantiles are those of
    the sum, which the power keeps in order."""

    def of(total: Any) -> Any:
        return np.exp(total) if math.isinf(power) else (2.0 + total) ** power

    size, count = 0.3, 6
    effects = [_effect(float(of(-size) - of(0.0)), float(of(size) - of(0.0)))] * count
    share = quantiles.corner_shares(np.ones((1, count)), np.full(count, 0.5))
    change = of(size * (2.0 * share - 1.0).sum(axis=1)) - of(0.0)
    corners = quantiles.Corners(share, change[:, None])
    found = quantiles.ranges(np.array([of(0.0)]), effects, corners)
    drawn = np.random.default_rng(0).uniform(-size, size, (200_000, count)).sum(axis=1)
    exact = np.percentile(of(drawn) - of(0.0), (2.5, 97.5))
    np.testing.assert_allclose(found.usual[0], exact, atol=0.02 * np.ptp(exact))
    assert found.interaction[0] < 0.02
    if power != 1.0:
        plain = quantiles.ranges(np.array([of(0.0)]), effects)  # which just adds changes up
        assert np.abs(plain.usual[0] - exact).max() > np.abs(found.usual[0] - exact).max()


@pytest.mark.long
def test_few_runs_cover_95_of_100_machines() -> None:
    """Of 60 drawn within the tolerances 90 to 99 % lie in the range, all within the worst case."""
    widths = {SPRING: "± 10 %", "spindle.bearings.*.model.contact_angle": "+3/-2 deg"}
    case = _case(("preload", "stiffness"), (0.0, 16000.0), tolerances=widths)
    few = rotordyn.run(case, interval=True).held_intervals[""]
    machines = Machines(lean(case))
    drawn = [machines.values(each) for each in sampled(asked_of(case).tolerances, 60, 2)]
    for name in ("preload: sum at 16000 rpm", "stiffness: full at 16000 rpm"):
        k = few.number.index(name)
        values = np.array([each.numbers[name].value for each in drawn])
        low, high = few.tolerances[k]
        assert 0.90 <= np.mean((values >= low) & (values <= high)) <= 0.99
        slack = 0.01 * (high - low)
        assert (values >= few.worst[k, 0] - slack).all()
        assert (values <= few.worst[k, 1] + slack).all()
    asked = Uncertain(tolerances=widths, samples=20, seed=3)
    again = rotordyn.run(replace(case, uncertain=asked), interval=True).held_intervals[""]
    assert again.runs >= few.runs + 20 - 2
    inside = again.tolerances[k]
    assert few.worst[k, 0] <= inside[0] < inside[1] <= few.worst[k, 1]
    assert np.isfinite(few.interaction[k])
    assert np.isnan(again.interaction).all()


def test_a_sample_of_which_no_machine_has_a_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    """Bores wider than the shaft: one sentence, and no ranges over tolerances."""
    section = "spindle.shaft.sections.tool_shank"
    outer, inner = f"{section}.outer_diameter", f"{section}.inner_diameter"
    widths = {outer: "14.8..33.1 mm", inner: "14..33 mm"}
    case = _case(("preload",), (0.0,), tolerances=widths, samples=20)
    monkeypatch.setattr(interval, "sampled", lambda *_: [{outer: 0.015, inner: 0.02}] * 20)
    held = rotordyn.run(case, interval=True).held_intervals[""]
    known = np.isfinite(held.nominal)
    assert (held.tolerances == held.nominal[:, None])[known].all()
    assert (held.without_within > 0)[known].all()
    (note,) = [each for each in interval_doubts(held) if "without a solution" in each]
    assert "all 20 machines drawn, so that tolerances have no ranges" in note


def test_a_sample_is_the_same_again_and_within_its_tolerances() -> None:
    widths = {SPRING: "500..600 N", "spindle.bearings.*.fits.taken": "least..most"}
    case = replace(rotordyn.load("mfw2310"), uncertain=Uncertain(tolerances={SPRING: "500..600 N"}))
    (given,) = asked_of(case).tolerances
    once, again = (sampled([given], 32, 1) for _ in range(2))
    assert once == again
    values = sorted(each[SPRING] for each in once)
    assert 500.0 <= values[0] < values[-1] <= 600.0
    assert np.diff(values).max() < 2 * 100.0 / 32  # one in each of 32 parts
    assert widths


def test_what_rules_is_what_moves_most() -> None:
    widths = {SPRING: "± 1 %", "spindle.bearings.*.model.contact_angle": "± 10 %"}
    held = rotordyn.run(
        _case(("stiffness",), (0.0, 24000.0), tolerances=widths), interval=True
    ).held_intervals[""]
    k = held.number.index("stiffness: full at 24000 rpm")
    source, share = held.ruling(k)[0]
    assert source.endswith("contact_angle")
    assert share > 0.9


def test_folder_keeps_the_interval(tmp_path: Path) -> None:
    case = _case(
        ("preload",),
        (0.0, 24000.0),
        hypotheses={"kinematics": ("outer", "hybrid")},
        tolerances={SPRING: "± 10 %"},
        sensitivities={SPRING: "± 10 %"},
    )
    results = rotordyn.run(case, interval=True)
    folder = results.save(tmp_path / "sure", figures=False)
    back = rotordyn.open(folder)
    assert back.interval.equals(results.interval)
    assert back.figures == results.figures
    assert "interval_rules" in back.figures
    assert {"interval.csv", "interval_effects.csv", "interval_hypotheses.csv"} <= {
        path.name for path in folder.iterdir()
    }
    assert (folder / "sensitivities.csv").exists()
    summary = (folder / "summary.txt").read_text(encoding="utf-8")
    assert "2 combinations of hypotheses and 1 tolerances" in summary
    assert max(map(len, summary.splitlines())) <= 100
    for name in ("interval_rules", "interval_preload", "sensitivities"):
        assert back.plot(name).axes
    assert "sum of preloads [N]" in [a.get_ylabel() for a in back.plot("interval_preload").axes]
    for panel in back.plot("interval_rules").axes:
        assert panel.get_title("right") in results.held_intervals[""].number  # with its analysis
        names = [label.get_text().replace("\n", "") for label in panel.get_yticklabels()]
        assert SPRING.removeprefix("spindle.") in names


def test_an_error_in_a_unit_of_its_own_is_none_of_other_numbers() -> None:
    """That of ``warm_up`` is of temperatures [K], its numbers are loads."""

    @dataclass(frozen=True)
    class Made:
        error: float = quantity(unit="K", label="")

    @dataclass(frozen=True)
    class Relative:
        error: float = quantity(unit="1", label="")

    results = {"warm_up": Made(0.3), "frf": Relative(1e-4)}
    assert math.isnan(interval._numerical("warm_up: load", results))
    assert interval._numerical("frf: peak", results) == 1e-4


def test_without_it_there_is_none() -> None:
    results = rotordyn.run(_case(("preload",), (0.0,), as_usual=True))
    with pytest.raises(InvalidInput, match="run the case with it"):
        _ = results.interval


def test_curves_without_numbers_have_one() -> None:
    """Few frequencies far from any peak, where planes are not coupled: there is no number to state,
    and half of the curves are zero."""
    y, z = Port("Oc2", "y"), Port("Oc2", "z")
    spec = FrfSpec((10.0, 20.0, 30.0), ((y, y), (z, y)))
    case = _case(("preload",), (0.0,), tolerances={SPRING: "± 10 %"})
    results = rotordyn.run(replace(case, analyses={"frf": spec}), interval=True)
    assert results.interval is not None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in results.figures:
            results.plot(name)


def test_variants_have_their_own() -> None:
    case = rotordyn.load("mfw2310_axial_cycle")
    specs = {"preload": case.analyses["preload"]}
    given = Uncertain(tolerances={SPRING: "± 10 %"})
    small = {"analyses": specs, "speeds": (0.0, 1000.0)}
    variants = {
        name: replace(each, uncertain=given, **small) for name, each in case.variants.items()
    }
    case = replace(case, variants=variants, uncertain=given, **small)
    results = rotordyn.run(case, interval=True)
    assert list(results.intervals) == list(case.variants)
    with pytest.raises(InvalidInput, match="each variant has its own"):
        _ = results.interval


def test_machines_without_a_solution_are_omitted_and_named() -> None:
    case = _case(("preload",), (0.0, 24000.0), tolerances={SPRING: "± 10 %"})
    machines = Machines(lean(case))
    lost = machines.values({"spindle.bearings.*.model.balls": 400})
    assert not lost.numbers
    assert machines.lost == [lost.sentence]
    assert machines.values({}).numbers


def test_a_derivative_is_that_of_a_closed_form() -> None:
    """A spring preload at rest is the preload: derivative 1 N/N by its own spring, the share of it
    as elasticity; κ over ± 10 % is a fifth of it."""
    case = _case(("preload",), (0.0,), as_usual=True)
    found = rotordyn.sensitivities(case, {SPRING: "± 10 %"})
    here = found.sel(number="preload: sum at 0 rpm", path=SPRING)
    assert float(here.derivative) == pytest.approx(1.0, rel=1e-6)
    assert float(here.elasticity) == pytest.approx(574.0 / 1102.0, rel=1e-6)
    assert float(here.range_effect) == pytest.approx(114.8, rel=1e-6)
    assert np.isnan(rotordyn.sensitivities(case, [SPRING]).range_effect).all()


def test_hertz_gives_the_elasticity_of_a_single_bearing() -> None:
    """Axial stiffness of a bearing at rest under light load goes with F^(1/3) nearly: the contact
    angle changes a little."""
    case = rotordyn.vary(rotordyn.load("vex70"), {"speeds": (0.0,)})
    case = replace(case, variants={})
    found = rotordyn.sensitivities(case, ["bearing.ball_diameter"])
    assert np.isfinite(found.elasticity.values).any()


@pytest.mark.parametrize(
    ("paths", "sentence"),
    [
        (["spindle.sleeves.frnt.spring.preload"], "did you mean front"),
        (["sleeves.frnt.spring.preload"], "did you mean front"),
        (["bearings.a.contact_angle"], r"did you mean model\.contact_angle"),
        (["conditions.kinematics"], "two words"),
        (["conditions.friction"], "infinite"),
        (["conditions.axial_force"], "share of 0"),
        ({SPRING: "± 1 mm"}, "not a unit of force"),
    ],
)
def test_sensitivities_that_there_are_not(paths: Any, sentence: str) -> None:
    case = _case(("preload",), (0.0,), as_usual=True)
    with pytest.raises(InvalidInput, match=sentence):
        rotordyn.sensitivities(case, paths)
