"""Figures: frequency responses between points, beside measured ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.analyses.frf.figures.slices import nearest_slice
from rotordyn.figures.draw import Job
from rotordyn.figures.labels import axis_label
from rotordyn.figures.mode_lines import modes_among
from rotordyn.figures.panels import ON_A_PAGE, Panel
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import RPM, shown
from rotordyn.results.frames import turning
from rotordyn.results.headline import Curve

code = partial(Code, __name__)

MOST_SLICES = 3


def figures(_: Described, result: Any, results: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    modes, count = modes_among(results), len(result.pair)
    if result.speed.size > 1 and result.frequency.size > 1:
        yield "frf_map", partial(code("map:map_figure"), result, [0], modes)
        if not _unbounded(result):
            yield "frf_surface", partial(code("surface:surface_figure"), result, 0)
        for first in range(1, count, ON_A_PAGE):
            pairs_on_page = list(range(first, min(first + ON_A_PAGE, count)))
            name = "frf_maps" + f"_{first // ON_A_PAGE + 1}" * (first > 1)
            yield name, partial(code("map:map_figure"), result, pairs_on_page, modes)
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


def _unbounded(result: Any) -> bool:
    """Whether the first pair has unbounded peaks: a surface would invent them between speeds."""
    return bool(np.isinf(result.peak_value[:, 0]).any())


def panels(_: Any, variants: Sequence[Shown]) -> Iterator[Panel]:
    """Small surfaces and maps of the first pair, all variants on a common scale."""
    first = variants[0].result
    if first.speed.size == 1 or first.frequency.size == 1:
        return
    limits = code("map:common_range")
    edges: dict[str, Any] = {"tall": 72.0, "margins": (1.0, 1.0, 2.0, 2.0), "gaps": (3.0, 2.0)}
    if not any(_unbounded(variant.result) for variant in variants):
        yield Panel("frf_surfaces", code("surface:draw_variant"), limits, **edges)
    scaled: dict[str, Any] = {"margins": (15.0, 20.0, 12.0, 9.0), "gaps": (14.0, 16.0)}
    yield Panel(
        "frf_maps", code("map:draw_variant"), limits, code("map:scale_of_variants"), **scaled
    )


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Amplitude over frequency of every pair at up to ``MOST_SLICES`` slice speeds, those nearest
    to measured responses first."""
    result = variant.result
    first = {nearest_slice(result, float(speed)) for speed in result.measured_speed}
    slices = [
        *first,
        *(k for k in np.flatnonzero(result.is_slice).tolist() if k not in first),
    ]
    x_label = axis_label(result, "frequency")
    for pair, name in enumerate(result.pair):
        number = f"_{pair + 1}" if len(result.pair) > 1 else ""
        unit = shown(result.unit(pair))
        for index in sorted(slices[:MOST_SLICES]):
            frequency, values = result.curve(index, pair)
            title = f"{result.kind} {name} at {result.speed[index] * RPM.factor:.0f} rpm"
            title += ", in the rotating frame" if turning(result) else ""
            look: dict[str, Any] = {"along": x_label, "title": title, "log": True}
            size = np.abs(values) * unit.factor
            curve = Curve(f"frf_curves{number}", "amplitude", unit.unit, frequency, size, **look)
            yield curve
            yield from _measured(curve, result, pair, index)


def _measured(curve: Curve, result: Any, pair: int, index: int) -> Iterator[Curve]:
    """Measured responses of a pair whose nearest slice speed is ``index``, as curves."""
    for row, name in enumerate(result.measured):
        speed, x = float(result.measured_speed[row]), result.measured_frequency[row]
        if (result.measured_pair[row], nearest_slice(result, speed)) != (result.pair[pair], index):
            continue
        inside = (x >= result.frequency[0]) & (x <= result.frequency[-1])
        size = np.abs(result.measured_response[row, inside]) * shown(result.unit(pair)).factor
        series = f"{name}, measured at {speed * RPM.factor:.0f} rpm"
        common = bool(np.isnan(result.measured_error[row]))  # unlike a tip coupled to the tool
        yield curve._replace(x=x[inside], y=size, series=series, backdrop=common)
