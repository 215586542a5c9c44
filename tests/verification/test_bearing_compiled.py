"""The compiled solver: the same functions, the same states, one after the other."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bearings import Follower, InvalidBearing, NoEquilibrium
from bearings.ball.balance import turning_balance
from bearings.ball.kinematics import (
    Angles,
    geometric,
    hybrid,
    inner_control,
    inner_share,
    outer_control,
    tan_beta,
)
from bearings.ball.law import KINEMATICS, MOMENT_SHARING, Law
from bearings.ring.compiled import jit, states
from bearings.ring.compiled.jit import _callee
from benchmarks.random_bearings import rings
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, RPM, SHARINGS, VEX70

COUNT = 40
LOAD = np.array([1500.0, 300.0, -200.0, 2.0, 1.0])
SPEED = 20000.0 * RPM


def thrown(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Hard loads and speeds, some at rest."""
    rng = np.random.default_rng(seed)
    thrust = 10 ** rng.uniform(1.5, 4.0, COUNT)
    side = rng.uniform(-0.6, 0.6, (COUNT, 2)) * thrust[:, None]
    load = np.column_stack([thrust, side, rng.uniform(-0.01, 0.01, (COUNT, 2)) * thrust[:, None]])
    speed = rng.uniform(0.0, 32000.0, COUNT) * RPM
    speed[::8] = 0.0
    return load, speed


def test_names_and_numbers_of_the_laws_agree() -> None:
    """The numbers by which the compiled code chooses are places in the lists of names."""
    angles = Angles(0.4, (1.0 - 0.4**2) ** 0.5, 0.3, (1.0 - 0.3**2) ** 0.5, 0.1, 0.7)
    by_name = {
        "hybrid": hybrid,
        "outer": outer_control,
        "inner": inner_control,
        "geometric": geometric,
    }
    for law, name in enumerate(KINEMATICS):
        assert tan_beta(law, angles) == by_name[name](angles)
    shares = {
        "equal": (1.0, 0.0),
        "outer": (0.0, 0.0),
        "inner": (2.0, 0.0),
        "hybrid": (1.4 / 1.7, 2.0 / 1.7**2),
    }
    for law, name in enumerate(MOMENT_SHARING):
        assert inner_share(law, 0.7) == shares[name]


def test_the_source_is_the_same() -> None:
    """Nothing is written twice: the compiled balance is the code of the batched one."""
    assert _callee(turning_balance).py_func.__code__ is turning_balance.__code__


@pytest.mark.few(3)
@pytest.mark.parametrize("friction", [None, 0.08])
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_same_states_under_loads_and_displacements(kinematics: str, friction: float | None) -> None:
    load, speed = thrown(11)
    for sharing in SHARINGS:
        how = dict(speed=speed, kinematics=kinematics, moment_sharing=sharing, friction=friction)
        together = VEX70.equilibrium(load=load, compiled=False, **how)
        single = VEX70.equilibrium(load=load, compiled=True, **how)
        assert (together.outcome == single.outcome).all()
        good = together.outcome == ""
        assert good.sum() > COUNT // 4
        size = np.abs(together.displacement[good]).max(axis=1, keepdims=True)
        assert (np.abs(single.displacement - together.displacement)[good] < 1e-9 * size).all()
        assert single.residual[good].max() < 1e-10
        moved = dict(displacement=together.displacement[good], **how)
        moved["speed"] = speed[good]
        there = VEX70.equilibrium(compiled=True, **moved)
        alike = VEX70.equilibrium(compiled=False, **moved)
        assert (there.outcome == alike.outcome).all()
        both = there.outcome == ""
        k = alike.complete_stiffness[both]
        fault = np.abs(there.complete_stiffness[both] - k).max((1, 2))
        assert (fault <= 1e-8 * np.abs(k).max((1, 2))).all()


