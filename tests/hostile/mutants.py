"""Shipped files with a few changes at random, each drawn from its own stream of numbers.

A mutant is (file, number): the same again on every machine.
"""

from __future__ import annotations

import random
import re
import shutil
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = ("cases", "models/spindles", "models/bearings", "models/tools", "models/materials")
VALUES = (
    "0", "-1", "1e308", "-1e308", "1e-308", ".nan", ".inf", "1e99999", "", "~", "[]", "{}", "true",
    "x", "'0 mm'", "0 mm", "-5 mm", "1e9 mm", "1e300 m", "3 N/um", "1e30 N/um", "12000 rpm",
    "0 rpm", "1e9 rpm", "100 %", "-3 %", "[1, 2]", "{a: 1}", "*a", "&a 1", "!!int 3", "1e400 N",
    "0.1 um", "steel_rotor", "vex70", "'\\0'", "'" + "y" * 300 + "'",
)  # fmt: skip
_VALUE = re.compile(r"(?<=: )[^,{}\[\]#\n]+|(?<=[\[,] )[^,:{}\[\]#\n]+(?=[,\]])")
_KEY = re.compile(r"[A-Za-z_]\w*(?=:)")


def files() -> list[Path]:
    """Every file that is changed."""
    return sorted(path for name in FOLDERS for path in (ROOT / name).glob("*.yaml"))


def mutant(path: Path, number: int) -> str:
    """The text of a file after one to three changes."""
    chance = random.Random(f"{path.name} {number}")
    text = path.read_text(encoding="utf-8")
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        text = _changed(text, chance)
    return text


def _changed(text: str, chance: random.Random) -> str:
    lines = text.splitlines(keepends=True) or [""]
    k, kind = chance.randrange(len(lines)), chance.randrange(9)
    if kind < 4:
        return _replaced(text, _VALUE, chance.choice(VALUES), chance)
    if kind == 4:
        return _replaced(text, _KEY, chance.choice(("x", "name", "model", "from", "'a.b'")), chance)
    if kind == 5:
        return "".join(lines[:k] + lines[k + 1 :])
    if kind == 6:
        return "".join([*lines[:k], lines[k], *lines[k:]])
    if kind == 7:
        at = chance.randrange(len(text) + 1)
        return text[:at] + chance.choice("{}[]:,#&*!|>'\"%@`\t\n -0") + text[at:]
    other = chance.randrange(len(lines))
    lines[k], lines[other] = lines[other], lines[k]
    return "".join(lines)


def _replaced(text: str, pattern: re.Pattern[str], word: str, chance: random.Random) -> str:
    found = list(pattern.finditer(text))
    if not found:
        return text
    place = chance.choice(found)
    return text[: place.start()] + word + text[place.end() :]


def written(path: Path, number: int, folder: Path) -> Path:
    """The case to check: a changed case, or one that asks for a changed model."""
    text = mutant(path, number)
    kind = path.parent.name
    if kind == "cases":
        for data in ("data", "figures"):
            if (ROOT / "cases" / data).exists():
                shutil.copytree(ROOT / "cases" / data, folder / data, dirs_exist_ok=True)
        case = folder / "case.yaml"
        case.write_text(text, encoding="utf-8")
        return case
    model = folder / "model.yaml"
    model.write_text(text, encoding="utf-8")
    asked = {
        "spindles": "spindle: ./model.yaml\nspeeds: [0 rpm]\nanalyses: {preload: {}}\n",
        "bearings": "bearing: ./model.yaml\nspeeds: [0 rpm]\n"
        "analyses: {bearing: {loads: [{fx: 100 N}]}}\n",
        "tools": "spindle: grinding_spindle\ntool: ./model.yaml\nspeeds: [0 rpm]\n"
        "analyses: {preload: {}}\n",
        "materials": "spindle: grinding_spindle\noverride: {shaft.material: ./model.yaml}\n"
        "speeds: [0 rpm]\nanalyses: {preload: {}}\n",
    }
    case = folder / "case.yaml"
    case.write_text(f"title: a changed model\n{asked[kind]}", encoding="utf-8")
    return case
