"""Shear coefficient κ of the hollow circular section (shear stiffness κ G A)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from bearings.errors import shown
from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput


def cowper(poisson_ratio: ArrayLike, diameter_ratio: ArrayLike) -> Array:
    """Return κ by Cowper (1966), J. Appl. Mech. 33, 335; ``diameter_ratio`` = inner / outer [1]."""
    nu, square = np.asarray(poisson_ratio), np.square(diameter_ratio)
    plus = (1.0 + square) ** 2
    return 6.0 * (1.0 + nu) * plus / ((7.0 + 6.0 * nu) * plus + (20.0 + 12.0 * nu) * square)


def hutchinson(poisson_ratio: ArrayLike, diameter_ratio: ArrayLike) -> Array:
    """Return κ by Hutchinson (2001), J. Appl. Mech. 68, 87; ``diameter_ratio`` = inner / outer."""
    nu, square = np.asarray(poisson_ratio), np.square(diameter_ratio)
    plus, fourth = (1.0 + square) ** 2, 1.0 + square**2
    denominator = (
        7.0 * fourth
        + 34.0 * square
        + nu * (12.0 * fourth + 48.0 * square)
        + nu**2 * (4.0 * fourth + 16.0 * square)
    )
    return 6.0 * (1.0 + nu) ** 2 * plus / denominator


RIGID = "none"  # no deformation in shear: Euler and Bernoulli's beam
FORMULAS = {"cowper": cowper, "hutchinson": hutchinson}


def shear_coefficient(
    choice: str | float, poisson_ratio: ArrayLike, diameter_ratio: ArrayLike
) -> Array:
    """Return κ by the name of a formula, or the number itself; infinite for ``"none"``.

    Raises
    ------
    InvalidInput : the name is unknown, or the number not positive and finite
    """
    shape = np.broadcast_shapes(np.shape(poisson_ratio), np.shape(diameter_ratio))
    if choice == RIGID:
        return np.full(shape, math.inf)
    if isinstance(choice, str):
        if choice not in FORMULAS:
            choices = ", ".join([*FORMULAS, RIGID])
            raise InvalidInput(
                f"unknown shear coefficient {shown(choice)}: one of {choices}, or a number"
            )
        return FORMULAS[choice](poisson_ratio, diameter_ratio)
    if not (math.isfinite(choice) and choice > 0.0):
        raise InvalidInput(f"a shear coefficient must be positive, got {shown(choice)}")
    return np.full(shape, float(choice))