@pytest.mark.few(1)
@pytest.mark.parametrize("kinematics", ["inner", "geometric"])
def test_every_state_of_a_sweep_is_found_on_its_own(kinematics: str) -> None:
    """Where a light ball may be loaded or lost, the state before must not decide."""
    speed = np.linspace(1000.0, 30000.0, 300) * RPM
    how = dict(load=[60.0, 20.0, 0, 0, 0], speed=speed, kinematics=kinematics)
    together = VEX70.equilibrium(compiled=False, **how)
    single = VEX70.equilibrium(compiled=True, **how)
    assert (together.outcome == single.outcome).all()
    assert (together.status == single.status).all()
    assert (together.outcome != "").any()
    backwards = VEX70.equilibrium(compiled=True, **(how | dict(speed=speed[::-1])))
    assert (backwards.status[::-1] == single.status).all()


def test_follower_finds_what_the_batched_solver_finds() -> None:
    """A ring that two balls hold on the way: only the batched solver follows free motions."""
    asked, index = rings.draw_states(10056), 34
    law = Law(asked.drawn.kinematics, asked.drawn.sharing)
    growth = dict(static_growth=asked.static[index], growth=asked.growth[index])
    follower = Follower(asked.drawn.bearing, speed=asked.speed[index], law=law, **growth)
    found = follower.displacement(asked.load[index])
    expected = asked.solve().displacement[index]
    assert found.displacement == pytest.approx(expected, rel=1e-7, abs=1e-13)


def test_mixed_questions_and_axial_states() -> None:
    for bearing in (VEX70, HARRIS_218):
        for load, move in (
            ([500.0, None, None, 0.0, 0.0], [None, 5e-6, 0.0, None, None]),
            ([800.0, 0, 0, 0, 0], None),
        ):
            ask = dict(load=load, displacement=move, speed=6000.0 * RPM)
            single = bearing.equilibrium(compiled=True, **ask)
            together = bearing.equilibrium(compiled=False, **ask)
            assert single.load == pytest.approx(together.load, rel=1e-9, abs=1e-9)
            k = together.complete_stiffness
            assert np.abs(single.complete_stiffness - k).max() < 1e-10 * np.abs(k).max()


def test_follower_marches_through_loads_and_speeds() -> None:
    follower = Follower(VEX70, speed=SPEED, law=Law("outer", "hybrid"))
    loads = np.linspace(1.0, 3.0, 60)[:, None] * LOAD
    how = dict(kinematics="outer", moment_sharing="hybrid", compiled=False)
    expected = VEX70.equilibrium(load=loads, speed=SPEED, **how)
    steps = [follower.displacement(load) for load in loads]
    for k, step in enumerate(steps):
        assert step.displacement == pytest.approx(expected.displacement[k], rel=1e-8, abs=1e-14)
        assert step.stiffness == pytest.approx(expected.complete_stiffness[k], rel=1e-7, abs=1e-3)
    march = follower.load(expected.displacement[::-1])
    assert march.converged.all()
    assert march.load == pytest.approx(loads[::-1], rel=1e-8, abs=1e-6)
    speeds = np.linspace(0.0, 30000.0, 80) * RPM
    sweep = follower.displacement(np.broadcast_to(LOAD, (80, 5)), speeds)
    at_speeds = VEX70.equilibrium(load=LOAD, speed=speeds, **how)
    assert sweep.displacement == pytest.approx(at_speeds.displacement, rel=1e-8, abs=1e-14)


def test_one_compilation_serves_all() -> None:
    """Single states, batches, rest, other bearings: one kind of arguments."""
    Follower(VEX70, speed=SPEED).displacement(LOAD)
    solver = jit.compiled(states.find_all)
    known = {*solver.signatures}  # bearings of other tests may have other grooves
    other = replace(VEX70, ball_diameter=np.float32(9.5e-3))
    for bearing, speed in ((VEX70, 0.0), (HARRIS_218, 500.0), (other, [100.0, 200.0])):
        bearing.equilibrium(load=LOAD, speed=speed, compiled=True)
    Follower(HARRIS_218).load(np.zeros((3, 5)))
    assert {*solver.signatures} == known


