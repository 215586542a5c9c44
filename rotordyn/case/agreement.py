"""What a case asks against the machine it names: points, sleeves, bearings, speeds exist."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields

from rotordyn.analyses.contract import Spec
from rotordyn.analyses.frf.spec import ORDERS_TURNED, QUANTITIES, FrfSpec
from rotordyn.analyses.registry import analysis
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.case.loads import misplaced, misplaced_unbalance, overheld, rotors_of, unheld
from rotordyn.description import ascending
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import housed_motions
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import MOTIONS, SPINDLE, acts, coupled_motions, entry_name
from rotordyn.quantity import suggestion
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.formulation import ROTATING, turned
from rotordyn.scene.on_housings import directions_on_housings, obstacles_on_housings
from rotordyn.scene.on_joints import obstacles_of_joints
from rotordyn.scene.on_rotors import joined_along, obstacles_of_rotors

OF_BALLS = ("kinematics", "moment_sharing", "friction")
MOST_ELEMENTS = 1000
_SPOKEN = {"axial": "axial motion"}


def speeds_agree(speeds: tuple[float, ...], analyses: Mapping[str, Spec]) -> Iterator[str]:
    """Speeds ascend, and slices lie within them."""
    if not speeds:
        yield "no speeds: at least one is needed"
        return
    yield from ascending("speeds", speeds)
    for spec in analyses.values():
        for speed in spec.slices if isinstance(spec, FrfSpec) else ():
            if not speeds[0] - 1e-6 <= speed <= speeds[-1] + 1e-6:
                yield f"frf: slices: not within the speeds of the case: given {speed:.6g} rad/s"


def questions_agree(
    spindle: Spindle | None, conditions: Conditions, analyses: Mapping[str, Spec]
) -> Iterator[str]:
    """Every question can be asked of the machine; without a spindle it is a single bearing."""
    if not analyses:
        yield "nothing is asked: name at least one analysis"
    for name, spec in analyses.items():
        try:
            own = analysis(name)
        except InvalidInput as error:
            yield str(error)
            return
        if not isinstance(spec, own.spec):
            yield f"analysis {name} takes a {own.spec.__name__}: given a {type(spec).__name__}"
        if (own.machine == "bearing") == (spindle is not None):
            kind = "single bearing" if spindle is None else "spindle"
            yield f"analysis {name} does not apply to a {kind}"
    if spindle is None:
        yield from _of_balls(conditions)
    if spindle is not None:
        yield from _machine(spindle, conditions)
        for name, spec in analyses.items():
            yield from _question(name, spec, spindle, conditions)
            if isinstance(spec, SectionForcesSpec):
                yield from _section_forces(name, spec, spindle, conditions)


def resolved_agree(
    spindle: Spindle,
    conditions: Conditions,
    analyses: Mapping[str, Spec],
    speeds: tuple[float, ...],
) -> Iterator[str]:
    """Elements of a given length carry what is asked of them."""
    if conditions.element_length is None:
        return
    from rotordyn.analyses.resolution import beyond_elements

    for sentence in beyond_elements(spindle, conditions, analyses, max(speeds, default=0.0)):
        yield f"conditions.element_length: {sentence}"


def _of_balls(conditions: Conditions) -> Iterator[str]:
    plain = Conditions()
    for name in (field.name for field in fields(conditions) if field.name not in OF_BALLS):
        if getattr(conditions, name) != getattr(plain, name):
            yield (
                f"conditions.{name} does not apply to a single bearing; allowed: "
                f"{', '.join(OF_BALLS)}"
            )


def moved_along(speeds: Iterable[float], bearings: str, force: float, weighed: bool) -> bool:
    """The preload state moves the shaft along its axis: by speed, by a force, by its weight."""
    return (bearings == "dynamic" and any(speeds)) or force != 0.0 or weighed


def supports_agree(
    spindle: Spindle, conditions: Conditions, speeds: tuple[float, ...]
) -> Iterator[str]:
    """Supports are known at the speeds; none turns motion along the axis into a push aside."""
    for support in spindle.supports:
        yield from support.unknown_at(speeds)
    own = conditions
    moved = moved_along(speeds, own.bearings, own.axial_force, own.gravity != "none")
    for support in spindle.supports if spindle.seats and moved else ():
        if support.sideways:
            names = ", ".join(entry_name(*pair) for pair in support.sideways)
            yield (
                f"support '{support.name}' pushes the shaft aside as its preload state moves it "
                f"along the axis ({names}): bearings are solved under axial load alone"
            )


def housings_agree(
    spindle: Spindle, conditions: Conditions, analyses: Iterable[str]
) -> Iterator[str]:
    """The questions and conditions of a case take housings, joints and further rotors."""
    for way, sentence in obstacles_of_rotors(conditions, analyses) if spindle.rotors else ():
        yield f"{'.'.join(way)}: {sentence}"
    if spindle.seats:
        yield from joined_along(spindle.supports)
    for way, sentence in obstacles_of_joints(analyses) if spindle.joints else ():
        yield f"{'.'.join(way)}: {sentence}"
    if not spindle.housings:
        return
    for way, sentence in obstacles_on_housings(conditions.formulation, analyses):
        yield f"{'.'.join(way)}: {sentence}"
    named = {name for housing in spindle.housings for name in housing.directions}
    loaded = conditions.axial_force != 0.0 or conditions.gravity != "none"
    yield from directions_on_housings(named, bool(spindle.seats), loaded)


def references_agree(references: Iterable[Reference], conditions: Conditions) -> Iterator[str]:
    """The conditions that references were found under are conditions of a model."""
    known = [field.name for field in fields(conditions)]
    for name in {name: None for reference in references for name in reference.conditions}:
        yield from _exists(name, known, "references: unknown condition")


def uncoupled(response: str, excitation: str, coupled: frozenset[str]) -> tuple[str, ...]:
    """The two motions that directions belong to, where nothing couples them; else nothing.

    ``coupled``: the motions that supports couple; unknown directions belong to no motion.
    """
    motions = [MOTIONS.get(direction, "") for direction in (response, excitation)]
    if "" in motions or motions[0] == motions[1] or coupled.issuperset(motions):
        return ()
    return tuple(_SPOKEN.get(motion, motion) for motion in motions)


def _machine(spindle: Spindle, conditions: Conditions) -> Iterator[str]:
    yield from spindle.off_the_shaft(*((f"point {n}", x) for n, x in spindle.points.items()))
    for rotor in spindle.rotors:
        named = ((f"point {rotor.name}.{name}", x) for name, x in rotor.points.items())
        yield from spindle.part(rotor.name).off_the_shaft(*named)
    own = [support for support in spindle.supports if SPINDLE in support.ends]
    held = {pair for support in own for pair, k in support.stiffness.items() if acts(k)}
    held |= {(freedom, freedom) for support in own for freedom in support.rigid}
    free = [freedom for freedom in ("y", "z") if (freedom, freedom) not in held]
    if free and not spindle.seats:
        axes = " and ".join(free)
        yield f"the shaft is not held: no bearings, no support with stiffness along {axes}"
    longest = conditions.element_length
    least = (spindle.shaft.end - spindle.shaft.start) / MOST_ELEMENTS
    if longest is not None and longest < least:
        yield (
            f"conditions.element_length: more than {MOST_ELEMENTS} elements: given "
            f"{longest:.6g} m; allowed: from {least:.6g} m"
        )


def _question(name: str, spec: Spec, spindle: Spindle, conditions: Conditions) -> Iterator[str]:
    if analysis(name).bearings and not spindle.seats:
        yield f"{name} needs bearings: this spindle has none"
    if isinstance(spec, FrfSpec):
        yield from _frf(name, spec, spindle, conditions)
    if isinstance(spec, UnbalanceSpec):
        yield from _unbalance(name, spec, spindle)
    if isinstance(spec, StiffnessSpec):
        yield from _exists(spec.point, spindle.points, f"{name}: unknown point")
        sleeves = [sleeve.name for sleeve in spindle.sleeves]
        for sleeve in spec.second_stop:
            yield from _exists(sleeve, sleeves, f"{name}: second_stop: unknown sleeve")
        yield from (f"{name}: {sentence}" for sentence in _one_plane(spindle))


def _frf(name: str, spec: FrfSpec, spindle: Spindle, conditions: Conditions) -> Iterator[str]:
    if spec.quantity != QUANTITIES[0] and conditions.formulation == ROTATING:
        yield f"{name}: quantity: {turned(spec.quantity)}"
    if spec.engine_orders and conditions.formulation == ROTATING:
        yield f"{name}: engine_orders: {ORDERS_TURNED}"
    for point in {port.point: None for pair in spec.pairs for port in pair}:
        yield from _exists(point, spindle.places, f"{name}: unknown point")
    for pair in spec.pairs:
        ends = (pair[0].direction, pair[1].direction)
        if motions := uncoupled(*ends, _coupled(spindle)):
            yield (
                f"{name}: nothing couples {' and '.join(motions)}: given "
                f"'{pair[0]} / {pair[1]}'; allowed: both ends in one of x; thx; y, z, thy, thz"
            )


def _unbalance(name: str, spec: UnbalanceSpec, spindle: Spindle) -> Iterator[str]:
    for way, sentence in misplaced_unbalance(spec, rotors_of(spindle)):
        yield f"{'.'.join(map(str, (name, *way)))}: {sentence}"


def _coupled(spindle: Spindle) -> frozenset[str]:
    return coupled_motions(spindle.supports) | housed_motions(spindle.housings)


def _one_plane(spindle: Spindle) -> Iterator[str]:
    for support in spindle.supports:
        if support.out_of_plane:
            across = ", ".join(entry_name(*pair) for pair in support.out_of_plane)
            yield (
                f"support '{support.name}' couples plane y or the axis to other motions "
                f"({across}): the radial stiffness is solved in plane y alone"
            )


def _section_forces(
    name: str, spec: SectionForcesSpec, spindle: Spindle, conditions: Conditions
) -> Iterator[str]:
    reach = spindle.shaft.start, spindle.shaft.end
    otherwise = bool(
        spindle.seats or spindle.drawbar or conditions.axial_force or conditions.tension
    )
    where = spindle.points, reach, conditions.gravity
    faults = list(misplaced(spec, *where, otherwise=otherwise))
    for way, sentence in faults or unheld(spec, spindle, conditions):
        yield ": ".join(filter(None, (name, ".".join(map(str, way)), sentence)))
    yield from (f"conditions.rotor: {sentence}" for sentence in overheld(spindle, conditions))


def _exists(name: str, allowed: Iterable[str], what: str) -> Iterator[str]:
    known = list(allowed)
    if name not in known:
        choices = ", ".join(known) or "none, there are none here"
        yield f"{what} '{name}'; allowed: {choices}{suggestion(name, known)}"
