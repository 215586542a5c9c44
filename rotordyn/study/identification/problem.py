"""Least-squares problem of an identification: predictions, weighed differences, derivatives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from bearings.errors import BearingError
from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.case.vary import vary
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.trial import Known, Trial
from rotordyn.study.identification.unknown import Sought
from rotordyn.study.identification.weighing import Weighing

STEP = 5e-3  # of finite differences, over the scale of an unknown
ALIKE = 1e-9  # relative difference up to which speeds are equal


@dataclass
class Problem:
    """Unknowns of a case, and measurements.

    ``weights``: of the rows of each measurement, in addition to the noise; ``known``: shared stages
    of solved machines; ``evaluations``: number of machines solved; ``why``: reason why the last one
    has no solution."""

    case: Case
    unknowns: tuple[Sought, ...]
    measurements: tuple[Measurement, ...]
    weights: tuple[Array | None, ...] = ()
    known: Known = field(default_factory=Known)
    evaluations: int = 0
    why: str = ""

    @cached_property
    def weighings(self) -> list[Weighing]:
        """Weighing of every measurement."""
        weights = self.weights or (None,) * len(self.measurements)
        pairs = zip(self.measurements, weights, strict=True)
        return [Weighing(each.data, weight) for each, weight in pairs]

    @property
    def blurred(self) -> list[Problem]:
        """The same problem with smoothed measurements, smoothest first; empty if none can be."""
        stages = [getattr(each, "blurred", ()) for each in self.measurements]
        most = max(map(len, stages), default=0)
        return [
            replace(
                self,
                weights=(),
                evaluations=0,
                measurements=tuple(
                    stage[k - most] if len(stage) >= most - k else each
                    for each, stage in zip(self.measurements, stages, strict=True)
                ),
            )
            for k in range(most)
        ]

    @property
    def start(self) -> Array:
        """Start values of the unknowns (p,)."""
        return np.array([each.start for each in self.unknowns])

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper bounds of the unknowns, (p,) each."""
        low, high = ([getattr(u, end) for u in self.unknowns] for end in ("low", "high"))
        return np.array(low), np.array(high)

    @property
    def scale(self) -> Array:
        """Standard deviation of the prior knowledge of each unknown (p,) [SI]."""
        return np.array([each.scale for each in self.unknowns])

    @property
    def count(self) -> int:
        """Number of observed values."""
        return sum(len(each.data.observed) for each in self.measurements)

    def machine(self, values: Array) -> Case:
        """The case with the given values of the unknowns.

        Raises
        ------
        InvalidInput : the values contradict one another
        """
        pairs = zip(self.unknowns, values.tolist(), strict=True)
        return vary(self.case, {k: v for u, value in pairs for k, v in u.changes(value).items()})

    def trial(self, values: Array) -> Trial:
        """Trial machine with the given values, for the analyses and speeds of the measurements."""
        self.evaluations += 1
        return Trial(self.machine(values), *self._asked, self.known)

    @cached_property
    def _asked(self) -> tuple[tuple[float, ...], dict[str, object], tuple[float, ...]]:
        """Speeds and analyses of all measurements; speeds of the axial ones."""
        solved: list[float] = []
        along: list[float] = []
        specs: dict[str, object] = {}
        for each in self.measurements:
            asked = each.analyses(self.case)
            specs |= asked
            (solved if asked else along).extend(each.speeds(self.case))
        return _distinct(solved), specs, _distinct(along)

    def predicted(self, values: Array) -> list[Array] | None:
        """Predictions of every measurement; None if the machine has no solution."""
        try:
            trial = self.trial(values)
            predictions = [each.predicted(trial) for each in self.measurements]
        except (InvalidInput, BearingError, NoSolution) as error:
            self.why = str(error)
            return None
        if all(np.isfinite(each).all() for each in predictions):
            return predictions
        pairs = zip(self.measurements, predictions, strict=True)
        missing = next(m for m, p in pairs if not np.isfinite(p).all())
        self.why = f"measurement {missing.data.name}: the machine has no such number"
        return None

    def rows(self, predicted: list[Array], values: Array) -> Array:
        """Residual rows: weighed differences of all measurements, then of the priors."""
        pairs = zip(self.weighings, predicted, strict=True)
        rows = [each.weighed(each.data.observed - one) for each, one in pairs]
        return np.concatenate([*rows, self.prior_rows(values)])

    def prior_rows(self, values: Array) -> Array:
        """Differences from the priors over their deviations (p,); 0 without a prior."""
        pairs = zip(self.unknowns, values.tolist(), strict=True)
        return np.array(
            [0.0 if u.deviation is None else (u.prior - v) / u.deviation for u, v in pairs]
        )

    @property
    def prior_slopes(self) -> Array:
        """Derivatives of ``prior_rows`` by the unknowns over their scale (p, p)."""
        return np.diag(
            [0.0 if u.deviation is None else -u.scale / u.deviation for u in self.unknowns]
        )

    def slopes(self, values: Array, at: list[Array], *, central: bool = False) -> list[Array]:
        """Derivatives of predictions by unknowns over their scale, (n, p) of each measurement.

        One-sided differences towards the farther bound, or ``central`` ones where both sides have a
        solution; 0 if neither has.
        """
        columns = [self._column(k, values, at, central=central) for k in range(len(values))]
        return [np.stack(parts, axis=1) for parts in zip(*columns, strict=True)]

    def _column(self, k: int, values: Array, at: list[Array], *, central: bool) -> list[Array]:
        """Derivatives of predictions by unknown ``k``, with the step of each measurement."""
        sizes = [getattr(each, "step", STEP) for each in self.measurements]
        by_size = {size: self._by_steps(k, values, at, size, central=central) for size in {*sizes}}
        return [by_size[size][index] for index, size in enumerate(sizes)]

    def _by_steps(
        self, k: int, values: Array, at: list[Array], size: float, *, central: bool
    ) -> list[Array]:
        evaluated = []
        for step in self._steps(k, values, size):
            shifted = values.copy()
            shifted[k] += step * self.scale[k]
            there = self.predicted(shifted)
            if there is not None:
                evaluated.append((step, there))
                if not central:
                    break
        if not evaluated:
            return [np.zeros_like(each) for each in at]
        if len(evaluated) == 1:
            (step, there), before, base = evaluated[0], at, 0.0
        else:
            (step, there), (base, before) = evaluated
        return [(b - a) / (step - base) for a, b in zip(before, there, strict=True)]

    def _steps(self, k: int, values: Array, size: float) -> Iterator[float]:
        """Yield steps of a ``size`` within the bounds, towards the farther bound first."""
        low, high = (float(end[k]) for end in self.bounds)
        value, scale = float(values[k]), float(self.scale[k])
        for side in sorted((1.0, -1.0), key=lambda s: s * (2.0 * value - low - high)):
            room = (high - value if side > 0.0 else value - low) / scale
            if room > 0.1 * size:
                yield side * min(size, room)

    def weighed_slopes(self, slopes: list[Array]) -> Array:
        """Derivatives of the residual rows of all measurements, without those of the priors."""
        pairs = zip(self.weighings, slopes, strict=True)
        return np.concatenate([each.weighed(-one) for each, one in pairs])


def _distinct(speeds: list[float]) -> tuple[float, ...]:
    """Distinct speeds, ascending."""
    distinct: list[float] = []
    for speed in sorted(speeds):
        if not distinct or speed - distinct[-1] > ALIKE * max(speed, 1.0):
            distinct.append(speed)
    return tuple(distinct)
