"""Lines of quantities over speed by bearing, sleeve or model; markers of reference values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array
from rotordyn.figures.style import BLACK, line_of
from rotordyn.machine.reference import QUANTITIES, Reference
from rotordyn.results.display import RPM, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MARKERS = {"measured": ("o", "p", "8", "H"), "published": ("D", "s", "^", "v", "<", ">", "d", "h")}
_OTHERS = ("P", "X", "*")
EDGE = 0.02  # of the axis: margin for marks at its ends, which would cover labels of the other


def merged(names: Sequence[str], *drawn: Array) -> list[tuple[str, int]]:
    """Return different columns of the ``drawn`` arrays (…, names), equal columns named together:
    ``("a, b", 0)``."""
    values = np.concatenate([array.reshape(-1, len(names)) for array in drawn])
    groups: list[tuple[list[str], int]] = []
    for column, name in enumerate(names):
        for members, first in groups:
            if np.allclose(values[:, column], values[:, first], rtol=1e-6, equal_nan=True):
                members.append(name)
                break
        else:
            groups.append(([name], column))
    return [(", ".join(members), first) for members, first in groups]


def draw_columns(
    axes: Axes,
    rpm: Array,
    values: Array,
    names: Sequence[str],
    beside: Sequence[Array] = (),
    **style: Any,
) -> None:
    """Draw a line per column of ``values`` (speed, name), equal columns once; ``beside``: values
    drawn in other panels with the same names."""
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
    """Draw published and measured values of ``quantity`` up to ``top`` [rpm] as open markers, one
    shape for each kind and subject.

    ``subject``: whether labels name the subject; ``colours`` by subject, else black.
    """
    factor = shown(QUANTITIES[quantity]).factor
    chosen = [r for r in dict.fromkeys(references) if r.quantity == quantity]
    taken = {str(line.get_label()): line.get_marker() for line in axes.get_lines()}
    for reference in chosen:
        rpm = np.asarray(reference.speeds) * RPM.factor
        in_range = rpm <= top * (1.0 + 1e-9)
        if not in_range.any():
            continue
        owner = f" {reference.subject}".replace("_", " ").rstrip() if subject else ""
        name = f"{reference.kind}{owner}"
        if name not in taken:
            shapes = _MARKERS.get(reference.kind, _OTHERS)
            free = [shape for shape in shapes if shape not in taken.values()]
            taken[name] = (free or shapes)[0]
        axes.plot(
            rpm[in_range],
            np.asarray(reference.values)[in_range] * factor,
            marker=taken[name],
            mfc="none",
            mec=(colours or {}).get(reference.subject, BLACK),
            mew=1.1,
            ls="none",
            clip_on=False,
            zorder=6,
            label=name,
        )
        if top > 0.0 and (min(rpm[in_range]) <= 0.0 or max(rpm[in_range]) >= top * (1.0 - 1e-9)):
            axes.set_xlim(-EDGE * top, (1.0 + EDGE) * top)


def draw_runs(
    axes: Axes,
    x: Array,
    y: Array,
    key: NDArray[np.int_],
    **style: Any,
) -> None:
    """Draw a curve that is broken where the ``key`` of its points changes."""
    starts = np.flatnonzero(np.diff(key, prepend=key[0] - 1))
    for first, last in zip(starts, [*starts[1:], len(x)], strict=True):
        axes.plot(x[first:last], y[first:last], **style)
        style["label"] = None
