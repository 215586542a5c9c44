"""Result: life and heat of bearings over speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import Shown

BY = ("speed", "bearing")
HOUR = 3600.0  # s
HOURS = Shown("h", 1.0 / HOUR)
MILLIONS = Shown("1e6", 1e-6)
NANOMETRE = Shown("nm", 1e9)
VISCOSITY = Shown("mm²/s", 1e6)
NO_OIL = Absence("without a lubricant")
AT_REST = Absence("at rest", beside="speed")
NO_LOAD = Absence("without load", beside="equivalent_load")
THIN = Absence("where κ is below 0.1, as at rest", beside="life_factor")
STEEP = Absence("of contact angles above 45°", by=("bearing",))
NO_SPECTRUM = Absence("without a load spectrum")
STILL = Absence("where no step has rotation under load", by=("bearing",))
NO_TEMPERATURE = Absence("where the conditions give no temperature")


@dataclass(frozen=True)
class LifeResult:
    """Life, static safety, heat, films and defect frequencies over speed.

    ``revolutions``: reference life L10r of ISO/TS 16281; ``life``: the same as time, infinite at
    rest; ``modified_life``: L_nm with the lubricant and the reliability, NaN above 45°.
    ``limiting``: the contact that fails first. ``groove_rating``: C from the grooves;
    ``dynamic_rating``: the one used. ``rating_factor``: of temperature, on ``dynamic_rating``,
    below 1 above 150 °C. ``set_life``: until the first bearing fails. ``spectrum_life``,
    ``spectrum_set_life``, ``spectrum_safety``: under the load spectrum, NaN without one.
    ``static_safety``: (4.2 GPa over the peak pressure)³, times C0 used over that of the grooves
    (``static_rating``, ``groove_static_rating``). ``shoulder_margin``: least angle from the
    end of a contact ellipse to the shoulder, NaN where no shoulder diameter is known;
    ``lost_load``: share of a ball's load that the shoulder takes away. ``viscosity_ratio`` κ,
    ``film``: least thickness, 0 without load, ``film_ratio`` Λ, and heat are NaN without a
    lubricant. Temperatures are NaN where the conditions have none; where they follow from the heat
    of the bearings, the oil has that of the balls. ``cage`` … ``ball``: defect frequencies over
    that of the spindle; ``ball``: turns of a ball, whose defect strikes twice. ``ring_stress``:
    largest stress of the fitted inner ring after Tresca, NaN without a fit.
    ``reliability``, ``target``: as specified.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    outcome: Words = quantity("speed", unit="", label="outcome")
    revolutions: Array = quantity(
        *BY, unit="1", label="reference life L10r", printed=MILLIONS, infinite=(NO_LOAD,)
    )
    life: Array = quantity(
        *BY, unit="s", label="reference life L10r", printed=HOURS, infinite=(AT_REST, NO_LOAD)
    )
    modified_life: Array = quantity(
        *BY,
        unit="s",
        label="modified life",
        printed=HOURS,
        absent=(NO_OIL, THIN, STEEP),
        infinite=(NO_LOAD,),
    )
    life_factor: Array = quantity(*BY, unit="1", label="factor a_ISO", absent=(NO_OIL, THIN, STEEP))
    limiting: NDArray[np.str_] = quantity(*BY, unit="", label="limiting contact")
    equivalent_load: Array = quantity(*BY, unit="N", label="equivalent load")
    static_safety: Array = quantity(*BY, unit="1", label="static safety S0", infinite=(NO_LOAD,))
    pressure: Array = quantity(*BY, unit="Pa", label="peak pressure")
    ellipse_length: Array = quantity(
        *BY, unit="m", label="largest half-length of an ellipse", printed=Shown("mm", 1e3)
    )
    shoulder_margin: Array = quantity(
        *BY,
        unit="rad",
        label="margin to the shoulder",
        absent=(
            Absence("where no diameter of the shoulder is given", by=("bearing",)),
            NO_LOAD,
        ),
    )
    lost_load: Array = quantity(*BY, unit="1", label="share of load beyond the shoulder")
    spin_to_roll: Array = quantity(*BY, unit="1", label="largest spin-to-roll ratio")
    inner_heat: Array = quantity(*BY, unit="W", label="heat of inner contacts", absent=(NO_OIL,))
    outer_heat: Array = quantity(*BY, unit="W", label="heat of outer contacts", absent=(NO_OIL,))
    spin_heat: Array = quantity(
        *BY, unit="W", label="heat of spin, within the contacts", absent=(NO_OIL,)
    )
    viscous_heat: Array = quantity(*BY, unit="W", label="heat of the oil", absent=(NO_OIL,))
    moment: Array = quantity(
        *BY, unit="N·m", label="friction moment", printed=Shown("N·mm", 1e3), absent=(NO_OIL,)
    )
    slips: Flags = quantity(
        *BY, unit="", label="balls need more friction than the lubricant provides"
    )
    viscosity: float = quantity(
        unit="m²/s",
        label="viscosity at the operating temperature",
        printed=VISCOSITY,
        absent=(NO_OIL,),
    )
    viscosity_ratio: Array = quantity(*BY, unit="1", label="viscosity ratio κ", absent=(NO_OIL,))
    film: Array = quantity(
        *BY, unit="m", label="least film thickness", printed=NANOMETRE, absent=(NO_OIL,)
    )
    film_ratio: Array = quantity(*BY, unit="1", label="film over roughness Λ", absent=(NO_OIL,))
    cage: Array = quantity(*BY, unit="1", label="cage frequency over that of the spindle")
    outer: Array = quantity(*BY, unit="1", label="outer race frequency over that of the spindle")
    inner: Array = quantity(*BY, unit="1", label="inner race frequency over that of the spindle")
    ball: Array = quantity(*BY, unit="1", label="ball frequency over that of the spindle")
    ring_stress: Array = quantity(
        *BY,
        unit="Pa",
        label="stress of the fitted ring",
        printed=Shown("MPa", 1e-6),
        absent=(Absence("without a fit", by=("bearing",)),),
    )
    ball_temperature: Array = quantity(
        *BY, unit="degC", label="temperature of the balls", absent=(NO_TEMPERATURE,)
    )
    inner_temperature: Array = quantity(
        *BY, unit="degC", label="temperature of the inner ring", absent=(NO_TEMPERATURE,)
    )
    outer_temperature: Array = quantity(
        *BY, unit="degC", label="temperature of the outer ring", absent=(NO_TEMPERATURE,)
    )
    dynamic_rating: Array = quantity("bearing", unit="N", label="dynamic load rating")
    groove_rating: Array = quantity("bearing", unit="N", label="dynamic load rating of the grooves")
    rating_factor: Array = quantity(
        *BY, unit="1", label="factor on the dynamic rating for temperature"
    )
    static_rating: Array = quantity("bearing", unit="N", label="static load rating")
    groove_static_rating: Array = quantity(
        "bearing", unit="N", label="static load rating of the grooves"
    )
    fatigue_limit: Array = quantity("bearing", unit="N", label="fatigue load limit Cu")
    set_life: Array = quantity(
        "speed", unit="s", label="life of the set", printed=HOURS, infinite=(AT_REST, NO_LOAD)
    )
    spectrum_life: Array = quantity(
        "bearing",
        unit="s",
        label="life under the spectrum",
        printed=HOURS,
        absent=(NO_SPECTRUM,),
        infinite=(STILL,),
    )
    spectrum_safety: Array = quantity(
        "bearing",
        unit="1",
        label="least static safety S0 under the spectrum",
        absent=(NO_SPECTRUM,),
        infinite=(Absence("without load", by=("bearing",)),),
    )
    spectrum_unloaded: Array = quantity(
        "bearing",
        unit="1",
        label="share of the spectrum without load",
        absent=(NO_SPECTRUM,),
    )
    spectrum_set_life: float = quantity(
        unit="s",
        label="life of the set under the spectrum",
        printed=HOURS,
        absent=(NO_SPECTRUM,),
        infinite=(STILL,),
    )
    reliability: float = quantity(unit="1", label="reliability of the modified life")
    target: float = quantity(
        unit="s", label="target life", printed=HOURS, absent=(Absence("where no target is given"),)
    )

    @property
    def heat(self) -> Array:
        """All heat of every bearing (speeds, bearings) [W]."""
        return self.inner_heat + self.outer_heat + self.viscous_heat
