"""All losses of a bearing by one balance: M ω is the sum of the powers of one model.

``"ellipse"`` adds the sliding in the contacts to Palmgren's viscous part; ``"palmgren"`` uses his
load-dependent moment, which contains the sliding, instead. The two are never added.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked, one_each
from bearings.arrays import Array, Flags
from bearings.errors import InvalidBearing, shown
from bearings.heat.ellipse import sliding
from bearings.heat.moments import load_moment, viscous_moment

if TYPE_CHECKING:
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState

MODELS = ("ellipse", "palmgren")


@dataclass(frozen=True, eq=False)
class Losses:
    """Heat of a bearing, shape (…) [W]: of its ``inner`` and ``outer`` contacts, ``viscous`` of the
    oil it churns. ``moment`` [N·m]: of all losses, 0 at rest. ``spin`` [W]: of spin alone, part of
    that of the contacts. ``slips`` (…): some contact slips fully under its gyroscopic moment."""

    inner: Array
    outer: Array
    viscous: Array
    spin: Array
    moment: Array
    slips: Flags

    @property
    def total(self) -> Array:
        """Total heat (…) [W]."""
        return self.inner + self.outer + self.viscous


@checked
def losses(
    state: BearingState,
    lubricant: Lubricant,
    temperature: ArrayLike,
    *,
    friction: float = 0.05,
    oil_factor: float = 1.0,
    model: str = "ellipse",
    static_rating: float | None = None,
) -> Losses:
    """Compute the losses of a state.

    Parameters
    ----------
    temperature : of the oil in the bearing, shape (…) [°C]
    friction : μ of the lubricated contacts, 0.03 to 0.07 in traction
    oil_factor : f0 of Palmgren's viscous moment (``OIL_FACTORS``)
    model : "ellipse" or "palmgren"
    static_rating : C0 for Palmgren's load factor [N]; None: from the grooves

    Raises
    ------
    InvalidBearing : an unknown model, factors that are not positive; temperatures that are not one
        for all states, or one each
    """
    temperature = one_each(temperature, state.outcome.shape, "temperature")
    if model not in MODELS:
        raise InvalidBearing(f"unknown model of losses {shown(model)}: {', '.join(MODELS)}")
    speed, g = np.asarray(state.speed), state.operation.geometry
    viscosity = lubricant.kinematic(temperature)
    viscous = viscous_moment(g.pitch_diameter, viscosity, speed, oil_factor) * speed
    slide = sliding(state, friction)
    by_contact = slide.power.sum(axis=-2)
    inner, outer = (by_contact[..., race].sum(axis=-1) for race in g.races)
    if model == "palmgren":  # races share his moment as they share the sliding
        load_power = load_moment(state, static_rating) * speed
        part = inner + outer
        share = np.where(part > 0.0, inner / np.where(part > 0.0, part, 1.0), 0.5)
        inner, outer = share * load_power, (1.0 - share) * load_power
    total = inner + outer + viscous
    turning = np.where(speed > 0.0, speed, 1.0)
    return Losses(
        inner=np.asarray(inner),
        outer=np.asarray(outer),
        viscous=np.broadcast_to(viscous, np.shape(inner)).copy(),
        spin=np.asarray(slide.spin_power.sum(axis=(-2, -1))),
        moment=np.asarray(np.where(speed > 0.0, total / turning, 0.0)),
        slips=np.asarray((slide.slips & state.driven[..., None]).any(axis=(-2, -1))),
    )
