"""Descriptions built in Python are checked when they are built, one sentence a fault."""

from __future__ import annotations

import copy
import importlib
import math
import pickle
from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import rotordyn
from bearings import STEEL, AngularContactBallBearing, InvalidBearing, Material
from rotordyn.analyses import (
    BalanceGrade,
    BearingMapSpec,
    CampbellSpec,
    Conditions,
    ControlSpec,
    FrfSpec,
    Lubrication,
    MatricesSpec,
    PointLoad,
    Port,
    PreloadSpec,
    SectionForcesSpec,
    StiffnessSpec,
    TwistLimit,
    Unbalance,
    UnbalanceSpec,
)
from rotordyn.analyses.measured_response import MeasuredResponse
from rotordyn.analyses.registry import analysis, built_in
from rotordyn.case.keys import keys_of
from rotordyn.description import Description
from rotordyn.errors import InvalidInput
from rotordyn.field import declared, descriptions, found_in
from rotordyn.machine import (
    BearingSeat,
    ComputedShortening,
    Disc,
    Drawbar,
    InterferenceFit,
    LinearSupport,
    PointMass,
    PrescribedShortening,
    QuadraticInSpeed,
    Reference,
    RingGrowth,
    Section,
    Shaft,
    Sleeve,
    Spindle,
    Spring,
    Tool,
)
from rotordyn.quantity import LENGTH, RIGIDITY, Quantity

BEARING = AngularContactBallBearing(7.144e-3, 55e-3, 19, contact_angle=math.radians(25))
SHAFT = Shaft(0.0, (Section(0.3, 0.05, 0.02, STEEL, "body"),))
FRONT, REAR = BearingSeat("a", BEARING, 0.05, 1), BearingSeat("b", BEARING, 0.2, -1)
SLEEVE = Sleeve("rear", ("b",), Spring(300.0, 5e6))
SUPPORT = LinearSupport("left", 0.0, {("y", "y"): 1e8, ("z", "z"): 1e8})
TIP = Port("tip", "y")


def spindle(**changes: Any) -> Spindle:
    made = Spindle("s", SHAFT, seats=(FRONT, REAR), sleeves=(SLEEVE,), points={"tip": 0.0})
    return replace(made, **changes)


def case(**changes: Any) -> rotordyn.Case:
    made = rotordyn.Case("c", "", (0.0, 1000.0), {"preload": PreloadSpec()}, spindle=spindle())
    return replace(made, **changes)


