"""Figures of odd cases: one speed, one frequency, long and strange titles, values off the axes."""

from __future__ import annotations

import itertools
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from rotordyn.analyses.campbell.figures.diagram import campbell_figure
from rotordyn.analyses.campbell.figures.shapes import shapes_figure
from rotordyn.analyses.campbell.result import TurningCampbellResult
from rotordyn.analyses.frf.result import TurningFrfResult
from rotordyn.analyses.preload.figures.over_speed import preload_figure
from rotordyn.analyses.stiffness.figures.curves import force_figure, stiffness_figure
from rotordyn.figures.draw import Drawing
from rotordyn.figures.legends import top_legend
from rotordyn.figures.overlays import Scale, colour, dash, overlay_figure
from rotordyn.figures.style import add_axes, mark_lone_points, new_figure
from rotordyn.job.figures import comparison_figures, figures
from rotordyn.machine.reference import Reference
from rotordyn.results.described import Shown
from rotordyn.results.headline import Curve
from tests.rotordyn.figures import samples

LONG = "spring number {} and much more to be said of what is different in this variant"


def at_top(result):
    """A result over speed, at its last speed only."""
    cut = {}
    for field in fields(result):
        value, dims = getattr(result, field.name), field.metadata.get("dims", ())
        if field.name == "speed" or dims[:1] == ("speed",):
            cut[field.name] = value[-1:]
    return replace(result, **cut)


def drawn(axes):
    """Points of lines that are seen: on a segment or marked."""
    mark_lone_points(axes)
    return sum(
        np.isfinite(line.get_ydata()).sum() if line.get_marker() in ("None", None) else
        len(line.get_markevery() if line.get_markevery() is not None else line.get_xdata())
        for line in axes.get_lines()
    )  # fmt: skip


def test_a_single_speed_is_seen() -> None:
    figure = preload_figure(at_top(samples.preload(5)), samples.spindle())
    assert all(drawn(axes) for axes in figure.axes)
    (axes,) = stiffness_figure(at_top(samples.stiffness(5))).axes
    marked = [line for line in axes.get_lines() if line.get_marker() not in ("None", None)]
    assert marked
    assert all(handle.get_marker() != "None" for handle in axes.get_legend().get_lines())


def test_contact_losses_need_the_curve_of_the_full_model() -> None:
    """A second stop solves that model even where it is not one of the variants."""
    whole = samples.stiffness()
    others = replace(
        whole,
        variant=whole.variant[1:],
        deflection=whole.deflection[:, 1:],
        tangent=whole.tangent[:, 1:],
        secant=whole.secant[:, 1:],
    )
    marked, plain = (
        [len(axes.texts) for axes in force_figure(result).axes] for result in (whole, others)
    )
    assert any(marked)
    assert not any(plain)


def test_two_speeds_are_marks_and_four_a_line() -> None:
    for speeds, line in ((2, "None"), (3, "None"), (4, "-")):
        sum_of_preloads = preload_figure(samples.preload(speeds), samples.spindle()).axes[1]
        (curve,) = (c for c in sum_of_preloads.get_lines() if c.get_label() == "computed")
        assert curve.get_linestyle() == line
        assert (curve.get_marker() == "None") == (line == "-")


def test_a_speed_between_lost_ones_is_seen() -> None:
    result = samples.stiffness(5)
    tangent = result.tangent.copy()
    tangent[[1, 3]] = np.nan
    (axes,) = stiffness_figure(replace(result, tangent=tangent)).axes
    assert axes.get_lines()[0].get_markevery().tolist() == [0, 2, 4]
    campbell = samples.campbell(5)
    frequency = campbell.frequency.copy()
    frequency[:4] = np.nan
    (axes,) = campbell_figure(replace(campbell, frequency=frequency), (), (), 4000.0).axes
    shown = [line for line in axes.get_lines() if line.get_label() == "forward whirl"]
    assert len(shown[0].get_xdata()) == 4
    assert not any("without whirl" in t for t in axes.get_legend_handles_labels()[1])


