"""Extreme machines that the keys allow: sizes, stiffness and speeds over all their decades.

A machine is its number: the same again on every computer. Some are refused for what only the whole
tells, such as a bearing beside the shaft; that must take a sentence as well.
"""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

Mapping = dict[str, Any]
BEARINGS = ("vex70", "s6014e", "kh6014e", "qj218", "6012", "vex30")
KINEMATICS = ("hybrid", "outer", "inner", "geometric")


def machine(number: int) -> Mapping:
    """A case with its machine."""
    chance = random.Random(f"machine {number}")
    length = _decades(chance, 1e-3, 20.0)
    spindle = _spindle(chance, length)
    speeds = _speeds(chance, 1e6 if "bearings" not in spindle else 6e4)
    analyses = _analyses(chance, spindle)
    case: Mapping = {"spindle": spindle, "speeds": speeds, "analyses": analyses}
    conditions = _conditions(chance)
    if "static_sag" in analyses:
        conditions.pop("gravity", None)
    if conditions:
        case["conditions"] = conditions
    return case


def written(number: int, folder: Path) -> Path:
    """The case as a file."""
    path = folder / "case.yaml"
    path.write_text(json.dumps(machine(number), indent=1), encoding="utf-8")
    return path


def _decades(chance: random.Random, low: float, high: float) -> float:
    return float(f"{low * (high / low) ** chance.random():.6g}")


def _spindle(chance: random.Random, length: float) -> Mapping:
    count = chance.choice((1, 1, 2, 3, 5, 8, 20, 60, chance.choice((300, 1))))
    weights = [_decades(chance, 1e-6, 1.0) for _ in range(count)]
    slender = _decades(chance, 2e-3, 2.0)
    stepped = chance.choice((1.0, 1.2, 3.0, 100.0))
    sections = []
    for k, weight in enumerate(weights):
        outer = length * slender * _decades(chance, 1.0 / stepped, stepped)
        outer = min(max(outer, 1.1e-4), 10.0)
        section = {
            "name": f"s{k}",
            "length": f"{max(length * weight / sum(weights), 1e-9):.9g} m",
            "outer_diameter": f"{outer:.6g} m",
        }
        if chance.random() < 0.3:
            section["inner_diameter"] = f"{outer * chance.choice((0.1, 0.5, 0.999)):.6g} m"
        elif chance.random() < 0.2:
            rear = outer * chance.choice((0.05, 0.5, 2.0, 40.0))
            section["rear_outer_diameter"] = f"{min(max(rear, 1.1e-4), 10.0):.6g} m"
        sections.append(section)
    material: Any = chance.choice(("steel_rotor", "cemented_carbide"))
    if chance.random() < 0.3:
        material = {
            "name": "m",
            "young_modulus": f"{_decades(chance, 1e9, 2e12):.6g} Pa",
            "density": f"{_decades(chance, 100.0, 3e4):.6g} kg/m^3",
            "poisson_ratio": chance.choice((0.0, 0.3, 0.49)),
        }
    spindle: Mapping = {
        "title": "extreme",
        "shaft": {"start": "0 m", "material": material, "sections": sections},
        "points": {"front": "0 m", "inside": f"{length * chance.random():.6g} m"},
    }
    if chance.random() < 0.1:
        spindle["shaft"]["shear_coefficient"] = chance.choice(("none", "hutchinson", 1e-6, 1))
    _add_supports(chance, spindle, length)
    if chance.random() < 0.35:
        _add_bearings(chance, spindle, length)
    _add_bodies(chance, spindle, length)
    damping: Mapping = {}
    if chance.random() < 0.3:
        damping["rotor"] = [chance.choice(("0 %", "1e-9 %", "1 %", "99 %"))]
    if chance.random() < 0.1:
        damping["loss_factor"] = chance.choice(("1e-9 %", "1 %", "100 %"))
    if damping:
        spindle["damping"] = damping
    return spindle


def _add_supports(chance: random.Random, spindle: Mapping, length: float) -> None:
    supports = []
    for k in range(chance.choice((1, 2, 2, 2, 3, 6))):
        support: Mapping = {
            "name": f"u{k}",
            "x": f"{length * chance.choice((0.0, 1.0, chance.random(), 0.5)):.6g} m",
        }
        if chance.random() < 0.1:
            support["rigid"] = chance.choice((["y", "z"], ["y"], ["x"], ["thy", "thz"]))
        else:
            y = (
                _decades(chance, 1e-15, 1e20)
                if chance.random() < 0.3
                else _decades(chance, 1e4, 1e10)
            )
            ratio = chance.choice((1.0, 1.0, 1.0 + 1e-12, 0.1, 1e-9, -1.0))
            support["stiffness"] = {"yy": f"{y:.6g} N/m", "zz": f"{y * ratio:.15g} N/m"}
            if chance.random() < 0.2:
                cross = y * chance.choice((1e-6, 0.1, 1.0, 10.0))
                support["stiffness"] |= {"yz": f"{cross:.6g} N/m", "zy": f"{-cross:.6g} N/m"}
            if chance.random() < 0.5:
                damping = _decades(chance, 1e-6, 1e13)
                support["damping"] = {"yy": f"{damping:.6g} N s/m", "zz": f"{damping:.6g} N s/m"}
        supports.append(support)
    if supports:
        spindle["supports"] = supports


