"""Errors as estimated by refinement hold at all speeds, not only at the ends: responses where a
lightly damped mode meets a frequency or the speed, poles where tables of supports are extreme."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.refinement import RESPONSES
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.bending import exact_receptance
from tests.oracles.rotors import STEEL
from tests.oracles.spindles import RPM, answers, pairs

RPMS = range(0, 24001, 1000)


def overhung(length: float, damping: float) -> Spindle:
    """Two cylinders, a disc beyond the rear support, uneven planes."""

    def support(name: str, x: float, stiffness: float) -> LinearSupport:
        ways = {("y", "y"): stiffness, ("z", "z"): 1.3 * stiffness}
        return LinearSupport(name, x, ways, dict.fromkeys(ways, damping))

    sections = (Section(length / 2.0, 0.05, 0.0, STEEL), Section(length / 2.0, 0.07, 0.0, STEEL))
    return Spindle(
        "overhung",
        Shaft(0.0, sections),
        supports=(support("a", 0.05, 1e8), support("b", 0.7 * length, 5e7)),
        discs=(Disc("d", 0.8 * length, 0.25, 0.07, 0.03, STEEL),),
        points={"tip": length},
    )


@pytest.mark.parametrize(("length", "damping"), [(0.8, 30.0), (0.8, 300.0), (0.4, 100.0)])
def test_receptances(length: float, damping: float) -> None:
    """A mode of damping ratio 4.5e-6 at 22 000 rpm beside a line (800 mm, 30 N·s/m)."""
    spindle, speed = overhung(length, damping), np.array([*RPMS]) * RPM
    spec = FrfSpec(tuple(np.arange(5.0, 3001.0, 20.0)), pairs("tip.y/tip.y"))
    scene = Scene(spindle, Conditions(accuracy=1e-6), speed, 3000.0)
    exact = exact_receptance(scene, spec.pairs, np.array(spec.frequencies))
    for accuracy in (1e-4, 1e-5):
        found = answers(spindle, RPMS, {"frf": spec}, accuracy=accuracy)["frf"]
        error = np.abs(found.receptance - exact).max() / np.abs(exact).max()
        assert error <= RESPONSES * accuracy
        assert found.error[0] > error / 3.0


@pytest.mark.parametrize("length", [0.4, 0.6, 0.8, 1.0])
def test_response_to_unbalance(length: float) -> None:
    spindle, load = overhung(length, 10.0), (Unbalance(0.8 * length, 1e-5),)
    spec = {"unbalance": UnbalanceSpec(("tip",), load)}
    fine, found = (answers(spindle, RPMS, spec, accuracy=a)["unbalance"] for a in (1e-8, 1e-3))
    truth = np.nan_to_num(fine.displacement)
    error = np.abs(np.nan_to_num(found.displacement) - truth).max() / np.abs(truth).max()
    assert error > 1e-5
    assert error / 3.0 < found.error[0] < 10.0 * error


def test_frequencies_between_the_ends_of_a_table() -> None:
    """Supports that are stiffer by six decades at the speed in the middle."""
    speed = (0.0, 500.0, 1000.0)

    def support(name: str, x: float) -> LinearSupport:
        table = {("y", "y"): (1e7, 1e13, 1e7), ("z", "z"): (1.3e7, 1.3e13, 1.3e7)}
        damping = dict.fromkeys(table, (1.0, 1e4, 1.0))
        return LinearSupport(name, x, table, damping, speeds=speed)

    sizes = ((0.2, 0.05, 0.0), (0.3, 0.07, 0.03), (0.2, 0.04, 0.0))
    sections = tuple(Section(*size, STEEL) for size in sizes)
    supports = support("a", 0.1), support("b", 0.6)
    spindle = Spindle("on tables", Shaft(0.0, sections), supports=supports)
    spec = {"campbell": CampbellSpec(3000.0, shapes=False)}
    rpm = [each / RPM for each in speed]
    fine, found = (answers(spindle, rpm, spec, accuracy=a)["campbell"] for a in (1e-8, 1e-5))
    truth, pole = fine.pole[1][np.isfinite(fine.pole[1])], found.pole[1]
    judged = np.isfinite(pole) & (found.frequency[1] < 3000.0) & (found.frequency[1] > 1.0)
    judged &= np.array(found.kind) == "bending"
    error = np.abs(truth - pole[judged][:, None]).min(axis=1) / np.abs(pole[judged])
    assert judged.sum() >= 4
    assert (error <= 1e-5).all()
    known = error > 1e-8
    assert known.sum() >= 2
    assert (found.frequency_error[1, judged][known] > error[known] / 3.0).all()
