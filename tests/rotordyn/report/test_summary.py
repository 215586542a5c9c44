"""The summary fits a screen and says what an engineer asks first."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bearings import STEEL, AngularContactBallBearing
from docs.generate.accepted import default
from rotordyn.case.keys import keys_of
from rotordyn.case.read import load
from rotordyn.case.vary import vary
from rotordyn.cli.screen import HEIGHT, on_screen
from rotordyn.job.side_by_side import write_comparison
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.reference import Reference
from rotordyn.report.side_by_side import comparison_summary
from rotordyn.report.summary import summary
from rotordyn.report.warnings import result_warnings
from rotordyn.results.display import number
from rotordyn.results.text import WIDTH, unbroken, wrapped
from tests.oracles.spindles import CASES
from tests.rotordyn.figures import samples

APART = ("control", "unbalance")  # more than one screen with all else


@pytest.fixture
def text(case, results):
    return summary(case, {name: r for name, r in results.items() if name not in APART})


def test_fits_one_screen(text):
    lines = text.splitlines()
    assert len(lines) <= HEIGHT
    assert max(map(len, lines)) <= WIDTH


@pytest.mark.parametrize(
    "words",
    [
        "Fischer MFW 2310, reconstructed",
        "kg, centre of gravity at",
        "front sleeve with c: 574 N, 6.2 N/µm, stop after 52.2 µm",
        "1 fw 903.0 → 713.0 fw",
        "axial 20400 rpm (-15 %, ζ 2 %)",
        "a 551 → 1273",
        "front sleeve: reached at 18000 rpm",
        "rear sleeve: not reached",
        "constant preload 142.7 → 52.8",
        "Ty -500 at -91.8 mm",
        "N 0, Ty",
        "Mt 40 at 172.3 mm",
        "front Fy 500; rear Fy 500",
        "middle to end: 0.0286 → 0.0286° of 0.0573° allowed, kept",
        "39.55 → 39.55 mm",
        "The thesis mixes two signs of the gyroscopic moment.",
        "1750 |",
    ],
)
def test_says(text, words):
    assert words in " ".join(text.split())


@pytest.mark.parametrize(
    ("guides", "words"),
    [
        ((), "drawbar 18000 N from 20.0 to 400.0 mm, not guided"),
        ((0.1, 0.2), "drawbar 18000 N from 20.0 to 400.0 mm, guided at 100.0, 200.0 mm"),
        ("everywhere", "drawbar 18000 N from 20.0 to 400.0 mm, guided everywhere"),
    ],
)
def test_drawbar_is_named(case, results, guides, words):
    assert "\ndrawbar" not in summary(case, results)
    machine = replace(case.spindle, drawbar=Drawbar(18e3, 0.02, 0.4, guides))
    assert words in " ".join(summary(replace(case, spindle=machine), results).split())


def test_a_kind_is_named_where_it_is_not_the_usual_one_and_thrust_where_it_is_one_way():
    case = load(CASES / "spindle_deep_groove_rear.yaml")
    said = " ".join(summary(case, {}).split())
    assert (
        "a − at 42.0, b − at 62.0, rear deep groove at 302.0 (−: carries thrust towards −x)" in said
    )
    assert "in O" not in said
    assert "in X" not in said


def test_the_material_of_balls_is_named():
    """Angular-contact bearings have balls of silicon nitride unless they say otherwise."""
    case = load("grinding_spindle")
    assert "balls of silicon nitride\n" in summary(case, {})
    other = vary(case, {"spindle.bearings.c.model.ball_material": STEEL})
    said = " ".join(summary(other, {}).split()).replace("\N{NO-BREAK SPACE}", " ")
    assert "balls of silicon nitride in a, b, d, bearing steel in c" in said


def test_a_single_bearing_is_described():
    bearing = load(CASES / "vex70.yaml")
    words = summary(bearing, {}).splitlines()[-2:]
    assert " ".join(" ".join(words).split()).endswith(
        "bearing angular contact: 25 balls of silicon nitride, 9.525 mm on 90 mm, free contact "
        "angle 25°"
    )


def test_the_reference_of_keys_names_default_materials():
    field = next(f for f in keys_of(AngularContactBallBearing) if f.name == "ball_material")
    assert default(field) == "`silicon_nitride`"


def test_where_a_line_leaves_the_band_is_reported(case, results):
    modes = results["campbell"]
    assert "leaves the band" not in summary(case, results)
    top = modes.speed[-1] * 30.0 / np.pi
    narrow = replace(modes, max_frequency=0.9 * top / 60.0)
    said = " ".join(summary(case, results | {"campbell": narrow}).split())
    assert f"(-15 %, ζ 2 %); 1× leaves the band at {0.9 * top:.0f} rpm" in said
    quiet = replace(narrow, critical_excited=np.zeros(1, dtype=bool))
    told = " ".join(summary(case, results | {"campbell": quiet}).split())
    assert "none in the band asked for; 1× leaves the band" in told


def test_critical_speeds_are_reported_of_the_orders_requested_alone(case, results):
    """Whether there are some or none; of what was not sought nothing is said."""
    modes = results["campbell"]
    half = replace(modes, engine_order=np.array([0.43, 2.5]), critical_order=np.array([0.43]))
    said = " ".join(summary(case, {"campbell": half}).split())
    assert "critical 0.43×, margin to top speed: axial 20400 rpm (-15 %, ζ 2 %) critical" in said
    assert "critical 2.5×, margin to top speed: none from 0 to 24000 rpm" in said
    assert "1×, margin" not in said
    nothing = summary(case, {"campbell": replace(half, engine_order=np.zeros(0))})
    assert "critical " not in nothing


def test_what_one_screen_does_not_hold_is_counted_and_is_in_the_summary(case, results):
    modes = results["campbell"]
    many = replace(modes, engine_order=np.linspace(0.1, 5.0, 70))
    text = summary(case, results | {"campbell": many})
    lines, shown = text.splitlines(), on_screen(text, Path("out/summary.txt")).splitlines()
    assert sum("margin to top speed" in line for line in lines) == 70
    assert not any(line.startswith("… and ") for line in lines)
    assert len(shown) == HEIGHT
    assert shown[:-1] == lines[: HEIGHT - 1]
    assert shown[-1] == f"… and {len(lines) - HEIGHT + 1} more lines in out/summary.txt"


def test_slow_modes_are_reported_with_their_digits(case, results):
    modes = results["campbell"]
    slow = replace(modes, frequency=modes.frequency * 1e-5, critical_speed=np.array([0.05]))
    said = " ".join(summary(case, {"campbell": slow}).split())
    assert "1 fw 0.00903 → 0.00713 fw" in said
    assert "axial 0.477 rpm" in said
    rows = comparison_summary(case, [(case, {"campbell": slow})]).splitlines()
    assert any("0.00903 → " in row for row in rows)


def test_numbers_have_three_digits_at_least():
    """Springs of small spindles are distinguished."""
    assert [number(each) for each in (2.416, 2.459, 2.529)] == ["2.42", "2.46", "2.53"]
    assert [number(1.1), number(0.5), number(12.0, 0)] == ["1.10", "0.5", "12.0"]
    assert [number(each) for each in (12.34, 903.04, 0.0)] == ["12.3", "903.0", "0.0"]
    assert [number(each, 0) for each in (95.28, 952.8)] == ["95.3", "953"]


def test_a_grade_for_another_speed_than_the_highest_is_reported(case, results):
    result = results["unbalance"]
    top = float(result.speed[-1])
    for speed, words in (
        (0.0, ""),
        (top, ""),
        (1.25 * top, "; the grade is for 30000 rpm, above all speeds of the case"),
        (0.5 * top, "; the grade is for 12000 rpm, a coarser grade above it"),
    ):
        lines = summary(case, {"unbalance": replace(result, grade_speed=speed)})
        text = " ".join(lines.split())
        assert f"g·mm at -52.4 mm to 28.65°{words} largest half axis" in text


def test_notes_are_below_the_title(case, results):
    lines = summary(case, results, ["first"], ["a choice " * 20]).splitlines()
    assert lines[0] == "WARNING: first"
    assert lines[2].startswith("note       a choice")
    assert max(map(len, lines)) <= WIDTH


def test_warnings_that_a_screen_leaves_out_are_counted(case, results):
    said = [f"number {k}" for k in range(8)]
    text = summary(case, results, [*said, "a long one " * 20])
    shown = on_screen(text, Path("summary.txt")).splitlines()
    assert shown[5:7] == ["WARNING: number 5", "WARNING: 3 more in summary.txt"]
    assert shown[7].startswith(case.name)
    assert text.count("WARNING: ") == 9
    room = 60 - len(summary(case, results).splitlines())
    assert 0 < room < 6
    few, many = (summary(case, results, said[:count]) for count in (room, room + 1))
    assert on_screen(few, Path("summary.txt")) == few
    assert on_screen(many, Path("summary.txt")).endswith("… and 2 more lines in summary.txt")


def test_published_frequencies_meet_the_modes_in_order(text):
    assert "903 | 903, 1350 | 1349, 1580 | 1587, 2860 | 2859" in " ".join(text.split())


def test_instability_is_named(case, results):
    ratio = results["campbell"].damping_ratio.copy()
    ratio[3:, 1] = -0.01
    ratio[4, 1] = -0.034
    wild = results | {"campbell": replace(results["campbell"], damping_ratio=ratio)}
    text = " ".join(summary(case, wild, ["first of all", *result_warnings(wild)]).split())
    name = results["campbell"].mode[1]
    assert text.startswith("WARNING: first of all")
    assert (
        f"WARNING: {name} is unstable at {results['campbell'].speed[3] * 30 / np.pi:.0f} rpm and"
        in text
    )
    assert "more of the speeds (damping ratio down to -3.4 %)" in text


def test_many_references_are_all_said(case, results):
    many = tuple(
        Reference("preload_sum", "measured", f"source {k}", (0.0,), (1000.0 + k,), remark="x" * 150)
        for k in range(40)
    )
    left = ("section_forces", "unbalance")
    own = {name: result for name, result in results.items() if name not in left}
    text = summary(replace(case, references=many), own)
    assert all(f"source {k}" in text or f"{1000 + k} |" in text for k in range(40))


def test_without_spindle_and_with_missing_modes(results):
    frequency = results["campbell"].frequency.copy()
    frequency[-1, 0] = np.nan
    partial = {"campbell": replace(results["campbell"], frequency=frequency)}
    text = summary(samples.SampleCase(), partial)
    assert "1 bw 903.0 → none" in text


def test_where_a_mode_exists_that_some_speeds_lack_is_said_of_variants(case, results, tmp_path):
    """In the table of the summary, and beside the empty cells of ``variants.csv``."""
    campbell = results["campbell"]
    frequency = campbell.frequency.copy()
    bending = [k for k, kind in enumerate(campbell.kind) if kind == "bending"]
    frequency[3:, bending] = np.nan
    partial = {"campbell": replace(campbell, frequency=frequency)}
    last = campbell.speed[2] * 30.0 / np.pi
    assert f"→ (0 to {last:.0f} rpm)" in comparison_summary(case, [(case, partial)])
    write_comparison(tmp_path, {"one": (load(CASES / "mfw2310.yaml"), partial)})
    head, row = (tmp_path / "variants.csv").read_text(encoding="utf-8-sig").splitlines()
    assert head.endswith(",absent")
    assert f"(0 to {last:.0f} rpm)" in row


def test_a_mode_that_is_not_followed_is_said(results):
    followed = results["campbell"].followed.copy()
    followed[-2:, 0] = False
    partial = {"campbell": replace(results["campbell"], followed=followed)}
    (sentence,) = [w for w in result_warnings(partial) if "not followed" in w]
    assert sentence.startswith("1 bw is not followed at 2 of the speeds, ")


def test_one_speed_and_no_mode_are_said_plainly(case, results):
    campbell = results["campbell"]
    names = ("speed", "frequency", "damping_ratio", "whirl")
    one = replace(
        campbell, outcome=campbell.outcome[-1:], **{n: getattr(campbell, n)[-1:] for n in names}
    )
    line = next(x for x in summary(case, {"campbell": one}).splitlines() if x.startswith("modes"))
    assert "→" not in line
    assert "24000 rpm: " in line
    preload = results["preload"]
    alone = replace(
        preload, outcome=("",), speed=preload.speed[:1], axial_load=preload.axial_load[:1]
    )
    line = next(x for x in summary(case, {"preload": alone}).splitlines() if "[N]" in x)
    assert "→" not in line
    bare = replace(campbell, mode=(), kind=(), damping_ratio=campbell.damping_ratio[:, :0])
    assert "none in the band asked for" in summary(case, {"campbell": bare})


def test_race_control_says_boundaries_fits_and_what_is_absent(case):
    result = samples.control(13)
    text = " ".join(summary(case, {"control": result}).split())
    assert "control under heavy load: inner race (C = 1.300); boundaries, axial load inner" in text
    assert "inner race controls above 16 N at 2000 rpm → 2304 N at 24000 rpm" in text
    assert "fit: 3 n² + 0 n + 0 N, n in 1000 rpm, misfit 0.5 N" in text
    assert "inner race controls, at 1 of 13 speeds" in text
    assert "more than once" not in text
    changes = result.changes.copy()
    changes[:, 4:6] = 3
    twice = replace(result, changes=changes, radial=0.2, resting_weight=0.9)
    text = " ".join(summary(case, {"control": twice}).split())
    assert "under heavy load: outer race (C = 0.900); boundaries, axial load, radial 0.2" in text
    assert "at 2 speeds control changes more than once; the highest is given" in text


def test_twist_beyond_its_limit_is_named(results):
    assert not any("twist" in sentence for sentence in result_warnings(results))
    far = replace(results["section_forces"], allowed_twist=np.array([4e-4]))
    sentence = "twist middle to end: 0.02865 deg is above the 0.02292 deg allowed"
    assert sentence in result_warnings({"section_forces": far})


def test_section_forces_of_variants_are_side_by_side(case, results):
    own = {"section_forces": results["section_forces"]}
    lines = comparison_summary(case, [(case, own)]).splitlines()
    (row,) = (line for line in lines if line.startswith(case.title) and "-500" in line)
    ends = "0.0 → 0.0 -50.0 → -500.0 0.0 → 0.0 40.0 → 40.0 0.0 → 0.0 13.2 → 132.1"
    assert row.removeprefix(case.title).split() == ends.split()


def test_entries_longer_than_a_line_break_at_their_blanks():
    """Not within a number; shorter ones stay whole."""
    long = unbroken("point " + ", ".join(f"{k}.005385 µm" for k in range(12)))
    lines = wrapped(f"time       {long}")
    assert len(lines) > 1
    assert all(len(line) <= WIDTH for line in lines)
    assert " ".join(" ".join(lines).split()) == " ".join(f"time {long}".split())
    assert wrapped(f"{'x' * 90} {unbroken('a b c d e f g')}")[1].strip() == "a b c d e f g"
