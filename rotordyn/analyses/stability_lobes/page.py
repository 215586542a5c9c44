"""Report page of stability lobes: charts of limits, chatter and planned cut, table of pockets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.stability_lobes.figures import LIMITS, headline_curves
from rotordyn.analyses.stability_lobes.result import REMOVAL, banded
from rotordyn.analyses.stability_lobes.spec import REPEATING
from rotordyn.page.blocks import Block, Table
from rotordyn.page.curves import curve_charts
from rotordyn.page.declared import declared_blocks
from rotordyn.results.described import Shown
from rotordyn.results.display import MICROMETRE, MILLIMETRE, RPM, number
from rotordyn.results.headline import Curve


def page(spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    """Yield charts; of a single speed, declared values. Of one machine, a table of its pockets."""
    curves = _alone if len(variants) == 1 else _compared
    yield from list(curve_charts(curves, spec, variants)) or declared_blocks(variants)
    if len(variants) == 1:
        yield from _pockets(variants[0].result)


def _compared(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Yield the headline curves and the limit of the motor."""
    result = variant.result
    for curve in headline_curves(spec, variant):
        yield curve
        if result.motor and curve.figure == LIMITS and not curve.series:
            depth = result.motor_depth * MILLIMETRE.factor
            yield curve._replace(y=depth, series=f"limit of the motor ({result.motor})")


def _alone(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Yield curves of one machine: further limits, chatter frequencies, and the vibration and
    largest force of a planned cut."""
    result = variant.result
    for curve in _compared(spec, variant):
        yield curve
        if curve.figure == LIMITS and not curve.series:
            for label, depth in _limits(result):
                yield curve._replace(y=depth * MILLIMETRE.factor, series=label)
            for label, depth in _repeating(result):
                marks = len(depth) + 1
                yield curve._replace(y=depth * MILLIMETRE.factor, series=label, least=marks)
            for label, y in (("chatter", result.chatter), ("nearest mode", result.mode_frequency)):
                look: dict[str, Any] = {"limits": (0.0, None), "least": len(y) + 1}
                yield Curve(LIMITS, "chatter frequency", "Hz", curve.x, y, label, **look)
    rpm = result.milling_speed * RPM.factor
    if result.cut_is_stable.any() and len(rpm) > 1:
        for k, direction in enumerate(result.direction):
            vibration = result.tip_vibration[:, k] * MICROMETRE.factor
            label = "vibration of the tip from peak to peak"
            yield Curve(
                "milled_surface", label, "µm", rpm, vibration, direction, limits=(0.0, None)
            )
        label, force = "largest cutting force", result.cutting_force
        yield Curve("milled_surface", label, "N", rpm, force, limits=(0.0, None))


def _limits(result: Any) -> Iterator[tuple[str, Any]]:
    """Yield labels and further limits [m]: band, at rest, evenly spaced teeth."""
    if banded(result):
        yield from (("least of the band", result.least), ("largest of the band", result.most))
    yield "with the receptance at rest", result.at_rest
    if not np.isnan(result.even).all():
        yield "with evenly spaced teeth", result.even


def _repeating(result: Any) -> Iterator[tuple[str, Any]]:
    """Yield labels and limits [m] where vibration repeats with the teeth, NaN elsewhere."""
    for kind, label in REPEATING.items():
        is_kind = np.array(result.loss) == kind
        if is_kind.any():
            yield label, np.where(is_kind, result.depth, np.nan)


def _pockets(result: Any) -> Iterator[Table]:
    """Yield a table of all pockets, the deepest first."""
    speeds = result.pocket_speed, result.pocket_from, result.pocket_to
    top, low, high = ([number(value * RPM.factor, 0) for value in speed] for speed in speeds)
    depth = [number(value * MILLIMETRE.factor, 2) for value in result.pocket_depth]
    rate = [number(value * REMOVAL.factor) for value in result.pocket_removal]
    heads = (
        "speed [rpm]",
        "depth of cut [mm]",
        f"removal rate [{REMOVAL.unit}]",
        "80 % of it from [rpm]",
        "to [rpm]",
    )
    if top:
        yield Table("Pockets", heads, list(zip(top, depth, rate, low, high, strict=True)))
