"""Curves of variants by the panel in which they lie over one another, and how they differ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotordyn.figures.amplitudes import log_axis
from rotordyn.results.headline import Curve, Known, under
from rotordyn.results.kinds import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BEYOND = "beyond the axis"  # of triangles at its edge
ALIKE = 1e-9  # of the largest value: no difference


class Layer(NamedTuple):
    """A curve of the variant at a ``place``."""

    place: int
    curve: Curve


class Group(NamedTuple):
    """What one panel shows.

    ``layers`` of all variants; their ``changes`` against the first one, none where all are alike;
    the ``backdrop`` that is the same for all.
    """

    layers: Sequence[Layer]
    changes: Sequence[Layer]
    backdrop: Sequence[Curve]

    @property
    def first(self) -> Curve:
        """The curve by which the panel is labelled."""
        return self.layers[0].curve

    @property
    def ceiling(self) -> float:
        """Above it values lie beyond the axis."""
        return max(layer.curve.ceiling for layer in self.layers)

    @property
    def known(self) -> set[Known]:
        """The references that are shown beside its curves."""
        return {layer.curve.known for layer in self.layers if layer.curve.known}


def groups_of(sets: Sequence[Sequence[Curve]]) -> list[Group]:
    """The curves of every variant by panel, label, title and abscissa, in the order of these."""
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
    """Scale and limits of the ordinate that a curve asks for; room above where it gives the bottom
    alone."""
    if curve.log:
        log_axis(axes)
    bottom, top = curve.limits
    if top is None and bottom is not None:
        top = axes.get_ylim()[1] * 1.05
    axes.set_ylim(bottom, top)


def _changes(layers: Sequence[Layer]) -> list[Layer]:
    """The curves of further variants less those of the first; none where all are alike."""
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
    """A curve less the first one; its axis holds differences of what lies within theirs."""
    with np.errstate(invalid="ignore"):
        change = curve.y - first.y
    if np.isinf(ceiling):
        return curve._replace(y=change)
    within = under(curve.y, ceiling) - under(first.y, ceiling)
    return curve._replace(y=change, ceiling=_largest(within))


def _largest(values: Array) -> float:
    return float(np.nanmax(np.abs(values), initial=0.0))
