"""Words on figures: which way loads count, of what a sum is, numbers that curves leave free."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb

from rotordyn.analyses.bearing_loads.figures.roses import rose_figure
from rotordyn.analyses.campbell.figures.diagram import campbell_figure
from rotordyn.analyses.frf.figures.map import map_figure
from rotordyn.analyses.preload.figures.over_speed import preload_figure
from rotordyn.analyses.thermal_preload.figures.over_difference import load_figure
from rotordyn.analyses.time_response.figures.histories import bearing_figure
from rotordyn.analyses.unbalance.figures import headline_curves
from rotordyn.analyses.unbalance.figures.runs import runs_figure
from rotordyn.analyses.unbalance.summary import accuracy
from rotordyn.figures.interval import bands_figure
from rotordyn.figures.style import add_axes, finish, new_figure
from rotordyn.results.described import Shown
from rotordyn.results.headline import Curve
from tests.rotordyn.figures import samples


def inside(axes):
    """Whether the labels of both axes are no longer than these."""
    axes.figure.canvas.draw()
    across, up = (each.label.get_window_extent() for each in (axes.xaxis, axes.yaxis))
    frame = axes.bbox
    return across.width <= 1.02 * frame.width and up.height <= 1.02 * frame.height


def test_preload_says_which_way_loads_count_and_what_is_summed():
    axes = preload_figure(samples.preload(5), samples.spindle()).axes
    assert axes[0].get_ylabel() == "axial load along thrust [N]"
    assert axes[1].get_ylabel() == "sum of preloads on sleeves [N]"
    assert all(inside(each) for each in axes)


def test_loads_over_time_count_along_the_axis():
    load = np.zeros((1, 5, 2, 3))
    result = SimpleNamespace(
        ended=np.ones(1), speed=np.zeros(1), bearing=("a", "b"), bearing_load=load,
        peak_load=np.ones((1, 2)), time=np.linspace(0.0, 0.1, 5),
    )  # fmt: skip
    labels = [axes.get_ylabel() for axes in bearing_figure(result).axes]
    assert labels == ["radial load [N]", "axial load towards +x [N]"]


def test_a_difference_of_temperature_says_to_what_it_is_added():
    result = SimpleNamespace(
        speed=np.array([0.0, 100.0, 200.0]), difference=np.linspace(-10.0, 20.0, 4),
        axial_load=np.ones((3, 4, 2)), bearing=("a", "b"),
    )  # fmt: skip
    for axes in load_figure(result).axes:
        assert axes.get_xlabel() == "temperature added to shaft,\ninner rings and balls [K]"
        assert inside(axes)


@pytest.mark.parametrize(("speeds", "shown"), [(2, 0.05), (3, 0.1), (7, 0.3), (8, 1.0)])
def test_a_map_of_few_speeds_has_colours_beside_these_alone(speeds, shown):
    image = map_figure(samples.frf(speeds, 100), [0]).axes[0].images[0]
    known = (np.asarray(image.get_array())[..., 3] > 0).any(axis=0)
    assert known.mean() == pytest.approx(shown, abs=0.01)
    assert known[0]
    assert known[-1]


def test_modes_in_their_bands_bear_their_names():
    rpm = np.linspace(0.0, 9000.0, 5)
    look = {"figure": "modes", "label": "frequency", "unit": "Hz", "x": rpm, "limits": (0.0, 1e3)}
    modes = {f"bending {k} {w}": 200.0 * k + (w == "fw") for k in (1, 2) for w in ("bw", "fw")}
    curves = {n: Curve(y=np.full(5, hz), series=n[-2:], end=n, **look) for n, hz in modes.items()}
    nominal = np.repeat([*modes.values()], 5)
    held = SimpleNamespace(
        curve=tuple(modes), rows_of=lambda k: slice(5 * k, 5 * k + 5), x=np.tile(rpm, 4),
        curve_nominal=nominal, curve_hypotheses=np.column_stack([nominal - 9.0, nominal + 9.0]),
        curve_tolerances=np.column_stack([nominal - 5.0, nominal + 5.0]),
    )  # fmt: skip
    (axes,) = bands_figure(held, curves).axes
    assert [text.get_text() for text in axes.texts] == ["bending 1 bw/fw", "bending 2 bw/fw"]
    axes.figure.canvas.draw()
    assert all(t.get_window_extent().x1 <= axes.figure.bbox.x1 for t in axes.texts)


def test_marks_at_the_sides_of_bands_are_whole():
    """Those of few speeds: their bars are drawn beyond the sides, not above or below."""
    rpm, load = np.array([0.0, 3000.0, 6000.0]), np.array([1.0, 2.0, 3.0])
    ends = np.column_stack([load - 0.5, load + 0.5])
    held = SimpleNamespace(
        curve=("load",), rows_of=lambda k: slice(None), x=rpm, curve_nominal=load,
        curve_hypotheses=ends, curve_tolerances=ends,
    )  # fmt: skip
    (axes,) = bands_figure(held, {"load": Curve("preload", "load", "N", rpm, load)}).axes
    canvas = FigureCanvasAgg(axes.figure)
    canvas.draw()
    pixels, colour = np.asarray(canvas.buffer_rgba())[..., :3], to_rgb(axes.lines[0].get_color())
    left, right = int(axes.bbox.x0), int(axes.bbox.x1)
    for beside in (slice(left - 2, left - 1), slice(right + 2, right + 3)):
        assert (np.abs(pixels[:, beside] / 255.0 - colour).max(axis=-1) < 0.15).any()


@pytest.mark.parametrize("least", [3, 8])
def test_a_band_leaves_the_frame_where_depths_do(least):
    rpm, depth = np.linspace(4000.0, 9000.0, 5), np.array([1.5, 3.0, math.inf, 3.0, 50.0])
    look = {"limits": (0.0, None), "ceiling": 10.0, "least": least}
    curve = Curve("stability_lobes", "depth of cut", "mm", rpm, depth, **look)
    held = SimpleNamespace(
        curve=("depth",), rows_of=lambda k: slice(None), x=rpm, curve_nominal=depth,
        curve_hypotheses=np.column_stack([depth / 2.0, depth]),
        curve_tolerances=np.column_stack([depth / 2.0, depth * 2.0]),
    )  # fmt: skip
    (axes,) = bands_figure(held, {"depth": curve}).axes
    assert 3.0 < axes.get_ylim()[1] < 4.0
    assert axes.get_xlim() == (4000.0, 9000.0)
    line, *off = axes.lines
    assert line.get_ydata() == pytest.approx([1.5, 3.0, 40.0, 3.0, 40.0])
    beyond = [(each.get_label(), each.get_marker(), each.get_xdata().tolist()) for each in off]
    assert beyond == [("beyond the axis", "^", rpm[1:].tolist())] * (least > 5)
    assert (line.get_linestyle() == "None") == (least > 5)
    for band in axes.collections:
        assert band.get_datalim(axes.transData).y1 == pytest.approx(40.0)


def test_lines_of_defects_are_named_along_them_those_side_by_side_once():
    base, turns = samples.campbell(9), samples.speeds(9) / (2.0 * math.pi)
    orders = np.array([3.02, 3.0, 2.4, 90.0])
    names = ("inner b", "inner a", "outer a", "ball a")
    result = replace(base, passing=names, passing_frequency=turns[:, None] * orders)
    axes = campbell_figure(result, max_frequency=3000.0).axes[0]
    texts = {t.get_text().strip(): t for t in axes.texts}
    assert {"inner a, b", "outer a", "ball a"} <= set(texts)
    assert not set(texts) & {"inner a", "inner b"}
    for name, order in (("inner a, b", 3.01), ("outer a", 2.4), ("ball a", 90.0)):
        x, y = texts[name].get_position()
        assert y == pytest.approx(order * x / 60.0)
        assert 0.0 < x < axes.get_xlim()[1]
        assert 0.0 < y < 3000.0
    beside = [t for t in axes.texts if t.get_position()[0] > axes.get_xlim()[1]]
    assert not any("inner" in t.get_text() for t in beside)


@pytest.mark.parametrize("towards", [0.0, 60.0, 180.0])
def test_circles_of_a_rose_are_named_where_balls_carry_least(towards):
    azimuth = np.linspace(0.0, 2.0 * math.pi, 20, endpoint=False)
    load = 200.0 * (1.1 + np.cos(azimuth - math.radians(towards)))
    result = SimpleNamespace(
        axial_load=np.ones((1, 1)), bearing=("a",), ball_azimuth=azimuth[None],
        ball_inner_load=load[None, None], speed=np.zeros(1),
    )  # fmt: skip
    figure = rose_figure(result)
    axes = figure.axes[0]
    assert figure.texts[0].get_text().endswith("y at 0°, z at 90°, seen from +x")
    rays = {text.get_position()[0] for text in axes.texts}
    (ray,) = rays
    assert math.cos(ray - math.radians(towards)) < -0.9
    over = max(line.get_zorder() for line in axes.lines)
    assert all(text.get_zorder() > over for text in axes.texts)
    assert len(axes.texts) > 1


def test_circles_of_a_rose_that_a_curve_runs_along_have_no_names():
    azimuth = np.linspace(0.0, 2.0 * math.pi, 20, endpoint=False)
    azimuth[-2:] = np.nan  # another bearing has two balls more
    load = np.array([38.0, 62.0, 125.0])[:, None] * np.where(np.isfinite(azimuth), 1.0, np.nan)
    result = SimpleNamespace(
        axial_load=np.ones((3, 1)), bearing=("a",), ball_azimuth=azimuth[None],
        ball_inner_load=load[:, None], speed=np.arange(3.0),
    )  # fmt: skip
    axes = rose_figure(result).axes[0]
    named = [float(text.get_text()) for text in axes.texts]
    high = axes.get_ylim()[1]
    assert named
    assert min(abs(each - at) for each in named for at in load[:, 0]) > 0.08 * high
    assert {38.0, 62.0, 125.0} & {*named} == set()


@pytest.mark.parametrize(
    ("runs", "panels"),
    [
        (("up",), ["Oc2 up", "O3 up"]),
        (("up", "down"), ["Oc2 up", "Oc2 down"]),
        (("a", "b", "c", "d", "e"), ["Oc2 a", "Oc2 b", "Oc2 c", "Oc2 d"]),
    ],
)
def test_comparisons_have_a_panel_for_every_run(runs, panels):
    steady = samples.unbalance(9)
    result = replace(steady, run=runs, run_amplitude=np.full((len(runs), 5, 2), 1e-6))
    curves = list(headline_curves(None, Shown("", result, (), None)))
    drawn = [each for each in curves if each.figure == "unbalance_runs"]
    assert [each.panel for each in drawn] == panels
    assert [each.panel for each in curves if each.figure == "unbalance"] == ["Oc2", "O3"]
    assert not {each.series for each in drawn} - {""}
    np.testing.assert_allclose(drawn[0].x, np.linspace(0.0, 1000.0, 5) * 30.0 / math.pi)
    np.testing.assert_allclose(drawn[0].y, 1.0)


def test_a_run_that_grows_beyond_bounds_is_cut_at_the_edge_and_named():
    steady = samples.unbalance(9)
    moved = np.full((3, 5, 2), 1e-6)
    moved[1, 3:, 0] = 1e3, 1e9  # m
    moved[2, :, 1] = np.nan, 1e-6, 1e-5, 5e-4, 5e-4  # grows, and is seen
    one = {"run": ("up", "on", "down"), "run_outcome": ("",) * 3, "run_amplitude": moved}
    first, second = runs_figure(replace(steady, **one)).axes
    peak, error = np.nanmax(moved, axis=1), np.array([2e-6, 7e-5, 1e-6])
    told = accuracy(replace(steady, **one, run_peak=peak, run_error=error))
    assert told[1:] == ["runs within 2e-06 of their peaks"]
    told = accuracy(replace(steady, **one, run_peak=peak[[1, 1, 1]], run_error=error))
    assert told[1:] == []
    assert first.get_title() == "Oc2, beyond the axis: on (to 1e+15)"
    assert second.get_title() == "O3"
    largest = 1e6 * np.nanmax(steady.fine_major_axis, axis=0)
    assert first.get_ylim()[1] == pytest.approx(1.6 * largest[0])
    assert second.get_ylim()[1] == pytest.approx(1.6 * 500.0)
    assert [len(axes.get_lines()) for axes in (first, second)] == [4, 4]


def test_a_run_that_grows_beyond_bounds_by_itself_leaves_the_steady_curve():
    steady = samples.unbalance(9)
    moved = np.full((1, 5, 2), 1e3)
    one = {"run": ("up",), "run_outcome": ("",), "run_amplitude": moved}
    first = runs_figure(replace(steady, **one)).axes[0]
    assert first.get_title() == "Oc2, beyond the axis: up (to 1e+09)"
    largest = 1e6 * np.nanmax(steady.fine_major_axis, axis=0)
    assert first.get_ylim()[1] == pytest.approx(1.6 * largest[0])


def test_a_constant_with_its_rounding_is_a_level_line():
    figure = new_figure()
    for k, values in enumerate(([85.39944, 85.39940], [1.0, 2.0], [1e-9, 1.00005e-9])):
        axes = add_axes(figure, (20.0, 10.0 + 30.0 * k, 60.0, 20.0))
        axes.plot([0.0, 1.0], values)
        axes.margins(y=0.0)
        axes.get_ylim()
    finish(figure)
    steady, changing, small = (axes.get_ylim() for axes in figure.axes)
    assert steady == pytest.approx((85.39942 * (1 - 1e-4), 85.39942 * (1 + 1e-4)), abs=1e-6)
    assert changing == (1.0, 2.0)
    assert small == pytest.approx((1.000025e-9 - 1e-13, 1.000025e-9 + 1e-13), rel=1e-6)
