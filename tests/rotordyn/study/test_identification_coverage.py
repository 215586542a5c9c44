"""How often 95 % intervals hold the true values of a linear model."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.stats import norm, t

import rotordyn
from rotordyn import Predicted, Unknown
from rotordyn.results.display import number
from rotordyn.study.identification import prediction
from rotordyn.study.identification.certainty import QUARTILE, certainty
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit, search, search_absolute
from rotordyn.study.identification.searches import Search, best_of
from rotordyn.study.identification.summary import decimals
from rotordyn.study.identification.unknown import sought
from tests.rotordyn.study.axial_twin import FRONT, REAR, Array
from tests.rotordyn.study.made_up import MadeUp

DRAWS = 600
TRUE = np.array([500.0, 600.0])
PRELOADS = {path + "spring.preload": Unknown("0 N", "1 kN") for path in (FRONT, REAR)}
CASE = rotordyn.load("mfw2310_identification")
UNKNOWNS = sought(CASE, PRELOADS)


@dataclass
class Linear(Problem):
    """Measurements that are ``forms`` (n, p) times the unknowns."""

    forms: Array = field(default_factory=lambda: np.empty((0, 0)))

    def predicted(self, values: Array) -> list[Array]:
        return [self.forms @ values]


@pytest.mark.parametrize(
    ("degrees", "noise"), [(1, 1.0), (2, 1.0), (8, 1.0), (100, 1.0), (8, 2.0), (100, 5.0)]
)
def test_intervals_cover_as_they_say(degrees: int, noise: float) -> None:
    """Whether the true ``noise`` is that stated, 1 N, or more."""
    rng = np.random.default_rng(degrees)
    forms = rng.normal(size=(degrees + 2, 2))
    held = []
    for _ in range(DRAWS):
        y = forms @ TRUE + noise * rng.normal(size=len(forms))
        values = np.linalg.lstsq(forms, y, rcond=None)[0]
        problem = Linear(CASE, UNKNOWNS, (MadeUp(y, 1.0),), forms=forms)
        predicted = problem.predicted(values)
        rows = problem.rows(predicted, values)
        sure = certainty(problem, Fit(values, float(rows @ rows), predicted))
        assert sure.degrees == degrees
        held.append((sure.interval[:, 0] <= TRUE) & (sure.interval[:, 1] >= TRUE))
    assert 0.92 < np.mean(held) < 0.98


@pytest.mark.few(2)
@pytest.mark.parametrize(("degrees", "absolute"), [(1, False), (8, True), (1, True), (8, False)])
def test_intervals_do_not_jump(degrees: int, *, absolute: bool) -> None:
    """Over the size of residuals: normal at those of the stated noise, Student's t well above."""
    forms = np.random.default_rng(2).normal(size=(degrees + 2, 2))
    apart = np.linalg.svd(forms)[0][:, -1]  # what no values explain
    apart /= np.median(np.sort(np.abs(apart))[2:]) / QUARTILE if absolute else degrees**-0.5
    scale = np.geomspace(0.5, 20.0, 800)
    half, quantile = [], []
    for size in scale:
        y = forms @ TRUE + size * apart
        problem = Linear(CASE, UNKNOWNS, (MadeUp(y, 1.0),), forms=forms)
        predicted = problem.predicted(TRUE)
        rows = problem.rows(predicted, TRUE)
        sure = certainty(problem, Fit(TRUE, float(rows @ rows), predicted), absolute=absolute)
        half.append(float(sure.quantile * sure.birge))
        quantile.append(sure.quantile)
    assert quantile[0] == pytest.approx(norm.ppf(0.975))
    assert quantile[-1] == pytest.approx(t.ppf(0.975, degrees))
    assert np.diff(half).min() >= 0.0
    assert (np.diff(half) / half[1:]).max() < 0.05


def test_a_value_on_a_bound_makes_no_residual_0() -> None:
    """Of three residuals beside one free value two count."""
    values = np.array([500.0, 1000.0])
    y = np.array([500.0, 1.0, 3.0])
    problem = Linear(CASE, UNKNOWNS, (MadeUp(y, 1.0),), forms=np.diag([1.0, 0.0, 0.0])[:, :2])
    fit = Fit(values, 10.0, problem.predicted(values))
    sure = certainty(problem, fit, absolute=True)
    assert sure.words[1] == "on a bound"
    assert sure.birge == pytest.approx(2.0 / QUARTILE)


