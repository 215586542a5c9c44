"""Blocks of a page: life, safety, heat and film of every bearing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.life.figures import headline_curves
from rotordyn.analyses.life.result import HOUR, LifeResult
from rotordyn.analyses.life.summary import hours, unmodified
from rotordyn.page.blocks import BEARING, BEARINGS, Block, Table
from rotordyn.page.curves import curve_charts
from rotordyn.results.described import Shown
from rotordyn.results.display import RPM, number


def page(spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    """Table with a row per bearing; curves of life and heat over speed."""
    for variant in variants:
        yield from _table(variant, named=len(variants) > 1)
    yield from curve_charts(headline_curves, spec, variants)


def _table(variant: Shown, *, named: bool) -> Iterator[Table]:
    result: LifeResult = variant.result
    solved = [k for k, word in enumerate(result.outcome) if not word]
    if not solved:
        return
    last, rows = solved[-1], []
    lubricated = bool(np.isfinite(result.viscosity))
    heads = [BEARING, "life L10r [h]", "least static safety S0"]
    heads += ["modified life [h]", "friction [N·mm]", "heat [W]", "film [nm]"] if lubricated else []
    for k, name in enumerate(result.bearing):
        row = [
            name,
            hours(result.life[last, k] / HOUR),
            number(np.nanmin(result.static_safety[:, k])),
        ]
        if lubricated:
            row += [
                hours(result.modified_life[last, k] / HOUR),
                number(result.moment[last, k] * 1e3),
                number(result.heat[last, k], 0),
                number(result.film[last, k] * 1e9, 0),
            ]
        rows.append(row)
    at = f"{result.speed[last] * RPM.factor:.0f} rpm"
    note = f"Life, friction, heat and film at {at}; friction and heat are orders of magnitude."
    if lubricated and unmodified(result).any():
        note += " Above a contact angle of 45° the factor of the modified life is not known."
    title = f"{variant.title}: bearings" if named else "Bearings"
    yield Table(title, heads, rows, note if lubricated else f"Life at {at}.", section=BEARINGS)
