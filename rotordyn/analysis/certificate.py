"""How many modes there are: proven for the assembled rotor, speed by speed.

The modes of a reduced system are all known (its eigenproblem is solved whole). That the assembled
rotor, none of its freedoms left out, has as many eigenvalues in a disc |s| ≤ R beyond the highest
frequency asked for, is shown by the argument principle in the form of Rouché (``rouche``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.formulation import SOFTENED
from rotordyn.analysis.hysteretic import Hysteretic
from rotordyn.analysis.scene import Scene
from rotordyn.numerics.modes import Modes
from rotordyn.numerics.rouche import same_count, to_circle, to_segment, wide_gap
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.leakage import CoupledLeakage, Leakage
from rotordyn.system.longitudinal import RodSystem

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
System = LateralSystem | RodSystem | CoupledSystem
BEYOND = 1.5  # the disc ends in the widest gap of the poles up to this multiple of the band
OSCILLATING = 1e-6  # of |pole|: less imaginary part than that is no vibration
SAME = 1e-9  # of the radius: poles so near are one
UNMOVED = 1e-9  # of the largest force of any mode: less is rounding
DEFECTIVE = 1e100  # larger left vectors are those of poles that share one vector


@dataclass(frozen=True, eq=False, slots=True)
class Certificate:
    """Discs of ``radius`` (speeds,) [rad/s] and where their count is ``proven`` (speeds,).

    ``bound`` (speeds,): what has to be below 1.
    """

    radius: Array
    bound: Array

    @property
    def proven(self) -> Flags:
        """Where the assembled rotor has as many eigenvalues in the disc as the reduced one."""
        return np.asarray(self.bound < 1.0)


@dataclass(frozen=True, eq=False, slots=True)
class Count:
    """Modes of one system (speeds,): how many, whether ``proven``, in discs of which ``radius``."""

    number: Array
    proven: Flags
    radius: Array


def count(scene: Scene, home: str, highest: float) -> Count:
    """Modes of a system that swing at ``highest`` [rad/s] at most, with poles in a proven disc."""
    system, found = scene.vibration(home)
    frame = np.asarray(getattr(system, "frame", np.zeros(len(found.pole))))
    own = certificate(scene, home, highest)
    pole, free = found.pole + 1j * frame[:, None], found.at_rest(frame)
    turning = np.abs(pole.imag) if _whirling(system) else pole.imag
    inside = (np.abs(pole) < own.radius[:, None]) & (turning <= highest) & ~free
    number = (inside & swings(pole, turning)).sum(axis=1)
    every = (number, own.proven, own.radius)
    return Count(*(np.broadcast_to(each, len(scene.usable)) for each in every))


def swings(pole: NDArray[np.complex128], turning: Array) -> Flags:
    """Where a pole with Im = ``turning``, seen one way round, is a vibration."""
    return np.asarray(turning > OSCILLATING * np.abs(pole))


def _whirling(system: object) -> bool:
    """True where poles of both signs are modes."""
    return isinstance(system, LateralSystem) and system.isotropic


def certificate(scene: Scene, motion: str, highest: float) -> Certificate:
    """Of the system that ``motion`` is part of, for all up to ``highest`` [rad/s].

    A rigid rotor is its own assembled system: its count needs no proof.
    """
    system, found = scene.vibration(motion)
    pole = _in_fixed_frame(system, found)
    radius = wide_gap(np.abs(pole), np.full(len(pole), highest), BEYOND)
    lossy = scene.hysteretic(motion)
    if lossy is None:
        bound = _bound(scene, motion, system, found, radius, to_circle(pole, radius))
    else:
        bound = _by_signs(scene, motion, lossy, found, radius)
    return Certificate(radius, bound)


def _in_fixed_frame(system: System, found: Modes) -> NDArray[np.complex128]:
    frame = np.asarray(getattr(system, "frame", np.zeros(len(found.pole))))
    return np.asarray(found.pole + 1j * frame[:, None])


def _by_signs(scene: Scene, motion: str, lossy: Hysteretic, found: Modes, radius: Array) -> Array:
    """The largest of what has to be below 1 in the part of the disc that belongs to each set of
    signs, ∞ where the system of these signs has other modes there than were ``found``."""
    free = found.at_rest(getattr(lossy.system, "frame", None))
    seen, worst = _in_fixed_frame(lossy.system, found), np.zeros(len(radius))
    for signs, low, high in lossy.regions():
        linear, own = lossy.answering(signs)
        pole = _in_fixed_frame(linear, own)
        apart = to_segment(pole, radius, low, high)
        bound = _bound(scene, motion, linear, own, radius, apart, scene.spindle.loss_factor)
        resting = own.at_rest(getattr(linear, "frame", None))
        for row in np.flatnonzero(low < high):
            edge = radius[row], low[row], high[row]
            mine, theirs = (
                _inside(pole[row, ~resting[row]], *edge),
                _inside(seen[row, ~free[row]], *edge),
            )
            same = len(mine) == len(theirs) and np.allclose(
                mine, theirs, rtol=0.0, atol=SAME * radius[row]
            )
            worst[row] = max(worst[row], bound[row]) if same else np.inf
    return worst


def _inside(
    pole: NDArray[np.complex128], radius: float, low: float, high: float
) -> NDArray[np.complex128]:
    """Vibrations of a part of a disc, in order."""
    swinging = swings(pole, np.abs(pole.imag)) & (np.abs(pole) < radius)
    return np.sort_complex(pole[swinging & (low < pole.imag) & (pole.imag < high)])


def _bound(
    scene: Scene,
    motion: str,
    system: System,
    found: Modes,
    radius: Array,
    apart: Array,
    loss: float = 0.0,
) -> Array:
    """What has to be below 1 (speeds,), with poles ``apart`` (speeds, k) from the edge."""
    leakage = _leakage(scene, motion, system, radius, loss)
    if leakage is None:
        return np.zeros(len(radius))
    columns, many = found.one_of_each_pair()
    free = np.take_along_axis(found.at_rest(getattr(system, "frame", None)), columns, axis=1)
    apart = np.take_along_axis(apart, columns, axis=1)
    vector, left_vector = (
        np.take_along_axis(each, columns[:, None, :], axis=2)
        for each in (found.vector, _left_vectors(found))
    )
    right = leakage.forces(vector, 1.0)
    with np.errstate(invalid="ignore", over="ignore"):
        left = leakage.forces(left_vector, -1.0)
        unmoved = free & (right <= UNMOVED * right.max(axis=1, keepdims=True))
    right, left = (np.where(unmoved, 0.0, side) for side in (many * right, left))
    return same_count(apart, right, left, radius, leakage.own())


def _leakage(
    scene: Scene, motion: str, system: System, radius: Array, loss: float
) -> Leakage | CoupledLeakage | None:
    """None of a rigid rotor."""
    if isinstance(system, CoupledSystem):
        parts = {}
        for name, part in system.parts.items():
            own = _leakage(scene, name, part, radius, loss)
            if not isinstance(own, Leakage):
                return None
            parts[name] = own
        return CoupledLeakage(system, parts, radius)
    if system.unreduced is None:
        return None
    bending = motion == "bending"
    spin = scene.speed[scene.usable] if bending else np.zeros(len(radius))
    softened = spin**2 if scene.conditions.formulation == SOFTENED else 0.0 * spin
    return Leakage(system, system.unreduced, spin, radius, softened, loss)


def _left_vectors(found: Modes) -> NDArray[np.complex128]:
    """Left vectors as columns (speeds, n, k), those of a defective system one by one."""
    left = np.swapaxes(found.participation, 1, 2)
    lost = np.flatnonzero(~(np.abs(left) < DEFECTIVE).all(axis=(1, 2)))
    if not lost.size:
        return left
    left = left.copy()
    for row in lost:
        left[row] = _left_of_simple(found, int(row))
    return left


def _left_of_simple(found: Modes, row: int) -> NDArray[np.complex128]:
    """Left vectors (n, k) from the transposed problem, scaled by w (2λ + D) v = 1."""
    stiffness, damping = found.stiffness[row], found.damping[row]
    n, pole = len(stiffness), found.pole[row]
    zero, one = np.zeros((n, n)), np.eye(n)
    values, vectors = np.linalg.eig(np.block([[zero, one], [-stiffness.T, -damping.T]]))
    own = np.abs(values[:, None] - pole).argmin(axis=0)
    left, right = vectors[:n, own], found.vector[row]
    slope = (left * (2.0 * pole * right + damping @ right)).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(left / slope)