def test_deflection_is_drawn_at_speeds_with_a_state_alone() -> None:
    """The first, the middle and the last of these; no speed has one: no figures."""
    result = samples.stiffness(5)
    deflection, tangent = result.deflection.copy(), result.tangent.copy()
    deflection[[0, 2, 4]], tangent[[0, 2, 4]] = np.nan, np.nan
    some = replace(result, deflection=deflection, tangent=tangent)
    titles = [axes.get_title() for axes in force_figure(some).axes]
    assert titles == [f"{some.speed[k] * 30.0 / np.pi:.0f} rpm" for k in (1, 3)]
    none = replace(result, deflection=np.full_like(deflection, np.nan))
    assert {name for name, _ in figures(samples.case(), {"stiffness": some})} == {
        "machine", "stiffness", "stiffness_force",
    }  # fmt: skip
    assert {name for name, _ in figures(samples.case(), {"stiffness": none})} == {"machine"}


def test_known_values_beyond_the_speeds_are_not_drawn() -> None:
    """24 000 rpm lies beside the axes of a case that ends at 12 000 rpm."""
    result = samples.stiffness(5)
    half = replace(result, speed=result.speed / 2.0)
    far = Reference("radial_stiffness", "measured", "s", (samples.TOP,), (56e6,))
    near = Reference("radial_stiffness", "published", "s", (0.0, samples.TOP), (56e6, 60e6))
    (axes,) = stiffness_figure(half, [far, near]).axes
    names = axes.get_legend_handles_labels()[1]
    assert "measured" not in names
    known = next(line for line in axes.get_lines() if line.get_label() == "published")
    assert known.get_xdata().tolist() == [0.0]
    campbell = samples.campbell(5)
    both = Reference("bending_frequency", "published", "s", (0.0, 0.0), (900.0, 9000.0))
    (axes,) = campbell_figure(campbell, (), [both], 4000.0).axes
    known = next(line for line in axes.get_lines() if line.get_label() == "published")
    assert known.get_ydata().tolist() == [900.0]


def test_shapes_of_a_single_speed_name_it_once() -> None:
    result = samples.campbell(5)
    one = replace(result, shape_speed=result.shape_speed[-1:], shape=result.shape[-1:])
    figure = shapes_figure(one, samples.spindle())
    assert "24000 rpm, scaled" in figure.texts[0].get_text()
    assert not any("→" in axes.get_title() for axes in figure.axes)


@pytest.mark.parametrize("count", [2, 12])
def test_long_titles_cover_nothing(count: int) -> None:
    result = {"stiffness": samples.stiffness(5)}
    shown = [(replace(samples.case(), title=LONG.format(k)), result) for k in range(count)]
    figure = dict(comparison_figures(shown))["stiffness"]()
    (legend,) = figure.legends
    renderer = figure.canvas.get_renderer()
    box, page = legend.get_window_extent(renderer), figure.bbox
    assert page.x0 <= box.x0
    assert box.x1 <= page.x1
    assert box.y1 <= page.y1
    assert box.y0 >= figure.axes[0].get_window_extent(renderer).y1
    assert len(legend.get_texts()) >= count + len(result["stiffness"].variant)


def test_many_variants_are_distinguished() -> None:
    looks = [(colour(k), dash(k)) for k in range(14)]
    assert len({colour for colour, _ in looks}) == len(looks)
    assert all(a != b for a, b in itertools.pairwise(dash for _, dash in looks))


def test_the_frame_is_on_the_axes_and_known_frequencies_stay_in_theirs() -> None:
    campbell, frf = samples.campbell(5), samples.frf(5, 50)
    turning = [
        kind(**{f.name: getattr(own, f.name) for f in fields(own)})
        for kind, own in ((TurningCampbellResult, campbell), (TurningFrfResult, frf))
    ]
    known = (Reference("bending_frequency", "published", "s", (0.0,), (900.0,)),)
    own = replace(samples.case(), references=known)
    pair = [
        (replace(own, title=name), {"campbell": modes, "frf": response})
        for name, modes, response in zip(
            ("fixed", "turning"), (campbell, turning[0]), (frf, turning[1]), strict=True
        )
    ]
    jobs = dict(comparison_figures(pair))
    for name in ("campbell", "campbell_overlay"):
        figure = jobs[name]()
        labels = [axes.yaxis.label for axes in figure.axes if "damped" in axes.get_ylabel()]
        assert [label.get_text() for label in labels] == [
            "damped frequency [Hz]", "damped frequency in the rotating frame [Hz]",
        ]  # fmt: skip
        figure.canvas.draw()
        for label in labels:
            box = label.get_window_extent()
            assert label.get_visible()
            assert box.x0 >= 0.0
            assert box.y0 >= 0.0
            assert box.y1 <= figure.bbox.height
    axes = [a for a in jobs["frf_maps"]().axes if a.get_title()]
    assert [len(a.get_lines()) for a in axes] == [1, 0]


