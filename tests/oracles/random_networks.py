"""Random networks on one axis with random paths, and what every answer must fulfil.

Balanced at rest by construction; the forces are summed independently, from the laws as written.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rotordyn.state import follow

Plain = dict[str, Any]
UM = 1e-6


def law(rng: np.random.Generator) -> Plain:
    """A power, a linear one, a coarse table or angular-contact balls at rest."""
    kind = rng.choice(["power", "linear", "table", "rest_ball"])
    if kind == "power":
        return {"kind": "power", "k": float(10 ** rng.uniform(9.3, 10.3)), "p": 1.5}
    if kind == "linear":
        return {"kind": "linear", "k": float(10 ** rng.uniform(7, 8.3))}
    if kind == "table":
        d = np.concatenate([[0.0], np.cumsum(rng.uniform(2e-6, 15e-6, 6))])
        slope = np.cumsum(rng.uniform(5e6, 3e7, 6))
        force = np.concatenate([[0.0], np.cumsum(np.diff(d) * slope)])
        return {"kind": "table", "interpolation": "linear", "d": d.tolist(), "F": force.tolist()}
    return {
        "kind": "rest_ball",
        "z": int(rng.integers(12, 26)),
        "kn": float(rng.uniform(5e9, 1e10)),
        "BD": float(rng.uniform(5e-4, 1.3e-3)),
        "alpha_deg": float(rng.uniform(15.0, 28.0)),
        "growth": float(rng.uniform(0.0, 5e-6)),
    }


def random_network(rng: np.random.Generator) -> Plain:
    """A shaft on front bearings, one to three sleeves, sometimes a housing that gives way."""
    way = int(rng.choice([-1, 1]))
    sleeves = [f"sleeve {k}" for k in range(int(rng.integers(1, 4)))]
    housing = "housing" if rng.random() < 0.3 else None
    preload = {sleeve: float(rng.uniform(100.0, 900.0)) for sleeve in sleeves}
    total, tandem = sum(preload.values()), int(rng.integers(1, 4))
    laws = {f"law {k}": law(rng) for k in range(3)}

    def bearing(outer: str | None, s: int, n: int, load: float) -> Plain:
        chosen = str(rng.choice(list(laws)))
        return {"inner": "shaft", "outer": outer, "s": s, "n": n, "law": chosen, "preload": load}

    bearings = [bearing(housing, way, tandem, total / tandem)]
    springs, stops, frictions = [], [], []
    for sleeve, load in preload.items():
        bearings.append(bearing(sleeve, -way, 1, load))
        k = float(10 ** rng.uniform(6.0, 7.5))
        rigid = {"K": None, "rigid": True} if rng.random() < 0.15 else {"K": k}
        springs.append({"body": sleeve, "P": load, "e": way, **rigid})
        others = [None, None, housing, *(other for other in sleeves if other != sleeve)]
        if rng.random() < 0.6 and "rigid" not in rigid:
            ends = {"low": -rng.uniform(2, 40) * UM, "high": rng.uniform(2, 40) * UM}
            kept = {key: ends[key] for key in ends if rng.random() < 0.7} or ends
            stops.append({"body": sleeve, **kept})
        if rng.random() < 0.7:
            other = others[int(rng.integers(len(others)))]
            limit = float(rng.uniform(10.0, 300.0))
            frictions.append({"body": sleeve, "other": other, "limit": limit})
    if housing:
        springs.append(
            {"body": housing, "P": total, "e": -way, "K": float(10 ** rng.uniform(7, 9))}
        )
    return {
        "bodies": ["shaft", *sleeves, *([housing] if housing else [])],
        "laws": laws,
        "bearings": bearings,
        "springs": springs,
        "stops": stops,
        "frictions": frictions,
        "path": [_step(rng, sleeves, len(bearings)) for _ in range(int(rng.integers(2, 7)))],
    }


def _step(rng: np.random.Generator, sleeves: list[str], bearings: int) -> Plain:
    step: Plain = {"force": {"shaft": float(rng.uniform(-2000.0, 2000.0))}}
    if rng.random() < 0.3:
        step["force"][str(rng.choice(sleeves))] = float(rng.uniform(-300.0, 300.0))
    if rng.random() < 0.4:
        step["shift"] = {f"bearing {rng.integers(bearings)}": float(rng.uniform(-20, 20)) * UM}
    return step


def split(network: Plain, parts: int) -> Plain:
    """The same path in ``parts`` equal parts of every step."""
    force: dict[str, float] = {}
    shift: dict[str, float] = {}
    path = []
    for step in network["path"]:
        after, moved = step.get("force", {}), step.get("shift", {})
        for k in range(1, parts + 1):
            share = k / parts
            path.append(
                {
                    "force": {b: _at(force.get(b, 0.0), f, share) for b, f in after.items()},
                    "shift": {p: _at(shift.get(p, 0.0), s, share) for p, s in moved.items()},
                }
            )
        force.update(after)
        shift.update(moved)
    return {**network, "path": path}


def _at(start: float, end: float, share: float) -> float:
    return end if share == 1.0 else (1.0 - share) * start + share * end


def load(law: Plain, d: float) -> float:
    """The law as it is written."""
    if d <= 0.0:
        return 0.0
    if law["kind"] in ("power", "linear"):
        return float(law["k"] * d ** law.get("p", 1.0))
    if law["kind"] == "table":
        x, y = law["d"], law["F"]
        beyond = y[-1] + (y[-1] - y[-2]) / (x[-1] - x[-2]) * (d - x[-1])
        return float(beyond if d > x[-1] else np.interp(d, x, y))
    radial = law["BD"] * math.cos(math.radians(law["alpha_deg"])) + law["growth"]
    axial = math.sqrt(law["BD"] ** 2 - radial**2) + d
    length = math.hypot(radial, axial)
    return float(law["z"] * law["kn"] * max(length - law["BD"], 0.0) ** 1.5 * axial / length)


def worst(network: Plain, answers: list[Plain]) -> dict[str, float]:
    """Over all steps: unbalanced force [N], penetration [m], friction beyond its limit [N], pull of
    a stop [N], force of an open stop [N], error of a load [N]."""
    found = dict.fromkeys(("residual", "penetration", "cone", "pull", "open", "load"), 0.0)
    force: dict[str, float] = {}
    for step, answer in zip(network["path"], answers, strict=True):
        force.update(step.get("force", {}))
        x = {None: 0.0, **answer["x"]}
        total = {body: force.get(body, 0.0) for body in network["bodies"]}
        total[None] = 0.0

        def push(one: Plain, value: float, ends: tuple[str, str] = ("body", "other")) -> None:
            total[one[ends[0]]] += value  # noqa: B023
            total[one.get(ends[1])] -= value  # noqa: B023

        loads = zip(network["bearings"], answer["deflection"], answer["load"], strict=True)
        for bearing, d, given in loads:
            again = load(network["laws"][bearing["law"]], d)
            found["load"] = max(found["load"], abs(again - given))
            push(bearing, -bearing["s"] * bearing["n"] * again, ("inner", "outer"))
        rigid = iter(answer["rigid"])
        for spring in network["springs"]:
            gap = x[spring["body"]] - x[spring.get("other")]
            stiff = spring["K"]
            push(spring, next(rigid) if stiff is None else spring["e"] * spring["P"] - stiff * gap)
        stops = iter(answer["stop"])
        for stop in network["stops"]:
            gap = x[stop["body"]] - x[stop.get("other")]
            for key, way in (("low", 1.0), ("high", -1.0)):
                if key in stop:
                    value, room = next(stops), way * (gap - stop[key])
                    found["penetration"] = max(found["penetration"], -room)
                    found["pull"] = max(found["pull"], -way * value)
                    found["open"] = max(found["open"], abs(value) if room > 1e-12 else 0.0)
                    push(stop, value)
        for friction, value in zip(network["frictions"], answer["friction"], strict=True):
            found["cone"] = max(found["cone"], abs(value) - friction["limit"])
            push(friction, value)
        left = max(abs(total[body]) for body in network["bodies"])
        found["residual"] = max(found["residual"], left)
    return found


def difference(network: Plain, answers: list[Plain], parts: int) -> float:
    """Largest change of a position when every step is done in ``parts``, over the largest one."""
    again = follow(split(network, parts))[parts - 1 :: parts]
    largest = max(abs(x) for answer in answers for x in answer["x"].values()) + 1e-9
    changes = (
        abs(answer["x"][body] - other["x"][body])
        for answer, other in zip(answers, again, strict=True)
        for body in answer["x"]
    )
    return max(changes) / largest
