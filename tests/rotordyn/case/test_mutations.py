"""Whatever is done to a case file, it is read or refused, and never breaks the reader."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import rotordyn

ROOT = Path(__file__).parents[3]
TEXTS = {path.name: path.read_text() for path in ROOT.glob("cases/*.yaml")}
SCALARS: Any = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.sampled_from(
        ["0 rpm", "5 mm", "-1 N", "computed", "front", "vex70", "rigid", "Oc2.y", "+x"]
    ),
)
VALUES: Any = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner, max_size=3)
    ),
    max_leaves=6,
)
relaxed = settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("mutations")


def read_or_refused(path: Path, content: str | bytes) -> None:
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "replace"))
    assert outcome(path)


def outcome(path: Path) -> bool:
    """Whether the file gave a case, or faults that each say where and what."""
    try:
        return isinstance(rotordyn.load(path), rotordyn.Case)
    except rotordyn.InvalidInput as error:
        return bool(error.faults) and all(f.message and f.file for f in error.faults)


def places(value: Any, way: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    children: Any = ()
    if isinstance(value, dict | list):
        children = value.items() if isinstance(value, dict) else enumerate(value)
    return [way, *(place for key, child in children for place in places(child, (*way, key)))]


def put(data: Any, way: tuple[Any, ...], value: Any) -> None:
    for key in way[:-1]:
        data = data[key]
    data[way[-1]] = value


@pytest.mark.long
@relaxed
@given(st.data())
def test_any_value_replaced(folder: Path, data: st.DataObject) -> None:
    case = yaml.safe_load(TEXTS["mfw2310.yaml"])
    way = data.draw(st.sampled_from(places(case)[1:]))
    put(case, way, data.draw(VALUES))
    read_or_refused(folder / "case.yaml", yaml.safe_dump(case))


@pytest.mark.long
@relaxed
@given(st.data())
def test_any_value_of_a_spindle_overridden(folder: Path, data: st.DataObject) -> None:
    spindle = yaml.safe_load((ROOT / "models/spindles/mfw2310.yaml").read_text())
    way = data.draw(st.sampled_from(places(spindle)[1:]))
    put(spindle, way, data.draw(VALUES))
    (folder / "spindle.yaml").write_text(yaml.safe_dump(spindle))
    case = yaml.safe_load(TEXTS["mfw2310.yaml"])
    case["spindle"] = "./spindle.yaml"
    case["override"] = {
        data.draw(st.sampled_from([".".join(map(str, way)), "bearings.a.x"])): "1 mm"
    }
    read_or_refused(folder / "case.yaml", yaml.safe_dump(case))


@pytest.mark.long
@relaxed
@given(st.sampled_from(sorted(TEXTS)), st.data())
def test_any_text_cut_and_spliced(folder: Path, name: str, data: st.DataObject) -> None:
    text = TEXTS[name]
    start = data.draw(st.integers(0, len(text)))
    length = data.draw(st.integers(0, 40))
    read_or_refused(
        folder / "case.yaml", text[:start] + data.draw(st.text(max_size=6)) + text[start + length :]
    )


@relaxed
@given(st.one_of(st.binary(max_size=60), st.text("ab:-[]{}&*!|>'\"#%@`, \n\t?0", max_size=60)))
def test_any_content(folder: Path, content: str | bytes) -> None:
    read_or_refused(folder / "case.yaml", content)
