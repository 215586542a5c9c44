"""Rules between a machine and its conditions: what holds it, what its frame allows."""

from __future__ import annotations

import math
from collections.abc import Iterable

from bearings.bearing import BallBearing
from rotordyn.description import Faults, Path
from rotordyn.machine.assembly import misnamed, unknown
from rotordyn.machine.history import Past
from rotordyn.machine.housing import Housing, ReducedHousing
from rotordyn.machine.matrix import acts, entry_name
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.station import on_the_shaft
from rotordyn.machine.support import GROUND, SPINDLE, LinearSupport, coupled_motions
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.formulation import INERTIAL, ROTATING
from rotordyn.scene.spec import Setting, placed
from rotordyn.units import format_quantity

MOST_ELEMENTS = 1000
RPM = math.pi / 30.0
FASTEST = 1e4 * RPM  # [m rad/s] n·dm of 10 million mm/min, twice what any ball bearing has run at
FORMULATION = ("conditions", "formulation")


def setting_faults(setting: Setting) -> Faults:
    """Yield faults between machine, conditions and speeds, by path in the case."""
    spindle, conditions = setting.spindle, setting.conditions
    yield from _surface_speed_faults(setting)
    yield from _shaft_faults(spindle)
    yield from _element_faults(spindle, conditions)
    if spindle.rotors:
        yield from _rotor_faults(spindle, conditions)
    if conditions.formulation == ROTATING:
        for support in spindle.supports:
            yield from _isotropy_faults(support)
    yield from _axial_restraint_faults(spindle, conditions)
    yield from _load_faults(setting)
    yield from _temperature_faults(setting)
    for support in spindle.supports:
        yield from ((("speeds",), sentence) for sentence in support.unknown_at(setting.speeds))
    yield from _housing_faults(spindle, conditions)
    yield from _joint_faults(spindle, conditions)
    if spindle.seats:
        yield from _coupling_faults(setting)


def last_setting_faults(setting: Setting) -> Faults:
    """Yield faults that only a computation shows; all other rules must hold already."""
    spindle = setting.spindle
    for index, seat in enumerate(spindle.seats):
        if seat.fits is None:
            continue
        from rotordyn.preload.growth import static_growth

        growth, room = static_growth(spindle, seat), seat.bearing.largest_static_growth
        if growth > room:
            yield (
                ("spindle", "bearings", index, "fits"),
                f"the fits of bearing {seat.name} reduce its contact angle to 0: growth "
                f"{format_quantity(growth, 'um')}; allowed: up to {format_quantity(room, 'um')}",
            )


def _surface_speed_faults(setting: Setting) -> Faults:
    """Yield a fault where n·dm is beyond any bearing, as when a number in rpm is given as rad/s."""
    speed_at: dict[Path, float] = {("speeds", k): speed for k, speed in enumerate(setting.speeds)}
    for k, step in enumerate(setting.conditions.history):
        speed_at[("conditions", "history", k, "speed")] = step.speed or 0.0
    if not speed_at:
        return
    path, top = max(speed_at.items(), key=lambda item: item[1])
    for seat in setting.spindle.seats:
        bearing: object = seat.bearing
        if isinstance(bearing, BallBearing) and top * bearing.pitch_diameter > FASTEST:
            product = top / RPM * bearing.pitch_diameter / 1e3
            yield (
                path,
                f"n·dm of bearing {seat.name} is {product:.3g}·10⁶ "
                f"mm/min: given {top / RPM:.6g} rpm; allowed: up to "
                f"{FASTEST / RPM / 1e3:.3g}·10⁶ mm/min (did you mean {top:.6g} rpm = "
                f"{top * RPM:.6g} rad/s?)",
            )
            return


def _shaft_faults(spindle: Spindle) -> Faults:
    reach = spindle.shaft.reach
    for name, x in spindle.points.items():
        yield from on_the_shaft("point", x, reach, ("spindle", "points", name))
    supports = [support for support in spindle.supports if SPINDLE in support.ends]
    restrained = {
        pair for support in supports for pair, value in support.stiffness.items() if acts(value)
    }
    restrained |= {(dof, dof) for support in supports for dof in support.rigid}
    free = [dof * 2 for dof in ("y", "z") if (dof, dof) not in restrained]
    if free and not spindle.seats and "" not in {support.name for support in spindle.supports}:
        yield (
            ("spindle", "supports"),
            "the shaft is unrestrained: no bearings, no support with stiffness "
            f"{' and '.join(free)}; give it, for a free shaft 1e-15 N/m",
        )


def _element_faults(spindle: Spindle, conditions: Conditions) -> Faults:
    """Yield a fault where there are more than ``MOST_ELEMENTS`` elements."""
    longest = conditions.element_length
    least = (spindle.shaft.end - spindle.shaft.start) / MOST_ELEMENTS
    if longest is not None and longest < least:
        yield (
            ("conditions", "element_length"),
            f"more than {MOST_ELEMENTS} elements: given {{given}}; allowed: from "
            f"{format_quantity(least, 'mm')}",
        )


