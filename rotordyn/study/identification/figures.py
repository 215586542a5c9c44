"""Figures of measured and computed curves, residuals, correlations, and models side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Indices
from rotordyn.case.identification import BRANCHES
from rotordyn.figures.legends import shortened, top_legend
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    CYCLE,
    FONT_SIZE,
    GREY,
    ORANGE,
    POINTS,
    add_axes,
    grid_boxes,
    head,
    new_figure,
)
from rotordyn.study.identification import profile_figure, response_figures
from rotordyn.study.identification.along_axis import AxialCurve
from rotordyn.study.identification.certainty import ON_A_BOUND
from rotordyn.study.identification.identification import Explained, Identification
from rotordyn.study.identification.measurement import FEW, Data
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.summary import MOST_WRITTEN

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROW, COLUMNS = 58.0, 2  # mm
NAMES = 30.0  # mm, of single values
MOST_MODELS = 16


def figures(result: Identification) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Yield the name of every figure and the function that draws it."""
    if any(_panels(result)):
        yield "measured", partial(_measured, result)
        yield "residuals", partial(_residuals, result)
    yield from response_figures.figures(result)
    if len(result.explained.problem.unknowns) > 1:
        yield "correlation", partial(_correlation, result)
    if result.profiles:
        yield "profiles", partial(profile_figure.profiles, result)
    if len(result.models) > 1:
        yield "models", partial(_models, result)


def _titled(result: Identification) -> str:
    return result.title or result.name


def _panels(result: Identification) -> tuple[list[int], list[int]]:
    """Indices of the measurements that are curves, and of those of single points."""
    every = enumerate(result.explained.problem.measurements)
    sizes = {k: len(m.data.observed) for k, m in every if not isinstance(m, Responses)}
    curves = [k for k, n in sizes.items() if n >= FEW]
    return curves, [k for k, n in sizes.items() if n < FEW]


