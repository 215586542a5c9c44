"""One bearing, on one core:  python -m benchmarks.bearing [--repeats N] [--states N] [--bearings N]

Speed compared with SciPy, first calls, the five methods of Noël's Tab. 2.3, error against time. The
results are written into ``benchmarks/results.json``; a few minutes.
"""

from __future__ import annotations

import argparse
import os
from typing import Any

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main() -> None:
    """Measure and keep the results."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.bearing",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--repeats", type=int, default=9, help="runs of which the fastest is taken")
    parser.add_argument("--states", type=int, default=1000, help="states of a sweep and of a batch")
    parser.add_argument(
        "--bearings", type=int, default=24, help="bearings on which path steps are tried"
    )
    asked = parser.parse_args()
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))  # before numpy is imported
    from benchmarks.kept import keep

    keep(bearing=measured(asked.repeats, asked.states, asked.bearings))


def measured(repeats: int, states: int, bearings: int) -> dict[str, Any]:
    """Everything, in the order of the page; ``busy``: the load average before."""
    busy = os.getloadavg()[0] if hasattr(os, "getloadavg") else None
    from benchmarks.bearing.first_call import measure_first_call
    from benchmarks.bearing.hertz_fits import measure_hertz
    from benchmarks.bearing.methods import measure_methods
    from benchmarks.bearing.path_steps import measure_path_steps
    from benchmarks.bearing.speed import lost_from_unloaded, measure_speed
    from benchmarks.bearing.tolerance import measure_tolerance

    return {
        "busy": busy,
        "first_call": measure_first_call(),
        "speed": measure_speed(states, repeats),
        "lost_from_unloaded": lost_from_unloaded(),
        "methods": measure_methods(repeats=repeats),
        "tolerance": measure_tolerance(repeats=repeats),
        "path_steps": measure_path_steps(bearings),
        "hertz": measure_hertz(repeats),
    }


if __name__ == "__main__":
    main()
