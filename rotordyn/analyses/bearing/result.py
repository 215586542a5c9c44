"""Results of a single bearing over load and speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.display import MILLIMETRE, Shown

BY_LOAD = ("speed", "load")
FEW_SPEEDS = 3  # which are curves over load, not points of one over speed
BY_CONTACT = (*BY_LOAD, "ball", "contact")


UNLOADED = Absence("of a contact without load", beside="contact_load")
NO_OIL = Absence("without a lubricant")
NO_LOAD = Absence("without load", beside="equivalent_load")


@dataclass(frozen=True)
class BearingMapResult:
    """A single bearing over axial load and speed; stiffness with tilts blocked.

    What belongs to a ball (``inner_angle`` … ``control_agrees``) is that of ``loaded_ball``, the
    one with the largest contact load, counted from 0; ``slipping`` is of any driven ball, one of at
    least 5 % of the largest load. ``ball``: azimuth, from y towards z, of the
    balls that results by contact have: all of them where balls differ, else one. Without load a
    contact has no angle and no ellipse ends (NaN). ``truncated``: share of the major axis of the
    contact ellipse outside its groove; ``shoulder_angle`` and ``middle_angle``: where grooves end,
    NaN where no diameter of the shoulder is known, or where the groove has one arc.
    ``revolutions``: L10r of ISO/TS 16281 by ``dynamic_rating``; ``groove_rating`` is that of the
    grooves. Heat and film are NaN without a lubricant. With a heat
    flow ``load`` is the preload at rest and 20 °C, ``axial_force`` that in operation; temperatures
    and ``speed_limit``, above which they reach no balance, are NaN without one, the limit also
    where it lies beyond the speeds. ``film_growth``: reduction of the distance of the grooves by
    films, 0 without them.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    load: Array = coordinate("load", unit="N", label="axial load")
    tangent: Words = coordinate("tangent", unit="", label="tangent")
    dof: Words = coordinate("dof", unit="", label="DOF")
    dof_other: Words = coordinate("dof_other", unit="", label="DOF")
    ball: Array = coordinate("ball", unit="rad", label="azimuth of the ball")
    contact: Words = coordinate("contact", unit="", label="contact")
    outcome: NDArray[np.str_] = quantity(*BY_LOAD, unit="", label="outcome")
    axial_force: Array = quantity(*BY_LOAD, unit="N", label="axial load in operation")
    deflection: Array = quantity(*BY_LOAD, unit="m", label="axial deflection")
    radial_deflection: Array = quantity(*BY_LOAD, unit="m", label="radial deflection")
    tilt: Array = quantity(*BY_LOAD, unit="rad", label="tilt about z")
    stiffness: Array = quantity(
        *("speed", "load", "tangent", "dof", "dof_other"),
        unit="N/m, N/rad, N·m/rad",
        label="stiffness",
    )
    loaded_ball: NDArray[np.int_] = quantity(
        *BY_LOAD, unit="", label="ball with the largest contact load"
    )
    inner_angle: Array = quantity(*BY_LOAD, unit="rad", label="inner contact angle")
    outer_angle: Array = quantity(*BY_LOAD, unit="rad", label="outer contact angle")
    inner_load: Array = quantity(*BY_LOAD, unit="N", label="inner ball load")
    outer_load: Array = quantity(*BY_LOAD, unit="N", label="outer ball load")
    inner_pressure: Array = quantity(*BY_LOAD, unit="Pa", label="inner peak pressure")
    outer_pressure: Array = quantity(*BY_LOAD, unit="Pa", label="outer peak pressure")
    centrifugal_force: Array = quantity(*BY_LOAD, unit="N", label="centrifugal force")
    gyroscopic_moment: Array = quantity(*BY_LOAD, unit="N·m", label="gyroscopic moment")
    inner_required_friction: Array = quantity(
        *BY_LOAD, unit="1", label="required friction, inner race"
    )
    outer_required_friction: Array = quantity(
        *BY_LOAD, unit="1", label="required friction, outer race"
    )
    required_friction: Array = quantity(
        *BY_LOAD, unit="1", label="required friction, largest of the driven balls"
    )
    slipping: NDArray[np.str_] = quantity(*BY_LOAD, unit="", label="race that slips")
    open_side: NDArray[np.int_] = quantity(
        *BY_LOAD, unit="", label="number of balls on the side without a shoulder"
    )
    inner_spin_to_roll: Array = quantity(*BY_LOAD, unit="1", label="spin-to-roll ratio, inner race")
    outer_spin_to_roll: Array = quantity(*BY_LOAD, unit="1", label="spin-to-roll ratio, outer race")
    attitude: Array = quantity(*BY_LOAD, unit="rad", label="inclination β of the ball's rotation")
    revolutions: Array = quantity(
        *BY_LOAD,
        unit="1",
        label="reference life L10r",
        printed=Shown("1e6", 1e-6),
        infinite=(NO_LOAD,),
    )
    dynamic_rating: float = quantity(unit="N", label="dynamic load rating in use")
    groove_rating: float = quantity(unit="N", label="dynamic load rating of the grooves")
    limiting: NDArray[np.str_] = quantity(*BY_LOAD, unit="", label="limiting contact")
    equivalent_load: Array = quantity(*BY_LOAD, unit="N", label="equivalent load")
    rating_factor: Array = quantity(
        *BY_LOAD, unit="1", label="factor on the dynamic rating for temperature"
    )
    static_safety: Array = quantity(
        *BY_LOAD, unit="1", label="static safety S0", infinite=(NO_LOAD,)
    )
    contact_heat: Array = quantity(
        *BY_LOAD, unit="W", label="heat of the contacts", absent=(NO_OIL,)
    )
    spin_heat: Array = quantity(
        *BY_LOAD, unit="W", label="heat of spin, within the contacts", absent=(NO_OIL,)
    )
    viscous_heat: Array = quantity(*BY_LOAD, unit="W", label="heat of the oil", absent=(NO_OIL,))
    film: Array = quantity(
        *BY_LOAD,
        unit="m",
        label="least film thickness",
        printed=Shown("nm", 1e9),
        absent=(NO_OIL,),
        infinite=(NO_LOAD,),
    )
    film_growth: Array = quantity(
        *BY_LOAD, unit="m", label="equivalent growth of the balls by films"
    )
    ball_temperature: Array = quantity(
        *BY_LOAD,
        unit="degC",
        label="temperature of the balls",
        absent=(Absence("without a heat flow"),),
    )
    inner_temperature: Array = quantity(
        *BY_LOAD,
        unit="degC",
        label="temperature of the inner ring",
        absent=(Absence("without a heat flow"),),
    )
    outer_temperature: Array = quantity(
        *BY_LOAD,
        unit="degC",
        label="temperature of the outer ring",
        absent=(Absence("without a heat flow"),),
    )
    speed_limit: Array = quantity(
        "load",
        unit="rad/s",
        label="thermal speed limit",
        absent=(
            Absence(
                "without a heat flow, and where the limit lies beyond the speeds", by=("load",)
            ),
        ),
    )
    control: NDArray[np.str_] = quantity(*BY_LOAD, unit="", label="controlling race")
    control_agrees: Flags = quantity(*BY_LOAD, unit="", label="kinematics agrees")
    contacts: NDArray[np.int_] = quantity(*BY_LOAD, "ball", unit="", label="loaded contacts")
    contact_load: Array = quantity(*BY_CONTACT, unit="N", label="contact load")
    contact_angle: Array = quantity(
        *BY_CONTACT, unit="rad", label="contact angle", absent=(UNLOADED,)
    )
    contact_pressure: Array = quantity(*BY_CONTACT, unit="Pa", label="peak pressure")
    ring_deflection: Array = quantity(
        *BY_CONTACT, unit="m", label="deflection of the raceway, 0 of rigid rings"
    )
    ellipse_length: Array = quantity(
        "speed",
        "load",
        "ball",
        "contact",
        unit="m",
        label="half-length of the ellipse",
        printed=MILLIMETRE,
    )
    ellipse_width: Array = quantity(
        "speed",
        "load",
        "ball",
        "contact",
        unit="m",
        label="half-width of the ellipse",
        printed=MILLIMETRE,
    )
    ellipse_lower: Array = quantity(
        *BY_CONTACT, unit="rad", label="lower end of the ellipse", absent=(UNLOADED,)
    )
    ellipse_upper: Array = quantity(
        *BY_CONTACT, unit="rad", label="upper end of the ellipse", absent=(UNLOADED,)
    )
    truncated: Array = quantity(
        "speed",
        "load",
        "ball",
        "contact",
        unit="1",
        label="share of the ellipse outside the groove",
    )
    shoulder_angle: Array = quantity(
        "contact",
        unit="rad",
        label="angle of the shoulder",
        absent=(Absence("where no diameter of the shoulder is given", by=("contact",)),),
    )
    middle_angle: Array = quantity(
        "contact",
        unit="rad",
        label="angle of the groove's middle",
        absent=(Absence("in a groove of one arc", by=("contact",)),),
    )


@dataclass(frozen=True)
class RadialMapResult(BearingMapResult):
    """A single bearing over radial load along y and speed."""

    load: Array = coordinate("load", unit="N", label="radial load")


@dataclass(frozen=True)
class MomentMapResult(BearingMapResult):
    """A single bearing over the moment about z and speed."""

    load: Array = coordinate("load", unit="N·m", label="moment")


def along_load(result: BearingMapResult) -> bool:
    """Return whether curves run over the load, one per speed, since there are few speeds."""
    return result.load.size > result.speed.size and result.speed.size <= FEW_SPEEDS


def longest(result: BearingMapResult) -> Array:
    """Return the half-length of the longest contact ellipse of all balls (speeds, loads) [m]."""
    return np.asarray(np.fmax.reduce(result.ellipse_length, axis=(-2, -1)))


def motion(result: BearingMapResult) -> tuple[str, str, Array]:
    """Return the displacement of the swept load: name, printed unit, values (speeds, loads)."""
    if isinstance(result, MomentMapResult):
        return "tilt", "mrad", result.tilt * 1e3
    if isinstance(result, RadialMapResult):
        return "radial deflection", "µm", result.radial_deflection * 1e6
    return "axial deflection", "µm", result.deflection * 1e6