def _grid(count: int) -> tuple[Figure, list[tuple[float, float, float, float]]]:
    """Make a figure with ``count`` panels; return it and their boxes."""
    columns = min(COLUMNS, count)
    rows = -(-count // columns)
    figure = new_figure(height=20.0 + ROW * rows)
    return figure, grid_boxes(figure, rows, columns, margins=(17.0, 5.0, 12.0, 8.0))


def _measured(result: Identification) -> Figure:
    """Draw every curve, without tare and drift, and the machine; single points as differences."""
    curves, single = _panels(result)
    figure, boxes = _grid(len(curves) + bool(single))
    drawn = []
    for place, box in zip(curves, boxes, strict=False):
        axes = add_axes(figure, box)
        _curve(axes, result.explained, place)
        drawn.append(axes)
    if single:
        left, bottom, wide, tall = boxes[len(curves)]
        box = (left + NAMES, bottom, wide - NAMES, tall)
        _singles(add_axes(figure, box), result.explained, single)
    if drawn:
        top_legend(figure, *drawn)
    return head(figure, f"{_titled(result)}: tare and drift taken off, lines the machine")


def _series(data: Data) -> Iterator[tuple[str, str, Indices, dict[str, Any]]]:
    """Yield speed and branch of every curve of a measurement, its rows, and its marker style."""
    words = list(dict.fromkeys(data.series))
    speeds = list(dict.fromkeys(word.partition(", ")[0] for word in words))
    for word in words:
        speed, _, branch = word.partition(", ")
        colour, rising = CYCLE[speeds.index(speed) % len(CYCLE)], branch == BRANCHES[1]
        face = "none" if rising else colour
        look = {"color": colour, "marker": POINTS[rising], "mew": 0.5, "markerfacecolor": face}
        yield speed, branch, np.flatnonzero(np.array(data.series) == word), look


def _curve(axes: Axes, best: Explained, place: int) -> None:
    data = best.problem.measurements[place].data
    machine = best.fit.predicted[place] * data.factor
    shown = machine + best.residuals[place] * data.factor
    along, line, series = _line(best, place)
    for speed, branch, rows, look in _series(data):
        here = np.flatnonzero(series == data.series[rows[0]])
        order = here[np.argsort(along[here])]
        label = speed or "the machine"
        axes.plot(along[order], line[order], lw=0.9, color=look["color"], label=label)
        label = f"measured, {branch}" if branch else "measured"
        axes.plot(data.at[rows], shown[rows], ls="none", ms=2.2, label=label, **look)
    _labelled(axes, data, "measured")


def _line(best: Explained, place: int) -> tuple[Array, Array, NDArray[np.str_]]:
    """Abscissa, prediction of the machine in printed units, and series of each point; at more
    points than measured for axial curves."""
    given, predicted = best.problem.measurements[place], best.fit.predicted[place]
    if isinstance(given, AxialCurve):
        given = given.finer
        predicted = given.predicted(best.problem.trial(best.fit.values))
    data = given.data
    return data.at, predicted * data.factor, np.array(data.series)


def _labelled(axes: Axes, data: Data, what: str) -> None:
    axes.set_title(shortened(data.name, 40), fontsize=FONT_SIZE)
    axes.locator_params(axis="x", nbins=5)
    axes.set_xlabel(data.along, fontsize=FONT_SIZE - 1.0)
    axes.set_ylabel(f"{what} [{data.unit}]".strip(), fontsize=FONT_SIZE - 1.0)


def _singles(axes: Axes, best: Explained, places: list[int]) -> None:
    """Draw the differences of single points over their noise as bars."""
    names, values = [], []
    for place in places:
        data, residual = best.problem.measurements[place].data, best.residuals[place]
        unit = data.along.partition("[")[2].removesuffix("]")
        for k, size in enumerate(residual / data.deviation):
            at = f" at {data.at[k]:g} {unit}" if len(residual) > 1 else ""
            names.append(shortened(f"{data.name}{at}", 30))
            values.append(size)
    axes.barh(np.arange(len(names)), values, color=BLUE, height=0.6)
    axes.set_yticks(np.arange(len(names)), names, fontsize=FONT_SIZE - 2.5)
    axes.invert_yaxis()
    for end in (-2.0, 2.0):
        axes.axvline(end, color=GREY, lw=0.6, ls="--")
    widest = max(3.0, *(abs(value) for value in values))
    axes.set_xlim(-1.1 * widest, 1.1 * widest)
    axes.axvline(0.0, color=BLACK, lw=0.6)
    axes.set_title("single values", fontsize=FONT_SIZE)
    axes.set_xlabel("(measured − machine) / noise", fontsize=FONT_SIZE - 1.0)


def _residuals(result: Identification) -> Figure:
    """Draw the residuals of every curve with a band of ± two standard deviations of the noise."""
    curves, single = _panels(result)
    places, best = curves or single, result.explained
    figure, boxes = _grid(len(places))
    drawn = []
    for place, box in zip(places, boxes, strict=False):
        axes, data = add_axes(figure, box), best.problem.measurements[place].data
        residual = best.residuals[place] * data.factor
        for speed, branch, rows, look in _series(data):
            label = ", ".join(filter(None, (speed, branch))) or data.name
            axes.plot(data.at[rows], residual[rows], lw=0.5, ms=2.2, label=label, **look)
        noise = 2.0 * float(data.deviation.mean()) * data.factor
        axes.axhspan(-noise, noise, color=GREY, alpha=0.2, lw=0.0)
        _labelled(axes, data, "measured − machine")
        drawn.append(axes)
    top_legend(figure, *drawn)
    words = f"{_titled(result)}: what is not explained, with ± 2 deviations of the noise"
    return head(figure, words)


def _correlation(result: Identification) -> Figure:
    """Draw the correlation matrix of the unknowns; blank for those on a bound."""
    best = result.explained
    names = [shortened(each.name, 28) for each in best.problem.unknowns]
    values = best.sure.correlation
    count = len(names)
    side = float(np.clip(9.0 * count, 50.0, 108.0))
    low = 6.0 + 1.2 * max(map(len, names))
    figure = new_figure(height=side + low + 14.0, title="correlation of the unknowns")
    axes = add_axes(figure, (44.0, low, side, side))
    axes.grid(visible=False)
    image = axes.imshow(values, cmap="RdBu_r", vmin=-1.0, vmax=1.0)
    axes.set_xticks(range(count), names, rotation=90, fontsize=FONT_SIZE - 1.5)
    axes.set_yticks(range(count), names, fontsize=FONT_SIZE - 1.5)
    if count <= MOST_WRITTEN:
        for k in range(count):
            for j in range(count):
                if j != k and np.isfinite(values[k, j]):
                    dark = abs(values[k, j]) > 0.6
                    axes.text(
                        j,
                        k,
                        f"{values[k, j]:.2f}".replace("0.", ".").replace("-", "−"),
                        ha="center",
                        va="center",
                        fontsize=FONT_SIZE - 2.5,
                        color="white" if dark else "black",
                    )
    bar = add_axes(figure, (48.0 + side, low, 4.0, side))
    figure.colorbar(image, cax=bar)
    return head(figure, _titled(result))


def _models(result: Identification) -> Figure:
    """Draw the mean difference of every model, and its unknowns between their bounds."""
    shown = list(result.models[:MOST_MODELS])
    story = [each for each in result.order if each in shown]
    paths = {u.path: u for model in story for u in model.problem.unknowns}
    tall = 8.0 + 7.0 * len(story)
    figure = new_figure(height=tall + 62.0, title="models side by side")
    names = [shortened(each.name, 26) for each in story]
    place = np.arange(len(story))
    axes = add_axes(figure, (38.0, 38.0, 40.0, tall))
    means = [result.criterion.mean_difference(each.problem, each.residuals) for each in story]
    kept = [each.name in result.surviving for each in story]
    axes.barh(place, means, height=0.6, color=[BLUE if k else GREY for k in kept])
    axes.set_yticks(place, names, fontsize=FONT_SIZE - 1.5)
    axes.invert_yaxis()
    if result.criterion.most is not None:
        axes.axvline(result.criterion.most, color=ORANGE, lw=0.8, ls="--")
    axes.set_xlabel(f"mean difference [{result.criterion.unit}]", fontsize=FONT_SIZE - 1.0)
    beside = add_axes(figure, (84.0, 38.0, 80.0, tall))
    for column, unknown in enumerate(paths.values()):
        for row, model in enumerate(story):
            known = {u.path: k for k, u in enumerate(model.problem.unknowns)}
            if unknown.path not in known:
                continue
            k = known[unknown.path]
            value = float(model.fit.values[k])
            share = (value - unknown.low) / (unknown.high - unknown.low)
            beside.plot([column - 0.4, column + 0.4], [row, row], "-", lw=0.6, color=GREY)
            bound = model.sure.words[k] == ON_A_BOUND
            colour = ORANGE if bound else BLUE
            beside.plot(column - 0.4 + 0.8 * share, row, "D", ms=3.5, color=colour)
            words = f"{unknown.shown(value):.3g}"
            beside.text(column, row - 0.22, words, ha="center", va="bottom", fontsize=FONT_SIZE - 3)
    beside.set_ylim(len(story) - 0.4, -0.7)
    beside.set_xlim(-0.6, len(paths) - 0.4)
    beside.set_yticks([])
    heads = [shortened(each.heading, 26) for each in paths.values()]
    beside.set_xticks(range(len(paths)), heads, rotation=90, fontsize=FONT_SIZE - 2.0)
    beside.set_title("between their ends, orange at an end", fontsize=FONT_SIZE - 1.0)
    return head(figure, _titled(result))