def test_maps_of_many_pairs_are_six_on_a_page() -> None:
    many = replace(samples.frf(3, 10), pair=tuple(f"{k}.y / 0.y" for k in range(14)))
    found = dict(figures(samples.case(), {"frf": many}))
    assert [n for n in found if "maps" in n] == ["frf_maps", "frf_maps_2", "frf_maps_3"]
    pairs = [found[name].args[0].args[1] for name in ("frf_maps", "frf_maps_3")]
    assert pairs == [[1, 2, 3, 4, 5, 6], [13]]


@pytest.mark.filterwarnings("error")
def test_titles_of_any_letters_are_drawn_as_they_are(tmp_path: Path) -> None:
    result = {"stiffness": samples.stiffness(5)}
    titles = ("$\\frac$", "日本 %s {a}", "größe $x_1$ & <b>")
    variants = [(replace(samples.case(), title=title), result) for title in titles]
    Drawing(comparison_figures(variants), tmp_path, workers=1, formats=("svg",)).finish()
    text = (tmp_path / "stiffness.svg").read_text(encoding="utf-8")
    assert "$\\frac$" in text
    assert "日本 %s {a}" in text
    assert "größe $x_1$ &amp; &lt;b&gt;" in text


def test_one_frequency_has_no_map() -> None:
    frf = samples.frf(5, 2)
    one = replace(frf, frequency=frf.frequency[:1], receptance=frf.receptance[:, :, :1])
    names = [name for name, _ in comparison_figures([(samples.case(), {"frf": one})] * 2)]
    assert names
    assert not any("map" in name or "surface" in name for name in names)


@pytest.mark.long
def test_a_hundred_variants_are_coloured_by_what_was_varied():
    own, base = samples.case(), samples.campbell(5)
    variants = [
        (
            replace(own, title=f"v{k}"),
            {"campbell": replace(base, frequency=base.frequency * (1.0 + k / 200.0))},
        )
        for k in range(100)
    ]
    jobs = dict(comparison_figures(variants, "", Scale("stiffness [N/um]", range(100))))
    assert list(jobs) == ["campbell_overlay"], "panels of a hundred would not be read"
    axes, differences, bar = jobs["campbell_overlay"]().axes
    assert bar.get_ylabel() == "stiffness [N/um]"
    assert bar.get_ylim() == (0.0, 99.0)
    (legend,) = axes.figure.legends
    assert "v1" not in [text.get_text() for text in legend.get_texts()]
    curves = [line for line in axes.get_lines() if len(line.get_xdata()) == 5]
    assert len({tuple(line.get_color()) for line in curves}) == 100
    last = differences.get_lines()[-1].get_ydata()
    assert np.isclose(last, base.frequency.T * 99.0 / 200.0).all(axis=1).any()


def test_variants_are_distinguished_by_marks_and_none_hides_another():
    own = samples.case()
    variants = [(replace(own, title=name), {"campbell": samples.campbell(9)}) for name in "abc"]
    axes = dict(comparison_figures(variants))["campbell_overlay"]().axes[0]
    curves = [line for line in axes.get_lines() if len(line.get_xdata()) == 9]
    looks = {line.get_color(): (line.get_marker(), line.get_linewidth()) for line in curves}
    assert len({mark for mark, _ in looks.values()}) == 3
    widths = [width for _, width in looks.values()]
    assert widths == sorted(widths, reverse=True)
    assert len(set(widths)) == 3