NAN, INF = math.nan, math.inf
IMPOSSIBLE: dict[str, Callable[[], object]] = {
    "Section: length: .* given -0.1 m; allowed: above 0 m": lambda: Section(-0.1, 1, 0, STEEL),
    r"Section neck: inner_diameter: no wall left": lambda: Section(0.1, 0.05, 0.05, STEEL, "neck"),
    "Section: outer_diameter: not a number": lambda: Section(0.1, NAN, 0.0, STEEL),
    "Section: length: .* given inf m": lambda: Section(INF, 0.1, 0.0, STEEL),
    "Section: material: wrong type: given 'steel'": lambda: Section(0.1, 0.1, 0.0, "steel"),
    "Section 3: name: not a name: given '3'": lambda: Section(0.1, 0.1, 0.0, STEEL, "3"),
    "Section: length: 'N' is not a unit of length: given '1 N'": lambda: Section(
        "1 N", 0.1, 0.0, STEEL
    ),
    r"Shaft: sections: too few items: given 0; allowed: at least one": lambda: Shaft(0.0, ()),
    r"Shaft: sections.body.name: name given twice: 'body'": lambda: Shaft(0.0, SHAFT.sections * 2),
    "Shaft: sections: wrong type: given a Section": lambda: Shaft(0.0, SHAFT.sections[0]),
    r"Shaft: sections\.1: wrong type": lambda: Shaft(0.0, (1.0,)),
    "Shaft: shear_coefficient: .*did you mean cowper": lambda: replace(
        SHAFT, shear_coefficient="couper"
    ),
    "Shaft: shear_coefficient: number out of range": lambda: replace(SHAFT, shear_coefficient=2.0),
    r"PointMass m: polar_inertia: impossible body: given 0.1 kg m.2": lambda: PointMass(
        "m", 0.0, 1.0, 0.1, 0.01
    ),
    "PointMass m: mass: mass out of range": lambda: PointMass("m", 0.0, -1.0),
    r"Disc d: inner_diameter: no wall left: given inner diameter 0.2 m; .* outer, 0.1 m": lambda: (
        Disc("d", 0.0, 0.1, 0.2, 0.01, STEEL)
    ),
    r"BearingSeat a: thrust: .*allowed: \+x, -x": lambda: BearingSeat("a", BEARING, 0.0, "+y"),
    r"BearingSeat a: growth.static: leaves no contact angle": lambda: replace(
        FRONT, growth=RingGrowth(static=-1e-3)
    ),
    r"BearingSeat a: growth.static: reduces the contact angle to 0: given 0.0005 m": lambda: (
        replace(FRONT, growth=RingGrowth(500e-6))
    ),
    r"growth.fit: the bore of bearing a leaves no ring beside the balls: given 60.00 mm": lambda: (
        replace(FRONT, growth=RingGrowth(0.0, "computed", InterferenceFit(0.06, 1e-6)))
    ),
    r"RingGrowth: centrifugal: .* QuadraticInSpeed or 'computed' or None": lambda: RingGrowth(
        0.0, 1e-6
    ),
    "QuadraticInSpeed: speed: speed out of range: given 0 rad/s": lambda: QuadraticInSpeed(0, 0.0),
    "Spring: stiffness: .* or infinite": lambda: Spring(1.0, -INF),
    r"Sleeve s: bearings: too few items": lambda: Sleeve("s", (), Spring(1.0)),
    r"LinearSupport s: stiffness\[\('y', 'q'\)\]: |LinearSupport s: stiffness": lambda: (
        LinearSupport("s", 0.0, {("y", "q"): 1.0})
    ),
    r"stiffness\[\('y', 'y'\)\]: not finite": lambda: LinearSupport("s", 0, {("y", "y"): INF}),
    r"LinearSupport s: rigid: y is rigid and has entries": lambda: LinearSupport(
        "s", 0.0, {("y", "thz"): 1.0}, rigid=("y",)
    ),
    r"LinearSupport s: rigid\.2: repeated: given 'y'": lambda: LinearSupport(
        "s", 0.0, rigid=("y", "y")
    ),
    "supports 'l' and 'r' both constrain y there": lambda: spindle(
        supports=tuple(LinearSupport(n, 0.1, rigid=("y",)) for n in ("l", "r"))
    ),
    "support 'l' is rigid in x beside bearings": lambda: spindle(
        supports=(LinearSupport("l", 0.1, rigid=("x",)),)
    ),
    r"analyses.section_forces: no load acts: allowed: at least one of loads": lambda: case(
        spindle=spindle(seats=(), sleeves=(), supports=(SUPPORT,)),
        analyses={"section_forces": SectionForcesSpec()},
    ),
    r"analyses.section_forces.loads\.1.at: unknown point: given 'tp'.*did you mean tip": lambda: (
        case(analyses={"section_forces": SectionForcesSpec((PointLoad("tp"),))})
    ),
    r"section_forces.loads\.1.at: load off the shaft: given 0.301 m": lambda: case(
        analyses={"section_forces": SectionForcesSpec((PointLoad(0.301),))}
    ),
    r"section_forces.loads: free body in a static case: thx unrestrained, .* 2 N m": lambda: case(
        analyses={"section_forces": SectionForcesSpec((PointLoad("tip", Mx=2.0),))}
    ),
    r"twist_limits\.2: repeated: given 'a to b'": lambda: SectionForcesSpec(
        twist_limits=(TwistLimit("a", "b", 1.0), TwistLimit("a", "b", 2.0))
    ),
    "PointLoad: at: ": lambda: PointLoad(math.inf),
    r"bearings.a.name: name given twice: 'a'": lambda: spindle(seats=(FRONT, FRONT), sleeves=()),
    r"bearings.a.x: bearing off the shaft: given 0.4 m; allowed: 0 mm to 300.0 mm": lambda: spindle(
        seats=(replace(FRONT, x=0.4), REAR)
    ),
    r"sleeves.rear.bearings\.1: unknown bearing: given 'B'; allowed: a, b": lambda: spindle(
        sleeves=(replace(SLEEVE, bearings=("B",)),)
    ),
    r"bearings of one sleeve must all have the same thrust": lambda: spindle(
        sleeves=(replace(SLEEVE, bearings=("a", "b")),)
    ),
    r"sleeves.other.bearings\.1: bearing 'b' is already on sleeve 'rear'": lambda: spindle(
        sleeves=(SLEEVE, replace(SLEEVE, name="other"))
    ),
    r"shortening.shift.c: unknown bearing: given 'c'": lambda: spindle(
        shortening=PrescribedShortening(1.0, {"c": 0.0})
    ),
    r"shortening.reference: reference off the shaft: given 1 m": lambda: spindle(
        shortening=ComputedShortening(1.0)
    ),
    r"bearings.a.growth.fit: the bore of bearing a leaves no shaft: given 20.00 mm": lambda: (
        spindle(
            seats=(
                replace(FRONT, growth=RingGrowth(0.0, "computed", InterferenceFit(0.02, 1e-6))),
                REAR,
            )
        )
    ),
    r"rotor_damping\.2: ratio out of range": lambda: spindle(rotor_damping=(0.1, 1.0)),
    r"Drawbar: to: no length left: given 0.2 m to 0.1 m": lambda: Drawbar(1e4, 0.2, 0.1),
    "Drawbar: guides: .*everywhere": lambda: Drawbar(1e4, 0.0, 0.1, "nowhere"),
    "drawbar off the shaft: given 0.4 m": lambda: spindle(drawbar=Drawbar(1e4, 0.1, 0.4)),
    r"masses.m.name: name given twice: 'm'": lambda: Tool(
        "t", SHAFT.sections, (PointMass("m", 0, 1),) * 2
    ),
    r"Tool t: sections: too few items": lambda: Tool("t", ()),
    "Reference: quantity: .*did you mean preload_sum": lambda: Reference(
        "preload_sun", "measured", "x", (0.0,), (1.0,)
    ),
    "2 speeds for 1 values": lambda: Reference("preload_sum", "measured", "", (0.0, 1.0), (1.0,)),
    "Conditions: kinematics: .*did you mean outer": lambda: Conditions(kinematics="outr"),
    "Conditions: element_length: .* given 0 m": lambda: Conditions(element_length=0.0),
    r"CampbellSpec: teeth\.1: wrong type: given 2.5": lambda: CampbellSpec(teeth=(2.5,)),
    r"teeth\.2: not in ascending order: given 2 after 3": lambda: CampbellSpec(teeth=(3, 2)),
    r"engine_orders\.2: number out of range: given 1000.5; allowed: from 0.001 up to 1000": (
        lambda: CampbellSpec(engine_orders=(0.43, 1000.5))
    ),
    r"engine_orders\.1: number out of range: given 0": (
        lambda: CampbellSpec(engine_orders=(0.0, 1.0))
    ),
    r"frequencies\.2: repeated: given 1 Hz after 1 Hz": lambda: FrfSpec((1.0, 1.0), ((TIP, TIP),)),
    r"FrfSpec: pairs: too few items": lambda: FrfSpec((1.0,), ()),
    r"pairs\.2: repeated": lambda: FrfSpec((1.0,), ((TIP, TIP),) * 2),
    r"pairs\.1: 2 items are needed: given 1": lambda: FrfSpec((1.0,), ((TIP,),)),
    "axial motion and bending are not coupled": lambda: case(
        analyses={"frf": FrfSpec((1.0,), ((Port("tip", "x"), TIP),))}
    ),
    "couples plane y or the axis to other motions .yz.": lambda: case(
        spindle=spindle(supports=(replace(SUPPORT, stiffness={("y", "z"): 1.0}),)),
        analyses={"stiffness": StiffnessSpec("tip")},
    ),
    r"UnbalanceSpec: points: too few items": lambda: UnbalanceSpec((), (Unbalance("tip", 1e-6),)),
    r"UnbalanceSpec: there is no unbalance: allowed: at least one of unbalances": lambda: (
        UnbalanceSpec(("tip",))
    ),
    r"points\.2: repeated: given 'tip'": lambda: UnbalanceSpec(
        ("tip", "tip"), (Unbalance("tip", 1e-6),)
    ),
    r"BalanceGrade: planes: too many items: given 3; allowed: up to 2": lambda: BalanceGrade(
        2.5e-3, 100.0, (0.0, 0.1, 0.2)
    ),
    "BalanceGrade: phase: a couple needs two planes": lambda: BalanceGrade(
        2.5e-3, 100.0, (0.0,), "couple"
    ),
    r"unbalance.unbalances\.1.at: unknown point: given 'tp'.*did you mean tip": lambda: case(
        analyses={"unbalance": UnbalanceSpec(("tip",), (Unbalance("tp", 1e-6),))}
    ),
    "unbalance.grade.planes: the centre of gravity must lie between": lambda: case(
        analyses={"unbalance": UnbalanceSpec(("tip",), grade=BalanceGrade(1e-3, 1.0, (0.0, 0.1)))}
    ),
    r"tangents\.2: repeated": lambda: BearingMapSpec((1.0,), tangents=("frozen", "frozen")),
    r"Disc d: the mass of the disc: mass out of range": lambda: Disc(
        "d", 0.0, 10.0, 0.0, 90.0, STEEL
    ),
    "Port: direction: .* allowed: x, y, z, thx, thy, thz": lambda: Port("tip", "w"),
    r"variants\.1: not one of": lambda: StiffnessSpec("tip", variants=("all",)),
    "steps: out of range: given 0": lambda: StiffnessSpec("tip", steps=0),
    r"second_stop\[rear\]: length": lambda: StiffnessSpec("tip", second_stop={"rear": -1e-6}),
    r"ControlSpec: max_load: not above min_load, 10 N: given 10 N": lambda: ControlSpec(10.0),
    "ControlSpec: min_load: force out of range": lambda: ControlSpec(10.0, 1e-9),
    r"ControlSpec: radial: number out of range: given -0.1": lambda: ControlSpec(20.0, radial=-0.1),
    r"Conditions: loads\.cut\.name: name given twice: 'cut'": lambda: Conditions(
        loads=(PointLoad("tip", "cut", Fy=1.0), PointLoad("tip", "cut", Fy=2.0))
    ),
    r"loads\.2: not in ascending order: given 1 N after 2 N": lambda: BearingMapSpec((2.0, 1.0)),
    r"Case c: speeds\.1: speed out of range: given -1 rad/s": lambda: case(speeds=(-1.0,)),
    r"Case c: speeds\.2: not in ascending order: given 0 rad/s after 5 rad/s": lambda: case(
        speeds=(5.0, 0.0)
    ),
    r"Case c: speeds: too few items": lambda: case(speeds=()),
    "no analysis is given": lambda: case(analyses={}),
    "unknown analysis: prelod; .*did you mean preload": lambda: case(
        analyses={"prelod": PreloadSpec()}
    ),
    r"analyses.frf: needs a FrfSpec: given a PreloadSpec": lambda: case(
        analyses={"frf": PreloadSpec()}
    ),
    r"analyses.bearing: this analysis does not apply to a spindle": lambda: case(
        analyses={"bearing": BearingMapSpec((1.0,))}
    ),
    r"analyses.preload: this analysis does not apply to a single bearing": lambda: case(
        spindle=None, bearing=BEARING
    ),
    "given both": lambda: case(bearing=BEARING),
    r"frf.pairs\.1.response: unknown point: given 'tipp'; allowed: tip": lambda: case(
        analyses={"frf": FrfSpec((1.0,), ((Port("tipp", "y"), TIP),))}
    ),
    r"frf.slices\.1: not within the speeds of the case: given 2000 rad/s": lambda: case(
        analyses={"frf": FrfSpec((1.0,), ((TIP, TIP),), (2000.0,))}
    ),
    r"MeasuredResponse m: file: no response: given zero at every": lambda: MeasuredResponse(
        "m", TIP, TIP, (1.0, 2.0), (0.0, 0.0), (0.0, 0.0)
    ),
    r"analyses.stiffness.point: unknown point": lambda: case(
        analyses={"stiffness": StiffnessSpec("nose")}
    ),
    r"second_stop.front: unknown sleeve: given 'front'; allowed: rear": lambda: case(
        analyses={"stiffness": StiffnessSpec("tip", second_stop={"front": 1e-5})}
    ),
    "second_stop: films and temperatures .* variant that has the other stop_travel": lambda: case(
        conditions=Conditions(films=Lubrication(32e-6, 5.4e-6, 40.0)),
        analyses={"stiffness": StiffnessSpec("tip", second_stop={"rear": 1e-5})},
    ),
    r"spindle.points.far: point off the shaft: given 9 m": lambda: case(
        spindle=spindle(points={"far": 9.0})
    ),
    r"analyses.preload: needs bearings": lambda: case(
        spindle=spindle(seats=(), sleeves=(), supports=(SUPPORT,))
    ),
    r"spindle.supports: the shaft is unrestrained: .* zz": lambda: case(
        spindle=spindle(
            seats=(), sleeves=(), supports=(replace(SUPPORT, stiffness={("y", "y"): 1.0}),)
        ),
        analyses={"campbell": CampbellSpec()},
    ),
    "more than 1000 elements": lambda: case(conditions=Conditions(element_length=1e-6)),
    r"unknown condition: given 'rotr'; .*did you mean rotor": lambda: case(
        references=(
            Reference("preload_sum", "measured", "", (0.0,), (1.0,), conditions={"rotr": "x"}),
        )
    ),
    r"variants: not a name: given '\.\./up'": lambda: case(variants={"../up": case()}),
    r"conditions.rotor: does not apply to a single bearing": lambda: case(
        spindle=None,
        bearing=BEARING,
        analyses={"bearing": BearingMapSpec((100.0,))},
        conditions=Conditions(rotor="rigid"),
    ),
    r"support 'left' pushes the shaft across the axis .*\(yx\)": lambda: case(
        spindle=spindle(supports=(LinearSupport("left", 0.0, {("x", "x"): 1e6, ("y", "x"): 1e6}),)),
        conditions=Conditions(axial_force=10.0),
    ),
    r"outer_diameter: length out of range: given 50 m; .*did you mean 50 mm = 0.05 m": (
        lambda: Section(0.1, 50.0, 0.0, STEEL)
    ),
    r"speeds\.2: n·dm of bearing a is .* given 229183 rpm; .*did you mean 24000 rpm = 2513": (
        lambda: case(speeds=(0.0, 24000.0))
    ),
    r"Case .: title: given 'a.x00' with the character U.0000; allowed: text without it": lambda: (
        case(title="a\0")
    ),
    r"Case a : name: given 'a.ud800' with the character U.D800": lambda: case(name="a\ud800"),
    r"LinearSupport a: stiffness: unknown entry: given 'yq'; .*as yy or y_thz": lambda: (
        LinearSupport("a", 0.0, {"yq": 1.0})
    ),
    r"LinearSupport a: damping: not a matrix .*: given 2 rows of 2, 2; .*: 6 rows of 6": lambda: (
        LinearSupport("a", 0.0, damping=np.eye(2))
    ),
    r"LinearSupport a: stiffness: not a matrix .*: given '5.0'; .*: 1 rows": lambda: LinearSupport(
        "a", 0.0, {"dof": ["y"], "matrix": 5.0}
    ),
    r"LinearSupport a: stiffness: not DOF: given 'y, y'; .* different ones of x, y,": lambda: (
        LinearSupport("a", 0.0, {"dof": ["y", "y"], "matrix": np.eye(2)})
    ),
    r"LinearSupport a: stiffness: an entry is given twice": lambda: LinearSupport(
        "a", 0.0, {"yy": 1.0, ("y", "y"): 2.0}
    ),
    r"MatricesSpec: ports\.1: unknown direction: given 'tip.q'": lambda: MatricesSpec(
        1e3, ("tip.q",)
    ),
    r"MatricesSpec: ports\.1: not a place: given 'tip'": lambda: MatricesSpec(1e3, ("tip",)),
    r"compare.v: the speeds and analyses": lambda: case(variants={"v": case(speeds=(1.0,))}),
}