def test_a_value_on_a_bound_takes_the_interval_of_what_follows_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """By 0.01 N over its whole range it does not, beside ± 2 N; by 1 N it does."""
    values = np.array([500.0, 1000.0])
    problem = Linear(CASE, UNKNOWNS, (MadeUp(values, 1.0),), forms=np.eye(2))
    sure = certainty(problem, Fit(values, 0.0, problem.predicted(values)))

    def numbers(_: Problem, at: Array, *__: object) -> dict[str, tuple[str, float, None]]:
        return {f"{by:g}": ("N", float(at @ [1.0, by]), None) for by in (1e-5, 1e-3)}

    monkeypatch.setattr(prediction, "numbers", numbers)
    hardly, much = prediction.predictions(problem, sure, (Predicted("preload: sum"),))
    assert hardly.bound == ()
    assert 0.5 * (hardly.high - hardly.low) == pytest.approx(1.96, rel=1e-3)
    assert much.bound == ("rear spring preload",)
    assert np.isnan([much.low, much.high]).all()


@pytest.mark.parametrize(
    ("ends", "value", "printed"),
    [
        ((85.82, 86.85), 86.339, "86.34"),
        ((np.nan, np.nan), 86.339, "86.34"),
        ((np.nan, np.nan), 2190.4, "2190"),
        ((np.nan, np.nan), 0.0123456, "0.01235"),
        ((0.0, 0.0), 0.0, "0"),
    ],
)
def test_digits(ends: tuple[float, float], value: float, printed: str) -> None:
    assert number(value, decimals(*ends, value)) == printed


@pytest.mark.few(1)
@pytest.mark.parametrize("outliers", [0.06, 0.0])
def test_intervals_of_least_absolute_differences(outliers: float) -> None:
    """In normal noise, and beside outliers of 25 times it: as wide as values scatter."""
    rng = np.random.default_rng(4)
    forms = rng.normal(size=(60, 2))
    held, half, off = [], [], []
    for _ in range(300):
        noise = rng.normal(size=60)
        noise[rng.random(60) < outliers] += 25.0 * rng.choice((-1.0, 1.0))
        y = forms @ TRUE + noise
        values = _least_absolute(forms, y)
        problem = Linear(CASE, UNKNOWNS, (MadeUp(y, 1.0),), forms=forms)
        predicted = problem.predicted(values)
        rows = problem.rows(predicted, values)
        sure = certainty(problem, Fit(values, float(rows @ rows), predicted), absolute=True)
        held.append((sure.interval[:, 0] <= TRUE) & (sure.interval[:, 1] >= TRUE))
        half.append(0.5 * np.ptp(sure.interval, axis=1))
        off.append(values - TRUE)
    assert 0.92 < np.mean(held) < 0.99
    assert np.mean(half) == pytest.approx(1.96 * np.std(off), rel=0.25)


def _least_absolute(forms: Array, y: Array) -> Array:
    """Values of least absolute differences, by linear programming."""
    n, p = forms.shape
    cost = np.concatenate([np.zeros(p), np.ones(2 * n)])
    whole = np.hstack([forms, np.eye(n), -np.eye(n)])
    ends = [(None, None)] * p + [(0.0, None)] * (2 * n)
    return np.asarray(linprog(cost, A_eq=whole, b_eq=y, bounds=ends).x[:p])


class Plateau(Problem):
    """Six numbers that rise from 0 at 300 N to 5 N, and one that falls from 25 N there to 0 at
    800 N: the sum of squares is least at 800 N, that of absolute values about 300 N."""

    def predicted(self, values: Array) -> list[Array]:
        (load,) = values
        rising = 5.0 * (1.0 - np.exp(-(((load - 300.0) / 100.0) ** 2)))
        return [np.append(np.full(6, rising), 0.05 * (800.0 - load))]


def test_least_absolute_differences_are_sought_from_the_start_too() -> None:
    """Not from the least squares alone; of several searches it is the one of
    which the mean is least."""
    unknowns = sought(CASE, {FRONT + "spring.preload": Unknown("0 N", "1 kN", start="350 N")})
    problem = Plateau(CASE, unknowns, (MadeUp(np.zeros(7), 1.0),))
    squares, absolute = search(problem, problem.start), search_absolute(problem, problem.start)
    assert squares.values == pytest.approx(800.0, abs=5.0)
    assert absolute.values == pytest.approx(308.0, abs=5.0)
    mean = np.abs(problem.predicted(absolute.values)[0]).mean()
    assert absolute.merit == pytest.approx(mean)
    found = [
        Search((0, k), tuple(fit.values), fit.cost, merit)
        for k, (fit, merit) in enumerate(((squares, 30.0 / 7.0), (absolute, absolute.merit)))
    ]
    assert squares.cost < absolute.cost
    assert best_of(found, 0) is found[1]
