"""Tip response of the case's tool on a measured spindle, laid over the computed ones."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.analyses.measured_spindle import PLANES
from rotordyn.analyses.on_measured import OnMeasured
from rotordyn.arrays import Array, Complex
from rotordyn.machine.spindle import Spindle

NAME = "tool on the measured spindle"
ROUNDS, TRIED = 2, 41  # frequencies tried around each peak, and once more around the best


class TipError(NamedTuple):
    """What makes a coupled tip uncertain: ``noise`` over its size, ``calibration``: its relative
    error over that of every response, a sentence of ``doubt``; ``at``: the standard deviation of
    its amplitude by noise, over it, at frequencies (n,) [Hz]."""

    noise: float
    calibration: float
    doubt: str
    at: Callable[[Array], Array]


def with_coupled(spec: FrfSpec, spindle: Spindle) -> tuple[FrfSpec, dict[str, TipError]]:
    """Add the coupled tip to the measured responses of a spec; the spec itself without a measured
    spindle. Returns the errors of the added responses, by name, as well."""
    if spec.measured_spindle is None:
        return spec, {}
    machine = OnMeasured(spec.measured_spindle, spindle)
    added, errors = [], {}
    for port, _ in spec.at_the_tip(spindle):
        # a spindle measured in one plane is taken to be the same in the other
        plane = port.direction if port.direction in machine.fits else machine.measured.planes[0]
        name = NAME if port.direction == PLANES[0] else f"{NAME} {port.direction}"
        added.append(_coupled(machine, port, plane, spec, name))
        errors[name] = _error(machine, plane, np.array(added[-1].frequency))
    return replace(spec, measured=(*spec.measured, *added)), errors


def _error(machine: OnMeasured, plane: str, hertz: Array) -> TipError:
    """Error of the tip over its size: of root mean squares at ``hertz`` (f,), and at others."""
    omega = 2.0 * math.pi * hertz
    size = np.linalg.norm(machine.tip(plane, omega))
    noise, calibration = (
        float(np.linalg.norm(of(plane, omega)) / size)
        for of in (machine.error, machine.calibration)
    )

    def at(hertz: Array) -> Array:
        return machine.amplitude_error(plane, 2.0 * math.pi * hertz)

    return TipError(noise, calibration, machine.doubt(plane), at)


def _coupled(
    machine: OnMeasured, port: Port, plane: str, spec: FrfSpec, name: str
) -> MeasuredResponse:
    """Response of the tip at the measured frequencies, those of the case in between, and peaks."""
    measured = np.array(machine.measured.responses[0].frequency)
    of_case = np.array(spec.frequencies)
    inside = of_case[(of_case > measured[0]) & (of_case < measured[-1])]
    hertz = np.unique(np.concatenate([measured, inside]))

    def tip(at: Array) -> Complex:
        return machine.tip(plane, 2.0 * math.pi * at)

    hertz = np.union1d(hertz, _peaks(tip, hertz))
    values = tip(hertz)
    return MeasuredResponse(
        name=name,
        response=port,
        excitation=port,
        frequency=tuple(hertz.tolist()),
        real=tuple(values.real.tolist()),
        imaginary=tuple(values.imag.tolist()),
        speed=machine.measured.responses[0].speed,
    )


def _peaks(response: Callable[[Array], Complex], hertz: Array) -> Array:
    """Frequencies of the local maxima of a response, refined between those of a grid.

    Every evaluation includes the whole grid, over which the noise of the measurement is estimated.
    """
    size = np.abs(response(hertz))
    top = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])) + 1
    low, high = hertz[top - 1], hertz[top + 1]
    best = hertz[top]
    for _ in range(ROUNDS if top.size else 0):
        tried = np.linspace(low, high, TRIED)
        with_grid = np.union1d(hertz, tried)
        amplitude = np.abs(response(with_grid))[np.searchsorted(with_grid, tried)]
        best = np.take_along_axis(tried, amplitude.argmax(axis=0)[None], axis=0)[0]
        step = (high - low) / (TRIED - 1)
        low, high = np.maximum(best - step, hertz[0]), np.minimum(best + step, hertz[-1])
    return best
