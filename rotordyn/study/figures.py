"""Headline numbers over what was varied; of three parameters or more, parallel coordinates too."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.figures.legends import shortened
from rotordyn.figures.style import (
    BLUE,
    CYCLE,
    DASHES,
    FONT_SIZE,
    GREY,
    POINTS,
    add_axes,
    grid_boxes,
    head,
    new_figure,
)
from rotordyn.results.kinds import Array
from rotordyn.study.parameter import Parameter
from rotordyn.study.point import Outcome, Study
from rotordyn.study.summary import names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANELS, COLUMNS = 9, 3
ROW = 48.0  # mm
ROOM = (0.05, 0.1)  # share of an axis beside its points
FEW = 7  # values of the second parameter that have a colour and a word in the legend each
ALONG = 5  # numbers beside the parameters of parallel coordinates


class Shown(NamedTuple):
    """A number as drawn: its words, unit, and value at every point, NaN where there is none."""

    words: str
    unit: str
    values: Array

    @property
    def heading(self) -> str:
        """Words and unit."""
        return f"{self.words} [{self.unit}]" if self.unit else self.words


def figures(
    study: Study, outcomes: Mapping[int, Outcome]
) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Name and drawing of every figure."""
    by_analysis: dict[str, list[Shown]] = {}
    for name, unit in names(outcomes).items():
        of, _, words = name.partition(": ")
        rows = (outcomes.get(k) for k in range(study.design.count))
        column = [row.numbers.get(name, (math.nan,))[0] if row else math.nan for row in rows]
        values = np.where(np.isfinite(column), column, np.nan)
        if np.isfinite(values).any() and np.nanmax(values) > np.nanmin(values):
            by_analysis.setdefault(of, []).append(Shown(words, unit, values))
    for of, found in by_analysis.items():
        yield f"study_{of}", partial(_over, study, of, found)
    if len(study.design.parameters) > 2 and by_analysis:
        chosen = [each for found in by_analysis.values() for each in found[:2]][:ALONG]
        yield "study_across", partial(_parallel_coordinates, study, chosen)


