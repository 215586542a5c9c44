"""Rules between the parts of a spindle: names, ends of supports, sleeves, housings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from bearings.errors import InvalidBearing
from rotordyn.description import Faults, Path, named_twice, within
from rotordyn.machine.growth import ComputedShortening
from rotordyn.machine.matrix import acts
from rotordyn.machine.station import SLACK, all_on_the_shaft, on_the_shaft, turning_faults
from rotordyn.machine.support import GROUND, MOTIONS, SPINDLE, LinearSupport
from rotordyn.quantity import suggestion
from rotordyn.units import format_quantity

if TYPE_CHECKING:
    from rotordyn.machine.spindle import Spindle


def spindle_faults(spindle: Spindle) -> Faults:
    """Yield contradictions between the parts of a spindle, each of which is valid by itself."""
    yield from turning_faults(spindle.shaft, spindle.masses, spindle.discs, spindle.joints)
    yield from _named_once(spindle)
    yield from _stations(spindle)
    yield from _shifts(spindle)
    yield from _bores(spindle)
    yield from _rings(spindle)
    yield from _sleeves(spindle)
    yield from _set(spindle)
    yield from _fixed_twice(spindle)
    yield from _names_taken(spindle)
    yield from _rotors(spindle)
    yield from _carried(spindle)


def unknown(what: str, name: str, allowed: Iterable[str], instead: str = "") -> Iterator[str]:
    """Yield a sentence where a name is none of those allowed. Empty names, of faulty parts, match
    any other."""
    names = list(allowed)
    if name and not {name, ""} & {*names}:
        choices = ", ".join(names) or "none, there are none here"
        choices += f", {instead}" if instead else ""
        yield f"unknown {what}: given '{name}'; allowed: {choices}{suggestion(name, names)}"


def _named_once(spindle: Spindle) -> Faults:
    parts = {
        "bearings": spindle.seats,
        "sleeves": spindle.sleeves,
        "supports": spindle.supports,
        "dampers": spindle.dampers,
        "housings": spindle.housings,
        "rotors": spindle.rotors,
    }
    for key, items in parts.items():
        yield from named_twice(key, items)
    taken = {support.name for support in spindle.supports}
    for index, damper in enumerate(spindle.dampers):
        if damper.name and damper.name in taken:
            yield ("dampers", index, "name"), f"name already taken by a support: '{damper.name}'"


def _stations(spindle: Spindle) -> Faults:
    reach = spindle.shaft.reach
    yield from all_on_the_shaft("bearing", "bearings", spindle.seats, reach)
    yield from all_on_the_shaft("damper", "dampers", spindle.dampers, reach)
    if spindle.drawbar is not None:
        for key, x in (("from", spindle.drawbar.start), ("to", spindle.drawbar.end)):
            yield from on_the_shaft("drawbar", x, reach, ("drawbar", key))
    reaches = {SPINDLE: reach}
    if not misnamed(spindle):
        reaches |= {rotor.name: rotor.shaft.reach for rotor in spindle.rotors}
    for index, support in enumerate(spindle.supports):
        for end in support.ends:
            if end in reaches:
                what = "support" if end == SPINDLE else f"support on {end}"
                yield from on_the_shaft(what, support.x, reaches[end], ("supports", index, "x"))


def _rings(spindle: Spindle) -> Faults:
    """Yield a fault where flexible rings do not fit their balls or their seats."""
    low, high = spindle.shaft.reach
    for index, seat in enumerate(spindle.seats):
        bodies, bearing = seat.flexible_rings, seat.known_bearing
        if bodies is None or bearing is None or not low <= seat.x <= high:
            continue
        if not bodies.sound or any(bodies._faults()) or any(seat._faults()):
            continue
        try:
            spindle.mounted(seat)
        except InvalidBearing as refusal:
            yield ("bearings", index, "flexible_rings"), f"bearing {seat.name}: {refusal}"


def _shifts(spindle: Spindle) -> Faults:
    """Yield faults of shortening: its reference is off the shaft, or a bearing is unknown."""
    shortening, path = spindle.shortening, ("shortening",)
    if isinstance(shortening, ComputedShortening):
        yield from on_the_shaft(
            "reference", shortening.reference, spindle.shaft.reach, (*path, "reference")
        )
    elif shortening is not None:
        names = [seat.name for seat in spindle.seats]
        for name in shortening.shift:
            for sentence in unknown("bearing", name, names):
                yield (*path, "shift", name), sentence


def _bores(spindle: Spindle) -> Faults:
    """Yield a fault where the bore of a fitted bearing leaves no shaft in it."""
    for index, seat in enumerate(spindle.seats):
        fit, fits = seat.growth.fitted, seat.fits
        bore = fit.bore_diameter if fit is not None else fits and fits.bore_diameter
        if not bore or not spindle.shaft.sections or math.isnan(seat.x):
            continue
        shaft_bore = spindle.shaft.diameters_at(seat.x)[1]
        if bore <= shaft_bore:
            yield (
                ("bearings", index, *(("fits",) if fit is None else ("growth", "fit"))),
                f"the bore of bearing {seat.name} leaves no shaft: given "
                f"{format_quantity(bore, 'mm')}; allowed: above "
                f"{format_quantity(shaft_bore, 'mm')}",
            )


def _sleeves(spindle: Spindle) -> Faults:
    """Yield faults of sleeves: bearings unknown, on two sleeves, or of different thrust."""
    thrust = {seat.name: seat.thrust for seat in spindle.seats}
    sleeve_of: dict[str, str] = {}
    for index, sleeve in enumerate(spindle.sleeves):
        for position, name in enumerate(sleeve.bearings):
            path = ("sleeves", index, "bearings", position)
            for sentence in unknown("bearing", name, thrust):
                yield path, sentence
            if sleeve_of.setdefault(name, sleeve.name) != sleeve.name:
                also = ""
                if spindle.arrangement is not None and sleeve.name == spindle.arrangement.name:
                    also = (
                        ", and the arrangement carries it by its preload: leave one of the two out"
                    )
                yield path, f"bearing '{name}' is already on sleeve '{sleeve_of[name]}'{also}"
        if {1, -1} <= {thrust.get(name, 0) for name in sleeve.bearings}:
            yield (
                ("sleeves", index, "bearings"),
                "bearings of one sleeve must all have the same thrust: given +x and -x",
            )


def _set(spindle: Spindle) -> Faults:
    """Yield faults of a set: bearings are unknown, or their thrust is not that of its name."""
    bearing_set = spindle.arrangement
    if bearing_set is None:
        return
    names = [seat.name for seat in spindle.seats]
    for index, name in enumerate(bearing_set.bearings):
        for sentence in unknown("bearing", name, names):
            yield ("arrangement", "bearings", index), sentence
    yield from within(("arrangement",), bearing_set.faults_with(spindle.seats))


def _fixed_twice(spindle: Spindle) -> Faults:
    """Yield a fault where two supports fix one DOF, or one fixes x beside bearings."""
    fixing: dict[tuple[str, frozenset[str]], list[LinearSupport]] = {}
    for support in spindle.supports:
        for dof in support.rigid:
            same_dof = fixing.setdefault((dof, frozenset(support.ends)), [])
            for other in same_dof:
                if abs(support.x - other.x) <= SLACK:
                    yield (
                        ("supports",),
                        f"supports '{other.name}' and '{support.name}' both constrain {dof} there",
                    )
            same_dof.append(support)
    axial = fixing.get(("x", frozenset((SPINDLE, GROUND))))
    if axial and spindle.seats:
        yield (
            ("supports",),
            f"support '{axial[0].name}' is rigid in x beside bearings, whose preload moves the "
            "shaft along x: give it a stiffness xx",
        )


def _names_taken(spindle: Spindle) -> Faults:
    """Yield a fault where a housing or rotor has the name of something else."""
    taken = {seat.name: "a bearing" for seat in spindle.seats}
    taken |= {support.name: "a support" for support in spindle.supports}
    further = {rotor.name: "a rotor" for rotor in spindle.rotors}
    further |= {GROUND: "ground", SPINDLE: "the shaft"}
    for key, parts in (("rotors", spindle.rotors), ("housings", spindle.housings)):
        for index, part in enumerate(parts):
            if part.name and (what := taken.get(part.name)):
                yield (
                    (key, index, "name"),
                    f"name already taken by {what}: given '{part.name}'; allowed: any other",
                )
        taken |= further


def misnamed(spindle: Spindle) -> bool:
    """Return whether rotors have faulty names, so that references to them mean nothing."""
    names = [rotor.name for rotor in spindle.rotors]
    return bool({SPINDLE, GROUND, ""} & {*names}) or len({*names}) < len(names)


def _rotors(spindle: Spindle) -> Faults:
    """Yield faults of further rotors: names, ends of supports, rotors that nothing supports."""
    names = [rotor.name for rotor in spindle.rotors]
    for index, name in enumerate(names):
        if name in (SPINDLE, GROUND):
            yield (
                ("rotors", index, "name"),
                f"this name is not allowed for a further rotor: given '{name}'; allowed: any other "
                f"name than {SPINDLE} and {GROUND}",
            )
    if misnamed(spindle):
        return
    ends = [*_ends(spindle, (SPINDLE, *names))]
    yield from ends
    for index, name in enumerate(names):
        free = [dof for dof in ("y", "z") if dof not in held_by(spindle, name)]
        if free:
            yield (
                ("rotors", index, "name"),
                f"rotor '{name}' is unrestrained: no support with an end on it has a stiffness "
                f"along {' and '.join(free)}",
            )
    if names:
        yield from _losses(spindle)


def _ends(spindle: Spindle, known: tuple[str, ...]) -> Faults:
    for index, support in enumerate(spindle.supports):
        for key, allowed in (("holds", known), ("against", (GROUND, *known))):
            for sentence in unknown("rotor", getattr(support, key), allowed):
                yield ("supports", index, key), sentence
        if support.holds and support.holds == support.against:
            yield (
                ("supports", index, "against"),
                f"a support needs two different ends: given '{support.holds}'",
            )


def held_by(spindle: Spindle, name: str) -> frozenset[str]:
    """Return the bending DOF in which supports hold a rotor, by their stiffness or rigidly."""
    touching = [support for support in spindle.supports if name in support.ends]
    dofs = [dof for support in touching for dof in support.rigid]
    for support in touching:
        dofs += [a for (a, b), value in support.stiffness.items() if a == b and acts(value)]
    return frozenset(dof for dof in dofs if MOTIONS.get(dof) == "bending")


def _losses(spindle: Spindle) -> Faults:
    factors: list[tuple[Path, float]] = [(("damping", "loss_factor"), spindle.loss_factor)]
    for index, support in enumerate(spindle.supports):
        factors.append((("supports", index, "loss_factor"), support.loss_factor))
    for path, value in factors:
        if value:
            yield (
                path,
                "loss factors need a machine with one rotor, since the sign of their damping "
                "depends on the speed of each rotor: given {given} beside rotors; allowed: 0, with "
                "viscous damping instead",
            )


def _carried(spindle: Spindle) -> Faults:
    """Yield faults of what housings carry: unknown, on two housings, or held otherwise."""
    turning = (SPINDLE, *(rotor.name for rotor in spindle.rotors))
    bearings = [seat.name for seat in spindle.seats]
    supports = {support.name: support for support in spindle.supports}
    sprung = {
        name: sleeve.name
        for sleeve in spindle.sleeves
        if sleeve.radially < math.inf
        for name in sleeve.bearings
    }
    base: dict[str, str] = {}
    for index, housing in enumerate(spindle.housings):
        path = ("housings", index, "carries")
        for name in dict.fromkeys(filter(None, housing.carries)):
            known = [*bearings, *supports]
            if name not in known:
                allowed = ", ".join(known) or "none, there are none"
                yield (
                    path,
                    f"carries an unknown support or bearing '{name}'; allowed: {allowed}"
                    f"{suggestion(name, known)}",
                )
            elif name in bearings and name in supports:
                yield path, f"'{name}' is both a support and a bearing: rename one of them"
            elif name in supports and supports[name].rigid:
                yield (
                    path,
                    f"support '{name}' is rigid and cannot act on a flexible housing: give it a "
                    "stiffness",
                )
            elif name in supports and supports[name].against in turning:
                yield path, f"support '{name}' connects two rotors and not a rotor to ground"
            elif name in sprung:
                yield (
                    path,
                    f"bearing '{name}' is on sleeve '{sprung[name]}', whose radial stiffness "
                    "supports it on ground: leave out that stiffness, or the bearing from the "
                    "housing",
                )
            if name in base:
                yield path, f"'{name}' is on two housings: {base[name]} and {housing.name}"
            base[name] = housing.name
