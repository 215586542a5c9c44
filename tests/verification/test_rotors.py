"""Several rotors on one axis: closed forms, limits, symmetry, and dense matrices of all of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eig

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.unbalance import solve as unbalance
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.rotor import RayleighDamping, Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import BalanceGrade, EccentricSpan, Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL, INNER, OUTER, Together, bearing
from tests.oracles.idealised import idealised
from tests.oracles.rotors import STEEL
from tests.oracles.spindles import RPM, all_poles, case, mfw2310, system_of

LIGHT = idealised("light and stiff", 2.1e14, 0.3, 1.0)


def scene(machine: Spindle, rpm: tuple[float, ...], highest: float, **given: object) -> Scene:
    asked = {"accuracy": 1e-7} | given
    ports = tuple(machine.places.values())
    return Scene(machine, Conditions(**asked), np.array(rpm) * RPM, highest, ports)  # type: ignore[arg-type]


def swinging(found: Scene, row: int = 0) -> np.ndarray:
    """Poles of bending of one sign, by frequency, as in both planes."""
    pole = system_of(found).modes.pole[row]
    if system_of(found).whirling:
        pole = np.where(pole.imag < 0.0, pole.conj(), pole)
    pole = pole[(pole.imag > 1.0) & (-pole.real < 0.99 * np.abs(pole))]
    return pole[np.argsort(pole.imag)]


def every_way(name: str, x: float, k: float, *ends: str) -> LinearSupport:
    """Nearly rigid across the axis and in tilt."""
    held = dict(zip(("holds", "against"), ends, strict=False))
    entries = {("y", "y"): k, ("z", "z"): k, ("thy", "thy"): 0.01 * k, ("thz", "thz"): 0.01 * k}
    return LinearSupport(name, x, entries, **held)


# --- limits ------------------------------------------------------------------------------------


def one_shaft() -> Spindle:
    sections = (Section(0.3, 0.04, 0.0, STEEL), Section(0.3, 0.06, 0.02, STEEL))
    return Spindle(
        "one",
        Shaft(0.0, sections),
        masses=(PointMass("a", 0.2, 3.0, 0.03, 0.016), PointMass("b", 0.5, 4.0, 0.05, 0.026)),
        supports=(bearing("front", 0.05, 4e7, 4e7), bearing("rear", 0.55, 3e7, 3e7)),
    )


def in_two(k: float) -> Spindle:
    """The same cut at 0.3 m and held together again."""
    whole = one_shaft()
    tail = Rotor("tail", 1.0, Shaft(0.3, whole.shaft.sections[1:]), masses=whole.masses[1:])
    return replace(
        whole,
        shaft=Shaft(0.0, whole.shaft.sections[:1]),
        masses=whole.masses[:1],
        rotors=(tail,),
        supports=(
            whole.supports[0],
            replace(whole.supports[1], holds="tail"),
            every_way("flange", 0.3, k, "tail", "spindle"),
        ),
    )


def test_rotors_joined_ever_more_stiffly_become_one() -> None:
    """The error falls with the stiffness of what joins them, tenfold each time."""
    exact = swinging(scene(one_shaft(), (20000.0,), 1500.0))[:6]
    errors = []
    for k in (1e10, 1e11, 1e12):
        found = swinging(scene(in_two(k), (20000.0,), 1500.0))[:6]
        errors.append(np.abs(found / exact - 1.0).max())
    assert errors[0] < 0.02
    assert np.array(errors[:-1]) / errors[1:] == pytest.approx(10.0, rel=0.1)


def test_a_still_and_ever_heavier_sleeve_becomes_ground() -> None:
    """Held softly to ground; the error falls with its mass."""
    grounded = one_shaft()
    exact = swinging(scene(grounded, (20000.0,), 1000.0))[:4]
    errors = []
    for mass in (1e3, 1e4):
        body = PointMass("body", 0.3, mass, 0.0, 0.1 * mass)
        sleeve = Rotor("sleeve", 0.0, Shaft(0.0, (Section(0.6, 0.2, 0.1, LIGHT),)), masses=(body,))
        held = tuple(replace(s, against="sleeve") for s in grounded.supports)
        soft = (every_way("soft", 0.3, 1e4, "sleeve"),)
        found = scene(replace(grounded, rotors=(sleeve,), supports=held + soft), (20000.0,), 1000.0)
        pole = swinging(found)
        near = np.abs(pole[:, None] / exact - 1.0).min(axis=0)
        errors.append(near.max())
    assert errors[0] < 0.02
    assert errors[0] / errors[1] == pytest.approx(10.0, rel=0.1)


@pytest.mark.parametrize(("ratio", "polar"), [(0.0, 0.0), (1.0, 0.03)])
def test_the_speed_ratio_is_that_of_the_gyroscopic_effect(ratio: float, polar: float) -> None:
    """A disc on a sleeve that stands still has none of it; at ratio 1 it is one on the shaft."""
    bare = replace(one_shaft(), masses=())
    body = PointMass("body", 0.2, 3.0, 0.03, 0.016)
    tube = Shaft(0.19, (Section(0.02, 0.2, 0.19, LIGHT),))
    sleeve = Rotor("sleeve", ratio, tube, masses=(body,))
    supports = (*bare.supports, every_way("fit", 0.2, 1e13, "sleeve", "spindle"))
    found = swinging(scene(replace(bare, rotors=(sleeve,), supports=supports), (30000.0,), 800.0))
    own = rotor_inertia(Spindle("tube", tube))
    on_shaft = PointMass("body", 0.2, 3.0 + own.mass, polar, 0.016 + own.diametral)
    alone = swinging(scene(replace(bare, masses=(on_shaft,)), (30000.0,), 800.0))
    assert found[:4] == pytest.approx(alone[:4], rel=3e-6)


def ring_on(spindle: Spindle, **ends: str) -> Spindle:
    """A balancing ring on a spindle, held in every way."""
    x = 0.2
    tube = Shaft(x - 0.01, (Section(0.02, 0.2, 0.19, STEEL),))
    body = PointMass("body", x, 2.0, 0.02, 0.011)
    ways = ("x", "y", "z", "thx", "thy", "thz")
    every = {(way, way): 1e12 if len(way) == 1 else 1e10 for way in ways}
    fit = LinearSupport("fit", x, every, holds="ring", against="spindle")
    more = [replace(fit, name="foot", stiffness={("x", "x"): 1e6}, against="ground")]
    return replace(
        spindle,
        rotors=(Rotor("ring", 1.0, tube, masses=(body,)),),
        supports=(*spindle.supports, fit, *(more if ends else ())),
    )


def test_a_ring_on_a_spindle_with_bearings_is_a_mass_on_its_shaft() -> None:
    """All motions, bearings in their preload state of the speed; their loads do not know of it."""
    bare = mfw2310(rotor_damping=())  # modal, it would be of other modes
    own = rotor_inertia(Spindle("tube", ring_on(bare).rotors[0].shaft))
    mass = PointMass("ring", 0.2, 2.0 + own.mass, 0.02 + own.polar, 0.011 + own.diametral)
    found, expected = (
        Scene(machine, Conditions(accuracy=1e-7), np.array([24000.0]) * RPM, 3000.0)
        for machine in (ring_on(bare), replace(bare, masses=(*bare.masses, mass)))
    )
    assert found.preload.net.response.load == pytest.approx(expected.preload.net.response.load)
    for motion in ("bending", "axial", "torsion"):
        ours, theirs = (system_of(s, motion).pole[0] for s in (found, expected))
        theirs = theirs[(theirs.imag > 1.0) & (theirs.imag < 2.0 * math.pi * 3000.0)]
        assert len(theirs)
        assert np.abs(ours[:, None] / theirs - 1.0).min(axis=0).max() < 1e-4


def test_no_other_rotor_ties_a_spindle_with_bearings_to_ground_along_its_axis() -> None:
    base = case("mfw2310")
    assert replace(base, spindle=ring_on(mfw2310()), analyses={"campbell": CampbellSpec()})
    with pytest.raises(
        InvalidInput, match="'fit', 'foot' connect the shaft along the axis to ground"
    ):
        replace(base, spindle=ring_on(mfw2310(), foot=""), analyses={"campbell": CampbellSpec()})


def test_what_holds_another_rotor_rigidly_along_does_not_hold_the_shaft() -> None:
    """Beside bearings, at the very station of a support of the shaft that holds the same DOF."""
    bare, along = mfw2310(), LinearSupport("own", 0.2, rigid=("x", "thx"), holds="ring")
    on_ring = every_way("around", 0.2, 1e8, "ring", "ground")
    ring = replace(ring_on(bare), supports=(*bare.supports, along, on_ring))
    twist = LinearSupport("twist", 0.2, rigid=("thx",))
    found, expected = (
        Scene(machine, Conditions(axial_force=0.0), np.array([24000.0]) * RPM, 3000.0)
        for machine in (replace(ring, supports=(*ring.supports, twist)), bare)
    )
    assert found.preload.net.response.load == pytest.approx(expected.preload.net.response.load)
    ours, theirs = (system_of(each, "axial").pole[0] for each in (found, expected))
    theirs = theirs[np.abs(theirs) < 2.0 * math.pi * 3000.0]
    assert len(theirs)
    assert np.abs(ours[:, None] / theirs - 1.0).min(axis=0).max() < 1e-6
    tied = replace(along, name="tie", against="spindle")
    replace(ring, supports=(on_ring, tied))
    machine = replace(ring, supports=(along, replace(tied, x=0.205), on_ring))
    with pytest.raises(
        InvalidInput, match="'own', 'tie' connect the shaft along the axis to ground"
    ):
        replace(case("mfw2310"), spindle=machine, analyses={"campbell": CampbellSpec()})


# --- closed form of two rigid rotors -------------------------------------------------------------

SPRINGS = (("a", 0.05, 2e7), ("b", 0.45, 1e7))  # inner rotor to ground
OUTWARD = ("c", 0.40, 1.5e7)  # outer rotor to ground
BETWEEN = ("d", 0.15, 0.8e7)


def rigid_pair(ratio: float) -> Spindle:
    """Two uniform tubes, one within the other."""
    outer = Rotor("outer", ratio, Shaft(0.1, (Section(0.35, 0.2, 0.1, STEEL),)), points={"e": 0.4})
    supports = [bearing(name, x, k, k) for name, x, k in SPRINGS]
    supports.append(bearing(*OUTWARD[:2], OUTWARD[2], OUTWARD[2], "outer"))
    supports.append(bearing(*BETWEEN[:2], BETWEEN[2], BETWEEN[2], "spindle", "outer"))
    inner = Shaft(0.0, (Section(0.5, 0.08, 0.0, STEEL),))
    return Spindle("pair", inner, supports=tuple(supports), rotors=(outer,), points={"t": 0.05})


def four_freedoms(ratio: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """M, K and P of M q̈ − iΩ P q̇ + K q = 0: y + i z and tilt about the centre of each."""
    bodies = []
    for length, outer, inner in ((0.5, 0.08, 0.0), (0.35, 0.2, 0.1)):
        mass = 7800.0 * math.pi / 4.0 * (outer**2 - inner**2) * length
        squares = (outer**2 + inner**2) / 4.0
        bodies.append((mass, mass * (squares / 4.0 + length**2 / 12.0), mass * squares / 2.0))
    mass = np.diag([v for m, d, _ in bodies for v in (m, d)])
    polar = np.diag([0.0, bodies[0][2], 0.0, ratio * bodies[1][2]])
    stiffness = np.zeros((4, 4))
    at = (
        (lambda x: np.array([1.0, x - 0.25, 0.0, 0.0])),
        (lambda x: np.array([0.0, 0.0, 1.0, x - 0.275])),
    )
    rows = [(k, at[0](x)) for _, x, k in SPRINGS]
    rows += [(OUTWARD[2], at[1](OUTWARD[1]))]
    rows += [(BETWEEN[2], at[0](BETWEEN[1]) - at[1](BETWEEN[1]))]
    for k, row in rows:
        stiffness += k * np.outer(row, row)
    return mass, stiffness, polar


@pytest.mark.parametrize("ratio", [1.7, 0.0, -1.3])
def test_two_rigid_rotors_and_a_spring_between_them(ratio: float) -> None:
    mass, stiffness, polar = four_freedoms(ratio)
    found = scene(rigid_pair(ratio), (0.0, 12000.0, 40000.0), 900.0, rotor="rigid")
    assert system_of(found).whirling
    for row, speed in enumerate(found.speed):
        one, none = np.eye(4), np.zeros((4, 4))
        inverse = np.linalg.inv(mass)
        whole = np.block([[none, one], [-inverse @ stiffness, 1j * speed * inverse @ polar]])
        expected = np.sort(np.linalg.eigvals(whole).imag)
        pole = system_of(found).modes.pole[row]
        assert np.sort(pole.imag) == pytest.approx(expected, rel=1e-9)
        assert np.abs(pole.real).max() < 1e-6


@pytest.mark.parametrize("ratio", [1.7, -1.3])
def test_critical_speeds_of_each_rotor_by_closed_form(ratio: float) -> None:
    """K φ = ω² (M − P/r) φ at ω = r Ω, forward, and with the other sign backward."""
    mass, stiffness, polar = four_freedoms(ratio)
    top = 12000.0 * RPM
    found = campbell.solve(
        scene(rigid_pair(ratio), (0.0, 12000.0), 900.0, rotor="rigid"),
        CampbellSpec(900.0, engine_orders=(0.43, 1, 1.5, 2)),
    )
    bending = np.array(found.critical_kind) == "bending"
    for name, own in (("spindle", 1.0), ("outer", ratio)):
        for order in (0.43, 1, 1.5, 2):
            multiple = order * abs(own)
            expected = []
            for side, whirl in ((1.0, "forward"), (-1.0, "backward")):
                squares = eig(stiffness, mass - side * polar / multiple)[0].real
                at = np.sqrt(squares[squares > 0.0]) / multiple
                expected += [(speed, whirl) for speed in at if speed < top]
            chosen = bending & (np.array(found.critical_rotor) == name)
            chosen &= found.critical_order == order
            ours = [
                (found.critical_speed[k], found.critical_whirl[k]) for k in np.flatnonzero(chosen)
            ]
            assert len(ours) == len(expected) > 1
            for (speed, whirl), (wanted, way) in zip(sorted(ours), sorted(expected), strict=True):
                assert speed == pytest.approx(wanted, rel=1e-9)
                assert whirl == way
            excited = found.critical_excited[chosen].tolist()
            way = "forward" if own > 0.0 else "backward"
            assert excited == [
                order != 1 or found.critical_whirl[k] == way for k in np.flatnonzero(chosen)
            ]


def test_axial_motion_and_torsion_of_two_rigid_rotors() -> None:
    """Two masses and a spring between them, one of which is free: k (1/m + 1/M)."""
    machine = rigid_pair(1.7)
    k, twist = 3e7, 5e4
    tie = LinearSupport(
        "tie", 0.3, {("x", "x"): k, ("thx", "thx"): twist}, holds="outer", against="spindle"
    )
    found = scene(replace(machine, supports=(*machine.supports, tie)), (0.0,), 900.0, rotor="rigid")
    bodies = [rotor_inertia(found.spindle.part(name)) for name in ("spindle", "outer")]
    for motion, stiff, inertia in (
        ("axial", k, [body.mass for body in bodies]),
        ("torsion", twist, [body.polar for body in bodies]),
    ):
        free = system_of(found, motion)
        expected = math.sqrt(stiff * sum(1.0 / each for each in inertia))
        assert np.nanmax(free.pole[0].imag) == pytest.approx(expected, rel=1e-9)
        assert free.free_count[0] == 2


# --- symmetry ------------------------------------------------------------------------------------


TURNING_DAMPERS = {
    "rotor_damping": (0.02, 0.03),
    "internal_damping": 0.7,
    "rayleigh": RayleighDamping(3.0, 1e-5),
    "joints": (Joint("flange", 0.3, tilt=2e6, tilt_damping=300.0),),
}


def swapped(machine: Spindle) -> Spindle:
    """The further rotor as the spindle, and the other way round."""
    (outer,) = machine.rotors
    kept = ("shaft", "masses", "points", *TURNING_DAMPERS)
    inner = Rotor("outer", 1.0 / outer.speed_ratio, **{n: getattr(machine, n) for n in kept})
    ends = {"spindle": "outer", "outer": "spindle", "ground": "ground"}
    supports = tuple(
        replace(s, holds=ends[s.holds], against=ends[s.against]) for s in machine.supports
    )
    own = {name: getattr(outer, name) for name in kept}
    return Spindle("swapped", supports=supports, rotors=(inner,), **own)


@pytest.mark.parametrize("damped", [(), ("outer",), ("spindle", "outer")])
@pytest.mark.parametrize("ratio", [1.5, -0.8])
def test_neither_rotor_is_the_first(ratio: float, damped: tuple[str, ...]) -> None:
    """Also where dampers turn with one of them, or each with its own."""
    outer = replace(OUTER, speed_ratio=ratio, **(TURNING_DAMPERS if "outer" in damped else {}))
    machine = replace(COAXIAL, rotors=(outer,), **(TURNING_DAMPERS if "spindle" in damped else {}))
    ours = swinging(scene(machine, (9000.0,), 900.0))
    theirs = swinging(scene(swapped(machine), (9000.0 * abs(ratio),), 900.0))
    # no spindle turns backwards: with all speeds reversed, whirl is the other way, as fast
    count = int((ours.imag < 2.0 * math.pi * 900.0).sum())
    assert count > 8
    assert ours[:count] == pytest.approx(theirs[:count], rel=1e-7)
    assert (np.abs(ours[:count].real) > 0.1).any() == bool(damped)


def test_the_number_of_modes_is_the_same_whichever_rotor_is_the_first() -> None:
    """With dampers in joints."""
    joint = TURNING_DAMPERS["joints"]
    machine = replace(COAXIAL, rotors=(replace(OUTER, joints=joint),))
    spec = CampbellSpec(400.0, shapes=False, engine_orders=())
    ours = campbell.solve(scene(machine, (9000.0,), 400.0), spec)
    theirs = campbell.solve(scene(swapped(machine), (13500.0,), 400.0), spec)
    counts = [(each.frequency[0] <= 400.0).sum() for each in (ours, theirs)]
    assert counts[0] == counts[1] > 5


# --- dense matrices ------------------------------------------------------------------------------

ELEMENT = 0.04
DAMPED = replace(
    COAXIAL,
    rotors=(
        replace(OUTER, speed_ratio=-1.2),
        Rotor(
            "quill",
            0.4,
            Shaft(0.3, (Section(0.3, 0.02, 0.0, STEEL),)),
            masses=(PointMass("head", 0.6, 0.8, 0.002, 0.0012),),
            points={"head": 0.6},
        ),
    ),
    supports=(
        *(replace(s, damping={("y", "y"): 900.0, ("z", "z"): 1500.0}) for s in COAXIAL.supports),
        LinearSupport(
            "splined",
            0.457,
            {
                ("y", "y"): 5e6,
                ("z", "z"): 7e6,
                ("y", "z"): 1e6,
                ("z", "y"): 1e6,
                ("thz", "thz"): 2e4,
                ("thy", "thy"): 1e4,
            }
            | {("x", "x"): 6e6, ("thx", "thx"): 3e4},
            {("y", "y"): 300.0, ("z", "z"): 300.0},
            holds="quill",
            against="spindle",
        ),
        bearing("nose", 0.356, 4e6, 4e6, "quill", "outer"),
        LinearSupport("thrust", 0.1, {("x", "x"): 8e6}, {("x", "x"): 100.0}),
    ),
)


@pytest.fixture(scope="module")
def damped() -> Scene:
    return scene(DAMPED, (0.0, 12000.0), 1200.0, element_length=ELEMENT, accuracy=1e-4)


@pytest.fixture(scope="module")
def at_speed() -> Scene:
    """At one speed alone, which has no critical ones to be sought."""
    return scene(DAMPED, (12000.0,), 1200.0, element_length=ELEMENT, accuracy=1e-4)


@pytest.mark.parametrize("row", [0, 1])
def test_three_rotors_by_dense_matrices(damped: Scene, row: int) -> None:
    expected = Together(DAMPED, ELEMENT, float(damped.speed[row])).poles(1200.0)
    near = np.abs(all_poles(damped, row)[:, None] / expected - 1.0).min(axis=0)
    assert len(expected) > 20
    assert near.max() < 1e-6


@pytest.mark.parametrize(
    ("response", "excitation"),
    [
        ("d4.y", "outer.d3.y"),
        ("quill.head.z", "d1.y"),
        ("quill.head.thz", "outer.d2.z"),
        ("quill.head.x", "d1.x"),
    ],
)
def test_responses_across_rotors_by_dense_matrices(
    damped: Scene, response: str, excitation: str
) -> None:
    ports = tuple(Port(*text.rsplit(".", 1)) for text in (response, excitation))
    frequency = (7.0, 61.0, 133.0, 304.0, 611.0)
    found = frf.solve(damped, FrfSpec(frequency, ((ports[0], ports[1]),)))
    assert found.error.max() < 1e-3
    for row, speed in enumerate(damped.speed):
        dense = Together(DAMPED, ELEMENT, float(speed))
        rows = []
        for port in ports:
            rotor, x = DAMPED.places[port.point]
            rows.append(dense.row[rotor, port.direction](x))
        expected = [dense.receptance(*rows, 2.0 * math.pi * f) for f in frequency]
        assert found.receptance[row, 0] == pytest.approx(expected, rel=1e-5)


def test_the_number_of_modes(damped: Scene) -> None:
    found = campbell.solve(damped, CampbellSpec(1000.0, shapes=False, engine_orders=()))
    for row, speed in enumerate(damped.speed):
        expected = Together(DAMPED, ELEMENT, float(speed)).poles(1000.0)
        assert (found.frequency[row] <= 1000.0).sum() == len(expected)


def test_the_error_of_coarse_elements_is_estimated() -> None:
    """Against nearly exact ones: at most twice as large as told, and not a tenth of it."""
    fine = swinging(scene(COAXIAL, (9000.0,), 900.0))
    coarse = scene(COAXIAL, (9000.0,), 900.0, element_length=0.25)
    found = campbell.solve(coarse, CampbellSpec(900.0, shapes=False))
    bending = np.array(found.kind) == "bending"
    frequency = np.sort(found.frequency[0, bending])[:8]
    told = found.frequency_error[0, bending][np.argsort(found.frequency[0, bending])][:8]
    error = np.abs(frequency * 2.0 * math.pi / fine.imag[:8] - 1.0)
    seen = error > 1e-6
    assert seen.sum() > 5
    assert (error[seen] < 2.0 * told[seen]).all()
    assert (error[seen] > 0.1 * told[seen]).all()


def test_a_pedestal_is_a_still_rotor_of_its_mass() -> None:
    """The same body under the outer rotor as a housing and as a rotor that does not turn."""
    stiffness = {("y", "y"): 3e7, ("z", "z"): 5e7}
    pedestal = RigidHousing("pedestal", ("b2",), 0.152, 20.0, stiffness)
    housed = scene(replace(COAXIAL, housings=(pedestal,)), (9000.0,), 600.0)
    ring = Rotor("ring", 0.0, Shaft(0.142, (Section(0.02, 0.2, 0.19, STEEL),)))
    rest = 20.0 - rotor_inertia(Spindle("ring", ring.shaft)).mass
    ring = replace(ring, masses=(PointMass("body", 0.152, rest, 0.0, 1.0),))
    own = LinearSupport("foot", 0.152, stiffness, holds="ring")
    b2 = replace(COAXIAL.supports[1], against="ring")
    supports = (COAXIAL.supports[0], b2, *COAXIAL.supports[2:], own)
    plain = scene(replace(COAXIAL, rotors=(OUTER, ring), supports=supports), (9000.0,), 600.0)
    ours = all_poles(housed)
    expected = swinging(plain)
    expected = expected[expected.imag < 2.0 * math.pi * 600.0]
    assert len(expected) > 10
    assert np.abs(ours[:, None] / expected - 1.0).min(axis=0).max() < 1e-6


# --- unbalance -----------------------------------------------------------------------------------

SIZE, ANGLE = 3e-4, 0.7


def out_of_balance(at: str, *points: str) -> UnbalanceSpec:
    return UnbalanceSpec(points, unbalances=(Unbalance(at, SIZE, ANGLE),))


@pytest.mark.parametrize("ratio", [1.7, -1.3])
def test_unbalance_of_the_outer_rotor_in_closed_form(ratio: float) -> None:
    """(K + ω Ω P − ω² M) q = U ω² e^(iα) at ω = r Ω; circular, the way the outer rotor turns."""
    mass, stiffness, polar = four_freedoms(ratio)
    machine = scene(rigid_pair(ratio), (0.0, 3000.0, 9000.0, 30000.0), 900.0, rotor="rigid")
    found = unbalance.solve(machine, out_of_balance("outer.e", "t", "outer.e"))
    assert (found.rotor, found.speed_ratio) == ("outer", ratio)
    at = {"t": np.array([1.0, 0.05 - 0.25, 0.0, 0.0]), "outer.e": np.array([0.0, 0.0, 1.0, 0.125])}
    assert not found.amplitude[0].any()
    for row, speed in list(enumerate(machine.speed))[1:]:
        omega = ratio * speed
        dynamic = stiffness + omega * speed * polar - omega**2 * mass
        q = np.linalg.solve(dynamic, SIZE * omega**2 * np.exp(1j * ANGLE) * at["outer.e"])
        for column, name in enumerate(("t", "outer.e")):
            r = at[name] @ q  # y + i z = r e^(iωt)
            for t in (0.0, 0.3 / speed):
                expected = r * np.exp(1j * omega * t)
                turn = np.exp(1j * abs(omega) * t)
                moved = (found.displacement[row, column] * turn).real
                assert moved == pytest.approx([expected.real, expected.imag], rel=1e-9)
            minor = found.minor_axis[row, column]
            assert minor == pytest.approx(np.sign(ratio) * abs(r), rel=1e-9)


@pytest.mark.parametrize("at", ["d1", "outer.d3", "quill.head"])
def test_unbalance_of_each_rotor_by_dense_matrices(at_speed: Scene, at: str) -> None:
    names = ("d4", "outer.d2", "quill.head")
    found = unbalance.solve(at_speed, out_of_balance(at, *names))
    ratio, speed = DAMPED.ratios[DAMPED.places[at].rotor], float(at_speed.speed[0])
    dense, omega = Together(DAMPED, ELEMENT, speed), abs(ratio) * speed
    size = SIZE * omega**2 * np.exp(1j * ANGLE * np.sign(ratio))
    load = {"y": size, "z": -1j * np.sign(ratio) * size}
    row = {
        (name, way): dense.row[DAMPED.places[name].rotor, way](DAMPED.places[name].x)
        for name in (at, *names)
        for way in "yz"
    }
    for column, name in enumerate(names):
        for axis, way in enumerate("yz"):
            expected = sum(
                dense.receptance(row[name, way], row[at, other], omega) * force
                for other, force in load.items()
            )
            assert found.displacement[0, column, axis] == pytest.approx(expected, rel=1e-5)
    assert found.error.max() < 1e-4


def test_the_force_of_an_intershaft_bearing_is_what_it_transmits(at_speed: Scene) -> None:
    found = unbalance.solve(at_speed, out_of_balance("outer.d3", "d1"))
    speed = float(at_speed.speed[0])
    dense, omega = Together(DAMPED, ELEMENT, speed), 1.2 * speed
    b3 = DAMPED.supports[2]
    size = SIZE * omega**2 * np.exp(-1j * ANGLE)
    gap = {}
    for way in "yz":
        ends = [dense.row[rotor, way](b3.x) for rotor in ("spindle", "outer")]
        moved = [
            sum(
                dense.receptance(end, dense.row["outer", other](0.356), omega) * force
                for other, force in (("y", size), ("z", 1j * size))
            )
            for end in ends
        ]
        gap[way] = moved[0] - moved[1]
    for axis, way in enumerate("yz"):
        dynamic = b3.stiffness[way, way] + 1j * omega * b3.damping[way, way]
        assert found.force[0, 2, axis] == pytest.approx(-dynamic * gap[way], rel=1e-4)


@pytest.mark.parametrize("ratio", [1.7, -1.7])
def test_a_span_and_a_grade_of_the_outer_rotor(ratio: float) -> None:
    """A span off the axis as a whole is one unbalance where a rigid rotor has its middle; a grade
    is that of the rotor's own speed, 1.7 times the one given, which is of the spindle."""
    machine = scene(rigid_pair(ratio), (9000.0,), 900.0, rotor="rigid")
    (rotor,) = machine.spindle.rotors
    rotor = replace(rotor, points={"a": 0.1, "m": 0.275, "b": 0.45})
    machine = scene(replace(machine.spindle, rotors=(rotor,)), (9000.0,), 900.0, rotor="rigid")
    body = rotor_inertia(machine.spindle.part("outer"))
    whole = UnbalanceSpec(("t",), spans=(EccentricSpan("outer.a", "outer.b", 1e-5),))
    graded = UnbalanceSpec(("t",), grade=BalanceGrade(2.5e-3, 1000.0, ("outer.m",)))
    ours = [unbalance.solve(machine, spec).displacement for spec in (whole, graded)]
    for found, size in zip(ours, (1e-5 * body.mass, 2.5e-3 * body.mass / 1700.0), strict=True):
        one = UnbalanceSpec(("t",), unbalances=(Unbalance("outer.m", size),))
        assert found == pytest.approx(unbalance.solve(machine, one).displacement, rel=1e-9)


