"""Every figure of a case: drawn, labelled with units, saved as valid PNG, PDF and SVG."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rotordyn.analyses.bearing.solve import solve
from rotordyn.analyses.bearing.spec import BearingMapSpec
from rotordyn.analyses.bearing.summary import summary
from rotordyn.cli.streams import bar
from rotordyn.figures.draw import Drawing
from rotordyn.figures.png import write_png
from rotordyn.figures.style import FORMATS, HEAD_COLOUR, new_figure
from rotordyn.job.figures import figures
from rotordyn.scene.conditions import Conditions
from tests.oracles.known_bearings import RPM
from tests.oracles.known_grooves import QJ218, R24_14, four_point
from tests.rotordyn.figures import samples

NAMES = {
    "machine", "campbell", "mode_shapes", "frf_map", "frf_maps", "frf_surface",
    "frf_amplitude_phase_1", "frf_amplitude_phase_2", "frf_real_imaginary_1",
    "frf_real_imaginary_2", "stiffness", "stiffness_force", "preload", "contacts", "bearing",
    "bearing_life", "bearing_motion", "bearing_tangents", "section_forces",
    "elastic_line", "control", "unbalance", "unbalance_forces", "unbalance_runs",
    "unbalance_run_forces",
}  # fmt: skip


WRITTEN = {"campbell", "frf_map", "frf_surface", "machine"}


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture(scope="module")
def drawn(case, results):
    return {name: draw() for name, draw in figures(case, results)}


@pytest.fixture(scope="module")
def folder(tmp_path_factory, case, results):
    """Files of those figures between which writing differs: lines, rasters, a mesh in space."""
    path = tmp_path_factory.mktemp("figures")
    jobs = [job for job in figures(case, results) if job[0] in WRITTEN]
    seconds = Drawing(jobs, path, formats=FORMATS).finish()
    assert set(seconds) == WRITTEN
    assert all(value > 0.0 for value in seconds.values())
    return path


def test_all_figures_of_the_case(drawn):
    assert set(drawn) == NAMES


@pytest.mark.parametrize("name", sorted(NAMES))
def test_every_axis_label_has_a_unit(drawn, name):
    labels = [label for a in drawn[name].axes for label in (a.get_xlabel(), a.get_ylabel())]
    texts = [t.get_text() for a in drawn[name].axes for t in a.texts]
    with_unit = [text for text in labels + texts if re.search(r"\[[^\]]+\]$", text)]
    assert with_unit
    assert all(re.search(r"\[[^\]]+\]$", label) for label in labels if label)


@pytest.mark.parametrize("name", sorted(WRITTEN))
def test_files_are_valid(folder, name):
    assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")
    assert (folder / f"{name}.pdf").read_bytes().startswith(b"%PDF-")
    root = ET.parse(folder / f"{name}.svg").getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.findall(".//{http://www.w3.org/2000/svg}text"), "text must stay text"


@pytest.mark.parametrize("name", sorted(NAMES))
def test_machine_and_case_are_at_the_top_and_touch_nothing(drawn, case, name):
    figure = drawn[name]
    renderer = figure.canvas.get_renderer()
    words = [t for t in figure.texts if t.get_va() == "top" and t.get_color() == HEAD_COLOUR]
    said = " ".join(text.get_text() for text in words)
    assert case.spindle.title in said
    assert case.title in said
    boxes = [text.get_window_extent(renderer) for text in words]
    assert all(b.x0 >= 0.0 and b.x1 <= figure.bbox.x1 and b.y1 <= figure.bbox.y1 for b in boxes)
    others = [legend.get_window_extent(renderer) for legend in figure.legends]
    others += [a.get_tightbbox(renderer) for a in figure.axes if a.name != "3d"]
    lowest = min(b.y0 for b in boxes)
    assert all(other.y1 <= lowest + 1.0 for other in others if other is not None)


@pytest.mark.parametrize("name", sorted(n for n in NAMES if not n.startswith("frf")))
def test_no_line_is_distinguished_by_its_colour_alone(drawn, name):
    for axes in drawn[name].axes:
        looks = {}
        for line in axes.get_lines():
            if not str(line.get_label()).startswith("_"):
                look = (str(line._unscaled_dash_pattern), line.get_marker(), line.get_linewidth())
                looks.setdefault(look, set()).add(line.get_label())
        assert [names for names in looks.values() if len(names) > 1] == []


def test_print_size_and_dots_per_inch(folder):
    """168 mm are 1984 dots at 300 dpi, and 476.2 points of a PDF page."""
    with Image.open(folder / "campbell.png") as picture:
        assert picture.width == 1984
        assert picture.info["dpi"] == pytest.approx((300, 300), abs=0.01)
    page = re.search(rb"/MediaBox \[ *0 0 ([0-9.]+) ", (folder / "campbell.pdf").read_bytes())
    assert float(page[1]) == pytest.approx(168.0 / 25.4 * 72.0, abs=0.1)


def test_pixels_are_those_of_matplotlib(drawn, tmp_path):
    """Our file holds what matplotlib's own has, and is the same when written again."""
    figure = drawn["frf_map"]
    write_png(figure, tmp_path / "ours.png", 100.0)
    ours = (tmp_path / "ours.png").read_bytes()
    figure.savefig(tmp_path / "theirs.png", dpi=100.0)
    with Image.open(tmp_path / "ours.png") as one, Image.open(tmp_path / "theirs.png") as other:
        np.testing.assert_array_equal(np.asarray(one), np.asarray(other.convert("RGB")))
        assert (np.asarray(other)[..., 3] == 255).all()
    write_png(figure, tmp_path / "ours.png", 100.0)
    assert (tmp_path / "ours.png").read_bytes() == ours


