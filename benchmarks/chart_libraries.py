"""Libraries for charts, their size and time:  python -m benchmarks.chart_libraries FILE…

FILE: ``plotly.min.js``, ``plotly-gl3d.min.js``, ``plotly-basic.min.js``, ``bokeh.min.js``,
``vega.min.js``, ``uPlot.iife.min.js``, as published. Each draws three curves of 2000
points in headless Chromium (playwright; CHROMIUM names another one); the time is that of the
thread of the page, the median of ``RUNS`` new pages.
"""

from __future__ import annotations

import base64
import gzip
import os
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

RUNS = 7
_CURVES = """
const n = 2000, x = Array.from({ length: n }, (_, k) => k);
const ys = [1, 2, 3].map((a) => x.map((k) => Math.sin(k / (40 * a)) / a));
const place = document.getElementById("plot");
"""
_PLOTLY = "Plotly.newPlot(place, ys.map((y) => ({ x, y, mode: 'lines' }))).then(done);"
_DRAWN = {
    "plotly": _PLOTLY,
    "bokeh": """const plot = Bokeh.Plotting.figure({ width: 800, height: 400 });
ys.forEach((y) => plot.line(x, y)); Bokeh.Plotting.show(plot, place).then(done);""",
    "vega": """const values = ys.flatMap((y, c) => x.map((k) => ({ x: k, y: y[k], c })));
const axis = (name, range) => ({ name, type: "linear", range, domain: { data: "t", field: name } });
const mark = { type: "line", from: { data: "s" }, encode: { enter: { x: { scale: "x", field: "x" },
  y: { scale: "y", field: "y" }, stroke: { value: "steelblue" } } } };
new vega.View(vega.parse({ width: 800, height: 400, data: [{ name: "t", values }],
  scales: [axis("x", "width"), axis("y", "height")],
  axes: [{ orient: "bottom", scale: "x" }, { orient: "left", scale: "y" }],
  marks: [{ type: "group", marks: [mark],
    from: { facet: { name: "s", data: "t", groupby: "c" } } }],
})).initialize(place).runAsync().then(done);""",
    "uPlot": """new uPlot({ width: 800, height: 400, scales: { x: { time: false } },
  series: [{}, ...ys.map(() => ({ stroke: "steelblue" }))] }, [x, ...ys], place); done();""",
}


def page(library: Path) -> str:
    """A page that holds a library and draws the curves."""
    kind = next(name for name in _DRAWN if library.name.startswith(name))
    files = [library, library.with_name("bokeh-api.min.js")] if kind == "bokeh" else [library]
    texts = [each.read_text(encoding="utf-8").replace("</script", r"<\/script") for each in files]
    finish = "const done = () => { document.body.dataset.drawn = 'all'; };"
    scripts = "".join(
        f"<script>{text}</script>" for text in (*texts, finish + _CURVES + _DRAWN[kind])
    )
    return f'<!doctype html><meta charset="utf-8"><body><div id="plot"></div>{scripts}'


def seconds(browser: object, path: Path) -> float:
    """Time of the page's thread until the chart is drawn [s]."""
    tab = browser.new_page()
    session = tab.context.new_cdp_session(tab)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    tab.goto(path.as_uri())
    tab.wait_for_selector("body[data-drawn]", state="attached")
    found = session.send("Performance.getMetrics")["metrics"]
    tab.close()
    return next(each["value"] for each in found if each["name"] == "TaskDuration")


def main(files: list[str]) -> None:
    """Prints a row of the table of the documentation for every library."""
    from playwright.sync_api import sync_playwright

    found = os.environ.get("CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as running, tempfile.TemporaryDirectory() as folder:
        browser = running.chromium.launch(args=["--no-sandbox"], executable_path=found)
        for file in map(Path, files):
            place = Path(folder) / f"{file.stem}.html"
            place.write_text(page(file), encoding="utf-8")
            raw = file.read_bytes()
            small = len(base64.b64encode(gzip.compress(raw)))
            took = statistics.median(seconds(browser, place) for _ in range(RUNS))
            sys.stdout.write(
                f"| {file.name} | {len(raw) / 1e6:.2f} | {small / 1e6:.2f} | {took:.2f} |\n"
            )
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:])
