"""Quantities of the balls of a bearing, and warnings of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags
from rotordyn.machine.limits import PRELOAD_PRESSURE, WARNING_PRESSURE
from rotordyn.results.severity import Severity, graded
from rotordyn.results.text import which_of

OILED = 0.1  # friction coefficient
LEAST_SAFETY = 2.0  # static, of spindles; also 3.3 GPa, up to which the exponent of life holds
PAIR = 1.4  # times the rating of the grooves: that of a pair is 1.62 times
DOFS = ("x", "y", "z", "thy", "thz")
BALL_QUANTITIES = (
    "inner_angle",
    "outer_angle",
    "inner_load",
    "outer_load",
    "inner_pressure",
    "outer_pressure",
    "centrifugal_force",
    "gyroscopic_moment",
    "inner_required_friction",
    "outer_required_friction",
)


def pressed(what: str, speed: Array, peak: Array) -> str:
    """A warning where the pressure passes the limit at some speed, else nothing."""
    over = peak > WARNING_PRESSURE
    if not over.any():
        return ""
    why = (
        f"{what}: contact pressure {np.nanmax(peak) / 1e9:.2f} GPa is above "
        f"{WARNING_PRESSURE / 1e9:g} GPa, {which_of(speed, over)}: lower the preload or the loads"
    )
    return graded(Severity.LOAD, why)


def preloaded(what: str, speed: Array, peak: Array) -> str:
    """A warning where pressures at rest exceed those of usual preloads, else nothing."""
    at_rest = np.nanmax(peak[speed == 0.0], initial=0.0)
    if not at_rest > PRELOAD_PRESSURE:
        return ""
    why = (
        f"{what}: contact pressure {at_rest / 1e9:.2f} GPa at rest, where spindle bearings are "
        f"preloaded to less than {PRELOAD_PRESSURE / 1e9:g} GPa: check preload and loads"
    )
    return graded(Severity.LOAD, why)


def of_a_pair(rating: float, of_grooves: float) -> str:
    """A warning where a dynamic load rating [N] may be that of two rows, else nothing."""
    ratio = rating / of_grooves
    if ratio <= PAIR:
        return ""
    return (
        f"dynamic rating {rating:.0f} N is {ratio:.2f} times that of the grooves; give that of one "
        "bearing, of one row: a pair has 1.62 times as much, as has a four-point bearing in "
        "catalogues, which count two rows"
    )


def unsafe(safety: Array, speed: Array) -> str:
    """A warning where the static safety (speeds, …) is too low for computed lives, else nothing."""
    low = safety < LEAST_SAFETY
    if not low.any():
        return ""
    return (
        f"static safety {np.nanmin(safety):.2g} is below {LEAST_SAFETY:g} "
        f"{which_of(speed, low)}, and life is shorter than computed; lower the load or take a "
        "larger bearing"
    )


def overloaded(load: Array, rating: Array, speed: Array) -> str:
    """A warning where the equivalent load (speeds, …) exceeds half the dynamic rating [N], up to
    which ISO/TS 16281 is valid, else nothing."""
    high = 2.0 * load > rating
    if not high.any():
        return ""
    return (
        f"equivalent load above half the dynamic rating {which_of(speed, high)}: life is shorter "
        "than computed; lower the load"
    )


def no_film(gone: Flags, speed: Array) -> str:
    """A warning where loaded contacts at speed have no film (speeds, …), else nothing."""
    if not gone.any():
        return ""
    return (
        f"films are taken as 0 {which_of(speed, gone)}, where the oil is too viscous for "
        "the formula of inlet heating; use a thinner or a warmer one"
    )


def softened(factor: Array, speed: Array) -> str:
    """A warning where heat lowers the dynamic rating at some speed (speeds, …), else nothing."""
    hot = factor < 1.0
    if not hot.any():
        return ""
    why = (
        f"hotter than 150 °C {which_of(speed, hot)}: the dynamic rating falls to "
        f"{100.0 * np.nanmin(factor):.0f} % there; cool it"
    )
    return graded(Severity.LOAD, why)


def races(slipping: NDArray[np.str_]) -> NDArray[np.str_]:
    """Combine the races on which each ball slips (…, balls) into those of any ball (…)."""
    inner, outer = (
        ((slipping == one) | (slipping == "both")).any(axis=-1) for one in ("inner", "outer")
    )
    return np.select([inner & outer, inner, outer], ["both", "inner", "outer"], "")


def slipping(what: str, speed: Array, races: NDArray[np.str_]) -> str:
    """A warning where balls slip on a race at some speed, else nothing."""
    slips = races != ""
    if not slips.any():
        return ""
    names = {"inner": "the inner race", "outer": "the outer race", "both": "both races"}
    race = names[str(races[slips.argmax()])]
    why = (
        f"{what}: the balls slip on {race} {which_of(speed, slips)} (friction as given): raise the "
        "preload, or lower the speed"
    )
    return graded(Severity.LOAD, why)


def on_open_side(what: str, speed: Array, balls: Flags) -> str:
    """A warning where balls bear on the side without a shoulder at some speed, else nothing."""
    if not balls.any():
        return ""
    why = (
        f"{what}: balls bear where the rings have no shoulder {which_of(speed, balls)}: raise the "
        "axial load, or turn the bearing round"
    )
    return graded(Severity.LOAD, why)


def friction_warning(what: str, speed: Array, required: Array) -> str:
    """A warning where rolling without slip requires high friction at some speed, else nothing.

    0.1 is about the most that oil-lubricated steel on steel has (Harris and Kotzalas, Rolling
    Bearing Analysis, 5th ed., on gyroscopic motion: 0.02 to 0.1).
    """
    high = required > OILED
    if not high.any():
        return ""
    why = (
        f"{what}: the balls roll without gyroscopic slip only if friction is above "
        f"{np.nanmax(required):.2g}, more than the {OILED:g} of oiled contacts "
        f"{which_of(speed, high)}; "
        "raise the preload, or set friction to compute the slip"
    )
    return graded(Severity.LOAD, why)
