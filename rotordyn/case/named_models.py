"""Paths at which files name models in separate files, derived from the annotations."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any, get_origin

from bearings.bearing import BallBearing
from bearings.materials import Material
from rotordyn.analyses.stability_lobes.workpiece import Workpiece
from rotordyn.case.keys import keys_of
from rotordyn.field import bare, descriptions, members
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

Way = tuple[str, ...]  # nested keys; ``*``: every item of a list
# Descriptions of models in separate files, and the folder of the library with them.
MODELS: dict[type, str] = {
    Spindle: "spindles",
    Tool: "tools",
    BallBearing: "bearings",
    Material: "materials",
    Workpiece: "workpieces",
}


@cache
def ways_to(model: type, kind: Any) -> tuple[Way, ...]:
    """Paths at which a file of this ``kind`` names a ``model``; shorter ones, which may apply to
    several items, first."""
    ways: list[Way] = []
    for each in keys_of(kind):
        for form in members(each.annotation) if each.keys else ():
            origin = get_origin(bare(form))
            way = (*each.keys, "*") if origin is tuple else each.keys
            for inner in () if origin is Mapping else descriptions(form):
                if inner is model:
                    ways.append(way)
                elif inner not in MODELS:
                    ways += [(*way, *rest) for rest in ways_to(model, inner)]
    return tuple(sorted(ways, key=len))
