"""Frequencies at which a receptance is sampled so that interpolation between them is close."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput

Receptance = Callable[[Array], Complex]
LOWEST, HIGHEST = 2.0 * math.pi * 1.0, 2.0 * math.pi * 60e3  # rad/s
FIRST = 1.01  # ratio of neighbours
BENT = 0.05  # largest relative error of linear interpolation of a receptance between samples
NEGLIGIBLE = 1e-2  # of the largest receptance: smaller receptances cause no chatter
STIFF = 1e-7  # m/N: larger receptances matter however soft the tip: they may limit depths of 8 mm
STATIC = 0.5  # of the receptance at the lowest frequency: as NEGLIGIBLE, if a peak is hardly damped
LEAST, MOST = 1e-20, 1e3  # m/N: range of the largest receptance of a tip
DAMPED = 1e-3  # of the largest receptance: a smaller quadrature part counts as no damping
HALVINGS = 14  # of an interval between first samples
SAMPLES = 2_000_000  # of a receptance at most
LEAST_TURN = 1e-6  # between samples
TURN = 2.0 * math.pi / 32.0  # phase from tooth to tooth between samples


def resolving(
    receptance: Receptance, band: tuple[float, float] = (LOWEST, HIGHEST), at_force: bool = True
) -> tuple[Array, float]:
    """Return angular frequencies between which linear interpolation of a receptance is close, and
    the highest one at which it matters [rad/s].

    ``at_force``: whether it is a driving-point receptance, which can only take energy.

    Raises
    ------
    InvalidInput : a receptance that is not finite over the band, does not fall at its end, is too
        small or too large for a tip, is not damped, or drives the tip
    """
    low, high = band
    count = math.ceil(math.log(high / low) / math.log(FIRST)) + 1
    omega = np.geomspace(low, high, count)
    value = _finite_values(receptance, omega)
    largest = _largest_entry(value).max()
    if not LEAST <= largest <= MOST:
        raise InvalidInput(
            f"receptance: its largest value is {largest:.3g} m/N; allowed: {LEAST:g} to {MOST:g}, "
            "a displacement per force in SI units"
        )
    new = np.arange(len(omega) - 1)
    for _ in range(HALVINGS):
        middle = 0.5 * (omega[new] + omega[new + 1])
        inserted = _finite_values(receptance, middle)
        ends = value[new], value[new + 1]
        bend = _largest_entry(inserted - 0.5 * (ends[0] + ends[1]))
        size = np.maximum(_largest_entry(ends[0]), _largest_entry(ends[1])) + NEGLIGIBLE * largest
        bent = bend > BENT * size
        omega = np.insert(omega, new + 1, middle)
        value = np.insert(value, new + 1, inserted, axis=0)
        at = new + np.arange(len(new))
        new = np.sort(np.concatenate([at[bent], at[bent] + 1]))
        if not len(new):
            break
    least = min(NEGLIGIBLE * _largest_entry(value).max(), STATIC * _largest_entry(value[:1])[0])
    matters = np.flatnonzero(_largest_entry(value) > least)
    if matters[-1] == len(omega) - 1:
        raise InvalidInput(
            f"receptance: it does not decrease up to {high / 2.0 / math.pi:.6g} Hz: give one that "
            "does, such as a modal fit"
        )
    _refuse_undamped(omega, value, at_force)
    soft = np.flatnonzero(_largest_entry(value) > min(least, STIFF))
    if soft[-1] < len(omega) - 1:  # not where its end is a residual flexibility
        matters = soft
    return omega, float(omega[matters[-1]])


def _refuse_undamped(omega: Array, value: Complex, at_force: bool) -> None:
    """Refuse a receptance without damping, or one that feeds energy into a motion at the force."""
    quadrature = -0.5j * (value - np.conj(np.swapaxes(value, 1, 2))) / _largest_entry(value).max()
    eigenvalues = np.linalg.eigvalsh(quadrature)  # negative where energy is taken
    least, most = float(eigenvalues[:, 0].min()), float(eigenvalues[:, -1].max())
    at = f"{omega[_largest_entry(value).argmax()] / 2.0 / math.pi:.6g} Hz"
    if at_force and most > max(-least, DAMPED):
        raise InvalidInput(
            f"receptance: it adds energy to the tip instead of damping it, with its peak at {at}: "
            "at ω > 0 its imaginary part is negative where forces are F e^(+iωt)"
        )
    if max(-least, most) < DAMPED:
        raise InvalidInput(
            f"receptance: its peak at {at} is undamped, and without damping no depth of cut is "
            "stable: give damping"
        )


def shaped(receptance: Receptance, shape: tuple[int, ...]) -> Receptance:
    """Return a receptance with complex values of ``shape`` at every frequency, checked when called.

    Raises
    ------
    InvalidInput : from the returned function, where values have another shape or type
    """

    def checked(omega: Array) -> Complex:
        value = np.asarray(receptance(omega))
        if value.dtype.kind not in "iufc" or value.shape != (len(omega), *shape):
            raise InvalidInput(
                f"receptance: for {len(omega)} angular frequencies it gives {value.dtype} of shape "
                f"{value.shape}; allowed: complex numbers of shape {(len(omega), *shape)}"
            )
        return value.astype(complex)

    if not callable(receptance):
        raise InvalidInput("receptance: it must be a function of angular frequencies")
    return checked


def _finite_values(receptance: Receptance, omega: Array) -> Complex:
    value = receptance(omega)
    lost = ~np.isfinite(value).all(axis=(1, 2))
    if lost.any():
        raise InvalidInput(
            f"receptance: not a finite number at {omega[lost][0] / 2.0 / math.pi:.6g} Hz: it must "
            "cover the chatter band and beyond; extrapolate it by a modal fit"
        )
    return value


def _largest_entry(value: Complex) -> Array:
    """Return the largest amount of the entries of each matrix (n, d, d)."""
    return np.abs(value).max(axis=(1, 2))


def refuse_slow(top: float, period: float) -> None:
    """Refuse a tooth period over which the phase of ``top`` takes more than ``SAMPLES`` samples.

    Raises
    ------
    InvalidInput : too many samples; the speed must be a mistake
    """
    if top * period > SAMPLES * TURN:
        waves, most = (value / 2.0 / math.pi for value in (top * period, SAMPLES * TURN))
        raise InvalidInput(
            f"speed: in a tooth period of {period:.3g} s the highest mode has {waves:.3g} waves; "
            f"allowed: {most:.0f}"
        )


def along(omega: Array, top: float, period: float) -> Array:
    """Return samples [rad/s] to ``top`` that resolve the receptance and the phase between teeth.

    Raises
    ------
    InvalidInput : too many samples; the speed must be a mistake
    """
    refuse_slow(top, period)
    even = np.arange(0.25 * TURN, top * period + TURN, TURN) / period
    return np.unique(np.concatenate([even, omega[omega <= top]]))


def peaks(omega: Array, top: float) -> Array:
    """Return the samples up to ``top`` at which the receptance bends over a shorter interval than
    the phase from tooth to tooth."""
    fine = np.append(np.diff(omega) < 0.4 * (FIRST - 1.0) * omega[:-1], False)
    return omega[fine & (omega <= top)]


def folded(near: Array, period: float) -> Array:
    """Return samples of the phase ωT in 0 … π that resolve all harmonics of the tooth frequency;
    ``near`` [rad/s] resolve the peaks of the receptance."""
    even = np.linspace(0.0, math.pi, round(math.pi / TURN) + 1)[1:]
    angle = np.mod(near * period, 2.0 * math.pi)
    angle = np.unique(np.concatenate([even, np.minimum(angle, 2.0 * math.pi - angle)]))
    angle = angle[np.append(True, np.diff(angle) > LEAST_TURN)]
    angle[-1] = math.pi
    return angle
