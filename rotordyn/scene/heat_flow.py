"""How the heat of bearings flows off, for temperatures that follow from it (SI; °C, W/K)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from rotordyn.description import Description, Faults
from rotordyn.quantity import Choice, Key, Temperature, ThermalConductance
from rotordyn.scene.lubrication import Lubrication

if TYPE_CHECKING:
    from bearings.heat.temperature import Conductances, Surroundings
    from rotordyn.preload.heat_balance import Flow

MOUNTINGS = ("rigid", "spring")
LEAVING = ("inner_shaft", "outer_housing", "balls_oil")


@dataclass(frozen=True, slots=True)
class HeatFlow(Description):
    """Conductances from balls and rings of a bearing to what is around it."""

    inner_shaft: Annotated[ThermalConductance, "from the inner ring to the shaft"]
    outer_housing: Annotated[ThermalConductance, "from the outer ring to the housing"]
    shaft: Annotated[Temperature, "of the shaft"]
    housing: Annotated[Temperature, "of the housing"]
    oil: Annotated[Temperature, "of the oil where it comes in"]
    balls_oil: Annotated[ThermalConductance, "from the balls to the oil that leaves"] = 0.0
    balls_inner: Annotated[ThermalConductance, "from the balls to the inner ring"] = 1.0
    balls_outer: Annotated[ThermalConductance, "from the balls to the outer ring"] = 1.0

    def _faults(self) -> Faults:
        leaving = sum(getattr(self, name) for name in LEAVING)
        if leaving <= 0.0:
            yield (), f"heat must leave the bearing: give one of {', '.join(LEAVING)} above 0 W/K"

    @property
    def conductances(self) -> Conductances:
        """Conductances in the form of ``bearings.heat``."""
        from bearings.heat.temperature import Conductances

        return Conductances(*(getattr(self, name) for name in Conductances._fields))

    @property
    def surroundings(self) -> Surroundings:
        """Temperatures of shaft, housing and oil in the form of ``bearings.heat``."""
        from bearings.heat.temperature import Surroundings

        return Surroundings(self.shaft, self.housing, self.oil)


@dataclass(frozen=True, slots=True)
class SpindleHeatFlow(HeatFlow):
    """The same of every bearing of a spindle, with the oil that heats and cools."""

    lubricant: Annotated[Lubrication | None, Key(required=True), "of the bearings"] = None

    @property
    def flow(self) -> Flow:
        """Oil and conductances in the form that the heat balance of a spindle takes."""
        from bearings.heat.moments import OIL_FACTORS
        from rotordyn.preload.heat_balance import Flow

        oiled = self.lubricant
        assert oiled is not None
        factor = OIL_FACTORS[oiled.supply]
        return Flow(oiled.oil, self.conductances, self.surroundings, oiled.friction, factor)


@dataclass(frozen=True, slots=True)
class MountedHeatFlow(HeatFlow):
    """The same of a single bearing, with what holds its preload."""

    mounting: Annotated[
        str,
        Choice(MOUNTINGS),
        "`rigid`: the rings keep the place that the load gives them at rest and 20 °C, so that "
        "growth raises it; `spring`: the load stays",
    ] = MOUNTINGS[0]
