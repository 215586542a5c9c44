"""Stable width of cut in turning, and in any process with one tooth always in cut."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bearings.arguments import typed
from rotordyn.analyses.stability_lobes.modal_limit import Limit
from rotordyn.analyses.stability_lobes.sampling import along, resolving, shaped
from rotordyn.analyses.stability_lobes.spec import HOPF, NONE
from rotordyn.analyses.stability_lobes.zero_order import Mean, zero_order
from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput


@typed(InvalidInput, besides=("receptance",))
def turning_limit(receptance: Callable[[Array], Complex], force: float, speed: float) -> Limit:
    """Return the width of cut up to which turning is stable: exact, as coefficients are constant.

    receptance : angular frequencies (f,) > 0 [rad/s] -> (f,) [m/N], motion across the cut surface
        by the cutting force, both directions projected
    force : cutting coefficient [Pa]
    speed : of the work [rad/s]

    Raises
    ------
    InvalidInput : a coefficient or a speed that is not above 0; a receptance as ``limit_depth``
        refuses it

    Source: Tobias; Tlusty; the form of lobes is 1 + a K (1 - e^(-iωT)) G(iω) = 0.
    """
    for name, value in (("force", force), ("speed", speed)):
        if not value > 0.0:
            raise InvalidInput(f"{name}: given {value:.6g}; allowed: above 0")

    checked = shaped(receptance, ())

    def matrices(omega: Array) -> Complex:
        return checked(omega.ravel()).reshape(*omega.shape, 1, 1)

    omega, top = resolving(matrices, at_force=False)
    period = np.array([2.0 * math.pi / speed])
    samples = along(omega, top, float(period[0]))[None]
    mean = Mean(np.array([[[force]]]), np.zeros((1, 1, 1)))
    depth, at = zero_order(matrices, mean, period[:, None], samples)
    kind = HOPF if math.isfinite(depth[0]) else NONE
    return Limit(float(depth[0]), float(at[0]) / (2.0 * math.pi), kind)
