"""Figures: frequency responses between points, beside measured ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.mode_lines import modes_among
from rotordyn.figures.panels import MOST_PANELS, Shown
from rotordyn.results.described import Described

code = partial(Code, __name__)


def figures(_: Described, result: Any, results: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    modes, count = modes_among(results), len(result.pair)
    if result.speed.size > 1 and result.frequency.size > 1:
        yield "frf_map", partial(code("map:map_figure"), result, [0], modes)
        yield "frf_surface", partial(code("surface:surface_figure"), result, 0)
        if count > 1:
            others = list(range(1, count))
            yield "frf_maps", partial(code("map:map_figure"), result, others, modes)
    for first in range(0, count if len(result.line) else 0, 2):
        pairs = list(range(first, min(first + 2, count)))
        number = f"_{first // 2 + 1}" if count > 2 else ""
        yield f"frf_engine_orders{number}", partial(code("orders:orders_figure"), result, pairs)
    if not np.any(result.is_slice):
        return
    for first in range(0, count, 2):
        pairs = list(range(first, min(first + 2, count)))
        number = f"_{first // 2 + 1}" if count > 2 else ""
        for kind in ("amplitude_phase", "real_imaginary"):
            draw = partial(code(f"slices:{kind}_figure"), result, pairs)
            yield f"frf_{kind}{number}", draw


def of_variants(_: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """The figures of variants."""
    first = shown[0].result
    few, swept = len(shown) <= MOST_PANELS, first.speed.size > 1 and first.frequency.size > 1
    if few and swept:
        yield "frf_surfaces", partial(code("compared:surfaces_figure"), shown, 0)
        yield "frf_maps", partial(code("compared:maps_figure"), shown, 0)
    if np.any(first.is_slice):
        for pair in range(len(first.pair)):
            number = f"_{pair + 1}" if len(first.pair) > 1 else ""
            yield f"frf_curves{number}", partial(code("compared:curves_figure"), shown, pair)
