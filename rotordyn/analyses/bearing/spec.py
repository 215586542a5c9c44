"""Specification of a single bearing over load and speed (SI)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing
from rotordyn.description import Faults, ascending, repeated
from rotordyn.machine.flexible_rings import RingBodies
from rotordyn.quantity import Choice, Force, Growth, Items, Load, Moment
from rotordyn.scene.conditions import TANGENTS, Tangent
from rotordyn.scene.heat_flow import HeatFlow, MountedHeatFlow
from rotordyn.scene.lubrication import ELLIPSE, LOSS_MODELS, Lubrication
from rotordyn.scene.spec import Spec

TILTS = ("free", "blocked")
AXIAL, RADIAL, MOMENT = SWEPT = ("axial", "radial", "moment")
LISTS = dict(zip(SWEPT, ("loads", "radial_loads", "moments"), strict=True))
FIXED = dict(zip(SWEPT, ("axial_load", "radial_load", "moment"), strict=True))


@dataclass(frozen=True, slots=True)
class BearingMapSpec(Spec):
    """A single bearing under one list of loads [N], [N·m] at every speed; others may be fixed."""

    loads: Annotated[
        tuple[Load, ...],
        "axial loads, ascending; one of `loads`, `radial_loads`, `moments` is given",
    ] = ()
    static_growth: Annotated[Growth, "radial growth of the inner groove at rest"] = 0.0
    tangents: Annotated[
        tuple[Tangent, ...],
        Items(),
        "stiffness matrices to compute ([theory](theory/ball.md#the-tangent))",
    ] = TANGENTS[:1]
    radial_loads: Annotated[
        tuple[Force, ...], "radial loads along y, ascending, in place of `loads`"
    ] = ()
    moments: Annotated[
        tuple[Moment, ...],
        "moments about z, ascending, in place of `loads`; they tilt the ring in the plane of y",
    ] = ()
    axial_load: Annotated[Force, "constant axial load, where `loads` is not given"] = 0.0
    radial_load: Annotated[Force, "constant radial load, where `radial_loads` is not given"] = 0.0
    moment: Annotated[Moment, "constant moment, where `moments` is not given"] = 0.0
    tilt: Annotated[str, Choice(TILTS), "`blocked` keeps the tilts of the ring at zero"] = TILTS[0]
    lubricant: Annotated[Lubrication | None, "oil; without it heat and films are not computed"] = (
        None
    )
    dynamic_rating: Annotated[
        Load | None, "catalogue rating C of one bearing; by default computed from the grooves"
    ] = None
    heat: Annotated[
        str,
        Choice(LOSS_MODELS),
        "`ellipse` or `palmgren` ([theory](theory/life.md#friction-and-heat))",
    ] = ELLIPSE
    heat_flow: Annotated[
        MountedHeatFlow | None,
        "thermal conductances: temperatures, growth and preload follow from the heat flow, "
        "and the highest speed with a thermal balance ([theory](theory/life.md#temperatures))",
    ] = None
    flexible_rings: Annotated[
        RingBodies | None,
        "its rings as elastic bodies on shaft and housing, with their sizes "
        "([theory](theory/flexible_rings.md)); rigid by default",
    ] = None
    films: Annotated[
        bool, "oil films at the contacts, as an equivalent growth of the balls and as springs"
    ] = False

    def _faults(self) -> Faults:
        yield from repeated("tangents", self.tangents)
        for name in LISTS.values():
            yield from ascending(name, getattr(self, name))
        given = [name for name in LISTS.values() if getattr(self, name)]
        if len(given) != 1:
            yield (
                tuple(given[-1:]),
                f"give exactly one list of {', '.join(LISTS.values())}: got "
                f"{' and '.join(given) or 'none'}",
            )
            return
        fixed = FIXED[self.swept]
        if abs(getattr(self, fixed)) > 0.0:
            yield (fixed,), f"{fixed} is given by the list {given[0]} already"
        yield from self._oil_faults()
        rings = self.flexible_rings
        if rings is not None and rings.inner and rings.shaft_bore is None:
            yield (
                ("flexible_rings", "shaft_bore"),
                "missing key: a single bearing has no shaft that gives it; 0 mm for a solid shaft",
            )
        if (self.moments or abs(self.moment) > 0.0) and self.tilt == "blocked":
            yield (
                ("tilt",),
                "a moment has no effect on a blocked tilt: the guide of the ring carries it; "
                "allowed: free",
            )

    def _oil_faults(self) -> Faults:
        needs_oil = {"heat_flow": self.heat_flow, "films": self.films, "heat": self.heat != ELLIPSE}
        for name in needs_oil if self.lubricant is None else ():
            if needs_oil[name]:
                yield (name,), f"{name} needs an oil: give lubricant"
        if self.heat_flow is not None and self.combined:
            yield (
                ("heat_flow",),
                "is solved for axial loads only: give loads and no other list or load",
            )
        if self.heat_flow is not None and self.films:
            yield ("films",), "given beside heat_flow; allowed: one of the two"
        if self.films and self.tangents != TANGENTS[:1]:
            yield (
                ("tangents",),
                "films need the complete tangent; allowed: complete",
            )

    def last_faults_of(self, bearing: BallBearing) -> Faults:
        """Yield faults of impossible rings, and of loads that the bearing cannot carry."""
        try:
            self.mounted(bearing)
        except InvalidBearing as refusal:
            yield ("flexible_rings",), f"{refusal}"
        free = (*(True,) * 3, *(self.tilt != "blocked",) * 2)
        fixed = {name: getattr(self, key) for name, key in FIXED.items()}
        single = [(FIXED[name], {name: fixed[name]}) for name in (AXIAL, RADIAL)]
        swept = [(LISTS[self.swept], fixed | {self.swept: value}) for value in self.values]
        for key, loads in (*single, *swept):
            axial, radial, moment = (loads.get(name, 0.0) for name in SWEPT)
            if why := bearing.refusal((axial, radial, 0.0, 0.0, moment), free):
                yield (key,), why
                return

    def mounted(self, bearing: BallBearing) -> BallBearing:
        """Return the bearing, with flexible rings where they are given.

        Raises
        ------
        InvalidBearing : rings that are impossible
        """
        if self.flexible_rings is None:
            return bearing
        return replace(bearing, rings=self.flexible_rings.bodies(bearing))

    @property
    def heat_flows(self) -> tuple[HeatFlow, ...]:
        return () if self.heat_flow is None else (self.heat_flow,)

    @property
    def swept(self) -> str:
        """Load component of the list, one of ``SWEPT``."""
        return next(name for name, key in LISTS.items() if getattr(self, key))

    @property
    def values(self) -> tuple[float, ...]:
        """Loads of the list [N, N·m]."""
        loads: tuple[float, ...] = getattr(self, LISTS[self.swept])
        return loads

    @property
    def combined(self) -> bool:
        """Whether balls differ, since more than an axial load acts."""
        return self.swept != AXIAL or self.radial_load != 0.0 or self.moment != 0.0