@pytest.mark.parametrize("said", IMPOSSIBLE)
def test_impossible_values_are_refused_in_one_sentence(said: str) -> None:
    with pytest.raises(InvalidInput, match=said) as refused:
        IMPOSSIBLE[said]()
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "make",
    [
        lambda: replace(BEARING, ball_diameter="9 mm"),
        lambda: replace(BEARING, contact_angle=NAN),
        lambda: replace(BEARING, balls=NAN),
        lambda: replace(BEARING, balls=None),
        lambda: Material("m", None, 0.3, 7800.0),
        lambda: Material("m", 2e11, NAN, 7800.0),
    ],
)
def test_impossible_bearings_are_refused_in_one_sentence(make: Callable[[], object]) -> None:
    with pytest.raises(InvalidBearing, match=r"must be a (finite )?number") as refused:
        make()
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("call", [rotordyn.run, rotordyn.load])
@pytest.mark.parametrize("thing", [None, 3, ["mfw2310"], b"mfw2310"])
def test_a_thing_of_another_kind_is_refused(call: Callable[[Any], object], thing: object) -> None:
    with pytest.raises(InvalidInput, match="takes"):
        call(thing)


def test_text_with_a_unit_and_words_of_files_are_taken() -> None:
    """What a file takes, Python takes; bare numbers are in SI."""
    given: Any = ("70 mm", "50 mm", 0.0, STEEL)
    assert Section(*given) == Section(0.07, 0.05, 0.0, STEEL)
    given = ("574 N", "rigid")
    assert Spring(*given) == Spring(574.0, INF)
    given = ("a", BEARING, "50 mm", "-x")
    assert BearingSeat(*given) == replace(FRONT, thrust=-1)


