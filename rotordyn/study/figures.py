"""Headline numbers over the parameters of a study; parallel coordinates of three or more."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import takewhile
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.analyses.registry import analysis
from rotordyn.arrays import Array
from rotordyn.figures.labels import broken
from rotordyn.figures.legends import shortened
from rotordyn.figures.style import (
    BLACK,
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
from rotordyn.study.parameter import Parameter
from rotordyn.study.point import Outcome, Study
from rotordyn.study.summary import lacking, names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANELS, COLUMNS = 9, 3
ROW = 48.0  # mm
ROOM = (0.05, 0.1)  # margins of x and y, over the range of the points
NOTE: dict[str, Any] = {"ha": "right", "color": GREY, "fontsize": FONT_SIZE - 1.5}  # in a panel
FEW = 7  # values of the second parameter, or combinations of the others, listed in the legend
LEGEND = 9.0  # mm, height of two lines
LETTER, SHORTEST, WIDEST = 1.25, 11, 22  # mm of a character; characters of a horizontal label
ALIKE = 1e-6  # relative difference up to which two numbers share a panel
ALONG = 5  # results after the parameters in parallel coordinates


class Shown(NamedTuple):
    """A headline number as drawn: name, unit, value at every point (NaN where there is none), and a
    note ``lacking`` on how many points have none."""

    words: str
    unit: str
    values: Array
    lacking: str = ""

    @property
    def heading(self) -> str:
        """Name with unit."""
        return f"{self.words} [{self.unit}]" if self.unit else self.words


def figures(
    study: Study, outcomes: Mapping[int, Outcome]
) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Yield the name of every figure and the function that draws it."""
    by_analysis: dict[str, list[Shown]] = {}
    for name, unit in names(outcomes).items():
        analysis_name, _, words = name.partition(": ")
        rows = (outcomes.get(k) for k in range(study.design.count))
        column = [row.numbers.get(name, (math.nan,))[0] if row else math.nan for row in rows]
        values = np.where(np.isfinite(column), column, np.nan)
        if np.isfinite(values).any() and np.nanmax(values) > np.nanmin(values):
            by_analysis.setdefault(analysis_name, []).append(
                Shown(words, unit, values, lacking(name, outcomes))
            )
    by_analysis = {analysis_name: _once(shown) for analysis_name, shown in by_analysis.items()}
    for analysis_name, shown in by_analysis.items():
        yield f"study_{analysis_name}", partial(_over, study, analysis_name, shown)
    if len(study.design.parameters) > 2 and by_analysis:
        chosen = [
            each._replace(words=f"{analysis_name}: {each.words}")
            for analysis_name, shown in by_analysis.items()
            for each in shown[:2]
        ][:ALONG]
        yield "study_across", partial(_parallel_coordinates, study, chosen)


def _once(found: Sequence[Shown]) -> list[Shown]:
    """Merge numbers that agree at every point, such as both whirl directions of a mode at rest."""
    groups: list[list[Shown]] = []
    for number in found:
        for group in groups:
            first = group[0]
            if first.unit == number.unit and np.allclose(
                first.values, number.values, rtol=ALIKE, atol=0.0, equal_nan=True
            ):
                group.append(number)
                break
        else:
            groups.append([number])
    return [
        group[0]._replace(words=_joined([number.words for number in group])) for group in groups
    ]


def _joined(names: Sequence[str]) -> str:
    """Join names into one: common words at both ends appear once, the rest is listed.

    >>> _joined(["bending 2 backward at 0 rpm", "bending 2 forward at 0 rpm"])
    'bending 2 backward, forward at 0 rpm'
    """
    rows = [name.split() for name in names]
    head = _shared(rows)
    rest = [row[len(head) :] for row in rows]
    tail = _shared([row[::-1] for row in rest])[::-1]
    middles = [" ".join(row[: len(row) - len(tail)]) for row in rest]
    listed = ", ".join(dict.fromkeys(filter(None, middles)))
    return " ".join(filter(None, [*head, listed, *tail]))


def _shared(rows: Sequence[Sequence[str]]) -> list[str]:
    """Longest common beginning of rows of words."""
    common = takewhile(lambda words: len({*words}) == 1, zip(*rows, strict=False))
    return [first for first, *_ in common]


