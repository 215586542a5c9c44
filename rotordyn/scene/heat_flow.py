"""How the heat of bearings flows off, for temperatures that follow from it (SI; °C, W/K)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from rotordyn.description import Description, Faults
from rotordyn.machine.temperatures import HousingExpansion
from rotordyn.quantity import Choice, CoolTemperature, Key, ThermalConductance
from rotordyn.scene.lubrication import Lubrication

if TYPE_CHECKING:
    from bearings.heat.temperature import Conductances, Surroundings
    from rotordyn.preload.heat_balance import Flow

MOUNTINGS = ("rigid", "spring")
LEAVING = ("inner_shaft", "outer_housing", "balls_oil")
BALLS = ("balls_inner", "balls_outer")


@dataclass(frozen=True, slots=True)
class HeatFlow(Description):
    """Conductances from balls and rings of a bearing to what is around it."""

    inner_shaft: Annotated[ThermalConductance, "conductance from the inner ring to the shaft"]
    outer_housing: Annotated[ThermalConductance, "conductance from the outer ring to the housing"]
    shaft: Annotated[CoolTemperature, "temperature of the shaft"]
    housing: Annotated[CoolTemperature, "temperature of the housing"]
    oil: Annotated[CoolTemperature, "inlet temperature of the oil"]
    balls_oil: Annotated[
        ThermalConductance, "conductance from the balls to the oil that leaves"
    ] = 0.0
    balls_inner: Annotated[
        ThermalConductance | None,
        "conductance from the balls to the inner ring; by default 1 W/K, a guess",
    ] = None
    balls_outer: Annotated[
        ThermalConductance | None,
        "conductance from the balls to the outer ring; by default 1 W/K, a guess",
    ] = None

    def _faults(self) -> Faults:
        leaving = sum(getattr(self, name) for name in LEAVING)
        if leaving <= 0.0:
            yield (), f"heat must leave the bearing: give one of {', '.join(LEAVING)} above 0 W/K"
            return
        to_inner, to_outer = self.balls_inner != 0.0, self.balls_outer != 0.0
        by_inner, by_outer = to_inner and self.inner_shaft, to_outer and self.outer_housing
        balls = self.balls_oil or by_inner or by_outer
        for body, leaves, keys in (
            ("the balls", balls, "balls_oil, balls_inner or balls_outer"),
            ("the inner ring", self.inner_shaft or (to_inner and balls), "inner_shaft"),
            ("the outer ring", self.outer_housing or (to_outer and balls), "outer_housing"),
        ):
            if not leaves:
                yield (), f"heat of {body} cannot leave: give {keys} above 0 W/K"

    @property
    def conductances(self) -> Conductances:
        """Conductances in the form of ``bearings.heat``, its guesses where they are not given."""
        from bearings.heat.temperature import Conductances

        values = {name: getattr(self, name) for name in Conductances._fields}
        return Conductances(**{name: value for name, value in values.items() if value is not None})

    @property
    def note(self) -> str:
        """A sentence with the conductances."""
        c = self.conductances
        return (
            f"heat of a bearing flows off through {c.inner_shaft:g} W/K from inner ring to shaft, "
            f"{c.outer_housing:g} from outer ring to housing, {c.balls_oil:g} from balls to oil, "
            f"{c.balls_inner:g} and {c.balls_outer:g} from balls to inner and outer ring"
        )

    def guesses(self) -> Iterator[str]:
        """Yield a sentence where conductances are guesses."""
        missing = [name for name in BALLS if getattr(self, name) is None]
        if missing:
            value = getattr(self.conductances, missing[0])
            yield (
                f"heat_flow: {' and '.join(missing)}, not given, {'are' if missing[1:] else 'is'} "
                f"taken as {value:g} W/K, a guess on which temperatures of the balls, preload, "
                "life and speed limits depend: give values, and vary them by a factor of five"
            )

    @property
    def surroundings(self) -> Surroundings:
        """Temperatures of shaft, housing and oil in the form of ``bearings.heat``."""
        from bearings.heat.temperature import Surroundings

        return Surroundings(self.shaft, self.housing, self.oil)


@dataclass(frozen=True, slots=True)
class SpindleHeatFlow(HeatFlow):
    """Conductances from every bearing of a spindle to what is around it, with its lubricant."""

    lubricant: Annotated[Lubrication | None, Key(required=True), "lubricant of the bearings"] = None
    housing_expansion: HousingExpansion = None

    @property
    def flow(self) -> Flow:
        """Oil and conductances in the form that the heat balance of a spindle takes."""
        from bearings.heat.moments import OIL_FACTORS
        from rotordyn.preload.heat_balance import Flow

        lubricant = self.lubricant
        assert lubricant is not None
        factor = OIL_FACTORS[lubricant.supply]
        return Flow(
            lubricant.oil,
            self.conductances,
            self.surroundings,
            lubricant.friction,
            factor,
            self.housing_expansion,
        )


@dataclass(frozen=True, slots=True)
class MountedHeatFlow(HeatFlow):
    """Conductances from a single bearing to what is around it, with what holds its preload."""

    mounting: Annotated[
        str,
        Choice(MOUNTINGS),
        "`rigid`: the rings keep the position that the load gives them at rest and 20 °C, so that "
        "growth raises the load; `spring`: the load is constant",
    ] = MOUNTINGS[0]
