"""How often 95 % intervals hold the true values of a linear model."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest
from scipy.optimize import linprog

import rotordyn
from rotordyn import Unknown
from rotordyn.study.identification.certainty import certainty
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit
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


@pytest.mark.parametrize("outliers", [0.0, 0.06])
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
