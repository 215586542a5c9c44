#!/usr/bin/env python3
"""Computing time and size of the page of a run:  python -m benchmarks.report

The flagship is run once; its page is written several times, each time with plotly.js packed again,
which is most of the time. The first page, which loads code, is not counted. Then it is opened from
disk in headless Chromium (playwright; CHROMIUM names another one): time of the thread of the page.
"""

from __future__ import annotations

import os
import shutil
import statistics
import tempfile
import time
from pathlib import Path
from typing import Any

import rotordyn
from benchmarks.kept import keep
from benchmarks.processes import MEGABYTE, ROOT
from rotordyn.page.html import packed_library

RUNS = 9


def measure() -> dict[str, float]:
    """Median CPU time of writing the page, ``seconds``, its size, ``megabytes``, and the
    times of ``opened``."""
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
        return {"seconds": statistics.median(seconds), "megabytes": size, **opened(page)}


def opened(page: Path) -> dict[str, float]:
    """Median seconds of the thread of the page until it is loaded, ``shown``, and until the first
    charts are drawn, ``drawn``; those further down are drawn when they are scrolled into view."""
    from playwright.sync_api import sync_playwright

    found = os.environ.get("CHROMIUM") or shutil.which("chromium")
    options = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with sync_playwright() as running:
        browser = running.chromium.launch(args=options, executable_path=found)
        times = [_once(browser, page) for _ in range(RUNS)]
        browser.close()
    shown, drawn = map(statistics.median, zip(*times, strict=True))
    return {"shown": shown, "drawn": drawn}


def _once(browser: Any, page: Path) -> tuple[float, float]:
    tab = browser.new_page()
    session = tab.context.new_cdp_session(tab)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def busy() -> float:
        found = session.send("Performance.getMetrics")["metrics"]
        return float(next(each["value"] for each in found if each["name"] == "TaskDuration"))

    tab.goto(page.as_uri(), wait_until="load")
    shown = busy()
    tab.wait_for_selector("body[data-drawn]")
    drawn = busy()
    tab.close()
    return shown, drawn


if __name__ == "__main__":
    found = measure()
    print(found)  # noqa: T201
    keep(report=found)
