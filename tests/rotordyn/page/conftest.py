"""A browser, and results small enough for it."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from docs.site.runs import case_run
from rotordyn.job import deliver
from tests.few_speeds import at_few_speeds

OPTIONS = [
    "--no-sandbox",  # which root has to do without
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


def evil() -> Any:
    """A small case whose title would run if it were HTML."""
    case = rotordyn.load("grinding_spindle")
    title = "<script>document.title='ran'</script><img src=x onerror=\"document.title='ran'\"> & Co"
    return replace(case, title=title, speeds=case.speeds[:: len(case.speeds) // 4])


@pytest.fixture(scope="session")
def evil_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Its results folder, with a page."""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    return deliver(
        evil(), tmp_path_factory.mktemp("page") / "evil", figures=False, report=True
    ).folder


@pytest.fixture(scope="session")
def flagship(runs: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of the flagship, in a copy of its run."""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    folder = tmp_path_factory.mktemp("page") / "mfw2310"
    shutil.copytree(case_run(at_few_speeds(rotordyn.load("mfw2310")), runs / "few"), folder)
    return rotordyn.write_report(folder, folder / "report.html")


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Headless Chromium: that of playwright, or one of the system, which CHROMIUM may name."""
    api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    found = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
    with api.sync_playwright() as running:
        try:
            opened = running.chromium.launch(args=OPTIONS, executable_path=found)
        except api.Error as error:
            pytest.skip(f"no Chromium to open the page with: {str(error).splitlines()[0]}")
        yield opened
        opened.close()


@pytest.fixture(scope="session")
def show(browser: Any) -> Iterator[Any]:
    """Opens a file offline; gives the page and what its console said."""
    contexts = []

    def opened(path: Path, **look: Any) -> tuple[Any, list[str]]:
        context = browser.new_context(**{"viewport": {"width": 1300, "height": 900}, **look})
        context.set_offline(True)
        contexts.append(context)
        page, said = context.new_page(), []
        page.on("console", lambda m: said.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda r: said.append(r.url) if r.url.startswith("http") else None)
        page.goto(path.as_uri())
        page.wait_for_selector("body[data-drawn=all]", timeout=90000)
        return page, said

    yield opened
    for context in contexts:
        context.close()


@pytest.fixture(scope="session")
def opened(show: Any, flagship: Path) -> Any:
    """The page of the flagship and what its console said; tests leave it usable."""
    return show(flagship)


def held(text: str) -> tuple[Any, bytes]:
    """Content of a page as a browser unpacks it: plain values, and the bytes of its arrays."""
    import base64
    import gzip
    import json
    import re

    (coded,) = re.findall(r'<script type="text/plain" id="content">(.*?)</script>', text, re.S)
    raw = gzip.decompress(base64.b64decode(coded))
    length = int.from_bytes(raw[:4], "little")
    return json.loads(raw[4 : 4 + length]), raw[4 + length :]


def array(of: Any, numbers: bytes) -> np.ndarray[Any, Any]:
    """An array of the content."""
    kind = np.dtype("<i4" if of["$"] == "i" else "<f4")
    return np.frombuffer(numbers, kind, of["n"], of["at"]).reshape(of["w"])
