"""Bending of the rotor on its supports, at many speeds.

Where every support answers alike in all directions, both planes fit into one complex coordinate
r = y + i z (rotation θz − i θy), forward whirl turning with +ω; otherwise the two real planes
stand side by side. The complex form may be written in the frame that turns with the shaft.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.elements.node import FREEDOMS, position
from rotordyn.elements.support import ALIKE, support_matrices, turn
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.system.dofs import BOTH_PLANES
from rotordyn.system.hysteresis import Hysteresis, Signs, answering
from rotordyn.system.lateral_rotor import LateralRotor
from rotordyn.system.remainder import Remainder
from rotordyn.system.unreduced import Unreduced
from rotordyn.system.whirl_in_planes import are_apart

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, slots=True)
class LateralSystem:
    """q̈ + ``damping`` q̇ + ``stiffness`` q = f, arrays (speeds, n, n).

    Complex with n = m where ``isotropic``, else real with n = 2m: plane y, then plane z.
    ``frame`` (speeds,) [rad/s]: the speed at which the coordinates turn, 0 in the fixed frame.
    ``held``, ``damped`` (speeds, connections, k, k): stiffness and damping of bearings and
    supports, over (deflection, tilt) in the complex form, of both planes otherwise. ``force``
    (speeds, elements) [N]: axial force that acts on bending; None where it does not.
    ``hysteresis``: what loss factors add to the stiffness; None where there are none.
    """

    rotor: LateralRotor
    isotropic: bool
    stiffness: NDArray[np.inexact]
    damping: NDArray[np.inexact]
    frame: Array
    held: NDArray[np.inexact]
    damped: NDArray[np.inexact]
    force: Array | None = None
    hysteresis: Hysteresis | None = None

    @property
    def planes(self) -> int:
        """1 in the complex form, else 2."""
        return 1 if self.isotropic else 2

    @property
    def freedoms(self) -> int:
        """Of a node in a plane: deflection and tilt."""
        return 2

    @property
    def rows(self) -> Array:
        """Deflection and tilt between the rings of bearings, then at supports (c, 2, m)."""
        return np.concatenate([self.rotor.seats, self.rotor.supports])

    @property
    def weightless(self) -> Array:
        """1 for coordinates whose unit mass is none of the machine's, else 0 (n,)."""
        return np.tile(self.rotor.weightless, self.planes)

    @property
    def connected(self) -> Array:
        """The nodes that bearings and supports join (c, nodes)."""
        return self.rotor.connected

    @property
    def remainder(self) -> Remainder | None:
        """What the coordinates leave out."""
        return self.rotor.remainder

    @property
    def unreduced(self) -> Unreduced | None:
        """The assembled rotor of a plane."""
        return self.rotor.unreduced

    @property
    def motion(self) -> Array:
        """Displacements of the nodes by the coordinates of the real form (nodes, 6, 2m)."""
        m = self.rotor.size
        plane = self.rotor.basis.reshape(-1, 2, m)
        motion = np.zeros((len(plane), len(FREEDOMS), 2 * m))
        for place, (freedom, sign) in enumerate(
            zip(BOTH_PLANES.names, BOTH_PLANES.signs, strict=True)
        ):
            own = slice(m) if place < 2 else slice(m, None)
            motion[:, position(freedom), own] = sign * plane[:, place % 2]
        return motion

    def planar(self, spin: Array, rows: slice = slice(None)) -> NDArray[np.bool_]:
        """Speeds at which nothing couples the planes, of the ``rows`` of the complex form.

        ``spin`` [rad/s]: what they are.
        """
        turns = self.hysteresis is not None and self.hysteresis.turns
        unseen = spin if turns else np.zeros_like(spin)
        return are_apart(self.stiffness[rows], self.damping[rows], unseen)

    def answering(self, signs: Signs) -> LateralSystem:
        """The linear system that answers motions of these signs: loss is in its stiffness."""
        return answering(self, signs)

    @property
    def in_planes(self) -> LateralSystem:
        """The same system in its real form: A + iB on y + iz is [[A, −B], [B, A]] on (y, z)."""
        if not self.isotropic:
            return self
        stiffness, damping = (
            _two_by_two(k.real, -k.imag, k.imag, k.real) for k in (self.stiffness, self.damping)
        )
        held, damped = (
            _two_by_two(k.real, -k.imag, k.imag, k.real) for k in (self.held, self.damped)
        )
        return LateralSystem(
            self.rotor,
            False,
            stiffness,
            damping,
            self.frame,
            held,
            damped,
            self.force,
            self.hysteresis and _hysteresis_in_planes(self.hysteresis),
        )