def test_matrices_and_ports_are_taken_as_files_write_them() -> None:
    """Entries by name, whole, or as 6 × 6 numbers; places as POINT.DIRECTION."""
    table = {"yy": [1e8, "2 kN/mm"], "zz": 1e8}
    made = LinearSupport("left", 0.0, table, speeds=(0.0, 100.0))
    assert made.stiffness == {("y", "y"): (1e8, 2e6), ("z", "z"): 1e8}
    every = np.zeros((6, 6))
    every[1, 1] = every[2, 2] = 1e8
    whole = {"dof": ["y", "z"], "matrix": [["100 N/um", 0.0], [0.0, 1e8]]}
    rows = tuple(map(tuple, every))
    for each in ({"yy": 1e8, "zz": "100 N/um"}, whole, every, every.tolist(), rows):
        assert LinearSupport("left", 0.0, each) == SUPPORT
    skew = {"dof": ["y", "thz"], "matrix": [[1e8, "5 kN/rad"], [0.0, 1e5]]}
    for each in (skew, {"yy": 1e8, "y_thz": "5 kN/rad", "thz_thz": 1e5}):
        own = {("y", "y"): 1e8, ("y", "thz"): 5e3, ("thz", "thz"): 1e5}
        assert LinearSupport("left", 0.0, each).stiffness == own
    over_speed = np.zeros((6, 6, 2))
    over_speed[1, 1], over_speed[2, 2] = (1e8, 2e6), (1e8, 1e8)
    for rows in (over_speed, over_speed.tolist(), [*over_speed]):
        each = LinearSupport("left", 0.0, rows, speeds=(0.0, 100.0))
        assert each.stiffness == {("y", "y"): (1e8, 2e6), ("z", "z"): (1e8, 1e8)}
    assert FrfSpec((1.0,), (("tip.y", TIP),)) == FrfSpec((1.0,), ((TIP, TIP),))
    assert MatricesSpec(1e3, ("tip.y",)).ports == (TIP,)
    asked = case(analyses={"matrices": MatricesSpec(1e3, (Port("tip", "z"),))})
    asked = asked.vary({"analyses.matrices.ports": ["tip.y"]})
    assert asked.analyses["matrices"] == MatricesSpec(1e3, (TIP,))


