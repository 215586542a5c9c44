"""Contacts of a single bearing: loads, angles, ellipse ends, pressures, number per ball."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.bearing.figures.groove_ends import (
    COLOURS,
    MARKS,
    groove_ends,
    loaded_contacts,
)
from rotordyn.analyses.bearing.result import BearingMapResult, along_load
from rotordyn.analyses.bearing.solve import mounted_under
from rotordyn.arrays import Array
from rotordyn.figures.curves import draw_runs
from rotordyn.figures.labels import axis_label
from rotordyn.figures.legends import legend, top_legend
from rotordyn.figures.style import (
    BLACK,
    DASHES,
    FONT_SIZE,
    GREY,
    PURPLE,
    SKY,
    add_axes,
    evenly,
    grid_boxes,
    marked,
    new_figure,
    round_ticks,
    speed_ticks,
)
from rotordyn.results.display import DEGREE, GIGAPASCAL, RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_CURVES = 3  # of one contact
COUNTED = (GREY, SKY, BLACK, PURPLE, "#7A8B2F")  # by number of contacts
WIDTHS = {"i": 2.0, "o": 1.0}  # thin outer contacts remain visible on the inner ones
SHADES = ("#FFFFFF", "#F1F1F1", "#D1E4F1", "#F9E0D2", "#E8B79B")  # by number of contacts


class Sweep(NamedTuple):
    """The variable that curves run over, with the indices and names of the curves drawn."""

    values: Array
    label: str
    chosen: tuple[int, ...]
    names: tuple[str, ...]
    over_load: bool

    def of(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return values (speed, load, …) with the swept dimension first, the other one second."""
        return values.swapaxes(0, 1) if self.over_load else values


def contacts_figure(result: BearingMapResult) -> Figure:
    """Draw load, angle with ellipse ends, pressure by contact, and number of contacts.

    Loads and pressures are the largest of all balls; angles those of the ball which loads a contact
    most, ellipse ends the extremes of all balls.
    """
    figure = new_figure(168.0, 128.0)
    run = _sweep(result)
    most = "largest " if result.ball.size > 1 else ""
    names = [f"{most}contact load [kN]", "contact angle [deg]", f"{most}peak pressure [GPa]", ""]
    boxes = grid_boxes(figure, 2, 2, margins=(16.0, 8.0, 12.0, 8.0), gaps=(19.0, 9.0))
    axes = [
        add_axes(figure, box, run.label if k > 1 else "", name)
        for k, (box, name) in enumerate(zip(boxes, names, strict=True))
    ]
    load = np.where(result.contact_load > 0.0, result.contact_load, np.nan) / 1e3
    pressure = np.where(result.contact_load > 0.0, result.contact_pressure, np.nan)
    _by_contact(axes[0], result, run, load, label=True)
    _by_contact(axes[2], result, run, pressure * GIGAPASCAL.factor)
    _angles(axes[1], result, run)
    (_numbers if result.ball.size > 1 else _map)(axes[3], result, run)
    for k, panel in enumerate(axes):
        _abscissa(panel, run)
        panel.tick_params(labelbottom=k > 1)
    if len(run.chosen) > 1:
        for dash, name in zip(DASHES, run.names, strict=False):
            axes[0].plot([], [], color="#444444", ls=dash, label=name)
    top_legend(figure, axes[0], axes[1])
    return figure


def _sweep(result: BearingMapResult) -> Sweep:
    rpm = result.speed * RPM.factor
    if along_load(result):
        rows = tuple(evenly(rpm.size, MOST_CURVES).tolist())
        names = tuple(f"{rpm[k]:.0f} rpm" for k in rows)
        return Sweep(result.load, axis_label(result, "load"), rows, names, True)
    rows = tuple(evenly(result.load.size, MOST_CURVES).tolist())
    names = tuple(mounted_under(result, k, " axial") for k in rows)
    return Sweep(rpm, "speed [rpm]", rows, names, False)


def _abscissa(axes: Axes, run: Sweep) -> None:
    if run.over_load:
        axes.set_xlim(float(run.values[0]), float(run.values[-1]))
    else:
        speed_ticks(axes, float(run.values[-1]), 5)


def _largest(values: Array) -> Array:
    """Return the largest of all balls from (…, ball, contact); NaN where none is loaded."""
    return np.fmax.reduce(values, axis=-2)


