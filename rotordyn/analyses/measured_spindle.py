"""A spindle that is known by receptances measured at a blank, or at its nose (SI)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated

from rotordyn.analyses.measured_response import QUANTITIES, MeasuredResponse, as_quantity
from rotordyn.analyses.passivity import APART, EXCESS, apart, excess, fault_at_driving_point
from rotordyn.description import Description, Faults
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.station import SLACK
from rotordyn.machine.tool import Tool
from rotordyn.quantity import Items, LossFactor, Whole

NOSE = 0.0  # station of the nose face [m]
PLANES = ("y", "z")
# Of the distance of two frequencies: over it a peak as narrow as that distance changes by 2e-3,
# which is below the noise of a measurement; frequencies rounded to six digits differ by as much.
SAME = 1e-3
NEEDED = (
    "the responses at two points in one direction, front / front, front / behind and "
    "behind / behind, of which the front one is at the tip of the blank, or at the nose"
)


@dataclass(frozen=True, slots=True)
class MeasuredSpindle(Description):
    """A spindle described by radial receptances, measured at rest at two points of a blank or of
    the nose; the tool of the case is coupled to it."""

    responses: Annotated[
        tuple[MeasuredResponse, ...],
        Items(),
        "measured responses at the front point, between it and a point behind it, and at "
        "the point behind; in y, or in y and z",
    ]
    modes: Annotated[
        Annotated[int, Whole(1, 60)] | None,
        "number of modes fitted to the responses, which averages noise; by default as many as "
        "are distinct from the noise",
    ] = None
    blank: Annotated[
        Tool | None,
        "name or path of the blank clamped into the nose for the measurement, which the "
        "analysis uncouples",
    ] = None

    loss_factor: Annotated[
        LossFactor, "η of the stiffness of tool and blank, twice a damping ratio"
    ] = 0.0

    @property
    def planes(self) -> tuple[str, ...]:
        """Directions in which the spindle is measured."""
        measured = {response.response.direction for response in self.responses}
        return tuple(plane for plane in PLANES if plane in measured)

    def of_plane(self, way: str) -> dict[tuple[str, str], MeasuredResponse]:
        """Responses in the direction ``way``; keys are the names of both points, alphabetic: by
        reciprocity, the point of the force and that of the motion may be exchanged."""
        return {self._ends(r): r for r in self.responses if r.response.direction == way}

    @staticmethod
    def _ends(measured: MeasuredResponse) -> tuple[str, str]:
        first, second = sorted((measured.response.point, measured.excitation.point))
        return first, second

    def _faults(self) -> Faults:
        crossed = [*self._directions()]
        yield from crossed
        if crossed or any(len(measured.frequency) < 2 for measured in self.responses):
            return
        yield from self._at_rest()
        mismatched = [*self._samples()]
        yield from mismatched
        if not mismatched:
            for plane in self.planes:
                yield from self._passive(plane)
        if self.blank is not None:
            yield from self._blank(self.blank)

    def _directions(self) -> Faults:
        for index, measured in enumerate(self.responses):
            direction, other = measured.response.direction, measured.excitation.direction
            if direction != other or direction not in PLANES:
                yield (
                    ("responses", index),
                    f"coupling needs motion and force in one direction across the axis: given "
                    f"'{measured.pair}'; allowed: both in y, or both in z",
                )

    def _at_rest(self) -> Faults:
        for index, measured in enumerate(self.responses):
            if measured.speed:
                yield (
                    ("responses", index, "speed"),
                    "coupling needs responses measured at rest: given {given}; leave speed out, or "
                    "measure at rest",
                )

    def _samples(self) -> Faults:
        first = self.responses[0].frequency
        for index, measured in enumerate(self.responses):
            if not _same_samples(measured.frequency, first):
                yield (
                    ("responses", index),
                    "measured at other frequencies than the first response: allowed: the same",
                )
        if len(first) < 6:
            yield ("responses",), f"too few frequencies: given {len(first)}; allowed: from 6"
        elif self.modes and len(first) < 4 * self.modes + 2:
            most = (len(first) - 2) // 4
            yield (
                ("modes",),
                f"too many for {len(first)} frequencies: given {{given}}; allowed: up to {most}",
            )

    def _passive(self, plane: str) -> Faults:
        """Faults of responses of a plane that are not passive, or not reciprocal."""
        index = {id(measured): k for k, measured in enumerate(self.responses)}
        by_ends = self.of_plane(plane)
        values = {ends: _mobility(measured) for ends, measured in by_ends.items()}
        active = False
        for ends, measured in by_ends.items():
            fault = _fault(measured) if len(set(ends)) == 1 else None
            if fault:
                active = True
                yield (
                    ("responses", index[id(measured)]),
                    f"{measured.pair} is not that of a driving point: {fault}",
                )
        if active:
            return
        for measured in self.responses:
            other = by_ends.get(self._ends(measured), measured)
            share = apart(_mobility(other), _mobility(measured)) if measured is not other else 0.0
            if measured.response.direction == plane and share > APART:
                yield (
                    ("responses", index[id(measured)]),
                    f"{measured.pair} and {other.pair} differ by {share**0.5:.0%}, but are equal "
                    "at rest by reciprocity: check whether a file is that of another point, or "
                    "give only one",
                )
        cross = [ends for ends in by_ends if ends[0] != ends[1]]
        ports = [(name, name) for name in cross[0]] if len(cross) == 1 else []
        if ports and all(port in by_ends for port in ports):
            share = excess(values[ports[0]], values[cross[0]], values[ports[1]])
            if share > EXCESS:
                yield (
                    ("responses", index[id(by_ends[cross[0]])]),
                    f"together with the responses at {' and '.join(cross[0])} it is not that of a "
                    f"passive structure: check whether files of points or directions in {plane} "
                    "are exchanged",
                )

    def _blank(self, blank: Tool) -> Faults:
        yield from uncoupled(("blank",), blank.masses, blank.joints)
        yield from self._points(blank.placed(NOSE), blank.front(NOSE))

    def _points(self, points: Mapping[str, float], front: float) -> Faults:
        """Require three responses per plane, between two existing points, one at ``front`` [m]."""
        for index, measured in enumerate(self.responses):
            for key, port in (("response", measured.response), ("excitation", measured.excitation)):
                if port.point not in points:
                    allowed = ", ".join(points) or "none"
                    yield (
                        ("responses", index, key),
                        f"unknown point: given '{port.point}'; allowed: {allowed}",
                    )
                    return
        for plane in self.planes:
            names = {name for pair in self.of_plane(plane) for name in pair}
            stations = sorted((points[name], name) for name in names)
            needed = {(name, other) for name in names for other in names if name <= other}
            measured_ends = {self._ends(measured) for measured in self.responses}
            if len(stations) != 2 or needed - measured_ends or abs(stations[0][0] - front) > SLACK:
                listed = ", ".join(measured.pair for measured in self.responses)
                yield ("responses",), f"given {listed}; allowed: {NEEDED}"
                return

    def faults_on(self, spindle: Spindle) -> Faults:
        """Faults of the machine whose tool is coupled to the measured spindle."""
        if not spindle.shaft.start < NOSE - SLACK:
            yield (
                (),
                "there is no tool to couple to the measured spindle: give tool, or tools, of the "
                "case",
            )
            return
        masses = tuple(mass for mass in spindle.masses if mass.x <= NOSE)
        joints = tuple(joint for joint in spindle.joints if joint.x < NOSE - SLACK)
        for _, sentence in uncoupled((), masses, joints):
            yield (), sentence
        if self.blank is None and not any(self._directions()):
            yield from self._points(dict(spindle.points), NOSE)

    def stations(self, spindle: Spindle) -> dict[str, float]:
        """Stations of the named points [m]."""
        return dict(spindle.points if self.blank is None else self.blank.placed(NOSE))


def _same_samples(frequency: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two ascending lists of frequencies [Hz] are equal but for rounding."""
    if len(frequency) != len(other):
        return False
    least = min(after - before for before, after in pairwise(other))
    return all(abs(a - b) <= SAME * least for a, b in zip(frequency, other, strict=True))


