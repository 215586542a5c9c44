"""Machines that are possible and rarely meant: each is questioned, in one sentence."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from bearings.materials import Material
from rotordyn.case.model import model
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.bearing_set import OPPOSITE, patterns
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.flexible_rings import RingBodies
from rotordyn.machine.growth import InterferenceFit, RingGrowth
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.plausibility import LOOSE, implausible, undamped, unopposed
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles import spindles
from tests.oracles.spindles import RPM, mfw2310

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
TOP = 20000.0 * RPM


def _said(spindle: Spindle, top: float = TOP) -> str:
    return "\n".join(implausible(spindle, top))


def _disc(bore: float) -> Spindle:
    machine = mfw2310()
    x = machine.seats[0].x + 0.05
    outer = machine.shaft.diameters_at(x)[0]
    disc = Disc("rim", x, 3.0 * outer, bore * outer, 0.02, STEEL)
    return replace(machine, discs=(disc,))


def test_the_flagship_has_nothing_to_question() -> None:
    """Every sentence below is the fault of the change made there."""
    assert not _said(mfw2310())
    assert not _said(_disc(bore=1.0))


def test_a_section_of_metres() -> None:
    machine = mfw2310()
    long = Section(25.0, 0.05, 0.0, STEEL, "rear end")
    shaft = replace(machine.shaft, sections=(*machine.shaft.sections, long))
    said = _said(replace(machine, shaft=shaft))
    assert "(rear end) of the shaft is 25 m long, 500 times its diameter" in said
    assert f"section from {machine.shaft.end * 1e3:.4g} mm on (rear end)" in said
    assert "check the units" in said


def test_stiffness_given_in_newton_per_micrometre() -> None:
    machine = mfw2310()
    front, rear = machine.sleeves
    soft = replace(front, spring=replace(front.spring, stiffness=6.2))
    said = _said(replace(machine, sleeves=(soft, rear)))
    assert "spring of sleeve front: a stiffness of 6.2 N/m" in said
    assert "did you mean 6.2 N/um?" in said


@pytest.mark.parametrize(("speed", "meant"), [(24000.0, True), (17000.0, True), (15000.0, False)])
def test_a_speed_in_radians_without_rolling_bearings(speed: float, meant: bool) -> None:
    """A shaft of 50 mm has 400 m/s at its surface at 16 000 rad/s, a disc on it more."""
    shaft = Shaft(0.0, (Section(0.5, 0.05, 0.0, STEEL),))
    rotor = Spindle("rotor", shaft)
    said = _said(rotor, speed)
    assert (f"surface speed of {0.025 * speed:.0f} m/s" in said) == meant
    assert (f"(did you mean {speed:g} rpm?)" in said) == meant
    wheel = replace(rotor, discs=(Disc("wheel", 0.25, 0.5, 0.05, 0.04, STEEL),))
    assert f"500 mm, has a surface speed of {0.25 * speed:.0f} m/s" in _said(wheel, speed)
    assert "surface speed" not in _said(wheel, 1500.0)


@pytest.mark.parametrize(
    ("x", "width", "said"),
    [
        (0.25, 0.04, ""),
        (0.5, 0.04, ""),
        (0.25, 0.6, "disc d, 600 mm wide at 250 mm, reaches 50 mm beyond an end of the shaft"),
        (0.49, 0.4, ""),
        (0.0, 0.04, ""),
    ],
)
def test_a_disc_wider_than_its_shaft(x: float, width: float, said: str) -> None:
    """An overhung disc on the end of a shaft reaches half its width beyond it."""
    shaft = Shaft(0.0, (Section(0.5, 0.05, 0.0, STEEL),))
    rotor = Spindle("rotor", shaft, discs=(Disc("d", x, 0.2, 0.05, width, STEEL),))
    assert said in _said(rotor)
    assert ("beyond an end" in _said(rotor)) == bool(said)


def test_a_section_of_micrometres() -> None:
    machine = mfw2310()
    for length, words in ((1e-6, "1 µm long, less than any shoulder"), (5e-5, "")):
        thin = Section(length, 0.05, 0.0, STEEL, "rear end")
        shaft = replace(machine.shaft, sections=(*machine.shaft.sections, thin))
        said = _said(replace(machine, shaft=shaft))
        assert words in said
        assert ("shoulder" in said) == bool(words)


def test_a_preload_in_newton_instead_of_kilonewton() -> None:
    machine = mfw2310()
    front, rear = machine.sleeves
    for force, words in ((1.2, "a preload of 1.2 N is far below the light class"), (60.0, "")):
        weak = replace(front, spring=replace(front.spring, preload=force))
        said = _said(replace(machine, sleeves=(weak, rear)))
        assert words in said
        assert ("(did you mean 1.2 kN?)" in said) == bool(words)


def test_the_light_class_is_that_of_makers() -> None:
    """Of the bearings whose catalogue prints preload classes."""
    for name in ("kh6014e", "s6012e", "vex70"):
        bearing = model("bearings", name)
        path = Path(rotordyn.__file__).parents[1] / f"models/bearings/{name}.yaml"
        printed = float(path.read_text(encoding="utf-8").partition("preloads: [")[2].split()[0])
        per_area = printed / (bearing.balls * bearing.ball_diameter**2)
        assert 15.0 * LOOSE < per_area < 30.0 * LOOSE


def test_damping_ratios_of_shafts_are_small() -> None:
    machine = mfw2310()
    assert "damping ratio of 50 % is far above" in _said(replace(machine, rotor_damping=(0.5,)))
    assert "damping ratio" not in _said(replace(machine, rotor_damping=(0.05, 0.1)))


@pytest.mark.parametrize(("interference", "said"), [(20e-6, False), (100e-6, True)])
def test_a_fit_given_in_tens_of_micrometres(interference: float, said: bool) -> None:
    machine = mfw2310()
    fit = InterferenceFit(0.05, interference)
    growth = RingGrowth(centrifugal="computed", fit=fit)
    seats = tuple(replace(seat, growth=growth) for seat in machine.seats[:2])
    found = _said(replace(machine, seats=(*seats, *machine.seats[2:])))
    names = ", ".join(seat.name for seat in seats)
    sentence = f"bearings {names}: growth.fit.interference of 100 µm on the radius of a bore of 50"
    assert (sentence in found) == said


@pytest.mark.parametrize(("force", "said"), [(30e3, False), (2e6, True)])
def test_a_drawbar_that_would_crush_its_shaft(force: float, said: bool) -> None:
    sections = Section(0.1, 0.06, 0.03, STEEL), Section(0.1, 0.04, 0.03, STEEL)
    spindle = Spindle("s", Shaft(0.0, sections), drawbar=Drawbar(force, 0.05, 0.18))
    stress = force / (np.pi / 4 * (0.04**2 - 0.03**2))
    sentence = f"presses the section at 140 mm, of 549.8 mm², by {stress * 1e-6:.0f} MPa"
    assert (sentence in _said(spindle)) == said


def test_discs_that_float_or_count_mass_twice() -> None:
    assert "does not touch the shaft" in _said(_disc(bore=2.0))
    assert "mass is counted twice" in _said(_disc(bore=0.0))


@pytest.mark.parametrize(("outer", "said"), [(5.0, True), (7.0, True), (7.2, False)])
def test_a_wide_disc_without_a_bore_counts_the_shaft_twice(outer: float, said: bool) -> None:
    """From a fiftieth of its mass on: the square of the shaft's diameter over its own."""
    machine = _disc(bore=0.0)
    (rim,) = machine.discs
    below = machine.shaft.diameters_at(rim.x)[0]
    wide = replace(machine, discs=(replace(rim, outer_diameter=outer * below),))
    assert ("disc rim and the shaft fill the same space" in _said(wide)) == said


