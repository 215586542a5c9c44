"""Section forces of variants, a line each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rotordyn.analyses.section_forces.figures.diagrams import Curve, curves_figure, speeds_shown
from rotordyn.figures.panels import Shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def diagrams_figure(variants: Sequence[Shown]) -> Figure:
    """The six diagrams at the last speed with a solution."""
    last = [speeds_shown(variant.result)[-1] for variant in variants]
    curves = [
        Curve(variant.title, own.result, own.row)
        for variant, own in zip(variants, last, strict=True)
    ]
    return curves_figure(curves, variants[0].spindle)
