"""Bearings in sets by their names, preloaded by force, class and ring offset: closed forms of pairs
and sets, a maker's printed pair, and what contradicts a name."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import bearings
import rotordyn
from bearings import AngularContactBallBearing, DeepGrooveBallBearing
from bearings.ball.law import Law
from bearings.materials import SILICON_NITRIDE, STEEL
from rotordyn.analyses import PreloadSpec
from rotordyn.analyses.preload.solve import solve
from rotordyn.analyses.preload.summary import summary
from rotordyn.errors import InvalidInput
from rotordyn.machine import BearingSet, Fits, RingGrowth, SetPreload, Spring
from rotordyn.machine.bearing_set import SETS, patterns
from rotordyn.machine.plausibility import implausible
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.mounting import (
    class_offset,
    mounted_preloads,
    ring_offset,
)
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.study.solve import study_of
from tests.oracles.spindles import RPM

BEARING = AngularContactBallBearing(9.525e-3, 90e-3, 24, contact_angle=math.radians(25.0))
NAMES = "abcd"


def spindle(
    name: str,
    preload: SetPreload | None,
    bearing: AngularContactBallBearing = BEARING,
    **seat: object,
) -> Spindle:
    """A set of bearings, 25 mm apart."""
    seats = tuple(
        BearingSeat(NAMES[k], bearing, 0.05 + 0.025 * k, thrust=1 if sign == "+" else -1, **seat)  # type: ignore[arg-type]
        for k, sign in enumerate(SETS[name])
    )
    shaft = Shaft(0.0, (Section(0.3, 0.07, 0.03, STEEL),))
    own = BearingSet(name, tuple(NAMES[: len(seats)]), preload)
    return Spindle("set", shaft, seats=seats, arrangement=own)


def state(machine: Spindle, rpm: float = 0.0, **conditions: object) -> Scene:
    return Scene(machine, Conditions(**conditions), np.array([rpm * RPM]))  # type: ignore[arg-type]


def deflection(force: float, growth: float = 0.0) -> float:
    """Axial displacement of one bearing [m]."""
    found = BEARING.equilibrium(load=[force, 0, 0, 0, 0], static_growth=growth)
    return float(found.displacement[0])


def test_names_of_sets() -> None:
    assert patterns("DB") == ("+-",)
    assert patterns("TBT") == ("++-", "+--")
    assert patterns("QBC") == ("++--",)
    assert patterns("DT") == ("++", "--")
    known = {signs for name in SETS for signs in patterns(name)}
    assert len(known) == sum(len(patterns(name)) for name in SETS), "no two names are the same set"


@pytest.mark.parametrize("name", ["DB", "DF", "TBT", "TFT", "QBC", "QFC", "QBT", "QFT"])
def test_a_set_is_the_same_as_its_thrusts_and_a_locked_sleeve(name: str) -> None:
    machine = spindle(name, SetPreload(force=600.0))
    (sleeve,) = machine.sleeves
    assert sleeve.spring == Spring(600.0, math.inf)
    plain = replace(machine, arrangement=None)
    both = [state(each, 6000.0).preload for each in (machine, plain)]
    assert both[0].outcome == ("",)
    assert (both[0].seat_load() == both[1].seat_load()).all()
    mounted = both[0].mounted_load()
    front = np.array([sign == SETS[name][0] for sign in SETS[name]])
    assert mounted[front].sum() == pytest.approx(600.0, rel=1e-9)
    assert mounted[~front].sum() == pytest.approx(600.0, rel=1e-9)


def test_force_and_offset_give_one_another() -> None:
    """Of free bearings the offset is the sum of both deflections; it gives the force back."""
    machine = spindle("DB", SetPreload(force=600.0))
    offset = ring_offset(machine, machine.sleeves[0], 600.0)
    assert offset == pytest.approx(2.0 * deflection(600.0), rel=1e-12)
    back = spindle("DB", SetPreload(offset=offset))
    assert mounted_preloads(back)[0] == pytest.approx(600.0, rel=1e-9)
    result = solve(state(back), PreloadSpec())
    assert result.mounted_preload == pytest.approx([600.0], rel=1e-9)
    assert result.ring_offset == pytest.approx([offset], rel=1e-9)
    assert any("600 N as mounted" in line for line in summary(result))


@pytest.mark.parametrize("thrust", [1, -1])
def test_an_offset_beside_bearings_for_both_ways_gives_its_force_back(thrust: int) -> None:
    """One of the two that face the sleeve takes thrust both ways, mounted either way round."""
    deep = DeepGrooveBallBearing(9.525e-3, 90e-3, 12, radial_clearance=-5e-6)
    machine = spindle("TBT", SetPreload(force=500.0))
    first, *rest = machine.seats
    plain = replace(
        machine,
        arrangement=None,
        seats=(replace(first, bearing=deep, thrust=thrust), *rest),
        sleeves=(Sleeve("s", ("c",), Spring(500.0, math.inf)),),
    )
    offset = ring_offset(plain, plain.sleeves[0], 500.0)
    by_offset = Sleeve("s", ("c",), Spring(0.0, math.inf, offset=offset))
    assert mounted_preloads(replace(plain, sleeves=(by_offset,)))[0] == pytest.approx(500.0)


@pytest.mark.parametrize("force", [0.105, 1.05, 9.5, 10.5, 102.0, 995.0, 1040.0, 10500.0])
def test_an_offset_of_any_size_gives_its_force_back(force: float) -> None:
    """Beside every power of ten as well, between which the force is sought."""
    machine = spindle("DB", SetPreload(force=force))
    offset = ring_offset(machine, machine.sleeves[0], force)
    back = spindle("DB", SetPreload(offset=offset))
    assert mounted_preloads(back)[0] == pytest.approx(force, rel=1e-8)


def test_fits_raise_the_preload_of_an_offset() -> None:
    """Growth takes up BD (sin α − sin α') of each bearing: by the law of one bearing at the grown
    angle."""
    from scipy.optimize import brentq

    fits = Fits(shaft="k5", bore_diameter=0.07)
    free, mounted = (spindle("DB", SetPreload(class_force=200.0), fits=f) for f in (None, fits))
    from rotordyn.preload.growth import static_growth

    growth = static_growth(mounted, mounted.seats[0])
    angle, distance = BEARING.free_angle, BEARING.free_distance
    gain = distance * (math.sin(angle) - math.sin(math.acos(math.cos(angle) + growth / distance)))
    total = 2.0 * deflection(200.0) + 2.0 * gain
    known = brentq(lambda p: 2.0 * deflection(p, growth) - total, 1.0, 1e5)
    assert mounted_preloads(mounted)[0] == pytest.approx(known, rel=1e-9)
    assert mounted_preloads(free)[0] == pytest.approx(200.0, rel=1e-9)
    assert known > 300.0
    assert class_offset(mounted, mounted.sleeves[0], 200.0) == pytest.approx(2 * deflection(200.0))


@pytest.mark.parametrize(
    ("name", "factor"), [("DB", 1.0), ("TBT", 1.36), ("QBT", 1.57), ("QBC", 2.0)]
)
def test_sets_of_one_class_are_preloaded_more_than_pairs(name: str, factor: float) -> None:
    """All bearings are ground to the offset of the class; makers print the factors to two digits
    (SKF, super-precision bearings, preload of sets: 1.36, 1.57 or 1.6, 2)."""
    machine = spindle(name, SetPreload(class_force=300.0))
    found = mounted_preloads(machine)[0] / 300.0
    assert found == pytest.approx(factor, rel=0.01)


def test_a_class_of_a_maker_in_a_file(tmp_path: Path) -> None:
    case = rotordyn.load("preload_concepts")
    machine = case.variants["back_to_back"].spindle
    assert machine is not None
    assert machine.sleeves[0].spring == Spring(570.0, math.inf, free=True)
    assert [seat.thrust for seat in machine.seats] == [1, -1]
    other = case.variants["face_to_face"].spindle
    assert other is not None
    assert [seat.thrust for seat in other.seats] == [-1, 1]
    assert case.variants["back_to_back"].vary({"spindle.arrangement.preload.class_force": 100.0})


@pytest.mark.long
def test_a_printed_pair() -> None:
    """FAG HS7014E: rigidities 131.9, 196.4, 256.2 N/µm and unloading forces 419, 1277, 2608 N of
    the three classes, by one estimated inside and the network of a spindle."""
    made = bearings.estimate(
        bore=0.07,
        outside_diameter=0.11,
        contact_angle=math.radians(25.0),
        preloads=[146.0, 437.0, 874.0],
        rigidities=[131.9e6, 196.4e6, 256.2e6],
        unloading=[419.0, 1277.0, 2608.0],
    )
    rigidity, unloading = [], []
    for force in (146.0, 437.0, 874.0):
        machine = spindle("DB", SetPreload(class_force=force), made)
        found = state(machine).preload
        rigidity += [found.seat_stiffness()[0, :, 0, 0].sum()]
        low, high = 2.5 * force, 3.5 * force
        for _ in range(9):  # to 2e-3 of the force
            middle = 0.5 * (low + high)
            load = state(machine, axial_force=middle).preload.seat_load()
            low, high = (low, middle) if load.min() <= 0.0 else (middle, high)
        unloading += [low]
    assert rigidity == pytest.approx([131.9e6, 196.4e6, 256.2e6], rel=0.025)
    assert unloading == pytest.approx([419.0, 1277.0, 2608.0], rel=0.01)


def test_constant_force_and_spring() -> None:
    """A piston keeps its force at speed, a spring hardly, a locked set does not."""
    ways = (
        SetPreload(constant_force=600.0),
        SetPreload(force=600.0, stiffness=2e6),
        SetPreload(force=600.0),
    )
    hybrid = replace(BEARING, ball_material=SILICON_NITRIDE)
    grown = RingGrowth(centrifugal=None)
    loads = [
        state(spindle("DB", way, hybrid, growth=grown), 12000.0).preload.seat_load()[0, 1]
        for way in ways
    ]
    assert loads[0] == pytest.approx(600.0, rel=1e-5)
    assert 600.0 < loads[1] < loads[2]


@pytest.mark.parametrize(
    ("words", "build"),
    [
        ("a set TBT has 3 bearings", lambda: BearingSet("TBT", ("a", "b"), SetPreload(force=1.0))),
        (
            "do not make a set DF: their thrusts from front to rear are \\+-",
            lambda: replace(
                spindle("DB", SetPreload(force=600.0)),
                arrangement=BearingSet("DF", ("a", "b"), SetPreload(force=600.0)),
            ),
        ),
        (
            "name the set DB",
            lambda: replace(
                spindle("DB", SetPreload(force=600.0)),
                arrangement=BearingSet("DT", ("a", "b")),
            ),
        ),
        (
            "from front to rear they are a, b",
            lambda: replace(
                spindle("DB", SetPreload(force=600.0)),
                arrangement=BearingSet("DB", ("b", "a"), SetPreload(force=600.0)),
            ),
        ),
        ("do not preload one another", lambda: spindle("DT", SetPreload(force=600.0))),
        ("a set DB needs it", lambda: spindle("DB", None)),
        ("given in one way", lambda: SetPreload(force=1.0, offset=1e-6)),
        ("given in one way: given none", SetPreload),
        (
            "friction: has no effect where the rings are locked",
            lambda: SetPreload(force=600.0, friction=50.0),
        ),
        ("a spring needs its force", lambda: SetPreload(offset=1e-6, stiffness=1e6)),
        ("one determines the other", lambda: Spring(100.0, math.inf, offset=1e-6)),
        (
            "unknown bearing",
            lambda: replace(
                spindle("DB", SetPreload(force=600.0)),
                arrangement=BearingSet("DB", ("a", "x"), SetPreload(force=600.0)),
            ),
        ),
    ],
)
def test_bad_input_is_one_sentence(words: str, build: object) -> None:
    with pytest.raises(InvalidInput, match=words):
        build()  # type: ignore[operator]


def test_a_class_that_a_bearing_does_not_have(tmp_path: Path) -> None:
    text = (Path(rotordyn.__file__).parents[1] / "cases" / "preload_concepts.yaml").read_text()
    file = tmp_path / "case.yaml"
    file.write_text(text.replace("model: kh6014e", "model: vex90"))
    with pytest.raises(InvalidInput, match="has no such class of preload: given 'medium'; allowed"):
        rotordyn.load(file)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("bearings: [front, rear], preload: {class", "bearings: front, preload: {class", "a list"),
        ("{class: medium}}", "{class: [medium]}}", "no such class of preload: given"),
        (
            "arrangement: {set: DB",
            "arrangement: {set: [DB]",
            "arrangement.set: not one of its choices",
        ),
        ("{class: medium}}", "{class: medium, class_force: 300 N}}", "class: a class gives"),
        (
            "sleeves: []",
            "sleeves: [{name: set, bearings: [rear], spring: {preload: 1 N, stiffness: rigid}}]",
            "the arrangement defines the sleeve 'set'",
        ),
        (
            "sleeves: []",
            "sleeves: [{name: s, bearings: [rear], spring: {preload: 1 N, stiffness: rigid}}]",
            "'s', and the arrangement carries it by its preload: leave one of the two out",
        ),
        (
            "{name: rear, model: kh6014e",
            "{name: rear, model: vex70",
            "the bearings of the set have other forces of this class: 570 N, 610 N",
        ),
        (
            "{name: rear, model: kh6014e",
            "{name: rear, model: lacroix_r24_14",
            "bearing rear has no such class",
        ),
        ("housing: JS6}", "housing: JS6, housing_diameter: 5 N}", "'N' is not a unit of length"),
    ],
)
def test_faults_of_a_file_with_a_set(tmp_path: Path, old: str, new: str, words: str) -> None:
    text = (Path(rotordyn.__file__).parents[1] / "cases" / "preload_concepts.yaml").read_text()
    file = tmp_path / "case.yaml"
    file.write_text(text[: text.index("compare:")].replace(old, new))
    with pytest.raises(InvalidInput, match=words):
        rotordyn.load(file)


def test_friction_and_stop_of_a_set_are_those_of_its_sleeve() -> None:
    """The set is the same as thrusts and a sleeve written out; the sleeve follows from the set."""
    way = SetPreload(force=600.0, stiffness=5e6, friction=40.0, stop_travel=20e-6)
    named = spindle("DB", way)
    sleeve = Sleeve("set", ("b",), Spring(600.0, 5e6), stop_travel=20e-6, friction=40.0)
    assert named.sleeves == (sleeve,)
    with pytest.raises(InvalidInput, match=r"sleeves\.set\.friction: changes nothing"):
        rotordyn.vary(named, {"sleeves.set.friction": 50.0})
    assert rotordyn.vary(named, {"arrangement.preload.friction": 50.0}).sleeves[0].friction == 50.0


def test_a_set_and_a_sleeve_beside_it_are_changed_together() -> None:
    """As one after the other; only a change of the sleeve of the set itself is refused."""
    pair = spindle("DF", SetPreload(offset=14e-6))
    rear = BearingSeat("r", BEARING, 0.25, thrust=1)
    beside = Sleeve("beside", ("r",), Spring(300.0, 5e5))
    machine = replace(pair, seats=(*pair.seats, rear), sleeves=(beside, *pair.sleeves))
    of_set, of_sleeve = {"arrangement.preload.offset": 10e-6}, {"sleeves.beside.stop_travel": 5e-5}
    one_by_one = rotordyn.vary(rotordyn.vary(machine, of_set), of_sleeve)
    assert one_by_one.sleeves[0].stop_travel == 5e-5
    for both in (of_set | of_sleeve, of_sleeve | of_set):
        assert rotordyn.vary(machine, both) == one_by_one
    undone = {**of_set, **of_sleeve, "sleeves.set.friction": 50.0}
    with pytest.raises(InvalidInput, match=r"^sleeves\.set\.friction: changes nothing"):
        rotordyn.vary(machine, undone)


def test_another_set_turns_the_bearings_whose_thrusts_follow_from_it() -> None:
    """As in a file that names the other set; a thrust that is given stays and contradicts it."""
    variants = rotordyn.load("preload_concepts").variants
    back, face = (variants[name].spindle for name in ("back_to_back", "face_to_face"))
    assert [seat.thrust for seat in back.seats] == [1, -1]
    other = rotordyn.vary(back, {"arrangement.set": "DF"})
    assert [seat.thrust for seat in other.seats] == [-1, 1]
    assert (other.seats, other.sleeves) == (face.seats, face.sleeves)
    warm = rotordyn.vary(back, {"arrangement.set": "DF", "bearings.front.damping.radial": 7.0})
    assert (warm.seats[0].thrust, warm.seats[0].radial_damping) == (-1, 7.0)
    given = spindle("DB", SetPreload(force=600.0))
    with pytest.raises(InvalidInput, match="do not make a set DF"):
        rotordyn.vary(given, {"arrangement.set": "DF"})
    four = spindle("QFT", SetPreload(force=600.0))
    seats = [replace(seat, by_set=k != 1) for k, seat in enumerate(four.seats)]
    other = rotordyn.vary(replace(four, seats=tuple(seats)), {"arrangement.set": "QBT"})
    assert [seat.thrust for seat in other.seats] == [1, -1, -1, -1], "mirrored, as the given one"


@pytest.mark.parametrize("word", ["light", "heavy"])
def test_another_class_is_that_of_a_file_that_names_it(word: str, tmp_path: Path) -> None:
    text = (Path(rotordyn.__file__).parents[1] / "cases" / "preload_concepts.yaml").read_text()
    text = text[: text.index("compare:")]
    (tmp_path / "medium.yaml").write_text(text)
    (tmp_path / "other.yaml").write_text(text.replace("class: medium", f"class: {word}"))
    medium, other = (rotordyn.load(tmp_path / f"{name}.yaml") for name in ("medium", "other"))
    path = "spindle.arrangement.preload.class"
    wanted = other.spindle.arrangement
    assert wanted.preload.class_force != medium.spindle.arrangement.preload.class_force
    varied = rotordyn.vary(medium, {path: word}).spindle
    assert (varied.arrangement, varied.sleeves) == (wanted, other.spindle.sleeves)
    assert study_of(medium, {path: ["medium", word]}).design.point(1) == {path: word}
    with pytest.raises(InvalidInput, match="no common force of a class 'extra'; allowed: light"):
        rotordyn.vary(medium, {path: "extra"})
    machine, path = medium.spindle, path.removeprefix("spindle.")
    front, rear = machine.seats
    beside = replace(rear, name="beside", x=rear.x + 0.05, preloads=())
    of_three = rotordyn.vary(replace(machine, seats=(front, rear, beside)), {path: word})
    assert of_three.arrangement == wanted, "the third one is not of the set"
    twice = replace(rear, preloads=tuple(2.0 * each for each in rear.preloads))
    with pytest.raises(InvalidInput, match=f"no common force of a class '{word}'"):
        rotordyn.vary(replace(machine, seats=(front, twice)), {path: word})


def test_a_class_with_another_model_is_the_force_of_that_model(tmp_path: Path) -> None:
    """Also where the class stays; a model that prints none is refused, as in a file."""
    text = (Path(rotordyn.__file__).parents[1] / "cases" / "preload_concepts.yaml").read_text()
    file, text = tmp_path / "case.yaml", text[: text.index("compare:")]
    file.write_text(text)
    plain = rotordyn.load(file)
    for changes in (
        {"bearings.*.model": "vex70"},
        {"bearings.*.model": "vex70", "arrangement.preload.class": "light"},
        {"bearings.*.model": "vex70", "arrangement.preload.class_force": "200 N"},
    ):
        varied = rotordyn.vary(plain, changes)
        force = varied.spindle.arrangement.preload.class_force
        if "arrangement.preload.class_force" in changes:
            assert force == 200.0
            continue
        listed = "".join(f"  {path}: {value}\n" for path, value in changes.items())
        file.write_text(text.replace("override:\n", f"override:\n{listed}"))
        assert varied.spindle == rotordyn.load(file).spindle
        assert force != plain.spindle.arrangement.preload.class_force
    with pytest.raises(InvalidInput, match="no common force of a class 'medium'"):
        rotordyn.vary(plain, {"bearings.rear.model": BEARING})


def test_a_constant_force_is_no_mistaken_spring() -> None:
    machine = spindle("DB", SetPreload(constant_force=600.0))
    assert machine.sleeves[0].spring.rate == "constant"
    assert not [words for words in implausible(machine, 0.0) if "stiffness" in words]


def test_a_set_of_weak_bearings_is_mounted_too() -> None:
    """They have no state under the largest force that is thought of."""
    pair = rotordyn.load("preload_concepts").variants["offset"].spindle
    assert pair is not None
    seats = tuple(replace(s, bearing=replace(s.bearing, balls=7)) for s in pair.seats)
    weak = replace(pair, seats=seats)
    force = mounted_preloads(weak)[0]
    given = pair.sleeves[0].spring.offset
    assert ring_offset(weak, weak.sleeves[0], force) == pytest.approx(given, rel=1e-9)


@pytest.mark.parametrize("force", [100.0, 900.0])
def test_bearings_of_a_side_that_grow_unlike_are_together(force: float) -> None:
    """One place of the rings is sought where their loads, of one bearing each, add up to the force:
    a bearing whose growth has taken up more play carries more."""
    from scipy.optimize import brentq

    machine = spindle("TBT", SetPreload(force=force))
    unlike = (RingGrowth(static=8e-6), RingGrowth(static=-4e-6), RingGrowth(static=3e-6))
    seats = tuple(replace(s, growth=g) for s, g in zip(machine.seats, unlike, strict=True))
    machine = replace(machine, seats=seats)
    free, angle = BEARING.free_distance, BEARING.free_angle

    def carried(place: float, growth: float) -> float:
        """Load of one bearing at a place of its free ring [N]."""
        gap = free * math.cos(angle) + growth
        own = place + free * math.sin(angle) - math.sqrt(free**2 - gap**2)
        motion = [own, 0.0, 0.0, 0.0, 0.0]
        return float(BEARING.equilibrium(displacement=motion, static_growth=growth).load[0])

    def place(growths: list[float]) -> float:
        total = lambda x: sum(carried(x, g) for g in growths) - force  # noqa: E731
        return float(brentq(total, -1e-4, 1e-4, xtol=1e-15))

    sides = {
        sign: [g.static for g, seat in zip(unlike, seats, strict=True) if seat.thrust == sign]
        for sign in (1, -1)
    }
    assert sorted(len(growths) for growths in sides.values()) == [1, 2]
    known = sum(place(growths) for growths in sides.values())
    assert ring_offset(machine, machine.sleeves[0], force) == pytest.approx(known, abs=1e-12)


@pytest.mark.parametrize("thrusts", [(1, -1, -1), (1, -1, 1, -1), (1, 1, -1, -1)])
@pytest.mark.parametrize("sprung", [False, True])
def test_sets_that_are_mounted_together_press_the_shaft_together(
    thrusts: tuple[int, ...], sprung: bool
) -> None:
    """Two sleeves in one housing, at offsets of 10 and 14 µm, or the second one on a spring: where
    the shaft has no force left, by the law of one bearing."""
    from scipy.optimize import brentq

    plain = replace(spindle("DT", None), arrangement=None)
    seats = tuple(
        replace(plain.seats[0], name=f"b{k}", x=0.03 + 0.05 * k, thrust=thrust)
        for k, thrust in enumerate(thrusts)
    )
    springs = Spring(0.0, offset=10e-6), Spring(300.0, 5e6) if sprung else Spring(0.0, offset=14e-6)
    sleeves = tuple(Sleeve(f"s{k}", (f"b{k}",), springs[k - 1]) for k in (1, 2))
    machine = replace(plain, seats=seats, sleeves=sleeves)
    given = {1: -thrusts[1] * 10e-6, 2: -thrusts[2] * 14e-6}

    def carried(k: int, shaft: float) -> float:
        if k == 2 and sprung:
            return 300.0
        motion = [thrusts[k] * (shaft - given.get(k, 0.0)), 0.0, 0.0, 0.0, 0.0]
        return float(BEARING.equilibrium(displacement=motion).load[0])

    shaft = brentq(
        lambda x: sum(thrust * carried(k, x) for k, thrust in enumerate(thrusts)),
        -30e-6,
        30e-6,
        xtol=1e-16,
    )
    known = [carried(1, shaft), carried(2, shaft)]
    assert mounted_preloads(machine) == pytest.approx(known, rel=1e-6)
    found = dynamic_preload(machine, np.zeros(1), Law())
    assert found.seat_load()[0, 1:3] == pytest.approx(known, rel=1e-6)
    heavy = replace(sleeves[1], spring=Spring(9e6, 5e6))
    with pytest.raises(InvalidInput, match=r"overloads? (the|its) bearings"):
        mounted_preloads(replace(machine, sleeves=(sleeves[0], heavy)))
    back = ring_offset(machine, sleeves[0], known[0])
    if sum(-thrusts[k] * known[k - 1] for k in (1, 2)):  # else the housing does not determine it
        assert back == pytest.approx(10e-6, rel=1e-6)


def test_an_offset_that_leaves_play_and_a_set_that_nothing_faces() -> None:
    loose = spindle("DB", SetPreload(offset=1e-6), growth=RingGrowth(static=-20e-6))
    plain = spindle("DB", SetPreload(offset=1e-6))
    given, taken = (ring_offset(each, each.sleeves[0], 1e-6) for each in (plain, loose))
    left = 1.0 - (taken - given) * 1e6
    play = rf"offset of 1 µm leaves clearance in its bearings as mounted \({left:.3g} µm with"
    with pytest.raises(InvalidInput, match=play):
        mounted_preloads(loose)[0]
    small = AngularContactBallBearing(3e-3, 30e-3, 5, contact_angle=math.radians(15.0))
    pressed = spindle("DB", SetPreload(offset=0.9e-3), small)
    beyond = "offset of 900 µm overloads its bearings .900 µm with"
    with pytest.raises(InvalidInput, match=beyond):
        mounted_preloads(pressed)[0]
    machine = spindle("DT", None)
    sleeve = Sleeve("s", ("a", "b"), Spring(0.0, math.inf, offset=1e-5))
    with pytest.raises(InvalidInput, match="needs bearings that oppose them"):
        mounted_preloads(replace(machine, sleeves=(sleeve,)))


def test_a_preload_beyond_the_bearing_is_named() -> None:
    """The pressure exceeds that of any elastic contact: bearing, speed and remedy."""
    found = state(spindle("DB", SetPreload(force=5e6))).preload
    assert "overloaded" in found.outcome[0]
    assert "lower its preload" in found.outcome[0]
