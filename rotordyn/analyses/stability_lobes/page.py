"""What a page shows of it: the depth of cut over speed, of one machine with its band and motor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rotordyn.analyses.stability_lobes.figures import LIMITS, headline_curves
from rotordyn.analyses.stability_lobes.result import banded
from rotordyn.page.blocks import Block
from rotordyn.page.curves import curve_charts
from rotordyn.page.declared import declared_blocks
from rotordyn.results.described import Shown
from rotordyn.results.display import MILLIMETRE
from rotordyn.results.headline import Curve


def page(spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    """The chart of the limits; of a single speed, what is declared."""
    curves = _with_band if len(variants) == 1 else headline_curves
    yield from list(curve_charts(curves, spec, variants)) or declared_blocks(variants)


def _with_band(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Headline curves, and the limit of a motor and both ends of a band where there are such."""
    result = variant.result
    for curve in headline_curves(spec, variant):
        yield curve
        if result.motor and curve.figure == LIMITS:
            depth = result.motor_depth * MILLIMETRE.factor
            yield curve._replace(y=depth, series=f"limit of the motor ({result.motor})")
        if banded(result) and curve.figure == LIMITS:
            for words, depth in (("least", result.least), ("largest", result.most)):
                yield curve._replace(y=depth * MILLIMETRE.factor, series=f"{words} of the band")
