"""Description of an analysis of the response over time (SI)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults, ascending, known, repeated
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import (
    Angle,
    Choice,
    Force,
    Frequency,
    Instant,
    Items,
    LastInstant,
    OptionalName,
    PointName,
    StopStiffness,
    TimeSpan,
)
from rotordyn.scene.formulation import ROTATING
from rotordyn.scene.loads import At, Unbalance
from rotordyn.scene.spec import Setting, Spec, placed, turning

DIRECTIONS = ("x", "y", "z")
SAMPLES = 20  # instants given in a period of the highest frequency
MOST_SAMPLES = 1_000_000


@dataclass(frozen=True, slots=True)
class ForceOverTime(Description):
    """A force on the shaft that changes with time.

    Of one shape: constant; sinusoidal where it has a `frequency`; half sines where it has a
    `pulse`, a single one or one every `period`; or by a table of `times` and `forces`, straight in
    between and zero outside.
    """

    at: Annotated[At, "where it acts: a point or station"]
    direction: Annotated[str, Choice(DIRECTIONS), "axis along which the force acts"]
    name: Annotated[OptionalName, "name in results; by default its number"] = ""
    force: Annotated[Force | None, "constant force, or the amplitude of a sine or half sine"] = None
    start: Annotated[Instant, "time at which the force begins"] = 0.0
    end: Annotated[LastInstant, "time at which the force ends"] = math.inf
    frequency: Annotated[Frequency | None, "frequency of a sinusoidal force"] = None
    phase: Annotated[Angle, "phase of a sinusoidal force at its start; 90° for a cosine"] = 0.0
    pulse: Annotated[TimeSpan | None, "duration of a half sine"] = None
    period: Annotated[
        TimeSpan | None, "time from the start of one half sine to that of the next"
    ] = None
    times: Annotated[tuple[Instant, ...], "times of a table, ascending"] = ()
    forces: Annotated[
        tuple[Force, ...],
        "forces of a table, one for each of `times`; zero before the first and after the last",
    ] = ()

    def _faults(self) -> Faults:
        if (self.force is None) == (not self.times):
            given = "neither" if self.force is None else "both"
            yield (
                ("force",),
                f"a force, or a table of times and forces: given {given}; allowed: one of the two",
            )
        if self.end <= self.start:
            yield ("end",), "not after the start: given {given}; allowed: a later time"
        yield from self._shape_faults()
        yield from self._table_faults()

    def _shape_faults(self) -> Faults:
        if self.frequency is not None and self.pulse is not None:
            yield ("pulse",), "given beside a frequency: a force has one shape, leave one out"
        if self.frequency is None and self.phase:
            yield (
                ("phase",),
                "only a sinusoidal force has a phase: give its frequency, or leave phase out",
            )
        if self.period is None:
            return
        if self.pulse is None:
            yield ("period",), "only half sines are repeated: give the pulse, or leave period out"
        elif self.period < self.pulse:
            yield ("period",), "shorter than the pulse: given {given}; allowed: at least the pulse"

    def _table_faults(self) -> Faults:
        given = {key: getattr(self, key) is not None for key in ("frequency", "pulse", "period")}
        given |= {"start": self.start > 0.0, "end": self.end < math.inf}
        for key in (key for key, there in given.items() if there and self.times):
            yield (key,), "given beside a table of times and forces: leave one of the two out"
        if len(self.times) != len(self.forces):
            counts = f"given {len(self.times)} and {len(self.forces)}"
            yield ("forces",), f"times and forces differ in number: {counts}"
        if len(self.times) == 1:
            yield ("times",), "a table needs at least two times: given one"
        yield from ascending("times", self.times)


@dataclass(frozen=True, slots=True)
class TimeResponseSpec(Spec):
    """Motion over time under forces and unbalance, at constant speed.

    Bearings follow their nonlinear load–displacement law, of which other analyses take the
    tangent. The machine begins in its preload state, on the steady orbit of its unbalances.
    """

    duration: Annotated[TimeSpan, "simulated time"]
    max_frequency: Annotated[
        Frequency,
        "highest frequency of the model; forces contain no higher frequency, and "
        "results have "
        f"{SAMPLES} samples per period of it",
    ]
    points: Annotated[tuple[PointName, ...], Items(), "points whose motion is computed"]
    forces: Annotated[tuple[ForceOverTime, ...], "forces on the shaft"] = ()
    unbalances: Annotated[tuple[Unbalance, ...], "unbalances at points or stations"] = ()
    stop_stiffness: Annotated[
        StopStiffness | None,
        "stiffness of the end stops of sleeves, which then close and open during the "
        "response; without it they stay as in the preload state",
    ] = None

    @property
    def samples(self) -> int:
        """Number of instants in results, both ends included: a multiple of four plus one, so that
        steps of two intervals can be halved from twice that length."""
        return 4 * max(1, math.ceil(self.duration * self.max_frequency * SAMPLES / 4.0 - 1e-6)) + 1

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the forces in results."""
        return tuple(force.name or f"force {k}" for k, force in enumerate(self.forces, start=1))

    @property
    def ports(self) -> tuple[tuple[str | float, str], ...]:
        """Place and direction of all forces and unbalances, each pair once."""
        acting = [(load.at, load.direction) for load in self.forces]
        acting += [(load.at, direction) for load in self.unbalances for direction in ("y", "z")]
        return tuple(dict.fromkeys(acting))

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations of results, forces and unbalances."""
        acting = [load.at for load in self.forces] + [load.at for load in self.unbalances]
        return (*self.points, *acting)

    def _faults(self) -> Faults:
        yield from repeated("points", self.points)
        yield from repeated("forces", self.names, "name", said="name given twice:")
        if not (self.forces or self.unbalances):
            yield (), "no load acts: allowed: at least one of forces, unbalances"
        if not (known(self.duration) and known(self.max_frequency)):
            return
        if self.samples > MOST_SAMPLES:
            yield (
                ("duration",),
                f"{self.samples} instants at {SAMPLES} times max_frequency: given {{given}}; "
                f"allowed: up to {MOST_SAMPLES}",
            )
        for index, force in enumerate(self.forces):
            if force.frequency is not None and force.frequency > self.max_frequency:
                yield (
                    ("forces", index, "frequency"),
                    "above max_frequency: given {given}; allowed: up to "
                    f"{self.max_frequency:g} Hz, or a higher max_frequency",
                )
            if force.pulse is not None and force.pulse < 0.5 / self.max_frequency:
                yield (
                    ("forces", index, "pulse"),
                    "shorter than a half sine of max_frequency: given {given}; allowed: from "
                    f"{0.5 / self.max_frequency:g} s, or a higher max_frequency",
                )
            key = "times" if force.times else "start"
            if (force.times[0] if force.times else force.start) >= self.duration:
                yield (
                    ("forces", index, key),
                    f"begins after the end of the duration: allowed: before {self.duration:g} s",
                )

    def faults_on(self, setting: Setting) -> Faults:
        spindle = setting.spindle
        if setting.conditions.formulation == ROTATING:
            yield (), "motion over time is that of the fixed frame: take formulation: inertial"
        if setting.conditions.films is not None:
            yield (
                (),
                "the response over time does not model oil films: leave films out of the "
                "conditions",
            )
        if spindle.hysteretic:
            yield (
                (),
                "a loss factor is defined for steady vibration and has no response over time: give "
                "damping.rotor, or damping of bearings and supports, instead",
            )
        if spindle.dampers:
            yield (
                (),
                "squeeze films have coefficients for a steady orbit of a given radius and no "
                "response over time: leave spindle.dampers out, or give supports with damping in "
                "their place",
            )
        yield from self._stop_faults(spindle)
        if not misnamed(spindle):
            yield from self._place_faults(spindle)
            yield from self._frequency_faults(setting)

    def _stop_faults(self, spindle: Spindle) -> Faults:
        """Check that a stop can close, and that its sleeve has a mass to strike it."""
        if self.stop_stiffness is None:
            return
        sleeves = [sleeve for sleeve in spindle.sleeves if _slides_to_stop(sleeve)]
        if not sleeves:
            yield (
                ("stop_stiffness",),
                "no sleeve slides freely on its spring up to an end stop: leave it out, or give "
                "such a sleeve its stop_travel",
            )
        for sleeve in sleeves:
            if not sleeve.mass:
                yield (
                    ("stop_stiffness",),
                    f"sleeve {sleeve.name} has no mass, which an impact on its stop needs: give "
                    "its mass, or leave stop_stiffness out",
                )

    def _frequency_faults(self, setting: Setting) -> Faults:
        """Check that unbalances rotate no faster than max_frequency."""
        top = setting.top / (2.0 * math.pi)
        for unbalance in self.unbalances:
            if isinstance(unbalance.at, str) and unbalance.at not in setting.spindle.places:
                continue
            ratio = abs(setting.spindle.ratios[setting.spindle.place(unbalance.at).rotor])
            if ratio * top > self.max_frequency:
                yield (
                    ("max_frequency",),
                    "below the frequency of rotation of an unbalance: given {given}; allowed: from "
                    f"{ratio * top:g} Hz",
                )
                return

    def _place_faults(self, spindle: Spindle) -> Faults:
        """Check that points exist, and that rotors with unbalance rotate."""
        for index, name in enumerate(self.points):
            for sentence in unknown("point", name, spindle.places):
                yield ("points", index), sentence
        for key, loads in (("forces", self.forces), ("unbalances", self.unbalances)):
            for index, at in enumerate(load.at for load in loads):
                yield from placed(at, spindle, (key, index, "at"), rotors=True)
        for index, load in enumerate(self.unbalances):
            yield from turning(load.at, spindle, ("unbalances", index, "at"))


def _slides_to_stop(sleeve: Sleeve) -> bool:
    """Return whether a sleeve slides freely on its spring up to an end stop."""
    slides = math.isfinite(sleeve.spring.stiffness) and not sleeve.friction
    return slides and math.isfinite(sleeve.stop_travel)
