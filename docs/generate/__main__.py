"""``python -m docs.generate [--measure] [--only WORD]``: see ``scripts/document``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable


def main() -> int:
    """Rewrite every generated part; with ``--measure`` measure the times first."""
    parser = argparse.ArgumentParser(prog="scripts/document", description=__doc__)
    parser.add_argument(
        "--measure", action="store_true", help="measure times first (benchmarks/main_job.py)"
    )
    parser.add_argument(
        "--only",
        metavar="WORD",
        default="",
        help="only pages and figures with this word in their name",
    )
    options = parser.parse_args()
    if options.measure:
        from benchmarks.main_job import measure

        _step("times measured", measure)
    from docs.generate import pages
    from docs.generate.bearing_curves import draw_bearing_curves
    from docs.generate.debongnie_curves import draw_debongnie
    from docs.generate.figures import draw_figures
    from docs.generate.precision import draw_precision
    from docs.generate.scaling_curves import draw_scaling
    from docs.generate.sweep_curves import draw_sweeps
    from docs.generate.zero_order_curves import draw_zero_order

    steps = pages.PAGES | {
        "docs/figures/mfw2310_*.png": draw_figures,
        "docs/figures/precision.png": draw_precision,
        "docs/figures/bearing_error.png": draw_bearing_curves,
        "docs/figures/debongnie_*.png": draw_debongnie,
        "docs/figures/scaling.png": draw_scaling,
        "docs/figures/sweeps.png": draw_sweeps,
        "docs/figures/zero_order.png": draw_zero_order,
    }
    for name, work in steps.items():
        if options.only in name:
            _step(name, work)
    return 0


def _step(name: str, work: Callable[[], None]) -> None:
    work()
    sys.stdout.write(f"{name}\n")


if __name__ == "__main__":
    sys.exit(main())
