"""Quantities over speed: one line per bearing, sleeve or model, known values as markers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.figures.style import BLACK, CYCLE, DASHES
from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MARKER = {"measured": "o", "published": "D"}


def merged(names: Sequence[str], values: NDArray[np.float64]) -> list[tuple[str, int]]:
    """Columns that differ, those alike named together: ``("a, b", 0)``."""
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
    **style: Any,
) -> None:
    """A line per column of ``values`` (speed, name), columns alike drawn once."""
    for name, column in merged(names, values):
        axes.plot(
            rpm,
            values[:, column],
            **{
                "color": CYCLE[column % len(CYCLE)],
                "ls": DASHES[column % len(DASHES)],
                "label": name,
                **style,
            },
        )


def draw_references(
    axes: Axes,
    references: Sequence[Reference],
    quantity: str,
    top: float,
    *,
    subject: bool = False,
    colours: Mapping[str, str] | None = None,
) -> None:
    """Published and measured values of ``quantity`` up to ``top`` [rpm] as open markers.

    ``subject``: the label says what the values belong to; ``colours`` by subject, else black.
    """
    factor = shown(QUANTITIES[quantity]).factor
    chosen = [r for r in dict.fromkeys(references) if r.quantity == quantity]
    for reference in chosen:
        rpm = np.asarray(reference.speeds) * RPM.factor
        shown_here = rpm <= top * (1.0 + 1e-9)
        if not shown_here.any():
            continue
        whose = f" {reference.subject}".replace("_", " ").rstrip() if subject else ""
        axes.plot(
            rpm[shown_here],
            np.asarray(reference.values)[shown_here] * factor,
            _MARKER.get(reference.kind, "s"),
            mfc="none",
            mec=(colours or {}).get(reference.subject, BLACK),
            mew=1.1,
            ls="none",
            clip_on=False,
            zorder=6,
            label=f"{reference.kind}{whose}",
        )


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
