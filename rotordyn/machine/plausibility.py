"""Warnings about what is possible but rarely intended: a sentence each, with the likely remedy.

Nothing here is refused. Every check reads the description alone.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from itertools import pairwise

from bearings.bearing import BallBearing
from rotordyn.machine.bearing_set import OPPOSITE
from rotordyn.machine.housing import Rows
from rotordyn.machine.implausible_bodies import UNLIKE, implausible_bodies
from rotordyn.machine.implausible_stress import implausible_stress
from rotordyn.machine.joint import WAYS
from rotordyn.machine.matrix import Entries, acts, entry_name
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle

RPM = 30.0 / math.pi
FASTEST = 3.0e6  # [mm/min] n·dm; oil–air spindles of hybrid bearings reach 2 to 2.8 million
SLOW = 100.0  # [rpm] of the highest speed; those of machining spindles have four digits and more
THIN = 0.05  # wall over the diameter of a ring: radial stiffness of the bearing 2 to 3 % lower
COMMON = 0.1  # the same, below which an adjacent ring adds to the deflection of the wall
GROWING = 1.0e6  # [mm/min] n·dm from which a missing ring growth is reported
BESIDE = 0.02  # of the width of rings: groove centres lie off their middle
SLENDER = 100.0  # length over outer diameter of one section
SOFT = (0.01, 1e3)  # [N/m], [N·m/rad]; springs have 1e5 to 1e8, less is meant as no spring
STRAIGHT = {("x", "x"), ("y", "y"), ("z", "z")}
LONG = 10.0  # [m] of a shaft
SHORT = 1e-5  # [m] of a section: less than any shoulder or chamfer has
AT_RIM = 400.0  # [m/s]; a thin steel ring has 1.3 GPa there, rims of grinding wheels reach 250 m/s
LOOSE = 5e3  # [N/m²] of Z·D²: a twentieth of the light preloads of makers
HEAVY = 0.2  # damping ratio of a shaft; measured ones are below a few hundredths
NEAR = 1e-6  # [m] between a point and an end


def implausible(spindle: Spindle, top: float) -> Iterator[str]:
    """Yield sentences about a machine whose spindle turns at up to ``top`` [rad/s]."""
    yield from _lengths(spindle)
    yield from implausible_bodies(spindle)
    yield from implausible_stress(spindle)
    yield from _tip(spindle)
    yield from _bores(spindle)
    yield from _overlapping(spindle)
    yield from _arrangement(spindle)
    yield from _low_speed(top)
    yield from _surface_speed(spindle, top)
    yield from _speed_factors(spindle, top)
    yield from _thin_walls(spindle)
    yield from _common_walls(spindle)
    yield from _loose_rings(spindle)
    yield from _soft_springs(spindle)
    yield from _small_preloads(spindle)
    yield from _damping_ratios(spindle)
    yield from estimates({seat.name: seat.bearing for seat in spindle.seats})


def estimates(bearings: Mapping[str, BallBearing]) -> Iterator[str]:
    """Yield sentences on bearings, by name, whose geometry is estimated from a catalogue."""
    alike: dict[str, list[str]] = {}
    doubted: dict[str, list[str]] = {}
    for name, bearing in bearings.items():
        if bearing.estimated:
            alike.setdefault(bearing.estimated, []).append(name)
            doubted.setdefault(bearing.doubt, []).append(name)
    for text, names in alike.items():
        yield (
            f"{named(names)}: estimate from catalogue values (nine in ten plausible internal "
            f"geometries): {text}; results that depend on balls and grooves vary as much"
        )
    yield from (f"{named(names)}: {text}" for text, names in doubted.items() if text)


def named(names: Collection[str]) -> str:
    """Return bearings by name, as the subject of a sentence: "bearings a, b"."""
    return f"bearing{'s' * (len(names) > 1)} {', '.join(names)}".strip()


def unopposed(spindle: Spindle) -> str:
    """Return a sentence where all bearings take thrust in the same direction, else ""."""
    signs = {seat.thrust for seat in spindle.seats}
    if len(signs) != 1 or any(seat.bearing.both_ways for seat in spindle.seats):
        return ""
    way, other = ("+x", "-x") if signs == {1} else ("-x", "+x")
    one = "turn one round" if len(spindle.seats) > 1 else "add one"
    return (
        f"all bearings carry thrust towards {way} only, and none opposes them: {one} (thrust: "
        f"{other}), or press them by an axial_force towards {way}"
    )


def undamped(spindle: Spindle) -> bool:
    """Return whether nothing in the machine dissipates energy."""
    joints = [*spindle.joints, *(joint for rotor in spindle.rotors for joint in rotor.joints)]
    damped = (
        spindle.damped
        or spindle.hysteretic
        or bool(spindle.dampers)
        or any(any(rotor.rotor_damping) or bool(rotor.rayleigh) for rotor in spindle.rotors)
        or any(seat.radial_damping or seat.axial_damping for seat in spindle.seats)
        or any(_nonzero(part.damping) for part in (*spindle.supports, *spindle.housings))
        or any(getattr(joint, f"{way}_damping") for joint in joints for way in WAYS)
    )
    return not damped


def _nonzero(matrix: Entries | Rows) -> bool:
    """Return whether a matrix is nonzero, by its entries or by its rows."""
    return any(map(acts, matrix.values() if isinstance(matrix, Mapping) else matrix))


def _soft_springs(spindle: Spindle) -> Iterator[str]:
    """Warn of stiffness far below that of machine parts, as of a number given in N/µm."""
    stiffness = {f"spring of sleeve {s.name}": s.spring.stiffness for s in spindle.sleeves}
    stiffness |= {f"sleeve {s.name}, radially": s.radially for s in spindle.sleeves}
    stiffness |= {f"joint {j.name}, {way}": getattr(j, way) for j in spindle.joints for way in WAYS}
    for support in spindle.supports:
        for pair, value in support.stiffness.items():
            if pair in STRAIGHT:
                largest = max(value) if isinstance(value, tuple) else value
                stiffness[f"support {support.name}, {entry_name(*pair)}"] = largest
    for what, value in stiffness.items():
        if SOFT[0] < value < SOFT[1]:
            turning = what.endswith(("tilt", "torsion"))
            unit, likely = ("N m/rad", "kN m/rad") if turning else ("N/m", "N/um")
            yield (
                f"{what}: a stiffness of {value:.4g} {unit} is far below that of machine parts: "
                f"check its unit (did you mean {value:.4g} {likely}?)"
            )


def _small_preloads(spindle: Spindle) -> Iterator[str]:
    """Warn of springs far below the light preload class of their bearings, as of kN in N."""
    for sleeve in spindle.sleeves:
        bearings = [seat.bearing for seat in spindle.seats if seat.name in sleeve.bearings]
        least = LOOSE * sum(each.balls * each.ball_diameter**2 for each in bearings)
        force = sleeve.spring.preload
        if 0.0 < force < least:
            yield (
                f"spring of sleeve {sleeve.name}: a preload of {force:.4g} N is far below the "
                f"light class of its bearings, some {20.0 * least:.2g} N: check its unit (did you "
                f"mean {force:.4g} kN?)"
            )


def _damping_ratios(spindle: Spindle) -> Iterator[str]:
    """Warn of modal damping far above that of any shaft, as of percents given as a number."""
    ratios = [*spindle.rotor_damping, *(r for rotor in spindle.rotors for r in rotor.rotor_damping)]
    largest = max(ratios, default=0.0)
    if largest > HEAVY:
        yield (
            f"damping.rotor: a damping ratio of {100.0 * largest:.4g} % is far above the few per "
            f"cent of shafts: check its unit (did you mean {largest:.4g} %?)"
        )


def _surface_speed(spindle: Spindle, top: float) -> Iterator[str]:
    """Warn of speeds at which no rotor of this diameter holds, as of rad/s instead of rpm."""
    widest = max(
        [section.outer_diameter for section in spindle.shaft.sections]
        + [section.rear_outer_diameter or 0.0 for section in spindle.shaft.sections]
        + [disc.outer_diameter for disc in spindle.discs]
    )
    rim = 0.5 * top * widest
    if rim > AT_RIM:
        meant = f" (did you mean {top:.6g} rpm?)" if rim / RPM < AT_RIM else ""
        yield (
            f"the highest speed is {top * RPM:.6g} rpm, at which the largest diameter, "
            f"{widest * 1e3:.4g} mm, has a surface speed of {rim:.0f} m/s, above {AT_RIM:g} m/s, "
            f"which hardly any steel rotor withstands: check speed and diameters{meant}"
        )


def _lengths(spindle: Spindle) -> Iterator[str]:
    for section, start in zip(spindle.shaft.sections, spindle.shaft.boundaries, strict=False):
        slender = section.length / section.outer_diameter
        called = f" ({section.name})" if section.name else ""
        if section.length < SHORT:
            yield (
                f"section from {start * 1e3:.4g} mm on{called} of the shaft is "
                f"{section.length * 1e6:.4g} µm long, less than any shoulder: check the unit of "
                f"its length (did you mean {section.length * 1e6:.4g} mm?)"
            )
        if slender > SLENDER:
            yield (
                f"section from {start * 1e3:.4g} mm on{called} of the shaft is "
                f"{section.length:.4g} m long, {slender:.0f} times its diameter: check the unit of "
                "its length"
            )
    total = spindle.shaft.end - spindle.shaft.start
    if total > LONG:
        yield f"the shaft is {total:.4g} m long: check the units of its sections"


def _tip(spindle: Spindle) -> Iterator[str]:
    """Warn of a point ``tip`` that did not move when a section of the tool became longer."""
    start, end = spindle.shaft.reach
    behind = spindle.points.get("tip", start) - start
    if NEAR < behind < end - start - NEAR:
        yield (
            f"point tip lies {behind * 1e3:.4g} mm behind the front end: give it as `front` in the "
            "points of the tool, which follows its sections, or rename it"
        )


def _bores(spindle: Spindle) -> Iterator[str]:
    """Warn of bearings on a shaft of another diameter, as of a radius given for it."""
    unlike: dict[str, tuple[float, float]] = {}
    for seat in spindle.seats:
        bore = _size(seat, "bore_diameter")
        under = spindle.shaft.diameters_at(seat.x)[0]
        if bore is not None and not 1.0 / UNLIKE < under / bore < UNLIKE:
            unlike[seat.name] = bore, under
    if unlike:
        worst = max(unlike, key=lambda name: abs(math.log(unlike[name][1] / unlike[name][0])))
        bore, under = unlike[worst]
        of = f" of {worst}" if len(unlike) > 1 else ""
        yield (
            f"{named(unlike)}: the bore{of} is {bore * 1e3:.4g} mm, the shaft at its seat "
            f"{under * 1e3:.4g} mm thick: check the section there, or the station"
        )


def _overlapping(spindle: Spindle) -> Iterator[str]:
    seats = sorted(spindle.seats, key=lambda seat: seat.x)
    for front, rear in pairwise(seats):
        widths = [size for seat in (front, rear) if (size := _size(seat, "width"))]
        rings = len(widths) == 2
        balls = [front.bearing.ball_diameter, rear.bearing.ball_diameter]
        least = sum(widths if rings else balls) / 2.0
        if rear.x - front.x < least * (1.0 - BESIDE * rings):
            yield (
                f"bearings {front.name} and {rear.name} overlap: their stations are "
                f"{(rear.x - front.x) * 1e3:.4g} mm apart, their "
                f"{'rings' if rings else 'balls alone'} need {least * 1e3:.4g} mm"
            )


def _size(seat: BearingSeat, key: str) -> float | None:
    """Return a size of the rings of a seat [m], None where unknown."""
    sizes = [getattr(body, key) for body in (seat.fits, seat.flexible_rings) if body is not None]
    return next(filter(None, sizes), seat.sizes.get(key))


def _arrangement(spindle: Spindle) -> Iterator[str]:
    facing = [(front, rear) for front, rear, word in spindle.pairings if word == "X"]
    if facing and not any(word == "O" for *_, word in spindle.pairings):
        names = ", ".join(f"{front} and {rear}" for front, rear in facing)
        yield (
            f"bearings {names} are mounted face to face (X): their contact lines meet between "
            "them, so that they restrain tilt with a short base; back to back (O) is usual in "
            f"spindles: {_reversal(spindle)}"
        )


def _reversal(spindle: Spindle) -> str:
    """Return how bearings face to face become back to back: those of one sleeve stay alike."""
    given = [seat.name for seat in spindle.seats if not seat.by_set]
    turn = f"reverse the thrust of all bearings ({', '.join(given)})" if given else ""
    given_set = spindle.arrangement.set if spindle.arrangement is not None else ""
    opposite = f"name the set {OPPOSITE[given_set]}" if given_set in OPPOSITE else ""
    return " and ".join(filter(None, (turn, opposite)))


def _low_speed(top: float) -> Iterator[str]:
    """Warn of speeds a thousand times too low, as of a point meant to separate thousands."""
    if 0.0 < top * RPM < SLOW:
        yield (
            f"the highest speed is {top * RPM:.4g} rpm: check it; a point separates decimals, not "
            "thousands (12.000 rpm is 12 rpm)"
        )


def _speed_factors(spindle: Spindle, top: float) -> Iterator[str]:
    factors = {s.name: top * RPM * s.bearing.pitch_diameter * 1e3 for s in spindle.seats}
    if fast := [name for name, factor in factors.items() if factor > FASTEST]:
        yield (
            f"{named(fast)}: n·dm {max(factors.values()) / 1e6:.2g} million mm/min at "
            f"{top * RPM:.0f} rpm is beyond {FASTEST / 1e6:.2g} million, which no grease or "
            "oil-air lubricated spindle bearing reaches: check speed and diameters"
        )
    growing = [seat for seat in spindle.seats if _growth_missing(seat, top)]
    if growing:
        names = named([seat.name for seat in growing])
        largest = max(_free_growth(seat, top) for seat in growing)
        yield (
            f"{names}: no centrifugal ring growth is given above n·dm "
            f"{GROWING / 1e6:g} million mm/min, where a free steel ring grows by up to "
            f"{largest * 1e6:.2g} µm on the radius at {top * RPM:.0f} rpm, and contact angles and "
            "preload follow: give growth.centrifugal or a fit"
        )


def _thin_walls(spindle: Spindle) -> Iterator[str]:
    """Warn of rings taken as rigid on a shaft or in a housing that becomes oval under them."""
    thin = [
        f"{seat.name} ({wall * 1e3:.3g} mm of {what})"
        for seat in spindle.seats
        if seat.flexible_rings is None
        for what, wall, size in _walls(spindle, seat)
        if 0.0 < wall < THIN * size
    ]
    if thin:
        yield (
            f"rings of bearing {', '.join(thin)} are modelled as rigid, but the wall there is "
            "flexible: stiffnesses are some hundredths too high, under radial loads up to a tenth; "
            "flexible_rings models the deformation"
        )


def _common_walls(spindle: Spindle) -> Iterator[str]:
    """Warn of adjacent rings on one thin wall, each computed with a wall of its own, as they
    differ or are taken apart."""
    seats = sorted(spindle.seats, key=lambda seat: seat.x)
    common = []
    for one, other in pairwise(seats):
        pair = [spindle.mounted(seat).rings for seat in (one, other)]
        for which, what in (("inner", "shaft"), ("outer", "housing or sleeve")):
            near, far = (getattr(each, which, None) for each in pair)
            if near is None or far is None or not _side_by_side(spindle, one, other, which):
                continue
            if spindle.joined(one, other, which):
                continue
            wall, seat = 0.5 * abs(near.backing_diameter - near.seat_diameter), near.seat_diameter
            if wall < COMMON * seat and near.backing_diameter == far.backing_diameter:
                common.append(f"{one.name} and {other.name} ({wall * 1e3:.3g} mm of {what})")
    if common:
        yield (
            f"rings of bearings {', '.join(common)} share one thin wall, and each is computed with "
            "a separate wall: the effect of flexible_rings there may be up to twice as large"
        )


def _side_by_side(spindle: Spindle, one: BearingSeat, other: BearingSeat, which: str) -> bool:
    """Return whether rings are less than half a width apart, outer ones in the same sleeve."""
    near = abs(other.x - one.x) < 0.75 * sum(_size(seat, "width") or 0.0 for seat in (one, other))
    return near and (
        which == "inner" or spindle.sleeve_of(one.name) == spindle.sleeve_of(other.name)
    )


def _loose_rings(spindle: Spindle) -> Iterator[str]:
    """Warn of rings that deform as one body with their seat, although there is clearance."""
    loose = [
        f"{seat.name} ({-2e6 * fits.depth('outer'):.2g} µm)"
        for seat in spindle.seats
        if (bodies := seat.flexible_rings) is not None
        and bodies.outer
        and (fits := seat.fits) is not None
        and fits.housing
        and fits.depth("outer") < 0.0
    ]
    if loose:
        yield (
            f"outer ring of bearing {', '.join(loose)}: has clearance in its housing by its fit, "
            "but is modelled as one body with it; it is more flexible than computed until it rests "
            "on the housing"
        )


def _walls(spindle: Spindle, seat: BearingSeat) -> Iterator[tuple[str, float, float]]:
    """Yield, as far as known, what the rings of a seat sit on, its wall and their diameter [m]."""
    fits, bore = seat.fits, _size(seat, "bore_diameter")
    if bore is not None:
        yield "shaft", 0.5 * (bore - spindle.shaft.diameters_at(seat.x)[1]), bore
    if fits is not None and fits.housing_diameter is not None and fits.outside_diameter is not None:
        outside = fits.outside_diameter
        yield "housing", 0.5 * (fits.housing_diameter - outside), outside


def _growth_missing(seat: BearingSeat, top: float) -> bool:
    fast = top * RPM * seat.bearing.pitch_diameter * 1e3 > GROWING
    specified = seat.growth.centrifugal is not None or (seat.fits is not None and seat.fits.shaft)
    return fast and not specified


def _free_growth(seat: BearingSeat, top: float) -> float:
    """Return ρ Ω² r³ / E of a thin ring with the radius of the inner raceway [m]."""
    material = seat.bearing.ring_material
    return material.density * top**2 * seat.bearing.inner_raceway_radius**3 / material.young_modulus
