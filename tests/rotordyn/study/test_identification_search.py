"""Searches beside an unknown that no measurement follows, and those that end by their limit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import linprog, minimize

import rotordyn
from rotordyn import Unknown, identify
from rotordyn.case.case import Case
from rotordyn.study.identification import search as searching
from rotordyn.study.identification.certainty import QUARTILE, UNFINISHED, certainty
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import search, search_absolute
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import sought
from tests.rotordyn.study.axial_twin import FRONT, REAR, Array
from tests.rotordyn.study.made_up import MadeUp

P1, P2 = FRONT + "spring.preload", REAR + "spring.preload"
FRICTION = FRONT + "friction"
ALONG, MANY = np.linspace(0.0, 3.0, 12), np.linspace(0.0, 3.0, 24)


@pytest.fixture(scope="module")
def case() -> Case:
    return rotordyn.load("mfw2310_identification")


def _decaying(load: float, length: float) -> Array:
    """Decays from a load [N] within a length."""
    return np.asarray(load * np.exp(-ALONG / length))


class Decaying(Problem):
    """A decay from the first unknown [N] within the second [100 N]; a third has no part."""

    def predicted(self, values: Array) -> list[Array]:
        self.evaluations += 1
        return [_decaying(values[0], values[1] / 100.0)]


def test_an_unknown_without_influence_changes_no_other(case: Case) -> None:
    """Neither values nor, hardly, the number of machines."""
    ends = {P1: Unknown("0 N", "1 kN", start="900 N"), P2: Unknown("20 N", "600 N", start="500 N")}
    noise = np.random.default_rng(3).normal(0.0, 2.0, len(ALONG))
    measured = MadeUp(_decaying(400.0, 0.8) + noise, 2.0)
    found = []
    for asked in (ends, ends | {FRICTION: Unknown("0 N", "200 N")}):
        problem = Decaying(case, sought(case, asked), (measured,))
        fit = search(problem, problem.start)
        found.append((fit.values[:2], problem.evaluations / (len(asked) + 1.0)))
    (alone, few), (beside, many) = found
    assert beside == pytest.approx(alone, rel=1e-5)
    assert many < 1.5 * few


@dataclass(frozen=True, eq=False)
class Decay(MadeUp):
    """The same of a machine's preloads."""

    def predicted(self, trial: Trial) -> Array:
        assert trial.case.spindle is not None
        loads = [each.spring.preload for each in trial.case.spindle.sleeves]
        return _decaying(loads[0], loads[1] / 100.0)


