"""Responses along the lines of engine orders: at n times the speed of a rotor, over speed."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.arrays import Array, Complex
from rotordyn.machine.support import SPINDLE
from rotordyn.modes.criticals import criticals_up_to
from rotordyn.modes.excitation import Line, exciting
from rotordyn.numerics.peaks import tops
from rotordyn.scene.sampling import over_speed
from rotordyn.scene.scene import Scene

Responses = Callable[[Scene, Array], Complex]


def lines_of(scene: Scene, spec: FrfSpec) -> list[Line]:
    """The lines of the engine orders of every rotor that turns."""
    return exciting(scene.spindle.ratios, spec.engine_orders)


def line_fields(
    scene: Scene, spec: FrfSpec, responses: Responses, at_few: Responses
) -> dict[str, Any]:
    """Fields of a result for the engine orders ``spec.engine_orders``.

    ``responses``: those (usable, pairs, n) of a scene at frequencies (usable, n) [Hz], a row per
    usable speed; ``at_few``: likewise, for so few frequencies per speed that modes do not pay.
    """
    lines, pairs = lines_of(scene, spec), len(spec.pairs)
    hertz = [line.size * scene.speed / (2.0 * math.pi) for line in lines]
    frequency = np.array(hertz).reshape(len(lines), len(scene.speed)).T
    value = np.zeros((len(scene.usable), pairs, len(lines)), dtype=complex)
    curves: list[tuple[Array, Complex]] = []
    if lines:
        line_frequency = zip(lines, frequency[scene.usable].T, strict=True)
        by_line = [responses(scene.whirling(one.size), at[:, None]) for one, at in line_frequency]
        value = np.concatenate(by_line, axis=2)
        curves = [_curve(scene, line, at_few, *peaks) for line, *peaks in _expected(scene, lines)]
    longest = max((len(speed) for speed, _ in curves), default=0)
    peak_steps = [[tops(np.abs(values)) for values in curve.T] for _, curve in curves]
    most_peaks = max((len(top) for by_pair in peak_steps for top in by_pair), default=0)
    speed = np.full((len(lines), longest), np.nan)
    curve = np.full((len(lines), longest, pairs), complex(np.nan, np.nan))
    peak_at = np.full((len(lines), pairs, most_peaks), np.nan)
    peak = np.full((len(lines), pairs, most_peaks), complex(np.nan, np.nan))
    for row, (along, response) in enumerate(curves):
        speed[row, : len(along)], curve[row, : len(along)] = along, response
        for pair, top in enumerate(peak_steps[row]):
            peak_at[row, pair, : len(top)], peak[row, pair, : len(top)] = (
                along[top],
                response[top, pair],
            )
    return {
        "line": tuple(_called(line) for line in lines),
        "line_rotor": tuple(line.rotor for line in lines),
        "line_order": np.array([line.order for line in lines]),
        "line_frequency": frequency,
        "line_value": scene.scattered(np.swapaxes(value, 1, 2)),
        "step": np.arange(longest),
        "line_speed": speed,
        "line_curve": curve,
        "crossing": np.arange(1, most_peaks + 1),
        "line_peak_speed": peak_at,
        "line_peak_value": peak,
    }


def _called(line: Line) -> str:
    """Name of a line, with its rotor unless that is the spindle.

    >>> _called(Line("spindle", 2.0, 2.0)), _called(Line("outer", 1.0, 1.5))
    ('2×', '1× outer')
    """
    return line.name if line.rotor == SPINDLE else f"{line.name} {line.rotor}"


def _expected(scene: Scene, lines: list[Line]) -> list[tuple[Line, Array, Array]]:
    """Lines with the speeds and half widths [rad/s] of the peaks expected on each."""
    size, orders = max(line.size for line in lines), [line.order for line in lines]
    critical = criticals_up_to(scene, size, orders)
    expected = []
    for line in lines:
        crossings = [peak for peak in critical if peak.line == line]
        speed = np.array([peak.speed for peak in crossings])
        expected.append((line, speed, speed * np.abs([peak.damping_ratio for peak in crossings])))
    return expected


def _curve(
    scene: Scene, line: Line, responses: Responses, centres: Array, widths: Array
) -> tuple[Array, Complex]:
    """Speeds (n,) and responses (n, pairs) along a line."""

    def values(other: Scene) -> list[Complex]:
        hertz = line.size * other.speed[other.usable] / (2.0 * math.pi)
        return [responses(other.whirling(line.size), hertz[:, None])[..., 0]]

    speed, curves = over_speed(scene, values, lambda arrays: np.abs(arrays[0]), centres, widths)
    return speed, np.asarray(curves[0])