def test_a_disc_floats_from_a_quarter_of_play_on_as_a_bearing_does() -> None:
    """Unless another disc fills the gap, or the shaft is thicker somewhere below it."""
    loose = _disc(bore=1.36)
    assert "disc rim does not touch the shaft" in _said(loose)
    assert not _said(_disc(bore=1.2))
    (rim,) = loose.discs
    bush = Disc("bush", rim.x, rim.inner_diameter, rim.inner_diameter / 1.36, 0.02, STEEL)
    assert not _said(replace(loose, discs=(rim, bush)))
    beside = replace(bush, x=rim.x + 0.03)
    assert "disc rim does not touch" in _said(replace(loose, discs=(rim, beside)))


def test_a_disc_over_a_step_sits_on_its_thicker_side() -> None:
    sections = (Section(0.2, 0.066, 0.0, STEEL), Section(0.2, 0.09, 0.0, STEEL))
    stepped = Spindle("stepped", Shaft(0.0, sections))
    on = Disc("hub", 0.195, 0.2, 0.09, 0.02, STEEL)
    assert "hub" not in _said(replace(stepped, discs=(on,)))
    off = replace(on, x=0.189)
    assert "disc hub does not touch" in _said(replace(stepped, discs=(off,)))


@pytest.mark.parametrize(("apart", "said"), [(0.0, True), (0.017, True), (0.019, False)])
def test_two_discs_in_the_same_space(apart: float, said: bool) -> None:
    """From a tenth of the smaller one on: 2 mm of 20 mm."""
    machine = _disc(bore=1.0)
    (rim,) = machine.discs
    other = replace(rim, name="fan", x=rim.x + apart)
    words = _said(replace(machine, discs=(rim, other)))
    assert ("discs rim and fan fill the same space" in words) == said
    around = replace(rim, name="fan", inner_diameter=rim.outer_diameter, outer_diameter=0.3)
    assert not _said(replace(machine, discs=(rim, around)))


