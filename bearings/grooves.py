"""Where the groove centres of a bearing lie: all that a kind tells the solver about itself."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from bearings.materials import Material


@dataclass(frozen=True, slots=True)
class Grooves:
    """Grooves of both rings, balls and materials (SI).

    ``free_angle`` αf [rad]: contact angle where an axial push first presses balls. ``radial_gap``
    Ri − Ro [m]: between the circles of inner and outer groove centres, rings centred.
    ``inner_offsets``, ``outer_offsets`` [m]: axial places of the groove centres of a ring from its
    middle plane, one or two each, the positive first: ir, il, or, ol. ``touching``: zero
    displacement is where balls just touch under an axial push; otherwise where rings are centred.
    """

    ball_diameter: float
    pitch_diameter: float
    balls: int
    inner_conformity: float
    outer_conformity: float
    ball_material: Material
    ring_material: Material
    free_angle: float
    radial_gap: float
    inner_offsets: tuple[float, ...] = (0.0,)
    outer_offsets: tuple[float, ...] = (0.0,)
    touching: bool = False

    @classmethod
    def of(
        cls, bearing: Any, *, free_angle: float, radial_gap: float | None = None, **centres: Any
    ) -> Grooves:
        """Of a kind with the common fields; Ri − Ro is BD cos αf where it is not given."""
        f, diameter = bearing.inner_conformity + bearing.outer_conformity, bearing.ball_diameter
        distance = (float(f) - 1.0) * float(diameter)
        gap = distance * math.cos(free_angle) if radial_gap is None else radial_gap
        return cls(
            ball_diameter=float(bearing.ball_diameter),
            pitch_diameter=float(bearing.pitch_diameter),
            balls=int(bearing.balls),
            inner_conformity=float(bearing.inner_conformity),
            outer_conformity=float(bearing.outer_conformity),
            ball_material=bearing.ball_material,
            ring_material=bearing.ring_material,
            free_angle=float(free_angle),
            radial_gap=float(gap),
            **centres,
        )

    @property
    def free_distance(self) -> float:
        """BD = ℓi + ℓo, between the centres of an inner and an outer groove that just touch [m]."""
        return (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter

    @property
    def contacts(self) -> tuple[str, ...]:
        """Names of the contacts: i, o; of two grooves a ring: ir, il, or, ol."""
        inner = ("ir", "il") if len(self.inner_offsets) == 2 else ("i",)
        return inner + (("or", "ol") if len(self.outer_offsets) == 2 else ("o",))
