"""Tables of the page on Debongnie's approximation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearings.debongnie import power_law
from docs.generate.debongnie_errors import BALLS, CONTINUOUS, RATIOS, SHARES, Errors, errors
from docs.generate.marked import table

LAWS = (0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0)
ZONES = (3.0, 1.5, 1.0)  # least numbers of balls in the load zone


def law_table() -> str:
    """A and n over ki/ke."""
    rows = []
    for ratio in LAWS:
        law = power_law(ratio)
        rows.append((f"{ratio:g}", f"{law.factor:.4f}", f"{law.exponent:.3f}"))
    return table(("ki/ke:", "A:", "n:"), rows)


def error_table() -> str:
    """Largest relative errors over ki/ke and δc/δr, by the number of balls."""
    head = ("balls:", "δr:", "largest Qe:", *(f"largest Qi, b ≥ {n:g}:" for n in ZONES))
    rows = [_row(f"{balls}", errors(balls)) for balls in BALLS]
    law = errors(CONTINUOUS, RATIOS[::2], SHARES[::4])
    return table(head, [*rows, _row("integral", law)])


def _row(name: str, ring: Errors) -> tuple[str, ...]:
    inner = (ring.inner[ring.in_zone >= least] for least in ZONES)
    return (name, *(_largest(part) for part in (ring.displacement, ring.outer, *inner)))


def _largest(error: NDArray[np.float64]) -> str:
    return f"{100.0 * np.abs(error).max():.1f} %" if error.size else "–"