def _load_faults(setting: Setting) -> Faults:
    """Yield faults of static loads: they need bearings, and places on the shaft."""
    spindle, conditions = setting.spindle, setting.conditions
    path = ("conditions", "loads")
    for index, load in enumerate(conditions.loads):
        yield from placed(load.at, spindle, (*path, index, "at"))
        if load.Fx and spindle.rotors:
            yield (
                (*path, index, "Fx"),
                "an axial force is not allowed with further rotors, whose supports would share it: "
                "given {given}; leave it out",
            )
    if conditions.loads and not spindle.seats:
        yield (
            path,
            "loads of the conditions act on the state of bearings, and this spindle has none: "
            "linear supports do not depend on them; give the loads to section_forces",
        )
    if setting.loaded and conditions.formulation == ROTATING:
        cause = "under static loads (loads, weight, misaligned seats)"
        yield _no_rotating_frame(f"{cause} bearings differ between directions")


def _temperature_faults(setting: Setting) -> Faults:
    """Yield faults of temperatures: they need bearings, and tables that cover all speeds."""
    spindle, conditions = setting.spindle, setting.conditions
    temperatures = conditions.temperatures
    yield from _heat_flow_faults(setting)
    yield from _film_faults(setting)
    if temperatures is None:
        return
    key = ("conditions", "temperatures")
    if not spindle.seats:
        yield (
            key,
            "temperatures act on the state of bearings, and this spindle has none: leave them out",
        )
    names = [seat.name for seat in spindle.seats]
    for name in temperatures.bearings:
        for sentence in unknown("bearing", name, names):
            yield (*key, "bearings", name), sentence
    passed_speeds: tuple[float, ...] = ()
    why = "which the history of its friction passes"
    if spindle.rubs:
        passed_speeds = Past(conditions.history).speeds
    elif conditions.bearings == "static":
        passed_speeds, why = (0.0,), "at which bearings are solved"
    uncovered = temperatures.unknown_at((*setting.speeds, *passed_speeds))
    if uncovered is not None:
        which = "" if uncovered in setting.speeds else f", {why}"
        ends = " to ".join(
            f"{speed / RPM:.6g}" for speed in (temperatures.speeds[0], temperatures.speeds[-1])
        )
        yield (
            (*key, "speeds"),
            f"the table of temperatures does not reach {uncovered / RPM:.6g} rpm{which}: given "
            f"{ends} rpm",
        )


def _heat_flow_faults(setting: Setting) -> Faults:
    """Yield faults of a heat flow: it needs bearings at speed, and excludes temperatures."""
    conditions, path = setting.conditions, ("conditions", "heat_flow")
    if conditions.heat_flow is None:
        return
    if not setting.spindle.seats:
        yield path, "heat flows off bearings, and this spindle has none: leave out"
    if conditions.temperatures is not None:
        yield path, "given beside temperatures, which follow from it; allowed: one of the two"
    if conditions.bearings == "static":
        yield path, "needs bearings at speed: given conditions.bearings: static"


def _film_faults(setting: Setting) -> Faults:
    """Yield faults of oil films: they need bearings at speed, and exclude a heat flow."""
    conditions, path = setting.conditions, ("conditions", "films")
    if conditions.films is None:
        return
    if not setting.spindle.seats:
        yield path, "films carry balls, and this spindle has no bearings: leave them out"
    if conditions.heat_flow is not None:
        yield path, "given beside heat_flow; allowed: one of the two"
    if conditions.bearings == "static":
        yield path, "needs bearings at speed: given conditions.bearings: static"
    if conditions.tangent != "complete":
        yield path, f"films need the complete tangent: given tangent {conditions.tangent}"


def _axial_restraint_faults(spindle: Spindle, conditions: Conditions) -> Faults:
    """Yield a fault where nothing carries the axial force or the weight."""
    if spindle.seats or any(s.along or "x" in s.rigid for s in spindle.supports):
        return
    weighed = bool(conditions.pull[0])
    for key, nonzero in (("axial_force", abs(conditions.axial_force) > 0.0), ("gravity", weighed)):
        if nonzero:
            yield (
                ("conditions", key),
                "the shaft is unrestrained along its axis: given {given}; allowed: with bearings, "
                "or with a support that has the stiffness xx or is rigid in x; tension needs none",
            )


def _isotropy_faults(support: LinearSupport) -> Faults:
    """Yield a fault where a support is not isotropic about the axis."""
    what = ""
    one_sided = [p for p in (("y", "z"), ("thy", "thz")) if len({*p} & {*support.rigid}) == 1]
    if "bending" in coupled_motions([support]):
        what = f"support '{support.name}' couples bending with another motion"
    elif one_sided:
        what = f"support '{support.name}' is rigid in only one of {' and '.join(one_sided[0])}"
    if what:
        yield _no_rotating_frame(what)
        return
    import numpy as np

    from rotordyn.equation.support import is_isotropic, support_matrices

    speeds = np.array(support.speeds or (0.0,))
    for name in ("stiffness", "damping"):
        entries = getattr(support, name).values()
        valid = not any(isinstance(value, float) and math.isnan(value) for value in entries)
        if valid and not is_isotropic(support_matrices(support, name, speeds)):
            differs = "differs between directions about the axis"
            yield _no_rotating_frame(f"the {name} of support '{support.name}' {differs}")


