"""Modes over speed as lines, and frequencies known of them as marks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from rotordyn.figures.style import BLACK, BLUE, GREEN, PURPLE, RED
from rotordyn.machine.reference import Reference
from rotordyn.results.display import RPM
from rotordyn.results.kinds import Array, Flags, Words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LOOKS: dict[str, tuple[str, Any, str]] = {
    "forward": (BLUE, "-", "forward whirl"),
    "backward": (RED, (0, (5, 2)), "backward whirl"),
    "planar": (BLACK, (0, (1, 1)), "bending without whirl"),
    "axial": (GREEN, (0, (6, 2, 1, 2)), "axial"),
    "torsion": (PURPLE, (0, (6, 2, 1, 2, 1, 2)), "torsion"),
}
KNOWN = {
    "bending_frequency": ("D", ""),
    "mean_bending_frequency": ("s", ", mean of both whirls"),
    "torsion_frequency": ("^", ", torsion"),
}
Segments = dict[str, list[NDArray[np.float64]]]


@runtime_checkable
class Modes(Protocol):
    """Modes over speed: frequency [Hz] and whirl (speeds, modes), kind (modes,)."""

    @property
    def speed(self) -> Array: ...
    @property
    def frequency(self) -> Array: ...
    @property
    def whirl(self) -> Array: ...
    @property
    def kind(self) -> Words: ...
    @property
    def mostly_overdamped(self) -> Flags: ...


def whirl_segments(result: Modes) -> Segments:
    """Curves of (rpm, Hz) by look; a mode that changes its whirl is cut there."""
    rpm = result.speed * RPM.factor
    found: Segments = {}
    for column in np.flatnonzero(~result.mostly_overdamped):
        kind = result.kind[column]
        frequency, whirl = result.frequency[:, column], result.whirl[:, column]
        looks = [look_of(kind, w) for w in whirl]
        if len(looks) > 1:
            looks[0] = looks[1]
        start = 0
        for end in range(1, len(looks) + 1):
            if end == len(looks) or looks[end] != looks[start]:
                first = max(start - 1, 0)
                curve = np.column_stack([rpm[first:end], frequency[first:end]])
                curve = curve[np.isfinite(curve).all(axis=1)]
                if curve.size:
                    found.setdefault(looks[start], []).append(curve)
                start = end
    return found


def draw_modes(axes: Axes, result: Modes, colour: str = "", width: float = 0.7) -> None:
    """One collection of curves per look; all in ``colour`` and of ``width`` when given."""
    from matplotlib.collections import LineCollection

    curves = whirl_segments(result)
    for look, (own, dashes, label) in LOOKS.items():
        paths = [curve for curve in curves.get(look, ()) if len(curve) > 1]
        points = [curve for curve in curves.get(look, ()) if len(curve) == 1]
        named = None if colour else label
        if points:
            dots = np.concatenate(points)
            axes.plot(*dots.T, "o", color=colour or own, ms=4.0, label=named, clip_on=False)
        if paths:
            lines = LineCollection(
                paths,
                colors=colour or own,
                linestyles=[dashes],
                linewidths=width if colour else 1.3,
                label=named,
                zorder=4,
            )
            axes.add_collection(lines, autolim=False)


def draw_known(axes: Axes, references: Sequence[Reference], edge: str = BLACK) -> None:
    """Published and measured frequencies within the axes: of one whirl, of both, of torsion."""
    right, top = axes.get_xlim()[1], axes.get_ylim()[1]
    for reference in references:
        if reference.quantity not in KNOWN:
            continue
        marker, what = KNOWN[reference.quantity]
        rpm, hertz = np.asarray(reference.speeds) * RPM.factor, np.asarray(reference.values)
        inside = (rpm <= right * (1.0 + 1e-9)) & (hertz <= top)
        if not inside.any():
            continue
        axes.plot(
            rpm[inside],
            hertz[inside],
            marker,
            mfc="none",
            mec=edge,
            ms=5.0,
            mew=0.9,
            ls="none",
            label=f"{reference.kind}{what}",
            zorder=6,
            clip_on=False,
        )


def look_of(kind: str, whirl: float) -> str:
    if kind != "bending":
        return kind if kind in LOOKS else "planar"
    return {1: "forward", -1: "backward"}.get(int(whirl) if whirl == whirl else 0, "planar")


def modes_among(results: Mapping[str, Any]) -> Modes | None:
    """The first result that has modes over speed."""
    return next((result for result in results.values() if isinstance(result, Modes)), None)
