"""Thermal expansion of the housing along the axis, where it is not given that of its material."""

from __future__ import annotations

from bearings.materials import STEEL
from rotordyn.machine.spindle import Spindle


def housing_expansion(spindle: Spindle, given: float | None) -> float:
    """Return the thermal expansion of the housing along the axis [1/K]: the ``given`` one, else
    that of the material in the fits of all bearings, else that of steel."""
    if given is not None:
        return given
    in_fits = {*expansions_in_fits(spindle).values()}
    return in_fits.pop() if len(in_fits) == 1 else STEEL.expansion


def expansions_in_fits(spindle: Spindle) -> dict[str, float]:
    """Return the thermal expansion of the housing around each bearing whose fits say of what it is,
    by the name of the bearing [1/K]."""
    return {
        seat.name: seat.fits.housing_material.expansion
        for seat in spindle.seats
        if seat.fits is not None and (seat.fits.housing or seat.fits.housing_material != STEEL)
    }