def test_every_description_that_a_spec_takes_can_be_had() -> None:
    """Of the analyses and of the machine, by a walk through all annotations."""
    rooms = [dir(importlib.import_module(f"rotordyn.{room}")) for room in ("analyses", "machine")]
    wanted: list[type] = [Conditions, *(analysis(name).spec for name in built_in())]
    for kind in wanted:  # which grows on the way
        inner = (each for field in declared(kind) for each in descriptions(field.annotation))
        wanted += [each for each in inner if each not in wanted]
    named = {kind.__name__ for kind in wanted if issubclass(kind, Description)}
    assert len(named) > 30
    assert named - {*rooms[0], *rooms[1]} == set()


def test_fields_are_kept_in_one_form() -> None:
    """Lists become tuples, numbers of numpy plain ones, mappings the description's own."""
    points = {"tip": np.float32(0.0)}
    made = case(speeds=np.linspace(0, 100, 3), spindle=spindle(points=points, rotor_damping=[0.1]))
    assert made.speeds == (0.0, 50.0, 100.0)
    assert {type(speed) for speed in made.speeds} == {float}
    assert made.spindle is not None
    assert made.spindle.rotor_damping == (0.1,)
    points["other"] = np.float32(1.0)
    assert made.spindle.points == {"tip": 0.0}
    assert type(StiffnessSpec("tip", steps=np.int64(3)).steps) is int
    assert type(Section(1, 1, 0, STEEL).length) is float


