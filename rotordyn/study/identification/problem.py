"""Unknowns of a case against measurements: predictions, differences, derivatives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.errors import BearingError
from rotordyn.case.case import Case
from rotordyn.case.vary import vary
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.trial import Known, Trial
from rotordyn.study.identification.unknown import Sought
from rotordyn.study.identification.weighing import Weighing

Array = NDArray[np.float64]
STEP = 5e-3  # of finite differences, over the scale of an unknown
ALIKE = 1e-9  # of a speed


@dataclass
class Problem:
    """What is sought and what was measured; ``weights``: of rows besides the noise, by measurement;
    ``evaluations``: machines solved; ``why``: the last of them has no solution."""

    case: Case
    unknowns: tuple[Sought, ...]
    measurements: tuple[Measurement, ...]
    weights: tuple[Array | None, ...] = ()
    known: Known = field(default_factory=Known)
    evaluations: int = 0
    why: str = ""

    @cached_property
    def weighings(self) -> list[Weighing]:
        """Every measurement, weighed."""
        weights = self.weights or (None,) * len(self.measurements)
        pairs = zip(self.measurements, weights, strict=True)
        return [Weighing(each.data, weight) for each, weight in pairs]

    @property
    def blurred(self) -> list[Problem]:
        """The same against measurements seen less sharply, in turn; none where all are smooth."""
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
        """Where the search begins (p,)."""
        return np.array([each.start for each in self.unknowns])

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Ends of the unknowns (p,)."""
        low, high = ([getattr(u, end) for u in self.unknowns] for end in ("low", "high"))
        return np.array(low), np.array(high)

    @property
    def scale(self) -> Array:
        """Standard deviation of what is known of each unknown before (p,) [SI]."""
        return np.array([each.scale for each in self.unknowns])

    @property
    def count(self) -> int:
        """How many numbers were observed."""
        return sum(len(each.data.observed) for each in self.measurements)

    def machine(self, values: Array) -> Case:
        """The case with such values of the unknowns.

        Raises
        ------
        InvalidInput : they contradict one another
        """
        pairs = zip(self.unknowns, values.tolist(), strict=True)
        return vary(self.case, {k: v for u, value in pairs for k, v in u.changes(value).items()})

    def trial(self, values: Array) -> Trial:
        """The machine, asked for what measurements need."""
        self.evaluations += 1
        return Trial(self.machine(values), *self._asked, self.known)

    @cached_property
    def _asked(self) -> tuple[tuple[float, ...], dict[str, object], tuple[float, ...]]:
        """Speeds and analyses of all measurements; speeds of those along the axis."""
        solved: list[float] = []
        along: list[float] = []
        specs: dict[str, object] = {}
        for each in self.measurements:
            asked = each.analyses(self.case)
            specs |= asked
            (solved if asked else along).extend(each.speeds(self.case))
        return _distinct(solved), specs, _distinct(along)

    def predicted(self, values: Array) -> list[Array] | None:
        """Predictions of every measurement; None of a machine without a solution."""
        try:
            trial = self.trial(values)
            found = [each.predicted(trial) for each in self.measurements]
        except (InvalidInput, BearingError, NoSolution) as error:
            self.why = str(error)
            return None
        if all(np.isfinite(each).all() for each in found):
            return found
        pairs = zip(self.measurements, found, strict=True)
        lost = next(m for m, p in pairs if not np.isfinite(p).all())
        self.why = f"measurement {lost.data.name}: the machine has no such number"
        return None

    def rows(self, predicted: list[Array], values: Array) -> Array:
        """Weighed differences of all measurements, then of the priors."""
        pairs = zip(self.weighings, predicted, strict=True)
        rows = [each.weighed(each.data.observed - one) for each, one in pairs]
        return np.concatenate([*rows, self.prior_rows(values)])

    def prior_rows(self, values: Array) -> Array:
        """Differences from priors over their deviations (p,); 0 without one."""
        pairs = zip(self.unknowns, values.tolist(), strict=True)
        return np.array(
            [0.0 if u.deviation is None else (u.prior - v) / u.deviation for u, v in pairs]
        )

    @property
    def prior_slopes(self) -> Array:
        """Derivatives of these by the unknowns over their scale (p, p)."""
        return np.diag(
            [0.0 if u.deviation is None else -u.scale / u.deviation for u in self.unknowns]
        )

    def slopes(self, values: Array, at: list[Array], *, central: bool = False) -> list[Array]:
        """Derivatives of predictions by unknowns over their scale, (n, p) of each measurement.

        Towards the farther end, or on both sides where ``central`` and both have a solution; 0 of
        an unknown that has none on either side.
        """
        columns = [self._column(k, values, at, central=central) for k in range(len(values))]
        return [np.stack(parts, axis=1) for parts in zip(*columns, strict=True)]

    def _column(self, k: int, values: Array, at: list[Array], *, central: bool) -> list[Array]:
        """Derivatives of predictions by one unknown, each by steps of the size it asks for."""
        sizes = [getattr(each, "step", STEP) for each in self.measurements]
        found = {size: self._by_steps(k, values, at, size, central=central) for size in {*sizes}}
        return [found[size][place] for place, size in enumerate(sizes)]

    def _by_steps(
        self, k: int, values: Array, at: list[Array], size: float, *, central: bool
    ) -> list[Array]:
        found = []
        for step in self._steps(k, values, size):
            moved = values.copy()
            moved[k] += step * self.scale[k]
            there = self.predicted(moved)
            if there is not None:
                found.append((step, there))
                if not central:
                    break
        if not found:
            return [np.zeros_like(each) for each in at]
        if len(found) == 1:
            (step, there), before, base = found[0], at, 0.0
        else:
            (step, there), (base, before) = found
        return [(b - a) / (step - base) for a, b in zip(before, there, strict=True)]

    def _steps(self, k: int, values: Array, size: float) -> Iterator[float]:
        """Steps of a ``size`` that stay between the ends, the roomier side first."""
        low, high = (float(end[k]) for end in self.bounds)
        value, scale = float(values[k]), float(self.scale[k])
        for side in sorted((1.0, -1.0), key=lambda s: s * (2.0 * value - low - high)):
            room = (high - value if side > 0.0 else value - low) / scale
            if room > 0.1 * size:
                yield side * min(size, room)

    def weighed_slopes(self, slopes: list[Array]) -> Array:
        """Derivatives of the rows of all measurements, without priors."""
        pairs = zip(self.weighings, slopes, strict=True)
        return np.concatenate([each.weighed(-one) for each, one in pairs])


def _distinct(speeds: list[float]) -> tuple[float, ...]:
    """Speeds in order, each once."""
    found: list[float] = []
    for speed in sorted(speeds):
        if not found or speed - found[-1] > ALIKE * max(speed, 1.0):
            found.append(speed)
    return tuple(found)
