"""Keys that only files have, in addition to the fields of descriptions.

``extra``: keys that are not stored, or are evaluated before a description is read. ``COMMON``:
values given once for all items of a list, for those items that have none themselves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Annotated, Any

from bearings.bearing import BallBearing
from bearings.kinds import DEFAULT, KINDS, kind_class
from bearings.materials import Material
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.case.case import Case
from rotordyn.description import Description, Faults, repeated
from rotordyn.field import Field, declared
from rotordyn.machine.fits import Fits
from rotordyn.machine.flexible_rings import SIZES, RingBodies
from rotordyn.machine.growth import (
    ComputedShortening,
    InterferenceFit,
    PrescribedShortening,
)
from rotordyn.machine.housing import ReducedHousing
from rotordyn.machine.reference import Reference
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.machine.tool import Tool
from rotordyn.quantity import (
    Choice,
    Diameter,
    Items,
    Key,
    Length,
    LightLoad,
    Name,
    Quantity,
    Station,
    TopSpeed,
    Whole,
)
from rotordyn.scene.conditions import Conditions

Overrides = Mapping[str, Any]
Stiff = Annotated[float, Quantity("stiffness", at_least="0.1 N/um", at_most="100000 N/um")]
MOST_STEPS = 100_000
# Descriptions of models in separate files, and the folder of the library with them.
MODELS: dict[type, str] = {
    Spindle: "spindles",
    Tool: "tools",
    BallBearing: "bearings",
    Material: "materials",
    Workpiece: "workpieces",
}
# Keys that a bearing needs of which the rest is estimated.
ESTIMATED = ("estimate", "name", "bore_diameter", "outside_diameter", "contact_angle")


@dataclass(frozen=True, slots=True)
class ModelFiles:
    """A reduced model as Matrix Market files, SI units, rows and columns by their places."""

    mass: Annotated[str, "Matrix Market file (.mtx), n × n, kg"]
    stiffness: Annotated[str, "likewise, N/m"]
    places: Annotated[
        tuple[str, ...],
        Items(),
        "place of every coordinate, `front.y` under the support or bearing front; an "
        'inner one is `""`',
    ]
    damping: Annotated[str, "Matrix Market file (.mtx), n × n, N·s/m; none by default"] = ""


@dataclass(frozen=True, slots=True)
class Range:
    """Evenly spaced values, both ends included, by ``step`` or by ``count``."""

    start: Annotated[float, Key("from"), "first value"]
    to: Annotated[float, "last value, included"]
    step: Annotated[float | None, "distance; must reach `to` exactly; either this or `count`"] = (
        None
    )
    count: Annotated[
        Annotated[int, Whole(2, MOST_STEPS)] | None, "number of values, both ends included"
    ] = None


@dataclass(frozen=True, slots=True)
class PortPair:
    """A response and what excites it."""

    response: Annotated[Port, "a point and the direction of its motion"]
    excitation: Annotated[Port, "a point and the direction of its force or moment"]


@dataclass(frozen=True, slots=True)
class PortMatrix(Description):
    """Every response to every excitation."""

    responses: Annotated[
        tuple[Port, ...], Items(), "points, each with one of x, y, z, thx, thy, thz"
    ]
    excitations: Annotated[
        tuple[Port, ...], Items(), "points, each with the direction of its force or moment"
    ]

    def _faults(self) -> Faults:
        for key in ("responses", "excitations"):
            yield from repeated(key, map(str, getattr(self, key)))


@dataclass(frozen=True, slots=True)
class Variant:
    """What one variant replaces (machine, title) or adds (overrides, conditions, references)."""

    title: Annotated[str, "title in figures and summary; by default its name"] = ""
    spindle: Annotated[Any, "another spindle"] = None
    tool: Annotated[Any, "another tool"] = None
    bearing: Annotated[Any, "another single bearing"] = None
    override: Annotated[Overrides, "added to the overrides of the case"] = field(
        default_factory=dict
    )
    conditions: Annotated[
        Conditions, "added to the conditions of the case, key by key at any depth"
    ] = field(default_factory=Conditions)
    references: Annotated[tuple[Reference, ...], "added to the references of the case"] = ()


Note = Annotated[str, "remark"]
Source = Annotated[str, "where it comes from"]
Sources = Annotated[tuple[str, ...], "where it comes from"]


@dataclass
class _Case:
    note: Note = ""
    tool: Annotated[Any, "name or path of the tool that is clamped into the nose"] = None
    tools: Annotated[
        tuple[Any, ...],
        "names or paths of several: each is a variant with this tool, the spindle solved once",
    ] = ()
    override: Annotated[
        Overrides,
        "dotted path into the machine, with or without `spindle.` (`bearing.`) before it, or one "
        "that begins with a key of the case -> new value ([how](reference/python.md#other-values))",
    ] = field(default_factory=dict)
    compare: Annotated[
        Mapping[Name, Variant],
        "name of a variant -> what it changes; the variants are solved side by side",
    ] = field(default_factory=dict)


@dataclass
class _Frf:
    matrix: Annotated[PortMatrix | None, "lists instead: every response to every excitation"] = None


@dataclass
class _Measured:
    file: Annotated[
        str,
        "file in the folder of the case: UFF with records of type 58, or a table that ends in .csv",
    ]
    record: Annotated[
        Annotated[int, Whole(1, 1_000_000)] | None,
        "record of type 58, counted from 1; needed where there are several",
    ] = None


@dataclass
class _Spindle:
    sources: Sources = ()
    bearing_override: Annotated[
        Overrides, "keys of the bearing model -> values, for every bearing"
    ] = field(default_factory=dict)


@dataclass
class _Tool:
    title: Annotated[str, "one line"] = ""
    note: Note = ""
    sources: Sources = ()


@dataclass
class _Seat:
    model_override: Annotated[Overrides, "keys of the model -> values, for this bearing"] = field(
        default_factory=dict
    )


@dataclass
class _Support:
    table: Annotated[
        str,
        "CSV file that holds these lists instead ([columns](conventions.md#tables-over-speed))",
    ] = ""


@dataclass
class _Prescribed:
    reference: Annotated[Station | None, "used only where `shift` is `computed`"] = None


@dataclass
class _Computed:
    at: Annotated[TopSpeed | None, "used only where shifts are given"] = None


@dataclass
class _Reduced:
    model: Annotated[
        str | ModelFiles,
        "path of a .npz file, or a mapping of model files, instead of a rigid body on springs "
        "([how](conventions.md#housings))",
    ]


@dataclass(frozen=True, slots=True)
class Printed:
    """What a catalogue prints of a bearing beside its size, from which missing data are estimated.

    Lists have one value for each preload class of a pair back to back.
    """

    preloads: Annotated[tuple[LightLoad, ...], "preloads of the pair"] = ()
    rigidities: Annotated[tuple[Stiff, ...], "axial, of the pair at each preload"] = ()
    unloading: Annotated[
        tuple[LightLoad, ...], "axial force that unloads one of the pair at each preload"
    ] = ()
    dynamic_rating: Annotated[LightLoad | None, "C of one bearing; axial above 45°"] = None
    static_rating: Annotated[LightLoad | None, "C0 of one bearing; axial above 45°"] = None


@dataclass
class _Bearing:
    name: Annotated[str, "designation as printed"]
    kind: Annotated[str, Choice(tuple(KINDS)), "kind of bearing, which decides the other keys"] = (
        DEFAULT
    )
    source: Source = ""
    note: Annotated[str, "remark, such as what is estimated"] = ""
    bore_diameter: Annotated[Diameter | None, "bore of the inner ring"] = None
    outside_diameter: Annotated[Diameter | None, "outside diameter of the outer ring"] = None
    width: Annotated[Length | None, "width of the rings"] = None
    preloads: Annotated[
        tuple[LightLoad, ...], "preloads of a pair by class: light, medium, heavy"
    ] = ()
    estimate: Annotated[
        Printed | None,
        "printed values by which balls and grooves that are not given are estimated, of kind "
        "`angular_contact` ([how](theory/catalogue.md))",
    ] = None


@dataclass
class _Material:
    source: Source = ""
    note: Note = ""


@dataclass
class _Workpiece:
    note: Note = ""


_EXTRA: dict[type, Any] = {
    Case: _Case,
    FrfSpec: _Frf,
    MeasuredResponse: _Measured,
    Spindle: _Spindle,
    Tool: _Tool,
    BearingSeat: _Seat,
    LinearSupport: _Support,
    PrescribedShortening: _Prescribed,
    ComputedShortening: _Computed,
    ReducedHousing: _Reduced,
    BallBearing: _Bearing,
    Material: _Material,
    Workpiece: _Workpiece,
}


def extra(kind: type) -> tuple[Field, ...]:
    """Keys of files that are not fields of this kind of description."""
    source = next((_EXTRA[base] for base in kind.__mro__ if base in _EXTRA), None)
    return () if source is None else tuple(replace(field, name="") for field in declared(source))


@dataclass(frozen=True, slots=True)
class Common:
    """A value at ``keys`` that every item at ``fills`` (``*``: of a list) takes if it has none.

    ``kind``: class of the items; ``meaning``: text for the key reference, empty where ``keys`` are
    fields anyway.
    """

    keys: tuple[str, ...]
    fills: tuple[str, ...]
    kind: type
    meaning: str = ""


_OF_BEARINGS = {
    ("growth",): "ring growth of every bearing that gives none itself",
    ("fits",): "fits of every bearing that gives none itself",
    ("flexible_rings",): "rings of every bearing that gives none itself, as elastic bodies",
    ("damping", "bearings"): "damping between the rings of bearings that give none themselves",
}
_SIZED = {
    ("growth", "fit"): (InterferenceFit, ("bore_diameter",)),
    ("fits",): (Fits, SIZES),
    ("flexible_rings",): (RingBodies, SIZES),
}
_MATERIAL = ("material",), ("sections", "*", "material"), Section
COMMON: dict[type, tuple[Common, ...]] = {
    Shaft: (Common(*_MATERIAL, "of sections that name none; name, path or mapping"),),
    Tool: (Common(*_MATERIAL, "of sections that name none"),),
    Spindle: tuple(
        Common(keys, ("bearings", "*", keys[0]), BearingSeat, meaning)
        for keys, meaning in _OF_BEARINGS.items()
    ),
    BearingSeat: tuple(
        Common(("model", size), (*way, size), kind)
        for way, (kind, sizes) in _SIZED.items()
        for size in sizes
    ),
}


@cache
def keys_of(kind: Any) -> tuple[Field, ...]:
    """All keys of a file, or of a mapping in it, that is read as this kind of description."""
    keys = declared(kind)
    common = tuple(f for each in COMMON.get(kind, ()) if each.meaning for f in _common(each))
    if issubclass(kind, BallBearing):
        return (*extra(kind), *(key for key in keys if key.keys))
    return (*keys, *extra(kind), *common)


def _common(each: Common) -> Iterator[Field]:
    tail = each.fills[each.fills.index("*") + 1 :]
    for inner in declared(each.kind):
        if inner.keys[: len(tail)] == tail:
            keys = (*each.keys, *inner.keys[len(tail) :])
            yield Field("", keys, inner.annotation, each.meaning, None)


def bearing_class(word: object) -> Any:
    """Class of bearing by the word for its kind; the default class for an unknown word."""
    return kind_class(word if isinstance(word, str) and word in KINDS else DEFAULT)


def kinds_with(key: str) -> list[str]:
    """Kinds of bearing that have this key."""
    return [kind for kind in KINDS if key in kind_class(kind).measures()]
