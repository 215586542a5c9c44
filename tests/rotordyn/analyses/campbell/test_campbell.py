"""Campbell diagram: following, names, whirl, critical speeds."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell import summary
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.idealised import idealised
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import RPM, case, mfw2310, scene, undamped

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)


def diagram(
    spindle: Spindle, rpm: Any, highest: float, element: float | None = None, **options: Any
) -> Any:
    speed = np.asarray(rpm, float) * RPM
    found = Scene(spindle, Conditions(element_length=element), speed, highest)
    return campbell.solve(found, CampbellSpec(highest, **options))


@cache
def lalanne(step: int, *, damped: bool = True) -> Any:
    rotor = case("lalanne_ferraris").spindle
    rotor = rotor if damped else undamped(rotor)
    return diagram(rotor, np.arange(0, 30001, step), 600.0, 0.1)


def overhung() -> Spindle:
    """A disc at the end of a shaft on two isotropic supports: strong gyroscopic splitting."""
    disc = PointMass("disc", 0.6, 20.0, 0.6, 0.31)
    held = (support("a", 0.0, (5e7, 5e7)), support("b", 0.4, (5e7, 5e7)))
    return uniform(0.6, 0.05, STEEL, masses=(disc,), supports=held)


def test_undamped_modes_are_not_called_unstable() -> None:
    """Their damping ratios are zero up to rounding, of either sign."""
    found = lalanne(3000, damped=False)
    assert np.abs(found.damping_ratio).max() < 1e-9
    assert not found.unstable.any()


# --- Lalanne and Ferraris: anisotropic, damped -------------------------------------------------


@pytest.mark.parametrize(
    ("row", "checked", "damping"),
    [
        (
            0,
            [60.6148, 63.0255, 169.4965, 185.5635, 329.605, 362.078, 529.333, 557.573],
            [5.0328e-4, 3.9881e-4, 3.1231e-3, 2.8533e-3],
        ),
        (
            -1,
            [54.0831, 68.0945, 154.3113, 195.7401, 233.626, 412.473, 437.634, 590.803],
            [2.6281e-4, 6.5568e-4, 3.0923e-3, 2.7101e-3],
        ),
    ],
)
def test_lalanne_ferraris(row: int, checked: list[float], damping: list[float]) -> None:
    """Values of an independent code with the same 13 elements, printed to six digits."""
    found = lalanne(1000)
    bending = np.flatnonzero([k == "bending" for k in found.kind])
    order = bending[np.argsort(found.frequency[row, bending])]
    assert found.frequency[row, order][:8] == pytest.approx(checked, rel=1e-5)
    assert found.damping_ratio[row, order][:4] == pytest.approx(damping, rel=2e-4)


@pytest.mark.parametrize("step", [250, 1000])
def test_synchronous_criticals(step: int) -> None:
    """The book's, to 1e-3; an independent code's, to 2e-5."""
    found = lalanne(step, damped=False)
    book = [3620.4, 3798.1, 10018, 11279, 16785, 24408, 26611]
    checked = [3620.4, 3798.1, 10016.9, 11278.2, 16768.9, 24398.8, 26602.7]
    bending = [kind == "bending" for kind in found.critical_kind]
    assert found.critical_speed[bending] / RPM == pytest.approx(book, rel=1e-3)
    assert found.critical_speed[bending] / RPM == pytest.approx(checked, rel=2e-5)


def test_whirl_of_an_anisotropic_rotor() -> None:
    """At rest every motion is planar; at speed modes 1 and 2 turn backward and forward."""
    found = lalanne(1000, damped=False)
    bending = [k for k, kind in enumerate(found.kind) if kind == "bending"]
    assert (found.whirl[0, bending] == 0).all()
    first, second = (found.mode.index(f"bending {n}") for n in (1, 2))
    assert found.whirl[-1, first] == -1
    assert found.whirl[-1, second] == 1
    assert set(np.unique(found.whirl[1:, bending])) <= {-1.0, 1.0}


def test_names_do_not_claim_a_whirl_that_changes() -> None:
    names = [n for n in lalanne(1000).mode if n.startswith("bending")]
    assert names == [f"bending {k + 1}" for k in range(len(names))]


def test_what_other_machines_may_have_is_named_as_they_name_it() -> None:
    """Pairs where bending modes pair, at every speed; critical speeds of every line
    and kind; modes by whirl or without."""
    found = lalanne(1000)
    named = {number.words for number in summary.lacking(found)}
    own = {number.words for number in summary.numbers(found, None)}  # type: ignore[arg-type]
    assert {each for each in own if each.startswith("bending")} <= named
    top = f"{found.speed[-1] / RPM:.0f} rpm"
    assert {f"bending pair 5 {way} at {top}" for way in ("backward", "forward")} <= named
    assert {"critical 1× bending (30)", "critical 1× torsion (1)"} <= named
    entries = dict(summary.missing_entries(found))
    assert {"bending 30", "bending 3 forward", "axial 1"} <= {*entries["mode"]}
    assert {*entries["critical"]} == {*entries["mode"]}


@pytest.mark.parametrize("step", [250, 500, 2500])
def test_paths_do_not_depend_on_the_step(step: int) -> None:
    coarse, fine = lalanne(5000), lalanne(step)
    every = 5000 // step
    bending = [k for k, kind in enumerate(coarse.kind) if kind == "bending"]
    ours = [fine.mode.index(coarse.mode[k]) for k in bending]
    assert fine.frequency[::every][:, ours] == pytest.approx(coarse.frequency[:, bending], rel=1e-9)


# --- crossings ---------------------------------------------------------------------------------


def test_forward_and_backward_of_different_modes_cross_without_swapping() -> None:
    """A disc midway tilts without moving: its backward mode falls through the pair below it."""
    disc = PointMass("disc", 0.3, 20.0, 2.0, 1.02)
    held = (support("a", 0.0, (5e7, 5e7)), support("b", 0.6, (5e7, 5e7)))
    rotor = uniform(0.6, 0.05, STEEL, masses=(disc,), supports=held)
    found = diagram(rotor, np.arange(0, 20001, 500), 1500.0)
    line = dict(zip(found.mode, found.frequency.T, strict=True))
    falling, straight = line["bending 2 backward"], line["bending 1 forward"]
    assert falling[0] > 1.4 * straight[0]
    assert falling[-1] < 0.4 * straight[-1]
    assert np.ptp(straight) < 1.0
    assert np.ptp(line["bending 1 backward"]) < 1.0
    for name, values in line.items():
        sense = {"forward": 1.0, "backward": -1.0}.get(name.split()[-1], 0.0)
        assert (sense * np.diff(values) > -1e-9).all(), name


def test_planes_of_an_uneven_rotor_cross() -> None:
    """Without polar inertia the planes do not couple: every mode keeps its plane."""
    disc = PointMass("disc", 0.25, 30.0, 1e-6, 1e-6)
    held = tuple(support(n, x, (4e7, 2e7)) for n, x in (("a", 0.0), ("b", 0.5)))
    rotor = uniform(0.5, 0.05, STEEL, masses=(disc,), supports=held)
    found = diagram(rotor, [0, 1000, 2000], 3000.0)
    assert np.isfinite(found.frequency).all()
    assert found.frequency[2] == pytest.approx(found.frequency[0], rel=2e-2)


def test_flagship_branches_are_smooth() -> None:
    """Second differences stay small against the slope where no stop closes."""
    found = campbell.solve(scene(mfw2310(), range(0, 20001, 500)), CampbellSpec(4000.0))
    assert np.isfinite(found.frequency).all()
    kink = np.abs(np.diff(found.frequency, 2, axis=0))
    assert kink.max() < 25.0
    for side, sign in (("forward", 1.0), ("backward", -1.0)):
        columns = [k for k, name in enumerate(found.mode) if name.endswith(side)]
        assert (found.whirl[:, columns] == sign).all()


# --- whirl, names, shapes ----------------------------------------------------------------------


def test_isotropic_pairs_meet_at_rest_and_split_with_speed() -> None:
    found = diagram(overhung(), [0, 10000], 1500.0)
    for number in (1, 2):
        f = found.frequency[:, found.mode.index(f"bending {number} forward")]
        b = found.frequency[:, found.mode.index(f"bending {number} backward")]
        assert f[0] == pytest.approx(b[0], rel=1e-9)
        assert f[1] > f[0] > b[1]


def test_reversed_spin_changes_only_the_sense_of_whirl() -> None:
    found = scene(mfw2310(), (-12000, 0), bearings="static")
    ours = campbell.solve(found, CampbellSpec(4000.0))
    plain = campbell.solve(scene(mfw2310(), (0, 12000), bearings="static"), CampbellSpec(4000.0))
    a = ours.frequency[0, ours.mode.index("bending 1 backward")]
    b = plain.frequency[1, plain.mode.index("bending 1 forward")]
    assert a == pytest.approx(b, rel=1e-9)


def test_forward_criticals_only_where_supports_are_even() -> None:
    """Unbalance cannot excite backward whirl of an isotropic rotor."""
    found = diagram(overhung(), np.arange(0, 40001, 1000), 1500.0)
    assert found.critical
    for name, excited in zip(found.critical, found.critical_excited, strict=True):
        assert excited == (name.startswith("bending") and name.endswith("forward"))
    for name, speed in zip(found.critical, found.critical_speed, strict=True):
        line = found.frequency[:, found.mode.index(name)]
        met = np.interp(speed, found.speed, line)
        assert met == pytest.approx(speed / (2 * np.pi), rel=1e-3)


def test_critical_of_a_rigid_disc_in_closed_form() -> None:
    """Jeffcott: a heavy disc midway on a light stiff shaft, ω² = 2k/m."""
    disc = PointMass("disc", 0.25, 200.0, 1e-6, 1e-6)
    light = idealised("light", 2.1e13, 0.3, 1.0)
    rotor = uniform(
        0.5, 0.06, light, masses=(disc,),
        supports=(support("a", 0.0, (1e6, 1e6)), support("b", 0.5, (1e6, 1e6))),
    )  # fmt: skip
    found = diagram(rotor, np.arange(0, 3001, 100), 100.0)
    assert found.critical_speed[0] == pytest.approx((2e6 / 200.0) ** 0.5, rel=1e-3)


def test_circular_shapes_are_real_in_y() -> None:
    """There y and z are equal but for rounding, which is not to choose."""
    shape = rotordyn.run(rotordyn.load("friswell_tapered_shaft"))["published/campbell"][
        "shape"
    ].values
    circular = np.abs(np.abs(shape[..., 1]) - np.abs(shape[..., 2])).max(axis=-1) < 1e-6
    assert circular.any()
    place = np.abs(shape[..., 1]).argmax(axis=-1)[..., None]
    largest = np.take_along_axis(shape[..., 1], place, axis=-1)[..., 0]
    assert largest[circular] == pytest.approx(np.ones(int(circular.sum())), abs=1e-8)


def test_shapes_at_the_first_and_last_speed() -> None:
    found = campbell.solve(scene(mfw2310(), (0, 12000, 24000)), CampbellSpec(4000.0))
    assert found.shape_speed == pytest.approx(np.array([0, 24000]) * RPM)
    assert found.shape.shape == (2, len(found.mode), len(found.node), 6)
    for k, kind in enumerate(found.kind):
        shape = found.shape[:, k]
        size = np.abs(shape[..., 3:] if kind == "torsion" else shape[..., :3])
        assert size.max(axis=(1, 2)) == pytest.approx(1.0, rel=1e-9)
        silent = {"bending": [0, 3], "axial": [1, 2, 3, 4, 5], "torsion": [0, 1, 2, 4, 5]}[kind]
        assert (shape[..., silent] == 0).all()


def test_circular_whirl_has_its_sense() -> None:
    """Forward: z lags y by a quarter (z = −i y); tilt follows the slope of the deflection."""
    found = campbell.solve(scene(undamped(mfw2310()), (24000,)), CampbellSpec(3000.0))
    for k, name in enumerate(found.mode):
        if not name.startswith("bending"):
            continue
        y, z = found.shape[0, k, :, 1], found.shape[0, k, :, 2]
        assert z == pytest.approx((-1j if name.endswith("forward") else 1j) * y, abs=1e-9)


def test_modes_are_named_from_below() -> None:
    found = diagram(overhung(), [0, 3000], 2000.0)
    for side in ("forward", "backward"):
        names = [n for n in found.mode if n.startswith("bending") and n.endswith(side)]
        assert names == [f"bending {k + 1} {side}" for k in range(len(names))]
        rest = [found.frequency[0, found.mode.index(n)] for n in names]
        assert rest == sorted(rest)
    assert len(set(found.mode)) == len(found.mode)


def test_nothing_above_the_highest_frequency_all_the_time() -> None:
    found = campbell.solve(scene(mfw2310(), (0, 24000)), CampbellSpec(2000.0))
    assert (found.frequency.min(axis=0) <= 2000.0).all()


def test_no_mode_below_the_highest_frequency_is_an_empty_diagram() -> None:
    found = campbell.solve(scene(mfw2310(), (0, 24000)), CampbellSpec(100.0))
    assert found.mode == ()
    assert found.frequency.shape == (2, 0)


def test_rigid_rotor_has_two_pairs() -> None:
    found = campbell.solve(scene(mfw2310(), (0, 24000), rotor="rigid"), CampbellSpec(4000.0))
    bending = [n for n in found.mode if n.startswith("bending")]
    assert len(bending) == 4
    assert not any(n.startswith("torsion") for n in found.mode)


def test_modal_damping_belongs_to_the_free_modes_in_order() -> None:
    """Softly held: the flexible modes are those of the free rotor, with 1, 2 and 5 %."""
    held = (support("a", 0.1, (1e3, 1e3)), support("b", 0.4, (1e3, 1e3)))
    rotor = uniform(0.5, 0.05, STEEL, supports=held)
    rotor = replace(rotor, rotor_damping=(0.01, 0.02, 0.05))
    found = diagram(rotor, [0], 12000.0)
    forward = [k for k, n in enumerate(found.mode) if n.endswith("forward")]
    order = sorted(forward, key=lambda k: found.frequency[0, k])
    assert found.frequency[0, order[:2]].max() < 20.0
    assert found.damping_ratio[0, order[:6]] == pytest.approx(
        [0.0, 0.0, 0.01, 0.02, 0.05, 0.05], abs=2e-5
    )


def critical_numbers(found: Any) -> dict[str, float]:
    names = {each.words: each.value for each in summary.numbers(found, case())}
    return {name: value for name, value in names.items() if name.startswith("critical")}


def test_critical_speeds_are_numbers_by_line_and_kind_from_below() -> None:
    """Whirls that a line does not excite have none."""
    found = diagram(overhung(), np.arange(0, 30001, 3000), 2000.0, engine_orders=(1.0, 3.0))
    critical = critical_numbers(found)
    for order in (1.0, 3.0):
        excited = found.critical_excited & (found.critical_order == order)
        bending = excited & np.array([kind == "bending" for kind in found.critical_kind])
        wanted = np.sort(found.critical_speed[bending]) / RPM
        assert len(wanted) > 1
        names = [f"critical {order:g}× bending ({k + 1})" for k in range(len(wanted))]
        assert [critical[name] for name in names] == pytest.approx(wanted)
    rpm = critical["critical 3× bending (1)"]
    again = diagram(overhung(), [rpm], 2000.0)
    there = again.frequency[0, again.mode.index("bending 1 backward")]
    assert there == pytest.approx(3.0 * rpm / 60.0, rel=1e-7)


def test_a_critical_speed_of_a_mode_that_is_not_followed_counts_with_its_kind() -> None:
    found = diagram(overhung(), np.arange(0, 30001, 3000), 2000.0, engine_orders=(3.0,))
    lost = replace(found, critical=tuple(f"{kind}, not followed" for kind in found.critical_kind))
    assert critical_numbers(lost) == critical_numbers(found)
    said = " ".join(summary.summary(lost)).replace("\N{NO-BREAK SPACE}", " ")
    assert "bending, not followed" in said


def test_critical_speeds_keep_their_names_where_planes_become_unlike() -> None:
    """Modes lose their whirl there."""
    soft = overhung()
    unlike = replace(soft, supports=(support("a", 0.0, (4.9e7, 5e7)), *soft.supports[1:]))
    speeds = np.arange(0, 30001, 3000)
    one, other = (
        critical_numbers(diagram(each, speeds, 2000.0, engine_orders=(3.0,)))
        for each in (soft, unlike)
    )
    assert one.keys() == other.keys()
    assert [*other.values()] == pytest.approx([*one.values()], rel=0.02)


def test_pairs_of_bending_modes_are_numbers_also_where_planes_become_unlike() -> None:
    """No number has the name of a mode and the frequency of another."""
    soft = overhung()
    unlike = replace(soft, supports=(support("a", 0.0, (4.9e7, 5e7)), *soft.supports[1:]))
    one, other = (diagram(each, [0, 15000, 30000], 2000.0) for each in (soft, unlike))
    first, second = (
        {n.words: n.value for n in summary.numbers(found, case()) if n.unit == "Hz"}
        for found in (one, other)
    )
    assert "bending 2 backward" in one.mode
    assert "bending 3" in other.mode
    assert first.keys() == second.keys() >= {"bending pair 2 backward at 30000 rpm"}
    assert [*second.values()] == pytest.approx([*first.values()], rel=0.02)
    assert second["bending pair 2 backward at 0 rpm"] == other.frequency[0, 2]
    alone = replace(other, whirl=np.ones_like(other.whirl))  # nothing to pair
    named = [n for n in summary.numbers(alone, case()) if n.unit == "Hz" and not n.inner]
    assert [n.name for n in named[::2]] == [*other.mode[: len(named) // 2]]
    assert [n.value for n in named] == other.frequency[
        [0, -1], : len(named) // 2
    ].T.ravel().tolist()


def test_a_mode_that_some_speeds_lack_keeps_its_place_among_pairs() -> None:
    """The next backward mode took its place there, under its name."""
    found = diagram(overhung(), [0, 15000, 30000], 2000.0)
    first = found.mode.index("bending 1 backward")
    frequency = found.frequency.copy()
    frequency[:2, first] = np.nan
    lacking = replace(found, frequency=frequency)
    whole, some = (
        {n.words: n.value for n in summary.numbers(each, case()) if n.unit == "Hz"}
        for each in (found, lacking)
    )
    for rpm in (0, 15000):
        assert np.isnan(some.pop(f"bending pair 1 backward at {rpm} rpm"))
        whole.pop(f"bending pair 1 backward at {rpm} rpm")
    assert some == whole


def test_pairs_over_speed_are_those_of_the_names() -> None:
    """Where two modes of one whirl cross, each number stays with its mode."""
    found = diagram(overhung(), [0, 15000, 30000], 2000.0)
    one, two = (found.mode.index(f"bending {k} forward") for k in (1, 2))
    frequency = found.frequency.copy()
    frequency[-1, [one, two]] = frequency[-1, [two, one]]
    crossed = replace(found, frequency=frequency)
    values = {n.words: n.value for n in summary.numbers(crossed, case())}
    assert values["bending pair 1 forward at 30000 rpm"] == frequency[-1, one]


def test_critical_speeds_of_unbalance_keep_their_names_where_planes_become_hardly_unlike() -> None:
    """Backward whirl, which unbalance then excites a little, has a name of its own."""
    soft = overhung()
    hardly = replace(soft, supports=(support("a", 0.0, (5e7, 5.0005e7)), *soft.supports[1:]))
    speeds = np.arange(0, 30001, 3000)
    one, other = (critical_numbers(diagram(each, speeds, 2000.0)) for each in (soft, hardly))
    assert one.keys() < other.keys()
    assert {name: other[name] for name in one} == pytest.approx(one, rel=1e-4)
    assert any("bending backward (1)" in name for name in other)
    listed = {n.words for n in summary.lacking(diagram(soft, speeds, 2000.0))}
    assert other.keys() <= listed


@pytest.mark.parametrize("ratio", [1.5, -1.5])
def test_whirl_against_another_rotor_is_numbered_apart(ratio: float) -> None:
    """On the line of a rotor that turns the other way that is whirl forward; a whirl that is
    neither is among the others."""
    found = diagram(overhung(), [0, 15000, 30000], 2000.0)
    names = ("bending 1 backward", "bending 1 forward", "bending 2")
    line = replace(
        found,
        critical=names,
        critical_speed=np.array([1000.0, 1100.0, 1200.0]),
        critical_rotor=("quill",) * 3,
        critical_order=np.ones(3),
        critical_kind=("bending",) * 3,
        critical_whirl=("backward", "forward", "mixed"),
        critical_damping=np.zeros(3),
        critical_excited=np.ones(3, dtype=bool),
        rotor=("spindle", "quill"),
        speed_ratio=np.array([1.0, ratio]),
    )
    values = {n.words: n.value * RPM for n in summary.numbers(line, case()) if "quill" in n.words}
    kinds = {name.partition("bending")[2]: value for name, value in values.items()}
    backward, forward = (" (1)", " forward (1)") if ratio < 0.0 else (" backward (1)", " (1)")
    assert kinds == pytest.approx({backward: 1000.0, forward: 1100.0, " (2)": 1200.0})
    assert values.keys() <= {n.words for n in summary.lacking(line)}


def test_a_band_below_all_bending_modes_has_no_numbers() -> None:
    assert [*summary.numbers(diagram(mfw2310(), [0, 24000], 100.0), case())] == []
