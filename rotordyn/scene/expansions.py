"""Warnings of thermal expansions that are not known, or that contradict each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from bearings.bearing import BallBearing
from bearings.materials import STEEL, Material
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.housing_expansion import expansions_in_fits
from rotordyn.scene.conditions import Conditions

ALIKE = 0.1  # of an expansion: difference within which two materials are taken as one


def expansion_warnings(spindle: Spindle, conditions: Conditions) -> Iterator[str]:
    """Yield warnings of materials without α and of housings with two of them, where temperatures
    act."""
    thermal = conditions.temperatures or conditions.heat_flow
    if thermal is None or not spindle.seats:
        return
    yield from unknown_expansions(expanding_materials(spindle))
    yield from _two_housings(expansions_in_fits(spindle), thermal.housing_expansion)


def unknown_expansions(materials: Iterable[tuple[str, Material]]) -> Iterator[str]:
    """Yield a warning of each of the ``materials`` of named parts whose α is not given."""
    unknown: dict[str, list[str]] = {}
    for part, material in materials:
        if material.thermal_expansion is None:
            parts = unknown.setdefault(material.name, [])
            parts += [part] * (part not in parts)
    for name, parts in unknown.items():
        yield (
            f"{' and '.join(parts)} of {name}: this material has no thermal_expansion and is taken "
            f"to expand as steel, {STEEL.expansion:.3g} 1/K; give it"
        )


def expanding_materials(spindle: Spindle) -> Iterator[tuple[str, Material]]:
    """Yield the materials whose expansion loads bearings, with the part of each: of bearings, and
    between these and supports along the axis."""
    along = [support.x for support in spindle.supports if support.along != 0.0]
    stations, shaft = [*(seat.x for seat in spindle.seats), *along], spindle.shaft
    in_fits = expansions_in_fits(spindle)
    first, last = shaft.boundaries[:-1], shaft.boundaries[1:]
    for section, left, right in zip(shaft.sections, first, last, strict=True):
        if left <= max(stations) and right >= min(stations):
            yield "shaft", section.material
    for seat in spindle.seats:
        yield from bearing_materials(seat.bearing)
        if seat.fits is not None and seat.name in in_fits:
            yield "housing", seat.fits.housing_material


def bearing_materials(bearing: BallBearing) -> tuple[tuple[str, Material], ...]:
    """Return the materials of rings and balls."""
    return ("rings", bearing.ring_material), ("balls", bearing.ball_material)


def _two_housings(in_fits: dict[str, float], given: float | None) -> Iterator[str]:
    """Warn of a housing with one expansion along the axis and another one around its bearings, or
    with different ones around two bearings."""
    if not in_fits:
        return
    if given is not None:
        name, most = max(in_fits.items(), key=lambda item: abs(item[1] - given))
        if abs(most - given) > ALIKE * max(abs(most), abs(given)):
            yield (
                f"the housing expands by {given:.3g} 1/K along the axis (housing_expansion), but "
                f"around bearing {name} by the {most:.3g} 1/K of its fits: give fits the "
                "housing_material that it has, or leave housing_expansion out"
            )
    elif len({*in_fits.values()}) > 1:
        (least, low), (greatest, high) = (
            pick(in_fits.items(), key=lambda item: item[1]) for pick in (min, max)
        )
        yield (
            f"the housing expands by {low:.3g} 1/K around bearing {least} and by {high:.3g} around "
            f"bearing {greatest}; along the axis it is taken to expand as steel, "
            f"{STEEL.expansion:.3g} 1/K: give housing_expansion"
        )
