"""What a page shows of it: the depth of cut over speed; of one machine all that is drawn beside it,
its chatter, its pockets and what a planned cut does."""

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
    """The charts; of a single speed, what is declared. Of one machine a table of its pockets."""
    curves = _alone if len(variants) == 1 else _beside_others
    yield from list(curve_charts(curves, spec, variants)) or declared_blocks(variants)
    if len(variants) == 1:
        yield from _pockets(variants[0].result)


def _beside_others(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Headline curves, and the limit of a motor."""
    result = variant.result
    for curve in headline_curves(spec, variant):
        yield curve
        if result.motor and curve.figure == LIMITS and not curve.series:
            depth = result.motor_depth * MILLIMETRE.factor
            yield curve._replace(y=depth, series=f"limit of the motor ({result.motor})")


def _alone(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Of one machine: further limits, frequencies of the chatter, and of a planned cut the
    vibration and the largest force."""
    result = variant.result
    for curve in _beside_others(spec, variant):
        yield curve
        if curve.figure == LIMITS and not curve.series:
            for words, depth in _limits(result):
                yield curve._replace(y=depth * MILLIMETRE.factor, series=words)
            for words, depth in _repeating(result):
                marks = len(depth) + 1
                yield curve._replace(y=depth * MILLIMETRE.factor, series=words, least=marks)
            for words, y in (("chatter", result.chatter), ("nearest mode", result.mode_frequency)):
                look: dict[str, Any] = {"limits": (0.0, None), "least": len(y) + 1}
                yield Curve(LIMITS, "chatter frequency", "Hz", curve.x, y, words, **look)
    rpm = result.milling_speed * RPM.factor
    if result.cut_is_stable.any() and len(rpm) > 1:
        for k, way in enumerate(result.direction):
            swing = result.tip_vibration[:, k] * MICROMETRE.factor
            words = "vibration of the tip from peak to peak"
            yield Curve("milled_surface", words, "µm", rpm, swing, way, limits=(0.0, None))
        words, force = "largest cutting force", result.cutting_force
        yield Curve("milled_surface", words, "N", rpm, force, limits=(0.0, None))


def _limits(result: Any) -> Iterator[tuple[str, Any]]:
    """What stands beside the limits [m], as far as there is such."""
    if banded(result):
        yield from (("least of the band", result.least), ("largest of the band", result.most))
    yield "by the receptance at rest", result.at_rest
    if not np.isnan(result.even).all():
        yield "with evenly spaced teeth", result.even


def _repeating(result: Any) -> Iterator[tuple[str, Any]]:
    """Limits [m] where vibration repeats with the teeth, NaN elsewhere."""
    for kind, words in REPEATING.items():
        of_it = np.array(result.loss) == kind
        if of_it.any():
            yield words, np.where(of_it, result.depth, np.nan)


def _pockets(result: Any) -> Iterator[Table]:
    """All of them, the deepest first."""
    speeds = result.pocket_speed, result.pocket_from, result.pocket_to
    own, low, high = ([number(each * RPM.factor, 0) for each in speed] for speed in speeds)
    depth = [number(each * MILLIMETRE.factor, 2) for each in result.pocket_depth]
    rate = [number(each * REMOVAL.factor) for each in result.pocket_removal]
    heads = (
        "speed [rpm]",
        "depth of cut [mm]",
        f"removal rate [{REMOVAL.unit}]",
        "80 % of it from [rpm]",
        "to [rpm]",
    )
    if own:
        yield Table("Pockets", heads, list(zip(own, depth, rate, low, high, strict=True)))
