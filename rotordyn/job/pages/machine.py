"""Blocks of the machine: its longitudinal section, rotor and bearings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from bearings.bearing import BallBearing
from bearings.kinds import kind_of
from rotordyn.case.case import Case
from rotordyn.machine.spindle import Spindle
from rotordyn.page.blocks import BEARING, BEARINGS, Block, Chart, Table
from rotordyn.page.looks import COLOURS, FAINT, INK, MARKS, axis
from rotordyn.report.rotors import rotor_table
from rotordyn.results.display import DEGREE, MILLIMETRE, RPM
from rotordyn.results.text import unbroken
from rotordyn.surface.rotor import bearing_width

MM = MILLIMETRE.factor
_GEOMETRY = ("balls", "ball [mm]", "pitch circle [mm]", "free angle [deg]")


def machine_blocks(cases: Sequence[Case]) -> Iterator[Block]:
    """Yield the longitudinal section, of the first variant if there are any, and all rotors."""
    first = cases[0]
    if first.spindle is None:
        return
    apart = any(each.spindle != first.spindle for each in cases)
    yield _section(first.spindle, (first.title or first.name) if apart else "")
    yield Table("Rotor", *rotor_table(cases))


def bearings_table(spindle: Spindle, title: str) -> Table:
    """Table of the bearings and their positions, to which analyses add columns."""
    rows = []
    for seat in spindle.seats:
        b = seat.bearing
        kind = kind_of(b).replace("_", " ")
        thrust = "both ways" if b.both_ways else "+x" if seat.thrust > 0 else "−x"
        model = seat.model or getattr(b, "name", "") or kind
        rows.append(
            [
                seat.name,
                unbroken(f"{model}{' (estimate)' if b.estimated else ''}"),
                *_geometry(b),
                f"{seat.x * MM:.1f}",
                thrust,
            ]
        )
    heads = [BEARING, "model", *_GEOMETRY, "at x [mm]", "takes thrust towards"]
    return Table(title, heads, rows, section=BEARINGS)


def single_table(bearing: BallBearing, fastest: float, title: str) -> Table:
    """Table of a single bearing, with n·dm at the ``fastest`` speed [rad/s]."""
    factor = fastest * RPM.factor * bearing.pitch_diameter * MM / 1e6
    name = unbroken(getattr(bearing, "name", "") or kind_of(bearing).replace("_", " "))
    row = [name, *_geometry(bearing), f"{factor:.2f} · 10⁶"]
    return Table(title, [BEARING, *_GEOMETRY, "n·dm [mm/min]"], [row], section=BEARINGS)


def _geometry(b: BallBearing) -> list[str]:
    angle = getattr(b, "contact_angle", None)
    return [
        str(b.balls),
        f"{b.ball_diameter * MM:.4g}",
        f"{b.pitch_diameter * MM:.4g}",
        f"{angle * DEGREE.factor:.3g}" if angle is not None else "",
    ]


def _section(spindle: Spindle, of: str) -> Chart:
    traces: list[dict[str, Any]] = []
    for place, name in enumerate(spindle.ratios):
        shaft = spindle.part(name).shaft
        x, y = _outline(shaft)
        looks = {"color": COLOURS[place], "width": 1}
        traces.append(
            {"x": x, "y": y, "fill": "toself", "mode": "lines", "line": looks, "name": name}
            | {"hoverinfo": "name"}
        )
    traces += [_disc(disc) for disc in spindle.discs]
    traces += [_bearing(seat, spindle.seats) for seat in spindle.seats]
    for word, symbol, held in _points(spindle):
        traces.append(
            {
                "x": np.array([x for _, x in held]) * MM,
                "y": np.zeros(len(held)),
                "text": [name for name, _ in held],
                "name": word,
                "mode": "markers",
                "hovertemplate": "%{text}, %{x:.1f} mm",
                "marker": {"symbol": symbol, "size": 10, "color": INK},
            }
        )
    layout = {
        "xaxis": axis("x", "mm"),
        "yaxis": axis("radius", "mm", scaleanchor="x", zeroline=True),
    }
    title = f"Section along the axis{': ' if of else ''}{of}"
    return Chart(title, traces, layout, wide=True, tall=330)


def _outline(shaft: Any) -> tuple[Any, Any]:
    """Outlines of the sections above and below the axis, separated by gaps."""
    x: list[float] = []
    y: list[float] = []
    edges = shaft.boundaries
    for section, left, right in zip(shaft.sections, edges, edges[1:], strict=False):
        (outer_l, outer_r), (inner_l, inner_r) = section.outer, section.inner
        for side in (0.5, -0.5):
            corners = ((left, inner_l), (left, outer_l), (right, outer_r), (right, inner_r))
            x += [*(MM * at for at, _ in (*corners, corners[0])), np.nan]
            y += [*(MM * side * d for _, d in (*corners, corners[0])), np.nan]
    return np.array(x), np.array(y)


def _bearing(seat: Any, seats: Sequence[Any]) -> dict[str, Any]:
    b, half = seat.bearing, bearing_width(seat, seats) / 2.0
    radii = (b.pitch_diameter / 2.0 - b.ball_diameter, b.pitch_diameter / 2.0 + b.ball_diameter)
    hollow = {"fillcolor": "rgba(0,0,0,0)", "line": {"color": INK, "width": 1.6}}
    return _frame(f"bearing {seat.name}", seat.x, half, *radii) | hollow


def _disc(disc: Any) -> dict[str, Any]:
    radii = (disc.inner_diameter / 2.0, disc.outer_diameter / 2.0)
    looks = {"fillcolor": FAINT, "line": {"color": FAINT, "width": 1}, "opacity": 0.6}
    return _frame(disc.name or "disc", disc.x, disc.width / 2.0, *radii) | looks


def _frame(name: str, x: float, half: float, low: float, high: float) -> dict[str, Any]:
    """Outlines of rectangles above and below the axis."""
    along = np.array([-half, -half, half, half, -half, np.nan] * 2) + x
    up = np.array([low, high, high, low, low, np.nan])
    return {
        "x": along * MM,
        "y": np.concatenate([up, -up]) * MM,
        "fill": "toself",
        "mode": "lines",
        "name": name,
        "hoverinfo": "name",
    }


def _points(spindle: Spindle) -> Iterator[tuple[str, str, list[tuple[str, float]]]]:
    """Positions on the axis by kind, with their markers."""
    kinds = (
        ("support", [(each.name, each.x) for each in spindle.supports]),
        ("mass", [(each.name or "mass", each.x) for each in spindle.masses]),
        ("named point", list(spindle.points.items())),
    )
    for place, (word, held) in enumerate(kinds):
        if held:
            yield word, f"{MARKS[place]}{'-open' if word == 'named point' else ''}", held
