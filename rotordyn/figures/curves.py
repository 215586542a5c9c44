"""Quantities over speed: one line per bearing, sleeve or model, known values as markers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.figures.style import BLACK, line_of
from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MARKERS = {"measured": ("o", "p", "8", "H"), "published": ("D", "s", "^", "v", "<", ">", "d", "h")}
_OTHERS = ("P", "X", "*")
EDGE = 0.02  # of the axis: room beside marks at its ends, which lie on numbers of the other else


def merged(names: Sequence[str], *drawn: NDArray[np.float64]) -> list[tuple[str, int]]:
    """Columns of all that is ``drawn`` (…, names) that differ, those alike named together:
    ``("a, b", 0)``."""
    values = np.concatenate([each.reshape(-1, len(names)) for each in drawn])
    groups: list[tuple[list[str], int]] = []
    for column, name in enumerate(names):
        for known, first in groups:
            if np.allclose(values[:, column], values[:, first], rtol=1e-6, equal_nan=True):
                known.append(name)
                break
        else:
            groups.append(([name], column))
    return [(", ".join(known), first) for known, first in groups]


def draw_columns(
    axes: Axes,
    rpm: NDArray[np.float64],
    values: NDArray[np.float64],
    names: Sequence[str],
    beside: Sequence[NDArray[np.float64]] = (),
    **style: Any,
) -> None:
    """A line per column of ``values`` (speed, name), columns alike drawn once; ``beside``: what is
    drawn in other panels under the same names."""
    for name, column in merged(names, values, *beside):
        axes.plot(rpm, values[:, column], **{**line_of(column), "label": name, **style})


def draw_references(
    axes: Axes,
    references: Sequence[Reference],
    quantity: str,
    top: float,
    *,
    subject: bool = False,
    colours: Mapping[str, str] | None = None,
) -> None:
    """Published and measured values of ``quantity`` up to ``top`` [rpm] as open markers, one shape
    for each kind and subject.

    ``subject``: the label says what the values belong to; ``colours`` by subject, else black.
    """
    factor = shown(QUANTITIES[quantity]).factor
    chosen = [r for r in dict.fromkeys(references) if r.quantity == quantity]
    taken = {str(line.get_label()): line.get_marker() for line in axes.get_lines()}
    for reference in chosen:
        rpm = np.asarray(reference.speeds) * RPM.factor
        shown_here = rpm <= top * (1.0 + 1e-9)
        if not shown_here.any():
            continue
        whose = f" {reference.subject}".replace("_", " ").rstrip() if subject else ""
        name = f"{reference.kind}{whose}"
        if name not in taken:
            shapes = _MARKERS.get(reference.kind, _OTHERS)
            free = [shape for shape in shapes if shape not in taken.values()]
            taken[name] = (free or shapes)[0]
        axes.plot(
            rpm[shown_here],
            np.asarray(reference.values)[shown_here] * factor,
            marker=taken[name],
            mfc="none",
            mec=(colours or {}).get(reference.subject, BLACK),
            mew=1.1,
            ls="none",
            clip_on=False,
            zorder=6,
            label=name,
        )
        if top > 0.0 and (
            min(rpm[shown_here]) <= 0.0 or max(rpm[shown_here]) >= top * (1.0 - 1e-9)
        ):
            axes.set_xlim(-EDGE * top, (1.0 + EDGE) * top)


def draw_runs(
    axes: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    key: NDArray[np.int_],
    **style: Any,
) -> None:
    """A curve that is broken wherever ``key``, what its points belong to, changes."""
    starts = np.flatnonzero(np.diff(key, prepend=key[0] - 1))
    for first, last in zip(starts, [*starts[1:], len(x)], strict=True):
        axes.plot(x[first:last], y[first:last], **style)
        style["label"] = None
