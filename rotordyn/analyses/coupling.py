"""Receptance coupling: a tool on a spindle that is known by its receptances at the joint.

A receptance matrix is [[y/f, y/m], [θ/f, θ/m]] with θ = dy/dx, x from the tip towards the spindle
for tool and base alike; rows of Bishop's tables for a beam seen from its other end have the
opposite sign off the diagonal. In two planes, which the gyroscopic effect couples, matrices are
4×4; any size is taken.

Sources: Bishop and Johnson (1960); Schmitz and Donaldson (2000); Schmitz and Duncan (2005).
Theory: docs/theory/coupling.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from bearings.arguments import finite, typed
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.errors import InvalidInput

LOST = 1e-11  # of a receptance: a smaller difference is rounding
UNRESPONSIVE = (
    "the tip of the blank does not respond to the base, whose receptance is then unknown: take "
    "a shorter or stiffer blank"
)
NOISE_ALONE = 0.7  # share of noise from which errors are half of the base and more
LARGEST = 1e15  # SI units; beyond, products lose all digits or overflow
TERMS = 20  # of an exponential series of small matrices, which are then below rounding
SPLIT = 8.0  # λL beyond which a section is split, since e^λL would lose digits


class Ends(NamedTuple):
    """Receptances of a free body between its tip 1 and its joint 2, each (f, n, n)."""

    r11: Complex
    r12: Complex
    r21: Complex
    r22: Complex


@typed(InvalidInput, besides=("base", "joint"))
def couple(tool: Ends, base: Complex, joint: Complex | None = None) -> Complex:
    """Receptance at the tip (f, n, n) of a tool on a base.

    base : receptance of the base at the joint (f, n, n); n = 2 in one plane, deflection and slope
    joint : flexibility of the joint (f, n, n) or (n, n), see ``joint_flexibility``; None is rigid

    Raises
    ------
    InvalidInput : matrices of unlike size, or directions
    """
    _refuse_unlike(tool, base)
    interface = tool.r22 + base + _flexibility(joint, base)
    try:
        tip = np.asarray(tool.r11 - tool.r12 @ np.linalg.solve(interface, tool.r21))
    except np.linalg.LinAlgError:
        tip = np.full_like(base, np.nan)
    if not np.isfinite(tip).all():
        raise InvalidInput(
            "tool and base have an undamped resonance at one of the frequencies: give damping"
        )
    return tip


@typed(InvalidInput, besides=("tip", "joint"))
def uncouple(tool: Ends, tip: Complex, joint: Complex | None = None, noise: float = 0.0) -> Complex:
    """Receptance of the base at the joint (f, n, n), from that at the tip of a known blank on it.

    It is ill-conditioned where the tip does not respond to the base: near the poles of the blank
    held at its joint, and with a blank as soft or as stiff as the whole. A short and stiff blank
    is best, and measured responses should be fitted by modes first.

    noise : standard deviation of the entries of ``tip`` over their size; 0: rounding alone

    Raises
    ------
    InvalidInput : matrices of unlike size; a blank whose tip does not respond to the base, or so
        little that ``noise`` leaves nothing of the base at half of the frequencies
    """
    _refuse_unlike(tool, tip)
    change = tool.r11 - tip
    size = np.abs(tool.r11).max(axis=(1, 2)) + np.abs(tip).max(axis=(1, 2))
    if (np.abs(change).max(axis=(1, 2)) <= LOST * size).any():
        raise InvalidInput(UNRESPONSIVE)
    try:
        inverse = np.linalg.inv(change)
    except np.linalg.LinAlgError:
        raise InvalidInput(UNRESPONSIVE) from None
    base = np.asarray(tool.r21 @ inverse @ tool.r12 - tool.r22 - _flexibility(joint, tip))
    if not 0.0 <= noise < 1.0:
        raise InvalidInput(f"noise: given {noise:.6g}; allowed: from 0 to below 1")
    if noise > 0.0:
        _refuse_noise(noise, tool, tip, base)
    return base


def amplification(tool: Ends, tip: Complex, joint: Complex | None = None) -> Array:
    """Factor (f, n, n) by which the relative noise of the tip grows in the base that ``uncouple``
    gives: at 100 a noise of 1 % hides an entry of the base.

    For standard deviations of small errors that are independent in every entry.
    """
    return _amplified(tool, tip, uncouple(tool, tip, joint))


def _amplified(tool: Ends, tip: Complex, base: Complex) -> Array:
    left = tool.r21 @ np.linalg.inv(tool.r11 - tip)
    right = np.linalg.solve(tool.r11 - tip, tool.r12)
    before, error, after = (np.abs(matrix) ** 2 for matrix in (left, tip, right))
    return np.asarray(np.sqrt(before @ error @ after) / np.abs(base))


def _refuse_noise(noise: float, tool: Ends, tip: Complex, base: Complex) -> None:
    """Refuse a blank with which noise hides the base at half of the frequencies.

    Where noise dominates, the base computed from it consists of noise: their ratio stays about 1.
    """
    inverse = np.linalg.inv(tool.r11 - tip)
    within = np.abs(np.linalg.eigvals(np.abs(inverse) @ np.abs(tip))).max(axis=1)
    if noise * np.median(within) >= NOISE_ALONE:
        raise InvalidInput(
            "the blank is as stiff as the spindle, which changes its responses no more than "
            f"their noise of {noise:.2%} does: take a shorter blank, or measure with less noise"
        )
    larger = np.diagonal(_amplified(tool, tip, base), axis1=1, axis2=2)
    if noise * np.median(larger, axis=0).min() >= NOISE_ALONE:
        raise InvalidInput(
            f"the blank is so flexible that the noise of {noise:.2%} of its responses hides the "
            "spindle: take a shorter or thicker blank, or measure with less noise"
        )


def between_points(front: Ends, rear: Ends | None) -> Ends:
    """Receptances of a blank between the translations of two of its points and its joint, with
    which ``uncouple`` removes it from those measured there: exact, without rotations.

    front, rear : free bodies from the tip to the second point, and from there to the joint; None
        where the second point is at the joint
    """
    if rear is None:
        rows = (front.r11, front.r12), (front.r21, front.r22)
        return _between(rows, np.array([2, 3]))
    interface = front.r22 + rear.r11
    by_tip, by_middle, by_joint = (
        np.linalg.solve(interface, matrix) for matrix in (front.r21, front.r22, rear.r12)
    )
    parts = (
        (front.r11 - front.r12 @ by_tip, front.r12 - front.r12 @ by_middle, front.r12 @ by_joint),
        (rear.r11 @ by_tip, rear.r11 @ by_middle, rear.r12 - rear.r11 @ by_joint),
        (rear.r21 @ by_tip, rear.r21 @ by_middle, rear.r22 - rear.r21 @ by_joint),
    )
    return _between(parts, np.array([4, 5]))


def _between(parts: Sequence[Sequence[Complex]], joint: Indices) -> Ends:
    """Receptances between the translations of tip and second point, and the ``joint`` by its rows,
    from all matrices (f, 2, 2) between tip, second point and joint."""
    blocks = np.concatenate([np.concatenate(row, axis=2) for row in parts], axis=1)
    points = np.array([0, 2])
    return Ends(*(blocks[:, a[:, None], b] for a in (points, joint) for b in (points, joint)))


def joint_flexibility(
    omega: Array,
    stiffness: float,
    tilt_stiffness: float,
    damping: float = 0.0,
    tilt_damping: float = 0.0,
) -> Complex:
    """diag(1/(k + iωc)) of a joint (f, 2, 2); infinite stiffness is rigid.

    stiffness, damping : of relative deflection [N/m, N s/m]
    tilt_stiffness, tilt_damping : of relative rotation [N m/rad, N m s/rad]
    """
    flexibility = np.zeros((len(omega), 2, 2), dtype=complex)
    for k, (spring, dashpot) in enumerate(((stiffness, damping), (tilt_stiffness, tilt_damping))):
        if not spring > 0.0 or dashpot < 0.0:
            raise InvalidInput(
                f"joint: given {spring:.6g} and {dashpot:.6g}; allowed: stiffness above 0, damping "
                "from 0"
            )
        flexibility[:, k, k] = 0.0 if np.isinf(spring) else 1.0 / (spring + 1j * omega * dashpot)
    return flexibility


class Section(NamedTuple):
    """A uniform part of a shaft at rest, exact by Timoshenko's theory [SI].

    ``stiff_diameter``: of the solid cylinder of equal bending stiffness, 0: ``outer``; a fluted
    part has 0.8 of its own (Kops and Vo 1990, abstract read). ``loss_factor`` of the material.
    """

    length: float
    outer: float
    inner: float = 0.0
    young: float = 210e9
    density: float = 7850.0
    poisson: float = 0.3
    loss_factor: float = 0.0
    stiff_diameter: float = 0.0
    area: float = 0.0  # true area of the section, 0 is that of the ring


def beam(omega: Array, sections: list[Section], speed: float = 0.0) -> Ends:
    """Receptances (f, 2, 2) of a free shaft of sections in order from its tip to its joint.

    omega : angular frequencies (f,) above 0: a free body has no static receptance [rad/s]
    speed : of rotation [rad/s]; receptances are then those of whirl in its sense
    """
    if not sections:
        raise InvalidInput("no sections: at least one is needed")
    for section in sections:
        _refuse_section(section)
    if not (omega > 0.0).all():
        raise InvalidInput("frequencies: a free body has receptances above 0 Hz only")
    body: Ends | None = None
    for section in sections:
        for _ in range(count := _pieces(section, float(omega.max()))):
            piece = _uniform(omega, section._replace(length=section.length / count), speed)
            body = piece if body is None else _joined(body, piece)
    assert body is not None
    return body


def _refuse_section(section: Section) -> None:
    """Refuse a section that no shaft can have."""
    positive = (section.length, section.young, section.density, section.outer)
    not_negative = (section.inner, section.loss_factor, section.stiff_diameter, section.area)
    stiff = section.stiff_diameter or section.outer
    are_finite = all(map(finite, (*positive, *not_negative, section.poisson)))
    if (
        not are_finite
        or min(positive) < 1.0 / LARGEST
        or max(*positive, *not_negative) > LARGEST
        or not -1.0 < section.poisson <= 0.5
        or 0.0 < section.area < 1.0 / LARGEST
        or min(not_negative) < 0.0
        or section.inner >= stiff
    ):
        raise InvalidInput(
            f"{section}: allowed: length, diameter, young and density above 0, poisson above −1 "
            "to 0.5, an inner diameter from 0 to below the outer (and the stiff) one, others from "
            "0, in SI units"
        )


def turning_beam(omega: Array, sections: list[Section], speed: float) -> Ends:
    """Receptances (f, 4, 4) of a free shaft that rotates at ``speed`` [rad/s] from y to z: rows y,
    dy/dx, z, dz/dx, which the gyroscopic effect couples.

    In a whirl y + i z at ω the rotary inertia is that of ω² − 2 ω Ω; backward whirl has −ω. The
    loss factor is that of the rotating material.
    """
    forward, backward = (beam(omega, sections, sense * speed) for sense in (1.0, -1.0))
    return Ends(*(_in_planes(ahead, back) for ahead, back in zip(forward, backward, strict=True)))


def _in_planes(forward: Complex, backward: Complex) -> Complex:
    """Receptances (f, 4, 4) in both planes from those of forward and backward whirl (f, 2, 2)."""
    direct, cross = 0.5 * (forward + backward), -0.5j * (forward - backward)
    upper, lower = (np.concatenate(row, axis=2) for row in ((direct, -cross), (cross, direct)))
    return np.concatenate([upper, lower], axis=1)


def _joined(first: Ends, second: Ends) -> Ends:
    """Two free bodies in series, coupled rigidly, as one."""
    interface = first.r22 + second.r11
    to_first, to_second = (np.linalg.solve(interface, matrix) for matrix in (first.r21, second.r12))
    return Ends(
        first.r11 - first.r12 @ to_first,
        first.r12 @ to_second,
        second.r21 @ to_first,
        second.r22 - second.r21 @ to_second,
    )


def _pieces(section: Section, omega: float) -> int:
    """Number of pieces in which the wave functions of a section, up to e^λL, keep their digits."""
    stiff = section.stiff_diameter or section.outer
    wave = section.density * 4.0 / stiff**2 * 4.0 / section.young  # at least ρA/EI of a ring
    return max(1, int(np.ceil((wave * omega**2) ** 0.25 * section.length / SPLIT)))


def _uniform(omega: Array, section: Section, speed: float) -> Ends:
    """Receptances of a free uniform Timoshenko shaft.

    State (y, θ, M, V): y' = θ + V/κGA, θ' = M/EI, M' = −V − ρI(ω² − 2ωΩ)θ, V' = −ρAω²y.
    """
    stiff, inner = section.stiff_diameter or section.outer, section.inner
    loss = section.loss_factor * np.sign(omega - speed)
    young = section.young * (1.0 + 1j * loss)
    shear = young / (2.0 * (1.0 + section.poisson))
    area = section.area or np.pi / 4.0 * (section.outer**2 - inner**2)
    stiff_area = np.pi / 4.0 * (stiff**2 - inner**2)
    second = np.pi / 64.0 * (stiff**4 - inner**4)
    # bending, shear and rotary inertia by the equivalent diameter, mass by the true area
    kappa = _shear_coefficient(section.poisson, inner / stiff)
    length, bending, size = section.length, young * second, section.young * second
    a = np.zeros((len(omega), 4, 4), dtype=complex)
    # y in units of 1, θ of 1/L, M of EI/L², V of EI/L³: entries of the matrix are then of one size
    scale = np.array([1.0, 1.0 / length, size / length**2, size / length**3])
    a[:, 0, 1], a[:, 0, 3] = 1.0, 1.0 / (kappa * shear * stiff_area)
    a[:, 1, 2] = 1.0 / bending
    a[:, 2, 3], a[:, 2, 1] = -1.0, -section.density * second * (omega**2 - 2.0 * omega * speed)
    a[:, 3, 0] = -section.density * area * omega**2
    t = _exponential(a * length * scale / scale[:, None])
    # (V, M)_L = fy (y, θ)₀ + ff (V, M)₀, with forces (f, m)₁ = −(V, M)₀ and (f, m)₂ = (V, M)_L on
    # the ends; the others by reciprocity, and by the symmetry of the section
    order = np.array([3, 2])
    fy, ff = t[:, order][:, :, :2], t[:, order][:, :, order]
    r11, r12 = np.linalg.solve(fy, ff), np.linalg.inv(fy)
    units = np.array([1.0, 1.0 / length])[:, None] / np.array([scale[3], scale[2]])
    mirrored = np.array([[1.0, -1.0], [-1.0, 1.0]])  # slopes, seen from the other end
    free = r11, r12, np.swapaxes(r12, 1, 2), mirrored * r11
    return Ends(*(matrix * units for matrix in free))


def _exponential(a: Complex) -> Complex:
    """e^a of matrices (f, 4, 4) of beams, which map deflections and moments to slopes and forces,
    and vice versa.

    So X = a² has two double eigenvalues, X^k = u X + v follows from their sum and product, and the
    series of e^a = cosh √X + a sinh √X / √X are those of u and v.
    """
    square = a @ a
    total = 0.5 * np.trace(square, axis1=1, axis2=2)
    product = 0.5 * (total**2 - 0.5 * np.einsum("fij,fji->f", square, square))
    if 1.0 < np.abs(total).max() ** 2 + np.abs(product).max() < np.inf:  # terms grow at first
        half = _exponential(0.5 * a)
        return half @ half
    u, v = np.zeros_like(total), np.ones_like(total)
    even, odd = np.array([u, v]), np.array([u, v])
    for order in range(2, TERMS, 2):
        share = 1.0 / (order * (order - 1))
        u, v = share * (total * u + v), -share * product * u
        even += u, v
        odd += u / (order + 1), v / (order + 1)
    (u, v), (w, x) = even[..., None, None], odd[..., None, None]
    unit = np.eye(4)
    return np.asarray(u * square + v * unit + a @ (w * square + x * unit))


def _shear_coefficient(poisson: float, ratio: float) -> float:
    """κ of a ring with inner over outer diameter ``ratio`` (Cowper 1966)."""
    m2 = ratio**2
    top = 6.0 * (1.0 + poisson) * (1.0 + m2) ** 2
    return top / ((7.0 + 6.0 * poisson) * (1.0 + m2) ** 2 + (20.0 + 12.0 * poisson) * m2)


def rotations(
    first: Complex, cross: Complex, spacing: float, far: Complex | None = None
) -> Complex:
    """Receptance matrix (f, 2, 2) from translations alone, after Schmitz and Duncan (2005).

    first, cross : y₁/f₁ and y₁/f₂ at two points ``spacing`` [m] apart, 1 nearer the tip (f,)
    far : y₂/f₂; with it θ/m is the second difference, else l²/h, which one mode alone allows

    Of two modes the second one's θ/m is 2 to 7 times too high without ``far``, within 8 % with it
    (computed example, spacing 15 to 40 mm); the noise of a difference grows with 1/spacing.
    """
    if not spacing > 0.0:
        raise InvalidInput(f"spacing: given {spacing:.6g} m; allowed: above 0")
    slope = (cross - first) / spacing
    turn = slope**2 / first if far is None else (first - 2.0 * cross + far) / spacing**2
    return np.stack([np.stack([first, slope], -1), np.stack([slope, turn], -1)], -2)


def _flexibility(joint: Complex | None, like: Complex) -> Complex:
    """Flexibility of a joint at every frequency, of the shape of ``like``; None is rigid."""
    if joint is None:
        return np.zeros_like(like)
    if np.shape(joint) not in (like.shape, like.shape[1:]) or not np.isfinite(joint).all():
        raise InvalidInput(
            f"joint: given shape {np.shape(joint)}; allowed: finite numbers of shape {like.shape} "
            f"or {like.shape[1:]}"
        )
    return np.broadcast_to(joint, like.shape)


def _refuse_unlike(tool: Ends, other: Complex) -> None:
    """Refuse receptances that are not matrices of one shape, or not of finite numbers."""
    for matrix in (*tool, other):
        if getattr(matrix, "dtype", np.dtype(object)).kind not in "fc":
            raise InvalidInput("receptances: they must be arrays of complex numbers (f, n, n)")
    for matrix in (*tool, other):
        if matrix.shape != other.shape or matrix.ndim != 3 or matrix.shape[1] != matrix.shape[2]:
            raise InvalidInput(
                f"receptances of different size: given {matrix.shape} and {other.shape}; allowed: "
                "(f, n, n) for all, of the same frequencies and the same directions at tip, joint "
                "and base"
            )
        if not (np.abs(matrix) < LARGEST).all():
            raise InvalidInput("a receptance is not a finite number: leave out its frequency")