def lateral_system(
    spindle: Spindle,
    rotor: LateralRotor,
    speed: Array,
    seat_stiffness: Array,
    axial_force: Array | None = None,
    *,
    softened: bool = False,
    turning: bool = False,
) -> LateralSystem:
    """Rotor, bearings and supports at every ``speed`` (speeds,) [rad/s].

    ``seat_stiffness`` (speeds, seats, 5, 5): tangents in the bearings' own frames. ``axial_force``
    (speeds, elements) [N]: in the shaft, tension positive; None = it and the drawbar do nothing to
    bending. ``softened``: Ω² M_ω is subtracted from the stiffness in the fixed frame. ``turning``:
    written in the frame that turns with the shaft. The share of the rotor's damping D that is
    internal answers to ṙ − iΩ r: it adds −iΩ D to the stiffness.

    Raises
    ------
    InvalidInput : ``turning``, and a support does not answer alike in all directions
    """
    k, c = connection_blocks(spindle, speed, seat_stiffness)
    rows = np.concatenate([rotor.seats, rotor.supports])
    own_stiffness = np.tile(np.diag(rotor.stiffness), (len(speed), 1, 1))
    if axial_force is not None:
        own_stiffness += rotor.per_newton.under(axial_force) + rotor.bar
    if softened:
        own_stiffness -= (speed**2)[:, None, None] * rotor.translational_mass
    gyroscopic = speed[:, None, None] * rotor.polar
    internal = speed[:, None, None] * rotor.turning
    alike = are_alike(k) and are_alike(c)
    lossy = _hysteresis(spindle, rotor, rows, k, alike=alike)
    if alike:
        stiffness = own_stiffness - 1j * internal + _gathered(rows, circular(k))
        damping = rotor.damping + _gathered(rows, circular(c))
        blocks = circular(k), circular(c)
        if turning:
            return replace(
                _turned(rotor, speed, stiffness, damping, blocks),
                force=axial_force,
                hysteresis=lossy,
            )
        still = np.zeros_like(speed)
        return LateralSystem(
            rotor, True, stiffness, damping - 1j * gyroscopic, still, *blocks, axial_force, lossy
        )
    if turning:
        raise InvalidInput(
            "the rotating formulation needs supports that answer alike in all directions, and "
            "those of this machine do not: use the inertial one"
        )
    zero = np.zeros_like(gyroscopic)
    across = _two_by_two(zero, gyroscopic, -gyroscopic, zero)
    return LateralSystem(
        rotor,
        False,
        _both(own_stiffness + zero)
        + _two_by_two(zero, internal, -internal, zero)
        + _gathered(_both(rows), k),
        _both(rotor.damping + zero) + across + _gathered(_both(rows), c),
        np.zeros_like(speed),
        k,
        c,
        axial_force,
        lossy,
    )


def connection_blocks(spindle: Spindle, speed: Array, seat_stiffness: Array) -> tuple[Array, Array]:
    """Stiffness and damping of bearings, then supports, in both planes (speeds, c, 4, 4)."""
    stiffness = [
        _seat_blocks(spindle, seat_stiffness),
        _support_blocks(spindle, speed, "stiffness"),
    ]
    damping = [_seat_dampers(spindle, len(speed)), _support_blocks(spindle, speed, "damping")]
    return np.concatenate(stiffness, axis=1), np.concatenate(damping, axis=1)


def _hysteresis(
    spindle: Spindle, rotor: LateralRotor, rows: Array, held: Array, *, alike: bool
) -> Hysteresis | None:
    """By the loss factors of shaft and supports, in the form that the supports allow.

    ``held`` (speeds, c, 4, 4): stiffness at the ``rows`` of bearings and supports.
    """
    if not spindle.hysteretic:
        return None
    turning, connections = np.diag(rotor.loss), np.array(spindle.connection_losses)
    lossy = connections[:, None, None] * held
    if alike:
        return Hysteresis(_gathered(rows, circular(lossy)), turning, None, connections)
    across = _two_by_two(0.0 * turning, turning, -turning, 0.0 * turning)
    return Hysteresis(_gathered(_both(rows), lossy), _both(turning), across, connections)


