"""Places of the groove centres of a bearing: the only data of a kind that the solver uses."""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

from bearings.materials import Material

STEEP = math.radians(80.0)  # free contact angle of a bearing whose grooves end beyond 90°
WIDEST = 0.2  # cos of the largest free contact angle that growth may leave, 78°


@dataclass(frozen=True, slots=True)
class Grooves:
    """Grooves of both rings, balls and materials (SI).

    ``free_angle`` αf [rad]: contact angle where an axial push first presses balls. ``radial_gap``
    Ri − Ro [m]: between the circles of inner and outer groove centres, rings centred.
    ``inner_offsets``, ``outer_offsets`` [m]: axial places of the groove centres of a ring from its
    middle plane, one or two each, the positive first: ir, il, or, ol. ``touching``: zero
    displacement is where balls just touch under an axial push; otherwise where rings are centred.
    ``both_ways``: carries thrust in both directions. ``by_side``: results have a contact for either
    side of a race; that of a ring with one groove is on the side of its angle. ``inner_shoulder``,
    ``outer_shoulder``: diameters at which the grooves end, None if unknown. ``rings``: the
    ``FlexibleRings``, None if they are rigid.
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
    both_ways: bool = True
    by_side: bool = False
    inner_shoulder: float | None = None
    outer_shoulder: float | None = None
    rings: Hashable = None

    @classmethod
    def of(
        cls,
        bearing: Any,
        *,
        free_angle: float | None = None,
        radial_gap: float | None = None,
        **centres: Any,
    ) -> Grooves:
        """Build from a kind with the common fields and αf, Ri − Ro = BD cos αf, or both."""
        distance = float(bearing.free_distance)
        if free_angle is None:
            assert radial_gap is not None
            free_angle = math.acos(min(radial_gap / distance, 1.0))
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
            both_ways=bearing.both_ways,
            inner_shoulder=bearing.inner_shoulder_diameter,
            outer_shoulder=bearing.outer_shoulder_diameter,
            rings=bearing.rings,
            **centres,
        )

    @property
    def free_distance(self) -> float:
        """BD = ℓi + ℓo, between the centres of an inner and an outer groove that just touch [m]."""
        return (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter

    @property
    def contacts(self) -> tuple[str, ...]:
        """Names of the contacts: i, o; by side: ir, il, or, ol."""
        return ("ir", "il", "or", "ol") if self.by_side else ("i", "o")

    @property
    def raceways(self) -> tuple[str, ...]:
        """Names of the raceways: i, o; of two grooves a ring: ir, il, or, ol."""
        inner = ("ir", "il") if len(self.inner_offsets) == 2 else ("i",)
        return inner + (("or", "ol") if len(self.outer_offsets) == 2 else ("o",))

    @property
    def centre_radii(self) -> tuple[float, float]:
        """Ri and Ro of the circles of inner and outer groove centres [m]."""
        cosine, half = self.radial_gap / self.free_distance, self.pitch_diameter / 2.0
        inner, outer = (
            (f - 0.5) * self.ball_diameter * cosine
            for f in (self.inner_conformity, self.outer_conformity)
        )
        return half + inner, half - outer

    @property
    def radii(self) -> tuple[float, float]:
        """Groove radii f D of inner and outer ring [m]."""
        return (
            self.inner_conformity * self.ball_diameter,
            self.outer_conformity * self.ball_diameter,
        )

    @property
    def bottoms(self) -> tuple[float, float]:
        """Diameters where the inner groove is deepest and the outer one widest [m]."""
        (inner, outer), (ri, ro) = self.radii, self.centre_radii
        deep = math.sqrt(inner**2 - self.inner_offsets[0] ** 2)
        wide = math.sqrt(outer**2 - self.outer_offsets[0] ** 2)
        return 2.0 * (ri - deep), 2.0 * (ro + wide)

    @property
    def shoulder_angles(self) -> tuple[float, float]:
        """Angles at which inner and outer groove end [rad]; NaN where that is not known.

        cos α = (Ri − d/2)/(f D) at an inner shoulder of diameter d, (d/2 − Ro)/(f D) at an outer.
        """
        (inner, outer), (ri, ro) = self.radii, self.centre_radii
        di, do = self.inner_shoulder, self.outer_shoulder
        return (
            math.nan if di is None else math.acos((ri - di / 2.0) / inner),
            math.nan if do is None else math.acos((do / 2.0 - ro) / outer),
        )

    @property
    def middle_angles(self) -> tuple[float, float]:
        """Angles where two arcs of inner and outer groove meet, asin(g/(2 f D)) [rad], or NaN."""
        offsets = (self.inner_offsets[0], self.outer_offsets[0])
        inner, outer = (
            math.asin(x / r) if x else math.nan for x, r in zip(offsets, self.radii, strict=True)
        )
        return inner, outer
