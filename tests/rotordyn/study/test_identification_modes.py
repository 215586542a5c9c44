"""The rotor from frequencies and dampings of its modes, a sentence for each fault."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.errors import InvalidInput
from rotordyn.machine.rotor import RayleighDamping
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.measured_modes import Modes
from rotordyn.study.identification.solve import identify
from rotordyn.study.identification.summary import summary
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import Unknown, sought
from tests.rotordyn.study.rotor_twin import (
    DAMPING,
    OUTER,
    SPEEDS,
    case,
    spindle,
    unknowns,
)


def modes(of: Spindle, rng: np.random.Generator) -> Modes:
    """Of the lowest three whirl pairs at both speeds, 0.05 % and 3 % noise."""
    scene = Scene(of, Conditions(), np.array(SPEEDS), 2500.0)
    found = scene.system(scene.with_motions(("bending",))[0])
    rows = []
    for row, speed in enumerate(SPEEDS):
        order = np.argsort(np.abs(found.pole[row]))
        for k in [k for k in order if found.pole[row, k].imag > 1.0][:6]:
            rows.append((speed, found.pole[row, k], found.whirl[row, k]))
    pole = np.array([each for _, each, _ in rows])
    return Modes(
        name="modal test",
        speed=np.array([speed for speed, _, _ in rows]),
        frequency=np.abs(pole) / (2.0 * np.pi) * (1.0 + 5e-4 * rng.normal(size=len(pole))),
        deviation=5e-4,
        damping=-pole.real / np.abs(pole) * (1.0 + 0.03 * rng.normal(size=len(pole))),
        damping_deviation=0.03,
        whirl=tuple("forward" if way > 0.0 else "backward" for _, _, way in rows),
    )


def test_sections_and_dampings_from_modes_alone() -> None:
    """From 10 % off; every value within four deviations, χ² as the noise stated."""
    measured = modes(spindle(), np.random.default_rng(4))
    found = identify(case(spindle()), unknowns(0.1), [measured], workers=1)
    best = found.explained
    assert found.sufficient
    true = np.array([OUTER[0], OUTER[2], OUTER[4], *DAMPING])
    assert (np.abs(best.fit.values - true) < 4.0 * best.sure.deviation).all()
    assert (best.sure.deviation[:3] < 0.02 * true[:3]).all()


def test_an_identification_says_which_variants_it_leaves_out() -> None:
    damped = replace(spindle(), rayleigh=RayleighDamping(stiffness=3e-7))
    measured = modes(damped, np.random.default_rng(4))
    sought = {"spindle.damping.rayleigh.stiffness": Unknown(1e-8, 1e-5)}
    both = replace(case(damped), variants={"cold": case(damped), "warm": case(damped)})
    note = "note       the case itself is solved, without its variants cold, warm"
    assert note in summary(identify(both, sought, [measured], workers=1)).splitlines()


def test_a_value_small_by_its_unit_is_printed() -> None:
    """Damping by stiffness, of 0.3 µs, is in seconds: it and its interval are not 0.000000."""
    damped = replace(spindle(), rayleigh=RayleighDamping(stiffness=3e-7))
    measured = modes(damped, np.random.default_rng(4))
    sought = {"spindle.damping.rayleigh.stiffness": Unknown(1e-8, 1e-5)}
    found = identify(case(damped), sought, [measured], workers=1)
    best = found.explained.fit.values[0]
    assert best == pytest.approx(3e-7, rel=0.1)
    (line,) = (each for each in summary(found).splitlines() if "stiffness [s]" in each)
    value, low, _, high = line.split("[s]")[1].split()[:4]
    assert [float(low), float(value), float(high)] == pytest.approx(
        [found.explained.sure.interval[0, 0], best, found.explained.sure.interval[0, 1]], rel=1e-3
    )


def test_values_are_printed_in_the_unit_of_the_ends() -> None:
    """Wherever the search begins."""
    path = "spindle.shaft.sections.s2.outer_diameter"
    for low, high, start, unit in (
        ("20 mm", "9 cm", None, "cm"),
        ("0.02 m", 0.09, "50 mm", "m"),
        (0.02, 0.09, "50 mm", "mm"),
    ):
        (found,) = sought(case(spindle()), {path: Unknown(low, high, start=start)})
        assert found.unit == unit
        assert found.low == pytest.approx(0.02)
        assert found == replace(found, written="")  # a search begun goes on, whatever is typed


def test_modes_are_paired_by_their_whirl() -> None:
    """A backward one, most of the way to the forward one, is nearer to that and still the backward;
    elements of another fineness move both by 1e-5."""
    scene = Scene(spindle(), Conditions(), np.array([700.0]), 2500.0)
    found = scene.system(scene.with_motions(("bending",))[0])
    lowest = {
        way: float(np.abs(found.pole[0][(found.whirl[0] == sign)]).min()) / (2.0 * np.pi)
        for way, sign in (("forward", 1.0), ("backward", -1.0))
    }
    high = lowest["backward"] + 0.7 * (lowest["forward"] - lowest["backward"])
    for whirl, meant in ((("backward",), "backward"), ((), "forward")):
        one = Modes(
            name="m",
            speed=np.array([700.0]),
            frequency=np.array([high]),
            deviation=1e-3,
            whirl=whirl,
        )
        np.testing.assert_allclose(one.predicted(Trial(case(spindle()))), lowest[meant], rtol=1e-4)


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ({"frequency": np.array([100.0])}, "frequencies: given 1; needed: one for each of"),
        ({"deviation": 0.0}, "deviation: given 0 %; allowed: above 0 %"),
        ({"damping": np.array([0.01, 0.01])}, "dampings have a deviation"),
        ({"whirl": ("forward", "sideways")}, "whirl 'sideways'"),
        ({"frequency": np.array([100.0, 100.0])}, "given twice"),
    ],
)
def test_faults_of_modes(how: dict[str, object], sentence: str) -> None:
    given = {"speed": np.zeros(2), "frequency": np.array([100.0, 200.0]), "deviation": 1e-3}
    with pytest.raises(InvalidInput, match=sentence):
        Modes(name="m", **{**given, **how})  # type: ignore[arg-type]