def _hysteresis_in_planes(own: Hysteresis) -> Hysteresis:
    """The same of the real form."""
    fixed, turning = own.fixed, own.turning
    zero = np.zeros_like(turning)
    return Hysteresis(
        _two_by_two(fixed.real, -fixed.imag, fixed.imag, fixed.real),
        _both(turning),
        _two_by_two(zero, turning, -turning, zero),
        own.connections,
    )


def _turned(
    rotor: LateralRotor,
    speed: Array,
    stiffness: NDArray[np.inexact],
    damping: NDArray[np.inexact],
    blocks: tuple[Complex, Complex],
) -> LateralSystem:
    """The complex form in the turning frame, r = ρ e^(iΩt); stiffness and damping act in the fixed.

    With M = Mt + Jd, translational and rotary, the kinetic energy gives the Coriolis terms
    2Ω (Mt + Jd) − Ω Jp and the centrifugal ones −Ω² Mt + Ω² (Jp − Jd); a damper in the fixed frame
    answers to ρ̇ + iΩρ.
    """
    spin, mass = speed[:, None, None], np.eye(rotor.size)
    return LateralSystem(
        rotor,
        True,
        stiffness + 1j * spin * damping - spin**2 * (mass - rotor.polar),
        damping + 1j * spin * (2.0 * mass - rotor.polar),
        speed,
        *blocks,
    )


def _seat_blocks(spindle: Spindle, stiffness: Array) -> Array:
    """(speeds, seats, 4, 4) over (y, θz, z, −θy) in the spindle's frame."""
    blocks = [
        BOTH_PLANES.take(turn(stiffness[:, k], seat.thrust)) for k, seat in enumerate(spindle.seats)
    ]
    return np.stack(blocks, axis=1) if blocks else np.zeros((len(stiffness), 0, 4, 4))


def _seat_dampers(spindle: Spindle, speeds: int) -> Array:
    """Radial dampers between the rings; tilt is not damped."""
    radial = np.array([seat.radial_damping for seat in spindle.seats])
    blocks = radial[:, None, None] * np.diag([1.0, 0.0, 1.0, 0.0])
    return np.broadcast_to(blocks, (speeds, *blocks.shape))


def _support_blocks(spindle: Spindle, speed: Array, which: str) -> Array:
    """(speeds, supports, 4, 4), likewise."""
    blocks = [BOTH_PLANES.take(support_matrices(s, which, speed)) for s in spindle.supports]
    return np.stack(blocks, axis=1) if blocks else np.zeros((len(speed), 0, 4, 4))


def are_alike(blocks: Array) -> bool:
    """True where both planes answer alike: blocks of the form [[P, Q], [−Q, P]], entry by entry."""
    return _equal(blocks[..., :2, :2], blocks[..., 2:, 2:]) and _equal(
        blocks[..., :2, 2:], -blocks[..., 2:, :2]
    )


def _equal(a: Array, b: Array) -> bool:
    return bool((np.abs(a - b) <= ALIKE * np.maximum(np.abs(a), np.abs(b))).all())


def circular(blocks: Array) -> Complex:
    """P − i Q of blocks [[P, Q], [−Q, P]] acting on r = y + i z."""
    return blocks[..., :2, :2] - 1j * blocks[..., :2, 2:]


def _gathered(rows: Array, blocks: NDArray[np.inexact]) -> NDArray[np.inexact]:
    """Σ rowᵀ block row over the connections: rows (c, k, n), blocks (speeds, c, k, k)."""
    n = rows.shape[-1]
    half = np.einsum("scij,cjn->scin", blocks, rows, optimize=True)
    flat = half.reshape(len(blocks), -1, n)
    return np.asarray(rows.reshape(-1, n).T @ flat)


def _both(matrix: Array) -> Array:
    """Block diagonal of two copies."""
    zero = np.zeros_like(matrix)
    return _two_by_two(matrix, zero, zero, matrix)


def _two_by_two(a: Array, b: Array, c: Array, d: Array) -> Array:
    return np.concatenate(
        [np.concatenate([a, b], axis=-1), np.concatenate([c, d], axis=-1)], axis=-2
    )
