"""Times of stability lobes and of tools:  python -m benchmarks.lobes

Limit depths at 400 speeds of the milling spindle with known modes, by zero order and by all
harmonics; one tool and ten tools, and how often the bearings are solved. Limits against the time
domain: ``python -m tests.oracles.random_milling 200``.
"""

from __future__ import annotations

import math
import sys
import time
from dataclasses import replace
from unittest.mock import patch

import numpy as np

import rotordyn
from rotordyn.analyses.stability_lobes.limits import Limits
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.spec import METHODS
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.scene import statics
from rotordyn.scene.scene import Scene

SPEEDS = np.linspace(4000.0, 24000.0, 400) * math.pi / 30.0
TOOLS = 10


def limits() -> None:
    """Seconds of the limits alone."""
    case = rotordyn.load("mfw2310_lobes").variants["at_speed"]
    spec = case.analyses["stability_lobes"]
    scene = Scene(case.spindle, case.conditions, SPEEDS, spec.max_frequency, (spec.point,))
    tip = Tip(scene, spec.point, spec.feed, spec.max_frequency)
    tip.modes, tip.tops  # noqa: B018  solved before
    found = Limits(tip, np.arange(len(SPEEDS)), SPEEDS)
    for method in reversed(METHODS):
        asked = Operation(replace(spec, method=method), *spec.pairs[0])
        start = time.perf_counter()
        found.of(asked)
        sys.stdout.write(f"{len(SPEEDS)} speeds, {method}: {time.perf_counter() - start:.2f} s\n")


def tools() -> None:
    """Seconds of one tool and of ten on one spindle."""
    case = rotordyn.load("mfw2310_tools")
    every = list(case.variants.values()) * TOOLS
    for count in (1, TOOLS):
        chosen = {f"tool_{k}": every[k] for k in range(count)}
        start = time.perf_counter()
        with patch.object(statics, "operating_state", wraps=statics.operating_state) as solved:
            rotordyn.run(replace(case, variants=chosen))
        seconds = time.perf_counter() - start
        sys.stdout.write(
            f"{count} tools: {seconds:.2f} s, bearings solved {solved.call_count} times\n"
        )


if __name__ == "__main__":
    limits()
    tools()
