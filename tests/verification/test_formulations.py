"""Three ways of writing the bending: two are the same physics, the third is not."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rotordyn
from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.result import TurningCampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.result import TurningFrfResult
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.errors import InvalidInput
from rotordyn.job import solve
from rotordyn.job.figures import comparison_figures
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.spindle import Spindle
from rotordyn.modes.branches import Branch, branches_of
from rotordyn.modes.errors import mode_errors
from rotordyn.modes.names import named
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.cylinders import NO_SEATS
from tests.oracles.dense_rotor.assemble import add_at_nodes, bending_plane
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, answers, case, mfw2310, pairs, scene, system_of
from tests.oracles.stepped_rotors import stepped_rotor

HZ = 2.0 * math.pi
SPEEDS = (0, 6000, 16000, 24000)
TURNED = "rotating"


def both(spindle: Spindle, speed: np.ndarray, highest: float, **changes: Any) -> list[Scene]:
    ports = (spindle.shaft.start, *spindle.points.values())
    return [
        Scene(spindle, Conditions(formulation=f, **changes), speed, highest, ports)
        for f in ("inertial", TURNED)
    ]


def turning_frame(found: Scene, spin: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """M, 2Ω (Mt + Jd) − Ω Jp and C, K − Ω² Mt + Ω² (Jp − Jd) and iΩC of r = y + i z there."""
    spindle, mesh = found.spindle, found.mesh
    plane = bending_plane(spindle, mesh)
    nodes = [mesh.node_of(s.x) for s in spindle.supports]

    def held(entries: list[Any]) -> np.ndarray:
        blocks = [
            np.diag([e.get(("y", "y"), 0.0) - 1j * e.get(("y", "z"), 0.0), 0.0]) for e in entries
        ]
        return add_at_nodes(0j * plane.mass, nodes, np.array(blocks))

    springs, damping = (
        held([getattr(s, w) for s in spindle.supports]) for w in ("stiffness", "damping")
    )
    moved, rotary = plane.translational_mass, plane.mass - plane.translational_mass
    stiffness = plane.stiffness + springs + 1j * spin * damping
    stiffness = stiffness - spin**2 * moved + spin**2 * (plane.polar - rotary)
    return plane.mass, damping + 1j * spin * (2.0 * (moved + rotary) - plane.polar), stiffness


@st.composite
def isotropic(draw: Any) -> tuple[Spindle, float]:
    """A stepped mass on a shaft on two supports with damping and cross-coupling, and a speed."""
    length, x = draw(st.floats(0.3, 1.0)), draw(st.floats(0.1, 0.9))
    mass, flat = draw(st.floats(0.5, 30.0)), draw(st.floats(0.0, 2.0))
    inertia = mass * draw(st.floats(1e-4, 1e-2))
    disc = PointMass("disc", x * length, mass, flat * inertia, inertia)
    held = []
    for name, at in (("a", draw(st.floats(0.0, 0.2))), ("b", draw(st.floats(0.8, 1.0)))):
        k, c = 10.0 ** draw(st.floats(6.0, 8.5)), 10.0 ** draw(st.floats(1.0, 4.0))
        cross = draw(st.floats(-0.05, 0.05)) * k
        even = support(name, at * length, (k, k), c)
        turning = {("y", "z"): cross, ("z", "y"): -cross}
        held.append(replace(even, stiffness={**even.stiffness, **turning}))
    rotor = uniform(length, draw(st.floats(0.03, 0.08)), STEEL, masses=(disc,), supports=held)
    return replace(rotor, points={"disc": disc.x}), draw(st.floats(0.0, 6000.0))


@pytest.mark.long
@settings(max_examples=40)
@given(isotropic())
def test_random_rotors(drawn: tuple[Spindle, float]) -> None:
    """Poles and receptances of the equation in rotating axes, with all its terms, unreduced."""
    spindle, spin = drawn
    highest = 1500.0
    (found,) = both(spindle, np.array([spin]), 2.0 * highest, element_length=0.05)[1:]
    mass, damping, stiffness = turning_frame(found, spin)
    inverse = np.linalg.inv(mass)
    none, one = np.zeros_like(mass), np.eye(len(mass))
    whole = np.block([[none, one], [-inverse @ stiffness, -inverse @ damping]])
    poles = np.linalg.eigvals(whole)
    in_space = system_of(found).modes.pole[0]
    for pole in in_space[(np.abs(in_space.imag) > 1.0) & (np.abs(in_space) < HZ * highest)]:
        seen = pole - 1j * spin
        assert np.abs(poles - seen).min() < 1e-5 * max(abs(pole), spin)
    frequency = np.array([0.011, 0.13, 0.3, 0.8]) * highest
    spec = FrfSpec(tuple(frequency), pairs("disc.y/disc.y", "disc.z/disc.y"))
    ours = frf.solve(found, spec).receptance[0]
    at = 2 * found.mesh.node_of(spindle.points["disc"])
    size = np.abs(ours).max()
    for k, omega in enumerate(HZ * frequency):
        plus, minus = (
            np.linalg.inv(stiffness + 1j * w * damping - w**2 * mass)[at, at]
            for w in (omega, -omega)
        )
        expected = [0.5 * (plus + minus.conj()), -0.5j * (plus - minus.conj())]
        assert ours[:, k] == pytest.approx(expected, abs=1e-4 * size)


# --- what a user gets --------------------------------------------------------------------------


def run(formulation: str, **changes: Any) -> dict[str, Any]:
    asked = {
        "campbell": CampbellSpec(3000.0),
        "frf": FrfSpec((120.0, 900.0, 2000.0), pairs("Oc2.y/Oc2.y", "Oc2.z/Oc2.y")),
        "stiffness": StiffnessSpec("Oc2", 100.0, 1, ("full",)),
    }
    return answers(mfw2310(), SPEEDS, asked, formulation=formulation, **changes)


@pytest.mark.long
def test_same_modes_after_shifting() -> None:
    """Same names, whirl, damping and shapes; |ω − Ω| in Hz; axial motion and torsion unmoved.
    Turning axes take finer elements, for whirl up to Ω beyond the band."""
    ours, seen = (run(f, accuracy=1e-8)["campbell"] for f in ("inertial", TURNED))
    assert isinstance(seen, TurningCampbellResult)
    assert seen.mode == ours.mode
    assert seen.whirl == pytest.approx(ours.whirl, nan_ok=True)
    assert seen.damping_ratio == pytest.approx(ours.damping_ratio, rel=1e-7)
    bending = np.array([k == "bending" for k in ours.kind])
    shifted = np.abs(ours.whirl * ours.frequency - (ours.speed / HZ)[:, None])
    expected = np.where(bending, shifted, ours.frequency)
    assert seen.frequency == pytest.approx(expected, rel=1e-7)
    assert np.abs(seen.shape) == pytest.approx(np.abs(ours.shape), abs=1e-5)


def test_stiffness_is_a_load_in_the_fixed_frame() -> None:
    ours, *others = (
        run(f)["stiffness"].tangent for f in ("inertial", TURNED, "fixed-frame softening")
    )
    for other in others:
        assert other == pytest.approx(ours, rel=1e-12)


def test_receptance_in_shaft_fixed_axes() -> None:
    """A force that turns with the shaft at ω there is, in space, ω + Ω forward and Ω − ω back."""
    seen = run(TURNED)["frf"]
    assert isinstance(seen, TurningFrfResult)
    found = scene(mfw2310(), SPEEDS, ports=(-0.0524,), accuracy=Conditions().accuracy)
    own = system_of(found)
    row = own.linear.row("spindle", -0.0524, "y")[None, : own.linear.size // 2]
    for k, spin in enumerate(found.speed):
        omega = HZ * seen.frequency
        plus = own.modes.receptance(spin + omega, row, row)[k, 0]
        minus = own.modes.receptance(spin - omega, row, row)[k, 0].conj()
        assert seen.receptance[k, 0] == pytest.approx(0.5 * (plus + minus), rel=1e-5)
        assert seen.receptance[k, 1] == pytest.approx(-0.5j * (plus - minus), rel=1e-5, abs=1e-14)


def test_critical_speeds_and_names_do_not_depend_on_the_frame() -> None:
    """An overhung disc through its criticals: forward modes below Ω keep their names."""
    disc = PointMass("disc", 0.6, 20.0, 0.1, 0.31)
    held = (support("a", 0.0, (5e7, 5e7)), support("b", 0.4, (5e7, 5e7)))
    rotor = uniform(0.6, 0.05, STEEL, masses=(disc,), supports=held)
    speed = np.arange(0.0, 40001.0, 1000.0) * RPM
    ours, seen = (campbell.solve(s, CampbellSpec(1500.0)) for s in both(rotor, speed, 1500.0))
    more = [k for k, name in enumerate(seen.mode) if name not in ours.mode]
    assert [name for name in seen.mode if name in ours.mode] == list(ours.mode)
    assert (seen.frequency[:, more].min(axis=0) < 1500.0).all()  # in rotating axes alone
    assert seen.critical == ours.critical != ()
    assert seen.critical_speed == pytest.approx(ours.critical_speed, rel=1e-4)
    for k in np.flatnonzero(seen.critical_excited):
        name, critical = seen.critical[k], seen.critical_speed[k]
        line = seen.frequency[:, seen.mode.index(name)]
        assert np.interp(critical, seen.speed, line) < 0.6 * np.abs(np.diff(line)).max()


def test_uneven_supports_are_refused() -> None:
    rotor = uniform(0.5, 0.05, STEEL, supports=(support("a", 0.0, (1e7, 2e7)),))
    asked = replace(case(), spindle=rotor, analyses={"campbell": CampbellSpec(500.0)})
    with pytest.raises(InvalidInput, match="of support 'a' differs between directions"):
        replace(asked, conditions=Conditions(formulation=TURNED))


@pytest.mark.parametrize("formulation", [TURNED, "fixed-frame softening"])
def test_user_is_informed(formulation: str) -> None:
    asked = replace(case(), speeds=(0.0,), analyses={"campbell": CampbellSpec(1500.0)})
    asked = replace(asked, conditions=replace(asked.conditions, formulation=formulation))
    answers = solve(asked)
    (told,) = answers.notes
    assert told.startswith(f"formulation {formulation}: ")
    assert answers.warnings == (), "it was chosen, and warns of nothing"
    assert solve(replace(asked, conditions=Conditions())).notes == ()


@pytest.mark.few(1)
@pytest.mark.parametrize("formulation", ["inertial", TURNED])
def test_whole_run(formulation: str, tmp_path: Any) -> None:
    """Files, figures and summary; labels name the rotating frame where it is chosen."""
    asked = {
        "campbell": CampbellSpec(2000.0, (2, 3)),
        "frf": FrfSpec((100.0, 200.0, 300.0), pairs("Oc2.y/Oc2.y")),
    }
    whole = replace(case(), speeds=(0.0, 1000.0, 2000.0), analyses=asked)
    whole = replace(whole, conditions=replace(whole.conditions, formulation=formulation))
    delivery = rotordyn.job.deliver(whole, tmp_path / "out", figures=formulation == TURNED)
    turning = formulation == TURNED
    header = (tmp_path / "out" / "campbell.csv").read_text().splitlines()[0]
    assert ("damped frequency in the rotating frame" in header) == turning
    assert ("modes [Hz] in the rotating frame" in delivery.summary) == turning
    chosen = formulation != "inertial"
    assert (f"\nnote       formulation {formulation}: " in delivery.summary) == chosen
    record = json.loads((tmp_path / "out" / "run.json").read_text(encoding="utf-8"))
    assert len(record["notes"]) == chosen
    assert record["warnings"] == []


@pytest.mark.parametrize(("formulation", "drawn"), [("inertial", True), (TURNED, False)])
def test_known_frequencies_are_drawn_in_the_fixed_frame_alone(
    formulation: str, drawn: bool
) -> None:
    asked: dict[str, Any] = {
        "campbell": CampbellSpec(1500.0, shapes=False),
        "frf": FrfSpec((100.0, 200.0), pairs("Oc2.y/Oc2.y")),
    }
    whole = replace(case(), speeds=(0.0, 1000.0), analyses=asked)
    whole = replace(whole, conditions=replace(whole.conditions, formulation=formulation))
    assert whole.known
    jobs = dict(comparison_figures([(whole, solve(whole).results)]))
    for name in ("campbell", "frf_maps", "frf_surfaces"):
        (variant,) = next(a for a in jobs[name].args[0].args if isinstance(a, list))
        assert bool(variant.known) == drawn, name


@pytest.mark.parametrize("seed", range(4))
def test_modes_seen_in_the_band_from_rotating_axes(seed: int) -> None:
    """Forward whirl of the exact shaft at ω, seen at |ω − Ω|: none is missing, though ω is up to Ω
    beyond the band, and the error is that of the frequency seen."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    still = whirl_frequencies(exact_rotor(spindle, 0.0, NO_SEATS), 4)
    spin, top = 2.2 * still[1], 1.02 * still[2]
    given = Conditions(accuracy=1e-3, formulation=TURNED)
    turned = Scene(spindle, given, np.array([spin]), top / HZ)
    found = campbell.solve(turned, CampbellSpec(top / HZ, shapes=False))
    exact = exact_rotor(spindle, spin, NO_SEATS)
    truth = whirl_frequencies(exact, modes_below(exact, top + spin), 1)
    seen = np.sort(np.abs(truth - spin)[np.abs(truth - spin) <= top])
    forward = np.array([kind == "bending" for kind in found.kind]) & (found.whirl[0] > 0.0)
    order = np.argsort(found.frequency[0, forward])
    ours = found.frequency[0, forward][order] * HZ
    told = found.frequency_error[0, forward][order][ours <= top]
    ours = ours[ours <= top]
    assert ours == pytest.approx(seen, rel=1e-3)
    error = np.abs(ours / seen - 1.0)
    known = error > 1e-8
    assert (told[known] > error[known] / 3.0).all()
    assert (told[known] < error[known] * 3.0).all()


