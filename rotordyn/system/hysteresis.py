"""Hysteretic damping: stiffness with a loss factor, whose force leads by a quarter turn.

A motion e^(iωt) against a stiffness K of loss factor η is answered by K (1 + i η sgn ω). What turns
with the shaft sees whirl e^(iωt) as e^(i(ω − Ω)t), so that there the sign is that of ω − Ω (Genta,
*Dynamics of Rotating Systems*, 2005). In the real form y and z are amplitudes of one e^(iωt), the
sum of forward whirl e^(iωt) and backward whirl e^(−iωt), each with a sign of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrix = NDArray[np.inexact[Any]]
Integers = NDArray[np.intp]
MET = 1e-9  # of the larger: frequencies so near are the same
Whole = TypeVar("Whole")


class Signs(NamedTuple):
    """Which way the shaft works in itself under motions e^(iωt), −1, 0 or 1.

    ``forward`` sgn(ω − Ω); ``backward`` sgn(ω + Ω), of the backward whirl e^(−iωt) in the real
    form; ``fixed`` sgn ω, in what does not turn.
    """

    forward: int
    backward: int
    fixed: int


SYNCHRONOUS = Signs(0, 1, 1)  # what turns with the shaft does not move in it


@dataclass(frozen=True, eq=False, slots=True)
class Hysteresis:
    """Loss factors times stiffness, of a system of n coordinates.

    ``fixed`` (speeds or 1, n, n): of what does not turn; ``turning`` (n, n): of the shaft;
    ``across`` (n, n): the same from plane z to y, and with opposite sign back, None in the complex
    form of bending. ``connections`` (c,): loss factors of bearings and supports.
    """

    fixed: Matrix
    turning: Array
    across: Array | None
    connections: Array

    def stiffness(self, signs: Signs) -> Complex:
        """What it adds to the stiffness (speeds or 1, n, n)."""
        ahead, behind, fixed = signs
        if self.across is None:
            return np.asarray(1j * (fixed * self.fixed + ahead * self.turning))
        even = 1j * (fixed * self.fixed + 0.5 * (ahead + behind) * self.turning)
        return np.asarray(even - 0.5 * (ahead - behind) * self.across)

    def held(self, blocks: Matrix, signs: Signs) -> Complex:
        """Blocks (…, c, k, k) of bearings and supports, with their loss."""
        return np.asarray(blocks * (1.0 + 1j * signs.fixed * self.connections[:, None, None]))

    @property
    def turns(self) -> bool:
        """True where the shaft has a loss factor."""
        return bool(self.turning.any())


def answering(system: Whole, signs: Signs) -> Whole:
    """The linear system that answers motions of these signs: its loss is in its stiffness."""
    own: Hysteresis | None = system.hysteresis  # type: ignore[attr-defined]
    if own is None:
        return system
    given: Any = system
    return replace(
        given,
        stiffness=given.stiffness + own.stiffness(signs),
        held=own.held(given.held, signs),
        hysteresis=None,
    )


def signs_of(omega: Array, spin: Array, *, whirling: bool) -> Integers:
    """Signs (…, 3) of motions e^(iωt) at ``spin``; ``whirling``: backward ones stand alone."""
    forward, backward = _sign(omega, spin), _sign(omega, -spin)
    if whirling:
        backward = np.zeros_like(backward)
    still = np.sign(omega + 0.0 * spin).astype(np.intp)
    return np.stack([forward, backward, still], axis=-1)


def gathered(signs: Integers) -> Sequence[tuple[Signs, NDArray[np.bool_]]]:
    """Each set of signs that occurs, and where (…)."""
    every = np.unique(signs.reshape(-1, 3), axis=0)
    return [(Signs(*map(int, one)), (signs == one).all(axis=-1)) for one in every]


def _sign(omega: Array, spin: Array) -> Integers:
    apart = omega - spin
    clear = np.abs(apart) > MET * np.maximum(np.abs(omega), np.abs(spin))
    return np.where(clear, np.sign(apart), 0.0).astype(np.intp)
