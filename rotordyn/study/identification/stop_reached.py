"""Measured speed or axial force at which a sleeve just meets its stop."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.study.identification.along_axis import RPM, Axial, row_at
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.trial import Trial


@dataclass(frozen=True, eq=False, kw_only=True)
class StopReached(Axial):
    """A ``sleeve`` just meets its stop at a ``speed`` [rad/s], after a run-up without additional
    force, or on the falling branch of a cycle between two forces, at ``force`` [N].

    Compared is the gap to the stop that the sleeve would have without it; ``deviation`` [m].
    """

    sleeve: str
    speed: float
    force: float | None = None
    lowest: float | None = None
    highest: float | None = None

    @property
    def data(self) -> Data:
        """A gap of zero."""
        one = np.ones(1)
        at = one * (self.speed / RPM if self.force is None else self.force)
        along = "speed [rpm]" if self.force is None else "axial force [N]"
        deviation = self.deviation * one
        return Data(self.name, 0.0 * one, deviation, "µm", 1e6, at, along, (self.sleeve,))

    def _speeds(self) -> list[float]:
        return [self.speed]

    @property
    def _body(self) -> str:
        return self.sleeve

    def faults(self, case: Case) -> Iterator[str]:
        """Yield faults of ``Axial``, a sleeve without a stop, a force outside the cycle."""
        yield from super().faults(case)
        if self.force is not None:
            yield from self._out_of_cycle(self.force)
        for sleeve in case.spindle.sleeves if case.spindle else ():
            if sleeve.name == self.sleeve and not np.isfinite(sleeve.stop_travel):
                yield f"measurement {self.name}: sleeve {self.sleeve} has no stop"

    def _out_of_cycle(self, force: float) -> Iterator[str]:
        if self.lowest is None or self.highest is None:
            yield f"measurement {self.name}: a force lies in a cycle: give its lowest and highest"
        elif not self.lowest <= force <= self.highest:
            yield (
                f"measurement {self.name}: force: given {force:g} N; allowed: within the cycle, "
                f"{self.lowest:g} N to {self.highest:g} N"
            )

    def predicted(self, trial: Trial) -> Array:
        """Predicted gap (1,) [m], negative beyond the stop."""
        assert trial.case.spindle is not None
        sleeve = next(s for s in trial.case.spindle.sleeves if s.name == self.sleeve)
        free = trial.along(without_stop=self.sleeve)
        body, row = free.bodies.index(self.sleeve), row_at(trial, self.speed)
        if self.force is None:
            displacement = free.idle[row, body] - free.mounted[body]
        else:
            path = [self.highest or 0.0, self.lowest or 0.0, self.highest or 0.0, self.force]
            displacement = (
                free.under(row, path)[-1, body] + free.standstill[body] - free.mounted[body]
            )
        direction = free.at[row].sleeves[body - 1].push.direction
        return np.array([sleeve.stop_travel + direction * displacement])
