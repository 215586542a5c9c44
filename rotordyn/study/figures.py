"""Headline numbers over what was varied; of three parameters or more, parallel coordinates too."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import takewhile
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.analyses.registry import analysis
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
from rotordyn.results.kinds import Array
from rotordyn.study.parameter import Parameter
from rotordyn.study.point import Outcome, Study
from rotordyn.study.summary import lacking, names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANELS, COLUMNS = 9, 3
ROW = 48.0  # mm
ROOM = (0.05, 0.1)  # share of an axis beside its points
NOTE: dict[str, Any] = {"ha": "right", "color": GREY, "fontsize": FONT_SIZE - 1.5}  # in a panel
FEW = 7  # values of the second parameter, or combinations of the others, that the legend names
LEGEND = 9.0  # mm of its two lines
LETTER, SHORTEST, WIDEST = 1.25, 11, 22  # mm of a letter; letters of a line that stands level
ALIKE = 1e-6  # relative difference of numbers that are drawn once
ALONG = 5  # numbers beside the parameters of parallel coordinates


class Shown(NamedTuple):
    """A number as drawn: its words, unit, and value at every point, NaN where there is none, which
    ``lacking`` tells."""

    words: str
    unit: str
    values: Array
    lacking: str = ""

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
            by_analysis.setdefault(of, []).append(
                Shown(words, unit, values, lacking(name, outcomes))
            )
    by_analysis = {of: _once(found) for of, found in by_analysis.items()}
    for of, found in by_analysis.items():
        yield f"study_{of}", partial(_over, study, of, found)
    if len(study.design.parameters) > 2 and by_analysis:
        chosen = [
            each._replace(words=f"{of}: {each.words}")
            for of, found in by_analysis.items()
            for each in found[:2]
        ][:ALONG]
        yield "study_across", partial(_parallel_coordinates, study, chosen)


def _once(found: Sequence[Shown]) -> list[Shown]:
    """Numbers that are alike at every point as one, such as both whirls of a mode at rest."""
    groups: list[list[Shown]] = []
    for each in found:
        for known in groups:
            first = known[0]
            if first.unit == each.unit and np.allclose(
                first.values, each.values, rtol=ALIKE, atol=0.0, equal_nan=True
            ):
                known.append(each)
                break
        else:
            groups.append([each])
    return [known[0]._replace(words=_joined([each.words for each in known])) for known in groups]


def _joined(names: Sequence[str]) -> str:
    """Names as one: what differs is listed, what they share at both ends stands once.

    >>> _joined(["bending 2 backward at 0 rpm", "bending 2 forward at 0 rpm"])
    'bending 2 backward, forward at 0 rpm'
    """
    rows = [name.split() for name in names]
    head = _shared(rows)
    rest = [row[len(head) :] for row in rows]
    tail = _shared([row[::-1] for row in rest])[::-1]
    apart = [" ".join(row[: len(row) - len(tail)]) for row in rest]
    listed = ", ".join(dict.fromkeys(filter(None, apart)))
    return " ".join(filter(None, [*head, listed, *tail]))


def _shared(rows: Sequence[Sequence[str]]) -> list[str]:
    """Words that all rows begin with."""
    alike = takewhile(lambda words: len({*words}) == 1, zip(*rows, strict=False))
    return [first for first, *_ in alike]


def _over(study: Study, name: str, found: list[Shown]) -> Figure:
    """Panels of the numbers of an analysis that vary most over the points."""
    spread = sorted(
        found,
        key=lambda s: -float(np.ptp(s.values[np.isfinite(s.values)]) / np.nanmax(np.abs(s.values))),
    )
    shown = [each for each in found if each in spread[:PANELS]]
    columns = min(COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    grid = study.design.sampling == "grid"
    legends = _legends(study, shown) if grid else []
    top = 11.0 + LEGEND * len(legends)
    high = top + 6.0 + ROW * rows
    title = analysis(name).heading
    if len(shown) < len(found):
        title += f": the {len(shown)} of {len(found)} numbers that vary most"
    figure = new_figure(height=high, title=title)
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
            bbox_to_anchor=(0.5, 1.0 - (6.0 + LEGEND * k) / high),
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
    """Heading and lines of the colours of the second parameter and of the dashes of the others."""
    from matplotlib.lines import Line2D

    legends: list[tuple[str, list[Any]]] = []
    _, *others = study.design.parameters
    if others and (count := len(others[0].values)) <= FEW:
        words = [_word(others[0], k) for k in range(count)]
        plain = {"ls": "-", "marker": ""} if others[1:] else {}
        looks = [{**_look(k, k), **plain} for k in range(count)]
        handles = [Line2D([], [], label=w, **look) for w, look in zip(words, looks, strict=True)]
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
                look = {**_look(0, j), "color": BLACK}
                handles.append(Line2D([], [], label=label, **look))
        legends.append((heading, handles))
    return legends


def _look(colour: int, sign: int) -> dict[str, Any]:
    """Of a line by the places of its colour and of its dashes and marks."""
    return {
        "color": CYCLE[colour % len(CYCLE)],
        "ls": DASHES[sign % len(DASHES)],
        "marker": POINTS[sign % len(POINTS)],
        "ms": 3.0,
        "lw": 1.0,
    }


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
    axes.set_xlabel(broken(of.heading, 32), fontsize=FONT_SIZE - 1.5)
    word_ticks(axes, of)
    axes.margins(*ROOM)


def word_ticks(axes: Axes, of: Parameter) -> None:
    """Name the ticks of a parameter without numbers; those of whole numbers are whole."""
    if of.numeric and len(of.values) and isinstance(of.values[0], int):
        from matplotlib.ticker import MaxNLocator

        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    if not of.numeric:
        words = dict.fromkeys(of.labels)
        axes.set_xticks(range(len(words)), [shortened(str(w), 14) for w in words])


def _panel(axes: Axes, study: Study, each: Shown) -> None:
    """A number of a grid over the first parameter: a colour for each value of the second, dashes
    for each combination of the others."""
    design = study.design
    first, *others = design.parameters
    x = abscissa(first, [design.labels(k)[first.path] for k in range(design.count)])
    grid = each.values.reshape(*design.shape[:2], -1) if others else each.values[:, None, None]
    along = x.reshape(*design.shape[:2], -1)[:, 0, 0] if others else x
    count = grid.shape[1]
    for k, j in np.ndindex(grid.shape[1:]):
        sign = k if len(others) < 2 else j * (grid.shape[2] <= FEW)
        look = _look(k if count <= FEW else 0, sign)
        axes.plot(along, grid[:, k, j], **(look if first.numeric else {**look, "ls": "none"}))
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
    title = "points across what was varied and what came of it, coloured by the last axis"
    figure = new_figure(height=100.0, title=title)
    axes = add_axes(figure, (16.0, 34.0, 136.0, 52.0))
    from matplotlib import colormaps

    rule = axes_of[-1][1]
    shares = np.column_stack([_share(values) for _, values in axes_of])
    for row, share in zip(shares, _share(rule), strict=True):
        known = np.isfinite(share)
        colour = colormaps["viridis"](share) if known else GREY
        axes.plot(range(len(axes_of)), row, lw=0.7, alpha=0.7, color=colour)
    room = min(int(136.0 / max(len(axes_of) - 1, 1) / LETTER) - 1, WIDEST)
    level = room >= SHORTEST
    names = [_lines(heading, room if level else 30) for heading, _ in axes_of]
    axes.set_xticks(range(len(axes_of)), names, rotation=0 if level else 90)
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
    """A heading in lines, broken between words and behind the dots of a path."""
    return "\n".join(
        broken(line, longest)
        for line in textwrap.wrap(heading, longest, break_long_words=False, break_on_hyphens=False)
    )


def _share(values: Array) -> Array:
    """Values as shares of the way from the lowest (0) to the highest (1)."""
    known = values[np.isfinite(values)]
    low, span = known.min(), np.ptp(known)
    return (values - low) / span if span else np.full_like(values, 0.5)
