"""When a model suffices: a mean difference that is stated, or one as large as the noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.study.identification.certainty import Certainty
from rotordyn.study.identification.measurement import Measurement
from rotordyn.study.identification.problem import Problem
from rotordyn.study.optimum.criterion import amount
from rotordyn.units import parse_unit

Array = NDArray[np.float64]
UNLIKELY = 1e-3  # probability of residuals as large, by noise alone
LEAST = 1e-12  # probability that is printed


@dataclass(frozen=True, slots=True)
class FitCriterion:
    """``most`` mean absolute difference in ``unit``, over all measurements in it; None: by χ²."""

    unit: str
    most: float | None = None

    @classmethod
    def of(cls, given: str | None, measurements: Sequence[Measurement]) -> FitCriterion:
        """A criterion as written, held against the measurements.

        Raises
        ------
        InvalidInput : no amount in a unit of any measurement
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
        """Mean absolute difference in the unit."""
        return float(np.abs(np.concatenate([*self._of_unit(problem, residuals)])).mean())

    def _of_unit(self, problem: Problem, residuals: Sequence[Array]) -> list[Array]:
        pairs = zip(problem.measurements, residuals, strict=True)
        return [part * m.data.factor for m, part in pairs if m.data.unit == self.unit]

    def excess(self, problem: Problem, residuals: Sequence[Array], sure: Certainty) -> list[str]:
        """Why the model does not suffice, empty where it does."""
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
        """The curve that differs most, where it stands out."""
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
        """That it suffices, in words."""
        if self.most is not None:
            held = f"allowed {self.most:.3g}"
        elif sure.degrees < 1:
            held = "no more points than values: nothing is left to check it by"
        else:
            held = (
                f"{_of_noise(sure)} in the root mean square, as noise alone may be: {_test(sure)}"
            )
        return f"sufficient: differs by {residual:.3g} {self.unit} in the mean, {held}"


def _of_noise(sure: Certainty) -> str:
    """The root mean square of the differences over the stated noise, in words."""
    times = f"{np.sqrt(sure.reduced):.2g}"
    return "as much as the stated noise" if times == "1" else f"{times} times the stated noise"


def _by_noise(sure: Certainty) -> float:
    """Probability of residuals as large, by noise alone."""
    from scipy.stats import chi2

    return float(chi2.sf(sure.reduced * sure.degrees, sure.degrees))


def _test(sure: Certainty) -> str:
    """χ², degrees of freedom and the probability of as much."""
    chance, freedom = _by_noise(sure), "degree" if sure.degrees == 1 else "degrees"
    share = f"p {chance:.2g}" if chance > LEAST else f"p below {LEAST:g}"
    squares = sure.reduced * sure.degrees
    return f"χ² {squares:.4g} at {sure.degrees} {freedom} of freedom, {share}"