def test_bearings_that_overlap() -> None:
    machine = mfw2310()
    first, second, *others = machine.seats
    near = replace(second, x=first.x + 0.5 * first.bearing.ball_diameter)
    assert "overlap" in _said(replace(machine, seats=(first, near, *others)))


def test_bearings_overlap_by_the_width_of_their_rings_where_it_is_known() -> None:
    """Balls alone take half of it."""
    machine = mfw2310()
    first, second, *others = machine.seats
    width = 2.0 * first.bearing.ball_diameter
    sized = [replace(each, sizes={"width": width}) for each in (first, second)]
    for distance, words in ((0.9, f"their rings need {width * 1e3:.4g} mm"), (1.0, "")):
        near = replace(sized[1], x=first.x + distance * width)
        said = _said(replace(machine, seats=(sized[0], near, *others)))
        assert words in said
        assert bool(words) == ("overlap" in said)


def test_face_to_face_is_named_only_where_no_pair_is_back_to_back() -> None:
    machine = mfw2310()
    assert any(word == "O" for *_, word in machine.pairings)
    turned = tuple(replace(seat, thrust=-seat.thrust) for seat in machine.seats)
    faced = replace(machine, seats=turned)
    said = _said(faced)
    assert "face to face (X)" in said
    assert "spindles: reverse the thrust of all bearings (a, b, c, d, e)" in said
    assert "face to face" not in _said(replace(faced, seats=machine.seats))
    grinding = rotordyn.load("grinding_spindle").spindle  # c and d on one sleeve
    assert grinding is not None
    faced = tuple(replace(seat, thrust=-seat.thrust) for seat in grinding.seats)
    assert "bearings b and c are mounted face to face" in _said(replace(grinding, seats=faced))
    both = tuple(replace(s, thrust=-s.thrust) if s.name in ("b", "c") else s for s in faced)
    with pytest.raises(InvalidInput, match="one sleeve must all have the same thrust"):
        replace(grinding, seats=both)


@pytest.mark.parametrize("thrusts", [None, (-1, 1)])
def test_a_set_face_to_face_becomes_back_to_back_by_its_name(
    thrusts: tuple[int, int] | None,
) -> None:
    machine = rotordyn.load("preload_concepts").variants["face_to_face"].spindle
    assert machine is not None
    assert machine.arrangement is not None
    if thrusts is not None:
        seats = zip(machine.seats, thrusts, strict=True)
        turned = tuple(replace(seat, thrust=sign, by_set=False) for seat, sign in seats)
        machine = replace(machine, seats=turned)
    remedy = "name the set DB"
    if thrusts is not None:
        remedy = f"reverse the thrust of all bearings (front, rear) and {remedy}"
    assert f"usual in spindles: {remedy}" in _said(machine)
    seats = tuple(replace(seat, thrust=-seat.thrust) for seat in machine.seats)
    named = replace(machine.arrangement, set="DB")
    assert "face to face" not in _said(replace(machine, seats=seats, arrangement=named))


def test_opposite_sets_have_every_thrust_reversed() -> None:
    swapped = str.maketrans("+-", "-+")
    for one, other in OPPOSITE.items():
        assert {signs.translate(swapped) for signs in patterns(one)} == {*patterns(other)}


def test_speed_beyond_any_lubrication() -> None:
    pitch = mfw2310().seats[0].bearing.pitch_diameter * 1e3
    limit = 3.0e6 / pitch * RPM
    assert "beyond 3 million" in _said(mfw2310(), 1.01 * limit)
    assert "beyond 3 million" not in _said(mfw2310(), 0.99 * limit)


def test_growth_not_given_at_speed_is_said_with_its_size() -> None:
    """ρ Ω² r³ / E, the growth of a thin ring that turns."""
    machine = mfw2310()
    bare = tuple(replace(seat, growth=RingGrowth()) for seat in machine.seats)
    machine = replace(machine, seats=bare)
    ring = max(seat.bearing.inner_raceway_radius for seat in bare)
    pitch = max(seat.bearing.pitch_diameter for seat in bare) * 1e3
    top = 1.5e6 / pitch * RPM
    material = bare[0].bearing.ring_material
    growth = material.density * top**2 * ring**3 / material.young_modulus
    assert f"grows by up to {growth * 1e6:.2g} µm" in _said(machine, top)
    assert "growth" not in _said(machine, 0.5e6 / pitch * RPM)


