"""The rotor's own damping: modal, Rayleigh's and that of joints, in its reduced coordinates.

Modal damping is Σ 2ζω (M φ)(M φ)ᵀ over all modes φ of the free rotor. Those kept are coordinates,
and on them it is diagonal. Static answers are damped as the modes not kept of which they are made
(``RitzBasis.rest``, of large rotors Ritz vectors); those that are too stiff for these to be known,
as if they were modes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.reduction import RitzBasis
from rotordyn.system.hierarchy import Hierarchy
from rotordyn.system.left_out_damping import LeftOutDamping
from rotordyn.system.remainder import Remainder

Array = NDArray[np.float64]
WHOLE = 1e-6  # of a static answer: modes that have all but this of it are all it is made of


def damping_ratios(values: Array, given: tuple[float, ...]) -> Array:
    """Of modes of ``values`` ω² (n,): none of rigid ones, then ``given`` in order, the last one
    repeated."""
    ratios = np.zeros(len(values))
    if given:
        order = np.arange(len(values)) - int((values == 0.0).sum())
        flexible = np.array(given)[np.clip(order, 0, len(given) - 1)]
        ratios = np.where(order < 0, 0.0, flexible)
    return ratios


def modal_rates(values: Array, given: tuple[float, ...]) -> Array:
    """2ζω [1/s] of the same modes (n,), ζ their ``damping_ratios``."""
    return np.asarray(2.0 * damping_ratios(values, given) * np.sqrt(values))


def diagonal_damping(values: Array, spindle: Spindle, *, bending: bool = True) -> Array:
    """Modal and Rayleigh's (m,), of coordinates of unit mass and stiffness ``values``, all of them
    taken for modes.

    Other motions than ``bending`` have the last modal ratio.
    """
    rayleigh = spindle.rayleigh.mass + spindle.rayleigh.stiffness * values
    return modal_rates(values, _ratios(spindle, bending=bending)) + rayleigh


def own_damping(spindle: Spindle, basis: RitzBasis, *, bending: bool = True) -> Array:
    """The same of the coordinates ``basis`` (m, m), modes and static answers."""
    given = _ratios(spindle, bending=bending)
    modal = modal_rates(basis.values, given)
    modal[basis.are_modes], not_kept = _of_modes(given, basis)
    rayleigh = spindle.rayleigh.mass + spindle.rayleigh.stiffness * basis.values
    return _with_answers(modal, not_kept, basis) + np.diag(rayleigh)


def damping_beside(
    spindle: Spindle,
    elements: Hierarchy,
    basis: RitzBasis,
    left_out: Remainder,
    *,
    bending: bool = True,
) -> LeftOutDamping | None:
    """Of what the ``basis`` leaves out, and between the two; None of a rotor without damping."""
    if not (spindle.damped or elements.dampers):
        return None
    own, finer = spindle.rayleigh, len(left_out.own_mass) - len(basis.rest_values)
    modal = np.pad(_of_modes(_ratios(spindle, bending=bending), basis)[1], (finer, 0))
    proportional = own.mass * left_out.mass + own.stiffness * left_out.stiffness
    proportional += modal[:, None] * left_out.mass
    joints = np.zeros_like(proportional)
    for row, damping in elements.dampers.items():
        joints[finer:] += damping * np.outer(basis.rest[row], basis.vectors[row])
    return LeftOutDamping(
        proportional + joints,
        modal + own.mass * left_out.own_mass + own.stiffness * left_out.own_stiffness,
        spindle.internal_damping * proportional + joints,
    )


def _ratios(spindle: Spindle, *, bending: bool) -> tuple[float, ...]:
    return spindle.rotor_damping if bending else spindle.rotor_damping[-1:]


def _of_modes(given: tuple[float, ...], basis: RitzBasis) -> tuple[Array, Array]:
    """Modal damping of the modes kept and of the others, numbered on."""
    kept = basis.values[basis.are_modes]
    every = np.concatenate([kept, np.maximum(basis.rest_values, 0.0)])
    modal = modal_rates(every, given)
    return modal[: len(kept)], modal[len(kept) :]


def _with_answers(modal: Array, not_kept: Array, basis: RitzBasis) -> Array:
    """``modal`` (m,) of all coordinates as a matrix (m, m), instead of it that of the modes
    ``not_kept`` (r,) on those static answers that these make up."""
    share = basis.rest_mass
    made_up = ~basis.are_modes & ((share**2).sum(axis=0) >= 1.0 - WHOLE)
    damped = share.T @ (not_kept[:, None] * share)
    return np.where(np.outer(made_up, made_up), damped, np.diag(modal))
