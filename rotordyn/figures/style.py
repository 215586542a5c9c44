"""Report style of all figures.

They are 168 mm wide, which fits A4, with fixed margins, colours that are distinct to the
colour-blind, and dashes and marks that distinguish lines without colour.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rotordyn.arrays import Indices
from rotordyn.results.display import rounded_up
from rotordyn.results.headline import LEAST_POINTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DPI = 300  # of a PNG, and of rasters within PDF and SVG
FORMATS = ("png", "pdf", "svg")
USUAL_FORMATS = ("png",)
BLUE, RED, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#9A5B8B"
ORANGE, SKY, BLACK, GREY = "#E69F00", "#56B4E9", "#222222", "#8A8A8A"
CYCLE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK)
DASHES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (1, 1)), (0, (7, 2)))
MARKS = {"-": "o", "--": "s", "-.": "^", ":": "v"}  # of lone points, by the dashes of their line
POINTS = ("o", "s", "^", "D", "v", "P")  # fewer than colours, so that pairs differ for longer
FONT_SIZE = 8.0
STEADY = 1e-4  # of a value: least span of an ordinate to either side
HEAD_SIDE, HEAD_LINE, HEAD_COLOUR = 4.0, 3.4, "#555555"  # of the title at the top [mm]
EMPTY = 0.25  # of an axis from zero: largest part without values
LEVEL = 1e-6  # of the largest value: smaller negative values are rounding
_RC: Any = {
    "font.size": FONT_SIZE,
    "axes.titlesize": FONT_SIZE,
    "axes.linewidth": 0.6,
    "axes.edgecolor": "#444444",
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.autolimit_mode": "data",
    "axes.xmargin": 0.0,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.2,
    "lines.markersize": 5.0,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.frameon": False,
    "legend.fontsize": FONT_SIZE - 1.0,
    "legend.handlelength": 2.4,
    "svg.fonttype": "none",
    "pdf.fonttype": 3,
    "svg.hashsalt": "rotordyn",
    "axes.formatter.use_mathtext": False,
    "text.parse_math": False,
}
_SAVED: Mapping[str, Any] = {  # without dates, so that a figure drawn twice gives the same file
    "pdf": {"metadata": {"CreationDate": None}},
    "svg": {"metadata": {"Date": None}},
}


@contextmanager
def own_settings() -> Iterator[None]:
    """Set the defaults of matplotlib, so that figures do not depend on style files of the user."""
    from matplotlib import rc_context, rcParamsDefault

    delivered: Any = {name: value for name, value in rcParamsDefault.items() if name != "backend"}
    with rc_context({**delivered, "text.parse_math": False}):
        yield


def new_figure(
    width: float = 168.0, height: float = 105.0, title: str = "", dpi: float = DPI
) -> Figure:
    """Return an empty figure of ``width`` × ``height`` [mm]; ``dpi``: of its PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from rotordyn.figures.canvas import ShownFigure

    figure = ShownFigure(figsize=(width / 25.4, height / 25.4), dpi=dpi)
    FigureCanvasAgg(figure)
    if title:
        title_y = 1.0 - 4.5 / height
        figure.text(0.5, title_y, title, ha="center", va="center", fontsize=FONT_SIZE + 1.0)
    return figure


def add_axes(
    figure: Figure, box: Sequence[float], x_label: str = "", y_label: str = "", **kwargs: Any
) -> Axes:
    """Add axes in ``box`` = left, bottom, width, height [mm from the lower left corner]."""
    from matplotlib import rc_context

    width, height = figure.get_size_inches() * 25.4
    left, bottom, wide, tall = box
    with rc_context(_RC):
        axes = figure.add_axes(
            (left / width, bottom / height, wide / width, tall / height), **kwargs
        )
        axes.set_xlabel(x_label, fontsize=FONT_SIZE)
        axes.set_ylabel(y_label, fontsize=FONT_SIZE)
        axes.tick_params(labelsize=FONT_SIZE - 0.5)
    return axes


def colour_scale(
    figure: Figure, box: Sequence[float], low: float, high: float, label: str, colours: str
) -> Axes:
    """Draw a colour bar from ``low`` to ``high`` in ``box`` [mm], its label at the right."""
    axes = add_axes(figure, box)
    axes.imshow(
        np.linspace(0.0, 1.0, 128)[:, None],
        origin="lower",
        aspect="auto",
        cmap=colours,
        rasterized=True,
        extent=(0.0, 1.0, low, high),
    )
    axes.set_xticks([])
    axes.yaxis.tick_right()
    axes.yaxis.set_label_position("right")
    axes.set_ylabel(label, fontsize=FONT_SIZE)
    axes.grid(visible=False)
    axes.tick_params(labelsize=FONT_SIZE - 0.5)
    return axes


