"""Sag and runout of the nose in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.static_sag.result import MICRORADIAN, StaticSagResult
from rotordyn.arrays import Array
from rotordyn.results.described import Described
from rotordyn.results.display import MICROMETRE, RPM, number
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.text import unbroken
from rotordyn.scene.linearity import not_small


def summary(result: StaticSagResult) -> list[str]:
    """Sag and runout at the slowest speed with a solution, at which they are measured."""
    row = _slowest(result)
    slope = _both(result, result.slope[row] * MICRORADIAN.factor)
    sag = ", ".join(_at_gauges(result, row, result.sag))
    at = f" at {result.speed[row] * RPM.factor:.0f} rpm" if len(result.speed) > 1 else ""
    lines = [f"sag        of {result.point} by weight{at} [µm] {sag}; slope [µrad] {slope}"]
    if result.ring:
        runout = ", ".join(_at_gauges(result, row, result.runout))
        highest = ", ".join(_at_gauges(result, row, result.highest_runout))
        lines += [
            f"runout     of {result.point}, full reading of a gauge [µm] {runout}; with the rings "
            f"at other angles up to {highest}",
            "           the sag does not rotate: it shifts the reading and is not part of the "
            "runout",
        ]
    return lines


def numbers(result: StaticSagResult, _: Described) -> Iterator[Number]:
    """Sag at the first gauge and slope, each along the weight, and runout, at the first and the
    last speed."""
    for name, values, printed in (
        ("sag", result.sag[:, 0], MICROMETRE),
        ("slope", result.slope, MICRORADIAN),
    ):
        down = values @ result.weight * printed.factor
        yield from each_speed(result, f"{name} along the weight", printed.unit, down, digits=2)
    if result.ring:
        runout = result.runout[:, 0].max(axis=1) * MICROMETRE.factor
        yield from each_speed(result, "runout", MICROMETRE.unit, runout, digits=2)


def warnings(result: StaticSagResult) -> list[str]:
    """Warnings of rings assumed to run true, of a machine not at rest, of large deflections."""
    sentences = []
    if result.ring and result.true_ring:
        sentences.append(
            f"runout of {result.point}: no ring runout is given for bearings "
            f"{', '.join(result.true_ring)}, which are assumed to run true: give theirs"
        )
    slow = float(result.speed[_slowest(result)])
    if slow > 0.0 and result.follows_speed:
        sentences.append(
            f"sag of {result.point}: the slowest speed solved is {slow * RPM.factor:.0f} rpm, "
            "where bearings are not as stiff as at rest, at which sag and runout are measured: add "
            "0 rpm"
        )
    difference = np.diff(result.deflection, axis=1)
    length = np.diff(result.station)[:, None]
    inclined = np.divide(difference, length, out=np.zeros_like(difference), where=length > 0.0)
    return [*sentences, *not_small(f"sag of {result.point}", result.speed, inclined)]


def _slowest(result: StaticSagResult) -> int:
    return int(np.flatnonzero(np.isfinite(result.slope).all(axis=1))[0])


def _at_gauges(result: StaticSagResult, row: int, values: Array) -> Iterator[str]:
    """y and z at each gauge, which is named where it is not at the point."""
    for gauge, value in zip(result.gauge, values[row] * MICROMETRE.factor, strict=True):
        side = "in front" if gauge > 0.0 else "behind"
        at = f" {abs(gauge) * 1e3:g} mm {side}" if gauge else ""
        yield unbroken(f"{_both(result, value)}{at}")


def _both(result: StaticSagResult, values: Array) -> str:
    by_direction = zip(result.direction, values, strict=True)
    return unbroken(" ".join(f"{name} {_number(float(value))}" for name, value in by_direction))


def _number(value: float) -> str:
    """Two decimals, rounding as zero."""
    return number(0.0 if abs(value) < 1e-6 else value, 2)
