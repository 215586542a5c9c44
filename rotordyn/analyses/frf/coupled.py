"""The tool of the case on a measured spindle, as one more response beside the computed ones."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.analyses.measured_spindle import PLANES
from rotordyn.analyses.on_measured import OnMeasured
from rotordyn.machine.spindle import Spindle

NAME = "tool on the measured spindle"


def with_coupled(spec: FrfSpec, spindle: Spindle) -> tuple[FrfSpec, dict[str, float]]:
    """The spec with the coupled tip among what was measured, and the errors of these by noise, over
    their size, by name; the spec itself where no spindle was measured."""
    if spec.measured_spindle is None:
        return spec, {}
    machine = OnMeasured(spec.measured_spindle, spindle)
    added, errors = [], {}
    for port, _ in spec.at_the_tip(spindle):
        # a spindle measured in one plane answers alike in the other
        way = port.direction if port.direction in machine.fits else machine.measured.planes[0]
        name = NAME if port.direction == PLANES[0] else f"{NAME} {port.direction}"
        added.append(_coupled(machine, port, way, spec, name))
        omega = 2.0 * math.pi * np.array(added[-1].frequency)
        error, size = machine.error(way, omega), np.abs(machine.tip(way, omega))
        errors[name] = float(np.linalg.norm(error) / np.linalg.norm(size))
    return replace(spec, measured=(*spec.measured, *added)), errors


def _coupled(
    machine: OnMeasured, port: Port, way: str, spec: FrfSpec, name: str
) -> MeasuredResponse:
    """At the frequencies of the measurement, and of the case between them."""
    measured = np.array(machine.measured.responses[0].frequency)
    asked = np.array(spec.frequencies)
    inside = asked[(asked > measured[0]) & (asked < measured[-1])]
    hertz = np.unique(np.concatenate([measured, inside]))
    values = machine.tip(way, 2.0 * math.pi * hertz)
    return MeasuredResponse(
        name=name,
        response=port,
        excitation=port,
        frequency=tuple(hertz.tolist()),
        real=tuple(values.real.tolist()),
        imaginary=tuple(values.imag.tolist()),
        speed=machine.measured.responses[0].speed,
    )
