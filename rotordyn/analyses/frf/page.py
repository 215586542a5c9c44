"""Blocks of a page: responses over frequency by speed, a map to rotate, measured responses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.frf.figures.decimate import nearest, peak_bins
from rotordyn.analyses.frf.figures.map import amplitude, amplitude_range, with_peaks
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.frf.summary import speeds_compared
from rotordyn.arrays import Array, Complex
from rotordyn.figures.amplitudes import wrapped_phase
from rotordyn.page.blocks import Block, Chart, Control, Markup, Table
from rotordyn.page.looks import INK, axis, line, logarithmic
from rotordyn.page.packed import rounded
from rotordyn.results.declaration import declared
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, number, shown

MOST_VALUES = 300_000  # of all responses of a page
MOST_VARIANTS = 6  # in one chart
MAP = (60, 240)  # most speeds and frequencies of a map


def page(spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    """Responses of all variants at a chosen speed, map of a chosen one, measured ones, peaks."""
    drawn = [v for v in variants[:MOST_VARIANTS] if _is_comparable(v.result, variants[0].result)]
    first: FrequencyResponse = drawn[0].result
    yield _responses(drawn)
    if first.speed.size > 1 and first.frequency.size > 1:
        yield _map(drawn)
    for variant in drawn:
        title = f"{variant.title}: " if len(drawn) > 1 else ""
        yield from _measured(variant.result, title)
    yield _peaks(drawn)


def _is_comparable(result: FrequencyResponse, first: FrequencyResponse) -> bool:
    return result.pair == first.pair and np.array_equal(result.speed, first.speed)


def _responses(variants: Sequence[Shown]) -> Chart:
    first: FrequencyResponse = variants[0].result
    speeds, pairs = len(first.speed), len(first.pair)
    most_points = MOST_VALUES // (2 * len(variants) * speeds * pairs)
    traces: list[dict[str, Any]] = []
    for place, variant in enumerate(variants):
        x, values = _sampled(variant.result, max(most_points, 100))
        name = variant.title if len(variants) > 1 else "amplitude"
        parts = {"y": np.abs(values), "y2": _phase(values)}
        for part, y in parts.items():
            moving = {"x": x, "y": rounded(y)}
            looks = line(place, place if len(variants) > 1 else 0)
            trace = {"mode": "lines", "line": looks, "moving": moving, "yaxis": part}
            names = {"name": name if part == "y" else f"{name}, phase", "legendgroup": name}
            traces.append(trace | names | {"showlegend": len(variants) > 1 and part == "y"})
    captions = [
        _captions(variants, speed, pair) for pair in range(pairs) for speed in range(speeds)
    ]
    layout = {
        "xaxis": axis(
            declared(first)["frequency"].metadata["label"], "Hz", anchor="y2", showspikes=True
        )
        | {"spikemode": "across", "spikethickness": 1, "spikecolor": INK, "spikedash": "solid"},
        "yaxis": logarithmic("amplitude", _units(first)[0]) | {"domain": [0.36, 1.0]},
        "yaxis2": axis("phase", "deg", domain=[0.0, 0.28], dtick=90, range=[-185, 185]),
        "hovermode": "x unified",
        "moving": {"yaxis.title.text": _moving(first, "amplitude")},
    }
    return Chart(
        f"{first.kind.capitalize()} over frequency",
        traces,
        layout,
        [_pairs(first), Control("speed", _speeds(first), slider=True)],
        captions,
        note="Move the pointer over the chart to read values.",
        wide=True,
        tall=560,
    )


def _pairs(result: FrequencyResponse) -> Control:
    return Control("response / excitation", result.pair)


def _speeds(result: FrequencyResponse) -> list[str]:
    return [f"{rpm:.0f} rpm" for rpm in result.speed * RPM.factor]


def _units(result: FrequencyResponse) -> list[str]:
    return [shown(result.unit(k)).unit for k in range(len(result.pair))]


def _moving(result: FrequencyResponse, label: str, by: int = 0) -> dict[str, Any]:
    """Title of an axis with the unit of the pair chosen by control number ``by``."""
    return {"by": (by,), "values": [f"{label} [{unit}]" for unit in _units(result)]}


def _captions(variants: Sequence[Shown], speed: int, pair: int) -> str:
    parts = [_caption(variant.result, speed, pair) for variant in variants]
    if len(parts) == 1:
        return parts[0]
    return " ".join(
        f"{variant.title}: {part}" for variant, part in zip(variants, parts, strict=True)
    )


def _caption(result: FrequencyResponse, speed: int, pair: int) -> str:
    """Caption of a response at one speed: its peaks, or why it is not solved."""
    if result.outcome[speed]:
        return f"Not solved: {result.outcome[speed]}."
    at = result.peak_frequency[speed, pair]
    size = np.abs(result.peak_value[speed, pair]) * shown(result.unit(pair)).factor
    texts = [
        f"{number(hertz)} Hz ({height:.3g})"
        if np.isfinite(height)
        else f"{number(hertz)} Hz (unbounded)"
        for hertz, height in zip(at, size, strict=True)
        if np.isfinite(hertz)
    ]
    peaks = f"Peaks [{shown(result.unit(pair)).unit}]: {', '.join(texts)}." if texts else "No peak."
    unstable = "The machine is unstable at this speed: the steady response is not reached. "
    return (unstable if result.unstable[speed] else "") + peaks


def _sampled(result: FrequencyResponse, most_points: int) -> tuple[Array, Complex]:
    """Frequencies and printed values (pairs, speeds, points), peaks included.

    Of the frequencies of the case every n-th is kept, and all of them adjacent to peaks.
    """
    frequency, step = result.frequency, max(1, -(-len(result.frequency) // most_points))
    extra = _about_peaks(result)
    grid = frequency[::step]
    x = np.empty((len(result.pair), len(result.speed), len(grid) + extra.shape[-1]))
    values = np.full(x.shape, np.nan + 0j)
    for pair in range(len(result.pair)):
        factor = shown(result.unit(pair)).factor
        for speed in range(len(result.speed)):
            at = np.concatenate([grid, extra[speed, pair]])
            response = result.response[speed, pair]
            y = np.interp(at, frequency, response.real) + 1j * np.interp(
                at, frequency, response.imag
            )
            peaks, heights = result.peak_frequency[speed, pair], result.peak_value[speed, pair]
            for hertz, height in zip(peaks, heights, strict=True):
                if np.isfinite(hertz) and np.isfinite(height):
                    y[at == hertz] = height
            order = np.argsort(at)
            x[pair, speed], values[pair, speed] = at[order], y[order] * factor
    return x, values


def _about_peaks(result: FrequencyResponse) -> Array:
    """Frequencies of the case around peaks, and of the peaks (speeds, pairs, points), else NaN."""
    peaks = result.peak_frequency
    index = np.searchsorted(result.frequency, np.nan_to_num(peaks))
    neighbours = np.clip(index[..., None] + np.arange(-6, 6), 0, len(result.frequency) - 1)
    around = np.where(np.isfinite(peaks)[..., None], result.frequency[neighbours], np.nan)
    return np.concatenate([around.reshape(*peaks.shape[:2], -1), peaks], axis=-1)


def _phase(values: Complex) -> Array:
    """Phase [deg], broken where it wraps; NaN where the response is zero."""
    with np.errstate(invalid="ignore"):
        phase = np.degrees(np.angle(np.where(values == 0.0, np.nan, values)))
    return np.apply_along_axis(wrapped_phase, -1, phase)


def _map(variants: Sequence[Shown]) -> Chart:
    first: FrequencyResponse = variants[0].result
    rpm = np.linspace(first.speed[0], first.speed[-1], min(MAP[0], len(first.speed)))
    edges = np.linspace(first.frequency[0], first.frequency[-1] * (1.0 + 1e-12), MAP[1] + 1)
    heights = np.array(
        [[_height(v.result, pair, edges, rpm) for pair in range(len(first.pair))] for v in variants]
    )
    trace = {
        "type": "surface",
        "x": (edges[1:] + edges[:-1]) / 2.0,
        "y": rpm * RPM.factor,
        "moving": {"z": rounded(heights), "surfacecolor": rounded(np.log10(heights))},
        "colorscale": "Viridis",
        "showscale": False,
        "hovertemplate": Markup("%{x:.0f} Hz, %{y:.0f} rpm<br>%{z:.3g}<extra></extra>"),
    }
    scene = {
        "xaxis": axis("frequency", "Hz", autorange="reversed"),
        "yaxis": axis("speed", "rpm"),
        "zaxis": logarithmic("|H|", _units(first)[0]),
        "camera": {"eye": {"x": 1.2, "y": -1.9, "z": 1.1}, "center": {"x": 0, "y": 0, "z": -0.2}},
        "aspectratio": {"x": 1.5, "y": 1.2, "z": 0.7},
    }
    layout = {
        "scene": scene,
        "margin": {"l": 0, "r": 0, "t": 0, "b": 0},
        "moving": {"scene.zaxis.title.text": _moving(first, "|H|", by=1)},
    }
    controls = [Control("variant", [v.title for v in variants]), _pairs(first)]
    return Chart("Map over speed and frequency", [trace], layout, controls, wide=True, tall=520)


def _height(result: FrequencyResponse, pair: int, edges: Array, speed: Array) -> Array:
    """|H| (speeds, bins) as printed, within the range of a figure."""
    values = peak_bins(amplitude(result, pair), result.frequency, edges)
    values = with_peaks(values, result, pair, edges)
    low, high = amplitude_range(values)
    return np.clip(nearest(values, result.speed, speed), low, high)


def _measured(result: FrequencyResponse, title: str) -> Iterator[Block]:
    """Chart of every measured response over the computed one at the nearest speed."""
    if not result.measured:
        return
    measured, computed, frequency = [], [], result.frequency
    for row, pair in enumerate(result.measured_pair):
        k, speed = (
            result.pair.index(pair),
            int(np.abs(result.speed - result.measured_speed[row]).argmin()),
        )
        factor = shown(result.unit(k)).factor
        measured.append(np.abs(result.measured_response[row]) * factor)
        computed.append(np.abs(result.response[speed, k]) * factor)
    marks = {"color": INK, "size": 4, "symbol": "circle-open"}
    traces: list[dict[str, Any]] = [
        {"x": frequency, "name": "computed", "mode": "lines", "line": line(0)}
        | {"moving": {"y": np.array(computed)}},
        {"name": "measured", "mode": "markers", "marker": marks}
        | {"moving": {"x": result.measured_frequency, "y": np.array(measured)}},
    ]
    unit = _units(result)[result.pair.index(result.measured_pair[0])]
    layout = {"xaxis": axis("frequency", "Hz"), "yaxis": logarithmic("amplitude", unit)}
    captions = [
        f"{result.kind} {result.measured_pair[k]} at {speeds_compared(result, k)}"
        + (f"; FRAC {result.frac[k]:.3f}" if np.isfinite(result.frac[k]) else "")
        for k in range(len(result.measured))
    ]
    controls = [Control("measured response", result.measured)]
    yield Chart(
        f"{title}measured and computed" if title else "Measured and computed",
        traces,
        layout,
        controls,
        captions,
        wide=True,
        tall=420,
    )


def _peaks(variants: Sequence[Shown]) -> Table:
    """Table of the highest peak of every pair."""
    rows = []
    for variant in variants:
        result: FrequencyResponse = variant.result
        for pair, name in enumerate(result.pair):
            size = np.abs(result.peak_value[:, pair])
            if not np.isfinite(size).any():
                continue
            row, place = np.unravel_index(np.nanargmax(size), size.shape)
            unit = shown(result.unit(pair))
            rows.append(
                [
                    f"{variant.title}, {name}" if len(variants) > 1 else name,
                    f"{size[row, place] * unit.factor:.4g} {unit.unit}",
                    number(float(result.peak_frequency[row, pair, place])),
                    number(float(result.speed[row] * RPM.factor), 0),
                ]
            )
    heads = ["response / excitation", "highest peak", "frequency [Hz]", "speed [rpm]"]
    return Table("Highest peaks", heads, rows)