def grid_boxes(
    figure: Figure,
    rows: int,
    columns: int,
    *,
    margins: Sequence[float] = (15.0, 4.0, 12.0, 9.0),
    gaps: Sequence[float] = (17.0, 15.0),
) -> list[tuple[float, float, float, float]]:
    """Return boxes [mm] of equal panels, by row from the top; margins: left, right, bottom, top."""
    width, height = figure.get_size_inches() * 25.4
    left, right, bottom, top = margins
    wide = (width - left - right - gaps[0] * (columns - 1)) / columns
    tall = (height - bottom - top - gaps[1] * (rows - 1)) / rows
    return [
        (left + c * (wide + gaps[0]), height - top - (r + 1) * tall - r * gaps[1], wide, tall)
        for r in range(rows)
        for c in range(columns)
    ]


def mark_lone_points(axes: Axes) -> None:
    """Mark points of lines without a segment: a single speed, or one between missing values."""
    for line in axes.get_lines():
        finite = np.isfinite(np.column_stack([line.get_xdata(), line.get_ydata()])).all(axis=1)
        if not finite.any():
            line.set_markevery(None)  # which fails on an empty line
        padded = np.pad(finite, 1)
        lone = np.flatnonzero(finite & ~padded[:-2] & ~padded[2:])
        plain = line.get_marker() in ("None", "", None)
        if lone.size and (plain or line.get_markevery() is not None):
            line.set_marker(
                MARKS.get(str(line.get_linestyle()), "D") if plain else line.get_marker()
            )
            line.set(markersize=4.0, markevery=lone, clip_on=False)


