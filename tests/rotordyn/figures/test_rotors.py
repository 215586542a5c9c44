"""How figures and text tell several rotors apart, on the co-axial rotor of the cases."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from matplotlib.collections import LineCollection, PolyCollection

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.figures.diagram import campbell_figure, orders
from rotordyn.analyses.campbell.figures.shapes import shapes_figure
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.figures.response import response_figure
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.figures.machine import machine_figure
from rotordyn.report.summary import summary
from rotordyn.report.tables import write_tables
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL, OUTER
from tests.oracles.spindles import RPM, case


@pytest.fixture(scope="module")
def scene() -> Scene:
    return Scene(COAXIAL, Conditions(), np.linspace(0.0, 15000.0, 11) * RPM, 250.0)


@pytest.fixture(scope="module")
def modes(scene: Scene) -> CampbellResult:
    return campbell.solve(scene, CampbellSpec(250.0, engine_orders=(1, 2)))


def turning(ratio: float, modes: CampbellResult) -> CampbellResult:
    return replace(modes, speed_ratio=np.array([1.0, ratio]))


def test_every_rotor_has_its_lines(modes: CampbellResult) -> None:
    assert orders(modes, [3, 4]) == {
        1.0: "1× spindle",
        2.0: "2× spindle",
        1.5: "1× outer",
        3.0: "2× outer, 3× (teeth)",
        4: "4× (teeth)",
    }
    assert orders(turning(0.0, modes), ()) == {1.0: "1×", 2.0: "2×"}
    assert orders(turning(-1.0, modes), ())[1.0] == "1× spindle, 1× outer"
    asked = replace(modes, engine_order=np.array([0.2, 0.3, 3.0]))
    assert orders(asked, [3]) == {
        0.2: "0.2× spindle",
        0.3: "0.3× spindle, 0.2× outer",
        0.45: "0.3× outer",
        1.0: "1× spindle",
        1.5: "1× outer",
        3.0: "3× spindle, 3× (teeth)",
        4.5: "3× outer",
    }
    alone = replace(turning(0.0, modes), engine_order=np.array([0.43, 1.0, 3.0]))
    assert orders(alone, [3]) == {0.43: "0.43×", 1.0: "1×", 3.0: "3× (teeth)"}


def test_names_of_steep_lines_do_not_overlap_and_are_beside_their_lines(
    modes: CampbellResult,
) -> None:
    asked = replace(modes, engine_order=np.array([2.37, 2.5, 3.0, 40.0]))
    figure = campbell_figure(asked, teeth=(3, 5), max_frequency=250.0)
    (axes,) = figure.axes
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    names = {f" {name}": k for k, name in orders(asked, (3, 5)).items()}
    inside = [text for text in axes.texts if text.get_text() in names]
    boxes = [text.get_window_extent(renderer) for text in inside]
    assert len(boxes) >= 9
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    for text in inside:
        rpm, hertz = text.get_position()
        assert names[text.get_text()] * rpm / 60.0 == pytest.approx(hertz + 0.015 * 250.0)


def test_critical_speeds_lie_on_the_line_that_excites(modes: CampbellResult) -> None:
    (axes,) = campbell_figure(modes, max_frequency=250.0).axes
    assert axes.get_xlabel() == "speed of the spindle [rpm]"
    dots = next(line for line in axes.get_lines() if line.get_label() == "critical speed")
    rpm, hertz = np.asarray(dots.get_xdata()), np.asarray(dots.get_ydata())
    multiple = hertz / rpm * 60.0
    assert set(np.round(multiple, 9)) == {1.0, 1.5, 2.0, 3.0}
    for speed, frequency in zip(rpm[hertz < 250.0], hertz[hertz < 250.0], strict=True):
        near = [np.interp(speed * RPM, modes.speed, f) for f in modes.frequency.T]
        assert np.abs(np.array(near) / frequency - 1.0).min() < 0.02
    lines = [c for c in axes.collections if isinstance(c, LineCollection)]
    assert any(len(c.get_segments()) == 4 for c in lines)


def test_shapes_have_a_line_per_rotor(modes: CampbellResult) -> None:
    figure = shapes_figure(modes, COAXIAL)
    for axes in figure.axes:
        first, last = axes.get_xlim()
        assert first < 0.0 < 508.0 < last < 530.0
        curves = [line for line in axes.get_lines() if line.get_linestyle() != "None"]
        spans = [np.asarray(line.get_xdata())[[0, -1]].tolist() for line in curves]
        assert spans == [pytest.approx([0.0, 508.0])] * 2 + [pytest.approx([152.0, 406.0])] * 2
    (legend,) = figure.legends
    names = {text.get_text() for text in legend.get_texts()}
    assert {"spindle, 0 rpm", "outer, 0 rpm", "bearing or support", "point mass"} <= names
    top = legend.get_window_extent(figure.canvas.get_renderer())  # type: ignore[attr-defined]
    titles = [axes.title.get_window_extent() for axes in figure.axes]
    assert not any(top.overlaps(box) for box in titles)


def test_the_drawing_shows_the_outer_rotor_around_the_inner() -> None:
    figure = machine_figure(COAXIAL)
    (axes,) = figure.axes
    words = {text.get_text() for text in axes.texts}
    assert {"outer: 1.5 × the speed", "b3", "d2\n7 kg", "outer.d2\n203.0"} <= words
    boxes = [
        path.vertices[:4]
        for c in axes.collections
        if isinstance(c, PolyCollection)
        for path in c.get_paths()
        if len(path.vertices) == 5
    ]
    corners = {(*np.round(b.min(axis=0), 6), *np.round(b.max(axis=0), 6)) for b in boxes}
    assert (152.0, 25.0, 406.0, 30.0) in corners  # its wall, cut
    assert (152.0, -30.0, 406.0, 0.0) in corners  # its outside
    assert (0.0, 0.0, 508.0, 15.0) in corners  # the inner one, seen in the bore
    assert (401.0, 15.0, 411.0, 25.0) in corners  # the bearing between them


def test_a_rotor_beside_and_one_within_can_be_drawn() -> None:
    shaft = replace(OUTER.shaft, start=0.508)
    beside = replace(OUTER, name="tail", shaft=shaft, masses=(), points={})
    joint = replace(COAXIAL.supports[3], holds="tail", against="spindle")
    machine = replace(
        COAXIAL, rotors=(OUTER, beside), supports=(*COAXIAL.supports, replace(joint, name="b5"))
    )
    axes = machine_figure(machine).axes[0]
    assert axes.get_xlim()[1] > 762.0
    assert "tail: 1.5 × the speed" in {text.get_text() for text in axes.texts}


def test_text_and_tables_name_the_rotors(modes: CampbellResult, scene: Scene, tmp_path) -> None:
    spec = UnbalanceSpec(("d1", "outer.d2"), unbalances=(Unbalance("outer.d2", 1e-4),))
    moved = unbalance.solve(scene, spec)
    own = replace(case("lalanne_ferraris"), spindle=COAXIAL)
    text = " ".join(summary(own, {"campbell": modes, "unbalance": moved}).split())
    assert "rotor outer, 1.5 × the speed, 12.32 kg" in text
    assert "critical 1× of spindle, margin to top speed: bending 1 bw 4289 rpm" in text
    assert "critical 1× of outer, margin to top speed: bending 1 bw 3060 rpm" in text
    assert "100 g·mm at 203.0 mm on outer, at its speed" in text
    assert response_figure(moved).axes[-1].get_xlabel() == "speed of the spindle [rpm]"
    names = write_tables(tmp_path, {"campbell": modes})
    assert {"campbell_rotors.csv", "campbell_nodes.csv"} <= set(names)
    lines = (tmp_path / "campbell_nodes.csv").read_text(encoding="utf-8-sig").splitlines()
    assert lines[0] == "station [mm],rotor of the node"
    assert [line.rpartition(",")[2] for line in lines[1:]] == list(modes.node_rotor)
