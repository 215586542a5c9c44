"""Whether a model suffices: by a stated mean difference, or by χ² against the noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput
from rotordyn.study.identification.certainty import Certainty
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.problem import Problem
from rotordyn.study.optimum.criterion import amount
from rotordyn.units import parse_unit

UNLIKELY = 1e-3  # probability of residuals as large by noise, below which a model is rejected
LEAST = 1e-12  # least probability printed


@dataclass(frozen=True, slots=True)
class FitCriterion:
    """Largest mean absolute difference ``most``, of measurements in ``unit``; None: χ² test."""

    unit: str
    most: float | None = None

    @classmethod
    def of(cls, given: str | None, measurements: Sequence[Measurement]) -> FitCriterion:
        """Read a criterion and check it against the measurements.

        Raises
        ------
        InvalidInput : it is not a value in the unit of a measurement
        """
        units = list(dict.fromkeys(each.data.unit for each in measurements))
        if given is None:
            return cls(units[0])
        unit = str(given).strip().partition(" ")[2]
        kind = parse_unit(unit).dimension if unit else None
        like = next((u for u in units if parse_unit(u).dimension == kind), None)
        if like is None:
            raise InvalidInput(
                f"criterion: given {given}; allowed: a mean difference in {' or '.join(units)}"
            )
        most = amount(given, like)
        if not most > 0.0:
            raise InvalidInput(f"criterion: given {given}; allowed: above 0 {like}")
        return cls(like, most)

    def mean_difference(self, problem: Problem, residuals: Sequence[Array]) -> float:
        """Mean absolute difference of all measurements in the unit."""
        return float(np.abs(np.concatenate([*self._of_unit(problem, residuals)])).mean())

    def _of_unit(self, problem: Problem, residuals: Sequence[Array]) -> list[Array]:
        pairs = zip(problem.measurements, residuals, strict=True)
        return [part * m.data.factor for m, part in pairs if m.data.unit == self.unit]

    def excess(self, problem: Problem, residuals: Sequence[Array], sure: Certainty) -> list[str]:
        """Sentences on why the model does not suffice; empty if it does."""
        mean = self.mean_difference(problem, residuals)
        if self.most is not None:
            if mean <= self.most:
                return []
            words = f"differs by {mean:.3g} {self.unit} in the mean, allowed {self.most:.3g}"
            return [words + self._worst(problem, residuals, mean)]
        if sure.degrees < 1 or _by_noise(sure) > UNLIKELY:
            return []
        words = f"differs by {_of_noise(sure)}: {_test(sure)}"
        return [words + self._worst(problem, residuals, mean)]

    def _worst(self, problem: Problem, residuals: Sequence[Array], mean: float) -> str:
        """Text on the curve that differs most; empty if none is well above the mean."""
        means: dict[str, list[float]] = {}
        for each, part in zip(problem.measurements, residuals, strict=True):
            if each.data.unit == self.unit:
                for series, value in zip(each.data.series, part, strict=True):
                    words = f"{each.data.name} {series}".strip()
                    means.setdefault(words, []).append(abs(value) * each.data.factor)
        worst = max(means, key=lambda key: float(np.mean(means[key])))
        size = float(np.mean(means[worst]))
        return f" (most on {worst}: {size:.3g})" if size > mean * 1.25 else ""

    def kept(self, residual: float, sure: Certainty) -> str:
        """Sentence on why the model suffices."""
        if self.most is not None:
            reason = f"allowed {self.most:.3g}"
        elif sure.degrees < 1:
            reason = "no more points than values: no degree of freedom is left to check it"
        else:
            reason = f"{_of_noise(sure)} in the root mean square, as noise may cause: {_test(sure)}"
        return f"sufficient: differs by {residual:.3g} {self.unit} in the mean, {reason}"


def _of_noise(sure: Certainty) -> str:
    """Text of the root mean square of the differences over the stated noise."""
    times = f"{np.sqrt(sure.reduced):.2g}"
    return "as much as the stated noise" if times == "1" else f"{times} times the stated noise"


def _by_noise(sure: Certainty) -> float:
    """Probability that noise alone gives residuals as large (χ² test)."""
    from scipy.stats import chi2

    return float(chi2.sf(sure.reduced * sure.degrees, sure.degrees))


def _test(sure: Certainty) -> str:
    """Text of χ², degrees of freedom and its probability."""
    chance, freedom = _by_noise(sure), "degree" if sure.degrees == 1 else "degrees"
    share = f"p {chance:.2g}" if chance > LEAST else f"p below {LEAST:g}"
    squares = sure.reduced * sure.degrees
    return f"χ² {squares:.4g} at {sure.degrees} {freedom} of freedom, {share}"
