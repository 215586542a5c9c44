"""A bearing on the shaft."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, Any

from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from bearings.bearing import BallBearing
from bearings.kinds import kind_of
from rotordyn.description import Description, Faults, Path
from rotordyn.machine.fits import Fits
from rotordyn.machine.flexible_rings import RingBodies
from rotordyn.machine.growth import RingGrowth
from rotordyn.quantity import (
    HIDDEN,
    Choice,
    Damping,
    Friction,
    Growth,
    Key,
    Length,
    Load,
    Name,
    SmallAngle,
    Station,
    Words,
)
from rotordyn.units import format_quantity

THRUST = Words((("+x", 1), ("-x", -1)), silent=0)


@dataclass(frozen=True, slots=True)
class Misalignment(Description):
    """Offset of the bore under an outer ring from the axis [m], and its tilt [rad]."""

    y: Annotated[Growth, "offset along y"] = 0.0
    z: Annotated[Growth, "offset along z"] = 0.0
    thy: Annotated[SmallAngle, "tilt about y"] = 0.0
    thz: Annotated[SmallAngle, "tilt about z"] = 0.0

    @property
    def offset(self) -> tuple[float, float, float, float]:
        """Offsets along y and z, tilts about y and z [m, rad]."""
        return self.y, self.z, self.thy, self.thz


@dataclass(frozen=True, slots=True)
class BearingSeat(Description):
    """A bearing on the shaft.

    ``thrust``: for a kind that takes thrust in both directions, the direction of positive axial
    load and of the load by a spring of its sleeve; 0 means +1 there. The ball model is that of the
    conditions of the case unless given here; friction ``none`` or infinite: no limit. Damping
    [N·s/m] acts between its rings; tilt is not damped. ``own``: keys given here, not for all
    bearings; ``sizes``: of its rings, from its model, for fits [m];
    ``by_set``: its set gives the thrust; ``preloads``: of a pair by the classes of its maker,
    light, medium, heavy [N]; ``override``: what the files change of any model here, as written.
    """

    name: Annotated[Name, "name of this bearing"]
    bearing: Annotated[BallBearing, Key("model"), "name or path of a bearing model, or a mapping"]
    x: Annotated[Station, "station of the circle of inner groove centres"]
    thrust: Annotated[
        int,
        THRUST,
        "direction in which the shaft pushes the inner ring to load the balls; kinds that take "
        "thrust both ways need it only on a sleeve",
    ] = 0
    growth: Annotated[RingGrowth, "instead of that of the spindle"] = field(
        default_factory=RingGrowth
    )
    fits: Annotated[
        Fits | None,
        "fits of its rings, from which the growth follows instead ([theory](theory/rings.md))",
    ] = None
    flexible_rings: Annotated[
        RingBodies | None,
        "its rings as elastic bodies on shaft and housing "
        "([theory](theory/flexible_rings.md)); rigid by default",
    ] = None
    radial_damping: Annotated[
        Damping, Key("damping.radial"), "radial damping between the rings"
    ] = 0.0
    axial_damping: Annotated[Damping, Key("damping.axial"), "axial damping between the rings"] = 0.0
    model: Annotated[str, HIDDEN] = ""
    kinematics: Annotated[
        Annotated[str, Choice(KINEMATICS)] | None, "instead of that of the conditions"
    ] = None
    moment_sharing: Annotated[
        Annotated[str, Choice(MOMENT_SHARING)] | None, "instead of that of the conditions"
    ] = None
    friction: Annotated[Friction | None, "instead of that of the conditions"] = None
    misalignment: Annotated[
        Misalignment,
        "misalignment of the bore in which its outer ring sits ([how](theory/loads.md))",
    ] = field(default_factory=Misalignment)
    own: Annotated[tuple[str, ...], HIDDEN] = field(default=(), repr=False, compare=False)
    sizes: Annotated[Mapping[str, Length], HIDDEN] = field(
        default_factory=dict, repr=False, compare=False
    )
    by_set: Annotated[bool, HIDDEN] = field(default=False, repr=False, compare=False)
    preloads: Annotated[tuple[Load, ...], HIDDEN] = field(default=(), repr=False, compare=False)
    override: Annotated[Mapping[str, Any], HIDDEN] = field(
        default_factory=dict, repr=False, compare=False
    )

    def __post_init__(self) -> None:
        given, bearing = self.thrust, self.known_bearing
        if type(given) is int and given == 0 and bearing is not None:
            object.__setattr__(self, "thrust", int(bearing.both_ways))
        Description.__post_init__(self)

    @property
    def known_bearing(self) -> BallBearing | None:
        """The bearing; None where the faults of its file are reported already."""
        given: object = self.bearing
        return given if isinstance(given, BallBearing) else None

    def law(self, common: Law) -> Law:
        """Return the hypotheses on its balls: those given here, the rest as in ``common``."""
        friction = common.friction
        if self.friction is not None:
            friction = None if math.isinf(self.friction) else self.friction
        return replace(
            common,
            kinematics=self.kinematics or common.kinematics,
            moment_sharing=self.moment_sharing or common.moment_sharing,
            friction=friction,
        )

    def _faults(self) -> Faults:
        bearing = self.known_bearing
        if bearing is None:
            return
        if self.thrust == 0 and not bearing.both_ways:
            yield (
                ("thrust",),
                f"missing key: kind {kind_of(bearing)} takes thrust one way only; allowed: +x, -x, "
                "the direction in which the shaft pushes the inner ring to load the balls",
            )
        yield from self._ring_faults(bearing)
        room = bearing.largest_static_growth
        if self.growth.static > room:
            yield (
                ("growth", "static"),
                f"reduces the contact angle to 0: given {{given}}; allowed: up to "
                f"{format_quantity(room, 'um')}",
            )
        least = bearing.smallest_static_growth
        if self.growth.static < least:
            yield (
                ("growth", "static"),
                f"leaves no contact angle, since the grooves are too far apart: given {{given}}; "
                f"allowed: from {format_quantity(least, 'um')}",
            )

    def _ring_faults(self, bearing: BallBearing) -> Faults:
        fit, fits = self.growth.fitted, self.fits
        rings: list[tuple[Path, float | None, float | None]] = []
        if fit is not None:
            rings.append((("growth", "fit"), fit.bore_diameter, None))
        for key, body in (("fits", fits), ("flexible_rings", self.flexible_rings)):
            if body is not None:
                rings.append(((key,), body.bore_diameter, body.outside_diameter))
        for path, bore, outside in rings:
            for which, size, allowed in no_ring_left(bearing, bore, outside):
                yield (
                    path,
                    f"the {which} of bearing {self.name} leaves no ring beside the balls: given "
                    f"{format_quantity(size, 'mm')}; allowed: {allowed}",
                )
        bodies = self.flexible_rings
        for key in ("housing_diameter", "housing_material"):
            if fits is not None and bodies is not None and getattr(bodies, key) is not None:
                yield (
                    ("flexible_rings", key),
                    f"fits and rings share one housing: give it as fits.{key}, and not here",
                )
        if fits is not None and fits.under_balls and bodies is not None and bodies.outer:
            yield (
                ("fits", "under_balls"),
                "given beside a flexible outer ring, which the balls expand already: leave it out, "
                "or make only the inner ring flexible (flexible_rings: {which: inner})",
            )
        if fits is not None and self.growth != RingGrowth():
            yield (
                ("fits",),
                "fits contradict a given growth: growth follows from the fits; leave one of the "
                "two out (growth: {static: 0 um} removes that of a model)",
            )


def no_ring_left(
    bearing: BallBearing, bore: float | None, outside: float | None
) -> Iterator[tuple[str, float, str]]:
    """Yield each diameter [m] that leaves no ring beside the balls: ``bore`` or ``outside``, its
    size, and what is allowed."""
    largest, least = bearing.ring_limits
    if bore is not None and bore >= largest:
        yield "bore", bore, f"below {format_quantity(largest, 'mm')}"
    if outside is not None and outside <= least:
        yield "outside", outside, f"above {format_quantity(least, 'mm')}"
