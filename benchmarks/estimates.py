"""Errors of estimates of catalogue values: ``python -m benchmarks.estimates FILE.csv``.

The file has a row for every bearing and the columns d_mm, D_mm, B_mm, C0_kN; for the preload
classes L, M and H of a pair back to back, Fv_*_N (preload), Sa_*_N_um (axial rigidity) and, where
printed, Kae_*_N (unloading force); alpha_deg and hybrid (0 or 1), or else a designation in
``code``: C or E for 15° or 25°, H or X in front for hybrid bearings, but HS for steel. Every row is
fitted to C0 and one class and compared with the other classes; with ``--rating 1`` also fitted to
C_kN, with ``--rating 1.62`` as if the rating of a pair were given for one bearing. No constant of
the method was chosen with such a file: the frequencies of balls are those of catalogues of other
makers (``bearings.catalogue``).
"""

from __future__ import annotations

import argparse
import csv
import math
import re
import sys
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from bearings import BearingError, EstimatedBearing, estimate

CLASSES = "LMH"
_ANGLES = {"C": 15.0, "E": 25.0}


class Judged(NamedTuple):
    """Errors of one row in one class it was not fitted to, estimated over printed less 1."""

    code: str
    series: str
    fitted: str
    judged: str
    rigidity: float
    unloading: float


def main() -> None:
    """Print errors over all rows, the worst row, and the errors of every series."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("file")
    arguments.add_argument("--fitted", default=CLASSES, help="classes to fit to (default: LMH)")
    arguments.add_argument("--every", type=int, default=1, help="use every n-th row only")
    arguments.add_argument("--rating", type=float, default=0.0, help="fit also to so many times C")
    given = arguments.parse_args()
    with open(given.file, newline="", encoding="utf-8") as file:
        rows = [*csv.DictReader(file)][:: given.every]
    for fitted in given.fitted:
        found: list[Judged] = []
        refused, doubted = [], 0
        for row in rows:
            try:
                bearing = fit(row, fitted, given.rating)
            except BearingError as error:
                refused.append(f"{row['code']}: {error}")
                continue
            found += judged(row, fitted, bearing)
            doubted += bool(bearing.doubt)
        head = (
            f"fitted on {fitted}: {len(rows)} rows, {len(refused)} refused, C of {doubted} doubted"
        )
        sys.stdout.write("\n".join([head, *refused, *report(found)]) + "\n")


def judged(row: dict[str, str], fitted: str, bearing: EstimatedBearing) -> Iterator[Judged]:
    """The other classes of one row, by its estimate from one class."""
    code = row.get("code", "")
    for other in CLASSES.replace(fitted, ""):
        rigidity, unloading = bearing.pair(float(row[f"Fv_{other}_N"]))
        printed = row.get(f"Kae_{other}_N")
        yield Judged(
            code,
            _series(code),
            fitted,
            other,
            rigidity / float(row[f"Sa_{other}_N_um"]) * 1e-6 - 1.0,
            unloading / float(printed) - 1.0 if printed else math.nan,
        )


def fit(row: dict[str, str], fitted: str, rating: float = 0.0) -> EstimatedBearing:
    """The estimate from C0, one class of a row and ``rating`` times its C."""
    code, unloading = row.get("code", ""), row.get(f"Kae_{fitted}_N")
    letter = re.search(r"\d([CE])\b", code)
    angle = row.get("alpha_deg") or _ANGLES[letter[1] if letter else "C"]
    hybrid = row["hybrid"] == "1" if row.get("hybrid") else bool(re.match(r"X|H(?!S)", code))
    return estimate(
        bore=float(row["d_mm"]) * 1e-3,
        outside_diameter=float(row["D_mm"]) * 1e-3,
        width=float(row["B_mm"]) * 1e-3,
        contact_angle=math.radians(float(angle)),
        hybrid=hybrid,
        preloads=[float(row[f"Fv_{fitted}_N"])],
        rigidities=[float(row[f"Sa_{fitted}_N_um"]) * 1e6],
        unloading=[float(unloading)] if unloading else [],
        static_rating=float(row["C0_kN"]) * 1e3 if row.get("C0_kN") else None,
        dynamic_rating=float(row["C_kN"]) * 1e3 * rating if rating else None,
    )


def _series(code: str) -> str:
    """Letters in front, series and angle: ``HCB719 C``."""
    found = re.match(r"([A-Z]+) ?(\d+)([A-Z])?", code)
    if not found:
        return code
    number = found[2]
    return f"{found[1]}{number[:3] if len(number) > 4 else number[:2]} {found[3] or ''}".strip()


def report(found: list[Judged]) -> Iterator[str]:
    """Median, 95th percentile and worst of both; the worst series by its 95th percentile."""
    values: Any
    for name in ("rigidity", "unloading"):
        values = np.abs([getattr(each, name) for each in found])
        if np.isnan(values).all():
            continue
        worst = found[int(np.nanargmax(values))]
        yield (
            f"  {name:9}  median {np.nanmedian(values):.2%}, 95th percentile "
            f"{np.nanpercentile(values, 95):.2%}, worst {getattr(worst, name):+.1%} "
            f"({worst.code}, {worst.judged})"
        )
        series = sorted({each.series for each in found})
        each = {s: [v for v, f in zip(values, found, strict=True) if f.series == s] for s in series}
        medians = {s: float(np.nanmedian(v)) for s, v in each.items() if len(v) > 5}
        if medians:
            last = max(medians, key=lambda s: medians[s])
            yield (f"             worst series by its median: {last}, {medians[last]:.2%}")


if __name__ == "__main__":
    main()
