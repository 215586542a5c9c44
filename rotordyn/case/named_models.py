"""Where files name models that stand in files of their own, read off the annotations."""

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

Way = tuple[str, ...]  # keys, one within the other; ``*``: every item of a list
# Descriptions of such models, and the folder of the library that holds them.
MODELS: dict[type, str] = {
    Spindle: "spindles",
    Tool: "tools",
    BallBearing: "bearings",
    Material: "materials",
    Workpiece: "workpieces",
}


@cache
def ways_to(model: type, kind: Any) -> tuple[Way, ...]:
    """Paths at which a file of this kind names a model of another; those that serve several items,
    shorter ones, first."""
    ways: list[Way] = []
    for each in keys_of(kind):
        for form in members(each.annotation) if each.keys else ():
            origin = get_origin(bare(form))
            way = (*each.keys, "*") if origin is tuple else each.keys
            for held in () if origin is Mapping else descriptions(form):
                if held is model:
                    ways.append(way)
                elif held not in MODELS:
                    ways += [(*way, *rest) for rest in ways_to(model, held)]
    return tuple(sorted(ways, key=len))
