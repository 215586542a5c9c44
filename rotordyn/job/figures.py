"""Which figures each analysis has, as functions that draw them when asked."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, Protocol

import numpy as np

from rotordyn.figures.draw import Job
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle


class Drawable(Protocol):
    """What the figures need to know of a case."""

    @property
    def spindle(self) -> Spindle | None: ...
    @property
    def title(self) -> str: ...
    @property
    def known(self) -> Sequence[Reference]: ...
    @property
    def analyses(self) -> Mapping[str, Any]: ...


def figures(case: Drawable, results: Mapping[str, Any]) -> list[Job]:
    """Name and drawing function of every figure that the results allow, the costly ones first.

    Nothing is drawn and matplotlib is not imported before a function is called.
    """
    jobs = [] if case.spindle is None else list(_machine(case, results))
    for name, result in results.items():
        if name in FIGURES:
            jobs += FIGURES[name](case, result, results)
    return sorted(jobs, key=lambda job: -_COST.get(job[0], 0))


def _machine(case: Drawable, _: Any) -> Iterator[Job]:
    yield "machine", partial(call, "rotordyn.figures.machine", "machine_figure", case.spindle)


def _campbell(case: Drawable, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    spec = case.analyses.get("campbell")
    teeth, highest = getattr(spec, "teeth", ()), getattr(spec, "max_frequency", 0.0)
    known = case.known
    yield (
        "campbell",
        partial(
            call,
            "rotordyn.analyses.campbell.figures.diagram",
            "campbell_figure",
            result,
            teeth,
            known,
            highest,
        ),
    )
    if result.unstable.any() and result.speed.size > 1:
        yield (
            "damping",
            partial(call, "rotordyn.analyses.campbell.figures.damping", "damping_figure", result),
        )
    if result.shape_speed.size and result.node.size:
        yield (
            "mode_shapes",
            partial(
                call,
                "rotordyn.analyses.campbell.figures.shapes",
                "shapes_figure",
                result,
                case.spindle,
            ),
        )


def _frf(_: Drawable, result: Any, results: Mapping[str, Any]) -> Iterator[Job]:
    modes, count = results.get("campbell"), len(result.pair)
    if result.speed.size > 1 and result.frequency.size > 1:
        yield (
            "frf_map",
            partial(call, "rotordyn.analyses.frf.figures.map", "map_figure", result, [0], modes),
        )
        yield (
            "frf_surface",
            partial(call, "rotordyn.analyses.frf.figures.surface", "surface_figure", result, 0),
        )
        if count > 1:
            others = list(range(1, count))
            yield (
                "frf_maps",
                partial(
                    call, "rotordyn.analyses.frf.figures.map", "map_figure", result, others, modes
                ),
            )
    if not np.any(result.is_slice):
        return
    for first in range(0, count, 2):
        pairs = list(range(first, min(first + 2, count)))
        number = f"_{first // 2 + 1}" if count > 2 else ""
        for kind in ("amplitude_phase", "real_imaginary"):
            draw = partial(
                call, "rotordyn.analyses.frf.figures.slices", f"{kind}_figure", result, pairs
            )
            yield f"frf_{kind}{number}", draw


def _stiffness(case: Drawable, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    point = getattr(case.analyses.get("stiffness"), "point", "")
    known = case.known
    yield (
        "stiffness",
        partial(
            call,
            "rotordyn.analyses.stiffness.figures.curves",
            "stiffness_figure",
            result,
            known,
            point,
        ),
    )
    yield (
        "stiffness_force",
        partial(call, "rotordyn.analyses.stiffness.figures.curves", "force_figure", result, point),
    )


def _preload(case: Drawable, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    if not result.bearing or case.spindle is None:
        return
    known = case.known
    yield (
        "preload",
        partial(
            call,
            "rotordyn.analyses.preload.figures.over_speed",
            "preload_figure",
            result,
            case.spindle,
            known,
        ),
    )
    yield (
        "contacts",
        partial(call, "rotordyn.analyses.preload.figures.over_speed", "contacts_figure", result),
    )


def _section_forces(case: Drawable, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    for name, draw in (("section_forces", "diagrams"), ("elastic_line", "elastic_line")):
        yield (
            name,
            partial(
                call,
                "rotordyn.analyses.section_forces.figures.diagrams",
                f"{draw}_figure",
                result,
                case.spindle,
            ),
        )


def _unbalance(_: Drawable, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    if result.speed[-1] > 0.0:
        yield (
            "unbalance",
            partial(
                call, "rotordyn.analyses.unbalance.figures.response", "response_figure", result
            ),
        )
        yield (
            "unbalance_forces",
            partial(call, "rotordyn.analyses.unbalance.figures.response", "forces_figure", result),
        )


def _bearing(case: Drawable, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    yield (
        "bearing",
        partial(call, "rotordyn.analyses.bearing.figures.over_load", "bearing_figure", result),
    )
    if result.ball.size > 1 or len(result.contact) > 2:
        yield (
            "bearing_contacts",
            partial(call, "rotordyn.analyses.bearing.figures.contacts", "contacts_figure", result),
        )
    if result.ball.size > 1:
        yield (
            "bearing_azimuth",
            partial(call, "rotordyn.analyses.bearing.figures.azimuth", "azimuth_figure", result),
        )
    if "complete" in result.tangent and len(result.tangent) > 1:
        known = case.known
        yield (
            "bearing_tangents",
            partial(
                call, "rotordyn.analyses.bearing.figures.tangents", "tangents_figure", result, known
            ),
        )


def _control(_: Drawable, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    yield (
        "control",
        partial(call, "rotordyn.analyses.control.figures.boundaries", "control_figure", result),
    )


def call(module: str, function: str, *arguments: Any) -> Any:
    """Import the drawing module now, and draw."""
    from importlib import import_module

    return getattr(import_module(module), function)(*arguments)


FIGURES: dict[str, Callable[[Drawable, Any, Mapping[str, Any]], Iterator[Job]]] = {
    "preload": _preload,
    "campbell": _campbell,
    "frf": _frf,
    "stiffness": _stiffness,
    "section_forces": _section_forces,
    "unbalance": _unbalance,
    "bearing": _bearing,
    "control": _control,
}
_COST = {"frf_surface": 9, "mode_shapes": 8, "frf_maps": 7, "preload": 6, "contacts": 6}