def _over(study: Study, name: str, found: list[Shown]) -> Figure:
    """Panels of the numbers of an analysis that vary most over the points."""
    spread = sorted(
        found,
        key=lambda s: -float(np.ptp(s.values[np.isfinite(s.values)]) / np.nanmax(np.abs(s.values))),
    )
    shown = [each for each in found if each in spread[:PANELS]]
    columns = min(COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    first, *others = study.design.parameters
    grid = study.design.sampling == "grid"
    legend = grid and bool(others) and len(others[0].values) <= FEW
    high = (26.0 if legend else 18.0) + ROW * rows
    figure = new_figure(height=high, title=analysis(name).heading)
    margins = (12.0, 5.0, 12.0, 20.0 if legend else 12.0)
    boxes = grid_boxes(figure, rows, columns, margins=margins, gaps=(14.0, 12.0 if grid else 16.0))
    for each, box in zip(shown, boxes, strict=False):
        axes = add_axes(figure, box)
        axes.set_title(shortened(each.heading, 40), fontsize=FONT_SIZE - 1.5, loc="left", pad=3.0)
        (_panel if grid else _scattered)(axes, study, each)
    if legend:
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(
            handles,
            labels,
            title=shortened(others[0].heading, 90),
            loc="upper center",
            bbox_to_anchor=(0.5, 1.0 - 7.0 / high),
            ncols=len(labels),
            frameon=False,
            fontsize=FONT_SIZE - 1.0,
            title_fontsize=FONT_SIZE - 1.0,
        )
    if grid:
        figure.text(0.5, 0.012, first.heading, ha="center", va="bottom", fontsize=FONT_SIZE)
    return head(figure, study.case.title or study.case.name)


def _scattered(axes: Axes, study: Study, each: Shown) -> None:
    """A number over the parameter that ranks it most."""
    from scipy.stats import rankdata

    design = study.design
    labels = [design.labels(k) for k in range(design.count)]
    known = np.isfinite(each.values)

    def ranked(of: Parameter) -> float:
        x = abscissa(of, [own[of.path] for own in labels])[known]
        if np.ptp(x) == 0.0:
            return 0.0
        return abs(float(np.corrcoef(rankdata(x), rankdata(each.values[known]))[0, 1]))

    of = max(design.parameters, key=ranked) if known.sum() > 2 else design.parameters[0]
    axes.plot(abscissa(of, [own[of.path] for own in labels]), each.values, "o", ms=2.5, color=BLUE)
    axes.set_xlabel(end_of(of.heading, 38), fontsize=FONT_SIZE - 1.5)
    word_ticks(axes, of)
    axes.margins(*ROOM)


def end_of(path: str, longest: int) -> str:
    """The last letters of a path, which tell most."""
    return path if len(path) <= longest else "…" + path[1 - longest :]


def word_ticks(axes: Axes, of: Parameter) -> None:
    """Name the ticks of a parameter without numbers."""
    if not of.numeric:
        words = dict.fromkeys(of.labels)
        axes.set_xticks(range(len(words)), [shortened(str(w), 14) for w in words])


def _panel(axes: Axes, study: Study, each: Shown) -> None:
    """A number of a grid over the first parameter: a colour for each value of the second, a line
    for each combination of the others."""
    design = study.design
    first, *others = design.parameters
    x = abscissa(first, [design.labels(k)[first.path] for k in range(design.count)])
    grid = each.values.reshape(*design.shape[:2], -1) if others else each.values[:, None, None]
    along = x.reshape(*design.shape[:2], -1)[:, 0, 0] if others else x
    count = grid.shape[1]
    for k in range(count):
        colour = CYCLE[k % len(CYCLE)] if count <= FEW else BLUE
        label = _word(others[0], k) if others and count <= FEW else ""
        for j in range(grid.shape[2]):
            axes.plot(
                along,
                grid[:, k, j],
                marker=POINTS[k % len(POINTS)],
                ms=3.0,
                lw=1.0,
                ls=DASHES[k % len(DASHES)] if first.numeric else "none",
                color=colour,
                label=label if j == 0 else "",
            )
    word_ticks(axes, first)
    axes.margins(*ROOM)


def _word(of: Parameter, place: int) -> str:
    value = of.displayed(of.labels[place])
    return f"{value:g}" if isinstance(value, float) else shortened(str(value), 24)


def abscissa(of: Parameter, labels: Sequence[Any]) -> Array:
    """Coordinates (points,) of a parameter in its usual unit; places of words among all."""
    if of.numeric:
        return np.array([of.displayed(label) for label in labels])
    kinds = [*dict.fromkeys(of.labels)]
    return np.array([float(kinds.index(label)) for label in labels])


def _parallel_coordinates(study: Study, shown: list[Shown]) -> Figure:
    """Every point as a line over parameters and numbers, its colour by the last number."""
    design = study.design
    labels = [design.labels(k) for k in range(design.count)]
    axes_of = [(p.heading, abscissa(p, [own[p.path] for own in labels])) for p in design.parameters]
    words = {
        k: [*dict.fromkeys(p.labels)] for k, p in enumerate(design.parameters) if not p.numeric
    }
    axes_of += [(each.heading, each.values) for each in shown]
    figure = new_figure(height=100.0, title="points across what was varied and what came of it")
    axes = add_axes(figure, (32.0, 34.0, 126.0, 52.0))
    from matplotlib import colormaps

    rule = axes_of[-1][1]
    shares = np.column_stack([_share(values) for _, values in axes_of])
    for row, share in zip(shares, _share(rule), strict=True):
        known = np.isfinite(share)
        colour = colormaps["viridis"](share) if known else GREY
        axes.plot(range(len(axes_of)), row, lw=0.7, alpha=0.7, color=colour)
    axes.set_xticks(
        range(len(axes_of)),
        [end_of(heading, 30) for heading, _ in axes_of],
        rotation=20,
        ha="right",
    )
    axes.set_yticks([])
    axes.set_ylim(-0.06, 1.06)
    for k, (_, values) in enumerate(axes_of):
        known = values[np.isfinite(values)]
        for y, end, side in ((-0.05, known.min(), "top"), (1.05, known.max(), "bottom")):
            text = str(words[k][int(end)]) if k in words else f"{end:.4g}"
            axes.text(k, y, text, ha="center", va=side, fontsize=FONT_SIZE - 1.5)
        axes.axvline(k, color=GREY, lw=0.6)
    return head(figure, study.case.title or study.case.name)


def _share(values: Array) -> Array:
    """Values as shares of the way from the lowest (0) to the highest (1)."""
    known = values[np.isfinite(values)]
    low, span = known.min(), np.ptp(known)
    return (values - low) / span if span else np.full_like(values, 0.5)
