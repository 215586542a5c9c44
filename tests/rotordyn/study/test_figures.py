"""Figures of a study: every line is distinguished and named, no name is cut."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import rotordyn
from rotordyn.page.blocks import Markup
from rotordyn.study.columns import Column, parallel_coordinates, plain_group, scatter
from rotordyn.study.design import design
from rotordyn.study.figures import _joined, figures
from rotordyn.study.point import Outcome, Study

PRELOAD = "spindle.sleeves.front.spring.preload"
STATION = "spindle.bearings.c.x"
TRAVEL = "spindle.sleeves.front.stop_travel"
TRAVELS = ("40 um", "50 um", "60 um")


@pytest.fixture(scope="module")
def drawn() -> dict[str, Any]:
    """Three paths; the first travel has no solution, as a machine that a point does not take."""
    asked = {PRELOAD: ["300 N", "400 N", "450 N"], STATION: ["82 mm", "84 mm"], TRAVEL: [*TRAVELS]}
    points = design(rotordyn.load("mfw2310"), asked)
    numbers = {k: {"preload: sum at 0 rpm": (float(k), "N")} for k in range(points.count) if k % 3}
    outcomes = {k: Outcome(k, numbers.get(k, {})) for k in range(points.count)}
    made = figures(Study(rotordyn.load("mfw2310"), points), outcomes)
    return {name: draw() for name, draw in made}


def test_a_panel_says_at_how_many_points_there_is_no_number(drawn: dict[str, Any]) -> None:
    """The first travel has none."""
    (panel,) = drawn["study_preload"].axes
    assert [text.get_text() for text in panel.texts] == ["none at 6 of 18"]


def test_lines_of_a_third_path_are_distinguished_and_named(drawn: dict[str, Any]) -> None:
    figure = drawn["study_preload"]
    lines = [each for each in figure.axes[0].lines if np.isfinite(each.get_ydata()).any()]
    looks = {(each.get_color(), each.get_linestyle(), each.get_marker()) for each in lines}
    assert len(lines) == len(looks) == 4
    titles = [legend.get_title().get_text() for legend in figure.legends]
    assert titles == [f"{STATION} [mm]", f"{TRAVEL} [um]"]
    words = [[text.get_text() for text in legend.get_texts()] for legend in figure.legends]
    assert words == [["82", "84"], ["50", "60"]]  # the travels that have a line


def test_numbers_that_are_alike_have_one_panel_and_one_axis() -> None:
    """Such as both whirls of a mode at rest; of more than nine others the title says so."""
    asked = {PRELOAD: ["300 N", "400 N"], STATION: ["82 mm", "84 mm"], TRAVEL: [*TRAVELS]}
    points = design(rotordyn.load("mfw2310"), asked)
    rows = {}
    for k in range(points.count):
        rest = 900.0 + k
        numbers = {"bending 1 backward at 0 rpm": rest, "bending 1 forward at 0 rpm": rest + 1e-7}
        numbers |= {f"bending {n} forward at 9000 rpm": 990.0 + n * k for n in range(1, 11)}
        rows[k] = Outcome(k, {f"campbell: {name}": (v, "Hz") for name, v in numbers.items()})
    study = Study(rotordyn.load("mfw2310"), points)
    made = {name: draw() for name, draw in figures(study, rows)}
    panels = made["study_campbell"].axes
    assert len(panels) == 9
    heading = "bending modes, critical speeds, backward/forward: the 9 of 11 numbers that vary most"
    assert heading in [text.get_text() for text in made["study_campbell"].texts]
    rows = {k: Outcome(k, dict([*row.numbers.items()][:4])) for k, row in rows.items()}
    made = {name: draw() for name, draw in figures(study, rows)}
    titles = [axes.get_title("left") for axes in made["study_campbell"].axes]
    assert titles == [
        "bending 1 backward, forward at 0 rpm [Hz]",
        "bending 1 forward at 9000 rpm [Hz]",
        "bending 2 forward at 9000 rpm [Hz]",
    ]
    labels = made["study_across"].axes[0].get_xticklabels()[3:]
    assert [" ".join(label.get_text().split()) for label in labels] == [
        "campbell: bending 1 backward, forward at 0 rpm [Hz]",
        "campbell: bending 1 forward at 9000 rpm [Hz]",
    ]


def test_axes_of_parallel_coordinates_are_named_whole_within_the_figure(
    drawn: dict[str, Any],
) -> None:
    figure = drawn["study_across"]
    labels = figure.axes[0].get_xticklabels()
    names = ["".join(label.get_text().split("\n")) for label in labels]
    assert [n.partition("[")[0].rstrip() for n in names[:3]] == [PRELOAD, STATION, TRAVEL]
    assert labels[3].get_text().replace("\n", " ") == "preload: sum at 0 rpm [N]"
    boxes = [label.get_window_extent(figure.canvas.get_renderer()) for label in labels]
    assert min(box.x0 for box in boxes) >= 0.0
    assert max(box.x1 for box in boxes) <= figure.bbox.x1
    assert all(box.y0 >= 0.0 for box in boxes)
    assert all(a.x1 < b.x0 for a, b in pairwise(boxes))


def test_panels_of_numbers_that_some_points_lack_have_the_axis_of_all() -> None:
    """Such as critical speeds that some machines do not reach."""
    path = "spindle.sleeves.front.spring.preload"
    points = design(rotordyn.load("mfw2310"), {path: [300, 400, 500, 600]}, "grid")
    critical = "campbell: critical 4× bending 1 forward"
    rows = {
        k: Outcome(
            k,
            {"campbell: bending 1 at 0 rpm": (900.0 + k, "Hz")}
            | ({critical: (8000.0 + k, "rpm")} if k < 2 else {}),
        )
        for k in range(4)
    }
    drawn = dict(figures(Study(rotordyn.load("mfw2310"), points), rows))["study_campbell"]()
    assert len(drawn.axes) == 2
    (low, high), other = (axes.get_xlim() for axes in drawn.axes)
    assert (low, high) == other
    assert low < 300.0 < 600.0 < high


def test_parallel_coordinates_keep_points_that_lack_a_number() -> None:
    """Such as the speed of a stop that is not met: it has no axis, and that is said."""
    words = ("1", "2", "3")
    varied = [Column("preload", words, np.array([1.0, 2.0, 3.0]))]
    stop = Column("stop", ("5", "", "6"), np.array([5.0, np.nan, 6.0]))
    whole = Column("sum", words, np.array([7.0, 9.0, 8.0]))
    chart = parallel_coordinates("Points", varied, [stop, whole])
    (trace,) = chart.traces
    assert [each["label"] for each in trace["dimensions"]] == ["preload", "sum"]
    assert len(trace["dimensions"][0]["values"]) == 3
    assert "not every point has it: stop." in chart.note


def test_labels_at_the_mouse_are_templates() -> None:
    """Their markup is not escaped; what users write in them is."""
    varied = [Column("a <b>", ("1", "2"), np.array([1.0, 2.0]))]
    chart = scatter(
        varied, [Column("c", ("3", "4"), np.array([3.0, 4.0]))], [plain_group(2)], (0, 1)
    )
    assert isinstance(chart.traces[0]["hovertemplate"], Markup)
    assert not any(isinstance(each, Markup) for each in chart.traces[0]["text"])


@pytest.mark.parametrize(
    ("names", "one"),
    [
        (["b at 0 rpm", "f at 0 rpm"], "b, f at 0 rpm"),
        (["sum", "sum at 0 rpm"], "sum at 0 rpm"),
        (["a", "a"], "a"),
    ],
)
def test_numbers_that_are_alike_have_one_name(names: list[str], one: str) -> None:
    assert _joined(names) == one
