"""What a measurement is. To add a kind:

1. A class in a file of its own, frozen, that has what ``Measurement`` lists. All its numbers are in
   SI units; complex ones are split into two real rows each.
2. ``data``: a ``Data``, what was observed, with the standard deviation of the noise of every
   number, and what the rig adds to it linearly (``columns``: tare, drift), each with the standard
   deviation of its prior; infinite where nothing is known of it. ``Data`` refuses what cannot be
   fitted: missing or repeated points, a deviation of zero.
3. ``faults(case)``: sentences about what of the case contradicts it (an unknown sleeve, an analysis
   that the case lacks). They are said before anything is solved.
4. ``speeds(case)``: speeds [rad/s] at which it needs machines solved; ``analyses(case)``: what it
   asks of the case there, name to spec; nothing where it solves by itself (``AsksNothing``).
5. ``predicted(trial)``: what a machine would show (n,) without tare and drift. ``trial.case`` is
   the case with trial values; ``trial.results`` answers to all ``analyses`` at all ``speeds``,
   solved once for all measurements; ``trial.axial`` the shaft along its axis with friction.
   What has no solution raises ``NoSolution``, ``InvalidInput`` or ``BearingError``: the search then
   steps back. A number that does not exist is NaN and counts as that.
6. Its keys in files: a class and a line in ``rotordyn.case.identification``, and in ``kinds`` what
   is made of them.
7. If it likes: ``step``, of an unknown's scale, by which ``predicted`` is differentiated;
   ``blurred``, the same measurement seen less sharply, from the vaguest on, each with all of the
   above: a search goes through them first; ``carried``, how many numbers its points tell, where
   these are fewer; ``beside(trial)``, a ``Beside`` of the best machine.

The search knows nothing of kinds: it weighs differences by deviations, takes out ``columns`` by
linear least squares, and differentiates ``predicted`` by small steps.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.study.identification.trial import Trial

Array = NDArray[np.float64]
FEW = 4  # points of a measurement from which it is drawn as a curve


@dataclass(frozen=True, eq=False, slots=True)
class Data:
    """What was observed: ``observed`` and ``deviation`` of its noise (n,) [SI].

    ``columns`` (n, k): what one unit of each of k nuisances adds, ``column_deviation`` (k,) of
    their priors, ``column_names``. For people: ``unit``, and ``factor`` from SI to it; ``at`` (n,):
    abscissa as printed, ``along`` its label; ``series`` (n,): which curve a point belongs to.
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
            raise InvalidInput(f"measurement {self.name}: has points that are no numbers")
        if not (self.deviation > 0.0).all():
            raise InvalidInput(
                f"measurement {self.name}: a deviation is a number above 0, got "
                f"{self.deviation.min() * self.factor:g} {self.unit}"
            )
        if self.columns.shape != (n, k):
            object.__setattr__(self, "columns", self.columns.reshape(n, k))

    @property
    def swamped(self) -> bool:
        """Whether the noise is as large as all that the points differ by."""
        n = len(self.observed)
        return n > 2 and bool(np.ptp(self.observed) < self.deviation.min())


class Beside(NamedTuple):
    """What a measurement says of a machine beside differences: a table called ``name``, its
    ``head`` and ``rows``, and ``remarks``, sentences for the verdict."""

    name: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    remarks: tuple[str, ...]


class AsksNothing:
    """A measurement that solves the machine at its own speeds, by its equation of motion alone."""

    def speeds(self, case: Case) -> tuple[float, ...]:
        """None."""
        return ()

    def analyses(self, case: Case) -> Mapping[str, Any]:
        """None."""
        return {}


class Measurement(Protocol):
    """A kind of measurement; see above."""

    @property
    def data(self) -> Data: ...
    def faults(self, case: Case) -> Iterable[str]: ...
    def speeds(self, case: Case) -> Iterable[float]: ...
    def analyses(self, case: Case) -> Mapping[str, Any]: ...
    def predicted(self, trial: Trial) -> Array: ...
