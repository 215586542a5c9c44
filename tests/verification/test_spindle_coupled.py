"""Coupling supports beside bearings, whose states are axial."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.spec import Setting
from tests.oracles.spindles import RPM, answers, conditions, mfw2310, pairs, scene, system_of

HERE = 0.1


def with_support(entries: dict[tuple[str, str], float], **more: object) -> Spindle:
    held = LinearSupport("seal", HERE, entries, **more)  # type: ignore[arg-type]
    return mfw2310(supports=(held,), points={**mfw2310().points, "seal": HERE})


def test_support_that_pushes_aside_as_the_shaft_moves_is_refused_by_name() -> None:
    """y_x: at rest nothing has moved; at speed rings have grown and the shaft has moved."""
    found = scene(with_support({("y", "x"): 1e6}), (0, 12000, 24000))
    place = found.preload.net.position[:, 0]
    assert found.outcome[0] == ""
    for rpm, word, x in zip((12000, 24000), found.outcome[1:], place[1:], strict=True):
        assert word.startswith(
            f"support seal pushes the shaft sideways at {rpm} rpm, where the shaft is"
        )
        assert "(y_x)" in word or "(yx)" in word
        assert f" {(x - place[0]) * 1e6:+.2g} µm from rest" in word
    still = scene(with_support({("y", "x"): 1e6}), (0, 24000), bearings="static")
    assert still.outcome == ("", "")


@pytest.mark.parametrize("entries", [{("x", "y"): 1e6}, {("y", "thx"): 1e4, ("thx", "y"): 1e4}])
def test_other_couplings_leave_the_preload_state_alone(
    entries: dict[tuple[str, str], float],
) -> None:
    plain, ours = scene(mfw2310(), (0, 24000)), scene(with_support(entries), (0, 24000))
    assert ours.outcome == ("", "")
    assert ours.preload.net.position.tolist() == plain.preload.net.position.tolist()
    assert any(len(system_of(ours, way).linear.kinds) == 2 for way in ("axial", "torsion"))


def test_damper_that_couples_moves_nothing_at_rest() -> None:
    seal = with_support({}, damping={("y", "x"): 500.0, ("x", "y"): 500.0})
    ours = scene(seal, (0, 24000))
    assert ours.outcome == ("", "")
    assert system_of(ours).linear.kinds == {"bending", "axial"}


def test_modes_are_followed_through_the_joint_system() -> None:
    """Weakly coupled: the flagship's own diagram, mode by mode, over the whole range."""
    weak = {("y", "thx"): 10.0, ("thx", "y"): 10.0, ("x", "y"): 100.0}
    rpm, spec = tuple(range(0, 24001, 3000)), CampbellSpec(3500.0)
    plain = campbell.solve(scene(mfw2310(), rpm), spec)
    ours = campbell.solve(scene(with_support(weak), rpm, ports=()), spec)
    assert sorted(ours.kind) == sorted(plain.kind)
    for kind in ("bending", "axial", "torsion"):
        a, b = (np.sort(r.frequency[:, [k == kind for k in r.kind]], axis=1) for r in (plain, ours))
        assert b == pytest.approx(a, rel=1e-4), kind
    steps = np.abs(np.diff(ours.frequency, axis=0)) / ours.frequency[:-1]
    own = np.abs(np.diff(plain.frequency, axis=0)) / plain.frequency[:-1]
    assert steps.max() < 1.05 * own.max()
    last = [k for k, kind in enumerate(ours.kind) if kind == "bending"]
    assert set(np.unique(ours.whirl[-1, last])) == {-1.0, 1.0}


def test_shapes_show_what_moves_along() -> None:
    """A strong x–y coupling: bending modes move along the axis too; torsion stays silent."""
    found = campbell.solve(scene(with_support({("x", "y"): 5e7}), (0, 24000)), CampbellSpec(3000.0))
    bending = [k for k, kind in enumerate(found.kind) if kind == "bending"]
    shape = found.shape[1, bending]
    assert np.abs(shape[..., :3]).max(axis=(1, 2)) == pytest.approx(1.0)
    assert np.abs(shape[..., 0]).max() > 1e-3
    assert (shape[..., 3] == 0.0).all()


def test_one_way_coupling_answers_one_way() -> None:
    """x_y: a lateral force moves the shaft along the axis; an axial force bends nothing."""
    found = scene(with_support({("x", "y"): 1e7}), (0, 24000), ports=(HERE, -0.0524))
    spec = FrfSpec((50.0, 500.0), pairs("Oc2.x/Oc2.y", "Oc2.y/Oc2.x", "Oc2.y/Oc2.y"))
    values = np.abs(frf.solve(found, spec).receptance)
    assert (values[:, 0] > 1e-6 * values[:, 2]).all()
    assert (values[:, 1] < 1e-11 * values[:, 2]).all()  # rounding of the sum over modes


@pytest.mark.parametrize("entry", [("y", "z"), ("x", "y"), ("thx", "thz"), ("z", "x")])
def test_radial_stiffness_refuses_what_it_would_leave_out(entry: tuple[str, str]) -> None:
    setting = Setting(with_support({entry: 1e6}), conditions(), (0.0,))
    ((_, sentence),) = StiffnessSpec("Oc2", 100.0, 1, ("full",)).faults_on(setting)
    assert sentence.startswith("support 'seal' couples plane y or the axis")


def test_radial_stiffness_takes_what_lies_beside_its_plane() -> None:
    spindle = with_support({("z", "thx"): 1e4, ("z", "z"): 1e8})
    asked = {"stiffness": StiffnessSpec("Oc2", 100.0, 1, ("full",))}
    plain = answers(mfw2310(), (0, 12000), asked)["stiffness"]
    assert answers(spindle, (0, 12000), asked)["stiffness"].tangent == pytest.approx(
        plain.tangent, rel=1e-9
    )
    assert plain.speed == pytest.approx(np.array([0, 12000]) * RPM)