def _add_bearings(chance: random.Random, spindle: Mapping, length: float) -> None:
    model = chance.choice(BEARINGS)
    places = sorted(length * chance.random() for _ in range(2))
    spindle["bearings"] = [
        {"name": "a", "model": model, "x": f"{places[0]:.6g} m", "thrust": "+x"},
        {"name": "b", "model": model, "x": f"{places[1]:.6g} m", "thrust": "-x"},
    ]
    if model in ("qj218", "6012"):
        for bearing in spindle["bearings"]:
            bearing.pop("thrust")
    else:
        spring: Mapping = {"preload": f"{_decades(chance, 1e-3, 1e7):.6g} N"}
        spring["stiffness"] = f"{_decades(chance, 1.0, 1e12):.6g} N/m"
        spindle["sleeves"] = [{"name": "rear", "bearings": ["b"], "spring": spring}]
    if chance.random() < 0.3:
        spindle["growth"] = {"static": f"{chance.choice((-900.0, 0.0, 1.0, 30.0, 900.0))} um"}


def _add_bodies(chance: random.Random, spindle: Mapping, length: float) -> None:
    if chance.random() < 0.4:
        spindle["discs"] = [
            {
                "name": "d",
                "x": f"{length * chance.random():.6g} m",
                "outer_diameter": f"{_decades(chance, 1e-3, 10.0):.6g} m",
                "inner_diameter": "0 m",
                "width": f"{_decades(chance, 1e-6, 10.0):.6g} m",
                "material": "steel_rotor",
            }
        ]
    if chance.random() < 0.4:
        mass = _decades(chance, 1e-12, 1e5)
        inertia = min(mass * _decades(chance, 1e-8, 1.0), 900.0)
        spindle["masses"] = [
            {
                "name": "m",
                "x": f"{length * chance.random():.6g} m",
                "mass": f"{mass:.6g} kg",
                "polar_inertia": f"{inertia:.6g} kg m^2",
                "diametral_inertia": f"{inertia * chance.choice((0.6, 1.0, 100.0)):.6g} kg m^2",
            }
        ]


def _speeds(chance: random.Random, highest: float) -> Any:
    top = _decades(chance, 1e-6, highest)
    return chance.choice(
        (
            ["0 rpm"],
            [f"{top:.6g} rpm"],
            ["0 rpm", f"{top:.6g} rpm"],
            ["0 rpm", f"{highest:.6g} rpm"],
            [f"{highest:.6g} rpm"],
            ["6000 rpm", "6000.000000001 rpm"],
            ["0 rpm", "0.000000001 rpm", "1000 rpm"],
            {"from": "0 rpm", "to": f"{top:.6g} rpm", "count": chance.choice((2, 5, 40))},
            {"from": "0 rpm", "to": "30000 rpm", "count": 4},
        )
    )


def _analyses(chance: random.Random, spindle: Mapping) -> Mapping:
    top, periods = _decades(chance, 0.1, 1e6), _decades(chance, 0.1, 100.0)
    highest = f"{top:.6g} Hz"
    point = chance.choice(("front", "inside"))
    port, force = chance.choice((("y", "y"), ("x", "x"), ("y", "z"), ("thy", "y"), ("y", "thz")))
    every: Mapping = {
        "campbell": {"max_frequency": highest},
        "frf": {
            "frequencies": chance.choice(
                (
                    {"from": "1e-9 Hz", "to": highest, "count": 50},
                    {"from": "1 Hz", "to": "2000 Hz", "count": 100},
                    ["1e-300 Hz"],
                    [highest],
                )
            ),
            "pairs": [{"response": f"{point}.{port}", "excitation": f"{point}.{force}"}],
        },
        "unbalance": {
            "points": [point],
            "unbalances": [{"at": point, "unbalance": f"{_decades(chance, 1e-12, 1e3):.6g} kg m"}],
        },
        "section_forces": {
            "loads": [{"at": point, "Fy": "1 kN", "Mx": chance.choice(("0 N m", "1 N m"))}]
        },
        "static_sag": {"point": point},
        "time_response": {
            "duration": f"{min(periods / top, 100.0):.6g} s",
            "max_frequency": highest,
            "points": [point],
            "forces": [
                {
                    "at": point,
                    "direction": chance.choice("xyz"),
                    "force": f"{_decades(chance, 1e-6, 1e7):.6g} N",
                }
            ],
        },
    }
    if "bearings" in spindle:
        every |= {
            "preload": {},
            "stiffness": {
                "point": point,
                "max_force": f"{_decades(chance, 1e-3, 1e7):.6g} N",
                "steps": 3,
            },
            "bearing_loads": {"loss_steps": 3},
        }
    names = chance.sample([*every], chance.choice((1, 1, 2, 3)))
    if chance.random() < 0.4 and "campbell" not in names:
        names.append("campbell")
    if random.Random(highest).random() < 0.3:  # leaves the numbers of other machines as they are
        names.append("matrices")
        every["matrices"] = {
            "max_frequency": highest,
            "ports": [f"{point}.{way}" for way in dict.fromkeys((port, force, "thx"))],
        }
    return {name: every[name] for name in names}


def _conditions(chance: random.Random) -> Mapping:
    conditions: Mapping = {}
    if chance.random() < 0.2:
        conditions["kinematics"] = chance.choice(KINEMATICS)
    if chance.random() < 0.2:
        conditions["gravity"] = chance.choice(("-z", "-y", "-x"))
    if chance.random() < 0.1:
        conditions["accuracy"] = chance.choice((1e-8, 0.01))
    return conditions