def test_modes_of_variants_bear_their_names_at_both_panels():
    own, base = samples.case(), samples.campbell(9)
    base = replace(
        base, mode=tuple(f"bending {k // 2 + 1} {'bw' if k % 2 else 'fw'}" for k in range(10))
    )
    other = replace(base, frequency=1.2 * base.frequency)
    variants = [(replace(own, title=t), {"campbell": r}) for t, r in (("a", base), ("b", other))]
    figure = dict(comparison_figures(variants))["campbell_overlay"]()
    renderer = figure.canvas.get_renderer()
    for axes, colours in zip(figure.axes, ({colour(0), colour(1)}, {colour(1)}), strict=True):
        names = [t for t in axes.texts if "bending" in t.get_text()]
        assert {t.get_color() for t in names} == colours
        assert {(t.get_text()[:2], t.get_color()) for t in names} == {
            (f"{k + 1}:", colour(k)) for k in range(2) if colour(k) in colours
        }
        assert len({t.get_text()[3:12] for t in names}) == 5
        boxes = sorted((t.get_window_extent(renderer) for t in names), key=lambda box: box.y0)
        assert all(box.x1 <= figure.bbox.x1 for box in boxes)
        assert all(a.y1 <= b.y0 + 1.0 for a, b in itertools.pairwise(boxes))
    (legend,) = figure.legends
    assert {"1: a", "2: b"} <= {t.get_text() for t in legend.get_texts()}


def test_a_legend_of_several_rows_is_read_by_rows():
    figure = new_figure()
    axes = add_axes(figure, (15.0, 15.0, 140.0, 60.0))
    names = [f"{k}, a name that takes some room" for k in range(5)]
    for name in names:
        axes.plot([0.0, 1.0], [0.0, 1.0], label=name)
    top_legend(figure, axes)
    (legend,) = figure.legends
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    at = {t.get_text(): t.get_window_extent(renderer) for t in legend.get_texts()}
    assert len({round(box.y0) for box in at.values()}) > 1
    assert sorted(at, key=lambda name: (-round(at[name].y0), at[name].x0)) == names


def test_curves_of_variants_are_drawn_from_their_least_abscissa():
    force = np.linspace(-2000.0, 1500.0, 8)
    shown = [Shown(name, None, (), None) for name in ("a", "bb")]

    def curves(variant):
        yield Curve("cycle", "shift", "um", force, force * len(variant.title), along="force [N]")

    for axes in overlay_figure("cycle", curves, shown, None).axes:
        assert axes.get_xlim()[0] <= -2000.0
        assert axes.get_xlim()[1] >= 1500.0


def test_curves_that_need_more_points_for_a_line_are_marks_in_panels_and_legend():
    rpm = np.linspace(20e3, 60e3, 41)

    def curves(variant):
        yield Curve("lobes", "depth", "mm", rpm, rpm * len(variant.title), least=100)

    figure = overlay_figure("lobes", curves, [Shown(n, None, (), None) for n in ("a", "bb")], None)
    for axes in figure.axes:
        assert axes.get_xlim() == (20e3, 60e3)  # no third of it empty
        lines = [line for line in axes.get_lines() if len(line.get_xdata()) == 41]
        assert {line.get_linestyle() for line in lines} == {"None"}
        assert all(line.get_markevery() is None for line in lines)
    (legend,) = figure.legends
    assert {line.get_linestyle() for line in legend.get_lines()} == {"None"}


def _deep(least):
    """Curves of which the second has a value beyond the axis, and one without bound."""
    x = np.linspace(0.0, 9000.0, 10)

    def curves(variant):
        y = 1.0 + x / 9000.0
        if variant.title == "bb":
            y[[3, 7]] = 30.0, np.inf
        look = {"least": least, "ceiling": 4.0, "limits": (0.0, None)}
        yield Curve("lobes", "depth", "mm", x, y, **look)

    return curves