def _over(study: Study, name: str, numbers: list[Shown]) -> Figure:
    """Draw a panel for each number of an analysis, those that vary most if there are too many."""
    spread = sorted(
        numbers,
        key=lambda s: -float(np.ptp(s.values[np.isfinite(s.values)]) / np.nanmax(np.abs(s.values))),
    )
    shown = [each for each in numbers if each in spread[:PANELS]]
    columns = min(COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    grid = study.design.sampling == "grid"
    legends = _legends(study, shown) if grid else []
    top = 11.0 + LEGEND * len(legends)
    height = top + 6.0 + ROW * rows
    title = analysis(name).heading
    if len(shown) < len(numbers):
        title += f": the {len(shown)} of {len(numbers)} numbers that vary most"
    figure = new_figure(height=height, title=title)
    margins = (12.0, 5.0, 12.0, top)
    boxes = grid_boxes(figure, rows, columns, margins=margins, gaps=(14.0, 12.0 if grid else 16.0))
    for each, box in zip(shown, boxes, strict=False):
        axes = add_axes(figure, box)
        axes.set_title(shortened(each.heading, 42), fontsize=FONT_SIZE - 1.5, loc="left", pad=3.0)
        axes.annotate(each.lacking, (0.97, 0.04), xycoords="axes fraction", **NOTE)
        (_panel if grid else _scattered)(axes, study, each)
    if grid:  # also where some points lack a number
        lefts, rights = zip(*(axes.get_xlim() for axes in figure.axes), strict=True)
        for axes in figure.axes:
            axes.set_xlim(min(lefts), max(rights))
    for k, (title, handles) in enumerate(legends):
        figure.legend(
            handles=handles,
            title=shortened(title, 110),
            loc="upper center",
            bbox_to_anchor=(0.5, 1.0 - (6.0 + LEGEND * k) / height),
            ncols=max(len(handles), 1),
            frameon=False,
            fontsize=FONT_SIZE - 1.0,
            title_fontsize=FONT_SIZE - 1.0,
        )
    if grid:
        first = study.design.parameters[0]
        figure.text(0.5, 0.012, first.heading, ha="center", va="bottom", fontsize=FONT_SIZE)
    return head(figure, study.case.title or study.case.name)


def _legends(study: Study, shown: Sequence[Shown]) -> list[tuple[str, list[Any]]]:
    """Headings and handles of two legends: colours (second parameter), dashes (the others)."""
    from matplotlib.lines import Line2D

    legends: list[tuple[str, list[Any]]] = []
    _, *others = study.design.parameters
    if others and (count := len(others[0].values)) <= FEW:
        words = [_word(others[0], k) for k in range(count)]
        solid = {"ls": "-", "marker": ""} if others[1:] else {}
        styles = [{**_look(k, k), **solid} for k in range(count)]
        handles = [Line2D([], [], label=w, **style) for w, style in zip(words, styles, strict=True)]
        legends.append((others[0].heading, handles))
    if further := others[1:]:
        shape = [len(each.values) for each in further]
        heading = ", ".join(each.heading for each in further)
        if math.prod(shape) > FEW:
            return [*legends, (f"a line for each value of {heading}", [])]
        grids = [each.values.reshape(*study.design.shape[:2], -1) for each in shown]
        handles = []
        for j, places in enumerate(np.ndindex(*shape)):
            if any(np.isfinite(grid[:, :, j]).any() for grid in grids):
                label = ", ".join(_word(p, k) for p, k in zip(further, places, strict=True))
                style = {**_look(0, j), "color": BLACK}
                handles.append(Line2D([], [], label=label, **style))
        legends.append((heading, handles))
    return legends


def _look(colour: int, sign: int) -> dict[str, Any]:
    """Line style with the given colour number; ``sign`` numbers dashes and markers."""
    return {
        "color": CYCLE[colour % len(CYCLE)],
        "ls": DASHES[sign % len(DASHES)],
        "marker": POINTS[sign % len(POINTS)],
        "ms": 3.0,
        "lw": 1.0,
    }


def _scattered(axes: Axes, study: Study, number: Shown) -> None:
    """Scatter a number over the parameter with which it has the largest rank correlation."""
    from scipy.stats import rankdata

    design = study.design
    labels = [design.labels(k) for k in range(design.count)]
    finite = np.isfinite(number.values)

    def ranked(of: Parameter) -> float:
        x = abscissa(of, [row[of.path] for row in labels])[finite]
        if np.ptp(x) == 0.0:
            return 0.0
        return abs(float(np.corrcoef(rankdata(x), rankdata(number.values[finite]))[0, 1]))

    of = max(design.parameters, key=ranked) if finite.sum() > 2 else design.parameters[0]
    axes.plot(
        abscissa(of, [row[of.path] for row in labels]), number.values, "o", ms=2.5, color=BLUE
    )
    axes.set_xlabel(broken(of.heading, 32), fontsize=FONT_SIZE - 1.5)
    word_ticks(axes, of)
    axes.margins(*ROOM)


def word_ticks(axes: Axes, of: Parameter) -> None:
    """Label the ticks of a parameter of words by these; put those of an integer at integers."""
    if of.numeric and len(of.values) and isinstance(of.values[0], int):
        from matplotlib.ticker import MaxNLocator

        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    if not of.numeric:
        words = dict.fromkeys(of.labels)
        axes.set_xticks(range(len(words)), [shortened(str(w), 14) for w in words])


def _panel(axes: Axes, study: Study, number: Shown) -> None:
    """Plot a number of a grid over the first parameter, with a colour for each value of the second
    and dashes for each combination of the others."""
    design = study.design
    first, *others = design.parameters
    x = abscissa(first, [design.labels(k)[first.path] for k in range(design.count)])
    grid = number.values.reshape(*design.shape[:2], -1) if others else number.values[:, None, None]
    abscissae = x.reshape(*design.shape[:2], -1)[:, 0, 0] if others else x
    count = grid.shape[1]
    for k, j in np.ndindex(grid.shape[1:]):
        sign = k if len(others) < 2 else j * (grid.shape[2] <= FEW)
        style = _look(k if count <= FEW else 0, sign)
        axes.plot(abscissae, grid[:, k, j], **(style if first.numeric else {**style, "ls": "none"}))
    word_ticks(axes, first)
    axes.margins(*ROOM)


def _word(of: Parameter, place: int) -> str:
    value = of.displayed(of.labels[place])
    return f"{value:g}" if isinstance(value, float) else shortened(str(value), 24)


def abscissa(of: Parameter, labels: Sequence[Any]) -> Array:
    """Abscissae (points,) of a parameter: numbers in its usual unit; indices of distinct words."""
    if of.numeric:
        return np.array([of.displayed(label) for label in labels])
    kinds = [*dict.fromkeys(of.labels)]
    return np.array([float(kinds.index(label)) for label in labels])


def _parallel_coordinates(study: Study, shown: list[Shown]) -> Figure:
    """Draw every point as a line across parameters and numbers, coloured by the last number."""
    design = study.design
    labels = [design.labels(k) for k in range(design.count)]
    axes_of = [
        (p.heading, abscissa(p, [point[p.path] for point in labels])) for p in design.parameters
    ]
    words = {
        k: [*dict.fromkeys(p.labels)] for k, p in enumerate(design.parameters) if not p.numeric
    }
    axes_of += [(each.heading, each.values) for each in shown]
    title = "points across varied values and results, coloured by the last axis"
    figure = new_figure(height=100.0, title=title)
    axes = add_axes(figure, (16.0, 34.0, 136.0, 52.0))
    from matplotlib import colormaps

    colour_values = axes_of[-1][1]
    shares = np.column_stack([_share(values) for _, values in axes_of])
    for row, share in zip(shares, _share(colour_values), strict=True):
        known = np.isfinite(share)
        colour = colormaps["viridis"](share) if known else GREY
        axes.plot(range(len(axes_of)), row, lw=0.7, alpha=0.7, color=colour)
    room = min(int(136.0 / max(len(axes_of) - 1, 1) / LETTER) - 1, WIDEST)
    horizontal = room >= SHORTEST
    names = [_lines(heading, room if horizontal else 30) for heading, _ in axes_of]
    axes.set_xticks(range(len(axes_of)), names, rotation=0 if horizontal else 90)
    axes.tick_params(axis="x", labelsize=FONT_SIZE - 1.5, pad=10.0, length=0.0)
    axes.set_yticks([])
    axes.set_ylim(-0.04, 1.04)
    for k, (_, values) in enumerate(axes_of):
        known = values[np.isfinite(values)]
        for y, end, side in ((-0.06, known.min(), "top"), (1.06, known.max(), "bottom")):
            text = str(words[k][int(end)]) if k in words else f"{end:.4g}"
            axes.text(k, y, text, ha="center", va=side, fontsize=FONT_SIZE - 1.5)
        axes.axvline(k, color=GREY, lw=0.6)
    return head(figure, study.case.title or study.case.name)


def _lines(heading: str, longest: int) -> str:
    """Wrap a heading between words and after the dots of a path."""
    return "\n".join(
        broken(line, longest)
        for line in textwrap.wrap(heading, longest, break_long_words=False, break_on_hyphens=False)
    )


def _share(values: Array) -> Array:
    """Scale values linearly so that the lowest becomes 0 and the highest 1."""
    finite = values[np.isfinite(values)]
    low, span = finite.min(), np.ptp(finite)
    return (values - low) / span if span else np.full_like(values, 0.5)