def evenly(count: int, most: int) -> Indices:
    """Return at most ``most`` evenly spaced indices of ``count``, with the first and the last."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(np.intp))


def mark_few_points(axes: Axes) -> None:
    """Replace a line through fewer than ``LEAST_POINTS`` points, which would suggest values between
    them, by marks: filled if the line is solid, open if it is dashed."""
    for line in axes.get_lines():
        across = line.get_transform() != axes.transData  # from edge to edge of the axes
        if across or not 1 < np.size(line.get_xdata()) < LEAST_POINTS:
            continue
        dashes = str(line.get_linestyle())
        if dashes == "None":
            continue
        if line.get_marker() in ("None", "", None):
            line.set_marker(MARKS.get(dashes, "D"))
        face = line.get_color() if dashes == "-" else "white"
        line.set(linestyle="", markevery=None, markersize=4.5, markerfacecolor=face, clip_on=False)


def line_of(place: int, dash: int | None = None) -> dict[str, Any]:
    """Return colour and dashes of the line at index ``place``; ``dash``: its index among dashes if
    these have another meaning."""
    dashes = DASHES[(place if dash is None else dash) % len(DASHES)]
    return {"color": CYCLE[place % len(CYCLE)], "ls": dashes}


def marked(place: int) -> dict[str, Any]:
    """Return sparse marks along the line at index ``place``, none for the first: they distinguish
    lines where dashes have another meaning."""
    if place == 0:
        return {}
    sign = POINTS[(place - 1) % len(POINTS)]
    return {
        "marker": sign,
        "ms": 3.6,
        "mfc": "white",
        "mew": 0.8,
        "markevery": (0.03 * place, 0.16),
    }


def note_error(axes: Axes, error: float) -> None:
    """Write the estimated relative error of the curves below the right corner, in small print."""
    if error > 0.0:
        axes.text(
            1.0,
            -0.085,
            f"estimated error ≤ {rounded_up(error)}",
            transform=axes.transAxes,
            ha="right",
            va="top",
            fontsize=FONT_SIZE - 2.0,
            color=GREY,
        )


def speed_ticks(axes: Axes, top: float, most: int = 6, low: float = 0.0) -> None:
    """Set a speed axis from ``low`` to ``top`` [rpm] with at most ``most`` + 1 round ticks."""
    axes.set_xlim(low, max(top, 1.0))
    axes.set_xticks(round_ticks(low, max(top, 1.0), most))


def axis_start(low: float, high: float) -> float:
    """Return the start of an axis of values from ``low`` to ``high``: zero, unless more than a
    quarter of it were empty.

    >>> axis_start(3000.0, 24000.0), axis_start(20000.0, 60000.0)
    (0.0, 20000.0)
    """
    return low if low > EMPTY * high else min(low, 0.0)


_STEPS = ((1,), (1, 2, 5), (1, 2, 3, 4, 6, 8))  # multiples of a decade with ticks


def log_ticks(low: float, high: float) -> list[tuple[float, str]]:
    """Return ticks of a logarithmic axis and their labels: decades, or more of each if few.

    >>> log_ticks(0.005, 1.2)
    [(0.01, '0.01'), (0.1, '0.1'), (1.0, '1')]
    >>> [name for _, name in log_ticks(0.9e-6, 6e-6)]
    ['1e-6', '2e-6', '5e-6']
    >>> [name for _, name in log_ticks(5500.0, 1.8e4)]
    ['6000', '8000', '1e4']
    """
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    inside: list[float] = []
    for steps in _STEPS[math.log10(high / low) <= 2.2 :]:
        values = [s * 10.0**d for d in range(first, last + 1) for s in steps]
        inside = [v for v in values if low * (1 - 1e-9) <= v <= high * (1 + 1e-9)]
        if len(inside) > 2:
            break
    return [(float(f"{v:.3g}"), _short(v)) for v in inside]


def _short(value: float) -> str:
    if 0.999e-3 <= value < 1e4:
        return f"{value:.4g}"
    mantissa, exponent = f"{value:.0e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def round_ticks(low: float, high: float, most: int) -> list[float]:
    """Return at most ``most`` + 1 round values between ``low`` and ``high``.

    >>> round_ticks(0.0, 24000.0, 6)
    [0.0, 4000.0, 8000.0, 12000.0, 16000.0, 20000.0, 24000.0]
    """
    span = high - low
    decade = 10.0 ** math.floor(math.log10(span / most))
    step = next(s * decade for s in (1, 2, 4, 5, 10, 20) if span / (s * decade) <= most + 1e-9)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [float(k * step) for k in range(first, last + 1)]


def finish(figure: Figure) -> Figure:
    """Complete a figure after all is drawn: marks on lone points, wider ordinates of nearly
    constant values."""
    for axes in figure.axes:
        mark_lone_points(axes)
        _widen(axes)
    return figure


def _widen(axes: Axes) -> None:
    """Widen an ordinate with nearly equal ends, as of a constant with rounding errors."""
    low, high = axes.get_ylim()
    size = max(abs(low), abs(high))
    if axes.get_yscale() == "linear" and axes.lines and abs(high - low) < STEADY * size:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - STEADY * size, middle + STEADY * size)


def head(figure: Figure, words: str) -> Figure:
    """Write ``words``, the machine and case, at the top of ``figure``, which grows."""
    width = figure.get_size_inches()[0] * 25.4
    room = (width - 2.0 * HEAD_SIDE) / max(text_width(words, FONT_SIZE - 0.5), 1.0)
    lines = [words] if room >= 1.0 else textwrap.wrap(words, int(0.94 * room * len(words)))
    grow(figure, 2.0 + HEAD_LINE * len(lines))
    height = figure.get_size_inches()[1] * 25.4
    for place, line in enumerate(lines):
        figure.text(
            HEAD_SIDE / width,
            1.0 - (1.6 + HEAD_LINE * place) / height,
            line,
            ha="left",
            va="top",
            fontsize=FONT_SIZE - 0.5,
            color=HEAD_COLOUR,
        )
    return figure


def text_width(words: str, size: float) -> float:
    """Return the width of a line of text [mm]."""
    from matplotlib.font_manager import FontProperties

    measure, font = measuring(DPI).get_text_width_height_descent, FontProperties(size=size)
    return float(measure(words, font, ismath=False)[0] * 25.4 / DPI)


@cache
def measuring(dpi: float) -> Any:
    """Return a renderer that measures texts, without the pixels of a figure, which take 10 ms."""
    from matplotlib.backends.backend_agg import RendererAgg

    return RendererAgg(1.0, 1.0, dpi)  # type: ignore[no-untyped-call]


def grow(figure: Figure, more: float) -> None:
    """Extend ``figure`` by ``more`` [mm] at its top; its contents stay in place."""
    width, height = figure.get_size_inches() * 25.4
    share = height / (height + more)
    for axes in figure.axes:
        x, y, wide, tall = axes.get_position(original=True).bounds
        axes.set_position((x, y * share, wide, tall * share))
    for text in figure.texts:
        text.set_y(text.get_position()[1] * share)
    for legend in figure.legends:
        box = legend.get_bbox_to_anchor().transformed(figure.transFigure.inverted())
        anchor = (box.x0, box.y0 * share, box.width, box.height * share)
        legend.set_bbox_to_anchor(anchor, transform=figure.transFigure)
    figure.set_size_inches(width / 25.4, (height + more) / 25.4)


def save(figure: Figure, folder: Path, name: str, formats: Sequence[str] = USUAL_FORMATS) -> None:
    """Write ``name`` into ``folder`` in each of ``formats``.

    A page of PDF and SVG has the size of the figure, 168 mm wide in a report.
    """
    from matplotlib import rc_context

    from rotordyn.figures.png import write_png

    finish(figure)
    with rc_context(_RC):
        for ending in formats:
            path = folder / f"{name}.{ending}"
            if ending == "png":
                write_png(figure, path, DPI)
            else:
                figure.savefig(path, dpi=DPI, **_SAVED[ending])


def with_zero(axes: Axes, room: float) -> None:
    """Set limits of the ordinate that include zero: at the bottom, unless values are below it."""
    low, high = axes.get_ylim()
    below = low if axes.dataLim.ymin < -LEVEL * abs(axes.dataLim.ymax) else 0.0
    axes.set_ylim(below * room, max(high, 0.0) * room)
