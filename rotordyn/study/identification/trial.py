"""A machine with trial values, solved only for what measurements need."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.errors import NoSolution
from rotordyn.preload.axial_curves import BearingCurves
from rotordyn.preload.play import AxialRunUp, axial_run_up
from rotordyn.scene.scene import Scene
from rotordyn.study.neighbours import Neighbours


@dataclass
class Known:
    """Results shared by the trials of one process: axial curves of bearings, stages of scenes."""

    curves: BearingCurves = field(default_factory=BearingCurves)
    neighbours: Neighbours = field(default_factory=Neighbours)


@dataclass
class Trial:
    """A ``case`` with trial values; ``speeds`` [rad/s], ascending, and ``analyses`` needed there by
    measurements; ``axial_speeds``: speeds of axial measurements."""

    case: Case
    speeds: tuple[float, ...] = ()
    analyses: Mapping[str, Any] = field(default_factory=dict)
    axial_speeds: tuple[float, ...] = ()
    known: Known = field(default_factory=Known)
    _cycles: dict[Any, tuple[Array, Array]] = field(default_factory=dict)

    @cached_property
    def results(self) -> Mapping[str, Any]:
        """Results by name of the analysis.

        Raises
        ------
        NoSolution : a speed has no solution
        """
        asked = replace(self.case, speeds=self.speeds, analyses=dict(self.analyses))
        results = self.known.neighbours.solve(asked)[0].results
        for result in results.values():
            words = [str(word) for word in np.ravel(np.asarray(result.outcome, dtype=object))]
            if any(words):
                raise NoSolution(next(word for word in words if word))
        return results

    @cached_property
    def axial(self) -> AxialRunUp:
        """Axial arrangement with friction, run up through the axial speeds."""
        return self.along()

    def cycle(
        self, row: int, falling: Array, rising: Array, lowest: float | None, highest: float | None
    ) -> tuple[Array, Array]:
        """Displacements of the bodies on both branches (``AxialRunUp.cycle``); each solved once."""
        key = row, falling.tobytes(), rising.tobytes(), lowest, highest
        if key not in self._cycles:
            self._cycles[key] = self.axial.cycle(row, falling, rising, lowest, highest)
        return self._cycles[key]

    def along(self, without_stop: str = "") -> AxialRunUp:
        """Axial arrangement run up through the axial speeds, without the stop of one sleeve."""
        spindle = self.case.spindle
        assert spindle is not None, "measurements of a spindle"
        sleeves = tuple(
            replace(sleeve, stop_travel=math.inf) if sleeve.name == without_stop else sleeve
            for sleeve in spindle.sleeves
        )
        spindle = replace(spindle, sleeves=sleeves) if without_stop else spindle
        scene = Scene(spindle, self.case.conditions, np.array(self.axial_speeds))
        if (oiled := self.case.conditions.films) is not None:
            require_all_speeds(scene)
        return axial_run_up(
            scene.grounded,
            scene.law,
            scene.bearing_speed[scene.bearing_row],
            scene.axial_force,
            self.case.conditions.temperatures,
            self.known.curves,
            scene.preload.films if oiled is not None else None,
            scene.past.weight,
        )


def require_all_speeds(scene: Scene) -> None:
    """Raise unless every speed has a solution.

    Raises
    ------
    NoSolution : with the sentence of the first speed without one
    """
    for word in scene.outcome:
        if word:
            raise NoSolution(word)
