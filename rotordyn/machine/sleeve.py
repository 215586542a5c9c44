"""Sliding sleeves and the springs that preload their bearings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults, repeated
from rotordyn.machine.ball_guide import BallGuide
from rotordyn.quantity import Items, Key, Mass, Name, Preload, Rigidity, RingOffset, StopTravel

LEAST_MASS, LEAST_HOLD = 1e-12, 1.0  # [kg], [N/m] of a sleeve: less is lost in rounding
CONSTANT = 1e-3  # N/m: a force independent of displacement


@dataclass(frozen=True, slots=True)
class Spring(Description):
    """Preload spring [N], [N/m]; ``rigid`` or infinite locks the sleeve in its place at rest."""

    preload: Annotated[Preload, "force at rest"]
    stiffness: Annotated[
        Rigidity, Key(required=True), "`rigid` locks the sleeve in its place at rest"
    ] = math.inf
    offset: Annotated[
        RingOffset | None,
        "offset of a rigid preload, instead of its force: axial offset of the free "
        "rings, or difference of spacers",
    ] = None
    free: Annotated[
        bool,
        "the preload is that of a pair of such bearings before it is mounted, as in a preload "
        "class",
    ] = False

    @property
    def words(self) -> str:
        """Preload as text."""
        if self.offset is not None:
            return f"offset of {self.offset * 1e6:.4g} µm"
        return f"{self.preload:.6g} N" + " by class" * self.free

    @property
    def rate(self) -> str:
        """Spring rate as text."""
        if self.stiffness <= CONSTANT:
            return "constant"
        return f"{self.stiffness / 1e6:.6g} N/µm" if math.isfinite(self.stiffness) else "rigid"

    def _faults(self) -> Faults:
        if (self.free or self.offset is not None) and math.isfinite(self.stiffness):
            key = "offset" if self.offset is not None else "free"
            yield (key,), "needs a rigid preload: given beside a stiffness; allowed: with rigid"
        if self.offset is not None and (self.preload > 0.0 or self.free):
            yield (
                ("offset",),
                "given beside a preload: one determines the other; leave one of the two out",
            )


@dataclass(frozen=True, slots=True)
class Sleeve(Description):
    """A sliding sleeve that carries the outer rings of bearings, its spring and its end stop.

    The spring pushes in the direction that loads the bearings. [m], [kg], [N/m]; infinite: no stop,
    held rigidly by the housing bore.
    """

    name: Annotated[Name, "name of the sleeve"]
    bearings: Annotated[tuple[Name, ...], Items(), "bearings whose outer rings it carries"]
    spring: Annotated[Spring, "spring that loads these bearings"]
    stop_travel: Annotated[StopTravel, "travel against the spring, from rest to the end stop"] = (
        math.inf
    )
    mass: Annotated[Mass, "mass of the sleeve"] = 0.0
    radial_stiffness: Annotated[Rigidity, "between sleeve and housing"] = math.inf
    ball_guide: Annotated[
        BallGuide | None,
        "balls between sleeve and housing, which determine that stiffness instead "
        "([theory](theory/supports.md#ball-guides))",
    ] = None
    friction: Annotated[
        Preload, "limit of the dry friction in its bore ([which analyses](theory/network.md))"
    ] = 0.0

    @property
    def radially(self) -> float:
        """Stiffness between sleeve and housing, infinite where the bore is rigid [N/m]."""
        return self.radial_stiffness if self.ball_guide is None else self.ball_guide.stiffness

    def _faults(self) -> Faults:
        if self.ball_guide is not None and self.radial_stiffness < math.inf:
            yield (
                ("radial_stiffness",),
                "given beside ball_guide, which determines it: leave one of the two out",
            )
        if 0.0 < self.mass < LEAST_MASS:
            yield ("mass",), f"out of range: given {{given}}; allowed: 0, or from {LEAST_MASS:g} kg"
        if self.radial_stiffness < LEAST_HOLD:
            yield (
                ("radial_stiffness",),
                f"out of range: given {{given}}; allowed: from {LEAST_HOLD:g} N/m, or infinite",
            )
        yield from repeated("bearings", self.bearings)