def _no_rotating_frame(what: str) -> tuple[Path, str]:
    described = "which a rotating frame cannot describe"
    return FORMULATION, f"{what}, {described}: given '{ROTATING}'; allowed: {INERTIAL}"


def _housing_faults(spindle: Spindle, conditions: Conditions) -> Faults:
    """Yield faults of housings: none in a rotating frame, none along x under a static state."""
    if spindle.housings and conditions.formulation == ROTATING:
        yield (
            FORMULATION,
            "a rotating frame cannot describe housings, which do not turn: given 'rotating'; "
            "allowed: inertial",
        )
    loaded = abs(conditions.axial_force) > 0.0 or bool(conditions.pull[0])
    for index, housing in enumerate(spindle.housings):
        if "x" in housing.directions and (spindle.seats or loaded):
            what = "of bearings" if spindle.seats else "of axial force and weight"
            yield (
                ("spindle", "housings", index, *_along(housing)),
                f"housing {housing.name} moves along x, but the static state {what} is computed on "
                "ground: leave x out",
            )


def _joint_faults(spindle: Spindle, conditions: Conditions) -> Faults:
    """Yield a fault where a joint is flexible along x between axial restraints of the shaft."""
    if not spindle.seats or conditions.rotor == "rigid":
        return
    supports = (s for s in spindle.supports if s.ends == (SPINDLE, GROUND))
    fixed = [seat.x for seat in spindle.seats]
    fixed += [support.x for support in supports if support.along or "x" in support.rigid]
    for index, joint in enumerate(spindle.joints):
        if math.isfinite(joint.axial) and min(fixed) <= joint.x < max(fixed):
            yield (
                ("spindle", "joints", index, "axial"),
                f"joint {joint.name} is flexible along x between bearings, or supports that "
                "restrain the shaft along x, but the preload state is that of a shaft rigid along "
                "its axis: leave axial out, or move the joint in front of all of them",
            )


def _along(housing: Housing) -> Path:
    """Return the path of the key that lets a housing move along the axis."""
    if isinstance(housing, ReducedHousing):
        return ("model",)
    return ("stiffness", *[entry_name(*pair) for pair in housing.stiffness if "x" in pair][:1])


def _rotor_faults(spindle: Spindle, conditions: Conditions) -> Faults:
    if conditions.formulation not in ("", INERTIAL):
        yield (
            FORMULATION,
            "rotors of different speeds have no common rotating frame: given "
            f"'{conditions.formulation}'; allowed: {INERTIAL}",
        )
    if conditions.pull[0]:
        yield (
            ("conditions", "gravity"),
            "weight along the axis is not allowed with further rotors, whose supports would share "
            f"it: given '{conditions.gravity}'; allowed: none",
        )
    if abs(conditions.axial_force) > 0.0:
        yield (
            ("conditions", "axial_force"),
            "an axial force takes no further rotors, on whose supports it would be shared: leave "
            "it out",
        )
    if spindle.seats and not misnamed(spindle):
        yield from _axial_tie_faults(spindle.supports)


def _axial_tie_faults(supports: Iterable[LinearSupport]) -> Faults:
    """Yield a fault where another rotor ties a shaft with bearings to ground along the axis.

    The preload state is that of the shaft alone; a rotor held by the shaft alone moves with it.
    """
    ties = [
        support
        for support in supports
        if set(support.ends) != {SPINDLE, GROUND}
        and any("x" in pair for pair in (*support.stiffness, support.rigid))
    ]
    reached, frontier = set[str](), {SPINDLE}
    while frontier:
        reached |= frontier
        ends = {end for tie in ties for end in tie.ends if reached & set(tie.ends) - {GROUND}}
        frontier = ends - reached
    if GROUND in reached:
        names = ", ".join(f"'{tie.name}'" for tie in ties if set(tie.ends) <= reached)
        yield (
            ("spindle",),
            f"supports {names} connect the shaft along the axis to ground through another rotor, "
            "but the preload state of the bearings is that of the shaft alone: leave out entries "
            "of x",
        )


def _coupling_faults(setting: Setting) -> Faults:
    """Yield a fault where a support couples x to other loads: bearing states are axial alone."""
    conditions = setting.conditions
    by_speed = conditions.bearings == "dynamic" and any(speed > 0.0 for speed in setting.speeds)
    acting = abs(conditions.axial_force) > 0.0 or any(conditions.pull) or setting.loaded
    if not (by_speed or acting or conditions.loads):
        return
    for support in setting.spindle.supports:
        if support.axial_coupling:
            names = ", ".join(entry_name(*pair) for pair in support.axial_coupling)
            yield (
                ("spindle",),
                f"support '{support.name}' pushes the shaft across the axis as its preload state "
                f"moves it along the axis ({names}), but bearings are solved under axial load "
                "alone: leave these entries out, or set bearings: static without axial force, "
                "weight and loads",
            )
