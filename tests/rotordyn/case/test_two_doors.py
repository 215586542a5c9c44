"""``override`` in a file and ``vary`` in Python: one vocabulary, one machine or one sentence.

Every key in the shipped cases and their models is set both ways: to its value, to one close by, to
a wrong word, to a mapping and to nothing.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

import rotordyn
from rotordyn.case.case import Case
from rotordyn.case.expand import opened
from rotordyn.case.library import cases_root, files_of, find
from rotordyn.errors import InvalidInput

Way = tuple[str, ...]
FOLDERS = {"spindle": "spindles", "tool": "tools", "bearing": "bearings"}
OF_CASE = ("conditions", "analyses", "uncertain", "references", "title", "speeds")
LISTS = {"sections", "bearings", "supports", "sleeves", "masses", "discs", "joints", "points"}
# Differences that stay, each for the reason given.
APART = [
    r"uncertain\.\w+\.",  # keys with dots in them
    r"measured_spindle\.responses|\.file=",  # a file that is read; responses are named in Python
    r"references\.\d+\.conditions\.\w+=nonsense",  # of a reference: any word in Python, so far
    r"^spindle=None|\.bore_diameter=None",  # none in Python, an empty key in a file
    r"(bearing_override|\.kind)=(None|nonsense)",
    r"(points|shift|second_stop)=\{'odd'",  # a further name, of which a rule speaks first
]


def walk(value: Any, way: Way = ()) -> Iterator[tuple[Way, Any]]:
    """Every path in a file with its value; items of lists by name or place."""
    if way:
        yield way, value
    entries = value.items() if isinstance(value, dict) else ()
    if isinstance(value, list):
        entries = [(_called(k, item), item) for k, item in enumerate(value, start=1)]
    for key, each in entries:
        yield from walk(each, (*way, str(key)))


def _called(place: int, item: Any) -> str:
    return item.get("name", str(place)) if isinstance(item, dict) else str(place)


def ways(file: Path, content: dict[str, Any]) -> Iterator[tuple[Way, Any]]:
    yield from walk({key: content[key] for key in OF_CASE if key in content})
    for key, kind in FOLDERS.items():
        if key in content:
            yield (key,), content[key]
            for way, value in walk(model(kind, content[key], file)):
                yield (key, *way), value
                if way[0] == "bearings" and way[-1] == "model" and isinstance(value, str):
                    inner = walk(model("bearings", value, file))
                    yield from (((key, *way, *each), known) for each, known in inner)


def model(kind: str, named: Any, file: Path) -> Any:
    return named if isinstance(named, dict) else opened(find(kind, str(named), file))[0].plain()


def close(value: Any) -> Any:
    if isinstance(value, bool):
        return not value
    match = re.match(r"[-+]?\d+\.?\d*(e[-+]?\d+)?", value) if isinstance(value, str) else None
    if match:
        return f"{float(match[0]) * 1.01:.8g}{value[match.end() :]}"
    return value


def kind_of(way: Way) -> Way:
    """What is tested once: the last keys of a path, without the names of items."""
    named = (key if way[k - 1] not in LISTS else "*" for k, key in enumerate(way))
    return tuple("*" if key.isdigit() else key for key in named)[-2:]


def outcome(made: Callable[[Any], Case], given: Any) -> Case | list[str]:
    try:
        return made(given)
    except InvalidInput as refusal:
        return [fault.message for fault in refusal.faults] or [str(refusal)]


def same(file: Case | list[str], python: Case | list[str]) -> bool:
    """The same case, or a sentence of Python that holds the first or another one of the file."""
    if isinstance(file, Case) and isinstance(python, Case):
        return file == python and file.tool == python.tool
    if isinstance(file, Case) or isinstance(python, Case):
        return False
    return any(message.removeprefix("impossible bearing: ") in python[0] for message in file)


def test_both_doors_lead_to_one_case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(cases_root() / "data", tmp_path / "data")
    monkeypatch.chdir(tmp_path)
    seen, wrongly_given = set[Way](), set[str]()
    different = []
    for shipped in files_of("cases"):
        content = opened(shipped)[0].plain()
        overrides = content.pop("override", {})
        content.pop("compare", None)
        file, text = tmp_path / shipped.name, yaml.safe_dump(content, sort_keys=False)
        file.write_text(f"{text}\noverride: {json.dumps(overrides)}\n", encoding="utf-8")
        plain = rotordyn.load(file)
        for way, value in ways(file, content):
            if kind_of(way) in seen:
                continue
            seen.add(kind_of(way))
            path = ".".join(way)
            numbers = [value] if isinstance(value, int | float) else [value, close(value)]
            wrong = [] if kind_of(way)[-1] in wrongly_given else [{"odd": 1}, None]
            wrongly_given.add(kind_of(way)[-1])
            for new in (*numbers, *wrong, "nonsense"):
                if any(re.search(part, f"{path}={new}") for part in APART):
                    continue
                changed = json.dumps(overrides | {path: new})
                file.write_text(f"{text}\noverride: {changed}\n", encoding="utf-8")
                both = outcome(rotordyn.load, file), outcome(plain.vary, {path: new})
                if not same(*both):
                    told = [each if isinstance(each, list) else "a case" for each in both]
                    different.append(f"{shipped.stem}: {path}: {new!r}: {told[0]} or {told[1]}")
    assert len(seen) > 250
    assert not different, "\n".join(different)
