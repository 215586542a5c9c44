"""Error against time of one bearing's solver, drawn from the last measurement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from docs.generate.pictures import keep_figure
from docs.generate.precision import plain_ticks
from docs.generate.times import measured
from rotordyn.figures.legends import legend
from rotordyn.figures.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    add_axes,
    grid_boxes,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STARTS = {"warm": (BLUE, "o-"), "cold": (RED, "s--")}
VARIED = {
    "first path step": (ORANGE, "v-."),
    "largest rotation [rad]": (BLUE, "o-"),
    "Newton steps allowed": (PURPLE, "d-"),
    "shortest path step": (RED, "s--"),
    "fixed path steps": (GREEN, "^:"),
}
FITS = {
    "Brewe and Hamrock 1977": (ORANGE, "v", "fit of 1977"),
    "Hamrock and Brewe 1983": (PURPLE, "^", "fit of 1983"),
}
EXACT = "exact, `bearings.contact.hertz`"
STANDARD = "default"
NEWTON, PATH = "tolerance of Newton's method", "step length along the path"
CONTACT = "contact stiffness"
MARGINS = {
    NEWTON: (0.3, 1.4),
    PATH: (0.8, 1.25),
    CONTACT: (0.6, 1.6),
}  # of the times: space for legends


def draw_bearing_curves() -> None:
    """The curves of the last measurement into the folder of figures."""
    keep_figure(bearing_figure(measured()["bearing"]), "bearing_error")


def bearing_figure(found: dict[str, Any]) -> Figure:
    """Tolerance of Newton's method; step length along the path; contact stiffness."""
    figure = new_figure(188.0, 82.0)
    boxes = grid_boxes(figure, 1, 3, margins=(15.0, 4.0, 12.0, 8.0), gaps=(16.5, 0.0))
    for draw, box in zip((_tolerance, _path_steps, _hertz), boxes, strict=True):
        draw(add_axes(figure, box), found)
    return figure


def _labelled(axes: Axes, title: str, x: str, y: str) -> None:
    """Labels, margins around the curves, and scales."""
    axes.set_title(title, fontsize=8.0, pad=4.0)
    axes.set_xlabel(x, fontsize=8.0)
    axes.set_ylabel(y, fontsize=8.0)
    axes.autoscale()
    low, high = axes.get_ylim()
    axes.set_ylim(low / 3.0, 3.0 * high)
    first, last = axes.get_xlim()
    axes.set_xlim(first * MARGINS[title][0], last * MARGINS[title][1])
    plain_ticks(axes)


def _tolerance(axes: Axes, found: dict[str, Any]) -> None:
    for start, (colour, look) in STARTS.items():
        own = [line for line in found["tolerance"] if line["start"] == start]
        times, errors = [r["state"] for r in own], [r["error_k"] for r in own]
        axes.loglog(times, errors, look, color=colour, ms=3.5, label=start)
        shipped = [r for r in own if r["tolerance"] == 1e-11]
        _ring(axes, shipped[0]["state"], shipped[0]["error_k"])
    axes.plot([], [], "o", color=BLACK, mfc="none", ms=8.0, label=STANDARD)
    _labelled(axes, NEWTON, "µs per state", "largest relative error of K [-]")
    legend(axes, loc="lower left")


def _path_steps(axes: Axes, found: dict[str, Any]) -> None:
    certain = found["path_steps"]["certain"]
    floor = 0.5 / certain
    for name, (colour, look) in VARIED.items():
        own = [line for line in found["path_steps"]["lines"] if line["varied"] == name]
        shares = [max(r["share"], floor) for r in own]
        axes.loglog(
            [1e-3 * r["state"] for r in own], shares, look, color=colour, ms=3.5, label=name
        )
    shipped = next(r for r in found["path_steps"]["lines"] if r["varied"] == "default")
    _ring(axes, 1e-3 * shipped["state"], max(shipped["share"], floor))
    axes.axhline(floor, color=GREY, lw=0.8, ls=":")
    _labelled(axes, PATH, "ms per state", "share of wrong states [-]")
    axes.annotate(
        f"none of {certain}",
        (0.03, floor),
        xycoords=("axes fraction", "data"),
        xytext=(0, 3),
        textcoords="offset points",
        ha="left",
        fontsize=6.5,
        color=GREY,
    )
    legend(axes, loc="upper right")


def _hertz(axes: Axes, found: dict[str, Any]) -> None:
    def worst(line: dict[str, Any]) -> float:
        return max(line["k"].values())

    lines = {line["way"]: line for line in found["hertz"]}
    scipy = [line for way, line in lines.items() if way.startswith("SciPy")]
    axes.loglog(
        [r["contact"] for r in scipy],
        [worst(r) for r in scipy],
        "s--",
        color=RED,
        ms=3.5,
        label="SciPy",
    )
    for way, (colour, mark, name) in FITS.items():
        line = lines[way]
        axes.loglog([line["contact"]], [worst(line)], mark, color=colour, ms=5.0, label=name)
    exact = lines[EXACT]
    axes.loglog([exact["contact"]], [worst(exact)], "o", color=BLUE, ms=5.0, label="exact")
    _ring(axes, exact["contact"], worst(exact))
    _labelled(axes, CONTACT, "µs per contact", "largest relative error of k [-]")
    legend(axes, loc="lower left")


def _ring(axes: Axes, time: float, error: float) -> None:
    """Marks the default setting of the solver."""
    axes.plot([time], [error], "o", color=BLACK, mfc="none", ms=8.0, zorder=5)
