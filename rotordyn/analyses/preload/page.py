"""Blocks of a page: loads, pressure and contact of every bearing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.preload.figures import headline_curves
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.arrays import Array
from rotordyn.page.blocks import BEARING, BEARINGS, Block, Table
from rotordyn.page.curves import curve_charts
from rotordyn.results.described import Shown
from rotordyn.results.display import DEGREE, GIGAPASCAL, RPM
from rotordyn.results.headline import Curve, curves_of
from rotordyn.results.text import from_to

_FIELDS = (
    "axial_load",
    "outer_load",
    "inner_pressure",
    "outer_pressure",
    "inner_angle",
    "outer_angle",
)


def page(spec: Any, variants: Sequence[Shown]) -> Iterator[Block]:
    """Table with a row per bearing; curves over speed, of a single machine also by bearing."""
    for variant in variants:
        yield from _table(variant, named=len(variants) > 1)
    yield from curve_charts(headline_curves, spec, variants)
    if len(variants) == 1:
        yield from curve_charts(_by_bearing, spec, variants)


def _by_bearing(_: Any, variant: Shown) -> Iterator[Curve]:
    for field in _FIELDS if variant.result.bearing else ():
        yield from curves_of(variant.result, field, series="bearing", figure=field)


def _table(variant: Shown, *, named: bool) -> Iterator[Table]:
    result: PreloadResult = variant.result
    solved = [k for k, word in enumerate(result.outcome) if not word]
    if not result.bearing or not solved:
        return
    ends = " → ".join(
        dict.fromkeys(f"{result.speed[k] * RPM.factor:.0f}" for k in (solved[0], solved[-1]))
    )
    columns: list[tuple[str, Array, int]] = [
        ("axial load [N]", result.axial_load, 0),
        ("ball load [N], inner", result.inner_load, 0),
        ("ball load [N], outer", result.outer_load, 0),
        ("contact angle [deg], inner", result.inner_angle * DEGREE.factor, 1),
        ("contact angle [deg], outer", result.outer_angle * DEGREE.factor, 1),
    ]
    pressure = np.fmax(result.inner_pressure, result.outer_pressure) * GIGAPASCAL.factor
    heads = [BEARING, *(head for head, _, _ in columns), "peak pressure [GPa]", "n·dm [mm/min]"]
    rows = [
        [
            name,
            *(from_to(values[solved, k], digits) for _, values, digits in columns),
            f"{np.nanmax(pressure[:, k]):.2f}",
            f"{np.nanmax(result.speed_factor[:, k]) / 1e6:.2f} · 10⁶",
        ]
        for k, name in enumerate(result.bearing)
    ]
    note = f"Loads and angles at {ends} rpm; pressure and n·dm are the largest of all speeds."
    title = f"{variant.title}: bearings" if named else "Bearings"
    yield Table(title, heads, rows, note, section=BEARINGS)
