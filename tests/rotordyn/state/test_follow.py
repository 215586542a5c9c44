"""Networks followed along their paths, against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from rotordyn.errors import InvalidInput
from rotordyn.state import NoEquilibrium, follow
from tests.oracles.random_networks import difference, random_network, split, worst

Plain = dict[str, Any]
P, LIMIT = 600.0, 80.0  # N
RANDOM = 12  # networks, of the 10 000 of python -m benchmarks.random_networks


def pair(p: float = 1.5, k: float = 6e9, **more: Any) -> Plain:
    """Two equal bearings back to back, the outer ring of one on a sleeve."""
    plain: Plain = {
        "laws": {"a": {"kind": "power", "k": k, "p": p}},
        "bodies": ["shaft", "sleeve"],
        "bearings": [
            {"inner": "shaft", "outer": None, "s": 1, "n": 1, "law": "a", "preload": P},
            {"inner": "shaft", "outer": "sleeve", "s": -1, "n": 1, "law": "a", "preload": P},
        ],
        "springs": [{"body": "sleeve", "P": P, "e": 1, "rigid": True}],
    }
    return plain | more


def spring(k: float) -> list[Plain]:
    return [{"body": "sleeve", "P": P, "e": 1, "K": k}]


def forces(*values: float, body: str = "shaft") -> list[Plain]:
    return [{"force": {body: value}} for value in values]


def block(**more: Any) -> Plain:
    """One body on a spring of 6 N/µm."""
    springs = [{"body": "sleeve", "P": 0.0, "e": 1, "K": 6e6}]
    return {"bodies": ["sleeve"], "springs": springs, **more}


@pytest.mark.parametrize("p", [1.0, 1.5, 2.0])
def test_a_rigid_pair_of_equal_bearings_unloads_at_two_to_the_p_times_its_preload(p: float) -> None:
    k = 3e7 if p == 1.0 else 6e9 if p == 1.5 else 1e12
    answers = follow(pair(p, k, path=forces(5.0 * P, 0.0, -5.0 * P)))
    unloads = [answer["unloading"][0]["at"] for answer in (answers[0], answers[2])]
    assert np.array(unloads) * 5.0 * P == pytest.approx(2.0**p * P, rel=1e-9)
    assert [answer["unloading"][0]["index"] for answer in (answers[0], answers[2])] == [1, 0]
    assert answers[1]["unloading"][0]["kind"] == "load"
    assert answers[0]["load"][1] == 0.0


def test_a_law_that_never_unloads_is_one_that_unloads_far_away() -> None:
    """A bearing whose force is constant below its points, beside a rubbing sleeve."""
    d, path = [0.0, 10e-6, 20e-6, 40e-6], []
    rng = np.random.default_rng(3)
    for _ in range(4):
        shaft, sleeve, shift = rng.uniform(-1.0, 1.0, 3) * (800.0, 200.0, 8e-6)
        path.append(forces(shaft)[0] | {"shift": {"bearing 1": shift}})
        path[-1]["force"]["sleeve"] = sleeve
        path[-1]["law"] = {"0": "stiff" if rng.random() < 0.5 else "soft"}
    found = []
    for far in (False, True):
        at, nothing = ([-1.0, -0.9, *d[1:]], [0.0]) if far else (d, [])
        laws = {
            name: {"kind": "table", "d": at, "F": [*nothing, *loads]}
            for name, loads in (
                ("soft", [300.0, 300.0, 600.0, 1800.0]),
                ("stiff", [500.0, 500.0, 700.0, 2500.0]),
            )
        }
        plain = pair(springs=spring(30e6), frictions=[{"body": "sleeve", "limit": LIMIT}])
        plain["laws"] |= laws
        del plain["bearings"][0]["preload"]
        plain["bearings"][0] |= {"law": "soft", "d0": 20e-6}
        found.append(follow(plain | {"path": path}))
    for one, other in zip(*found, strict=True):
        assert one["x"] == pytest.approx(other["x"], abs=1e-15)


def test_a_cycle_with_friction_takes_four_times_limit_and_travel() -> None:
    cycle = [500.0, -500.0, 500.0]
    plain = block(
        frictions=[{"body": "sleeve", "limit": LIMIT}], path=forces(*cycle, body="sleeve")
    )
    corners, x, before = [], 0.0, 0.0
    for answer, after in zip(follow(plain), cycle, strict=True):
        (slip,) = answer["events"]
        corners.append((before + slip["at"] * (after - before), x))
        before, x = after, answer["x"]["sleeve"]
        corners.append((after, x))
    force, place = np.array(corners[1:]).T
    work = 0.5 * np.abs(np.dot(force, np.roll(place, -1)) - np.dot(place, np.roll(force, -1)))
    assert work == pytest.approx(4.0 * LIMIT * place.max(), rel=1e-12)
    assert place.max() == pytest.approx((500.0 - LIMIT) / 6e6, rel=1e-12)


def test_past_unloading_the_slope_is_that_of_the_spring_behind_the_other_bearing() -> None:
    answers = follow(pair(1.0, 3e7, springs=spring(6e6), path=forces(-700.0, -800.0)))
    slope = -100.0 / (answers[1]["x"]["shaft"] - answers[0]["x"]["shaft"])
    assert slope == pytest.approx(1.0 / (1.0 / 3e7 + 1.0 / 6e6), rel=1e-9)


def test_a_rigid_preload_is_the_limit_of_stiff_springs() -> None:
    path = forces(500.0, 2500.0, -1000.0)
    rigid = np.array([a["x"]["shaft"] for a in follow(pair(path=path))])
    for stiff in (1e10, 1e11):
        near = [a["x"]["shaft"] for a in follow(pair(springs=spring(stiff), path=path))]
        assert np.abs(near - rigid).max() == pytest.approx(600.0 / stiff, rel=1.0)


def test_friction_that_never_slips_makes_a_spring_rigid() -> None:
    path = forces(500.0, 2500.0, -1000.0)
    rubs = [{"body": "sleeve", "limit": 1e4}]
    stuck = follow(pair(springs=spring(6e6), frictions=rubs, path=path))
    for answer, known in zip(stuck, follow(pair(path=path)), strict=True):
        assert answer["x"] == pytest.approx(known["x"], abs=1e-16)


def test_sliding_that_comes_to_rest_within_a_step_sticks_there() -> None:
    """The bearing stiffens while its seat is pushed on: first the force wins, then the seat."""
    plain = block(
        laws={"a": {"kind": "power", "k": 6e9, "p": 1.5}},
        bearings=[{"inner": None, "outer": "sleeve", "s": 1, "law": "a", "preload": 10.0}],
        springs=[{"body": "sleeve", "P": 10.0, "e": -1, "K": 6e6}],
        frictions=[{"body": "sleeve", "limit": 5.0}],
        path=[{"shift": {"bearing 0": 10e-6}, "force": {"sleeve": -180.0}}],
    )
    (answer,) = follow(plain)
    assert [event["kind"] for event in answer["events"]] == ["slip-", "stick", "slip+"]
    whole = [event["at"] for event in answer["events"]]
    parts = [(a["events"], k) for k, a in enumerate(follow(split(plain, 5)))]
    again = [(k + event["at"]) / 5.0 for events, k in parts for event in events]
    assert again == pytest.approx(whole, abs=1e-9)


def test_play_is_passed_in_a_snap() -> None:
    bearings = [
        {"inner": "shaft", "outer": None, "s": side, "n": 1, "law": "a", "d0": -5e-6}
        for side in (1, -1)
    ]
    plain = {
        "laws": {"a": {"kind": "power", "k": 6e9, "p": 1.5}},
        "bodies": ["shaft"],
        "bearings": bearings,
        "path": forces(100.0, -100.0),
    }
    answers = follow(plain)
    reach = 5e-6 + (100.0 / 6e9) ** (2.0 / 3.0)
    assert [a["x"]["shaft"] for a in answers] == pytest.approx([reach, -reach], rel=1e-9)
    snap = next(event for event in answers[1]["events"] if event["kind"] == "snap")
    assert snap["at"] == pytest.approx(0.5, abs=1e-6)


def test_a_constant_force_that_is_overcome_runs_to_its_stop() -> None:
    stops = [{"body": "sleeve", "low": -30e-6}]
    plain = pair(springs=spring(0.0), stops=stops, path=forces(-599.0, -700.0, 0.0))
    answers = follow(plain)
    kinds = [event["kind"] for answer in answers for event in answer["events"]]
    assert kinds[:2] == ["snap", "close"]
    assert answers[1]["stop"] == pytest.approx([100.0], rel=1e-9)
    assert answers[2]["x"] == pytest.approx({"shaft": 0.0, "sleeve": 0.0}, abs=1e-12)


def test_a_constant_force_that_is_overcome_without_a_stop_has_no_equilibrium() -> None:
    with pytest.raises(NoEquilibrium, match=r"step 2 of the path.*-600\.?\d* N on shaft") as none:
        follow(pair(springs=spring(0.0), path=forces(-599.0, -700.0)))
    assert none.value.body in ("shaft", "sleeve")
    assert none.value.share == pytest.approx(1.0 / 101.0, abs=1e-6)


def test_a_rigid_spring_that_is_driven_through_a_stop_has_no_equilibrium() -> None:
    stops = [{"body": "sleeve", "low": -5e-6}]
    path = [{"shift": {"spring 0": -10e-6}}]
    with pytest.raises(NoEquilibrium, match="body sleeve has no equilibrium") as none:
        follow(pair(stops=stops, path=path))
    assert none.value.share == pytest.approx(0.5, abs=1e-6)


def test_mirrored_networks_have_mirrored_answers() -> None:
    rubs, stops = [{"body": "sleeve", "limit": LIMIT}], [{"body": "sleeve", "low": -5e-6}]
    path = forces(900.0, -1500.0, 400.0)
    answers = follow(pair(springs=spring(6e6), frictions=rubs, stops=stops, path=path))
    turned = pair(frictions=rubs, stops=[{"body": "sleeve", "high": 5e-6}])
    turned["springs"] = [{"body": "sleeve", "P": P, "e": -1, "K": 6e6}]
    for bearing in turned["bearings"]:
        bearing["s"] *= -1
    turned["path"] = forces(-900.0, 1500.0, -400.0)
    for answer, other in zip(answers, follow(turned), strict=True):
        assert answer["load"] == pytest.approx(other["load"], abs=1e-9)
        assert answer["x"]["shaft"] == pytest.approx(-other["x"]["shaft"], abs=1e-16)


# 20544: friction at its limit goes within and comes back to it in one step
# 31575: a bearing of linear law is unloaded, and with it all that slides comes to rest
# 3667: a bearing of linear law is loaded where sliding would otherwise come to rest
@pytest.mark.few(5)
@pytest.mark.parametrize("seed", [*range(RANDOM), 3667, 20544, 31575])
def test_random_networks_are_in_balance_whatever_the_step(seed: int) -> None:
    network = random_network(np.random.default_rng(seed))
    answers = follow(network)
    found = worst(network, answers)
    assert found.pop("residual") <= 1e-8
    assert found.pop("penetration") <= 1e-12
    assert max(found.values()) <= 1e-8
    assert difference(network, answers, 3) <= 1e-6


def rubbing_pair(law: Plain, preload: float, force: float, limit: float) -> Plain:
    """A sleeve rubs on a housing, both on springs of 20 N/um and pressed by the shaft, the sleeve
    through 10 N/um, the housing through ``law``. While both stick together, friction on the sleeve
    is f = -(10 N/um u - h) / 2 with u the way of the shaft against them and h(u) the rise of the
    load of the housing: it turns where h gets steeper than 10 N/um, and again where less steep."""
    return {
        "laws": {"a": {"kind": "linear", "k": 10e6}, "b": law},
        "bodies": ["shaft", "sleeve", "housing"],
        "bearings": [
            {"inner": "shaft", "outer": "sleeve", "s": 1, "n": 1, "law": "a", "preload": 500.0},
            {"inner": "shaft", "outer": "housing", "s": 1, "n": 1, "law": "b", "preload": preload},
        ],
        "springs": [
            {"body": "sleeve", "P": 500.0, "e": -1, "K": 20e6},
            {"body": "housing", "P": preload, "e": -1, "K": 20e6},
            {"body": "shaft", "P": 500.0 + preload, "e": 1, "K": 0.0},
        ],
        "frictions": [{"body": "sleeve", "other": "housing", "limit": limit}],
        "path": forces(force),
    }


KINKS = {"kind": "table", "d": [0.0, 120e-6, 122e-6, 240e-6], "F": [0.0, 600.0, 680.0, 1270.0]}
ROUND = {"kind": "power", "k": 5e6 / (1.5 * math.sqrt(10e-6)), "p": 1.5}
TURNS = {  # law, preload and last force [N], largest friction there [N], rise h(u)
    "between two kinks": (KINKS, 500.0, 415.0, 50.0, lambda u: 5e6 * u),
    "smoothly": (
        ROUND,
        ROUND["k"] * 10e-6**1.5,
        1200.0,
        100.0 / 3.0,
        lambda u: ROUND["k"] * ((10e-6 + u) ** 1.5 - 10e-6**1.5),
    ),
}


@pytest.mark.parametrize("turns", TURNS)
def test_friction_whose_force_turns_within_a_step_slips_before(turns: str) -> None:
    law, preload, force, most, rise = TURNS[turns]
    plain = rubbing_pair(law, preload, force, 0.999 * most)
    (answer,) = follow(plain)
    slip, stick = answer["events"]
    assert (slip["kind"], stick["kind"]) == ("slip+", "stick")
    u = brentq(lambda u: 5e6 * u - 0.5 * rise(u) - 0.999 * most, 0.0, 30e-6)
    assert slip["at"] == pytest.approx((10e6 * u + rise(u)) / force, rel=1e-9)
    assert difference(plain, [answer], 7) <= 1e-9
    (answer,) = follow(rubbing_pair(law, preload, force, 1.001 * most))
    assert answer["events"] == []
    assert abs(answer["friction"][0]) < 0.5 * most


def test_all_that_slides_comes_to_rest_where_what_drives_it_turns() -> None:
    """Force and seat of the shaft drive both bodies: their velocities vanish at one place."""
    network = random_network(np.random.default_rng(88))
    network["frictions"] = [
        {"body": "sleeve 0", "other": "shaft", "limit": 101.39457338559382},
        {"body": "sleeve 0", "other": None, "limit": 158.87863749205667},
    ]
    assert difference(network, follow(network), 3) <= 1e-9


def loop() -> Plain:
    """Two frictions between a sleeve and the shaft, one between it and the ground."""
    network = random_network(np.random.default_rng(11))
    network["frictions"] = [
        {"body": "sleeve 0", "limit": 160.0},
        {"body": "sleeve 0", "other": "shaft", "limit": 110.0},
        {"body": "sleeve 0", "other": "shaft", "limit": 15.0},
    ]
    return {**network, "path": network["path"][:2]}


def test_friction_that_forms_a_loop_is_followed() -> None:
    network = loop()
    answers = follow(network)
    slips = [[event["index"] for event in answer["events"]] for answer in answers]
    assert slips == [[1, 2], [1, 2]], "one gives way, then the other that it pressed on"
    assert max(worst(network, answers).values()) <= 1e-8
    assert difference(network, answers, 3) <= 1e-9


def test_contacts_that_rounding_decides_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rotordyn.state.rates.FLIPS", 1)
    with pytest.raises(NoEquilibrium, match=r"step 2 of the path, .* changes with rounding"):
        follow(loop())


def spoilt(**more: Any) -> Plain:
    return pair(**{"springs": spring(6e6), **more})


BAD = [
    ({"bodies": ["shaft", "sleeve", "housing"]}, "body housing: unrestrained"),
    (
        {
            "bodies": ["shaft", "sleeve", "b"],
            "frictions": [{"body": "b", "other": "shaft", "limit": 9}],
        },
        "body b: restrained by friction alone",
    ),
    ({"stops": [{"body": "sleeve", "low": 1e-6}]}, "stop 0, low: violated at rest"),
    ({"stops": [{"body": "sleeve", "high": -1e-6}]}, "stop 0, high: violated at rest"),
    ({"stops": [{"body": "sleeve"}]}, "stop 0: missing key: low, high or both"),
    ({"path": forces(math.nan)}, "step 1 of the path, force on shaft: given nan"),
    ({"path": [{"force": {"shat": 1.0}}]}, "did you mean shaft"),
    ({"path": [{"shift": {"bearing 7": 1e-6}}]}, "unknown place: given 'bearing 7'"),
    ({"path": [{"law": {"0": "z"}}]}, "unknown law: given 'z'; allowed: a"),
    ({"springs": [{"body": "sleeve", "P": 500.0, "K": 6e6}]}, "not in balance at rest"),
    ({"springs": [{"body": "sleeve", "P": P, "K": -6e6}]}, "spring 0, K: given"),
    ({"springs": [{"body": "sleeve", "P": P, "K": 6e6, "rigid": True}]}, "rigid beside K"),
    ({"frictions": [{"body": "sleeve", "limit": -1.0}]}, "friction 0, limit: given -1.0"),
    ({"frictions": [{"body": "sleeve", "limit": 1.0, "start": 2.0}]}, "friction 0, start"),
    ({"laws": {"a": {"kind": "pow", "k": 1.0}}}, "unknown kind of law: given 'pow'"),
    ({"laws": {"a": {"kind": "table", "d": [0, 0], "F": [0, 1]}}}, "deflections d that rise"),
    ({"paths": []}, "network: unknown key: given 'paths'"),
    ({"springs": [{"body": "sleeve", "P": P, "rigid": "no"}]}, "spring 0, rigid: given 'no'"),
    ({"path": forces(True)}, "force on shaft: given True"),
    ({"laws": None}, "laws: given None; allowed: a mapping"),
    ({"laws": {"a": 5}}, "laws a: given 5; allowed: a mapping with the keys"),
    ({"path": [{"force": 5.0}]}, "step 1 of the path, force: given 5.0; allowed: a mapping"),
    ({"path": forces(1e300)}, "force on shaft: given 1e+300; allowed"),
    ({"path": forces(10**400)}, "force on shaft: given 1000"),
    ({"laws": {"a": {"kind": "table", "d": [0, 1, 2], "F": [0, 2, 1]}}}, "falls beyond 1 m"),
    ({"laws": {"a": {"kind": "table", "d": [0, 1], "F": [700, 700]}}}, "does not reach 600 N"),
    (
        {
            "laws": {
                "a": {
                    "kind": "table",
                    "d": [0.0, 1e-5, 2e-5, 3e-5],
                    "F": [0.0, 0.0, 0.0, 1e3],
                    "interpolation": "cubic",
                }
            }
        },
        "between points either",
    ),
    (
        {"laws": {"a": {"kind": "rest_ball", "z": 20.5, "kn": 1e10, "BD": 1e-3, "alpha_deg": 25}}},
        "laws a, z: given 20.5; allowed: a whole number",
    ),
]


@pytest.mark.parametrize(("more", "sentence"), BAD, ids=[sentence for _, sentence in BAD])
def test_bad_input_is_refused_in_one_sentence(more: Plain, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        follow(spoilt(**more))
    assert sentence in str(refused.value)
    assert "\n" not in str(refused.value)


def test_numbers_and_rows_of_numpy_are_as_good_as_plain_ones() -> None:
    d = [1e-6 * k for k in range(60)]
    load = [6e9 * each**1.5 for each in d]
    plain = {"laws": {"a": {"kind": "table", "d": d, "F": load}}, "path": forces(500.0)}
    rows = {"a": {"kind": "table", "d": np.array(d), "F": np.array(load)}}
    typed = {"laws": rows, "path": [{"force": {"shaft": np.int64(500)}}]}
    assert follow(spoilt(**typed)) == follow(spoilt(**plain))
    named = {"path": [{"shift": {("bearing", 0): 1e-6}}]}
    assert follow(spoilt(**named)) == follow(spoilt(path=[{"shift": {"bearing 0": 1e-6}}]))
