"""Supports whose matrices follow the speed, against supports that are constant at each speed."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.section_forces import solve as section_forces
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.analyses.stiffness import solve as stiffness
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.errors import InvalidInput
from rotordyn.job import solve
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.joint import Joint
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.modes.branches import branches_of
from rotordyn.modes.excitation import Line
from rotordyn.modes.roots import Start, solved
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM, all_poles, case, mfw2310, pairs, system_of

SPEEDS = (0.0, 6000.0 * RPM, 20000.0 * RPM)
FREQUENCY = tuple(np.linspace(20.0, 1500.0, 60))
TABLED = LinearSupport(
    "film",
    0.03,
    {
        ("y", "y"): (2e7, 5e7, 9e7),
        ("z", "z"): (3e7, 4e7, 9e7),
        ("y", "z"): (1e6, 8e6, 3e7),
        ("z", "y"): (-1e6, -7e6, -2e7),
        ("thz", "thz"): 2e4,
        ("x", "x"): 1e7,
    },
    {("y", "y"): (4e3, 2e3, 1e3), ("z", "z"): 2e3, ("y", "z"): (0.0, 3e2, 1e2)},
    speeds=SPEEDS,
)
OTHER = support("other", 0.2, (4e7, 4e7), 1e3)


def on(*supports: LinearSupport) -> Spindle:
    return replace(STEPPED, supports=supports)


def scene(spindle: Spindle, rpm: tuple[float, ...], **conditions: object) -> Scene:
    ports = tuple(spindle.points.values())
    return Scene(spindle, Conditions(**conditions), np.array(rpm) * RPM, 1500.0, ports)  # type: ignore[arg-type]


FINE = Conditions(accuracy=1e-8)
RPMS = (0.0, 3000.0, 6000.0, 15000.0, 20000.0)


def halfway(rpm: float) -> LinearSupport:
    """The table read by hand."""
    speed = rpm * RPM

    def at(value: object) -> float:
        return float(np.interp(speed, SPEEDS, value)) if isinstance(value, tuple) else value  # type: ignore[arg-type, return-value]

    entries = (TABLED.stiffness, TABLED.damping)
    own = ({pair: at(value) for pair, value in each.items()} for each in entries)
    return LinearSupport("film", 0.03, *own)


def test_every_speed_is_a_machine_of_its_own() -> None:
    whole = scene(on(TABLED, OTHER), RPMS)
    spec = FrfSpec(FREQUENCY, pairs("nose.y/tip.y", "nose.z/tip.y", "tip.thy/nose.z"))
    curves = frf.solve(whole, spec).receptance
    for row, rpm in enumerate(RPMS):
        fastest = sorted({rpm, RPMS[-1]})  # whose coordinates are those of the whole
        alone = scene(on(halfway(rpm), OTHER), tuple(fastest))
        own = frf.solve(alone, spec).receptance[0]
        assert np.abs(curves[row] - own).max() < 1e-8 * np.abs(own).max()
        ours, theirs = (
            np.sort_complex(p) for p in (system_of(whole).modes.pole[row], poles(alone))
        )
        assert np.abs(ours - theirs).max() < 1e-7 * np.abs(theirs).max()


def poles(alone: Scene) -> np.ndarray:
    return system_of(alone).modes.pole[0]


def test_rigid_rotor_follows_its_supports() -> None:
    """A table that is a straight line of speed: both modes of a rigid rotor in closed form."""
    rotor = replace(STEPPED, masses=(), supports=())
    body = rotor_inertia(rotor)
    pair = tuple(
        LinearSupport(
            name,
            body.centre + side * 0.05,
            dict.fromkeys(diagonal, (1e6, 9e6)),
            speeds=(0.0, 800.0),
        )
        for name, side, diagonal in (
            ("a", -1.0, (("y", "y"), ("z", "z"))),
            ("b", 1.0, (("y", "y"), ("z", "z"))),
        )
    )
    speed = np.linspace(0.0, 800.0, 5)
    found = Scene(replace(rotor, supports=pair), Conditions(rotor="rigid"), speed, 500.0)
    k = 1e6 + 1e4 * speed
    bounce = np.sqrt(2.0 * k / body.mass)
    half = 0.5 * body.polar / body.diametral * speed
    rock = np.sqrt(half**2 + 2.0 * k * 0.05**2 / body.diametral)
    exact = np.stack([bounce, -bounce, half + rock, half - rock], axis=1)
    turning = np.sort(system_of(found).modes.pole.imag, axis=1)
    assert turning == pytest.approx(np.sort(exact, axis=1), rel=1e-9)


@pytest.mark.parametrize("bearings", ["static", "dynamic"])
def test_radial_stiffness_beside_bearings(bearings: str) -> None:
    table = LinearSupport(
        "film", 0.1, {("y", "y"): (2e7, 9e7), ("z", "z"): 5e7}, speeds=(0.0, 30000.0 * RPM)
    )
    rpm = (0.0, 12000.0, 24000.0)
    spec = StiffnessSpec(
        "nose_face", 500.0, steps=2, variants=("nonlinear", "full", "constant_preload")
    )
    base = replace(case().conditions, bearings=bearings)
    whole = stiffness.solve(Scene(mfw2310(supports=(table,)), base, np.array(rpm) * RPM), spec)
    for row, one in enumerate(rpm):
        fixed = LinearSupport("film", 0.1, {("y", "y"): 2e7 + 7e7 * one / 30000.0, ("z", "z"): 5e7})
        alone = Scene(mfw2310(supports=(fixed,)), base, np.array([one]) * RPM)
        own = stiffness.solve(alone, spec)
        assert whole.deflection[row] == pytest.approx(own.deflection[0], rel=1e-7)
    assert np.ptp(whole.tangent[:, 0]) > 0.005 * whole.tangent[0, 0]


def test_reactions_of_a_beam() -> None:
    """A force between two springs is shared by levers; what it sinks is force over stiffness."""
    table = replace(
        support("a", 0.03, (1e7, 1e7)),
        stiffness={("y", "y"): (1e7, 4e7), ("z", "z"): 1e7, ("x", "x"): 1e7, ("thx", "thx"): 1e3},
        speeds=(0.0, 1000.0),
    )
    rotor = on(table, support("b", 0.2, (4e7, 4e7)))
    loads = SectionForcesSpec(loads=(PointLoad(at=0.1, Fy=100.0),))
    found = section_forces.solve(Scene(rotor, Conditions(), np.array([0.0, 500.0])), loads)
    front = np.flatnonzero(np.isclose(found.cut, 0.03))[0]
    assert found.reaction[:, 0, 1] == pytest.approx(-100.0 * 0.1 / 0.17, rel=1e-9)
    sunk = found.deflection_y[:, front]
    assert sunk == pytest.approx(100.0 * 0.1 / 0.17 / np.array([1e7, 2.5e7]), rel=1e-9)


def test_an_end_of_a_table_is_held_on_request() -> None:
    """As a support of that constant value, with a warning; inside the table nothing changes."""
    held = replace(TABLED, beyond="hold")
    beyond = (0.0, 15000.0, 22000.0, 30000.0)
    with pytest.raises(InvalidInput, match="no values at that speed: given 22000 rpm"):
        TABLED.at(22000.0 * RPM)
    whole = scene(on(held, OTHER), beyond)
    for row, rpm in enumerate(beyond):
        alone = scene(on(halfway(min(rpm, 20000.0)), OTHER), (rpm,))
        ours, theirs = (np.sort_complex(all_poles(s, k)) for s, k in ((whole, row), (alone, 0)))
        assert ours == pytest.approx(theirs, rel=1e-7)
    (warning,) = (w for w in whole.warnings if "film" in w)
    assert "values at 20000 rpm beyond its table, at 22000 rpm to 30000 rpm" in warning
    assert not any("film" in w for w in scene(on(held, OTHER), RPMS).warnings)
    later = replace(held, speeds=(1000.0 * RPM, 6000.0 * RPM, 20000.0 * RPM))
    (below,) = (w for w in scene(on(later, OTHER), (0.0, 9000.0)).warnings if "film" in w)
    assert "values at 1000 rpm beyond its table, at 0 rpm:" in below
    with pytest.raises(InvalidInput, match="hold needs a table over speed: none is given"):
        replace(OTHER, beyond="hold")


CASE = """
title: rotor on films
spindle:
  shaft:
    start: 0 mm
    material: steel_rotor
    sections: [{length: 1 m, outer_diameter: 50 mm}]
  supports:
    - {name: left, x: 0 m, %s}
    - {name: right, x: 1 m, stiffness: {yy: 1 N/um, zz: 1 N/um}}
