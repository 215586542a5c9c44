"""Measured frequency responses of several pairs at several speeds, at rest and in rotation.

The common modes of the responses of a speed are fitted first (``pole_count``). Their sum can be
evaluated off the imaginary axis, too, at s = (b + i) ω, under a growing harmonic force: there every
peak has the relative width b, so that a search converges from frequencies far from the measured
ones. A search begins with such ``blurred`` responses and ends with the measured ones, each sample
weighed by its noise.

Theory: docs/theory/rotor_from_responses.md.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from rotordyn.analyses.measured_response import QUANTITIES, MeasuredResponse, Port, as_quantity
from rotordyn.analyses.passivity import NO_DRIVING_POINT, fault_at_driving_point
from rotordyn.arrays import Array, Complex, Flags
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.machine.assembly import unknown
from rotordyn.numerics.pole_count import Counted, counted_without_outliers
from rotordyn.numerics.pole_refinement import Refined, refined
from rotordyn.numerics.sample_noise import LEAST_COHERENCE
from rotordyn.numerics.threads import linear_algebra_alone
from rotordyn.results.display import RPM, is_rotation
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.measurement import AsksNothing, Beside, Data
from rotordyn.study.identification.paired_modes import beside
from rotordyn.study.identification.trial import Trial, require_all_speeds

PARTS = ("real", "imaginary")  # of a response, in this order
BLURS = (0.3, 0.05)  # b, in turn: about the distance of modes, then of pairs of modes
POINTS = 40  # frequencies of blurred responses
STEP = 1e-4  # of finite differences over the scale of an unknown: sharp peaks need small steps
FLOOR = 0.02  # least noise, over the relative noise of the median response
MOST_MODES = 40
SWAMPED = 0.5  # noise over response from which a measurement is refused
MOST_ERROR = 0.9  # of a squared error: the lines that make it are named
TELLING = 0.1  # noise over response up to which sign and phase are checked
INCOHERENT = 1e-3  # least 1 − γ²: below it other errors dominate


@dataclass(frozen=True, eq=False, kw_only=True)
class Responses(AsksNothing):
    """Measured ``responses`` of any pairs and speeds; those of one speed share their frequencies.

    The standard deviation of the real and of the imaginary part of a sample is ``noise`` times its
    magnitude, or √((1 − γ²)/(2 n γ²)) times it, with coherence γ² over n ``averages`` (J. Bendat
    and A. Piersol, Random data). ``gain``: standard deviation of an unknown calibration factor of
    each response, over 1.
    """

    name: str
    responses: tuple[MeasuredResponse, ...]
    noise: float | None = None
    averages: int | None = None
    gain: float = 0.0

    step = STEP

    def __post_init__(self) -> None:
        for sentence in self._refusals():
            raise InvalidInput(f"measurement {self.name}: {sentence}")

    def _refusals(self) -> Iterator[str]:
        if not self.responses:
            yield "holds no responses"
        if self.noise is not None and not 0.0 < self.noise < SWAMPED:
            yield f"noise: given {self.noise:g}; allowed: above 0, below {SWAMPED:g} of a response"
        if self.averages is not None and not self.averages >= 1:
            yield f"averages: given {self.averages}; allowed: at least 1"
        if not 0.0 <= self.gain < 1.0:
            yield f"gain: given {self.gain:g}; allowed: from 0, below 1"
        seen: dict[tuple[str, float], None] = {}
        for one in self.responses:
            at = f"{one.pair} at {_rpm(one.speed)}"
            if (one.pair, one.speed) in seen:
                yield f"{at} is given twice"
            seen[one.pair, one.speed] = None
            first = next(other for other in self.responses if other.speed == one.speed)
            if one.frequency != first.frequency:
                yield (
                    f"{at} has {len(one.frequency)} frequencies from {one.frequency[0]:g} to "
                    f"{one.frequency[-1]:g} Hz, {first.pair} has {len(first.frequency)} from "
                    f"{first.frequency[0]:g} to {first.frequency[-1]:g} Hz: responses of one speed "
                    "are needed at the same frequencies"
                )
            yield from self._noise_refusals(one, at)

    def _noise_refusals(self, one: MeasuredResponse, at: str) -> Iterator[str]:
        if self.averages is not None and not one.coherence:
            yield f"{at} has no coherence, which averages need: give noise instead"
        elif self.averages is None and self.noise is None:
            yield f"{at}: give noise, or averages beside a coherence"
        elif np.median(self._relative(one)) >= SWAMPED:
            yield (
                f"{at}: noise dominates it, {100.0 * np.median(self._relative(one)):.0f} % of the "
                "response at half of the frequencies"
            )

    def _relative(self, one: MeasuredResponse) -> Array:
        """Standard deviation of each part over the magnitude of a response (f,)."""
        if self.averages is None:
            return np.full(len(one.frequency), self.noise)
        coherence = np.clip(np.array(one.coherence), LEAST_COHERENCE, 1.0 - INCOHERENT)
        return np.asarray(np.sqrt((1.0 - coherence) / (2.0 * self.averages * coherence)))

    def compared(self, one: MeasuredResponse) -> Flags:
        """Frequencies (f,) at which a response is compared with the machine: noise does not swamp
        it, and they are no outliers."""
        compared = self._relative(one) < SWAMPED
        compared[self.modes[one.speed].outliers] = False
        return np.asarray(compared)

    @property
    def word(self) -> str:
        """Name usable as a file name."""
        return re.sub(r"\W+", "_", self.name)

    @cached_property
    def speed(self) -> tuple[float, ...]:
        """Distinct speeds, ascending [rad/s]."""
        return tuple(sorted({one.speed for one in self.responses}))

    def of_speed(self, speed: float) -> tuple[MeasuredResponse, ...]:
        """The responses of a speed."""
        return tuple(one for one in self.responses if one.speed == speed)

    @cached_property
    def modes(self) -> Mapping[float, Counted]:
        """Modes fitted to the responses of every speed.

        Raises
        ------
        InvalidInput : noise swamps the responses; too few frequencies; sign or phase of another
            quantity at a driving point
        """
        return {speed: self._fitted(speed) for speed in self.speed}

    def _fitted(self, speed: float) -> Counted:
        responses = self.of_speed(speed)
        values = np.array([as_quantity(one, QUANTITIES[0]) for one in responses]).T
        relative = np.array([self._relative(one) for one in responses]).T
        most = min(MOST_MODES, (len(values) - 2) // 4)
        if most < 1:
            raise InvalidInput(
                f"measurement {self.name}: {len(values)} frequencies at {_rpm(speed)}; allowed: at "
                "least 6"
            )
        for one in responses:
            if fault := self._turned(one):
                raise InvalidInput(
                    f"measurement {self.name}: {one.pair} at {_rpm(speed)} is not that of a "
                    f"driving point: {fault}"
                )
        omega = 2.0 * np.pi * np.array(responses[0].frequency)
        with linear_algebra_alone():
            fitted = counted_without_outliers(omega, values, _deviation(relative, values), most)
            compared = relative < SWAMPED
            compared[fitted.outliers] = False
            if self.averages is not None:
                better = _reweighed(omega, values, relative, compared, fitted.best)
                fitted = fitted._replace(best=better)
        error = values - fitted.best.fit(omega)
        self._require_modes(speed, np.where(compared, values, 0.0), np.where(compared, error, 0.0))
        return fitted

    def _require_modes(self, speed: float, values: Complex, error: Complex) -> None:
        """Refuse responses (f, e), 0 where they are not compared, that no sum of modes comes near,
        with such an ``error``."""
        size, error = np.abs(values) ** 2, np.abs(error) ** 2
        for one, e, h in zip(self.of_speed(speed), error.T, size.T, strict=True):
            if e.sum() <= SWAMPED**2 * h.sum():
                continue
            order = np.argsort(-e)
            most = order[: 1 + int(np.searchsorted(np.cumsum(e[order]), MOST_ERROR * e.sum()))]
            hertz = np.array(one.frequency)[most]
            raise InvalidInput(
                f"measurement {self.name}: noise dominates {one.pair} at {_rpm(speed)}: no sum of "
                f"modes fits it within {100.0 * SWAMPED:.0f} % of its size, and "
                f"{len(most)} of its {len(h)} lines, {hertz.min():g} to {hertz.max():g} Hz, make "
                f"{100.0 * MOST_ERROR:.0f} % of the error: omit such lines, or give averages "
                "beside a coherence"
            )

    def _turned(self, one: MeasuredResponse) -> str:
        """Correction (of sign or phase) that makes a driving-point response passive; empty if it is
        passive, or if no known correction helps: a rotor with oil films need not be passive."""
        if one.response != one.excitation or np.median(self._relative(one)) > TELLING:
            return ""
        omega = 2.0 * np.pi * np.array(one.frequency)
        fault = fault_at_driving_point(
            as_quantity(one, one.quantity).tolist(), omega.tolist(), one.quantity
        )
        return "" if fault in (None, NO_DRIVING_POINT) else str(fault)

    @cached_property
    def data(self) -> Data:
        """Real, then imaginary part of every response, one after the other; with a gain of each."""
        values, deviations, gains = [], [], []
        pairs = [(one, self.compared(one)) for one in self.responses]
        for one, at in pairs:
            size = self._smooth(one)
            deviation = _deviation(self._relative(one)[:, None], size[:, None])[at, 0]
            values.append(as_quantity(one, QUANTITIES[0])[at])
            deviations += [deviation, deviation]
        observed = [_rows(one) for one in values]
        if self.gain:
            gains = [f"gain of {one.pair} at {_rpm(one.speed)}" for one in self.responses]
        columns = np.zeros((sum(map(len, observed)), len(gains)))
        ends = np.cumsum([0, *map(len, observed)])
        for k in range(len(gains)):
            columns[ends[k] : ends[k + 1], k] = observed[k]
        return Data(
            self.name,
            np.concatenate(observed),
            np.concatenate(deviations),
            *_unit(self.responses),
            np.concatenate([np.tile(np.array(one.frequency)[at], 2) for one, at in pairs]),
            "frequency [Hz]",
            tuple(word for one, at in pairs for word in _series(one, int(at.sum()))),
            columns,
            np.full(len(gains), self.gain),
            tuple(gains),
        )

    def _smooth(self, one: MeasuredResponse) -> Complex:
        """Response synthesised from the modes of its speed (f,)."""
        place = self.of_speed(one.speed).index(one)
        return self.modes[one.speed].best.fit(2.0 * np.pi * np.array(one.frequency))[:, place]

    @property
    def carried(self) -> int:
        """Number of real parameters of the fitted modes."""
        return sum(each.best.unknowns for each in self.modes.values())

    @property
    def blurred(self) -> tuple[Blurred, ...]:
        """Smoothed versions, smoothest first."""
        return tuple(Blurred(self, share) for share in BLURS)

    def faults(self, case: Case) -> Iterator[str]:
        """Yield faults: no spindle, or an unknown point."""
        spindle = case.spindle
        if spindle is None:
            yield f"measurement {self.name}: needs a spindle"
            return
        for one in self.responses:
            for port in (one.response, one.excitation):
                for sentence in unknown("point", port.point, [*spindle.places]):
                    yield f"measurement {self.name}: {sentence}"
                    return

    def predicted(self, trial: Trial) -> Array:
        """Predicted values in the rows of ``data`` (n,) [SI]."""
        frequency = {s: np.array(self.of_speed(s)[0].frequency) for s in self.speed}
        receptances = self.computed(trial, {s: 2.0 * np.pi * f for s, f in frequency.items()})
        return np.concatenate(
            [_rows(receptances[one.speed][one.pair][self.compared(one)]) for one in self.responses]
        )

    def beside(self, trial: Trial) -> Beside:
        """Table of measured and computed modes."""
        return beside(self, trial)

    def scene(self, trial: Trial) -> Scene:
        """The machine of a trial at the speeds of the responses."""
        spindle, case = trial.case.spindle, trial.case
        assert spindle is not None, "asked for by faults"
        places = {spindle.place(p.point) for one in self.responses for p in _ports(one)}
        highest = max(one.frequency[-1] for one in self.responses)
        speed, ports = np.array(self.speed), tuple(sorted(places))
        scene = Scene(spindle, case.conditions, speed, highest, ports)
        require_all_speeds(scene)
        return scene

    def computed(self, trial: Trial, omega: Mapping[float, Any]) -> dict[float, dict[str, Complex]]:
        """Computed receptances by speed and pair; ``omega``: angular frequencies (f,) by speed."""
        with linear_algebra_alone():
            scene = self.scene(trial)
            return {s: self._at(scene, row, s, omega[s]) for row, s in enumerate(self.speed)}

    def _at(
        self, scene: Scene, row: int, speed: float, omega: Array | Complex
    ) -> dict[str, Complex]:
        receptances: dict[str, Complex] = {}
        systems: dict[int, list[MeasuredResponse]] = {}
        for one in self.of_speed(speed):
            owners = self.owners(scene, one)
            receptances[one.pair] = np.zeros(len(omega), dtype=complex)
            if owners[0] == owners[1]:
                systems.setdefault(owners[0], []).append(one)
        at = np.array([row])
        for k, responses in systems.items():
            rows = np.array([self.rows(scene, k, one) for one in responses])
            values = scene.system(k).at(at).receptance(np.asarray(omega), rows[:, 0], rows[:, 1])[0]
            for one, value in zip(responses, values, strict=True):
                receptances[one.pair] = np.asarray(value)
        return receptances

    @staticmethod
    def owners(scene: Scene, one: MeasuredResponse) -> tuple[int, int]:
        """Subsystems in which response and excitation move."""
        first, second = (scene.owner(port.point, port.direction) for port in _ports(one))
        return first, second

    @staticmethod
    def rows(scene: Scene, k: int, one: MeasuredResponse) -> Array:
        """Rows (2, n) from the coordinates of a subsystem to motions at response and excitation."""
        linear = scene.system(k).linear
        places = [(scene.spindle.place(port.point), port.direction) for port in _ports(one)]
        return np.array([linear.row(place.rotor, place.x, way) for place, way in places])

    def deviation_at(self, speed: float, place: int) -> Array:
        """Standard deviation (e,) of the parts of responses of a speed at frequency ``place``."""
        responses, response = self.of_speed(speed), self.modes[speed].best.fit
        omega = 2.0 * np.pi * np.array(responses[0].frequency)
        relative = np.array([self._relative(one) for one in responses]).T
        return _deviation(relative, response(omega))[place]


@dataclass(frozen=True, eq=False)
class Blurred(AsksNothing):
    """Smoothed responses ``of`` a measurement, at s = (``share`` + i) ω."""

    of: Responses
    share: float
    step = STEP

    @cached_property
    def _omega(self) -> dict[float, Complex]:
        rotation = 2.0 * np.pi * (1.0 - 1j * self.share)
        frequencies = {speed: _across(self.of.of_speed(speed)[0]) for speed in self.of.speed}
        return {
            speed: np.asarray(rotation * hertz, dtype=complex)
            for speed, hertz in frequencies.items()
        }

    @cached_property
    def data(self) -> Data:
        """Rows as those of the measurement at few frequencies, synthesised from fitted modes."""
        observed, deviations = [], []
        for one in self.of.responses:
            place = self.of.of_speed(one.speed).index(one)
            values = self.of.modes[one.speed].best.fit(self._omega[one.speed])[:, place]
            typical = float(np.median(self.of._relative(one)))
            observed.append(_rows(values))
            deviations.append(np.tile(typical * np.abs(values), 2))
        at = [np.tile(_across(one), 2) for one in self.of.responses]
        return Data(
            self.of.name,
            np.concatenate(observed),
            np.concatenate(deviations),
            *_unit(self.of.responses),
            np.concatenate(at),
            "frequency [Hz]",
            ("",) * sum(map(len, at)),
        )

    def faults(self, case: Case) -> tuple[str, ...]:
        """No faults in addition to those of the measurement."""
        return ()

    def predicted(self, trial: Trial) -> Array:
        """Predicted values in the rows of ``data`` (n,) [SI]."""
        receptances = self.of.computed(trial, self._omega)
        return np.concatenate(
            [_rows(receptances[one.speed][one.pair]) for one in self.of.responses]
        )


def _across(one: MeasuredResponse) -> Array:
    return np.geomspace(one.frequency[0], one.frequency[-1], POINTS)


def _ports(one: MeasuredResponse) -> tuple[Port, Port]:
    return one.response, one.excitation


def _rows(values: Complex) -> Array:
    return np.concatenate([values.real, values.imag])


def _deviation(relative: Array, values: Complex) -> Array:
    """Standard deviation of each part (f, e), with a floor near antiresonances."""
    magnitude = np.abs(values)
    floor = np.maximum(FLOOR * np.median(magnitude, axis=0), 1e-300)
    return np.asarray(relative * np.maximum(magnitude, floor))


def _reweighed(
    omega: Array, values: Complex, relative: Array, compared: Flags, of: Refined
) -> Refined:
    """Refine poles by the lines that are ``compared``, with the noise of fitted, not of measured
    sizes, by which lines that noise makes small count for too much."""
    weight = np.where(compared, 1.0 / _deviation(relative, of.fit(omega)), 0.0)
    return refined(omega, values, of.fit.pole, weight)


def _unit(responses: tuple[MeasuredResponse, ...]) -> tuple[str, float]:
    turned = {is_rotation(port.direction) for one in responses for port in _ports(one)}
    return ("", 1.0) if True in turned else ("µm/N", 1e6)


def _series(one: MeasuredResponse, count: int) -> list[str]:
    at = f"{one.pair}, {_rpm(one.speed)}"
    return [f"{at}, {part}" for part in PARTS for _ in range(count)]


def _rpm(speed: float) -> str:
    return f"{speed * RPM.factor:.0f} rpm"
