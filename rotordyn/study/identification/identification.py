"""Result of an identification: fitted models ranked by evidence, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bearings.arguments import typed
from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.description import quantity_of
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.identification.certainty import (
    BY_ITS_PRIOR,
    IDENTIFIED,
    ON_A_BOUND,
    UNFINISHED,
    UNIDENTIFIABLE,
    Certainty,
    inseparable,
)
from rotordyn.study.identification.criterion import FitCriterion
from rotordyn.study.identification.measurement import Beside
from rotordyn.study.identification.models import Model
from rotordyn.study.identification.outliers import outliers
from rotordyn.study.identification.prediction import Prediction
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.profile import Profile, remarks
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.searches import Search

if TYPE_CHECKING:
    import xarray as xr

SURVIVES = 6.0  # difference of BIC up to which a model is not ruled out
INSUFFICIENT = "insufficient"
UNDECIDED = "undecidable"


@dataclass(frozen=True, eq=False)
class Explained:
    """One fitted model: ``fit``, uncertainty ``sure`` of its values, searches from all starts."""

    model: Model
    problem: Problem
    fit: Fit
    sure: Certainty
    searches: tuple[Search, ...]

    @property
    def name(self) -> str:
        """Name of the model."""
        return self.model.name

    @property
    def held(self) -> dict[str, Any]:
        """Values that the model holds fixed, by path, as files write them."""
        return {path: _written(self.problem.case, path) for path in self.model.holds}

    @property
    def information(self) -> float:
        """BIC: χ² of measurements and priors + unknowns · ln of observations (G. Schwarz, Ann.
        Statist. 6, 1978)."""
        return self.fit.cost + len(self.problem.unknowns) * float(np.log(self.problem.count))

    @property
    def residuals(self) -> list[Array]:
        """Residuals (n,) of every measurement: observed less machine, tare and drift [SI]."""
        pairs = [*zip(self.problem.weighings, self.fit.predicted, strict=True)]
        if self.fit.absolute is not None:
            pairs = [(each.anew(one), one) for each, one in pairs]
        return [each.residual(one) for each, one in pairs]

    @property
    def case(self) -> Case:
        """Case of the fitted machine."""
        return self.problem.machine(self.fit.values)

    @cached_property
    def beside(self) -> list[Beside]:
        """Further comparisons of measurements with the machine, such as paired modes."""
        asked = [m for m in self.problem.measurements if hasattr(m, "beside")]
        if not asked:
            return []
        trial = self.problem.trial(self.fit.values)
        return [each.beside(trial) for each in asked]

    @property
    def on_bounds(self) -> list[str]:
        """Names of the unknowns on a bound."""
        return [n for n, w in self.named if w == ON_A_BOUND]

    @property
    def at_limits(self) -> list[str]:
        """Names of the unknowns on a bound that is the physical limit of the quantity, 0."""
        triples = zip(self.problem.unknowns, self.fit.values, self.sure.words, strict=True)
        return [
            each.name
            for each, value, word in triples
            if word == ON_A_BOUND and each.limited and value < 0.5 * each.high
        ]

    @property
    def named(self) -> list[tuple[str, str]]:
        """Name and verdict of every unknown."""
        pairs = zip(self.problem.unknowns, self.sure.words, strict=True)
        return [(unknown.name, word) for unknown, word in pairs]


@dataclass(frozen=True, eq=False)
class Identification:
    """Result of an identification.

    ``models`` by evidence, the best first; ``predictions`` and ``profiles`` (by path) of the best;
    ``failed``: reasons by name of models without a solution; ``stopped``: interrupted before the
    end; ``left_out``: variants of the case, ignored.
    """

    name: str
    title: str
    models: tuple[Explained, ...]
    criterion: FitCriterion
    predictions: tuple[Prediction, ...] = ()
    profiles: Mapping[str, Profile] = field(default_factory=dict)
    failed: Mapping[str, str] = field(default_factory=dict)
    stopped: bool = False
    left_out: tuple[str, ...] = ()

    @property
    def order(self) -> list[Explained]:
        """Models in the order of the request."""
        return sorted(self.models, key=lambda each: each.searches[0].number)

    @property
    def explained(self) -> Explained:
        """The best model."""
        return self.models[0]

    @property
    def best(self) -> Case:
        """Case of the identified machine."""
        return self.explained.case

    @property
    def values(self) -> dict[str, float]:
        """Identified values by path [SI]."""
        best = self.explained
        pairs = zip(best.problem.unknowns, best.fit.values.tolist(), strict=True)
        return {unknown.path: value for unknown, value in pairs}

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """95 % intervals by path [SI]; both ends are the value if it is on a bound."""
        best = self.explained
        pairs = zip(best.problem.unknowns, best.sure.interval.tolist(), strict=True)
        return {unknown.path: (ends[0], ends[1]) for unknown, ends in pairs}

    @cached_property
    def evidence(self) -> list[float]:
        """BIC of every model less that of the best; χ² is divided by the reduced χ² of the best
        model where that is above 1 (K. Burnham and D. Anderson, 2002, 2.5)."""
        best = self.models[0]
        reduced = max(1.0, best.sure.reduced)
        penalty = np.log(best.problem.count)

        def scaled(model: Explained) -> float:
            return model.fit.cost / reduced + len(model.problem.unknowns) * float(penalty)

        return [scaled(each) - scaled(best) for each in self.models]

    @property
    def survivors(self) -> list[Explained]:
        """Models that the measurements do not rule out, the best first."""
        pairs = zip(self.models, self.evidence, strict=True)
        return [each for each, above in pairs if above <= SURVIVES]

    @property
    def surviving(self) -> list[str]:
        """Names of the models that the measurements do not rule out."""
        return [each.name for each in self.survivors]

    @property
    def mean_difference(self) -> float:
        """Mean absolute difference in the unit of the criterion."""
        return self.criterion.mean_difference(self.explained.problem, self.explained.residuals)

    @cached_property
    def _insufficient(self) -> list[str]:
        """Sentences on why the best model does not suffice; empty if it does."""
        best = self.explained
        reasons = self.criterion.excess(best.problem, best.residuals, best.sure)
        limits = [] if reasons else best.at_limits
        bound = [name for name in best.on_bounds if name not in limits]
        if bound:
            what = f"{', '.join(bound)} {'is' if len(bound) == 1 else 'are'} {ON_A_BOUND}"
            reasons.append(f"{what}: the model lacks a phenomenon, or the bound is too tight")
        return reasons

    @property
    def verdict(self) -> list[str]:
        """Sentences: whether the model suffices, which unknowns are identified, which not."""
        best, reasons = self.explained, self._insufficient
        kept = self.criterion.kept(self.mean_difference, best.sure)
        if limits := best.at_limits:
            whose = "its" if len(limits) == 1 else "their"
            kept += f"; {', '.join(limits)} at {whose} physical limit"
        lines = [f"{INSUFFICIENT}: " + "; ".join(reasons) if reasons else kept]
        if best.fit.limited:
            lines.append(
                f"{UNFINISHED}: the largest number of machines is reached, so that no interval is "
                "known: start nearer to the solution (start), or identify fewer unknowns"
            )
        lines += [remark for each in best.beside for remark in each.remarks]
        for word in (IDENTIFIED, BY_ITS_PRIOR, UNIDENTIFIABLE):
            names = [name for name, each in best.named if each == word]
            if names:
                lines.append(f"{word}: {', '.join(names)}")
        idle = [u.name for u, i in zip(best.problem.unknowns, best.sure.idle, strict=True) if i]
        if reasons and idle:
            lines.append(
                f"no measurement depends on {', '.join(idle)} at the best fit, as with a stop that "
                "is never reached: searches from other starts may find a better one (starts)"
            )
        lines += inseparable(best.problem.unknowns, best.sure)
        if best.fit.absolute is not None:
            lines += outliers(best.problem.measurements, best.residuals, best.sure)
        lines += remarks(self.profiles, best.problem, best.sure)
        others = self.surviving
        if len(others) > 1:
            lines.append(
                f"{UNDECIDED}: {len(others)} models explain it equally well: {'; '.join(others)}"
            )
        return lines

    @property
    def sufficient(self) -> bool:
        """Whether the best model explains the measurements, and no value stands on a bound; 0 is
        allowed for a quantity that is never negative, such as friction."""
        return not self._insufficient

    @property
    def summary(self) -> str:
        """Summary in plain text."""
        from rotordyn.study.identification.summary import summary

        return summary(self)

    def plot(self, name: str) -> Any:
        """Draw a figure by its name; ``figures`` lists the names."""
        from rotordyn.study.identification.figures import figures

        known = dict(figures(self))
        if name not in known:
            raise InvalidInput(f"no figure {shown(name)}; allowed: {', '.join(known)}")
        return known[name]()

    @property
    def figures(self) -> list[str]:
        """Names of the figures."""
        from rotordyn.study.identification.figures import figures

        return [name for name, _ in figures(self)]

    def dataset(self) -> xr.Dataset:
        """Values, intervals, correlation, residuals, evidence and predictions as a Dataset."""
        from rotordyn.study.identification.dataset import dataset

        return dataset(self)

    @typed(InvalidInput)
    def save(self, folder: str | Path, *, draw: bool = True) -> None:
        """Write summary, dataset, tables, figures and the identified machine into a folder."""
        from rotordyn.study.identification.deliver import write

        write(self, Path(folder), draw=draw)


def _written(case: Case, path: str) -> Any:
    value, annotation = found_at(case, path)[0]
    quantity = quantity_of(annotation)
    if quantity is None or isinstance(value, str | bool):
        return value
    return quantity.infinite if np.isinf(value) else f"{value!r} {quantity.coherent_unit}".strip()
