"""Usual uncertainties of a spindle or a bearing: ``uncertain: as usual``.

Each entry has its source; those that are assumptions say so (docs/howto/intervals.md).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Set
from typing import Any, NamedTuple

from bearings import BallBearing
from rotordyn.case.case import Case
from rotordyn.case.paths import places

THESIS = "D. Noël, doctoral thesis, 2013, III.1.3.3"
ASSUMED = "assumption"
# The two kinematic hypotheses whose required friction a race can transmit; moment sharing by one
# race alone, which bounds the other choices.
HYPOTHESES: Mapping[str, tuple[str, ...]] = {
    "conditions.kinematics": ("hybrid", "outer"),
    "conditions.moment_sharing": ("equal", "outer", "inner"),
}


class Usual(NamedTuple):
    """A usual tolerance of the value at ``path``, and its source."""

    path: str
    text: str
    source: str


OF_SPINDLE = (
    Usual("spindle.bearings.*.model.contact_angle", "+3/-2 deg", f"{THESIS} (the maker's)"),
    Usual("spindle.bearings.*.model.inner_conformity", "± 1 %", THESIS),
    Usual("spindle.bearings.*.model.outer_conformity", "± 1 %", THESIS),
    Usual(
        "spindle.bearings.*.fits.taken",
        "probable_least..probable_most",
        "ISO 286, ISO 492: half the root of the squared tolerances (SKF)",
    ),
    Usual(
        "spindle.bearings.*.growth.static", "± 3 um", "ISO 286, ISO 492: k5 on 70 mm of class P4"
    ),
    Usual("spindle.sleeves.*.spring.preload", "± 10 %", ASSUMED),
    Usual("spindle.sleeves.*.spring.stiffness", "± 10 %", ASSUMED),
    Usual("spindle.sleeves.*.spring.offset", "± 1 um", ASSUMED),
    Usual("spindle.sleeves.*.stop_travel", "± 5 um", ASSUMED),
    Usual("spindle.sleeves.*.friction", "± 30 %", ASSUMED),
    Usual("spindle.arrangement.preload.force", "± 10 %", ASSUMED),
    Usual("spindle.arrangement.preload.constant_force", "± 5 %", ASSUMED),
    Usual("spindle.arrangement.preload.class_force", "± 15 %", ASSUMED),
    Usual("spindle.arrangement.preload.offset", "± 1 um", ASSUMED),
    Usual("spindle.arrangement.preload.stiffness", "± 10 %", ASSUMED),
    Usual("spindle.bearings.*.damping.radial", "factor 2", ASSUMED),
    Usual("spindle.bearings.*.damping.axial", "factor 2", ASSUMED),
    Usual("spindle.damping.rotor", "factor 2", ASSUMED),
    Usual("conditions.friction", "± 30 %", ASSUMED),
    Usual("conditions.temperatures.shaft", "± 3 K", ASSUMED),
    Usual("conditions.temperatures.housing", "± 3 K", ASSUMED),
    Usual("conditions.temperatures.inner_rings", "± 3 K", ASSUMED),
    Usual("conditions.temperatures.outer_rings", "± 3 K", ASSUMED),
)
OF_BEARING = (
    Usual("bearing.contact_angle", "+3/-2 deg", f"{THESIS} (the maker's)"),
    Usual("bearing.inner_conformity", "± 1 %", THESIS),
    Usual("bearing.outer_conformity", "± 1 %", THESIS),
    Usual("conditions.friction", "± 30 %", ASSUMED),
)
APART = ".sleeves.*"  # items that vary independently: each has a tolerance of its own


def usual_of(case: Case) -> Iterator[Usual]:
    """Yield the entries that apply to ``case``; items of one maker vary together."""
    listed = OF_BEARING if case.bearing is not None else OF_SPINDLE
    for entry in listed:
        values = [(path, value) for path, value, _ in places(case, entry.path) if _uncertain(value)]
        values = [(path, value) for path, value in values if path not in ground_plays(case, [path])]
        if case.spindle is not None and case.spindle.arrangement is not None:
            made = f"spindle.sleeves.{case.spindle.arrangement.name}."
            values = [(path, value) for path, value in values if not path.startswith(made)]
        if not values:
            continue
        together = len(values) == len(places(case, entry.path)) and APART not in entry.path
        for path in [entry.path] if together else [path for path, _ in values]:
            yield entry._replace(path=path)


def ground_plays(case: Case, paths: Iterable[str], kept: Set[str] = frozenset()) -> dict[str, Any]:
    """Changes by path that keep the plays to which rings are ground, whatever their groove radii,
    of bearings with values at ``paths`` that are given by a free contact angle, unless the angle is
    among ``kept``; the angle follows."""
    changes: dict[str, Any] = {}
    for model in dict.fromkeys(path.rpartition(".")[0] for path in paths):
        for at, bearing, _ in places(case, model) if model else ():
            ground = bearing.ground if isinstance(bearing, BallBearing) else {}
            play = {f"{at}.{name}": value for name, value in ground.items()}
            changes |= play if kept.isdisjoint(play) else {}
    return changes


def _uncertain(value: Any) -> bool:
    """Whether a value can have a tolerance: a nonzero number, a list of these, a word."""
    if isinstance(value, tuple):
        return bool(value) and all(map(_uncertain, value))
    if isinstance(value, float | int) and not isinstance(value, bool):
        return math.isfinite(value) and value != 0.0
    return isinstance(value, str)
