"""The mode nearest to a line: the one that becomes critical when the speed is raised."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.result import TurningCampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.campbell.summary import summary
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.spindle import Spindle
from rotordyn.results.declaration import declared
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.coaxial import COAXIAL, OUTER
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import RPM

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
SHORT = 0.95  # of a critical speed: up to there a machine turns without one


def diagram(spindle: Spindle, rpm: float, highest: float = 1500.0, order: float = 1.0) -> Any:
    found = Scene(spindle, Conditions(), np.array([0.0, rpm]) * RPM, highest)
    return campbell.solve(found, CampbellSpec(highest, engine_orders=(order,)))


def said(result: Any, line: str) -> str:
    words = " ".join(" ".join(summary(result)).split()).replace("\u00a0", " ")
    return words.partition(f"critical {line}, margin to top speed: ")[2].partition(" critical ")[0]


def overhung(ky: float, kz: float) -> Spindle:
    disc = PointMass("disc", 0.6, 20.0, 0.6, 0.31)
    held = tuple(support(name, x, (ky, kz)) for name, x in (("a", 0.0), ("b", 0.4)))
    return uniform(0.6, 0.05, STEEL, masses=(disc,), supports=held)


def coaxial(ratio: float, *, alike: bool) -> Spindle:
    held = COAXIAL.supports
    if alike:
        held = tuple(replace(each, stiffness={("y", "y"): 2e7, ("z", "z"): 2e7}) for each in held)
    return replace(COAXIAL, rotors=(replace(OUTER, speed_ratio=ratio),), supports=held)


@pytest.mark.parametrize(
    ("machine", "rotor", "whirl"),
    [
        (overhung(5e7, 5e7), "", "forward"),
        (overhung(8e6, 6e7), "", "bending 1 "),
        (coaxial(-1.5, alike=True), "spindle", "forward"),
        (coaxial(-1.5, alike=True), "outer", "backward"),
        (coaxial(-1.5, alike=False), "outer", ""),
    ],
    ids=["alike", "unlike", "with the spindle", "against it", "against it, unlike"],
)
def test_it_becomes_critical_a_little_above(machine: Spindle, rotor: str, whirl: str) -> None:
    line = f"1× of {rotor}" if rotor else "1×"
    wide = diagram(machine, 20000.0)
    of_line = np.array(wide.critical_rotor) == (rotor or "spindle")
    first = int(np.flatnonzero(of_line & wide.critical_excited)[0])
    top = SHORT * float(wide.critical_speed[first]) / RPM
    told = said(diagram(machine, top), line)
    assert f"none from 0 to {top:.0f} rpm; {wide.critical[first]} is nearest, " in told
    assert whirl in f"{wide.critical[first]} "
    ratio = float(told.partition("nearest, ")[2].split()[0])
    assert ratio == pytest.approx(1.0 / SHORT, abs=0.02)
    assert told.endswith("× the line at the top speed")


def test_lines_of_another_order_have_backward_whirl_too() -> None:
    top = 6000.0
    found = diagram(overhung(5e7, 5e7), top, order=0.43)
    line = 0.43 * top / 60.0
    near = int(np.argmin(np.abs(found.frequency[-1] - line)))
    assert f"{found.mode[near]} is nearest, {found.frequency[-1, near] / line:.2f} ×" in said(
        found, "0.43×"
    )
    assert "backward" in found.mode[near]


def test_excited_is_what_is_excited_at_critical_speeds() -> None:
    """Of order 1, of one mode after the other and of both rotors, whatever its kind."""
    for ratio, alike in ((-1.5, True), (1.5, True), (-1.5, False)):
        found = diagram(coaxial(ratio, alike=alike), 20000.0)
        own = dict(zip(found.mode, found.excited_by, strict=True))
        assert set(own.values()) <= ({"forward", "backward", ""} if alike else {"either", ""})
        for name, rotor, excited in zip(
            found.critical, found.critical_rotor, found.critical_excited, strict=True
        ):
            way = "backward" if rotor == "outer" and ratio < 0.0 else "forward"
            assert excited == (own[name] in (way, "either"))


def test_the_rotating_frame_tells_of_the_fixed_one() -> None:
    found = diagram(overhung(5e7, 5e7), 1000.0)
    known = {name: getattr(found, name) for name in declared(found)}
    turning = TurningCampbellResult(**(known | {"frequency": found.frequency + 7.0}))
    assert said(turning, "1×") == said(found, "1×") + " in the fixed frame"
