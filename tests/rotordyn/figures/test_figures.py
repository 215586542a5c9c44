"""What the figures of results show: lines, markers and limits from the numbers given."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib import colormaps
from matplotlib.collections import LineCollection

from rotordyn.analyses.axial_cycle.figures.loops import cycle_figure
from rotordyn.analyses.bearing.figures.tangents import tangents_figure
from rotordyn.analyses.campbell.figures.diagram import campbell_figure
from rotordyn.analyses.campbell.figures.shapes import plane_curve, shapes_figure
from rotordyn.analyses.campbell.summary import accuracy
from rotordyn.analyses.control.figures.boundaries import control_figure
from rotordyn.analyses.frf.figures.decimate import nearest, peak_bins
from rotordyn.analyses.frf.figures.map import map_figure
from rotordyn.analyses.frf.figures.slices import (
    LINEAR,
    amplitude_phase_figure,
    real_imaginary_figure,
)
from rotordyn.analyses.frf.figures.surface import surface_figure
from rotordyn.analyses.frf.result import InertanceResult, MobilityResult
from rotordyn.analyses.preload.figures.over_speed import contacts_figure, preload_figure
from rotordyn.analyses.section_forces.figures.diagrams import (
    FORCES,
    diagrams_figure,
    elastic_line_figure,
    speeds_shown,
)
from rotordyn.analyses.stiffness.figures.curves import stiffness_figure
from rotordyn.analyses.unbalance.figures.response import response_figure, round_orbits
from rotordyn.figures.mode_lines import LOOKS, jumps, whirl_segments
from rotordyn.job.figures import comparison_figures, figures
from rotordyn.machine.lumped import Disc
from rotordyn.machine.reference import Reference
from rotordyn.modes.overdamped import OVERDAMPED
from tests.rotordyn.figures import samples


def compared(analysis, name, *results):
    """A figure of variants "a", "b" …"""
    own = samples.case()
    shown = [
        (replace(own, title=title), {analysis: result})
        for title, result in zip("abcdef", results, strict=False)
    ]
    return dict(comparison_figures(shown))[name]()


def _labels(axes):
    return axes.get_legend_handles_labels()[1]


def test_whirl_is_distinguished_by_look():
    curves = whirl_segments(samples.campbell(9))
    assert {look: len(lines) for look, lines in curves.items()} == {
        "backward": 4, "forward": 4, "axial": 1, "torsion": 1,
    }  # fmt: skip
    assert all(len(line) == 9 for lines in curves.values() for line in lines)
    assert LOOKS["forward"][1] == "-"


def test_a_mode_that_turns_its_whirl_is_cut_without_a_gap():
    result = samples.campbell(9)
    whirl = result.whirl.copy()
    whirl[5:, 0] = 1.0
    curves = whirl_segments(replace(result, whirl=whirl))
    first = next(c for c in curves["backward"] if len(c) == 5)
    second = next(c for c in curves["forward"] if len(c) == 5)
    np.testing.assert_array_equal(first[-1], second[0])


def test_campbell_lines_markers_and_names():
    axes = campbell_figure(samples.campbell(9), (3, 8), samples.references(), 3500.0).axes[0]
    words = [t.get_text() for t in axes.texts]
    assert {"1×", "3× (teeth)", "8× (teeth)"} <= set(words)
    assert "1 fw  713 Hz" in words
    assert {"forward whirl", "critical speed", "published"} <= set(_labels(axes))
    listed = [text.get_text() for text in axes.figure.texts]
    assert "1: 20400 rpm, 340.0 Hz, axial" in listed
    assert "1" in words
    critical = next(line for line in axes.lines if line.get_label() == "critical speed")
    np.testing.assert_allclose(critical.get_xydata(), [[20400.0, 340.0]])
    known = next(line for line in axes.lines if line.get_label() == "published")
    np.testing.assert_allclose(known.get_ydata(), [903.0, 1350.0, 1580.0, 2860.0])


def test_two_speeds_bear_marks_and_no_lines():
    axes = campbell_figure(samples.campbell(2)).axes[0]
    lines = [
        c for c in axes.collections if isinstance(c, LineCollection) and c.get_label()[0] != "_"
    ]
    assert not lines
    marks = {line.get_label(): line for line in axes.lines if line.get_linestyle() == "None"}
    assert {"forward whirl", "backward whirl", "axial", "torsion"} <= set(marks)
    signs = [marks[name].get_marker() for name in ("forward whirl", "backward whirl", "axial")]
    assert len(set(signs)) == 3
    rpm, hertz = marks["torsion"].get_data()
    result = samples.campbell(2)
    np.testing.assert_allclose(rpm, [0.0, 24000.0])
    np.testing.assert_allclose(hertz, result.frequency[:, result.kind.index("torsion")])


def test_a_frequency_that_jumps_where_a_stop_closes_is_cut_there():
    result = samples.campbell(9)
    column = result.kind.index("axial")
    frequency, stopped = result.frequency.copy(), np.zeros(9)
    frequency[6:, column] += 120.0
    moved = replace(result, frequency=frequency)
    assert len(whirl_segments(moved)["axial"]) == 1, "no stop: a line that rises"
    stopped[6:] = 1.0
    jumped = replace(moved, stopped=stopped)
    assert jumps(jumped).sum() == 1
    assert [len(curve) for curve in whirl_segments(jumped)["axial"]] == [6, 3]
    assert "a stop closes" in _labels(campbell_figure(jumped).axes[0])
    assert "a stop closes" not in _labels(campbell_figure(moved).axes[0])


def test_a_jump_on_a_steep_slope_is_cut_and_a_bend_is_not():
    """Frequencies that fall by 60 Hz a step: one rises by 92 Hz where the stop closes, the other
    goes on there between the slopes of both sides."""
    result = samples.campbell(9)
    jumping, bending = result.kind.index("axial"), result.kind.index("bending")
    frequency, stopped = result.frequency.copy(), np.zeros(9)
    stopped[6:] = 1.0
    frequency[:, jumping] = 900.0 - 60.0 * np.arange(9) + 92.0 * stopped
    frequency[:, bending] = np.cumsum([900.0, *[-60.0] * 5, -20.0, 10.0, 10.0])
    steep = replace(result, frequency=frequency, stopped=stopped)
    assert np.argwhere(jumps(steep)).tolist() == [[5, jumping]]
    turned = replace(steep, frequency=1800.0 - frequency)
    assert np.argwhere(jumps(turned)).tolist() == [[5, jumping]], "it falls where others rise"
    last = replace(result, frequency=frequency[:7], stopped=stopped[:7])
    assert jumps(last)[5, jumping], "no step behind it"


def test_campbell_shows_where_a_mode_is_unstable():
    result = samples.campbell(9)
    ratio = result.damping_ratio.copy()
    ratio[6:, 2] = -1e-3
    axes = campbell_figure(replace(result, damping_ratio=ratio)).axes[0]
    assert _labels(axes).count("unstable") == 1
    bands = [line for line in axes.lines if line.get_linewidth() == 6.0]
    drawn = [np.isfinite(line.get_ydata()) for line in bands]
    assert [flags.tolist() for flags in drawn if flags.any()] == [[False] * 6 + [True] * 3]
    assert "unstable" not in _labels(campbell_figure(result).axes[0])


def test_campbell_omits_overdamped_modes():
    result = samples.campbell(9)
    ratio = result.damping_ratio.copy()
    ratio[:, 0], ratio[4, 2] = 0.9999, 0.9999  # the second does oscillate, but at one speed
    overdamped = replace(result, damping_ratio=ratio)
    lines = [len(whirl_segments(r).get("backward", [])) for r in (result, overdamped)]
    assert lines[1] == lines[0] - 1
    names = [
        {t.get_text() for t in campbell_figure(r).axes[0].texts if t.get_text() != "1×"}
        for r in (result, overdamped)
    ]
    (gone,) = names[0] - names[1]
    assert gone.startswith(result.mode[0])


def test_figure_and_summary_tell_one_error_of_oscillating_modes():
    """Neither names the error of an overdamped motion; both name that of a strongly damped one."""
    result = samples.campbell(9)
    ratio, error = result.damping_ratio.copy(), result.frequency_error.copy()
    ratio[:5, 0], ratio[:4, 1], ratio[:, 2] = 0.9999, 0.9999, 0.9
    error[:, 0], error[0, 1], error[3, 2] = 0.5, 0.4, 0.021
    strong = replace(
        result, damping_ratio=ratio, frequency_error=error, overdamped=ratio > OVERDAMPED
    )
    assert strong.mostly_overdamped.tolist() == [k == 0 for k in range(len(result.mode))]
    assert strong.largest_error == 0.021
    assert accuracy(strong) == ["frequencies within 3e-02"]
    said = [t.get_text() for t in campbell_figure(strong).axes[0].texts]
    assert "estimated error ≤ 3e-02" in said


def test_campbell_of_variants_shows_where_a_mode_is_unstable():
    result = samples.campbell(9)
    ratio = result.damping_ratio.copy()
    ratio[6:, 2] = -1e-3
    grown = replace(result, damping_ratio=ratio)
    figure = compared("campbell", "campbell", result, grown)
    assert ["unstable" in _labels(axes) for axes in figure.axes] == [False, True]


def test_campbell_names_do_not_overlap():
    figure = campbell_figure(samples.campbell(9), (1, 2, 3, 4, 5, 6), (), 3500.0)
    renderer = figure.canvas.get_renderer()
    names = [text for text in figure.axes[0].texts if text.get_text() != "1"]  # of a ring
    boxes = [text.get_window_extent(renderer) for text in names]
    boxes.sort(key=lambda box: box.y0)
    assert all(low.y1 <= high.y0 + 1.0 for low, high in pairwise(boxes))
    assert max(b.x1 for b in boxes) <= figure.bbox.x1


def test_a_line_that_leaves_at_the_top_is_named_there():
    axes = campbell_figure(samples.campbell(9), (20,), (), 3500.0).axes[0]
    text = next(t for t in axes.texts if "20×" in t.get_text())
    assert text.get_position()[0] == pytest.approx(3500.0 * 60.0 / 20.0)


def test_plane_curve_follows_the_phase():
    shape = np.exp(0.4j) * np.array([[0.0, 0.0], [0.5, 0.1j], [-2.0, 0.2j]])
    np.testing.assert_allclose(plane_curve(shape), [0.0, -0.25, 1.0])
    np.testing.assert_array_equal(plane_curve(np.zeros((3, 2), complex)), np.zeros(3))


def test_a_panel_per_mode_with_both_speeds():
    result = samples.campbell(3)
    few = replace(
        result,
        mode=result.mode[:4],
        kind=result.kind[:4],
        frequency=result.frequency[:, :4],
        whirl=result.whirl[:, :4],
        shape=result.shape[:, :4],
    )
    axes = shapes_figure(few, samples.spindle()).axes
    assert [a.get_title().split(":")[0] for a in axes] == ["1 bw", "1 fw", "2 bw", "2 fw"]
    curves = [[line for line in a.lines if line.get_linestyle() != "None"] for a in axes]
    assert [len(each) for each in curves] == [2] * 4
    assert axes[0].get_ylabel() == "relative motion [-]"
    assert {"0 rpm", "24000 rpm", "bearing or support"} <= _names(axes[0].figure)


def _names(figure):
    return {text.get_text() for legend in figure.legends for text in legend.get_texts()}


def test_a_shape_is_smooth_between_its_nodes():
    """Of a sine known at eight nodes with its slope, the line is the sine; a shear beam as long as
    ours would leave it by the shear angle alone."""
    result, spindle = samples.campbell(2), samples.spindle()
    node = result.node[::10]
    wave = math.pi / np.ptp(node)
    shape = np.zeros((2, 1, node.size, 6), complex)
    shape[:, 0, :, 1] = np.sin(wave * (node - node[0]))
    shape[:, 0, :, 5] = wave * np.cos(wave * (node - node[0]))
    few = replace(
        result, node=node, node_rotor=("spindle",) * node.size, mode=("1",), kind=("bending",),
        frequency=result.frequency[:, :1], whirl=result.whirl[:, :1], shape=shape,
        damping_ratio=result.damping_ratio[:, :1],
    )  # fmt: skip
    axes = shapes_figure(few, spindle).axes[0]
    x, y = (
        axes.lines[0].get_data()
        if axes.lines[0].get_linestyle() != "None"
        else (axes.lines[1].get_data())
    )
    assert len(x) > 5 * node.size
    np.testing.assert_allclose(y, np.sin(wave * (x / 1e3 - node[0])), atol=0.012)
    slope = np.diff(y) / np.diff(x)
    assert np.abs(np.diff(slope)).max() < 0.1 * np.ptp(slope)


def test_bearings_of_a_cycle_differ_by_marks():
    """Dashes are those of the branch, and colour alone is not enough."""
    names, force = ("a", "b", "c"), np.linspace(-1e3, 1e3, 21)
    bodies = SimpleNamespace(
        speed=np.zeros(1),
        branch=("falling", "rising"),
        force=force,
        bearing=names,
        position=np.broadcast_to(1e-9 * force[:, None], (1, 2, 21, 1)),
        axial_load=np.stack([force * k for k in (1.0, 2.0, 3.0)], axis=-1)[None, None].repeat(2, 1),
    )
    lines = cycle_figure(bodies).axes[1].get_lines()
    marks = {line.get_label(): line.get_marker() for line in lines if line.get_label() in names}
    assert list(marks) == list(names)
    assert len({*marks.values()}) == len(names)


def test_discs_are_part_of_the_outline_of_shapes():
    disc = Disc("flywheel", 0.2, 0.3, 0.05, 0.02, samples.spindle().shaft.sections[0].material)
    spindle = replace(samples.spindle(), discs=(disc,))
    figure = shapes_figure(samples.campbell(2), spindle)
    assert "disc" in _names(figure)


def test_modes_omitted_are_counted():
    """Of whirling pairs the backward ones go first, but only where names tell of pairs."""
    result = samples.campbell(3)
    figure = shapes_figure(result)
    assert "1 more mode in the results file" in figure.texts[0].get_text()
    long = {"bw": "backward", "fw": "forward"}
    names = [" ".join(long.get(word, word) for word in name.split()) for name in result.mode]
    figure = shapes_figure(replace(result, mode=tuple(names)))
    assert "4 more modes in the results file" in figure.texts[0].get_text()
    assert not any("backward" in axes.get_title() for axes in figure.axes)


def test_map_covers_the_axes_and_carries_the_modes():
    axes = map_figure(samples.frf(9, 100), [0], samples.campbell(9)).axes[0]
    assert axes.get_xlim() == (0.0, pytest.approx(24000.0))
    assert sum(isinstance(c, LineCollection) for c in axes.collections) == 4
    assert not map_figure(samples.frf(9, 100), [0]).axes[0].collections


def _drawn_up_to(image):
    """The upper end of the colours of a map, whose colour is there."""
    top = colormaps["viridis"](1.0, bytes=True)
    assert (np.asarray(image.get_array()) == top).all(axis=-1).any()
    return image.get_clim()[1]


def test_map_keeps_the_largest_amplitude():
    frf = samples.frf(9, 2000)
    image = map_figure(frf, [0]).axes[0].images[0]
    largest = np.abs(frf.receptance[:, 0]).max() * 1e6
    assert _drawn_up_to(image) == pytest.approx(np.log10(largest))


def test_uneven_speeds_are_put_where_they_belong():
    frf = samples.frf(9, 50)
    uneven = replace(frf, speed=frf.speed**2 / frf.speed[-1])
    values = map_figure(uneven, [0]).axes[0].images[0].get_array()
    assert values.shape[1] == 480
    assert np.ptp(values[:, :2], axis=1).max() == 0


def test_surface_keeps_peaks_and_leaves_out_missing_speeds():
    frf = samples.frf(9, 2000)
    values = frf.receptance.copy()
    values[4] = np.nan
    figure = surface_figure(replace(frf, receptance=values), 0)
    surface = next(c for c in figure.axes[0].collections if c.get_rasterized())
    assert len(surface.get_paths()) == 7 * 259


def test_slices_have_a_line_per_speed():
    frf = samples.frf(9, 100)
    figure = amplitude_phase_figure(frf, [0, 3])
    assert [len(a.lines) for a in figure.axes] == [3, 3, 3, 3]
    assert [t.get_text() for t in figure.legends[0].get_texts()] == [
        "0 rpm", "12000 rpm", "24000 rpm",
    ]  # fmt: skip
    real = real_imaginary_figure(frf, [1]).axes[0].lines[2].get_ydata()
    np.testing.assert_allclose(real, frf.receptance[-1, 1].real * 1e6)


@pytest.mark.parametrize(("part", "flat"), [(1e-15, True), (1e-6, False)])
def test_an_imaginary_part_of_mere_rounding_is_drawn_as_zero(part, flat):
    frf = samples.frf(3, 200)
    values = frf.slice_value.real * (1.0 + 1j * part)
    axes = real_imaginary_figure(replace(frf, slice_value=values), [0]).axes[1]
    words = [text.get_text() for text in axes.texts]
    assert words == (["zero: no damping"] if flat else [])
    assert (axes.get_ylim() == (-1.0, 1.0)) == flat


def test_a_map_shows_peaks_between_its_frequencies_and_no_speed_below_the_first():
    frf = samples.frf(9, 40)
    speed = frf.speed + 100.0
    at, value = np.full((9, 4, 1), np.nan), np.full((9, 4, 1), complex(np.nan, np.nan))
    at[4, 0], value[4, 0] = 0.5 * (frf.frequency[20] + frf.frequency[21]), 1e-3
    one = replace(frf, speed=speed, resonance=np.arange(1), peak_frequency=at, peak_value=value)
    axes = map_figure(one, [0]).axes[0]
    assert _drawn_up_to(axes.images[0]) == pytest.approx(np.log10(1e-3 * 1e6))
    assert axes.get_xlim()[0] == pytest.approx(speed[0] * 30.0 / np.pi)
    first, up = axes.get_xlim()[0], frf.frequency[20]
    cells = [
        axes.images[0].get_cursor_data(SimpleNamespace(xdata=first + dx, ydata=up))
        for dx in (-1.0, 1.0)
    ]
    assert cells[0] is None
    assert cells[1] is not None


def test_real_parts_of_sharp_peaks_stay_readable():
    frf = samples.frf(3, 2000)
    sharp = frf.slice_value.copy()
    sharp[:, 0, 500] *= 1e6
    figure = real_imaginary_figure(replace(frf, slice_value=sharp), [0])
    axes = figure.axes[0]
    assert axes.get_yscale() == "symlog"
    bend = axes.yaxis.get_transform().linthresh
    (band,) = axes.patches
    assert (band.get_y(), band.get_height()) == pytest.approx((-bend, 2.0 * bend))
    assert LINEAR in [text.get_text() for text in figure.legends[0].get_texts()]
    plain = real_imaginary_figure(frf, [0]).axes[0]
    assert plain.get_yscale() == "linear"
    assert not plain.patches


def test_phase_does_not_draw_its_jumps():
    frf = samples.frf(3, 2000)
    figure = amplitude_phase_figure(frf, [1])
    phase = figure.axes[1].lines[0].get_ydata()
    steps = np.abs(np.diff(phase))
    assert np.isnan(phase).any()
    assert np.nanmax(steps) < 200.0


def test_tangents_have_a_curve_per_load_and_a_map():
    known = Reference("frozen_error", "published", "x", (samples.TOP,), (0.16,))
    result = samples.bearing(9)
    figure = tangents_figure(result, (known,))
    curves, chart, scale = figure.axes[:3]
    assert scale.get_ylabel() == "error [%]"
    assert [t.get_text() for t in figure.legends[0].get_texts()] == [
        "250 N", "500 N", "1000 N", "1500 N", "2000 N",
    ]  # fmt: skip
    ends = [line.get_ydata()[-1] for line in curves.lines[:5]]
    np.testing.assert_allclose(ends, [-16.0, -8.0, -4.0, -8.0 / 3.0, -2.0])
    marker = next(line for line in curves.lines if line.get_label() == "published magnitude")
    np.testing.assert_allclose(marker.get_xydata(), [[24000.0, -16.0]])
    assert "largest -16.0 % at 24000 rpm, 250 N" in chart.get_title()


def test_few_loads_have_no_map_and_exact_tangents_no_lines():
    result = samples.bearing(9)
    few = replace(result, load=result.load[:4], stiffness=result.stiffness[:, :4])
    assert len(tangents_figure(few).axes) == 2
    same = replace(result, stiffness=np.repeat(result.stiffness[:, :, :1], 2, axis=2))
    chart = tangents_figure(same).axes[1]
    assert [text.get_text() for text in chart.texts] == ["no difference"]


def test_a_missing_state_leaves_a_gap():
    result = samples.bearing(9)
    values = result.stiffness.copy()
    values[-1, 0] = np.nan
    figure = tangents_figure(replace(result, stiffness=values))
    assert np.isnan(figure.axes[0].lines[0].get_ydata()[-1])
    assert "250 N" in figure.axes[1].get_title()


def test_race_control_has_regions_boundaries_and_their_fits():
    result = samples.control(13)
    figure = control_figure(result)
    axes = figure.axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("speed [rpm]", "axial load [N]")
    figure.canvas.draw()
    at = {t.get_text(): t.get_window_extent() for t in figure.legends[0].get_texts()}
    assert sorted(at, key=lambda name: (-round(at[name].y0, -1), at[name].x0)) == [  # as read
        "neither race controls", "inner race controls", "outer race controls",
        "inner race controls above", "quadratic fit, inner race",
        "outer race controls up to", "quadratic fit, outer race",
    ]  # fmt: skip
    for line, factor in zip(axes.lines, (4.0, 4.0, 3.0, 3.0), strict=True):
        rpm, load = line.get_data()
        np.testing.assert_allclose(load[1:], factor * (rpm[1:] / 1000.0) ** 2)
        assert np.isnan(load[0])
    for where, colours in (((12000.0, 900.0), 2), ((12000.0, 500.0), 1), ((12000.0, 200.0), 3)):
        assert _top_shade(axes, where) == colours


def _top_shade(axes, point):
    """1, 2, 3: the shade drawn last at a point: neither, inner, outer."""
    shades = [c for c in axes.collections if c.get_paths()]
    inside = [any(path.contains_point(point) for path in c.get_paths()) for c in shades]
    return max(k for k, hit in enumerate(inside, 1) if hit)


def test_race_control_without_boundary_or_state():
    result = samples.control(13)
    lost = result.inner_margin.copy()
    lost[6:, :10] = np.nan
    bare = replace(
        result,
        boundary_load=np.full((2, 13), np.nan),
        fit_absence=("none", "none"),
        inner_margin=np.where(np.isnan(lost), lost, -0.1),
        outer_margin=np.where(np.isnan(lost), lost, 0.1),
        radial=0.2,
    )
    figure = control_figure(bare)
    assert [t.get_text() for t in figure.legends[0].get_texts()] == [
        "outer race controls all balls", "no state",
    ]  # fmt: skip
    words = np.where(np.isnan(lost), "third contact", "")
    third = control_figure(replace(bare, state=words)).legends[0].get_texts()
    assert third[1].get_text() == "third contact"
    assert figure.axes[0].get_ylabel() == "axial load, radial 0.2 of it [N]"
    assert not figure.axes[0].lines
    alone = control_figure(samples.control(1))
    assert len(alone.axes[0].collections) == 0
    axes = compared("control", "control", result, bare).axes[0]
    assert {"a", "b: none"} <= set(_labels(axes))


def test_references_are_beside_the_stiffness():
    axes = stiffness_figure(samples.stiffness(9), samples.references(), "Oc2").axes[0]
    assert axes.get_ylabel() == "radial stiffness at Oc2 [N/µm]"
    assert _labels(axes)[0] == "nonlinear, full"
    known = {line.get_label(): line for line in axes.lines if line.get_linestyle() == "None"}
    signs = [line.get_marker() for line in known.values()]
    assert len(set(signs)) == len(signs)
    assert axes.get_xlim()[1] > 24000.0, "a mark at the end stays off the frame"
    measured = next(line for line in axes.lines if line.get_label() == "measured")
    np.testing.assert_allclose(measured.get_xydata(), [[4000.0, 134.0], [24000.0, 56.3]])


def test_preload_sum_is_what_the_sleeves_carry():
    result = samples.preload(9)
    axes = preload_figure(result, samples.spindle(), samples.references()).axes
    assert _labels(axes[0]) == ["a, b", "c", "d, e", "a stop closes"]
    computed, published = axes[1].lines[:2]
    np.testing.assert_allclose(computed.get_ydata(), result.axial_load[:, 2:].sum(axis=1))
    np.testing.assert_allclose(published.get_xydata(), [[24000.0, 1750.0]])
    assert "measured rear sleeve" in _labels(axes[2])


def test_a_stop_bears_from_the_speed_on_at_which_it_closes():
    result = samples.preload(5)  # without force up to 18 000 rpm, the fourth of five speeds
    for closes, ahead in ((0.75, False), (0.875, True)):
        met = replace(result, stop_speed=result.stop_speed / 0.75 * closes)
        forces = preload_figure(met, samples.spindle()).axes[3]
        line = next(one for one in forces.lines if one.get_label().endswith(", stop"))
        assert len(line.get_xdata()) == 5 + ahead
        assert np.interp(closes * 24000.0, *line.get_data()) == 0.0


def test_a_sleeve_and_its_spring_stay_from_the_speed_on_at_which_the_stop_closes():
    """Between speeds, where of the shaft and of another sleeve nothing is known."""
    result = samples.preload(5)
    met = replace(result, stop_speed=result.stop_speed / 0.75 * 0.7)  # 16 800, not 18 000 rpm
    axes = preload_figure(met, samples.spindle()).axes
    shifts = {line.get_label(): line for line in axes[2].lines}
    springs = {line.get_label(): line for line in axes[3].lines}
    for line, there in (
        (shifts["front sleeve"], met.position[3, 1] * 1e6),
        (springs["front sleeve, spring"], met.spring_force[3, 0]),
    ):
        rpm = [0.0, 6000.0, 12000.0, 16800.0, 18000.0, 24000.0]
        np.testing.assert_allclose(line.get_xdata(), rpm)
        assert line.get_ydata()[3] == there
    for body in ("shaft", "rear sleeve"):
        assert np.isnan(shifts[body].get_ydata()).tolist() == [False] * 3 + [True] + [False] * 2
    assert len(springs["rear sleeve, spring"].get_xdata()) == 5


def test_peak_bins_keep_the_peak_and_fill_gaps():
    coordinate, values = np.array([0.0, 1.0, 2.0, 10.0]), np.array([[1.0, 5.0, 2.0, 10.0]])
    found = peak_bins(values, coordinate, np.array([0.0, 3.0, 5.0, 9.0, 11.0]))
    np.testing.assert_allclose(found, [[5.0, 4.0, 7.0, 10.0]])


def test_nearest_takes_whole_rows():
    rows = np.arange(6.0).reshape(3, 2)
    found = nearest(rows, np.array([0.0, 1.0, 4.0]), np.array([0.4, 0.6, 2.4, 2.6, 9.0]))
    np.testing.assert_array_equal(found[:, 0], [0.0, 2.0, 2.0, 4.0, 4.0])


def test_section_forces_have_a_panel_each_with_upright_jumps():
    result = samples.section_forces(9)
    panels = diagrams_figure(result, samples.spindle()).axes
    assert len(panels) == len(FORCES)
    shear = next(line for line in panels[1].lines if line.get_label() == "24000 rpm")
    x, y = shear.get_data()
    (jump,) = np.flatnonzero(np.abs(np.diff(y)) > 1.0)
    assert x[jump] == x[jump + 1]
    np.testing.assert_allclose(y[[jump, jump + 1]], [-500.0, 500.0])
    names = {text.get_text() for text in panels[0].texts}
    assert {"front", "rear", "nose"} <= names
    assert not panels[3].texts


def test_section_forces_show_a_speed_only_where_it_differs():
    result = samples.section_forces(9)
    assert [curve.name for curve in speeds_shown(result)] == ["0 rpm", "12000 rpm", "24000 rpm"]
    still = {name: np.tile(getattr(result, name)[:1], (9, 1)) for name in FORCES}
    assert [curve.row for curve in speeds_shown(replace(result, **still))] == [8]
    lost = result.torque.copy()
    lost[5:] = np.nan
    assert [curve.row for curve in speeds_shown(replace(result, torque=lost))] == [0, 2, 4]


def test_elastic_line_is_that_of_the_last_speed():
    result = samples.section_forces(9)
    panels = elastic_line_figure(result, None).axes
    line = next(line for line in panels[0].lines if line.get_label() == "deflection y")
    np.testing.assert_allclose(line.get_ydata(), result.deflection_y[-1] * 1e6)
    assert _labels(panels[2]) == ["normal stress", "shear stress of torsion", "von Mises stress"]


def test_a_twist_by_rounding_is_drawn_as_none():
    """Beside a deflection of micrometres; alone, a small one is a result."""
    result = samples.section_forces(9)
    little = replace(result, twist=np.full_like(result.twist, -1e-19))
    panels = elastic_line_figure(little, None).axes
    assert panels[1].get_ylim() == (-1.0, 1.0)
    assert not panels[1].lines[1].get_ydata().any()
    still = {name: np.zeros_like(result.twist) for name in ("deflection_y", "deflection_z")}
    panels = elastic_line_figure(replace(little, **still), None).axes
    assert panels[1].lines[1].get_ydata().all()


def test_section_forces_of_variants_have_a_line_each():
    own = samples.case()
    result = {"section_forces": samples.section_forces(3)}
    shown = [(replace(own, title=name), result) for name in "ab"]
    jobs = dict(comparison_figures(shown))
    panels = jobs["section_forces"]().axes
    assert _labels(panels[0]) == ["a", "b"]
    assert len(panels) == len(FORCES)
    assert {text.get_text() for text in panels[0].texts}, "supports are named above"


def test_response_to_unbalance_shows_planes_apart_and_criticals():
    result = samples.unbalance(49)
    panels = response_figure(result).axes
    assert len(panels) == 3
    assert _labels(panels[0]) == ["Oc2.y", "Oc2.z", "O3.y", "O3.z", "critical speed"]
    assert [t.get_text() for t in panels[0].texts] == [
        "bending 1\n10800 rpm\n180.0 Hz", "bending 2\n14400 rpm\n240.0 Hz",
    ]  # fmt: skip
    first = panels[0].get_lines()[0]
    np.testing.assert_allclose(first.get_ydata()[1:], result.amplitude[1:, 0, 0] * 1e6)
    assert np.isnan(first.get_ydata()[0]), "nothing moves at rest, and zero has no logarithm"


def test_round_orbits_need_one_line_per_point():
    result = samples.unbalance(9)
    even = replace(result, minor_axis=result.major_axis)
    assert round_orbits(even)
    panels = response_figure(even).axes
    assert len(panels) == 2
    assert _labels(panels[0]) == ["Oc2", "O3", "critical speed"]


def test_response_of_variants_is_drawn_over_one_another():
    result = samples.unbalance(9)
    panels = compared("unbalance", "unbalance", result, result).axes
    drawn = [[line for line in axes.get_lines() if len(line.get_xdata())] for axes in panels]
    assert [len(lines) for lines in drawn] == [2, 2]


@pytest.mark.parametrize(
    ("kind", "unit"), [(MobilityResult, "(mm/s)/N"), (InertanceResult, "(m/s²)/N")]
)
def test_mobility_and_inertance_say_so_on_every_figure(kind, unit):
    result = samples.frf_of(kind, 9, 300)
    for figure in (
        amplitude_phase_figure(result, [0]),
        map_figure(result, [0]),
        surface_figure(result, 0),
        compared("frf", "frf_curves_1", result, result),
    ):
        words = [t.get_text() for a in figure.axes for t in a.texts]
        words += [w for a in figure.axes for w in (a.get_title(), a.get_ylabel())]
        assert any(kind.kind in word for word in words)
        assert any(f"[{unit}]" in word for word in words)
        assert not any("receptance" in word for word in words)


def growing() -> object:
    """A mode that grows from 9000 rpm on, beside one damped far more."""
    plain = samples.campbell(49)
    ratio = plain.damping_ratio.copy()
    ratio[:, 1] = 0.02 * (1.0 - plain.speed / (9000.0 * np.pi / 30.0))
    ratio[:, 0] = 0.9
    return replace(
        plain,
        damping_ratio=ratio,
        stability_threshold=9000.0 * np.pi / 30.0,
        unstable_mode=plain.mode[1],
    )


def test_damping_is_drawn_where_a_mode_grows():
    own, result = samples.case(), growing()
    assert "damping" not in dict(figures(own, {"campbell": samples.campbell(9)}))
    axes = dict(figures(own, {"campbell": result}))["damping"]().axes[0]
    line = next(one for one in axes.get_lines() if one.get_label() == result.mode[1])
    np.testing.assert_allclose(line.get_ydata(), result.damping_ratio[:, 1] * 100.0)
    assert result.mode[0] not in _labels(axes), "beyond the limits"
    low, high = axes.get_ylim()
    assert low < line.get_ydata().min() < line.get_ydata().max() < high < 90.0
    assert [text.get_text() for text in axes.texts] == ["9000 rpm"]


def test_damping_of_variants_has_equal_axes():
    own, calm = samples.case(), samples.campbell(49)
    shown = [
        (replace(own, title="grows"), {"campbell": growing()}),
        (replace(own, title="calm"), {"campbell": calm}),
    ]
    panels = dict(comparison_figures(shown))["damping"]().axes
    assert panels[0].get_ylim() == panels[1].get_ylim()
    assert [len(axes.texts) for axes in panels] == [1, 0]
    assert "damping" not in dict(comparison_figures(shown[1:] * 2))


def test_bearings_of_equal_loads_and_unlike_angles_are_two_lines():
    """Of different sizes in series; those alike in all that is drawn are one."""
    result = samples.preload()
    load = np.repeat(result.axial_load[:, :1], len(result.bearing), axis=1)
    same = {
        name: np.repeat(getattr(result, name)[:, :1], len(result.bearing), axis=1)
        for name in (
            "inner_angle",
            "outer_angle",
            "inner_pressure",
            "outer_pressure",
            "inner_load",
            "outer_load",
            "inner_required_friction",
            "outer_required_friction",
        )
    }
    alike = replace(result, axial_load=load, **same)
    steeper = same["outer_angle"].copy()
    steeper[:, -1] *= 1.2
    for one, names in ((alike, 1), (replace(alike, outer_angle=steeper), 2)):
        figure = contacts_figure(one)
        assert [len(axes.get_lines()) for axes in figure.axes[:4]] == [2 * names] * 4
