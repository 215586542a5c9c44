"""Radial stiffness of variants over speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.figures.curves import draw_references
from rotordyn.figures.legends import top_legend
from rotordyn.figures.panels import Shown, colour, dash
from rotordyn.figures.style import BLACK, add_axes, new_figure, speed_ticks
from rotordyn.machine.reference import Reference
from rotordyn.results.display import RPM, STIFFNESS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def stiffness_figure(variants: Sequence[Shown], point: str = "") -> Figure:
    """Tangent at no load: a colour per variant, dashes by bearing model; known values as marks."""
    figure = new_figure(168.0, 100.0)
    where = f" at {point}" if point else ""
    axes = add_axes(
        figure, (15.0, 11.0, 147.0, 84.0), "speed [rpm]", f"radial stiffness{where} [N/µm]"
    )
    models = variants[0].result.variant
    top = float(variants[0].result.speed[-1] * RPM.factor)
    shared = [r for r in variants[0].known if all(r in v.known for v in variants)]
    for place, variant in enumerate(variants):
        rpm = variant.result.speed * RPM.factor
        for column in range(len(models)):
            axes.plot(
                rpm,
                variant.result.tangent[:, column] * STIFFNESS.factor,
                color=colour(place),
                ls=dash(column if len(models) > 1 else place),
                label=variant.title,
            )
        own = [r for r in variant.known if r not in shared and _drawn(r, models)]
        colours = dict.fromkeys((r.subject for r in own), colour(place))
        draw_references(axes, own, "radial_stiffness", top, subject=True, colours=colours)
    known = [r for r in shared if _drawn(r, models)]
    draw_references(axes, known, "radial_stiffness", top, subject=True)
    if len(models) > 1:
        for column, name in enumerate(models):
            axes.plot([], [], color=BLACK, ls=dash(column), label=name.replace("_", " "))
    speed_ticks(axes, top)
    axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)
    top_legend(figure, axes)
    return figure


def _drawn(reference: Reference, models: Sequence[str]) -> bool:
    """Whether it belongs to no bearing model, or to one that is drawn."""
    return not reference.subject or reference.subject in models
