"""Detection of printed values that no internal geometry explains together."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from bearings.arrays import Array
from bearings.catalogue.printed import Catalogue, Value
from bearings.errors import InvalidBearing

LIMIT = {
    "rigidity": 0.12,
    "unloading": 0.12,
    "dynamic": 0.3,
    "static": 0.3,
}  # of ln(computed/printed)
ROW_FACTOR = 2.0**0.7  # C of two like bearings over that of one (ISO 281)
# Likely mistake behind a factor between printed and expected value
_SLIPS = {
    ("rigidity", 0.5): "of one bearing: give that of the pair back to back",
    ("rigidity", 2.0): "of two pairs: give that of one pair back to back",
    ("dynamic", ROW_FACTOR): "of a pair: give that of one bearing",
    ("static", 2.0): "of a pair: give that of one bearing",
}
_NEAR = 0.25  # of ln(factor)


def refuse_contradictions(
    catalogue: Catalogue, apart: Array, computed: Array, weight: Array
) -> None:
    """Raise InvalidBearing where no internal geometry is within the limits of all values.

    ``computed`` (values, insides), ``apart``: its ln(computed/printed) in standard deviations;
    ``weight`` (insides,): logarithm of the prior probability of each, up to a constant.
    """
    values = catalogue.values
    if not values:
        return
    ratio = np.log(computed / np.array([v.number for v in values])[:, None])
    met = np.abs(ratio) <= np.array([LIMIT[v.kind] for v in values])[:, None]
    count = met.sum(axis=0)
    if count.max() == len(values):
        return
    quality = weight - 0.5 * (np.where(met, apart, 0.0) ** 2).sum(axis=0)
    k = int(np.argmax(np.where(count == count.max(), quality, -np.inf)))
    odd = [
        (v, float(c)) for v, c, m in zip(values, computed[:, k], met[:, k], strict=True) if not m
    ]
    agree = [v for v, m in zip(values, met[:, k], strict=True) if m]
    others = f"the largest set that agrees: {', '.join(v.words for v in agree)}"
    raise InvalidBearing(
        "catalogue values contradict one another or the size of the rings: "
        f"{'; '.join(_odd(odd))}; {others if agree else 'none agrees with the size of the rings'}"
    )


def _odd(values: list[tuple[Value, float]]) -> Iterator[str]:
    """Yield a phrase for every kind of contradicting value."""
    for kind in dict.fromkeys(value.kind for value, _ in values):
        pairs = [(value, computed) for value, computed in values if value.kind == kind]
        listing = ", ".join(f"{v.words} ({v.shown(c)} expected)" for v, c in pairs)
        yield listing + _slip(kind, [v.number / c for v, c in pairs])


def _slip(kind: str, ratios: list[float]) -> str:
    """Name the mistake whose factor all ``ratios`` of printed to expected values are near."""
    for (of, factor), slip in _SLIPS.items():
        if of == kind and all(abs(math.log(ratio / factor)) < _NEAR for ratio in ratios):
            return f", which looks like that {slip}"
    return ""
