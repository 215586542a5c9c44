"""Bearings and their materials."""

from __future__ import annotations

from typing import Any

from bearings.bearing import BallBearing
from bearings.kinds import kind_class
from bearings.materials import Material
from rotordyn.case.schema.bearing import BearingEntry
from rotordyn.case.schema.material import MaterialEntry


def material(entry: MaterialEntry | None) -> Material:
    """The material of an entry that is known to have one."""
    if entry is None:
        raise ValueError("a material was not read")
    return Material(entry.name, entry.young_modulus, entry.poisson_ratio, entry.density)


def bearing(entry: BearingEntry) -> BallBearing:
    """The bearing; raises InvalidBearing where its geometry is impossible."""
    model = kind_class(entry.kind)
    return model(**{name: _value(getattr(entry, name)) for name in model.measures()})


def _value(value: Any) -> Any:
    return material(value) if isinstance(value, MaterialEntry) else value
