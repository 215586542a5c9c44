"""Squeeze-film dampers: stiffness and damping of a short film whose journal whirls on a circle.

Reynolds' equation of a short film, open at both ends, gives the force on the journal
per unit of angle, μ R L³ (∂h/∂t) / h³, with h = c − e cos θ and ∂h/∂t = −ω e sin θ at the angle θ
from the journal's displacement e = ε c. Over the whole film its radial part vanishes; of a
cavitated one only the half under pressure acts, 0 < θ < π
(Vance, *Rotordynamics of Turbomachinery*).

Theory: docs/theory/supports.md#squeeze-film-dampers.
"""

from __future__ import annotations

import numpy as np

from rotordyn.equation.dofs import position
from rotordyn.equation.term import LinkLaw, LinkMatrices, State
from rotordyn.machine.squeeze_film import SqueezeFilmDamper

_RADIAL = np.diag(np.isin(np.arange(6), [position("y"), position("z")]).astype(float))


def film_coefficients(damper: SqueezeFilmDamper) -> tuple[float, float]:
    """Return stiffness over the speed of whirl, and damping [N·s/m], equal along y and z."""
    eps = damper.eccentricity_ratio
    size = damper.viscosity * damper.radius * (damper.length / damper.clearance) ** 3
    damping = np.pi * size / (1.0 - eps**2) ** 1.5
    if damper.film == "full":
        return 0.0, damping
    return 2.0 * size * eps / (1.0 - eps**2) ** 2, 0.5 * damping


def film_law(damper: SqueezeFilmDamper) -> LinkLaw:
    """Return stiffness (s, 6, 6) and damping (1, 6, 6); no film carries a static load."""
    stiffness, damping = film_coefficients(damper)

    def matrices(state: State) -> LinkMatrices:
        whirl = state.whirl * np.abs(state.speed)[:, None, None] * (not state.standing)
        return LinkMatrices(stiffness * whirl * _RADIAL, damping * _RADIAL[None])

    return LinkLaw(matrices, ("y", "z"))
