"""The contract of a measurement. To add a kind:

1. Write a frozen class in its own file that has the members of ``Measurement``. All numbers are in
   SI units; complex ones are split into two real rows.
2. ``data``: a ``Data`` with the observed values, the standard deviation of the noise of each, and
   linear effects of the rig (``columns``: tare, drift), each with the standard deviation of its
   prior, infinite if unknown. ``Data`` refuses missing or repeated points and a deviation of zero.
3. ``faults(case)``: sentences on contradictions with the case (an unknown sleeve, a missing
   analysis). They are raised before anything is solved.
4. ``speeds(case)``: speeds [rad/s] at which it needs results; ``analyses(case)``: the analyses it
   needs there, spec by name; both empty if it solves the machine itself (``AsksNothing``).
5. ``predicted(trial)``: predicted values (n,) without tare and drift. ``trial.case`` is the case
   with trial values; ``trial.results`` holds results of all ``analyses`` at all ``speeds``, solved
   once for all measurements; ``trial.axial`` the axial arrangement with friction. Without a
   solution it raises ``NoSolution``, ``InvalidInput`` or ``BearingError``, and the search steps
   back; so it does if a value is NaN.
6. Keys in files: a class and a line in ``rotordyn.case.identification``, and a function in
   ``kinds`` that makes the measurement.
7. Optional members: ``step``, of finite differences of ``predicted``, over the scale of an unknown;
   ``blurred``, smoothed versions of the measurement, smoothest first, each with all of the above,
   through which a search goes first; ``carried``, the number of independent values in the points;
   ``beside(trial)``, a ``Beside`` of the best machine.

The search does not depend on kinds: it weighs differences by deviations, eliminates ``columns`` by
linear least squares, and differentiates ``predicted`` by finite differences.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np

from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.study.identification.trial import Trial

FEW = 4  # points of a measurement from which it is drawn as a curve


@dataclass(frozen=True, eq=False, slots=True)
class Data:
    """Observations: ``observed`` values and standard ``deviation`` of their noise (n,) [SI].

    ``columns`` (n, k): effect of one unit of each of k nuisance parameters, ``column_deviation``
    (k,) of their priors, ``column_names``. For printing: ``unit``, and ``factor`` from SI to it;
    ``at`` (n,): abscissa, ``along`` its label; ``series`` (n,): name of the curve of a point.
    """

    name: str
    observed: Array
    deviation: Array
    unit: str
    factor: float
    at: Array
    along: str
    series: tuple[str, ...]
    columns: Array = field(default_factory=lambda: np.empty((0, 0)))
    column_deviation: Array = field(default_factory=lambda: np.empty(0))
    column_names: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        n, k = len(self.observed), len(self.column_deviation)
        if not n:
            raise InvalidInput(f"measurement {self.name}: holds no points")
        if not np.isfinite(self.observed).all():
            raise InvalidInput(f"measurement {self.name}: has points that are not numbers")
        if not (self.deviation > 0.0).all():
            raise InvalidInput(
                f"measurement {self.name}: a deviation is a number above 0, got "
                f"{self.deviation.min() * self.factor:g} {self.unit}"
            )
        if self.columns.shape != (n, k):
            object.__setattr__(self, "columns", self.columns.reshape(n, k))

    @property
    def swamped(self) -> bool:
        """Whether the noise exceeds the range of the observed values."""
        n = len(self.observed)
        return n > 2 and bool(np.ptp(self.observed) < self.deviation.min())


class Beside(NamedTuple):
    """Further comparison of a measurement with a machine: a table ``name`` with its ``head`` and
    ``rows``, and ``remarks``, sentences for the verdict."""

    name: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    remarks: tuple[str, ...]


class AsksNothing:
    """Base of measurements that need no analysis: they solve the equation of motion themselves."""

    def speeds(self, case: Case) -> tuple[float, ...]:
        """No speeds."""
        return ()

    def analyses(self, case: Case) -> Mapping[str, Any]:
        """No analyses."""
        return {}


class Measurement(Protocol):
    """Members of a measurement; see the module."""

    @property
    def data(self) -> Data: ...
    def faults(self, case: Case) -> Iterable[str]: ...
    def speeds(self, case: Case) -> Iterable[float]: ...
    def analyses(self, case: Case) -> Mapping[str, Any]: ...
    def predicted(self, trial: Trial) -> Array: ...
