"""Lines of modes over speed, and marks of their published and measured frequencies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np

from rotordyn.arrays import Array, Flags, Words
from rotordyn.figures.style import BLACK, BLUE, GREEN, PURPLE, RED
from rotordyn.machine.reference import Reference
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LEAST_SPEEDS = 4  # for a line; with fewer a mode has a mark at each speed
JUMP = 0.5  # of the change over adjacent steps: least excess of a jump where a stop closes
LOOKS: dict[str, tuple[str, Any, str]] = {
    "forward": (BLUE, "-", "forward whirl"),
    "backward": (RED, (0, (5, 2)), "backward whirl"),
    "planar": (BLACK, (0, (1, 1)), "bending without whirl"),
    "axial": (GREEN, (0, (6, 2, 1, 2)), "axial"),
    "torsion": (PURPLE, (0, (6, 2, 1, 2, 1, 2)), "torsion"),
}
LONE = {"forward": "^", "backward": "v", "planar": "o", "axial": ">", "torsion": "D"}
KNOWN = {
    "bending_frequency": ("D", ""),
    "mean_bending_frequency": ("s", ", mean of both whirls"),
    "torsion_frequency": ("^", ", torsion"),
}
Segments = dict[str, list[Array]]


@runtime_checkable
class Modes(Protocol):
    """Modes over speed: frequency [Hz] and whirl (speeds, modes), kind (modes,); ``stopped``:
    number of sleeves at their stops (speeds,)."""

    @property
    def speed(self) -> Array: ...
    @property
    def frequency(self) -> Array: ...
    @property
    def whirl(self) -> Array: ...
    @property
    def kind(self) -> Words: ...
    @property
    def stopped(self) -> Array: ...
    @property
    def mostly_overdamped(self) -> Flags: ...


def jumps(result: Modes) -> Flags:
    """Return flags of steps between speeds (speeds − 1, modes) over which a stop closes or opens
    and a frequency jumps: beyond its changes over both adjacent steps by ``JUMP`` of the larger."""
    step = np.diff(result.frequency, axis=0)
    padded = np.pad(step, ((1, 1), (0, 0)), constant_values=np.nan)
    adjacent = padded[:-2], padded[2:]
    low, high = (np.nan_to_num(extreme(*adjacent)) for extreme in (np.fmin, np.fmax))
    excess = np.maximum(low - step, step - high)
    least = np.maximum(JUMP * np.maximum(np.abs(low), np.abs(high)), 1e-4 * result.frequency[1:])
    stop_moves = np.abs(np.diff(result.stopped)) > 0.0
    return np.asarray(stop_moves[:, None] & (excess > least))


def whirl_segments(result: Modes) -> Segments:
    """Return curves of (rpm, Hz) by look; a mode is cut where its whirl changes or it jumps."""
    rpm = result.speed * RPM.factor
    segments: Segments = {}
    jump = jumps(result)
    for column in np.flatnonzero(~result.mostly_overdamped):
        kind = result.kind[column]
        frequency, whirl = result.frequency[:, column], result.whirl[:, column]
        looks = [look_of(kind, w) for w in whirl]
        if len(looks) > 1:
            looks[0] = looks[1]
        start = 0
        for end in range(1, len(looks) + 1):
            is_jump = end < len(looks) and jump[end - 1, column]
            if end == len(looks) or looks[end] != looks[start] or is_jump:
                continues = start > 0 and not jump[start - 1, column]
                first = start - 1 if continues else start
                curve = np.column_stack([rpm[first:end], frequency[first:end]])
                curve = curve[np.isfinite(curve).all(axis=1)]
                if curve.size:
                    segments.setdefault(looks[start], []).append(curve)
                start = end
    return segments


def draw_modes(axes: Axes, result: Modes, colour: str = "", width: float = 0.7) -> None:
    """Draw one collection of curves per look; all in ``colour`` and of ``width`` if given.

    With fewer than ``LEAST_SPEEDS`` speeds every frequency is a mark instead.
    """
    from matplotlib.collections import LineCollection

    curves = whirl_segments(result)
    few = len(result.speed) < LEAST_SPEEDS
    for look, (usual, dashes, label) in LOOKS.items():
        paths = [curve for curve in curves.get(look, ()) if len(curve) > 1 and not few]
        points = [curve for curve in curves.get(look, ()) if len(curve) == 1 or few]
        named = None if colour else label
        if points:
            dots = np.unique(np.concatenate(points), axis=0)
            dots = dots[dots[:, 1] <= axes.get_ylim()[1]]
            mark: dict[str, Any] = dict(ms=4.0, ls="none", clip_on=False, zorder=4 if few else 2)
            mark["label"] = None if paths else named
            axes.plot(*dots.T, marker=LONE[look], color=colour or usual, **mark)
        if paths:
            lines = LineCollection(
                paths,
                colors=colour or usual,
                linestyles=[dashes],
                linewidths=width if colour else 1.3,
                label=named,
                zorder=4,
            )
            axes.add_collection(lines, autolim=False)


def draw_stops(axes: Axes, result: Modes) -> None:
    """Shade steps between speeds over which a stop closes or opens and a frequency jumps."""
    if len(result.speed) < LEAST_SPEEDS:
        return
    rpm = result.speed * RPM.factor
    for step in np.flatnonzero(jumps(result).any(axis=1)):
        axes.axvspan(
            rpm[step], rpm[step + 1], color="#DDDDDD", lw=0.0, zorder=0.5, label="a stop closes"
        )


def draw_known(axes: Axes, references: Sequence[Reference], face: str = "none") -> None:
    """Draw published and measured frequencies within the axes: of one whirl, of both, of torsion;
    ``face``: colour of the marks, which are filled over an image."""
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
            mfc=face,
            mec=BLACK,
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
    """Return the first result that has modes over speed, or None."""
    return next((result for result in results.values() if isinstance(result, Modes)), None)