speeds: [0 rpm, 4000 rpm]
analyses: {campbell: {max_frequency: 200 Hz}}
"""
LISTS = (
    "speeds: [0 rpm, 3000 rpm, 6000 rpm], stiffness: {yy: [1 N/um, 2 N/um, 4 N/um], zz: 1 N/um},"
    " damping: {yy: [100 N s/m, 50 N s/m, 20 N s/m]}"
)
CSV = """# film of the left bearing
speed [rpm], stiffness.yy [N/mm], damping.yy [kN s/m]
0, 1000, 0.1
3000, 2000, 0.05
6000, 4000, 0.02
"""


@pytest.mark.parametrize("between", [",", ";", "\t"])
def test_a_csv_file_is_the_lists(tmp_path: Path, between: str) -> None:
    (tmp_path / "film.csv").write_text(CSV.replace(",", between))
    (tmp_path / "lists.yaml").write_text(CASE % LISTS)
    (tmp_path / "file.yaml").write_text(CASE % "table: film.csv, stiffness: {zz: 1 N/um}")
    lists, file = (rotordyn.load(tmp_path / f"{name}.yaml") for name in ("lists", "file"))
    assert lists.spindle is not None
    assert file.spindle is not None
    given, read = lists.spindle.supports[0], file.spindle.supports[0]
    assert read.speeds == given.speeds == pytest.approx(np.array([0, 3000, 6000]) * RPM)
    for which in ("stiffness", "damping"):
        ours, theirs = getattr(read, which), getattr(given, which)
        assert set(ours) == set(theirs)
        for pair, value in theirs.items():
            assert ours[pair] == pytest.approx(value, rel=1e-12)
    assert tmp_path / "film.csv" in file.files
    found = rotordyn.run(file)["campbell"]
    slow, fast = (float(np.nansum(found.frequency[row])) for row in (0, 1))
    assert fast > 1.01 * slow


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 0, "holds no table"),
        ("speed [rpm], stiffnes.yy [N/m]\n0, 1\n", 1, "not a column of a table: given 'stiffnes"),
        ("speed [rpm], damping.yy [N s/m]\n0, 1, 2\n", 2, "not as many values as columns: given 3"),
        ("stiffness.yy [N/m]\n1\n", 1, "column missing"),
        ("speed [rpm], speed [rpm]\n1, 1\n", 1, "column repeated: given 'speed'"),
        ("speed [rpm], stiffness.yy [N/mm]\n0, 1\n9, x\n", 3, "not a finite number: given 'x N/mm"),
        ("speed [Hz], stiffness.yy [N/m]\n0, 1\n9, 1\n", 2, "'Hz' is not a unit of speed"),
        ("speed [rpm], stiffness.yy [N/m]\n9, 1\n0, 1\n", 3, "not in ascending order"),
        ("speed [rpm], stiffness.yy [N/um]\n0, " + 140_000 * "1", 0, "not a table: field larger"),
    ],
)
def test_a_broken_csv_file_says_where(tmp_path: Path, text: str, line: int, words: str) -> None:
    (tmp_path / "film.csv").write_text(text)
    (tmp_path / "a.yaml").write_text(CASE % "table: film.csv, stiffness: {zz: 1 N/um}")
    with pytest.raises(rotordyn.InvalidInput) as caught:
        rotordyn.load(tmp_path / "a.yaml")
    first = next(fault for fault in caught.value.faults if fault.file.endswith("film.csv"))
    assert first.line == line
    assert words in first.message


def test_no_support_beyond_its_table() -> None:
    with pytest.raises(rotordyn.InvalidInput, match=r"given 21000 rpm; allowed: 0 rpm to 20000 rp"):
        system_of(scene(on(TABLED, OTHER), (0.0, 21000.0)))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speeds": (0.0, 1.0)}, "stiffness yy needs one value for each of speeds: given 3"),
        ({"stiffness": {("x", "x"): (1.0, 2.0, 3.0)}}, "stiffness xx takes one value for all sp"),
        ({"stiffness": {("y", "y"): 1.0}, "damping": {}}, "speeds without a table"),
        ({"speeds": (0.0, math.pi, 1.0)}, "not in ascending order"),
    ],
)
def test_tables_that_contradict_themselves(changes: dict, words: str) -> None:
    with pytest.raises(rotordyn.InvalidInput, match=words):
        replace(TABLED, **changes)


@pytest.mark.long
def test_critical_speeds_and_threshold_within_the_table() -> None:
    """Each critical speed is that of the machine whose supports are constant, as they are there;
    machines solved between the speeds of the case do not leave the table."""
    top = SPEEDS[-1]
    rotor = replace(
        on(TABLED, OTHER),
        rotor_damping=(0.02,),
        internal_damping=1.0,
        joints=(Joint("cone", 0.05, tilt=2e5, tilt_damping=20.0),),
    )
    found = Scene(rotor, FINE, np.linspace(0.0, top, 9), 1500.0)
    result = campbell.solve(found, CampbellSpec(1500.0, engine_orders=(1, 2)))
    assert sorted(result.critical) == 2 * ["axial 1"] + 2 * ["bending 1"] + 2 * ["bending 2"]
    for k in range(len(result.critical)):
        speed = float(result.critical_speed[k])
        assert 0.0 < speed <= top
        alone = replace(rotor, supports=(halfway(speed / RPM), OTHER))
        one = Scene(alone, FINE, np.unique([speed, top]), 1500.0)
        turning = all_poles(one).imag
        order = result.critical_order[k]
        assert np.abs(turning / (order * speed) - 1.0).min() < 1e-8
    growth = [
        np.nanmax(system_of(Scene(rotor, FINE, np.array([at, top]), 1500.0)).pole[0].real)
        for at in result.stability_threshold * np.array([1.0 - 1e-6, 1.0 + 1e-6])
    ]
    assert growth[0] < 0.0 < growth[1]


def steep(seed: int) -> Spindle:
    """A table whose values jump by up to three decades between breakpoints."""
    rng = np.random.default_rng(seed)
    inner = np.sort(rng.uniform(0.0, 1.0, rng.integers(0, 6)))
    breakpoints = (0.0, *(inner * SPEEDS[-1]).tolist(), SPEEDS[-1])

    def leaping() -> tuple[float, ...]:
        return tuple((10.0 ** rng.uniform(5.5, 8.5, len(breakpoints))).tolist())

    own = leaping()
    stiffness = {("y", "y"): own, ("z", "z"): own if seed % 2 else leaping()}
    if seed % 3 == 0:
        across = tuple((1e6 * rng.uniform(-1.0, 1.0, len(breakpoints))).tolist())
        stiffness |= {("y", "z"): across, ("z", "y"): tuple(-value for value in across)}
    damping = {("y", "y"): 50.0, ("z", "z"): 50.0}
    film = LinearSupport("film", 0.03, stiffness, damping, speeds=breakpoints)
    return on(film, support("other", 0.2, (4e7, 4e7), 50.0))


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("seed", "coupled"), [(1, False), (2, False), (3, False), (1, True), (5, True)]
)
def test_no_critical_speed_is_missed_between_few_speeds(seed: int, coupled: bool) -> None:
    """Three speeds of the case; at two hundred, modes slower than the line of rotation are counted
    without following them, and change by as many as are found between."""
    rotor, spec = steep(seed), CampbellSpec(1500.0, shapes=False, engine_orders=(1, 2))
    if coupled:  # with axial motion, hardly: no eigenproblem then, breakpoints alone
        along = {("x", "x"): 1e3, ("x", "y"): 1e-3, ("y", "x"): 1e-3}
        rotor = replace(rotor, supports=(*rotor.supports, LinearSupport("link", 0.1, along)))
    few = Scene(rotor, Conditions(), np.linspace(0.0, SPEEDS[-1], 3), 1500.0)
    result = campbell.solve(few, spec)
    at = np.linspace(0.0, SPEEDS[-1], 201)[1:]
    poles = system_of(Scene(rotor, Conditions(), at, 1500.0)).pole
    for order in spec.engine_orders:
        below = ((poles.imag > 0.0) & (poles.imag < order * at[:, None])).sum(axis=1)
        own = (result.critical_order == order) & (np.array(result.critical_kind) != "torsion")
        found = np.histogram(result.critical_speed[own], at)[0]
        assert (found >= np.abs(np.diff(below))).all()
        assert ((found - np.diff(below)) % 2 == 0).all()
    assert len(result.critical) >= 6


@pytest.mark.parametrize(
    ("order", "roots"), [(0.43, 1), (0.5, 1), (1.5, 2), (2, 2), (2.04, 2), (2.05, 0), (2.37, 0)]
)
def test_two_critical_speeds_between_two_breakpoints(order: float, roots: int) -> None:
    """ω² = ω₁² (5 x − 3/2) with x = Ω/ω₁ of a rigid rotor that moves in parallel: n² x² = 5 x − 3/2
    has none, one or two roots in the table (at 2× ½ and ¾, at both ends 2 Ω is faster)."""
    rotor = replace(STEPPED, masses=(), supports=())
    body, first = rotor_inertia(rotor), 500.0
    table = (0.301 * first, 2.0 * first)
    held = tuple(0.5 * body.mass * first**2 * (5.0 * spin / first - 1.5) for spin in table)
    pair = tuple(
        LinearSupport(name, body.centre + way, {("y", "y"): held, ("z", "z"): held}, speeds=table)
        for name, way in (("a", -0.05), ("b", 0.05))
    )
    whole = Scene(replace(rotor, supports=pair), Conditions(rotor="rigid"), np.array(table), 500.0)
    found = campbell.solve(whole, CampbellSpec(500.0, shapes=False, engine_orders=(order,)))
    every = np.roots([order**2, -5.0, 1.5])
    inside = [x.real for x in every if x.imag == 0.0 and 0.301 < x.real < 2.0]
    assert len(inside) == roots
    assert (len(found.critical) > 0) == (roots > 0)  # it tilts at other speeds, where it does
    for expected in inside:
        assert (np.abs(found.critical_speed / (expected * first) - 1.0) < 1e-8).sum() == 2


def test_threshold_of_what_grows_between_the_speeds_only() -> None:
    """m r̈ + c ṙ + (k − iq) r = 0 grows where q > c √(k/m); q peaks at a breakpoint, where the case
    has no speed."""
    rotor = replace(STEPPED, masses=(), supports=())
    body, top, stiff, damper = rotor_inertia(rotor), 800.0, 2e6, 200.0
    enough = damper * math.sqrt(2.0 * stiff / body.mass)
    cross = (0.0, 4.0 * enough, 0.0)
    pair = tuple(
        LinearSupport(
            name,
            body.centre + way,
            {
                ("y", "y"): stiff,
                ("z", "z"): stiff,
                ("y", "z"): cross,
                ("z", "y"): tuple(-value for value in cross),
            },
            {("y", "y"): damper, ("z", "z"): damper},
            speeds=(0.0, 0.5 * top, top),
        )
        for name, way in (("a", -0.1), ("b", 0.1))
    )
    whole = Scene(
        replace(rotor, supports=pair), Conditions(rotor="rigid"), np.array([0.0, top]), 500.0
    )
    found = campbell.solve(whole, CampbellSpec(500.0, shapes=False))
    assert found.stability_threshold == pytest.approx(0.25 * 0.5 * top, rel=1e-8)


def rising() -> Scene:
    """Both planes alike, stiffer with speed: the second mode stays above the line of rotation."""
    both = {(way, way): (1e6, 5e7, 9e7) for way in "yz"}
    film = LinearSupport("film", 0.03, both, speeds=SPEEDS)
    rotor = on(film, support("other", 0.2, (4e7, 4e7)))
    return Scene(rotor, Conditions(), np.linspace(0.0, SPEEDS[-1], 5), 1500.0)


def test_no_critical_speed_by_the_supports_of_one_speed() -> None:
    """The stiffness requested is that of the breakpoints on either side."""
    found = campbell.solve(rising(), CampbellSpec(1500.0, engine_orders=(1,)))
    assert len([name for name in found.critical if name.startswith("bending")]) == 2


def test_no_critical_speed_where_a_search_ends_at_the_range() -> None:
    """Without a root the secants stay at an end of the range; that is none."""
    whole = rising()
    branches, top = branches_of(whole, 2.0 * math.pi * 1500.0), SPEEDS[-1]
    above = [
        Start(
            k,
            Line("spindle", 1, 1.0),
            0.5 * top,
            0.0,
            top,
            b.vector[-1],
            float(np.sign(b.pole[-1].imag)),
        )
        for k, b in enumerate(branches)
        if b.kind == "bending" and (np.abs(b.pole.imag) > whole.speed).all()
    ]
    assert len(above) >= 1
    for _, speed, state in solved(whole, branches, above):
        assert speed == pytest.approx(abs(state.pole.imag), rel=1e-6)


def test_a_case_holds_a_table_on_request(tmp_path: Path) -> None:
    text = (CASE % LISTS).replace("4000 rpm]", "7000 rpm]")
    (tmp_path / "refused.yaml").write_text(text)
    with pytest.raises(InvalidInput, match="no values at that speed: given 7000 rpm"):
        rotordyn.load(tmp_path / "refused.yaml")
    (tmp_path / "held.yaml").write_text(
        text.replace("left, x: 0 m,", "left, x: 0 m, beyond: hold,")
    )
    solution = solve(rotordyn.load(tmp_path / "held.yaml"))
    assert any(
        "'left' keeps its values at 6000 rpm beyond its table" in w for w in solution.warnings
    )
    none = CASE % "beyond: hold, stiffness: {yy: 1 N/um, zz: 1 N/um}"
    (tmp_path / "none.yaml").write_text(none)
    with pytest.raises(InvalidInput, match="hold needs a table over speed"):
        rotordyn.load(tmp_path / "none.yaml")
