"""Specification of frequency responses, and of measured ones laid over them (SI)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from rotordyn.analyses.measured_response import QUANTITIES, MeasuredResponse, Pair, Port
from rotordyn.analyses.measured_spindle import PLANES, MeasuredSpindle, at_front
from rotordyn.description import Faults, ascending, named_twice, repeated, within
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.machine.housing import housed_motions
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import MOTIONS, coupled_motions
from rotordyn.quantity import Choice, EngineOrder, Frequency, Items, Key, Speed, Sweep
from rotordyn.scene.formulation import ROTATING, turned
from rotordyn.scene.spec import Setting, Spec

ORDERS_TURNED = (
    "a multiple of the speed has another frequency in the rotating frame: leave engine_orders out, "
    "or take formulation: inertial"
)
MOST_VALUES = 100_000_000
LOADED = frozenset({"bending", "axial"})
_SPOKEN: Mapping[str, str] = {"axial": "axial motion"}


@dataclass(frozen=True, slots=True)
class FrfSpec(Spec):
    """Frequency responses between pairs of points over speed and frequency."""

    frequencies: Annotated[
        tuple[Frequency, ...],
        Sweep(),
        Key(default=()),
        "excitation frequencies, independent of speed; these or `engine_orders`, or both",
    ]
    pairs: Annotated[
        tuple[Annotated[tuple[Port, Port], Pair()], ...],
        Items(),
        Key(missing="it must be given, or matrix"),
        "responses and excitations of single FRFs; may be left out where `matrix` is given",
    ]
    slices: Annotated[
        tuple[Speed, ...],
        "speeds drawn as curves and written as UFF58 (nearest speed of the case), besides those of "
        "measured responses; by default the lowest and the highest",
    ] = ()
    quantity: Annotated[
        str, Choice(QUANTITIES), "displacement, velocity or acceleration over force"
    ] = QUANTITIES[0]
    measured: Annotated[
        tuple[MeasuredResponse, ...],
        "measured responses drawn over the computed ones "
        "([how](theory/receptances.md#measured-responses))",
    ] = ()
    measured_spindle: Annotated[
        MeasuredSpindle | None,
        "measured receptances of a spindle, with the tool of the case coupled to them; "
        "drawn over that of the computed machine at the tip ([how](howto/measured_spindle.md))",
    ] = None
    engine_orders: Annotated[
        tuple[EngineOrder, ...],
        "multiples of the speed of every rotor, integer or not, along which responses are computed",
    ] = ()

    @property
    def measured_speeds(self) -> tuple[float, ...]:
        """Speeds [rad/s] of the measured responses that are laid over."""
        coupled = () if self.measured_spindle is None else self.measured_spindle.responses[:1]
        return tuple(response.speed for response in (*self.measured, *coupled))

    def highest(self, top: float) -> float:
        """Highest frequency of the responses [Hz]; ``top``: speed of the fastest rotor [rad/s]."""
        order = max(self.engine_orders, default=0.0)
        return max(*self.frequencies[-1:], order * top / (2.0 * math.pi), 0.0)

    def _faults(self) -> Faults:
        if not self.frequencies:
            if not self.engine_orders:
                yield (
                    ("frequencies",),
                    "no frequencies: at least one is needed, or engine_orders",
                )
            for key in ("slices", "measured", "measured_spindle"):
                if getattr(self, key):
                    yield (key,), "needs frequencies, which are not given"
        yield from ascending("engine_orders", self.engine_orders)
        yield from ascending("frequencies", self.frequencies)
        yield from ascending("slices", self.slices)
        pairs = [f"{response} / {excitation}" for response, excitation in self.pairs]
        yield from repeated("pairs", ("" if "." in pair[:1] else pair for pair in pairs))
        for index, entry in enumerate(self.measured):
            if entry.name and entry.pair not in pairs:
                listed = ", ".join(pairs)
                yield (
                    ("measured", index),
                    f"not a pair of the case: given '{entry.pair}'; allowed: {listed}",
                )
            yield from self._in_band(entry, index)
        yield from named_twice("measured", self.measured)
        yield from self._in_spindle_band()

    def _in_spindle_band(self) -> Faults:
        """Require two frequencies, of the case or of the measured spindle, within both bands."""
        if self.measured_spindle is None or not self.frequencies:
            return
        measured = self.measured_spindle.responses[0].frequency
        if not measured or measured[0] != measured[0]:  # a faulty file, reported as such
            return
        low, high = self.frequencies[0], self.frequencies[-1]
        inside = {f for f in measured if low <= f <= high}
        inside |= {f for f in self.frequencies if measured[0] < f < measured[-1]}
        if len(inside) < 2:
            yield (
                ("frequencies",),
                f"fewer than two in the band of measured_spindle: given {low:g} to {high:g} Hz; "
                f"allowed: at least two from {measured[0]:g} to {measured[-1]:g} Hz",
            )

    def _in_band(self, entry: MeasuredResponse, index: int) -> Faults:
        if not self.frequencies:
            return
        low, high = self.frequencies[0], self.frequencies[-1]
        inside = [f for f in entry.frequency if not (f < low or f > high)]
        if entry.frequency and len(inside) < 2 and entry.frequency[0] == entry.frequency[0]:
            yield (
                ("measured", index, "file"),
                "{given}: fewer than two frequencies in the band of the case: given "
                f"{entry.frequency[0]:g} to {entry.frequency[-1]:g} Hz; allowed: {low:g} to "
                f"{high:g} Hz",
            )

    def faults_on(self, setting: Setting) -> Faults:
        sizes = len(setting.speeds), len(self.pairs), len(self.frequencies)
        if (count := math.prod(sizes)) > MOST_VALUES:
            yield (
                ("frequencies",),
                f"too many values: given {count:.6g} (speeds × pairs × frequencies: "
                f"{' × '.join(map(str, sizes))}); allowed: up to {MOST_VALUES:.0e}",
            )
        for index, speed in enumerate(self.slices):
            if not setting.within(speed):
                yield ("slices", index), "not within the speeds of the case: given {given}"
        for index, entry in enumerate(self.measured):
            if not setting.within(entry.speed):
                yield ("measured", index), "its speed is not within the speeds of the case"
        turning = setting.conditions.formulation == ROTATING
        if turning and self.quantity not in ("", QUANTITIES[0]):
            yield ("quantity",), f"{turned(self.quantity)}: given '{self.quantity}'"
        if turning and self.engine_orders:
            yield ("engine_orders",), ORDERS_TURNED
        if turning and self.measured:
            yield (
                ("measured",),
                "measured responses are those of the fixed frame: given with formulation rotating; "
                "allowed: inertial",
            )
        if not misnamed(setting.spindle):
            yield from self._pairs(setting)
            yield from self._coupled(setting)

    def _coupled(self, setting: Setting) -> Faults:
        """Require that the measured spindle takes the tool of the case, and a pair at its tip."""
        if self.measured_spindle is None:
            return
        yield from within(("measured_spindle",), self.measured_spindle.faults_on(setting.spindle))
        if not self.at_the_tip(setting.spindle):
            yield (
                ("measured_spindle",),
                "no pair at the tip of the tool, over which it is drawn: allowed: response and "
                "excitation in y, or in z, of the point at its front end",
            )

    def at_the_tip(self, spindle: Spindle) -> tuple[tuple[Port, Port], ...]:
        """Pairs over which the tool on a measured spindle is laid."""
        front = spindle.places
        return tuple(
            pair
            for pair in self.pairs
            if pair[0] == pair[1]
            and pair[0].direction in PLANES
            and pair[0].point in front
            and at_front(spindle, pair[0].point)
        )

    def _pairs(self, setting: Setting) -> Faults:
        """Require points that exist, and pairs whose ends belong to one motion or to coupled
        ones, as bearings under transverse loads couple bending and axial motion."""
        spindle = setting.spindle
        coupled = coupled_motions(spindle.supports) | housed_motions(spindle.housings)
        if setting.loaded:
            coupled |= LOADED
        points = [*spindle.places]
        for index, pair in enumerate(self.pairs):
            for key, port in zip(("response", "excitation"), pair, strict=True):
                for sentence in unknown("point", port.point, points):
                    yield ("pairs", index, key), sentence
            motions = [MOTIONS.get(port.direction, "") for port in pair]
            if "" in motions or motions[0] == motions[1] or coupled.issuperset(motions):
                continue
            one, other = (_SPOKEN.get(motion, motion) for motion in motions)
            yield (
                ("pairs", index),
                f"{one} and {other} are not coupled: given '{pair[0]} / {pair[1]}'; allowed: both "
                "ends in one of x; thx; y, z, thy, thz, or a support or static loads that couple "
                "them",
            )
