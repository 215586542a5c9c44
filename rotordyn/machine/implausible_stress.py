"""Fits and drawbars that stress a machine as hardly any does: a sentence each."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from rotordyn.machine.spindle import Spindle

TIGHT = 5e-4  # of the bore, radial; rings of spindles have up to some 1e-4
PULLED = 3e8  # [Pa] mean stress of a section; clamping systems of spindles stay below some 1e8


def implausible_stress(spindle: Spindle) -> Iterator[str]:
    """Yield sentences about the fits of inner rings and the drawbar of a spindle."""
    yield from _fits(spindle)
    yield from _drawbar(spindle)


def _fits(spindle: Spindle) -> Iterator[str]:
    tight: dict[tuple[float, float], list[str]] = {}
    for seat in spindle.seats:
        fit = seat.growth.fit
        if fit is not None and fit.interference > TIGHT * fit.bore_diameter:
            tight.setdefault((fit.interference, fit.bore_diameter), []).append(seat.name)
    for (interference, bore), names in tight.items():
        yield (
            f"bearing{'s' * (len(names) > 1)} {', '.join(names)}: growth.fit.interference of "
            f"{interference * 1e6:.4g} µm on the radius of a bore of {bore * 1e3:.4g} mm is far "
            "above that of fits of rings, a few µm: check its unit (it is that at rest, without "
            "the part by speed)"
        )


def _drawbar(spindle: Spindle) -> Iterator[str]:
    bar, shaft = spindle.drawbar, spindle.shaft
    if bar is None:
        return
    edges = [x for x in shaft.boundaries if bar.start < x < bar.end]
    inside = [(a + b) / 2.0 for a, b in pairwise([bar.start, *edges, bar.end])]
    diameters = [(*shaft.diameters_at(x), x) for x in inside]
    thin, x = min((math.pi / 4.0 * (outer**2 - inner**2), x) for outer, inner, x in diameters)
    if bar.force > PULLED * thin:
        yield (
            f"drawbar: its force of {bar.force * 1e-3:.4g} kN presses the section at "
            f"{x * 1e3:.4g} mm, of {thin * 1e6:.4g} mm², by {bar.force / thin * 1e-6:.0f} MPa, far "
            "above clamping systems of spindles: check the unit of the force, and the diameters"
        )
