"""The four-point-contact ball bearing: two arcs a ring, thrust in both directions.

Geometry after Lacroix, doctoral thesis, INSA Lyon, 2014, ch. 2: a shim of thickness g is taken out
of the middle of a circular groove, so that the centres of its two arcs lie g apart.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from bearings.grooves import Grooves
from bearings.measure import Measure, measured

CONTACT_ANGLE = Measure(
    "angle", "free contact angle under thrust", 0.0, math.radians(60.0), unit="deg"
)
PLAY = Measure("length", "free travel of ring against ring", -1e-3, 5e-3, unit="um")
MOST_PRESSED = 2e-3  # largest compression of a ball at rest, over the ball diameter
GIVEN = ("contact_angle", "axial_play", "radial_play")  # each fixes the others
SHIM = Measure("length", "thickness taken out of the middle of the groove", 0.0, 0.02, unit="mm")


@dataclass(frozen=True, slots=True, kw_only=True)
class FourPointBallBearing(BallBearing):
    """A single-row four-point-contact ball bearing.

    Displacement and moments are about the centre of the inner ring's middle plane and count from
    the centred position, where load is zero by symmetry. Contacts are named ir and il (inner ring,
    −x and +x side of the ball) and or and ol (outer ring); pushing the inner ring towards +x loads
    ir and ol. A ring without shim has one arc, whose contact has the name of the side it bears on.

    Parameters
    ----------
    contact_angle : free contact angle αf [rad]; or one of
    axial_play : Ep, free axial travel of ring against ring [m]
    radial_play : Jd, free radial travel of ring against ring [m]; negative plays: preload at rest
    inner_shim, outer_shim : gi, go [m]

    Raises
    ------
    InvalidBearing : the geometry is impossible, or not exactly one of angle and plays is given
    """

    contact_angle: float | None = measured(CONTACT_ANGLE, None)
    axial_play: float | None = measured(PLAY, None)
    radial_play: float | None = measured(PLAY, None)
    inner_shim: float = measured(SHIM, 0.0)
    outer_shim: float = measured(SHIM, 0.0)

    both_ways: ClassVar[bool] = True

    def _faults(self) -> Iterator[str]:
        shims = f"{self.drawn('inner_shim')}, {self.drawn('outer_shim')}"
        contradicting = self._exactly_one(GIVEN, f" with {shims}")
        yield from (sentence + self._shims_of_both() for sentence in contradicting)
        for ring, shim, conformity in self._rings():
            most = (2.0 * conformity - 1.0) * self.ball_diameter
            if shim >= most * (1.0 - 1e-9):
                yield (
                    f"{self.drawn(f'{ring}_shim')} reaches beyond the groove: with conformity "
                    f"{conformity:g} allowed below {most * 1e3:.4g} mm: take a thinner shim or a "
                    "larger conformity"
                )
                return
        gap = self._radial_gap()
        word = next(self.drawn(name) for name in GIVEN if getattr(self, name) is not None)
        if not math.cos(CONTACT_ANGLE.high) - 1e-12 <= gap / self.free_distance <= 1.0:
            yield (
                f"{word} does not fit {shims}: the free contact angle must lie between 0 and 60°; "
                "raise the play if it is too small, reduce it if it is too large"
            )
        elif (pressed := gap - self._radial_reach()) > MOST_PRESSED * self.ball_diameter:
            yield (
                f"{word} with {shims} compresses every ball by {pressed * 1e6:.4g} µm at rest, "
                f"beyond {MOST_PRESSED * self.ball_diameter * 1e6:.4g} µm: raise the play or the "
                "contact angle, or reduce the shims"
            )

    def _rings(self) -> tuple[tuple[str, float, float], ...]:
        return (
            ("inner", self.inner_shim, self.inner_conformity),
            ("outer", self.outer_shim, self.outer_conformity),
        )

    def _meaning(self, name: str) -> str:
        """Values of the other two data that one of them fixes, as text."""
        others: dict[str, Any] = {other: None for other in GIVEN if other != name}
        try:
            plays = replace(self, **others).plays
        except InvalidBearing:
            return " (impossible with these shims)"
        values = [self.drawn(n, v) for n, v in zip(GIVEN, plays, strict=True) if n != name]
        return f" means {', '.join(values)}"

    def _shims_of_both(self) -> str:
        """Hint at the shims that angle and axial play give, where a drawing has these two."""
        if self.contact_angle is None or self.axial_play is None or self.radial_play is not None:
            return ""
        shims = 2.0 * self.free_distance * math.sin(self.contact_angle) - self.axial_play
        both = "to have both, give one of them and inner_shim and outer_shim"
        return f"; {both}, {shims * 1e3:.4g} mm together" if shims >= 0.0 else ""

    def _radial_gap(self) -> float:
        """BD cos αf, from whichever of the three data is given (Lacroix 2.41–2.49, corrected)."""
        if self.contact_angle is not None:
            return self.free_distance * math.cos(self.contact_angle)
        if self.axial_play is not None:
            axial = 0.5 * (self.axial_play + self.inner_shim + self.outer_shim)
            possible = 0.0 < axial < self.free_distance
            return math.sqrt(self.free_distance**2 - axial**2) if possible else math.nan
        assert self.radial_play is not None
        return self._radial_reach() - self.radial_play / self._travel

    @property
    def _travel(self) -> float:
        """Radial play of the rings over that of one ball a side, Jd/Qr."""
        if self.balls % 2 == 0:
            return 2.0
        return 1.0 + 1.0 / math.cos(math.pi / self.balls)

    def _radial_reach(self) -> float:
        """ℓo cos αo⁰ + ℓi cos αi⁰, sin α⁰ = g/(2 ℓ): distance of the groove circles when a ball
        just fills both arches."""
        reaches = ((shim, (f - 0.5) * self.ball_diameter) for _, shim, f in self._rings())
        return sum(math.sqrt(reach**2 - shim**2 / 4.0) for shim, reach in reaches)

    @property
    def plays(self) -> tuple[float, float, float]:
        """Free contact angle αf [rad], axial play Ep [m] and radial play Jd [m]."""
        gap = self._radial_gap()
        angle = math.acos(gap / self.free_distance)
        shims = self.inner_shim + self.outer_shim
        axial = 2.0 * self.free_distance * math.sin(angle) - shims
        return angle, axial, self._travel * (self._radial_reach() - gap)

    @property
    def ground(self) -> dict[str, float | None]:
        """The axial play behind a free contact angle."""
        if self.contact_angle is None:
            return {}
        return {"contact_angle": None, "axial_play": self.plays[1]}

    @property
    def grooves(self) -> Grooves:
        """Grooves whose arcs have their centres half a shim off the middle, on the far side."""
        return Grooves.of(
            self,
            radial_gap=self._radial_gap(),
            by_side=True,
            inner_offsets=_arcs(self.inner_shim / 2.0),
            outer_offsets=_arcs(self.outer_shim / 2.0),
        )


def _arcs(offset: float) -> tuple[float, ...]:
    return (offset, -offset) if offset else (0.0,)