@given(st.floats())
def test_a_length_is_taken_just_where_its_range_holds(value: float) -> None:
    """Against the range written out; the sentence is there exactly where the value is refused."""
    assert LENGTH.holds(value) == (0.0 < value <= 100.0)
    assert bool(LENGTH.refusal(value)) != LENGTH.holds(value)
    assert RIGIDITY.holds(value) == (0.0 < value <= 1e12 or value == INF)


@pytest.mark.parametrize("room", ["rotordyn", "rotordyn.machine", "rotordyn.analyses", "bearings"])
def test_every_name_of_a_face_can_be_had(room: str) -> None:
    face = importlib.import_module(room)
    assert dir(face) == sorted(face.__all__)
    assert all(getattr(face, name) is not None for name in face.__all__)
    with pytest.raises(AttributeError, match="nothing_such"):
        _ = face.nothing_such


def test_files_have_every_field_of_a_material() -> None:
    """With the range by which Python refuses a value, and its meaning."""
    named = {key.name: key for key in keys_of(Material) if key.name}  # not notes beside them
    assert [*named] == [field.name for field in fields(Material)]
    assert all(key.meaning for key in named.values())
    limits = {name: found_in(key.annotation, Quantity) for name, key in named.items()}
    assert {name: limit.allowed for name, limit in limits.items() if limit} == {
        "young_modulus": "from 1 GPa up to 2000 GPa",
        "poisson_ratio": "above -1 below 0.5",
        "density": "from 100 kg/m^3 up to 30000 kg/m^3",
        "thermal_expansion": "from -0.0001 1/K up to 0.001 1/K",
    }