@pytest.mark.parametrize("name", ["frf_map", "frf_surface"])
def test_rasters_stay_rasters_in_the_svg(folder, name):
    root = ET.parse(folder / f"{name}.svg").getroot()
    assert root.findall(".//{http://www.w3.org/2000/svg}image")
    assert len(root.findall(".//{http://www.w3.org/2000/svg}path")) < 300


def test_nothing_to_draw_without_results():
    assert figures(samples.SampleCase(), {}) == []


def test_bearing_alone(case):
    jobs = figures(
        samples.SampleCase(bearing=samples.ball_bearing(0.09, 25)), {"bearing": samples.bearing(3)}
    )
    assert [name for name, _ in jobs] == [
        *("bearing", "bearing_motion", "bearing_life", "bearing_tangents")
    ]


@pytest.mark.parametrize("limited", [True, False])
def test_a_bearing_that_warms_up(limited):
    """Temperatures of three parts over speed; the speed limit over the load, or that there is
    none."""
    result = samples.bearing(5, warm=1.0)
    if not limited:
        result = replace(result, speed_limit=np.full(result.load.size, np.nan))
    case = samples.SampleCase(bearing=samples.ball_bearing(0.09, 25))
    figure = dict(figures(case, {"bearing": result}))["bearing_heat"]()
    names = [a.get_ylabel() for a in figure.axes]
    assert names[0] == "temperature [°C]"
    assert names[3] == "speed limit [rpm]"
    legend = {text.get_text() for text in figure.axes[0].get_legend().get_texts()}
    assert legend == {"balls", "inner ring", "outer ring"}
    assert figure.axes[3].get_xlabel() == "axial load [N]"
    words = {text.get_text() for text in figure.axes[3].texts}
    assert words == (set() if limited else {"none up to 24000 rpm"})
    lines = [line for line in summary(result) if "speed limit" in line]
    assert len(lines) == 2
    ends = "speed limit 19200 rpm" if limited else "no speed limit up to there"
    assert lines[-1].endswith(ends)


@pytest.mark.few(1)
@pytest.mark.parametrize("keys", [{"radial_loads": (0.0, 6e3, 12e3)}, {"moments": (0.0, 300.0)}])
def test_a_bearing_whose_balls_differ(keys):
    """Contacts by load and around the ring; labels with units; NaN of unloaded contacts drawn."""
    bearing = four_point(R24_14)
    spec = BearingMapSpec(axial_load=20e3, **keys)
    speed = np.array([0.0, 3000.0]) * RPM
    found = solve(bearing, Conditions(kinematics="outer"), speed, spec)
    jobs = figures(samples.SampleCase(bearing=bearing), {"bearing": found})
    assert [name for name, _ in jobs] == [
        "bearing",
        "bearing_motion",
        "bearing_life",
        "bearing_contacts",
        "bearing_azimuth",
    ]
    for _, draw in jobs:
        figure = draw()
        figure.draw_without_rendering()
        labels = [t for a in figure.axes for t in (a.get_xlabel(), a.get_ylabel()) if t]
        assert labels
        assert all(re.search(r"\[[^\]]+\]$", label) for label in labels)


@pytest.mark.long
def test_a_four_point_bearing_under_thrust(tmp_path):
    bearing = four_point(QJ218)
    speed = np.array([0.0, 2000.0, 4000.0, 8000.0]) * RPM
    found = solve(bearing, Conditions(), speed, BearingMapSpec((5e3, 20e3)))
    jobs = figures(samples.SampleCase(bearing=bearing), {"bearing": found})
    assert [name for name, _ in jobs] == [
        *("bearing", "bearing_motion", "bearing_life", "bearing_contacts")
    ]
    Drawing(jobs, tmp_path, workers=1).finish()
    drawn = dict(jobs)["bearing_contacts"]()
    (counts,) = (a for a in drawn.axes if "contacts" in a.get_title())
    assert {t.get_text() for t in counts.texts} == {"2", "3"}


def test_race_control_alone():
    jobs = figures(
        samples.SampleCase(bearing=samples.ball_bearing(0.09, 25)), {"control": samples.control(3)}
    )
    assert [name for name, _ in jobs] == ["control"]


