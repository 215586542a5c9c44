"""Which figures of variants a case gets, and how each is drawn, on demand."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from rotordyn.figures.draw import Job
from rotordyn.figures.panels import MOST_PANELS, Shown
from rotordyn.job.figures import Drawable, call
from rotordyn.machine.reference import Reference
from rotordyn.results.frames import turning

Variant = tuple[Drawable, Mapping[str, Any]]


def comparison_figures(variants: Sequence[Variant]) -> list[Job]:
    """Name and drawing function of every figure that the results of the variants allow."""
    jobs: list[Job] = []
    for name, draw in FIGURES.items():
        shown = [
            Shown(case.title, found[name], _known(case, found[name]), case.spindle)
            for case, found in variants
            if name in found
        ]
        if shown:
            jobs += draw(variants[0][0].analyses.get(name), shown)
    return jobs


def _known(case: Drawable, result: Any) -> Sequence[Reference]:
    """What may be drawn over a result: known frequencies belong to the fixed frame."""
    return () if turning(result) else case.known


def _campbell(spec: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    teeth, highest = getattr(spec, "teeth", ()), getattr(spec, "max_frequency", 0.0)
    if len(shown) <= MOST_PANELS:
        yield (
            "campbell",
            partial(
                call,
                "rotordyn.analyses.campbell.figures.compared",
                "panels_figure",
                shown,
                teeth,
                highest,
            ),
        )
    yield (
        "campbell_overlay",
        partial(
            call,
            "rotordyn.analyses.campbell.figures.compared",
            "overlay_figure",
            shown,
            teeth,
            highest,
        ),
    )
    growing = any(variant.result.unstable.any() for variant in shown)
    if growing and len(shown) <= MOST_PANELS and shown[0].result.speed.size > 1:
        yield (
            "damping",
            partial(
                call, "rotordyn.analyses.campbell.figures.compared_damping", "damping_figure", shown
            ),
        )


def _frf(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    first = shown[0].result
    few, swept = len(shown) <= MOST_PANELS, first.speed.size > 1 and first.frequency.size > 1
    if few and swept:
        yield (
            "frf_surfaces",
            partial(call, "rotordyn.analyses.frf.figures.compared", "surfaces_figure", shown, 0),
        )
        yield (
            "frf_maps",
            partial(call, "rotordyn.analyses.frf.figures.compared", "maps_figure", shown, 0),
        )
    if np.any(first.is_slice):
        for pair in range(len(first.pair)):
            number = f"_{pair + 1}" if len(first.pair) > 1 else ""
            yield (
                f"frf_curves{number}",
                partial(
                    call, "rotordyn.analyses.frf.figures.compared", "curves_figure", shown, pair
                ),
            )


def _stiffness(spec: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    point = getattr(spec, "point", "")
    yield (
        "stiffness",
        partial(
            call, "rotordyn.analyses.stiffness.figures.compared", "stiffness_figure", shown, point
        ),
    )


def _preload(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    if shown[0].result.bearing:
        yield (
            "preload",
            partial(call, "rotordyn.analyses.preload.figures.compared", "preload_figure", shown),
        )


def _section_forces(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    yield (
        "section_forces",
        partial(
            call, "rotordyn.analyses.section_forces.figures.compared", "diagrams_figure", shown
        ),
    )


def _unbalance(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    if shown[0].result.speed[-1] > 0.0:
        yield (
            "unbalance",
            partial(
                call, "rotordyn.analyses.unbalance.figures.compared", "amplitudes_figure", shown
            ),
        )


def _bearing(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    yield (
        "bearing",
        partial(call, "rotordyn.analyses.bearing.figures.compared", "bearing_figure", shown),
    )


def _control(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    yield (
        "control",
        partial(call, "rotordyn.analyses.control.figures.compared", "control_figure", shown),
    )


FIGURES: dict[str, Callable[[Any, Sequence[Shown]], Iterator[Job]]] = {
    "frf": _frf,
    "campbell": _campbell,
    "preload": _preload,
    "stiffness": _stiffness,
    "section_forces": _section_forces,
    "unbalance": _unbalance,
    "bearing": _bearing,
    "control": _control,
}