@pytest.mark.parametrize("name", ["grinding_spindle", "mfw2310_computed", "friswell_coaxial"])
def test_mappings_of_a_description_are_read_alone(name: str) -> None:
    """Of a file as of Python; what holds the same has the same hash, and travels unchanged."""
    case = rotordyn.load(name)
    spindle = case.spindle
    assert spindle is not None
    changes: list[Callable[[Any], object]] = [
        lambda held: held.update(nose=-5.0),
        lambda held: held.clear(),
        lambda held: held.pop("nose"),
        lambda held: held.setdefault("nose", -5.0),
        lambda held: held.__setitem__("nose", -5.0),
        lambda held: held.__delitem__("nose"),
        lambda held: held.__ior__({"nose": -5.0}),
    ]
    for held in (spindle.points, replace(spindle, points={"nose": 0.0}).points):
        before = dict(held)
        for change in changes:
            with pytest.raises(TypeError, match="a description is not changed"):
                change(held)
        assert held == before
    again = replace(spindle, points=dict(reversed(spindle.points.items())))
    assert hash(again) == hash(spindle)
    for same in (pickle.loads(pickle.dumps(case)), copy.deepcopy(case)):
        assert same == case
        assert hash(same) == hash(case)
        with pytest.raises(TypeError, match="a description is not changed"):
            same.spindle.points["nose"] = -5.0
