"""Frequencies at which a receptance must be known so that nothing between them is lost."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Receptance = Callable[[Array], Complex]
LOWEST, HIGHEST = 2.0 * math.pi * 1.0, 2.0 * math.pi * 60e3  # rad/s
FIRST = 1.01  # ratio of neighbours
BENT = 0.05  # of its size, by which a receptance may leave the line between samples
NEGLIGIBLE = 1e-2  # of the largest receptance: where it stays below, nothing chatters
STIFF = 1e-7  # m/N: more matters in any case, however soft the tip: it may limit depths of 8 mm
STATIC = 0.5  # of the lowest frequency's receptance: the same, where a peak is hardly damped
LEAST, MOST = 1e-20, 1e3  # m/N, between which the largest receptance of a tip is
DAMPED = 1e-3  # of the largest receptance: what is less in quadrature damps nothing
HALVINGS = 14  # of an interval between first samples
SAMPLES = 2_000_000  # of a receptance at most
LEAST_TURN = 1e-6  # between samples
TURN = 2.0 * math.pi / 32.0  # phase from tooth to tooth between samples


def resolving(
    receptance: Receptance, band: tuple[float, float] = (LOWEST, HIGHEST), at_force: bool = True
) -> tuple[Array, float]:
    """Angular frequencies between which linear interpolation of a receptance is close, and the
    highest one at which it matters [rad/s].

    ``at_force``: whether it is a driving-point receptance, which can only take energy.

    Raises
    ------
    InvalidInput : a receptance that is not known over the band, does not fall at its end, is of no
        size of a tip, is not damped, or drives the tip
    """
    low, high = band
    count = math.ceil(math.log(high / low) / math.log(FIRST)) + 1
    omega = np.geomspace(low, high, count)
    value = _known(receptance, omega)
    largest = _size(value).max()
    if not LEAST <= largest <= MOST:
        raise InvalidInput(
            f"receptance: its largest value is {largest:.3g} m/N; allowed: {LEAST:g} to {MOST:g}, "
            "a displacement by a force in SI units"
        )
    new = np.arange(len(omega) - 1)
    for _ in range(HALVINGS):
        middle = 0.5 * (omega[new] + omega[new + 1])
        inserted = _known(receptance, middle)
        ends = value[new], value[new + 1]
        bend = _size(inserted - 0.5 * (ends[0] + ends[1]))
        size = np.maximum(_size(ends[0]), _size(ends[1])) + NEGLIGIBLE * largest
        bent = bend > BENT * size
        omega = np.insert(omega, new + 1, middle)
        value = np.insert(value, new + 1, inserted, axis=0)
        at = new + np.arange(len(new))
        new = np.sort(np.concatenate([at[bent], at[bent] + 1]))
        if not len(new):
            break
    least = min(NEGLIGIBLE * _size(value).max(), STATIC * _size(value[:1])[0])
    matters = np.flatnonzero(_size(value) > least)
    if matters[-1] == len(omega) - 1:
        raise InvalidInput(
            f"receptance: it does not fall up to {high / 2.0 / math.pi:.6g} Hz: give one that "
            "does, such as a modal fit"
        )
    _damped(omega, value, at_force)
    soft = np.flatnonzero(_size(value) > min(least, STIFF))
    if soft[-1] < len(omega) - 1:  # not where its end is a residual flexibility
        matters = soft
    return omega, float(omega[matters[-1]])


def _damped(omega: Array, value: Complex, at_force: bool) -> None:
    """Refuse a receptance without damping, or that gives energy to the motion where it acts."""
    share = -0.5j * (value - np.conj(np.swapaxes(value, 1, 2))) / _size(value).max()
    ends = np.linalg.eigvalsh(share)  # negative where energy is taken
    least, most = float(ends[:, 0].min()), float(ends[:, -1].max())
    at = f"{omega[_size(value).argmax()] / 2.0 / math.pi:.6g} Hz"
    if at_force and most > max(-least, DAMPED):
        raise InvalidInput(
            f"receptance: it drives the tip instead of damping it, with its peak at {at}: at "
            "ω > 0 its imaginary part is negative where forces are F e^(+iωt)"
        )
    if max(-least, most) < DAMPED:
        raise InvalidInput(
            f"receptance: nothing damps its peak at {at}, and without damping no depth of cut is "
            "stable: give damping"
        )


def shaped(receptance: Receptance, shape: tuple[int, ...]) -> Receptance:
    """A receptance whose values are complex numbers of ``shape`` at every frequency.

    Raises
    ------
    InvalidInput : of the function that is returned, where they are not
    """

    def known(omega: Array) -> Complex:
        value = np.asarray(receptance(omega))
        if value.dtype.kind not in "iufc" or value.shape != (len(omega), *shape):
            raise InvalidInput(
                f"receptance: for {len(omega)} angular frequencies it gives {value.dtype} of shape "
                f"{value.shape}; allowed: complex numbers of shape {(len(omega), *shape)}"
            )
        return value.astype(complex)

    if not callable(receptance):
        raise InvalidInput("receptance: it must be a function of angular frequencies")
    return known


def _known(receptance: Receptance, omega: Array) -> Complex:
    value = receptance(omega)
    lost = ~np.isfinite(value).all(axis=(1, 2))
    if lost.any():
        raise InvalidInput(
            f"receptance: not a finite number at {omega[lost][0] / 2.0 / math.pi:.6g} Hz: it must "
            "reach over the chatter band and beyond; extrapolate it by a modal fit"
        )
    return value


def _size(value: Complex) -> Array:
    """Largest entry of each matrix (n, d, d)."""
    return np.abs(value).max(axis=(1, 2))


def refuse_slow(top: float, period: float) -> None:
    """Refuse a tooth period in which the phase of ``top`` takes more samples than there may be.

    Raises
    ------
    InvalidInput : so many that the speed must be a mistake
    """
    if top * period > SAMPLES * TURN:
        waves, most = (value / 2.0 / math.pi for value in (top * period, SAMPLES * TURN))
        raise InvalidInput(
            f"speed: in a tooth period of {period:.3g} s the highest mode has {waves:.3g} waves; "
            f"allowed: {most:.0f}"
        )


def along(omega: Array, top: float, period: float) -> Array:
    """Samples up to ``top`` that resolve the receptance and the phase from tooth to tooth.

    Raises
    ------
    InvalidInput : so many that the speed must be a mistake
    """
    refuse_slow(top, period)
    even = np.arange(0.25 * TURN, top * period + TURN, TURN) / period
    return np.unique(np.concatenate([even, omega[omega <= top]]))


def peaks(omega: Array, top: float) -> Array:
    """Of samples up to ``top`` those at which the receptance bends on a shorter way than the
    phase from tooth to tooth."""
    fine = np.append(np.diff(omega) < 0.4 * (FIRST - 1.0) * omega[:-1], False)
    return omega[fine & (omega <= top)]


def folded(near: Array, period: float) -> Array:
    """Samples of the phase ωT in 0 … π at which all harmonics of the tooth frequency are
    resolved; ``near`` [rad/s] resolve the peaks of the receptance."""
    even = np.linspace(0.0, math.pi, round(math.pi / TURN) + 1)[1:]
    angle = np.mod(near * period, 2.0 * math.pi)
    angle = np.unique(np.concatenate([even, np.minimum(angle, 2.0 * math.pi - angle)]))
    angle = angle[np.append(True, np.diff(angle) > LEAST_TURN)]
    angle[-1] = math.pi
    return angle
