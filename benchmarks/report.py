#!/usr/bin/env python3
"""What the page of a run costs:  python -m benchmarks.report

The flagship is run once; its page is written again and again, each time with plotly.js packed anew,
which is most of the time. The first page, which loads code, is left out.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import MEGABYTE, ROOT
from rotordyn.page.html import packed_library

RUNS = 9


def measure() -> dict[str, float]:
    """Median CPU time of writing the page, ``seconds``, and its size, ``megabytes``."""
    results = rotordyn.run(rotordyn.load(ROOT / "cases" / "mfw2310.yaml"))
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"
        results.report(page)
        seconds = []
        for _ in range(RUNS):
            packed_library.cache_clear()
            begin = time.process_time()
            results.report(page)
            seconds.append(time.process_time() - begin)
        size = page.stat().st_size / MEGABYTE
        return {"seconds": statistics.median(seconds), "megabytes": size}


if __name__ == "__main__":
    found = measure()
    print(found)  # noqa: T201
    keep(report=found)
