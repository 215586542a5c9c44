"""A measurement of made-up numbers, for problems that predict them themselves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rotordyn.case.case import Case
from rotordyn.study.identification.measurement import Data
from rotordyn.study.identification.trial import Trial
from tests.rotordyn.study.axial_twin import Array


@dataclass(frozen=True, eq=False)
class MadeUp:
    """Numbers ``observed`` with a ``deviation`` of their noise."""

    observed: Array
    deviation: float

    @property
    def data(self) -> Data:
        n = len(self.observed)
        noise = np.full(n, self.deviation)
        return Data("made up", self.observed, noise, "N", 1.0, np.arange(n) * 1.0, "", ("",) * n)

    def faults(self, case: Case) -> Iterator[str]:
        yield from ()

    def speeds(self, case: Case) -> Iterator[float]:
        yield from ()

    def analyses(self, case: Case) -> dict[str, Any]:
        return {}

    def predicted(self, trial: Trial) -> Array:
        raise NotImplementedError
