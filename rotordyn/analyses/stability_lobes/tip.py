"""Receptance between the tip of the tool and the workpiece in feed and normal, at every speed.

It is the sum of that of the machine, from its free motions, and that of the modes of the workpiece.

Teeth turn from the normal to the feed as the spindle turns from y to z: normal = y and feed = z,
both rotated by the angle of the feed. With the opposite sense the gyroscopic cross receptances
would have the opposite sign.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rotordyn.analyses.stability_lobes.modal import (
    RIGID,
    Change,
    ModalTip,
    feed_and_normal,
    frequencies_near,
)
from rotordyn.analyses.stability_lobes.sampling import NEGLIGIBLE, STIFF
from rotordyn.analyses.stability_lobes.tip_modes import TipModes
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.equation.free_motion import FreeMotions, free_motions
from rotordyn.errors import InvalidInput
from rotordyn.numerics.modes import WELL_CONDITIONED
from rotordyn.results.display import RPM
from rotordyn.scene.scene import Scene
from rotordyn.scene.stability import fastest_growth

UNDAMPED = 1e-9  # damping ratio below which a pole counts as undamped
HIGH = 0.25  # of the highest peak: least height of high peaks
BEYOND = 1.5  # times the highest mode that matters


@dataclass(frozen=True)
class Tip:
    """Tip of the tool at the usable speeds of a scene; ``feed`` [rad] from z in the sense of
    rotation; modes below ``highest`` [Hz]; modes of the ``workpiece``, the same at all speeds."""

    scene: Scene
    point: str
    feed: float
    highest: float
    workpiece: ModalTip = RIGID

    @cached_property
    def _parts(self) -> list[tuple[FreeMotions, list[tuple[int, int]], Array]]:
        """Subsystems that move the point: free motions, pairs (response, excitation) of the
        directions y = 0 and z = 1 in each, rows of these directions (k, n)."""
        place = self.scene.spindle.place(self.point)
        grouped: dict[int, list[int]] = {}
        for k, direction in enumerate("yz"):
            grouped.setdefault(self.scene.owner(self.point, direction), []).append(k)
        parts = []
        for system, directions in grouped.items():
            motions = self.scene.system(system)
            rows = np.array([motions.linear.row(*place, "yz"[k]) for k in directions])
            pairs = [(i, j) for i in directions for j in directions]
            parts.append((motions, pairs, rows))
        return parts

    @property
    def count(self) -> int:
        """Number of speeds."""
        return len(self._speed)

    @property
    def _speed(self) -> Array:
        return self._parts[0][0].linear.speed

    @property
    def _axes(self) -> Array:
        return feed_and_normal(self.feed)

    def receptance(self, omega: Array) -> Complex:
        """Return receptance (s, f, 2, 2) [m/N] at the frequencies (s, f) [rad/s] of each speed."""
        total = np.zeros((*omega.shape, 2, 2), dtype=complex)
        for motions, pairs, rows in self._parts:
            directions = sorted({i for i, _ in pairs})
            responses = np.array([rows[directions.index(i)] for i, _ in pairs])
            excitations = np.array([rows[directions.index(j)] for _, j in pairs])
            values = motions.receptance(omega, responses, excitations)
            for k, (i, j) in enumerate(pairs):
                total[..., i, j] = values[:, k]
        return np.asarray(self._axes @ total @ self._axes.T) + self.workpiece.receptance(omega)

    @cached_property
    def modes(self) -> TipModes | None:
        """Modes whose sum is the receptance; None with loss factors or rigid-body modes, for which
        it is no such sum."""
        poles, shapes, participations = [], [], []
        for motions, pairs, rows in self._parts:
            if motions.lossy is not None or motions.modes.condition.max() >= WELL_CONDITIONED:
                return None
            directions = np.eye(2)[sorted({i for i, _ in pairs})] @ self._axes.T
            shape = np.einsum("wn,snk->skw", rows, motions.vector) @ directions
            poles.append(motions.pole)
            # ``ModalTip`` adds the conjugate of every pole
            shapes.append(np.where(motions.paired[..., None], shape, 0.5 * shape))
            participations.append(np.einsum("skn,wn->skw", motions.left, rows) @ directions)
        tool = TipModes(*(np.concatenate(each, axis=1) for each in (poles, shapes, participations)))
        return tool.beside(self.workpiece)

    @cached_property
    def growing(self) -> Complex:
        """Pole of the most unstable mode without a cut (s,) [rad/s], 0 where none is unstable."""
        return fastest_growth([motions for motions, *_ in self._parts], self.count)

    def at(self, row: int) -> Tip:
        """Return the tip at one of the speeds."""
        tip = replace(self)
        chosen = np.array([row])
        parts = [(motions.at(chosen), *rest) for motions, *rest in self._parts]
        tip.__dict__["_parts"] = parts
        return tip

    def changed(self, rows: Indices, change: Change) -> Tip:
        """Return the tip at some of the speeds, with stiffness and damping ratios scaled."""
        # damping matrices scale with √(k m) for the same damping ratios
        stiffness, damping = change.stiffness, change.damping * np.sqrt(change.stiffness)
        highest = self.highest * math.sqrt(float(change.stiffness.max()))
        tip = replace(self, highest=highest)
        tip.__dict__["_parts"] = [
            (free_motions(motions.linear.at(rows).scaled(stiffness, damping)), *rest)
            for motions, *rest in self._parts
        ]
        return tip

    @cached_property
    def poles(self) -> Complex:
        """Poles (s, k) of oscillating modes below the highest frequency, NaN for other modes.

        Raises
        ------
        InvalidInput : a mode without damping that moves the tip
        """
        workpiece = np.broadcast_to(self.workpiece.pole, (self.count, len(self.workpiece.pole)))
        pole = np.concatenate([*(motions.pole for motions, *_ in self._parts), workpiece], axis=1)
        limit = 2.0 * math.pi * self.highest
        with np.errstate(invalid="ignore"):
            kept = (pole.imag > 1e-3) & (pole.imag < limit) & (pole.imag > -pole.real)
        pole = np.where(kept, pole, complex(np.nan, np.nan))
        self._refuse_undamped(pole)
        return pole

    def _refuse_undamped(self, pole: Complex) -> None:
        with np.errstate(invalid="ignore"):
            undamped = np.abs(pole.real) <= UNDAMPED * np.abs(pole)
        if not undamped.any():
            return
        row, column = np.argwhere(undamped)[0]
        rpm = self._speed[row] * RPM.factor
        hertz = pole[row, column].imag / (2.0 * math.pi)
        raise InvalidInput(
            f"stability_lobes: the mode at {hertz:.5g} Hz and {rpm:.0f} rpm is undamped, and "
            "without damping no depth of cut is stable: give damping"
        )

    @cached_property
    def _peaks(self) -> Array:
        """Largest receptance at the frequency of each mode (s, k) [m/N], 0 for other modes."""
        at = np.nan_to_num(self.poles.imag, nan=1.0)
        size = np.abs(self.receptance(at)).max(axis=(2, 3))
        return np.where(np.isnan(self.poles.imag), 0.0, size)

    @cached_property
    def high_poles(self) -> Complex:
        """Poles of the modes with high peaks (s, k), NaN for other modes."""
        high = self._peaks > HIGH * self._peaks.max(axis=1, keepdims=True)
        return np.where(high, self.poles, complex(np.nan, np.nan))

    @property
    def least_damped(self) -> Array:
        """Least damping ratio of the modes with high peaks at every speed (s,)."""
        ratio = -self.high_poles.real / np.abs(self.high_poles)
        return np.asarray(np.nan_to_num(ratio, nan=np.inf).min(axis=1))

    @cached_property
    def tops(self) -> Array:
        """Highest frequency that matters at every speed (s,) [rad/s]."""
        at, size = np.nan_to_num(self.poles.imag, nan=1.0), self._peaks
        matters = size > np.minimum(NEGLIGIBLE * size.max(axis=1, keepdims=True), STIFF)
        highest = np.where(matters, at, 0.0).max(axis=1)
        if not (highest > 0.0).all():
            raise InvalidInput(
                f"stability_lobes: no mode up to {self.highest:.5g} Hz: raise max_frequency"
            )
        return BEYOND * highest

    def about_poles(self, row: int) -> Array:
        """Return frequencies that resolve the peaks at a speed, ascending [rad/s]."""
        pole = self.poles[row]
        near = frequencies_near(pole[np.isfinite(pole)])
        return near[near <= self.tops[row]]
