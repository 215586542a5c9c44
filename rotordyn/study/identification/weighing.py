"""Differences of prediction and observation, weighed by noise, without nuisances of the rig.

Tare and drift are linear: for every prediction the best ones follow by linear least squares, and
their contribution is projected out (variable projection: G. Golub and V. Pereyra, SIAM J. Numer.
Anal. 10, 1973). A prior of a nuisance is an additional row that observes it to be zero.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rotordyn.arrays import Array
from rotordyn.study.identification.measurement import Data

ROUNDS, SAME = 100, 1e-4  # reweightings at most; change of differences over noise that ends them
FLOOR = 0.05  # difference over noise below which the weight grows no further


@dataclass(frozen=True, eq=False)
class Weighing:
    """Rows of a least-squares problem of one measurement; ``weight`` (n,): additional weights."""

    data: Data
    weight: Array | None = None

    @property
    def _rows(self) -> Array:
        by_noise = 1.0 / self.data.deviation
        return by_noise if self.weight is None else by_noise * self.weight

    @cached_property
    def _columns(self) -> Array:
        """Weighed columns above the rows of their priors (n + k, k)."""
        prior = np.diag(1.0 / self.data.column_deviation)  # 0 where nothing is known
        return np.concatenate([self._rows[:, None] * self.data.columns, prior])

    @cached_property
    def _basis(self) -> Array:
        return np.asarray(np.linalg.qr(self._columns)[0])

    def weighed(self, difference: Array) -> Array:
        """Weigh differences (n,) or (n, p) and project nuisances out: rows (n + k, …)."""
        k = len(self.data.column_deviation)
        rows = (difference.T * self._rows).T
        rows = np.concatenate([rows, np.zeros((k, *difference.shape[1:]))])
        if not k:
            return rows
        return np.asarray(rows - self._basis @ (self._basis.T @ rows))

    def nuisances(self, predicted: Array) -> Array:
        """Best nuisances (tare, drift) (k,) [SI] for a prediction."""
        if not self.data.column_names:
            return np.empty(0)
        target = self._rows * (self.data.observed - predicted)
        target = np.concatenate([target, np.zeros(len(self.data.column_names))])
        return np.asarray(np.linalg.lstsq(self._columns, target, rcond=None)[0])

    def anew(self, predicted: Array) -> Weighing:
        """Reweigh the rows so that the nuisances minimise the mean absolute difference."""
        size = np.abs(self.residual(predicted)) / self.data.deviation
        for _ in range(ROUNDS):
            reweighed = replace(self, weight=1.0 / np.sqrt(np.maximum(size, FLOOR)))
            before, size = size, np.abs(reweighed.residual(predicted)) / self.data.deviation
            if np.abs(size - before).max() < SAME:
                break
        return reweighed

    def beside(self, predicted: Array) -> float:
        """Sum of squares of the prior rows of the nuisances."""
        scaled = self.nuisances(predicted) / self.data.column_deviation
        return float(scaled @ scaled)

    def residual(self, predicted: Array) -> Array:
        """Observed values less prediction and nuisances (n,) [SI]."""
        explained = self.data.columns @ self.nuisances(predicted)
        return np.asarray(self.data.observed - predicted - explained)
