"""A case as the same machine in other units, or seen from another side."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import is_dataclass, replace
from functools import cache
from typing import Any

from bearings.materials import Material
from rotordyn.analyses import PointLoad
from rotordyn.case.case import Case
from rotordyn.description import quantity_of
from rotordyn.field import declared, found_in
from rotordyn.machine.matrix import Matrix
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.quantity import Quantity
from rotordyn.units import KINDS, parse_unit
from tests.oracles.idealised import times

Scale = tuple[float, float, float]  # of lengths, times and masses
TURNED = {"x": ("x", 1), "y": ("z", 1), "z": ("y", -1)}  # where a direction goes, and its sign
MIRRORED = {"x": ("x", -1), "y": ("y", 1), "z": ("z", 1)}
TURNED |= {f"th{way}": (f"th{to}", sign) for way, (to, sign) in TURNED.items()}
MIRRORED |= {f"th{way}": (f"th{to}", -sign) for way, (to, sign) in MIRRORED.items()}
Change = Mapping[str, tuple[str, int]]


def factor(unit: str, scale: Scale) -> float:
    """By which a value in ``unit`` grows."""
    return math.prod(s**p for s, p in zip(scale, dimension(unit), strict=True))


@cache
def dimension(unit: str) -> tuple[int, int, int]:
    """Powers of length, time and mass."""
    metre, kilogram, second, *_ = parse_unit("N m" if unit == "J" else unit).dimension
    return metre, second, kilogram


def scaled(value: Any, scale: Scale, annotation: Any = None) -> Any:
    """A description, or the value of one of its fields, of the machine in other units."""
    if isinstance(value, Material):
        pressure, density = (factor(unit, scale) for unit in ("Pa", "kg/m^3"))
        return times(value, young_modulus=pressure, density=density)
    if is_dataclass(value) and not isinstance(value, type):
        fields = [f for f in declared(type(value)) if f.name not in ("references", "sizes")]
        return replace(
            value, **{f.name: scaled(getattr(value, f.name), scale, f.annotation) for f in fields}
        )
    return _field(value, scale, annotation)


def _field(value: Any, scale: Scale, annotation: Any) -> Any:
    if isinstance(value, Mapping):
        entries = found_in(annotation, Matrix)
        return {
            key: scaled(each, scale, entries.quantity(*key) if entries else annotation)
            for key, each in value.items()
        }
    if isinstance(value, tuple):
        return tuple(scaled(each, scale, annotation) for each in value)
    if not isinstance(value, float) or math.isinf(value):
        return value
    quantity = annotation if isinstance(annotation, Quantity) else quantity_of(annotation)
    return value if quantity is None else value * factor(KINDS[quantity.kind][0], scale)


def moved(case: Case, change: Change) -> Case:
    """The machine with its questions, a quarter turn from y to z on, or its front for its rear."""
    rear, angle = change is MIRRORED, 0.0 if change is MIRRORED else math.pi / 2.0

    def entries(given: Mapping[tuple[str, str], Any]) -> dict[tuple[str, str], Any]:
        signed = {pair: [change[dof] for dof in pair] for pair in given}
        return {
            (row[0], column[0]): row[1] * column[1] * given[pair]
            for pair, (row, column) in signed.items()
        }

    def components(given: Any, names: Mapping[str, str]) -> Any:
        pushed = {names[change[d][0]]: change[d][1] * getattr(given, n) for d, n in names.items()}
        return replace(given, **pushed)

    def load(given: PointLoad) -> PointLoad:
        forces = {"x": "Fx", "y": "Fy", "z": "Fz", "thx": "Mx", "thy": "My", "thz": "Mz"}
        return components(components(given, forces), {"y": "y", "z": "z"})

    def weight(given: str) -> str:
        way, sign = change.get(given[1:], ("", 1))
        return f"{'+' if (given[0] == '+') == (sign > 0) else '-'}{way}" if way else given

    spindle, conditions, asked = case.spindle, case.conditions, dict(case.analyses)
    assert spindle is not None
    x = -1.0 if rear else 1.0
    shaft = Shaft(-spindle.shaft.end, tuple(map(turned_round, spindle.shaft.sections[::-1])))
    tilts = {name: name for name in ("y", "z", "thy", "thz")}
    seats = [
        replace(
            seat,
            x=x * seat.x,
            thrust=int(x) * seat.thrust,
            misalignment=components(seat.misalignment, tilts),
        )
        for seat in spindle.seats
    ]
    supports = [
        replace(s, x=x * s.x, stiffness=entries(s.stiffness), damping=entries(s.damping))
        for s in spindle.supports
    ]
    frf, unbalance, lobes = (asked[n] for n in ("frf", "unbalance", "stability_lobes"))
    asked["frf"] = replace(
        frf,
        pairs=tuple(
            tuple(replace(port, direction=change[port.direction][0]) for port in pair)
            for pair in frf.pairs
        ),
    )
    asked["unbalance"] = replace(
        unbalance, unbalances=tuple(replace(u, angle=u.angle + angle) for u in unbalance.unbalances)
    )
    asked["stability_lobes"] = replace(lobes, feed=lobes.feed + angle)
    if "section_forces" in asked:
        forces = asked["section_forces"]
        asked["section_forces"] = replace(
            forces, loads=tuple(map(load, forces.loads)), gravity=weight(forces.gravity)
        )
    if rear and "axial_cycle" in asked:
        cycle = asked["axial_cycle"]
        asked["axial_cycle"] = replace(cycle, lowest=-cycle.highest, highest=-cycle.lowest)
    return replace(
        case,
        spindle=replace(
            spindle,
            shaft=shaft if rear else spindle.shaft,
            seats=tuple(seats),
            supports=tuple(supports),
            points={name: x * at for name, at in spindle.points.items()},
        ),
        conditions=replace(
            conditions,
            loads=tuple(map(load, conditions.loads)),
            gravity=weight(conditions.gravity),
        ),
        analyses=asked,
    )


def turned_round(section: Section) -> Section:
    """A cylinder, or a cone of a plain bore, with its rear end in front."""
    rear = section.rear_outer_diameter
    if rear is None:
        return section
    return replace(section, outer_diameter=rear, rear_outer_diameter=section.outer_diameter)
