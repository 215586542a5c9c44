"""Curves of variants grouped by panel, and their differences from the first variant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotordyn.arrays import Array
from rotordyn.figures.amplitudes import log_axis
from rotordyn.results.headline import Curve, Known, under

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BEYOND = "beyond the axis"  # label of triangles at its edge
ALIKE = 1e-9  # of the largest value: smaller differences are none


class Layer(NamedTuple):
    """A curve of the variant at index ``place``."""

    place: int
    curve: Curve


class Group(NamedTuple):
    """Curves of one panel.

    ``layers`` of all variants; their ``changes`` from the first one, none if all are equal; the
    ``backdrop`` that is the same for all.
    """

    layers: Sequence[Layer]
    changes: Sequence[Layer]
    backdrop: Sequence[Curve]

    @property
    def first(self) -> Curve:
        """Curve that gives the labels of the panel."""
        return self.layers[0].curve

    @property
    def ceiling(self) -> float:
        """Largest value on the axis; curves above it are cut off."""
        return max(layer.curve.ceiling for layer in self.layers)

    @property
    def known(self) -> set[Known]:
        """References that are drawn with the curves."""
        return {layer.curve.known for layer in self.layers if layer.curve.known}


def groups_of(sets: Sequence[Sequence[Curve]]) -> list[Group]:
    """Group the curves of all variants by panel, label, title and abscissa, in order."""
    layers: dict[tuple[str, ...], list[Layer]] = {}
    behind: dict[tuple[str, ...], list[Curve]] = {}
    for place, curves in enumerate(sets):
        for curve in curves:
            key = curve.panel, curve.label, curve.title, curve.along
            if not curve.backdrop:
                layers.setdefault(key, []).append(Layer(place, curve))
            elif place == 0:
                behind.setdefault(key, []).append(curve)
    return [Group(each, _changes(each), behind.get(key, [])) for key, each in layers.items()]


def limit_ordinate(axes: Axes, curve: Curve) -> None:
    """Set scale and limits of the ordinate given by a curve; with a lower limit only, leave room
    at the top."""
    if curve.log:
        log_axis(axes)
    bottom, top = curve.limits
    if top is None and bottom is not None:
        top = axes.get_ylim()[1] * 1.05
    axes.set_ylim(bottom, top)


def _changes(layers: Sequence[Layer]) -> list[Layer]:
    """Return the curves of further variants minus those of the first; none if all are equal."""
    ceiling = max(curve.ceiling for _, curve in layers)
    base = {c.key or c.series: c for place, c in layers if place == 0}
    changes = []
    for place, curve in layers:
        first = base.get(curve.key or curve.series)
        if not place or curve.log or first is None or len(curve.x) < 2:
            continue
        if np.array_equal(first.x, curve.x):
            changes.append(Layer(place, _change(curve, first, ceiling)))
    size = max((_largest(c.y[np.isfinite(c.y)]) for c in base.values()), default=0.0)
    largest = max((_largest(layer.curve.y) for layer in changes), default=0.0)
    return changes if largest > ALIKE * size else []


def _change(curve: Curve, first: Curve, ceiling: float) -> Curve:
    """Return a curve minus the first one; its ceiling is that of differences within theirs."""
    with np.errstate(invalid="ignore"):
        change = curve.y - first.y
    if np.isinf(ceiling):
        return curve._replace(y=change)
    within = under(curve.y, ceiling) - under(first.y, ceiling)
    return curve._replace(y=change, ceiling=_largest(within))


def _largest(values: Array) -> float:
    return float(np.nanmax(np.abs(values), initial=0.0))