def test_thrust_that_nothing_opposes_is_named_instead_of_the_preload() -> None:
    machine = mfw2310()
    alike = tuple(replace(seat, thrust=1) for seat in machine.seats)
    machine = replace(machine, seats=alike)
    assert "towards +x only" in unopposed(machine)
    with pytest.raises(NoSolution, match=r"all bearings carry thrust towards \+x only"):
        Scene(machine, Conditions(), np.array([0.0, TOP])).require_solution()
    assert not unopposed(mfw2310())


def test_a_machine_without_any_damping() -> None:
    machine = spindles.undamped(mfw2310())
    assert undamped(machine)
    assert not undamped(replace(machine, rotor_damping=(0.01,)))
    seat = replace(machine.seats[0], radial_damping=100.0)
    assert not undamped(replace(machine, seats=(seat, *machine.seats[1:])))


@pytest.mark.parametrize(("share", "said"), [(0.5, True), (0.9, False), (1.1, False), (2.0, True)])
def test_a_bearing_on_a_shaft_of_another_diameter(share: float, said: bool) -> None:
    machine = mfw2310()
    first = machine.seats[0]
    bore = machine.shaft.diameters_at(first.x)[0] / share
    seats = (replace(first, sizes={"bore_diameter": bore}), *machine.seats[1:])
    words = _said(replace(machine, seats=seats))
    assert (f"bearing {first.name}: the bore is {bore * 1e3:.4g} mm" in words) == said


@pytest.mark.parametrize(("rpm", "said"), [(0.0, False), (12.0, True), (1500.0, False)])
def test_a_highest_speed_a_thousand_times_too_low(rpm: float, said: bool) -> None:
    words = " ".join(implausible(mfw2310(), rpm * RPM))
    assert ("the highest speed is 12 rpm" in words) == said


@pytest.mark.parametrize(("polar", "said"), [(9e-8, True), (0.09, False), (0.0, False)])
def test_a_mass_with_the_inertia_of_a_smaller_one(polar: float, said: bool) -> None:
    machine = mfw2310()
    pulley = PointMass("pulley", machine.seats[0].x, 14.0, polar, 0.045)
    words = _said(replace(machine, masses=(pulley,)))
    assert ("mass pulley: its polar inertia of 9e-08 kg m^2 is far below" in words) == said


@pytest.mark.parametrize(("inertia", "said"), [(0.02, False), (1.0, False), (7.0, True)])
def test_a_mass_with_the_inertia_of_one_metres_away(inertia: float, said: bool) -> None:
    machine = mfw2310()
    pulley = PointMass("pulley", machine.seats[0].x, 1.1, inertia, inertia)
    words = _said(replace(machine, masses=(pulley,)))
    assert ("diametral inertia of 7 kg m^2 is that of 1.1 kg at 2.52 m from" in words) == said
    assert said or "pulley" not in words


def test_inertia_alone_is_meant() -> None:
    machine = mfw2310()
    inertia = PointMass("inertia", machine.seats[0].x, 0.0, 0.01, 0.01)
    assert "mass inertia" not in _said(replace(machine, masses=(inertia,)))


def _elastic(
    housing: float, width: float = 0.018, apart: bool = False, neighbours: str = "apart"
) -> str:
    """What is said of the rear pair of the flagship in a sleeve with an outer diameter."""
    machine = mfw2310()
    rings = RingBodies(
        "outer",
        outside_diameter=0.095,
        width=width,
        housing_diameter=housing,
        neighbours=neighbours,
    )
    seats = [
        replace(seat, flexible_rings=rings) if seat.name in "de" else seat for seat in machine.seats
    ]
    sleeves = [replace(sleeve, bearings=("d",)) for sleeve in machine.sleeves[1:] if apart]
    sleeves = sleeves or [*machine.sleeves[1:]]
    return _said(replace(machine, seats=tuple(seats), sleeves=(machine.sleeves[0], *sleeves)))


def test_rings_that_deform_one_thin_wall_together_are_named() -> None:
    """Both in one sleeve, less than half a width between them, a wall below a tenth of them."""
    assert "bearings d and e (3 mm of housing or sleeve) share one thin wall" in _elastic(0.101)
    assert "one thin wall" not in _elastic(0.120)
    assert "one thin wall" not in _elastic(0.101, width=0.012)
    assert "one thin wall" not in _elastic(0.101, apart=True)
    assert "one thin wall" not in _elastic(0.101, neighbours="alike")
