"""Tables joined, numbers packed, texts escaped."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.frf.page import _responses
from rotordyn.job.results import inputs_of
from rotordyn.page.blocks import Chart, Control, Markup, Shapes, Table, Text, sections
from rotordyn.page.curves import curve_charts, once_named
from rotordyn.page.html import Page, html
from rotordyn.page.packed import packed, rounded
from rotordyn.results.described import Shown
from rotordyn.results.headline import Curve
from tests.rotordyn.figures import samples
from tests.rotordyn.page.conftest import array, held


def test_tables_of_the_same_things_become_one() -> None:
    one = Table("Bearings", ("bearing", "load"), [("a", "1"), ("b", "2")], "At rest.")
    other = Table("Bearings", ("bearing", "life"), [("b", "9"), ("c", "8")], "At speed.")
    (found,) = sections([("Bearings", one), ("Bearings", other)])
    (table,) = found.blocks
    assert table.head == ["bearing", "load", "life"]
    assert table.rows == [["a", "1", ""], ["b", "2", "9"], ["c", "", "8"]]
    assert table.note == "At rest. At speed."


def test_a_block_may_be_in_a_section_of_others() -> None:
    shared = Table("T", ("", "x"), [("a", "1")], section="Bearings")
    found = sections([("Machine", Text(["m"])), ("Life", shared), ("Life", Text(["l"]))])
    assert [each.title for each in found] == ["Machine", "Bearings", "Life"]


def test_numbers_are_packed_as_they_were() -> None:
    values = np.array([[1.5, np.inf], [-2.0e-7, np.nan]])
    said = packed({"v": values, "n": np.arange(3)})
    content, numbers = held(f'<script type="text/plain" id="content">{said}</script>')
    assert array(content["v"], numbers) == pytest.approx(
        np.array([[1.5, np.nan], [-2.0e-7, np.nan]]), nan_ok=True
    )
    assert array(content["n"], numbers).tolist() == [0, 1, 2]


def test_texts_are_escaped_but_templates() -> None:
    said = {"a": "<b>&", "b": Markup("<b>&"), "c": np.array(["<i>"])}
    content, _ = held(f'<script type="text/plain" id="content">{packed(said)}</script>')
    assert content == {"a": "&lt;b&gt;&amp;", "b": "<b>&", "c": ["&lt;i&gt;"]}


def test_rounded_numbers_keep_four_digits() -> None:
    values = np.random.default_rng(0).normal(size=1000) * 10.0 ** np.arange(-20, 20).repeat(25)
    kept = rounded(np.append(values, [np.nan, np.inf, 0.0]))
    assert np.abs(kept[:1000] / values - 1.0).max() < 2.0**-15
    assert np.isnan(kept[1000])
    assert np.isinf(kept[1001])
    assert kept[1002] == 0.0


def test_the_page_has_headings_labels_and_no_script_of_others() -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    evil = "</script><script>alert(1)</script>"
    chart = Chart(
        evil, [{"x": [1, 2], "y": [1, 2]}], controls=[Control(evil, [evil, "b"], slider=True)]
    )
    table = Table(evil, ("", evil), [(evil, evil)], note=evil)
    text = html(Page(evil, [evil], evil, True, sections([(evil, chart), (evil, table)]), evil))
    assert text.count("<h1>") == 1
    assert "<h2 id=" in text
    assert "<h3>" in text
    assert text.count("<script") == 3
    assert text.count("</script>") == 3
    assert 'type="range"' in text
    assert "<label for=" in text
    assert 'scope="row"' in text
    assert "http://" not in text.split('id="library"')[0]
    assert 'src="' not in text


def test_what_is_said_of_peaks_names_the_variant() -> None:
    one = replace(samples.frf(1, 400), outcome=("",), resonance=np.arange(1))
    at = np.full((1, 4, 1), 900.0)
    two = replace(one, peak_frequency=at, peak_value=1e-9 * at + 0j, peak_damping=at)
    shown: Any = [SimpleNamespace(title=t, result=r) for t, r in (("one", one), ("two", two))]
    peaks = "Peaks [µm/N]: 900.0 Hz (0.9)."
    assert _responses(shown[1:]).words[0] == peaks
    assert _responses(shown).words[0] == f"one: No peak. two: {peaks}"


def test_a_file_beside_the_reader_has_its_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir("/usr")
    case: Any = SimpleNamespace(files=(Path("case.yaml"), Path("/a/b/c.yaml")))
    assert inputs_of(case) == ("usr/case.yaml", "b/c.yaml")


def test_paper_holds_tables_of_many_columns_in_small_print() -> None:
    tables = [
        Table(f"T{k}", [str(n) for n in range(k)], [["1"] * k], folded=True) for k in (12, 13)
    ]
    text = html(Page("t", [], "fine", False, sections([("S", each) for each in tables])))
    assert text.count("<table>") == text.count('<table class="many">') == 1


def test_no_library_is_embedded_where_there_is_no_chart() -> None:
    text = html(Page("t", [], "fine", False, sections([("S", Text(["one"]))])))
    assert len(text) < 40_000


def test_shapes_are_packed_whole() -> None:
    pytest.importorskip("plotly", reason="the extra report is not installed")
    motion = np.ones((2, 1, 3, 6)) + 2j
    shapes = Shapes(
        "Modes",
        [Control("mode", ["1", "2"]), Control("speed", ["0 rpm"])],
        points=np.zeros((6, 3)),
        triangles=np.array([[0, 1, 2]]),
        place=np.zeros(6, int),
        station=np.zeros(3),
        motion=motion,
        still_points=np.zeros((0, 3)),
        still_triangles=np.zeros((0, 3), int),
    )
    content, numbers = held(html(Page("t", [], "fine", False, sections([("S", shapes)]))))
    found = array(content["c0"]["motion"], numbers)
    assert found.shape == (2, 1, 3, 6, 2)
    assert (found[..., 0] + 1j * found[..., 1] == motion).all()


def test_a_name_is_in_the_legend_once_and_hides_all_that_bear_it() -> None:
    named = once_named([{"name": "published"}, {"name": "a"}, {"name": "published"}])
    assert [each["showlegend"] for each in named] == [True, True, False]
    assert [each.get("legendgroup") for each in named] == ["published", None, "published"]


def test_a_range_of_numbers_breaks_behind_its_arrow_alone() -> None:
    table = Table("T", ("bearing", "load"), [("a", "551 → 1251")])
    text = html(Page("t", [], "fine", False, sections([("S", table)])))
    assert '<td class="n">551\u00a0→ 1251</td>' in text


@pytest.mark.parametrize("least", [100, 4])
def test_points_beyond_the_axis_are_on_the_page(least: int) -> None:
    """As triangles at its edge where they are too few for a line, which leaves the frame else."""
    x = np.linspace(0.0, 9000.0, 10)
    y = np.array([1.0, 2.0, 1.0, 30.0, 1.0, 2.2341231, np.nan, np.inf, 1.0, 2.0])

    def curves(_: Any, variant: Shown) -> Any:
        look: Any = {"least": least, "ceiling": 4.0, "limits": (0.0, None)}
        yield Curve("lobes", "depth", "mm", x, y if variant.title == "b" else 0.0 * x, **look)

    (chart,) = curve_charts(curves, None, [Shown(name, None, (), None) for name in ("a", "b")])
    low, high = chart.layout["yaxis"]["range"]
    assert low == 0.0
    assert 2.0 < high < 3.0
    _, line, *beyond = chart.traces
    if least == 4:
        assert (line["y"][[3, 7]] > high).all()
        assert not beyond
        assert not chart.note
        return
    assert line["mode"] == "markers"
    assert np.isnan(line["y"][[3, 7]]).all()
    (off,) = beyond
    assert off["x"] == pytest.approx(x[[3, 7]])
    assert off["y"] == pytest.approx(high, rel=1e-4)
    assert (np.float32(off["y"]) < float(f"{high:.7g}")).all()  # as packed: else it is not drawn
    assert off["text"] == ["30", "unbounded"]
    assert off["legendgroup"] == line["legendgroup"]
    assert "beyond the axis" in chart.note