def test_few_points_beyond_the_axis_are_triangles_at_its_edge():
    shown = [Shown(name, None, (), None) for name in ("a", "bb")]
    figure = overlay_figure("lobes", _deep(100), shown, None)
    for axes, highest in zip(figure.axes, (2.0, 0.0), strict=True):
        top = axes.get_ylim()[1]
        assert highest < top < 3.0
        (line,) = (each for each in axes.get_lines() if len(each.get_xdata()) == 2 and
                   each.get_marker() == "^")  # fmt: skip
        assert line.get_xdata() == pytest.approx([3000.0, 7000.0])
        assert line.get_ydata() == pytest.approx(top)
        assert line.get_color() == colour(1)
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names == ["a", "bb", "beyond the axis"]


def test_lines_beyond_the_axis_leave_the_frame():
    shown = [Shown(name, None, (), None) for name in ("a", "bb")]
    for axes in overlay_figure("lobes", _deep(4), shown, None).axes:
        top = axes.get_ylim()[1]
        assert top < 3.0
        line = axes.get_lines()[-1]
        assert (line.get_ydata()[[3, 7]] > top).all()


def test_differences_are_drawn_only_where_variants_differ():
    shown = [Shown(name, None, (), None) for name in ("a", "bb")]
    x = np.linspace(0.0, 9000.0, 9)

    def alike(_):
        yield Curve("curves", "load", "N", x, 1.0 + x)

    def apart(variant):
        yield Curve("curves", "load", "N", x, x * len(variant.title))

    assert len(overlay_figure("curves", alike, shown, None).axes) == 1
    _, differences = overlay_figure("curves", apart, shown, None).axes
    assert differences.get_lines()[-1].get_ydata() == pytest.approx(x)


def test_a_panel_without_differences_is_as_high_as_its_row():
    """A logarithmic panel has none; it is next to a linear one, not above it."""
    shown = [Shown(name, None, (), None) for name in ("a", "bb")]
    x = np.linspace(0.0, 9000.0, 9)

    def curves(variant):
        yield Curve("both", "life", "h", x, 1.0 + x * len(variant.title), panel="life", log=True)
        yield Curve("both", "load", "N", x, x * len(variant.title), panel="load")

    life, load, differences = (
        axes.get_position() for axes in overlay_figure("both", curves, shown, None).axes
    )
    assert life.x1 < load.x0
    assert life.y0 == pytest.approx(differences.y0)
    assert life.y1 == pytest.approx(load.y1)
    assert differences.y1 < load.y0


def test_no_line_joins_both_sides_of_a_jump():
    x, jump = np.linspace(0.0, 9000.0, 9), np.arange(8) == 4

    def curves(variant):
        step = np.where(np.arange(9) > 4, 5.0, 0.0) * len(variant.title)
        yield Curve("curves", "load", "N", x, step, breaks=jump)

    shown = [Shown(name, None, (), None) for name in ("a", "bb")]
    for axes in overlay_figure("curves", curves, shown, None).axes:
        lines = [line.get_ydata() for line in axes.get_lines() if len(line.get_xdata()) > 8]
        assert lines
        assert all(np.flatnonzero(np.isnan(y)).tolist() == [5] for y in lines)


def test_unbounded_peaks_have_no_surface():
    result = samples.frf(5, 50)
    bare = replace(result, peak_value=np.full((5, 4, 1), np.inf + 0j))
    for each, expected in ((result, True), (bare, False)):
        names = [name for name, _ in figures(samples.case(), {"frf": each})]
        assert "frf_map" in names
        assert ("frf_surface" in names) is expected
        names = [name for name, _ in comparison_figures([(samples.case(), {"frf": each})] * 2)]
        assert ("frf_surfaces" in names) is expected


def test_places_along_the_shaft_are_named_above_the_top_row_alone() -> None:
    x, shown = np.arange(5.0), [Shown(name, None, (), None) for name in ("a", "bb")]

    def curves(_: Shown) -> list[Curve]:
        labels = ("N", "Ty", "Tz", "Mt", "My", "Mz")
        look = {"places": ((1.0, "front"), (3.0, "rear"))}
        return [Curve("forces", label, "N", x, x, **look) for label in labels]

    panels = overlay_figure("forces", curves, shown, None).axes
    named = [{text.get_text() for text in axes.texts} >= {"front", "rear"} for axes in panels]
    assert named == [True] * 3 + [False] * 3
