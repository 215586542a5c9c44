"""Differences of prediction and observation, weighed by noise, without what the rig may add.

Tare and drift are linear: for every prediction the best ones follow by linear least squares, and
what they take up is projected out (variable projection: G. Golub and V. Pereyra, SIAM J. Numer.
Anal. 10, 1973). A prior of a nuisance is one more row that observes it to be zero.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rotordyn.study.identification.measurement import Data

Array = NDArray[np.float64]
ROUNDS, SAME = 100, 1e-4  # of weighing anew; change of differences over noise that ends them
FLOOR = 0.05  # least difference over noise that weighs no more


@dataclass(frozen=True, eq=False)
class Weighing:
    """One measurement as rows of a least-squares problem; ``weight`` (n,): of the rows besides."""

    data: Data
    weight: Array | None = None

    @property
    def _rows(self) -> Array:
        own = 1.0 / self.data.deviation
        return own if self.weight is None else own * self.weight

    @cached_property
    def _columns(self) -> Array:
        """Weighed columns above the rows of their priors (n + k, k)."""
        prior = np.diag(1.0 / self.data.column_deviation)  # 0 where nothing is known
        return np.concatenate([self._rows[:, None] * self.data.columns, prior])

    @cached_property
    def _basis(self) -> Array:
        return np.asarray(np.linalg.qr(self._columns)[0])

    def weighed(self, difference: Array) -> Array:
        """Differences (n,) or (n, p) as rows (n + k, …) without what nuisances take up."""
        k = len(self.data.column_deviation)
        rows = (difference.T * self._rows).T
        rows = np.concatenate([rows, np.zeros((k, *difference.shape[1:]))])
        if not k:
            return rows
        return np.asarray(rows - self._basis @ (self._basis.T @ rows))

    def nuisances(self, predicted: Array) -> Array:
        """Best tare and drift (k,) [SI] for a prediction."""
        if not self.data.column_names:
            return np.empty(0)
        target = self._rows * (self.data.observed - predicted)
        target = np.concatenate([target, np.zeros(len(self.data.column_names))])
        return np.asarray(np.linalg.lstsq(self._columns, target, rcond=None)[0])

    def anew(self, predicted: Array) -> Weighing:
        """Rows weighed by their differences so that nuisances make the mean absolute one least."""
        size = np.abs(self.residual(predicted)) / self.data.deviation
        for _ in range(ROUNDS):
            found = replace(self, weight=1.0 / np.sqrt(np.maximum(size, FLOOR)))
            before, size = size, np.abs(found.residual(predicted)) / self.data.deviation
            if np.abs(size - before).max() < SAME:
                break
        return found

    def beside(self, predicted: Array) -> float:
        """Sum of squares of the rows of the priors of nuisances."""
        known = self.nuisances(predicted) / self.data.column_deviation
        return float(known @ known)

    def residual(self, predicted: Array) -> Array:
        """What of the observation neither machine nor nuisances explain (n,) [SI]."""
        explained = self.data.columns @ self.nuisances(predicted)
        return np.asarray(self.data.observed - predicted - explained)
