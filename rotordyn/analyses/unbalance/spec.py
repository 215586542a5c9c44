"""Description of an analysis of the response to unbalance (SI)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults, Path, known, repeated
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import Duration, Items, PointName
from rotordyn.scene.loads import BalanceGrade, EccentricSpan, Unbalance
from rotordyn.scene.spec import Setting, Spec, placed, span_faults, turning
from rotordyn.units import format_quantity


@dataclass(frozen=True, slots=True)
class UnbalanceSpec(Spec):
    """Steady response to unbalance at every speed: amplitudes are zero to peak.

    All of ``unbalances``, ``spans`` and ``grade`` act together.
    """

    points: Annotated[tuple[PointName, ...], Items(), "points whose motion is computed"]
    unbalances: Annotated[tuple[Unbalance, ...], "unbalances at points or stations"] = ()
    spans: Annotated[
        tuple[EccentricSpan, ...], "spans of the shaft with an eccentric centre of mass"
    ] = ()
    grade: Annotated[
        BalanceGrade | None,
        "residual unbalance by balance quality grade, added to the others",
    ] = None
    run_up: Annotated[
        tuple[Duration, ...],
        "durations of runs with constant acceleration from the first to the last speed of the "
        "case, through its resonances: the motion of the points during the run is computed",
    ] = ()
    run_down: Annotated[tuple[Duration, ...], "durations of run-downs, likewise"] = ()

    def _faults(self) -> Faults:
        yield from repeated("points", self.points)
        for key in ("run_up", "run_down"):
            yield from repeated(key, map(run_name, getattr(self, key)))
        if not (self.unbalances or self.spans or self.grade):
            yield (), "there is no unbalance: allowed: at least one of unbalances, spans, grade"

    def faults_on(self, setting: Setting) -> Faults:
        spindle, speeds = setting.spindle, setting.speeds
        for key in ("run_up", "run_down"):
            if getattr(self, key) and len(speeds) < 2 and all(map(known, speeds)):
                yield (key,), "needs two speeds of the case, at which the run begins and ends"
            if getattr(self, key) and spindle.hysteretic:
                yield (
                    (key,),
                    "loss factors are defined for steady vibration alone: give damping of rotor or "
                    "supports in place of loss_factor",
                )
        if misnamed(spindle):
            return
        for index, name in enumerate(self.points):
            for sentence in unknown("point", name, spindle.places):
                yield ("points", index), sentence
        for index, unbalance in enumerate(self.unbalances):
            yield from placed(unbalance.at, spindle, ("unbalances", index, "at"), rotors=True)
        for index, span in enumerate(self.spans):
            yield from span_faults(span.start, span.to, spindle, ("spans", index), rotors=True)
        if self.grade is not None:
            yield from _plane_faults(self.grade, spindle)
        yield from self._speed_faults(spindle)

    def _speed_faults(self, spindle: Spindle) -> Faults:
        """Check that all rotors out of balance turn, and at one speed."""
        first: dict[float, str] = {}
        for path, at in self._acting():
            if isinstance(at, str) and at not in spindle.places:
                continue
            rotor = spindle.place(at).rotor
            ratio = spindle.ratios[rotor]
            yield from turning(at, spindle, path)
            if ratio == ratio and ratio != 0.0 and ratio not in first:
                first[ratio] = rotor
                if len(first) > 1:
                    others = " and ".join(f"'{name}'" for name in first.values())
                    yield (
                        path,
                        f"rotors {others} rotate at different speeds: give the unbalance of one at "
                        "a time",
                    )

    def _acting(self) -> Iterator[tuple[Path, str | float]]:
        """Yield the path of keys, and point or station, of every unbalance."""
        for index, unbalance in enumerate(self.unbalances):
            yield ("unbalances", index, "at"), unbalance.at
        for index, span in enumerate(self.spans):
            yield ("spans", index, "from"), span.start
        for index, at in enumerate(self.grade.planes if self.grade else ()):
            yield ("grade", "planes", index), at

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations of results and of unbalance."""
        return (*self.points, *self.acting)

    @property
    def acting(self) -> tuple[str | float, ...]:
        """Points and stations of unbalance; both ends of a span."""
        places = [unbalance.at for unbalance in self.unbalances]
        places += [at for span in self.spans for at in (span.start, span.to)]
        return (*places, *(self.grade.planes if self.grade else ()))


def run_name(time: float) -> str:
    """Return a time [s] as the name of a run."""
    return f"{time:g} s"


def _plane_faults(grade: BalanceGrade, spindle: Spindle) -> Faults:
    """Check that planes are on one rotor; of two, one on either side of its centre of gravity."""
    path = ("grade", "planes")
    faults = [
        fault
        for index, at in enumerate(grade.planes)
        for fault in placed(at, spindle, (*path, index), rotors=True)
    ]
    yield from faults
    if faults or len(grade.planes) != 2 or "" in grade.planes:
        return
    places = [spindle.place(at) for at in grade.planes]
    if places[0].rotor != places[1].rotor:
        given = " and ".join(place.rotor for place in places)
        yield path, f"both must be on one rotor: given {given}"
        return
    from rotordyn.machine.inertia import rotor_inertia  # numpy, which a check seldom needs

    ends = sorted(place.x for place in places)
    centre = rotor_inertia(spindle.part(places[0].rotor)).centre
    if ends[0] >= centre or ends[1] <= centre:
        yield (
            path,
            "the centre of gravity must lie between the two planes: it is at "
            f"{format_quantity(centre, 'mm')}; allowed: one plane on either side, or unbalances "
            "given one by one",
        )
