"""25 states of three four-point bearings, rigid rings, computed by an independent code.

QJ218, QJ218 thinned and R_24^14 of Lacroix (thesis, INSA Lyon, 2014), at rest and at speed, with
two, three and four contacts a ball; displacement and loads to 1e-6 as the table's ``tolerance``
says, angles and pressures to their print, the stiffness to 1e-6 of its largest entry (angles times
the radius of the inner groove circle). The oracle of the tests meets the same table.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from bearings import FourPointBallBearing
from tests.oracles.four_point import Drawing, GrooveOracle
from tests.oracles.known_bearings import DEGREE, RPM
from tests.oracles.known_grooves import DRAWINGS, four_point

TABLE = json.loads((Path(__file__).parent / "four_point_cases.json").read_text(encoding="utf-8"))
CASES = {case["id"]: case for case in TABLE["cases"]}
PRINT = 1e-7  # of a displacement [µm, µrad]


def asked(case: dict[str, Any]) -> tuple[Drawing, dict[str, Any], dict[str, Any]]:
    """Drawing, question, hypotheses."""
    question = dict(load=case["load"], speed=case["rpm"] * RPM, dynamics=case["model"])
    how = dict(
        kinematics=case.get("kinematics", "hybrid"), moment_sharing=case.get("sharing", "equal")
    )
    return DRAWINGS[case["bearing"]], question, how


@cache
def product_state(name: str) -> Any:
    drawing, question, how = asked(CASES[name])
    state = four_point(drawing).equilibrium(**question, **how)
    return SimpleNamespace(
        displacement=state.displacement,
        contact_load=state.contact_load,
        contact_angle=state.contact_angle,
        contacts=state.contacts,
        centrifugal_force=state.centrifugal_force,
        gyroscopic_moment=state.gyroscopic_moment,
        peak=np.nanmax(state.contact_pressure),
        stiffness=lambda: state.stiffness("complete"),
    )


@cache
def oracle_state(name: str) -> Any:
    drawing, question, how = asked(CASES[name])
    oracle = GrooveOracle(drawing, **how)
    state = oracle.solve(**question)
    return SimpleNamespace(
        displacement=state.displacement,
        contact_load=state.contact_load,
        contact_angle=state.contact_angle,
        contacts=state.contacts,
        centrifugal_force=state.centrifugal_force,
        gyroscopic_moment=state.gyroscopic_moment,
        peak=oracle.pressure(state.contact_load).max(),
        stiffness=lambda: state.stiffness,
    )


SOLVERS = {"product": product_state, "oracle": oracle_state}


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", CASES)
def test_displacement(name: str, solver: str) -> None:
    found = SOLVERS[solver](name).displacement * 1e6
    want = np.array(CASES[name]["displacement_um_urad"])
    for kind in (slice(0, 3), slice(3, 5)):
        size = np.abs(want[kind]).max()
        assert found[kind] == pytest.approx(want[kind], abs=1e-6 * size + PRINT)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", CASES)
def test_contacts(name: str, solver: str) -> None:
    """How many contacts of every ball bear, their loads and angles."""
    found, case = SOLVERS[solver](name), CASES[name]
    load, angle = np.array(case["load_N"]), np.array(case["angle_deg"], dtype=float)
    assert found.contacts.tolist() == case["contacts"]
    assert found.contact_load == pytest.approx(load, abs=1e-6 * load.max())
    assert (np.isnan(found.contact_angle) == np.isnan(angle)).all()
    bearing = ~np.isnan(angle)
    assert found.contact_angle[bearing] / DEGREE == pytest.approx(angle[bearing], abs=2e-5)
    assert found.peak / 1e6 == pytest.approx(case["p_max_MPa"], rel=1e-6)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", [name for name in CASES if CASES[name]["rpm"]])
def test_forces_of_motion(name: str, solver: str) -> None:
    found, case = SOLVERS[solver](name), CASES[name]
    assert found.centrifugal_force == pytest.approx(
        np.broadcast_to(case["Fc_N"], found.contacts.shape), rel=1e-6
    )
    want = np.array(case.get("Mg_Nm", np.zeros(found.contacts.shape)))
    assert found.gyroscopic_moment == pytest.approx(want, abs=1e-6 * np.abs(want).max())


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", [name for name in CASES if "stiffness_SI" in CASES[name]])
def test_stiffness(name: str, solver: str) -> None:
    case = CASES[name]
    lever = GrooveOracle(DRAWINGS[case["bearing"]]).lever
    want = np.array(case["stiffness_SI"]) / lever / lever[:, None]
    found = SOLVERS[solver](name).stiffness() / lever / lever[:, None]
    assert found == pytest.approx(want, abs=1e-6 * np.abs(want).max())


@pytest.mark.parametrize("name", TABLE["bearings"])
def test_drawings(name: str) -> None:
    """The bearings of this table are those that the tests share; their axial plays."""
    row, drawing = TABLE["bearings"][name], DRAWINGS[name]
    assert drawing.ball_diameter * 1e3 == pytest.approx(row["D_mm"], rel=1e-12)
    assert drawing.inner_shim * 1e3 == pytest.approx(row["gi_mm"], rel=1e-12)
    assert drawing.outer_shim * 1e3 == pytest.approx(row["go_mm"], rel=1e-12)
    assert drawing.axial_play * 1e6 == pytest.approx(row["axial_play_um"], rel=1e-9)
    built: FourPointBallBearing = four_point(drawing, axial_play=drawing.axial_play)
    assert built.free_angle / DEGREE == pytest.approx(row["alpha_free_deg"], rel=1e-12)
