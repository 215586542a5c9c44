"""Receptance of the tip of a tool on a spindle known by measured receptances.

These are fitted by modes, the blank is uncoupled, and the tool is coupled in its place. The tool is
exact by Timoshenko's theory and at rest, as the spindle was when it was measured.

Theory: docs/theory/coupling.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property, lru_cache

import numpy as np

from rotordyn.analyses.coupling import (
    Ends,
    Section,
    beam,
    between_points,
    couple,
    joint_flexibility,
    rotations,
    uncouple,
)
from rotordyn.analyses.measured_response import QUANTITIES, MeasuredResponse, as_quantity
from rotordyn.analyses.measured_spindle import NOSE, MeasuredSpindle
from rotordyn.analyses.modal_fit import ModalFit, modal_fit
from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput
from rotordyn.machine import shaft
from rotordyn.machine.joint import Joint
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.station import SLACK

CONE_PIECES = 24  # cylinders in place of a cone
STEP = 1e-6  # of a response: of finite differences
FEW = 0.5  # of a misfit: more modes that leave less than this are needed
POOR = 0.1  # misfit by too few modes from which on the tip is refused
HIDDEN = 0.7  # of the tip: error by noise from which on the blank hides the spindle
SURE = 3.0  # standard deviations of the noise, beyond which a tip is not passive
ACTIVE = 0.01  # of the tip: positive imaginary part that is reported
UNSUITABLE = (
    "the blank is as stiff as the spindle, or so flexible that it hides the spindle: take a "
    "shorter blank, or a thicker one"
)
CLOSE = "take points farther apart, or a blank"


class OnMeasured:
    """Response at the tip of the tool of ``spindle`` on a measured spindle."""

    def __init__(self, measured: MeasuredSpindle, spindle: Spindle) -> None:
        self.measured, self.loss = measured, measured.loss_factor
        self._tool = [
            section
            for section, end in zip(
                spindle.shaft.sections, spindle.shaft.boundaries[1:], strict=True
            )
            if end <= NOSE + SLACK
        ]
        self._joint = _at_nose(spindle.joints)
        stations = measured.stations(spindle)
        ports = ((response.response, response.excitation) for response in measured.responses)
        names = {port.point for pair in ports for port in pair}
        self._front, self._behind = sorted(names, key=lambda name: stations[name])
        self._spacing = stations[self._behind] - stations[self._front]
        self._beams: dict[bytes, tuple[Ends | None, Complex, Ends, Complex]] = {}
        self._hidden: dict[str, str] = {}

    @cached_property
    def omega(self) -> Array:
        """Angular frequencies of the measurement [rad/s]."""
        return 2.0 * math.pi * np.array(self.measured.responses[0].frequency)

    @cached_property
    def fits(self) -> dict[str, ModalFit]:
        """Modes fitted to the three responses of every plane, front, across and behind."""
        return {plane: self._fit(plane, self.measured.modes) for plane in self.measured.planes}

    def tip(self, plane: str, omega: Array) -> Complex:
        """Receptance of the tip in a plane at angular frequencies within the band (f,) [m/N].

        Raises
        ------
        InvalidInput : a blank that hides the spindle behind the noise of its responses, or too few
            modes to tell
        """
        if plane not in self._hidden:
            self._hidden[plane] = self._why_hidden(plane)
        if why := self._hidden[plane]:
            raise InvalidInput(f"measured_spindle: {why}")
        return self._tip(self.fits[plane](omega), *self._parts(omega))

    def error(self, plane: str, omega: Array) -> Array:
        """Standard deviation of ``tip`` from the noise of the measurement (f,) [m/N].

        The noise is what the modes leave, independent in every sample; poles and residues fitted
        to all of them carry it to the tip, by derivatives.
        """
        carried = self.fits[plane].carried(omega, self._derivative(plane, omega))
        return np.asarray(np.linalg.norm(carried, axis=1))

    def amplitude_error(self, plane: str, omega: Array) -> Array:
        """Standard deviation of the amplitude of ``tip`` from the same noise, over it (f,): of the
        part of the error that is in phase with the tip."""
        tip = self.tip(plane, omega)
        share = self._derivative(plane, omega) / tip[:, None]
        return self.fits[plane].carried(omega, share)[:, 0]

    def calibration(self, plane: str, omega: Array) -> Array:
        """Change of ``tip`` (f,) [m/N] over the relative error of gain, or of phase [rad], of every
        response, the root of the sum of squares of all three.

        Unlike noise, such errors are the same at all frequencies, and no average lessens them.
        """
        share = self._derivative(plane, omega) * self.fits[plane](omega)
        return np.asarray(np.linalg.norm(share, axis=1))

    def doubt(self, plane: str) -> str:
        """Sentence on what makes the tip in a plane doubtful; empty where nothing does."""
        doubts, fit, omega = [], self.fits[plane], self.omega
        if fit.at_most:
            doubts.append(
                f"{len(fit.fit.pole)} modes, the largest number tried, are fitted, and some may be "
                "noise: give modes, or check whether the responses are those of a linear structure"
            )
        if too_few := self._too_few_modes(plane):
            doubts.append(too_few)
        tip = self.tip(plane, omega)
        positive = np.maximum(tip.imag - SURE * self.error(plane, omega), 0.0)
        share = np.linalg.norm(positive) / np.linalg.norm(tip)
        if share > ACTIVE:
            hertz = omega[positive.argmax()] / (2.0 * math.pi)
            doubts.append(
                f"the tip is not that of a passive structure, by {100.0 * share:.0f} % of its "
                "size and most at "
                f"{hertz:.5g} Hz: check gains and delays of the channels, and the blank"
            )
        return "; ".join(doubts)

    def _derivative(self, plane: str, omega: Array) -> Complex:
        """Derivatives (f, 3) of the tip by the responses."""
        values, parts = self.fits[plane](omega), self._parts(omega)
        unchanged, derivative = self._tip(values, *parts), np.empty_like(values)
        for k in range(values.shape[1]):
            changed = values.copy()
            changed[:, k] *= 1.0 + STEP
            derivative[:, k] = (self._tip(changed, *parts) - unchanged) / (STEP * values[:, k])
        return derivative

    def _why_hidden(self, plane: str) -> str:
        """Sentence on why the tip cannot be found; empty where it can."""
        if self.fits[plane].misfit > POOR and (too_few := self._too_few_modes(plane)):
            return too_few
        try:
            tip = self._tip(self.fits[plane](self.omega), *self._parts(self.omega))
            share = np.linalg.norm(self.error(plane, self.omega)) / np.linalg.norm(tip)
        except InvalidInput as error:
            return self._too_few_modes(plane) or str(error)
        if share < HIDDEN:
            return ""
        cause = CLOSE if self.measured.blank is None else UNSUITABLE
        return self._too_few_modes(plane) or (
            f"the noise of the responses causes an error of {100.0 * share:.0f} % at the tip: "
            f"{cause}, or "
            "measure with less noise"
        )

    def _too_few_modes(self, plane: str) -> str:
        """Sentence on why a misfit is not noise; empty where more modes do not halve it."""
        if self.measured.modes is None:
            return ""
        fit, best = self.fits[plane], self._fit(plane, None)
        if best.misfit > FEW * fit.misfit:
            return ""
        return (
            f"modes: given {self.measured.modes}, with a misfit of "
            f"{100.0 * fit.misfit:.2f} % to the "
            f"responses ({len(best.fit.pole)} have {100.0 * best.misfit:.2f} %): raise "
            "modes, or leave it "
            "out"
        )

    def _fit(self, plane: str, modes: int | None) -> ModalFit:
        """Fit of ``modes`` modes to the responses of a plane; None: as many as its noise leaves."""
        by_ends = self.measured.of_plane(plane)
        front, behind = self._front, self._behind
        across = min(front, behind), max(front, behind)
        three = by_ends[front, front], by_ends[across], by_ends[behind, behind]
        return _fitted(three, modes)

    def _parts(self, omega: Array) -> tuple[Ends | None, Complex, Ends, Complex]:
        """Receptances of the blank and flexibility of its joint, then those of the tool, computed
        once for both planes."""
        key = omega.tobytes()
        if key not in self._beams:
            self._beams[key] = self._bodies(omega)
        return self._beams[key]

    def _bodies(self, omega: Array) -> tuple[Ends | None, Complex, Ends, Complex]:
        """Compute what ``_parts`` returns."""
        tool = beam(omega, _pieces(self._tool, self.loss)), _flexibility(omega, self._joint)
        if (blank := self.measured.blank) is None:
            return None, _flexibility(omega, None), *tool
        front, rear = _split(_pieces(blank.sections, self.loss), self._spacing)
        blank_ends = between_points(beam(omega, front), beam(omega, rear) if rear else None)
        return blank_ends, _flexibility(omega, _at_nose(blank.joints)), *tool

    def _tip(
        self,
        values: Complex,
        blank: Ends | None,
        blank_joint: Complex,
        tool: Ends,
        joint: Complex,
    ) -> Complex:
        """Receptance of the tip (f,) from ``values`` (f, 3): front, across and behind."""
        front, across, behind = values.T
        if blank is None:
            base = rotations(front, across, self._spacing, behind)
        else:
            rows = np.stack([front, across], -1), np.stack([across, behind], -1)
            base = uncouple(blank, np.stack(rows, -2), blank_joint)
        return couple(tool, base, joint)[:, 0, 0]


@lru_cache(maxsize=8)
def _fitted(responses: tuple[MeasuredResponse, ...], modes: int | None) -> ModalFit:
    """Fit of ``modes`` modes to responses; None: as many as there is evidence of. All tools and
    analyses share it."""
    omega = 2.0 * math.pi * np.array(responses[0].frequency)
    values = np.array([as_quantity(response, QUANTITIES[0]) for response in responses]).T
    coherence = None
    if all(response.coherence for response in responses):
        coherence = np.array([response.coherence for response in responses]).T
    return modal_fit(omega, values, modes, coherence)


def _at_nose(joints: Sequence[Joint]) -> Joint | None:
    return next((joint for joint in joints if abs(joint.x - NOSE) <= SLACK), None)


def _flexibility(omega: Array, joint: Joint | None) -> Complex:
    if joint is None:
        return np.zeros((len(omega), 2, 2), dtype=complex)
    coefficients = (joint.radial, joint.tilt, joint.radial_damping, joint.tilt_damping)
    return joint_flexibility(omega, *coefficients)


def _split(sections: list[Section], at: float) -> tuple[list[Section], list[Section]]:
    """Sections up to a distance ``at`` [m] from the tip, and those behind it."""
    front, rear = [], []
    for section in sections:
        part = min(max(at, 0.0), section.length)
        if part > SLACK:
            front.append(section._replace(length=part))
        if section.length - part > SLACK:
            rear.append(section._replace(length=section.length - part))
        at -= section.length
    return front, rear


def _pieces(sections: Sequence[shaft.Section], loss: float) -> list[Section]:
    """Sections as cylinders; a cone as ``CONE_PIECES`` of them, of its diameters half-way."""
    pieces = []
    for section in sections:
        (outer, outer_end), (inner, inner_end) = section.outer, section.inner
        count = 1 if outer == outer_end and inner == inner_end else CONE_PIECES
        for share in (np.arange(count) + 0.5) / count:
            pieces.append(
                Section(
                    section.length / count,
                    outer + (outer_end - outer) * float(share),
                    inner + (inner_end - inner) * float(share),
                    section.material.young_modulus,
                    section.density,
                    section.material.poisson_ratio,
                    loss,
                )
            )
    return pieces
