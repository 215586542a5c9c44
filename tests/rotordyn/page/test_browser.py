"""The page in headless Chromium, from disk, without network."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.campbell.page import FACETS
from rotordyn.page.blocks import Chart, sections
from rotordyn.page.html import Page, write
from rotordyn.surface.body import together
from rotordyn.surface.several import displacements, surfaces


def _response(page: Any) -> Any:
    """The chart of responses: the first with a slider that is not of shapes."""
    return page.locator("figure.chart:has(input[type=range]):not(:has(.play))").first


def _data(figure: Any) -> Any:
    got = figure.locator(".plot").evaluate(
        "(p) => [Array.from(p.data[0].x), Array.from(p.data[0].y)]"
    )
    return [np.array(each, dtype=float) for each in got]


def test_opens_from_disk_offline_without_an_error(opened: Any) -> None:
    """The verdict is there as soon as the page is; charts follow."""
    page, said = opened
    assert said == []
    page.reload(wait_until="load")
    assert page.locator(".verdict").is_visible()
    page.wait_for_selector("body[data-drawn]")
    assert said == []


def test_the_slider_moves_the_curve(opened: Any, flagship: Path) -> None:
    page, said = opened
    figure = _response(page)
    slider, output = figure.locator("input[type=range]"), figure.locator("output")
    before = _data(figure)
    assert output.text_content() == "0 rpm"
    slider.focus()
    for _ in range(2):
        page.keyboard.press("ArrowRight")
    frf = rotordyn.open(flagship.parent)["frf"]
    assert output.text_content() == f"{frf['speed_rpm'].values[2]:.0f} rpm"
    x, y = _data(figure)
    known = np.isfinite(x)
    wanted = np.interp(x[known], frf["frequency"], np.abs(frf["receptance"].values[2, 0])) * 1e6
    assert y[known] == pytest.approx(wanted, rel=0.02)
    assert not np.array_equal(before[1], y, equal_nan=True)
    figure.locator("select").select_option(index=1)
    changed = _data(figure)[1]
    assert np.nanmax(changed) == pytest.approx(
        np.nanmax(np.abs(frf["peak_value"].values[2, 1])) * 1e6, rel=0.01
    )
    assert said == []


@pytest.mark.long
def test_modes_move_as_computed(opened: Any, flagship: Path) -> None:
    """Drawn points are those of the surface moved by the mode, up to one factor."""
    page, said = opened
    figure = page.locator("figure:has(.play)")
    figure.scroll_into_view_if_needed()
    figure.locator("select").select_option(index=2)
    plot = "document.querySelector('figure:has(.play) .plot').data[0]"
    drawn = page.evaluate(f"['x', 'y', 'z'].map((axis) => Array.from({plot}[axis]))")
    (case, results) = rotordyn.open(flagship.parent).parts[""]
    result, bodies = results["campbell"], surfaces(case.spindle, FACETS)
    nodes = (result.node, result.node_rotor, result.shape[0, 2])
    moved = displacements(case.spindle, bodies, *nodes).real
    away = np.array(drawn).T / 1e3 - together(list(bodies.values())).points
    factor = np.vdot(moved, away) / np.vdot(moved, moved)
    assert factor > 0.0
    assert away == pytest.approx(factor * moved, abs=1e-4 * np.abs(away).max())

    button = figure.locator("button.play")
    assert button.get_attribute("aria-pressed") == "false"
    button.click()
    page.wait_for_function(f"(before) => {plot}.y[7] !== before", arg=drawn[1][7])
    assert button.get_attribute("aria-pressed") == "true"
    assert button.text_content() == "Pause"
    button.click()
    assert said == []


@pytest.fixture(
    scope="module", params=["wide and dark", pytest.param("narrow", marks=pytest.mark.long)]
)
def looked(request: pytest.FixtureRequest, show: Any, evil_folder: Path) -> Any:
    """The page of ``evil`` in one look, opened once, and what its console said."""
    width, scheme = (390, "light") if request.param == "narrow" else (1300, "dark")
    look = {"viewport": {"width": width, "height": 844}, "color_scheme": scheme}
    return show(evil_folder / "report.html", **look)


in_the_dark = pytest.mark.parametrize("looked", ["wide and dark"], indirect=True, scope="module")


@in_the_dark
def test_titles_are_inert(looked: Any, evil_folder: Path) -> None:
    page, said = looked
    assert said == []
    assert page.title().startswith("<script>")
    assert page.locator("h1").text_content() == rotordyn.open(evil_folder).case.title
    assert page.locator("img").count() == 0
    assert page.evaluate("document.scripts.length") == 4  # library, content, ours, library run


def test_nothing_runs_over_the_edge(looked: Any, request: pytest.FixtureRequest) -> None:
    page, said = looked
    look = request.node.callspec.params["looked"]
    assert said == []
    assert page.evaluate("document.documentElement.scrollWidth") <= page.viewport_size["width"]
    names = ("color", "backgroundColor")
    ink, paper = (page.evaluate(f"getComputedStyle(document.body).{name}") for name in names)
    light = [sum(map(int, c.strip("rgb()").split(", ")[:3])) for c in (ink, paper)]
    assert (light[0] > light[1]) == (look != "narrow")
    tick = page.evaluate("getComputedStyle(document.querySelector('.xtick text')).fill")
    assert tick == ink


@in_the_dark
def test_prints_on_white(looked: Any, tmp_path: Path) -> None:
    page, said = looked
    page.emulate_media(media="print")
    page.wait_for_timeout(1500)
    paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert paper == "rgb(255, 255, 255)"
    assert (
        page.evaluate("getComputedStyle(document.querySelector('.xtick text')).fill")
        == "rgb(0, 0, 0)"
    )
    canvases = "[...document.querySelectorAll('.gl-container canvas')]"
    widths = page.evaluate(f"{canvases}.map((each) => each.getBoundingClientRect().width)")
    assert widths
    assert max(widths) < 681  # of A4 within its margins
    page.emulate_media(media="screen")
    pdf = page.pdf(path=tmp_path / "page.pdf")
    assert pdf.startswith(b"%PDF")
    assert len(pdf) > 50_000
    assert said == []


@pytest.mark.parametrize("width", [1300, 390])
def test_long_names_are_read_whole_and_nothing_lies_over_them(
    show: Any, tmp_path: Path, width: int
) -> None:
    """The toolbar that comes with the mouse lies above the legend, within the page."""
    pytest.importorskip("plotly", reason="the extra report is not installed")
    names = [f"Solid end mill of {k} mm in a shrink-fit holder on HSK-A63, mode" for k in range(6)]
    traces = [{"x": [0, 1], "y": [k, 2], "name": name} for k, name in enumerate(names)]
    chart = Chart("long names", traces, {"xaxis": {}, "yaxis": {}})
    write(tmp_path / "p.html", Page("t", [], "fine", False, sections([("S", chart)])))
    page, said = show(tmp_path / "p.html", viewport={"width": width, "height": 900})
    plot = page.locator(".plot")
    plot.hover()
    bar, held = (page.locator(s).bounding_box() for s in (".modebar", ".across"))
    assert held["y"] <= bar["y"]
    texts = plot.locator(".legendtext")
    read = [text.replace(" ", "") for text in texts.all_text_contents()]
    assert read == [name.replace(" ", "") for name in names]
    boxes = [each.bounding_box() for each in texts.all()]
    shown = plot.locator(".legend .bg").bounding_box()
    axes = plot.locator(".nsewdrag").bounding_box()
    assert all(box["y"] > bar["y"] + bar["height"] for box in boxes)
    assert all(box["x"] + box["width"] <= held["x"] + held["width"] for box in boxes)
    assert all(box["y"] + box["height"] <= axes["y"] for box in boxes)
    assert shown["y"] + shown["height"] >= max(box["y"] + box["height"] for box in boxes)
    assert said == []
