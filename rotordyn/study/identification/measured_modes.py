"""Measured frequencies and damping ratios of bending modes over speed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.numerics.threads import linear_algebra_alone
from rotordyn.results.display import RPM
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.measurement import AsksNothing, Data
from rotordyn.study.identification.paired_modes import FAR, SWINGS, assigned
from rotordyn.study.identification.trial import Trial, require_all_speeds

WHIRLS = {"forward": 1.0, "backward": -1.0, "": 0.0}
BEYOND = 1.5  # highest computed frequency over the highest measured one
OTHER = 1.0  # cost of a mode of the opposite whirl, that of a frequency ``FAR`` off


@dataclass(frozen=True, eq=False, kw_only=True)
class Modes(AsksNothing):
    """Measured modes: ``frequency`` |λ|/2π [Hz] at ``speed`` [rad/s], both (n,), with a relative
    standard ``deviation``.

    ``damping`` ratios (n,) with a relative ``damping_deviation``, or None; ``whirl`` (n,):
    "forward", "backward", or "" if unknown. At each speed measured modes are assigned to computed
    ones with the least total distance.
    """

    name: str
    speed: Array
    frequency: Array
    deviation: float
    damping: Array | None = None
    damping_deviation: float | None = None
    whirl: tuple[str, ...] = ()

    step = 1e-3

    def __post_init__(self) -> None:
        for sentence in self._refusals():
            raise InvalidInput(f"measurement {self.name}: {sentence}")

    def _refusals(self) -> Iterator[str]:
        n, whirls = len(self.speed), self.whirl or None
        given = {"frequencies": self.frequency, "dampings": self.damping, "whirls": whirls}
        for name, values in given.items():
            if values is not None and len(values) != n:
                yield f"{name}: given {len(values)}; needed: one for each of {n} speeds"
        if not self.deviation > 0.0:
            yield f"deviation: given {100.0 * self.deviation:g} %; allowed: above 0 %"
        if (self.damping is None) != (self.damping_deviation is None):
            yield "dampings have a deviation: give both or none"
        for word in sorted({*self.whirl} - {*WHIRLS}):
            yield f"whirl {word!r}; allowed: forward, backward"
        seen: set[tuple[float, float]] = set()
        for pair in zip(self.speed.tolist(), self.frequency.tolist(), strict=True):
            if pair in seen:
                yield f"{pair[1]:g} Hz at {pair[0] * RPM.factor:.0f} rpm is given twice"
            seen.add(pair)

    @cached_property
    def data(self) -> Data:
        """Frequencies, followed by the decay rates ζ |λ|/2π [Hz]."""
        observed, deviation = [self.frequency], [self.deviation * self.frequency]
        series = ["frequency"] * len(self.frequency)
        if self.damping is not None and self.damping_deviation is not None:
            decay = self.damping * self.frequency
            observed.append(decay)
            deviation.append(self.damping_deviation * decay)
            series += ["decay"] * len(decay)
        return Data(
            self.name,
            np.concatenate(observed),
            np.concatenate(deviation),
            "Hz",
            1.0,
            np.tile(self.speed * RPM.factor, len(observed)),
            "speed [rpm]",
            tuple(series),
        )

    def faults(self, case: Case) -> Iterator[str]:
        """Yield a fault if the case has no spindle."""
        if case.spindle is None:
            yield f"measurement {self.name}: needs a spindle"

    def predicted(self, trial: Trial) -> Array:
        """Predicted values in the rows of ``data`` [Hz]."""
        speeds = np.unique(self.speed)
        highest = BEYOND * float(self.frequency.max())
        frequency, decay = np.empty(len(self.speed)), np.empty(len(self.speed))
        with linear_algebra_alone():
            assert trial.case.spindle is not None, "asked for by faults"
            scene = Scene(trial.case.spindle, trial.case.conditions, speeds, highest)
            require_all_speeds(scene)
            for row, speed in enumerate(speeds):
                rows = np.flatnonzero(self.speed == speed)
                pole = self._paired(rows, *_bending(scene, row))
                frequency[rows] = np.abs(pole) / (2.0 * np.pi)
                decay[rows] = -pole.real / (2.0 * np.pi)
        return frequency if self.damping is None else np.concatenate([frequency, decay])

    def _paired(self, measured: Indices, pole: Complex, whirl: Array) -> Complex:
        """Poles of the computed modes assigned to measured modes ``measured`` (n,)."""
        distance = np.abs(np.log(2.0 * np.pi * self.frequency[measured, None] / np.abs(pole)))
        cost = distance / FAR
        if self.whirl:
            direction = np.array([WHIRLS[self.whirl[k]] for k in measured])
            cost = cost + OTHER * (direction[:, None] * whirl < 0.0)
        rows, columns = assigned(cost, distance)
        if len(rows) < len(measured):
            raise NoSolution(f"measurement {self.name}: the machine has too few modes")
        return np.asarray(pole[columns])[np.argsort(rows)]


def _bending(scene: Scene, row: int) -> tuple[Complex, Array]:
    """Poles of oscillating bending modes at a speed, and their whirl (k,)."""
    solved = [scene.system(k).at(np.array([row])) for k in scene.with_motions(("bending",))]
    pole = np.concatenate([motions.pole[0] for motions in solved])
    whirl = np.concatenate([motions.whirl[0] for motions in solved])
    oscillates = np.isfinite(pole) & (pole.imag > SWINGS * np.abs(pole))
    return pole[oscillates], whirl[oscillates]
