"""How many modes lie below a frequency: proven, after Wittrick and Williams.

For real ω the dynamic stiffness of a rotor without damping on symmetric isotropic supports is real
and symmetric; every mode of one whirl direction below ω makes one of its eigenvalues negative,
since each curve xᵀ(K + ωΩ P − ω² M)x has exactly one positive root. Pieces too short to vibrate
by themselves add none. What all nodes share (``ExactRotor``) borders the matrix. (Wittrick &
Williams, Q. J. Mech. Appl. Math. 24 (1971) 263.)

Eliminated from the left, node by node, the stiffness S of all that is left of a piece with transfer
matrix T becomes (T21 + T22 S)(T11 + T12 S)⁻¹ at its right end. So the piece's own stiffness, which
may be 10¹⁵ times that of the springs the rotor oscillates on, is never subtracted from itself.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from tests.oracles.exact_shaft.poles import exact_mode
from tests.oracles.exact_shaft.rotor import ExactRotor
from tests.oracles.exact_shaft.segment import transfer

Array = NDArray[np.float64]
FIRST = 10.0  # rad/s, where the search for a frequency with enough modes below begins
APART = 1e-7  # relative width to which a mode is enclosed before it is refined


def modes_below(rotor: ExactRotor, omega: float) -> int:
    """Modes between 0 and ``omega`` [rad/s]; a negative ``omega`` counts backward whirl.

    Raises
    ------
    InvalidInput : damping, supports that tell directions apart, or an unsymmetric stiffness
    """
    if not countable(rotor):
        raise InvalidInput(
            "modes can be counted only without damping, on isotropic supports of symmetric "
            "stiffness"
        )
    fine = rotor.up_to(omega)
    over = transfer(fine.segments, omega, fine.spin)
    nodes = fine.terms.at(omega, fine.spin).real
    own, across, shared = nodes[:, :2, :2], nodes[:, :2, 2:], nodes[:, 2:, 2:].sum(axis=0)
    left, beside, negative = own[0], across[0], 0
    for k, piece in enumerate(over):
        ahead = piece[:2, 2:]
        moved = piece[:2, :2] + ahead @ left
        negative += _negative_pair(_inverse(ahead) @ moved)
        back = _inverse(moved)
        if shared.size:
            shared = shared - beside.T @ back @ ahead @ beside
            beside = across[k + 1] + back.T @ beside
        left = (piece[2:, :2] + piece[2:, 2:] @ left) @ back
        left = own[k + 1] + 0.5 * (left + left.T)
    if shared.size:
        shared = shared - beside.T @ _inverse(left) @ beside
        negative += int((np.linalg.eigvalsh(shared) < 0.0).sum())
    return negative + _negative_pair(left) - _strings(rotor)


def countable(rotor: ExactRotor) -> bool:
    """True without damping, on isotropic supports of symmetric stiffness: all modes then whirl."""
    terms = rotor.terms
    if rotor.planes == 2 or terms.damping.any():
        return False
    gap = np.abs(terms.stiffness - np.swapaxes(terms.stiffness, -1, -2).conj()).max()
    rounding = 1e-9 * np.abs(terms.stiffness).max(initial=0.0)
    return bool(gap <= rounding and not terms.stiffness.imag.any())


def _strings(rotor: ExactRotor) -> int:
    """Parts of the drawbar: the stretch of each, taken as unknown, makes one sign negative."""
    shared = rotor.terms.stiffness[:, 2:, 2:].sum(axis=0)
    return int((np.diagonal(shared).real < 0.0).sum())


def whirl_frequencies(rotor: ExactRotor, number: int, direction: int = 1) -> Array:
    """The ``number`` lowest frequencies of whirl [rad/s], each proven to be the n-th, ascending.

    ``direction`` +1 forward, −1 backward. Rigid motions at rest frequency zero are omitted.
    """
    free = modes_below(rotor, direction * FIRST * 1e-3)
    highest = FIRST
    while modes_below(rotor, direction * highest) < free + number:
        highest *= 2.0
    fine = rotor.up_to(highest)
    found = []
    low = FIRST * 1e-3
    for order in range(free, free + number):
        low, high = _enclosed(fine, order, low, highest, direction)
        found.append(_refined(fine, 0.5 * direction * (low + high)))
    return np.array(found)


def _enclosed(
    rotor: ExactRotor, order: int, low: float, high: float, direction: int
) -> tuple[float, float]:
    """An interval of relative width ``APART`` whose lower end has ``order`` modes below it."""
    while high - low > APART * high:
        middle = np.sqrt(low * high) if high > 2.0 * low else 0.5 * (low + high)
        if modes_below(rotor, direction * middle) > order:
            high = middle
        else:
            low = middle
    return low, high


def _refined(rotor: ExactRotor, omega: float) -> float:
    """The mode within the interval around ``omega``, or its middle where two all but coincide."""
    close = abs(exact_mode(rotor, omega).omega.real)
    return close if abs(close / abs(omega) - 1.0) < 2.0 * APART else abs(omega)


def _inverse(block: Array) -> Array:
    """Of a 2×2 matrix, at a tenth of what a solver costs."""
    (a, b), (c, d) = block.tolist()
    return np.array(((d, -b), (-c, a))) / (a * d - b * c)


def _negative_pair(block: Array) -> int:
    """Negative eigenvalues of a symmetric 2×2 matrix, in whatever units its rows are."""
    (a, b), (c, d) = block.tolist()
    return 1 if a * d < b * c else 2 * (a < 0.0)