def between_shown_frequencies() -> list[Scene]:
    """A rotor whose second forward mode oscillates at 457 Hz in space, at 357 Hz in the frame that
    turns at 6000 rpm."""
    disc = PointMass("d", 0.3, 15.0, 0.12, 0.065)
    held = [support(name, x, (5e6, 5e6), 500.0) for name, x in (("a", 0.0), ("b", 0.8))]
    steel = Material("s", 2e11, 0.3, 7800.0)
    rotor = uniform(0.8, 0.04, steel, masses=(disc,), supports=held)
    return both(rotor, np.array([0.0, 3000.0, 6000.0]) * RPM, 300.0)


def test_modes_beyond_the_band_of_both_frames_are_not_missed() -> None:
    fixed, turned = (campbell.solve(s, CampbellSpec(300.0)) for s in between_shown_frequencies())
    assert fixed.unconverged == turned.unconverged == ""
    assert np.nanmin(turned.frequency, axis=0).max() <= 300.0


def test_modes_missed_are_named_by_the_frequency_in_the_frame() -> None:
    """A search that leaves out the forward mode of 51 Hz in space at 6000 rpm, 49 Hz in the
    frame."""
    spoken, shown = [], []
    for found in between_shown_frequencies():

        def without_one(one: Scene) -> tuple[list[Branch], tuple[str, ...]]:
            every = branches_of(one, 2.0 * math.pi * 300.0)
            forward = [b for b in every if b.side > 0.0]
            left = min(forward, key=lambda b: b.frequency[-1])
            shown.append(left.frequency[-1])
            return named([b for b in every if b is not left])

        _, _, errors = mode_errors(found, 2.0 * math.pi * 300.0, without_one)
        spoken.append(float(errors.unconverged.split("one of ")[1].split(" Hz")[0]))
    assert spoken == pytest.approx([shown[0], abs(shown[-1] - 100.0)], rel=1e-4)