def _fault(measured: MeasuredResponse) -> str | None:
    """Sentence on what a response seems to be instead of one at a driving point; else None."""
    omega = [2.0 * math.pi * hertz for hertz in measured.frequency]
    return fault_at_driving_point(
        as_quantity(measured, measured.quantity).tolist(), omega, measured.quantity
    )


def _mobility(measured: MeasuredResponse) -> list[complex]:
    """Mobility of a response, with the phase of the receptance."""
    return [complex(value) for value in -1j * as_quantity(measured, QUANTITIES[1])]


def uncoupled(
    path: tuple[str, ...], masses: tuple[PointMass, ...], joints: tuple[Joint, ...]
) -> Faults:
    """Faults of a tool that has parts which the coupling does not model."""
    inner = [joint.name for joint in joints if joint.x < NOSE - SLACK]
    if masses:
        yield (
            path,
            f"coupling does not model point masses on a tool: given {len(masses)}; allowed: "
            "sections, with mean_density, and a joint at x = 0",
        )
    if inner:
        yield (
            path,
            f"coupling does not model a joint within a tool: given {', '.join(inner)}; allowed: x "
            "= 0",
        )


def at_front(spindle: Spindle, point: str) -> bool:
    """Whether a point is at the front end of the shaft, where the tip of its tool is."""
    return point in spindle.points and abs(spindle.points[point] - spindle.shaft.start) <= SLACK