def test_compiled_functions_are_kept_by_their_sources(tmp_path: Path) -> None:
    """Whatever folder numba's user names, other sources have another one."""
    code = "from bearings.ring.compiled.jit import _folder; print(_folder())"
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    folder = Path(done.stdout.strip())
    assert folder.is_relative_to(tmp_path)
    assert re.fullmatch(r"bearings-[0-9a-f]{16}", folder.name)


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="this system has other users")
def test_without_a_cache_one_folder_among_temporary_files_serves_every_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It must be of this user alone: what is kept in it is run."""
    none = tmp_path / "file"
    none.write_text("")
    for variable in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA", "HOME"):
        monkeypatch.setenv(variable, str(none))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    found = {jit._folder.__wrapped__() for _ in range(2)}
    own = tmp_path / f"rotordyn-{os.getuid()}"
    assert [each.parent for each in found] == [own]
    assert own.stat().st_mode & 0o777 == 0o700
    own.chmod(0o777)
    assert jit._folder.__wrapped__() is None
    own.rename(tmp_path / "mine")
    own.symlink_to(tmp_path / "mine")
    (tmp_path / "mine").chmod(0o700)
    assert jit._folder.__wrapped__() is None
    assert sorted(os.listdir(tmp_path)) == ["file", "mine", own.name]


def test_follower_of_nothing() -> None:
    follower = Follower(VEX70, speed=SPEED)
    assert follower.load(np.empty((0, 5))).stiffness.shape == (0, 5, 5)
    for wrong in (dict(bearing="VEX70"), dict(bearing=VEX70, law="outer")):
        with pytest.raises(InvalidBearing, match="a follower takes a"):
            Follower(**wrong)


def test_follower_says_what_it_cannot_do() -> None:
    follower = Follower(VEX70, speed=30000.0 * RPM, law=Law("inner"))
    with pytest.raises(NoEquilibrium, match="unloaded"):
        follower.displacement(np.zeros(5))
    with pytest.raises(NoEquilibrium, match="no equilibrium"):
        follower.displacement([50.0, 400.0, 0.0, 0.0, 0.0])
    many = follower.displacement([[50.0, 400.0, 0, 0, 0], [5000.0, 0, 0, 0, 0]])
    assert many.converged.tolist() == [False, True]
    assert np.isnan(many.displacement[0]).all()
    assert np.isfinite(many.stiffness[1]).all()
    for wrong in (np.full(5, np.nan), np.ones(4), "load"):
        with pytest.raises(InvalidBearing):
            follower.displacement(wrong)
    with pytest.raises(InvalidBearing, match="does not fit"):
        follower.load(np.zeros((3, 5)), speed=[1.0, 2.0])
    for wrong in (dict(speed=[1.0, 2.0]), dict(static_growth=[0.0, 1e-6]), dict(growth=np.nan)):
        with pytest.raises(InvalidBearing):
            Follower(VEX70, **wrong)
    with pytest.raises(InvalidBearing, match="contact angle"):
        Follower(VEX70, static_growth=1e-3)
    with pytest.raises(InvalidBearing, match="friction"):
        Law(friction=-0.1)


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ModuleNotFoundError("No module named 'numba'"), "numba is not installed, and balls"),
        (ImportError("needs another NumPy"), r"numba cannot be loaded \(needs another NumPy\)"),
    ],
)
def test_where_numba_is_missing_its_remedy_is_given(
    error: ImportError, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The plain functions serve, but a user should know why they are slow."""

    class Missing:
        def find_spec(self, name: str, *_: object) -> None:
            if name == "numba":
                raise error

    monkeypatch.delitem(sys.modules, "numba", raising=False)
    monkeypatch.setattr(sys, "meta_path", [Missing(), *sys.meta_path])
    with pytest.warns(RuntimeWarning, match=f"{words}.*python -m pip install numba"):
        assert not jit.available.__wrapped__()