# --- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"supports": COAXIAL.supports[:1]}, "rotor 'outer' is unrestrained"),
        (
            {"supports": (replace(COAXIAL.supports[0], against="outr"), *COAXIAL.supports[1:])},
            r"supports.b1.against: unknown rotor: given 'outr'; allowed: ground, spindle, outer "
            r"\(did you mean outer\?\)",
        ),
        (
            {"supports": (replace(COAXIAL.supports[0], against="spindle"), *COAXIAL.supports[1:])},
            "needs two different ends",
        ),
        ({"rotors": (replace(OUTER, name="ground"),)}, "not allowed for a further rotor: given"),
        ({"rotors": (OUTER, OUTER)}, "rotors.outer.name: name given twice: 'outer'"),
        (
            {"supports": (*COAXIAL.supports, replace(COAXIAL.supports[1], name="outer"))},
            "rotors.outer.name: name already taken by a support: given 'outer'; allowed: any other",
        ),
        (
            {"housings": (RigidHousing("b1", ("b1",), 0.0, 5.0, {("y", "y"): 1e8}),)},
            "housings.b1.name: name already taken by a support: given 'b1'; allowed: any other",
        ),
        ({"loss_factor": 0.01}, "damping.loss_factor: .* one rotor, .*: given 0.01 beside rotors"),
        (
            {"supports": (replace(COAXIAL.supports[0], loss_factor=0.1), *COAXIAL.supports[1:])},
            "supports.b1.loss_factor: .* one rotor, .*: given 0.1 beside rotors",
        ),
        (
            {"housings": (RigidHousing("casing", ("b2", "b3"), 0.4, 5.0, {("y", "y"): 1e8}),)},
            "support 'b3' connects two rotors and not a rotor to ground$",
        ),
        ({"rotors": (replace(OUTER, shaft=Shaft(0.16, OUTER.shaft.sections)),)}, "off the shaft"),
    ],
)
def test_rotors_that_cannot_be(changes: dict[str, object], said: str) -> None:
    with pytest.raises(InvalidInput, match=said):
        replace(COAXIAL, **changes)  # type: ignore[arg-type]


def test_one_rotor_is_its_own_part() -> None:
    assert INNER.part("spindle") is INNER
    assert INNER.grounded is INNER
