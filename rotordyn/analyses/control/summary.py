"""Race control in a few lines of text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.control.result import ControlResult
from rotordyn.analyses.control.solve import BOUNDARY_WORDS, fit_words
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, each_speed


def summary(result: ControlResult) -> list[str]:
    """Return lines on control under heavy load, both boundaries with their fits, or why none."""
    weight = result.resting_weight
    heavy = "inner race" if weight > 1.0 else "outer race" if weight < 1.0 else "neither race"
    radial = f", radial {result.radial:g} of it" if result.radial else ""
    lines = [
        f"control    under heavy load: {heavy} (C = {weight:.3f}); boundaries, axial load{radial}"
    ]
    fits = fit_words(result)
    for place, (race, word) in enumerate(BOUNDARY_WORDS.items()):
        load, absent = result.boundary_load[place], result.boundary_absence[place]
        finite = np.flatnonzero(np.isfinite(load))
        if finite.size:
            ends = " → ".join(_at_speed(load[k], result.speed[k]) for k in finite[[0, -1]])
            lines.append(f"           {word} {ends}")
        if race in fits:
            lines.append(f"           fit: {fits[race]}")
        lines += [
            f"           {sentence}, at {count} of {len(load)} speeds"
            for sentence, count in Counter(absent[absent != ""].tolist()).items()
        ]
    several = int((result.changes > 1).any(axis=0).sum())
    if several:
        lines.append(
            f"           at {several} speeds control changes more than once; the highest is given"
        )
    return lines


def _at_speed(load: float, speed: float) -> str:
    return f"{load:.0f} N at {speed * RPM.factor:.0f} rpm"


def numbers(result: ControlResult, _: Described) -> Iterator[Number]:
    """Yield the loads at both boundaries."""
    for name, load in zip(("inner from", "outer up to"), result.boundary_load, strict=True):
        yield from each_speed(result, name, "N", load, digits=0)