@pytest.mark.long
def test_one_speed_and_missing_values_can_be_drawn(case):
    results = samples.results(1, 40)
    results["campbell"].frequency[0, 2] = np.nan
    three = samples.results(3, 40)
    three["frf"].receptance[1] = np.nan
    three["preload"].axial_load[1] = np.nan
    for each in (results, three):
        for _, draw in figures(case, each):
            draw().draw_without_rendering()


def test_bare_rotor_on_linear_supports(tmp_path):
    from rotordyn.machine.support import LinearSupport

    spindle = samples.spindle()
    bare = replace(
        spindle,
        seats=(),
        sleeves=(),
        references=(),
        supports=(LinearSupport("left", 0.0, {("y", "y"): 1e7}),),
    )
    empty = samples.preload(2)
    empty = replace(empty, bearing=(), axial_load=np.zeros((2, 0)))
    jobs = figures(samples.SampleCase(spindle=bare), {"preload": empty})
    assert [name for name, _ in jobs] == ["machine"]
    Drawing(jobs, tmp_path, formats=("svg",)).finish()
    assert ">left<" in (tmp_path / "machine.svg").read_text()


def test_listing_figures_does_not_import_matplotlib():
    code = (
        "import sys; from rotordyn.job.figures import figures; import rotordyn.figures.draw;"
        "from tests.rotordyn.figures import samples as s;"
        "assert figures(s.case(), s.results(3, 20));"
        "sys.exit('matplotlib' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.long
def test_pyplot_is_never_imported(tmp_path):
    code = (
        "import sys; from pathlib import Path; from rotordyn.job.figures import figures;"
        "from rotordyn.figures.draw import Drawing;"
        "from tests.rotordyn.figures import samples as s;"
        "jobs = figures(s.case(), s.results(3, 20)); [draw() for _, draw in jobs];"
        f"Drawing(jobs[:2], Path({str(tmp_path)!r}), 1).finish();"
        "sys.exit('matplotlib.pyplot' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_failing_figure_surfaces_its_own_error(tmp_path, case, results):
    def broken():
        raise LookupError("no such mode")

    good = figures(case, results)[-1]
    for workers in (1, 2):
        drawing = Drawing([good, ("broken", broken), good], tmp_path, workers)
        with pytest.raises(LookupError, match="no such mode"), drawing:
            drawing.finish()


def test_nobody_draws_any_more_after_an_interruption(tmp_path, case, results, monkeypatch):
    main = os.getpid()

    def endless():
        if os.getpid() == main:
            raise KeyboardInterrupt
        time.sleep(60.0)

    monkeypatch.setattr("rotordyn.figures.draw._processors", lambda: 2)
    jobs = [("one", endless), ("two", endless)]
    with pytest.raises(KeyboardInterrupt), Drawing(jobs, tmp_path, workers=2) as drawing:
        drawing.finish()
    ((process, _),) = drawing._workers
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


def test_nothing_is_forked_beside_threads_that_may_hold_locks(tmp_path, monkeypatch):
    """Of a lock that another thread holds a forked process would never see the end."""
    lock, held, done = threading.Lock(), threading.Event(), threading.Event()

    def other():
        with lock:
            held.set()
            done.wait(0.2)

    def draw():
        with lock:
            return new_figure(60.0, 40.0)

    monkeypatch.setattr("rotordyn.figures.draw._processors", lambda: 2)
    thread = threading.Thread(target=other)
    thread.start()
    held.wait()
    with Drawing([("one", draw), ("two", draw)], tmp_path) as drawing:
        forked = len(drawing._workers)
        if not forked:
            drawing.finish()
    thread.join()
    assert forked == 0
    with Drawing([("one", draw), ("two", draw)], tmp_path) as drawing:
        assert len(drawing._workers) == 1


def test_the_bar_of_a_terminal_leaves_the_second_process(tmp_path, monkeypatch):
    monkeypatch.setattr("rotordyn.figures.draw._processors", lambda: 2)
    monkeypatch.setattr("sys.stderr", Terminal())
    jobs = [("one", lambda: new_figure(60.0, 40.0))] * 2
    with bar("reading", 2, quiet=False):
        assert threading.active_count() == 2
        with Drawing(jobs, tmp_path) as drawing:
            assert len(drawing._workers) == 1


def test_a_dying_worker_leaves_its_figures_to_us(tmp_path, case, results, monkeypatch):
    main = os.getpid()

    def deadly():
        if os.getpid() != main:
            os._exit(9)
        return good[1]()

    good = figures(case, results)[-1]
    monkeypatch.setattr("rotordyn.figures.draw._processors", lambda: 2)
    jobs = [("one", deadly), ("two", deadly)]
    drawing = Drawing(jobs, tmp_path, workers=2)
    assert list(drawing.finish()) == ["one", "two"]
    assert (tmp_path / "one.png").exists()
    assert (tmp_path / "two.png").exists()