def _by_contact(
    axes: Axes, result: BearingMapResult, run: Sweep, values: Array, *, label: bool = False
) -> None:
    shown = run.of(_largest(values))
    for k, name in loaded_contacts(result):
        for dash, other in zip(DASHES, run.chosen, strict=False):
            legend_name = f"contact {name}" if label and other == run.chosen[0] else None
            look: dict[str, Any] = {"ls": dash, **_look(name)}
            axes.plot(run.values, shown[:, other, k], label=legend_name, **look)
    axes.set_ylim(0.0, axes.get_ylim()[1] * 1.05)


def _look(name: str) -> dict[str, Any]:
    """Return colour, width and marks of a contact."""
    start = 0.03 + 0.04 * list(COLOURS).index(name)
    marks = {
        "marker": MARKS[name],
        "ms": 3.2,
        "mfc": "white",
        "mew": 0.8,
        "markevery": (start, 0.2),
    }
    return {"color": COLOURS[name], "lw": WIDTHS[name[0]], **marks}


def _angles(axes: Axes, result: BearingMapResult, run: Sweep) -> None:
    """Draw angles, and thinly the ends of ellipses, at the last of the other dimension."""
    ball = np.nan_to_num(result.contact_load).argmax(axis=-2)
    angle = np.take_along_axis(result.contact_angle, ball[..., None, :], axis=-2)[..., 0, :]
    upper = np.fmax.reduce(result.ellipse_upper, axis=-2)
    lower = np.fmin.reduce(result.ellipse_lower, axis=-2)
    last = run.chosen[-1]
    for k, name in loaded_contacts(result):
        colour = COLOURS[name]
        low, middle, high = (run.of(v)[:, last, k] * DEGREE.factor for v in (lower, angle, upper))
        of_ball = run.of(ball)[:, last, k]
        draw_runs(axes, run.values, middle, of_ball, **_look(name))
        for end in (low, high):
            axes.plot(run.values, end, color=colour, lw=0.7, ls=":")
        if np.isfinite(low).any():
            axes.fill_between(run.values, low, high, color=colour, alpha=0.08, lw=0.0)
    axes.plot([], [], color="#444444", lw=0.7, ls=":", label="ends of the contact ellipse")
    groove_ends(axes, result)
    where = f"at {run.names[-1]}" if run.over_load else f"under {run.names[-1]}"
    axes.set_title(where, fontsize=FONT_SIZE - 1.0, pad=2.5)


def _numbers(axes: Axes, result: BearingMapResult, run: Sweep) -> None:
    """Draw the number of balls by number of contacts."""
    axes.set_ylabel("number of balls [-]", fontsize=FONT_SIZE)
    for count in range(int(result.contacts.max()) + 1):
        balls = run.of((result.contacts == count).sum(axis=-1).astype(float))
        if not balls.any():
            continue
        for dash, other in zip(DASHES, run.chosen, strict=False):
            text = f"{count} contact{'' if count == 1 else 's'}"
            name = text if other == run.chosen[0] else None
            look = {"color": COUNTED[count], "ls": dash, "label": name, **marked(count)}
            axes.plot(run.values, balls[:, other], **look)
    axes.set_ylim(0.0, result.ball.size * 1.35)  # curves end at all balls: the legend lies above
    axes.set_yticks(round_ticks(0.0, float(result.ball.size), 5))
    legend(axes, loc="upper center", ncols=2)


def _map(axes: Axes, result: BearingMapResult, run: Sweep) -> None:
    """Draw the number of contacts over the sweep, a row for each value of the other dimension."""
    shown = run.of(result.contacts[..., 0])
    axes.grid(visible=False)
    axes.set_title("number of contacts [-]", fontsize=FONT_SIZE - 1.0, pad=2.5)
    steps = np.diff(run.values, prepend=2 * run.values[0] - run.values[min(1, run.values.size - 1)])
    left = run.values - steps / 2.0
    widths = np.append(np.diff(left), steps[-1])
    for row in range(shown.shape[1]):
        for count in np.unique(shown[:, row]):
            cells = shown[:, row] == count
            axes.barh(
                np.full(int(cells.sum()), row), widths[cells], left=left[cells], height=0.86,
                color=SHADES[count], edgecolor=SHADES[count], lw=0.3,
            )  # fmt: skip
            axes.text(
                float(np.mean(run.values[cells])), row, f"{count}", ha="center", va="center",
                fontsize=FONT_SIZE - 1.0, color=GREY,
            )  # fmt: skip
    rows = range(shown.shape[1])
    rpm = result.speed * RPM.factor
    names = [f"{rpm[k]:.0f} rpm" if run.over_load else mounted_under(result, k) for k in rows]
    axes.set_yticks(list(rows), names)
    axes.set_ylim(-0.5, len(names) - 0.5)
