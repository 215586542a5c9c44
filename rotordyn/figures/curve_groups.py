"""Curves of variants by the panel in which they lie over one another, and how they differ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rotordyn.figures.amplitudes import log_axis
from rotordyn.results.headline import Curve, Known

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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
    def known(self) -> set[Known]:
        """The references that are shown beside its curves."""
        return {layer.curve.known for layer in self.layers if layer.curve.known}


def groups_of(sets: Sequence[Sequence[Curve]]) -> list[Group]:
    """The curves of every variant by panel, label and title, in the order in which these come."""
    layers: dict[tuple[str, str, str], list[Layer]] = {}
    behind: dict[tuple[str, str, str], list[Curve]] = {}
    for place, curves in enumerate(sets):
        for curve in curves:
            key = curve.panel, curve.label, curve.title
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
    base = {c.key or c.series: c for place, c in layers if place == 0}
    changes = []
    for place, curve in layers:
        first = base.get(curve.key or curve.series)
        if not place or curve.log or first is None or len(curve.x) < 2:
            continue
        if np.array_equal(first.x, curve.x):
            changes.append(Layer(place, curve._replace(y=curve.y - first.y)))
    size, largest = (
        max((float(np.nanmax(np.abs(c.y), initial=0.0)) for c in each), default=0.0)
        for each in (base.values(), [layer.curve for layer in changes])
    )
    return changes if largest > ALIKE * size else []
