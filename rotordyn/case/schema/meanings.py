"""What each key of a file means, one phrase a key; all else about it comes from the schema."""

from __future__ import annotations

from bearings.bearing import Measure
from rotordyn.case.schema.base import Entry, title
from rotordyn.case.schema.bearing import BearingEntry

MEANINGS: dict[str, dict[str, str]] = {
    "case": {
        "title": "one line, shown in summary and figures",
        "note": "anything worth keeping",
        "spindle": "name of a model, or a path; either this or `bearing`",
        "tool": "name or path of what is clamped into the nose",
        "bearing": "name or path of a single bearing; either this or `spindle`",
        "override": "dotted path into the machine, items of a list by their name -> new value",
        "conditions": "how the machine is modelled",
        "speeds": "every speed at which the questions are answered",
        "analyses": "what is asked",
        "references": "known values shown beside the computed ones",
        "compare": "name of a variant -> what it changes; the variants are answered side by side",
    },
    "variant": {
        "title": "what figures and summary call it; by default its name",
        "spindle": "another spindle",
        "tool": "another tool",
        "bearing": "another single bearing",
        "override": "added to the overrides of the case",
        "conditions": "added to the conditions of the case",
        "references": "added to the references of the case",
    },
    "conditions": {
        "kinematics": "how a ball's rotation axis is found ([theory](theory/ball.md))",
        "moment_sharing": "which race carries the gyroscopic moment",
        "friction": "coefficient that limits the gyroscopic moment a race holds "
        "([theory](theory/ball.md#friction)); `none`: no limit",
        "tangent": "stiffness of a spindle's bearings where they act as springs "
        "([theory](theory/ball.md#the-tangent))",
        "bearings": "`static`: the state at rest serves every speed",
        "rotor": "`rigid`: the shaft does not bend, stretch or twist",
        "axial_force": "external force on the front end of the shaft (of the tool), towards +x",
        "tension": "force that pulls at both ends of the shaft and needs no support; below 0 it "
        "presses",
        "gravity": "direction of the rotor's weight (vertical spindle); sleeves are not weighed",
        "accuracy": "relative error allowed of every frequency asked for; the elements follow",
        "element_length": "standard elements no longer than that instead, whatever their error",
        "formulation": "frame in which bending is written ([the three](formulations.md))",
        "axial_stiffening": "the axial force in the shaft stiffens or softens its bending",
    },
    "speed range": {
        "from": "first speed",
        "to": "last speed, included",
        "step": "distance; must come out at `to`; either this or `count`",
        "count": "number of speeds, both ends included",
    },
    "frequency range": {
        "from": "first frequency",
        "to": "last frequency, included",
        "step": "distance; must come out at `to`; either this or `count`",
        "count": "number of frequencies, both ends included",
    },
    "analyses": {
        "preload": "state of every bearing at every speed",
        "campbell": "damped modes over speed",
        "frf": "frequency responses over speed and frequency",
        "stiffness": "radial stiffness of a point",
        "section_forces": "section forces, deflection, stress and twist under static loads",
        "unbalance": "steady response to unbalance over speed ([theory](theory/response.md))",
        "bearing": "a single bearing over load and speed",
        "control": "which race controls the balls of a single bearing",
    },
    "preload": {},
    "campbell": {
        "max_frequency": "modes that come below it are followed",
        "teeth": "numbers of teeth whose passing frequency is drawn",
        "engine_orders": "multiples of the speed, whole or not, whose critical speeds are sought",
        "shapes": "keep the mode shapes at the first and last speed",
        "shapes_3d": "draw them in space too, and write them as meshes ([how](theory/shapes.md))",
    },
    "shapes in space": {
        "amplitude": "largest displacement drawn, over the length of the shaft",
        "animation": "one period of each mode as a GIF",
        "files": "formats of the meshes that other programs read",
    },
    "frf": {
        "frequencies": "of the excitation, independent of speed; these or `engine_orders`, or both",
        "engine_orders": "multiples of the speed of every rotor, whole or not, followed over speed",
        "quantity": "displacement, velocity or acceleration over force",
        "pairs": "which responses to which forces; these or `matrix`, or both",
        "matrix": "lists instead: every response to every excitation",
        "slices": "speeds drawn as curves and written as UFF58 (nearest speed of the case)",
        "measured": "measured ones laid over ([how](theory/receptances.md#measured-responses))",
    },
    "pair": {
        "response": "a point and one of x, y, z, thx, thy, thz",
        "excitation": "a point and the direction of its force or moment",
    },
    "measured": {
        "name": "in figures and summary; by default its number",
        "file": "beside the case: UFF with records of type 58, or a table that ends in .csv",
        "record": "of type 58, counted from 1; needed where there are several",
        "response": "the pair of the case that it is laid over",
        "excitation": "the pair of the case that it is laid over",
        "speed": "at which it was measured",
    },
    "response matrix": {
        "responses": "points, each with one of x, y, z, thx, thy, thz",
        "excitations": "points, each with the direction of its force or moment",
    },
    "stiffness": {
        "point": "where the force acts and the deflection is taken",
        "max_force": "highest radial force",
        "steps": "load steps up to it",
        "variants": "ways of modelling the bearings ([theory](theory/radial_stiffness.md))",
        "second_stop": "other stop travels by sleeve, computed as one more variant",
    },
    "section forces": {
        "loads": "forces and moments at points or stations",
        "line_loads": "forces per length",
        "unbalances": "rotating forces as they stand at one angle",
        "gravity": "direction of the rotor's weight, in any of the axes",
        "twist_limits": "angles by which it may twist, and the diameters that keep to them",
    },
    "point load": {
        "name": "for messages",
        "at": "where it acts",
        "Fx": "force towards +x",
        "Fy": "force towards +y",
        "Fz": "force towards +z",
        "Mx": "moment about x: a torque",
        "My": "moment about y",
        "Mz": "moment about z",
        "y": "distance from the axis at which the forces act, along y",
        "z": "the same along z",
    },
    "line load": {
        "name": "for messages",
        "from": "where it begins",
        "to": "where it ends",
        "qx": "force per length towards +x",
        "qy": "force per length towards +y",
        "qz": "force per length towards +z",
    },
    "unbalance": {
        "name": "for messages",
        "at": "where it turns",
        "unbalance": "mass times distance from the axis",
        "angle": "of its force, from y towards z",
    },
    "eccentric span": {
        "name": "in results and messages",
        "from": "where it begins",
        "to": "where it ends",
        "eccentricity": "distance of its centre of mass from the axis",
        "angle": "of that distance, from y towards z",
    },
    "balance grade": {
        "quality": "G",
        "speed": "highest speed of service of the spindle; the grade belongs to that of the rotor "
        "itself, which is this times its `speed_ratio`",
        "planes": "one or two points or stations that hold it; two share it by the levers of the "
        "centre of gravity between them, neither below 0.3",
        "phase": "of the second plane: `static` like the first, `couple` opposite",
        "angle": "in the first plane, from y towards z",
    },
    "unbalance response": {
        "points": "where motion is told",
        "unbalances": "at points or stations",
        "spans": "lengths of shaft off their axis",
        "grade": "residual unbalance by balance quality grade, added to the others",
    },
    "twist limit": {
        "name": "in summary and tables; by default its two ends",
        "from": "one end",
        "to": "the other end",
        "limit": "angle between the two sections",
        "bore": "of the uniform shaft whose outer diameter is sought",
    },
    "bearing map": {
        "loads": "axial loads, ascending; one of `loads`, `radial_loads`, `moments` is given",
        "radial_loads": "radial loads along y, ascending, instead",
        "moments": "moments about z, ascending, instead; they tilt the ring in the plane of y",
        "axial_load": "acts all the time, where axial loads are not the list",
        "radial_load": "acts all the time, where radial loads are not the list",
        "moment": "acts all the time, where moments are not the list",
        "tilt": "`blocked` holds the tilts of the ring at zero",
        "dynamics": "`frozen`: centrifugal force at the free contact angle, no gyroscopic moment "
        "([theory](theory/four_point.md#at-speed))",
        "static_growth": "radial growth of the inner groove at rest",
        "tangents": "stiffness matrices to compute ([theory](theory/ball.md#the-tangent))",
    },
    "control": {
        "max_load": "highest axial load to look at",
        "min_load": "lowest axial load to look at",
        "radial": "radial load over the axial one",
        "static_growth": "radial growth of the inner groove at rest",
    },
    "spindle": {
        "title": "one line",
        "note": "what is known, assumed, estimated",
        "sources": "where it comes from",
        "shaft": "the turning shaft",
        "masses": "rigid masses on the shaft",
        "discs": "rigid discs on the shaft",
        "bearings": "its bearings, of any kind",
        "bearing_override": "keys of the bearing model -> values, for every bearing",
        "growth": "ring growth of every bearing that gives none itself",
        "shortening": "axial shift of the seats with speed",
        "sleeves": "sliding sleeves with their springs",
        "supports": "linear supports to ground, to the housing that carries them, to another rotor",
        "dampers": "squeeze films between the shaft and ground",
        "housings": "what supports and bearings stand on where that gives way",
        "joints": "between parts of the shaft, as of a tool holder",
        "rotors": "further ones on the same axis, turning at their own speeds",
        "drawbar": "bar in the bore that pulls the tool into the nose",
        "damping": "of bearings and rotor",
        "points": "named stations",
        "references": "known values shown beside the computed ones",
    },
    "shaft": {
        "start": "station of its front end",
        "shear_coefficient": "formula by Poisson's ratio and diameters, or the coefficient; "
        "`none`: no shear deformation (Euler and Bernoulli's beam)",
        "material": "of sections that name none; name, path or mapping",
        "sections": "from front to rear",
    },
    "section": {
        "name": "for messages, overrides and the figure",
        "length": "along the axis",
        "outer_diameter": "above the inner one",
        "inner_diameter": "bore",
        "rear_outer_diameter": "where it is another one at the rear end: a cone",
        "rear_inner_diameter": "likewise, of the bore",
        "material": "instead of that of the shaft",
    },
    "mass": {
        "name": "for messages and overrides",
        "x": "station",
        "mass": "of the body",
        "polar_inertia": "about the axis",
        "diametral_inertia": "about a diameter through its centre",
    },
    "disc": {
        "name": "for messages and overrides",
        "x": "station of its centre",
        "outer_diameter": "above the inner one",
        "inner_diameter": "bore",
        "width": "along the axis",
        "material": "name, path or mapping",
    },
    "seat": {
        "name": "of this bearing",
        "model": "name or path of a bearing model, or a mapping",
        "model_override": "keys of the model -> values, for this bearing",
        "x": "station of the circle of inner groove centres",
        "thrust": "the way the shaft pushes the inner ring to load the balls; of kinds that take "
        "thrust both ways only needed on a sleeve",
        "kinematics": "instead of that of the conditions",
        "moment_sharing": "instead of that of the conditions",
        "friction": "instead of that of the conditions",
        "growth": "instead of that of the spindle",
        "damping": "instead of that of the spindle",
    },
    "growth": {
        "static": "at rest, part of every speed",
        "centrifugal": "added with speed",
        "fit": "fit of ring and shaft, needed where growth is `computed`",
    },
    "quadratic": {
        "value": "at the speed `at`",
        "at": "speed; the value grows with speed squared",
    },
    "fit": {
        "interference": "on the radius, at rest",
        "bore_diameter": "of the inner ring; by default that of the bearing model",
    },
    "shortening": {
        "shift": "bearing -> shift towards +x, or computed from the sections",
        "at": "speed of the given shifts, which grow with speed squared",
        "reference": "station that does not shift, for `computed`",
    },
    "sleeve": {
        "name": "of the sleeve",
        "bearings": "whose outer rings it carries",
        "spring": "that loads these bearings",
        "stop_travel": "way against the spring, from rest to the end stop",
        "mass": "of the sleeve",
        "radial_stiffness": "between sleeve and housing",
    },
    "spring": {
        "preload": "force at rest",
        "stiffness": "`rigid` locks the sleeve in its place at rest",
    },
    "support": {
        "name": "of the support",
        "x": "station",
        "stiffness": "between its two ends, 6×6, in the fixed frame",
        "damping": "between its two ends, 6×6, in the fixed frame",
        "rigid": "freedoms that do not move, instead of a stiffness",
        "speeds": "of the values in lists, ascending",
        "beyond": "at speeds outside a table: `refuse` the case, or `hold` the values of its "
        "nearest end, with a warning",
        "table": "CSV file that holds these lists instead "
        "([columns](conventions.md#tables-over-speed))",
        "loss_factor": "η of its stiffness: hysteretic damping in the fixed frame, without further "
        "rotors ([how](theory/damping.md#hysteretic-damping))",
        "holds": "the rotor at one end; `spindle` is its shaft",
        "against": "what is at the other end: `ground` (or a housing), `spindle` or another rotor",
    },
    "rotor": {
        "name": "by which supports, points and results call it, and of no support or bearing",
        "speed_ratio": "its speed over that of the spindle: 1 turns with it, 0 stands still, below "
        "0 turns the other way round",
        "shaft": "its own, at stations of the same axis",
        "masses": "rigid masses on it",
        "discs": "rigid discs on it",
        "joints": "between parts of its shaft",
        "damping": "of this rotor",
        "points": "named stations; elsewhere they are called ROTOR.POINT",
    },
    "rotor damping": {
        "rayleigh": "damping by its mass and stiffness, added to `rotor`",
        "rotor": "modal ratios of the flexible free-free bending modes at rest, the last repeated",
        "internal": "share of `rotor` that turns with it ([why](theory/damping.md))",
    },
    "housing": {
        "name": "of the housing, and of no support, bearing or rotor",
        "carries": "supports (none between two rotors) and bearings that stand on it; all others "
        "stand on ground",
        "x": "station of its centre of gravity, where its stiffness and damping act",
        "mass": "of the body",
        "polar_inertia": "about the axis",
        "diametral_inertia": "about y or z through its centre of gravity",
        "stiffness": "of the body against ground, 6×6; it moves in the freedoms named here",
        "damping": "of the body against ground, 6×6",
        "model": "path of a .npz file, or a mapping of model files, instead of all these "
        "([how](conventions.md#housings))",
    },
    "joint": {
        "name": "of the joint",
        "x": "station; what sits there belongs to the part in front",
        "radial": "spring across the axis",
        "tilt": "spring against bending",
        "axial": "spring along the axis",
        "torsion": "spring against twist",
        "damping": "dampers that turn with the shaft",
    },
    "joint damping": {
        "radial": "across the axis",
        "tilt": "against bending",
        "axial": "along the axis",
        "torsion": "against twist",
    },
    "model files": {
        "mass": "Matrix Market file (.mtx), n × n, kg",
        "stiffness": "likewise, N/m",
        "damping": "likewise, N·s/m; none by default",
        "places": "of every coordinate, `front.y` under the support or bearing front; an inner one "
        'is `""`',
    },
    "whole stiffness": {
        "freedoms": "what rows (loads) and columns (displacements) belong to",
        "matrix": "N/m, N/rad or N m/rad as the freedoms require; a bare 0 needs no unit",
    },
    "whole damping": {
        "freedoms": "what rows (loads) and columns (velocities) belong to",
        "matrix": "N s/m, N s/rad or N m s/rad as the freedoms require; a bare 0 needs no unit",
    },
    "squeeze film damper": {
        "name": "of the damper",
        "x": "station",
        "viscosity": "dynamic, of the oil in the film",
        "length": "of the film, open at both ends; short against the radius",
        "radius": "of the journal, which does not spin",
        "clearance": "on the radius",
        "eccentricity_ratio": "radius of the circular orbit over the clearance",
        "film": "`cavitated`: pressure over half the circumference (π film); `full`: over all "
        "of it ([theory](theory/supports.md#squeeze-film-dampers))",
    },
    "drawbar": {
        "force": "tension in the bar, which compresses the shaft between `from` and `to`",
        "from": "front station where it pulls the shaft",
        "to": "rear station where it pulls the shaft",
        "guides": "stations between where it touches the bore; in between it runs straight",
    },
    "damping": {
        "bearings": "of bearings that give none themselves",
        "rayleigh": "damping of the rotor by its mass and stiffness, added to `rotor`",
        "rotor": "modal ratios of the flexible free-free bending modes at rest, the last repeated",
        "internal": "share of `rotor` that turns with the shaft ([why](theory/damping.md))",
        "loss_factor": "η of the stiffness of the rotor: hysteretic damping, which turns with the "
        "shaft, without further rotors ([how](theory/damping.md#hysteretic-damping))",
    },
    "rayleigh": {
        "mass": "α, by which the mass matrix of the rotor is multiplied",
        "stiffness": "β, by which its stiffness matrix is multiplied",
    },
    "bearing damping": {
        "radial": "between the rings",
        "axial": "between the rings",
    },
    "tool": {
        "title": "one line",
        "note": "anything worth keeping",
        "sources": "where it comes from",
        "material": "of sections that name none",
        "sections": "from its tip to the nose face",
        "masses": "rigid masses on the tool",
        "joints": "of the tool, or between tool and spindle; x = 0 is the nose face",
        "points": "named stations, in coordinates of the spindle (negative)",
        "references": "known values shown beside the computed ones",
    },
    "bearing": {
        "name": "as printed",
        "source": "where it comes from",
        "kind": "which keys it has besides these",
        "note": "what is estimated",
        "bore_diameter": "of the inner ring",
        "outside_diameter": "of the outer ring",
        "width": "of the rings",
    },
    "material": {
        "name": "as printed",
        "young_modulus": "E",
        "poisson_ratio": "ν",
        "density": "ρ",
        "source": "where it comes from",
        "note": "anything worth keeping",
    },
    "reference": {
        "quantity": "what is known",
        "subject": "variant, sleeve or bearing it belongs to",
        "kind": "computed by others, or measured",
        "source": "where it was found",
        "speeds": "one per value, or one for all",
        "values": "with units of the quantity",
        "remark": "one sentence why it may differ from ours",
        "conditions": "compared only where these conditions are in force",
    },
}


def meanings(entry: type[Entry]) -> dict[str, str]:
    """Meaning of every key of an entry; of a kind of bearing its own ones from its measures."""
    if issubclass(entry, BearingEntry):
        geometry = {name: _meaning(measure) for name, measure in entry.measures.items()}
        return {**MEANINGS[title(BearingEntry)], **geometry}
    return MEANINGS.get(title(entry), {})


def _meaning(measure: Measure) -> str:
    written = "; name, path or mapping" if measure.quantity == "material" else ""
    return measure.meaning + written