def test_a_search_that_ends_by_its_limit_gives_no_interval(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(searching, "MOST", 2)
    asked = {P1: Unknown("1 N", "1 kN", start="900 N"), P2: Unknown("20 N", "600 N", start="500 N")}
    measured = Decay(_decaying(400.0, 0.8), 2.0)
    found = identify(case, asked, [measured], profiles="all", workers=1, folder=tmp_path)
    assert np.isnan([*found.intervals.values()]).all()
    assert not found.profiles
    assert any(line.startswith(f"{UNFINISHED}: ") for line in found.verdict)
    assert "nan" not in found.summary
    again = identify(case, asked, [measured], profiles="all", workers=1, folder=tmp_path)
    assert again.verdict == found.verdict
    found.save(tmp_path, draw=False)
    head, row, _ = (tmp_path / "values.csv").read_text(encoding="utf-8-sig").splitlines()
    assert row.split(",")[head.split(",").index("lower end of 95 %")] == ""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    page = rotordyn.write_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert UNFINISHED in page
    assert "none to none" not in page


class Without(Problem):
    """No machine of more than 500 N has a solution."""

    def predicted(self, values: Array) -> list[Array] | None:
        return None if values[0] > 500.0 else [values[0] * ALONG]


def test_machines_without_a_solution_have_as_many_rows(case: Case) -> None:
    unknowns = sought(case, {P1: Unknown("0 N", "1 kN", start="400 N"), P2: Unknown("0 N", "1 kN")})
    problem = Without(case, unknowns, (Tared(300.0 * ALONG, 1.0),))
    goal = searching._Objective(problem, problem.start / problem.scale)
    with_one, without = (np.array([size, 100.0]) / problem.scale for size in (400.0, 600.0))
    assert goal.rows(without).shape == goal.rows(with_one).shape
    assert goal.slopes(without).shape == goal.slopes(with_one).shape
    assert goal.rows(without).min() == searching.FAR


@dataclass(frozen=True, eq=False)
class Tared(MadeUp):
    """Numbers with one tare, of which this deviation is known before."""

    known: float = np.inf

    @property
    def data(self) -> Data:
        n = len(self.observed)
        tare = {"columns": np.ones((n, 1)), "column_names": ("tare",)}
        return replace(super().data, **tare, column_deviation=np.array([self.known]))


class Straight(Problem):
    """A line through zero, of a slope [N]."""

    def predicted(self, values: Array) -> list[Array]:
        return [values[0] * ALONG]


def test_least_absolute_differences_bear_outliers_in_their_tare(case: Case) -> None:
    """Line and tare are those of linear programming; the mean difference is as small."""
    rng = np.random.default_rng(8)
    observed = 400.0 * ALONG + 50.0 + rng.normal(0.0, 1.0, len(ALONG))
    observed[[2, 5, 8]] += (90.0, 60.0, 75.0)
    count = len(ALONG)
    forms = np.hstack([ALONG[:, None], np.ones((count, 1)), np.eye(count), -np.eye(count)])
    cost = np.append([0.0, 0.0], np.ones(2 * count))
    ends = [(None, None)] * 2 + [(0.0, None)] * (2 * count)
    least = linprog(cost, A_eq=forms, b_eq=observed, bounds=ends)
    unknowns = sought(case, {P1: Unknown("0 N", "1 kN", start="900 N")})
    problem = Straight(case, unknowns, (Tared(observed, 1.0),))
    fit = search_absolute(problem, problem.start)
    assert fit.values == pytest.approx(least.x[:1], abs=1.0)
    assert fit.merit == pytest.approx(least.fun / count, rel=2e-3)
    there = replace(fit, values=least.x[:1], predicted=problem.predicted(least.x[:1]))
    sure = certainty(problem, there, absolute=True)
    left = np.sort(np.abs(observed - forms[:, :2] @ least.x[:2]))[2:]
    assert sure.birge == pytest.approx(np.median(left) / QUARTILE, rel=0.05)


def test_what_is_known_of_a_tare_counts_beside_least_absolute_differences(case: Case) -> None:
    """Half of its square, as one of the rows' differences does; another method finds the same."""
    rng = np.random.default_rng(8)
    observed = 400.0 * ALONG + 50.0 + rng.normal(0.0, 1.0, len(ALONG))
    observed[[2, 5, 8]] += (90.0, 60.0, 75.0)

    def mean(both: Array) -> float:
        left = np.abs(observed - both[0] * ALONG - both[1]).sum()
        return float(left + 0.5 * (both[1] / 3.0) ** 2) / len(ALONG)

    best = minimize(mean, [400.0, 40.0], method="Nelder-Mead", tol=1e-9)
    unknowns = sought(case, {P1: Unknown("0 N", "1 kN", start="900 N")})
    problem = Straight(case, unknowns, (Tared(observed, 1.0, known=3.0),))
    fit = search_absolute(problem, problem.start)
    assert best.x[1] < 45.0
    assert fit.merit == pytest.approx(best.fun, rel=2e-3)


@dataclass(frozen=True, eq=False)
class TaredDecay(Decay, Tared):
    """The same with a tare."""


def test_residuals_beside_least_absolute_differences_have_the_tare_of_these(case: Case) -> None:
    asked = {P1: Unknown("1 N", "1 kN", start="500 N"), P2: Unknown("20 N", "600 N", start="100 N")}
    observed = _decaying(400.0, 0.8) + np.random.default_rng(5).normal(0.0, 2.0, len(ALONG))
    observed[[3, 7]] += (90.0, 90.0)
    found = identify(case, asked, [TaredDecay(observed, 2.0)], minimise="absolute", workers=1)
    (residual,) = found.explained.residuals
    assert np.abs(residual).mean() / 2.0 == pytest.approx(found.explained.fit.absolute, rel=1e-3)


def test_points_are_not_far_off_where_the_others_are_as_far(case: Case) -> None:
    """A stated noise that is a tenth of the true one."""
    asked = {P1: Unknown("1 N", "1 kN", start="500 N"), P2: Unknown("20 N", "600 N", start="100 N")}
    observed = _decaying(400.0, 0.8) + np.random.default_rng(5).normal(0.0, 2.0, len(ALONG))
    found = identify(case, asked, [Decay(observed, 0.2)], minimise="absolute", workers=1)
    assert np.abs(found.explained.residuals[0]).max() > 5.0 * 0.2
    assert not [
        line for line in found.verdict if line.startswith("points that differ by more than")
    ]


class Waved(Problem):
    """A line through zero and a wave, of two unknowns [N]."""

    def predicted(self, values: Array) -> list[Array]:
        return [values[0] * MANY + values[1] * np.sin(2.0 * MANY)]


def test_least_absolute_differences_are_as_near_beside_large_outliers(case: Case) -> None:
    """Of which 5 in 24 points are some 2000 times the noise: values of linear programming, within a
    part of the interval."""
    rng, count, away = np.random.default_rng(1), len(MANY), []
    columns = np.column_stack([MANY, np.sin(2.0 * MANY), np.ones(count)])
    forms = np.hstack([columns, np.eye(count), -np.eye(count)])
    cost = np.append(np.zeros(3), np.ones(2 * count))
    ends = [(None, None)] * 3 + [(0.0, None)] * (2 * count)
    unknowns = {P1: Unknown("0 N", "1 kN", start="900 N"), P2: Unknown("0 N", "600 N")}
    for _ in range(12):
        observed = columns @ [400.0, 150.0, 50.0] + rng.normal(0.0, 1.0, count)
        observed[rng.choice(count, 5, replace=False)] += rng.normal(0.0, 2000.0, 5)
        least = linprog(cost, A_eq=forms, b_eq=observed, bounds=ends)
        problem = Waved(case, sought(case, unknowns), (Tared(observed, 1.0),))
        fit = search_absolute(problem, problem.start)
        deviation = certainty(problem, fit, absolute=True).deviation
        away.append(np.abs(fit.values - least.x[:2]) / deviation)
    assert np.max(away) < 1.0
    assert np.mean(away) < 0.3


def test_outliers_are_named_beside_least_absolute_differences(case: Case) -> None:
    """The farthest first; least squares, which share them out, name none."""
    asked = {P1: Unknown("1 N", "1 kN", start="500 N"), P2: Unknown("20 N", "600 N", start="100 N")}
    noise = np.random.default_rng(5).normal(0.0, 2.0, len(ALONG))
    observed = _decaying(400.0, 0.8) + noise
    observed[[3, 7]] += (60.0, -90.0)
    said = {}
    for how in ("squares", "absolute"):
        found = identify(case, asked, [Decay(observed, 2.0)], minimise=how, workers=1)
        said[how] = [
            line for line in found.verdict if line.startswith("points that differ by more than")
        ]
    assert not said["squares"]
    (line,) = said["absolute"]
    first, second = line.partition("others: ")[2].split("; ")[:2]
    assert first.startswith("made up at 7 by -9")
    assert second.startswith("made up at 3 by +")
