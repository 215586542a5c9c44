"""Reads one YAML file into nodes with line and column.

The composer works on parse events and limits depth and number of values, so that neither deep
nesting nor repeated aliases can exhaust memory. Duplicate keys, tags, further documents and
anything that is not text are faults.
"""

from __future__ import annotations

import codecs
import difflib
import os
import re
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import yaml

from rotordyn.case.faults import Faults
from rotordyn.case.node import Node, joined, set_paths
from rotordyn.errors import Fault

T = TypeVar("T")
MAX_BYTES = 4_000_000
MAX_DEPTH = 40
MERGE = "<<"
MAX_VALUES = 100_000
_TOO_DEEP = f"nested deeper than {MAX_DEPTH} levels"

_UNPRINTABLE = re.compile("[\\x00-\\x1f\\x7f-\\x9f\\ud800-\\udfff]")
TIGHT = re.compile(r"(?:^|[{,]|- )\s*([\w.*]+):[\[{\w]")  # a key without a space after the colon
# Plain scalars by the core schema of YAML 1.2: ``1e-3`` is a number, ``off`` and ``12:30`` text.
Scalar = str | int | float | bool | None

_WORDS: dict[str, Scalar] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL"), None),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".nan", ".NaN", ".NAN"), float("nan")),
    **{f"{sign}{dot}": float(f"{sign}inf") for sign in "+-" for dot in (".inf", ".Inf", ".INF")},
    **dict.fromkeys((".inf", ".Inf", ".INF"), float("inf")),
}
_INTEGER = re.compile(r"[-+]?[0-9]{1,300}|0o[0-7]{1,300}|0x[0-9a-fA-F]{1,300}")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_document(path: Path, faults: Faults, contents: dict[Path, bytes]) -> Node | None:
    """Read the root mapping of a YAML file; None if it is unusable, which ``faults`` explains.

    ``contents`` receives the bytes read, by path.
    """
    return _read(
        path, faults, contents, lambda raw: _Composer(shown(path), faults).root(_text(raw))
    )


def read_bytes(path: Path, faults: Faults, contents: dict[Path, bytes]) -> bytes | None:
    """Read the bytes of a file that is not YAML; see ``read_document``."""
    return _read(path, faults, contents, lambda raw: raw)


def read_text(path: Path, faults: Faults, contents: dict[Path, bytes]) -> str | None:
    """Read the text of a file that is not YAML; see ``read_document``."""
    return _read(path, faults, contents, lambda raw: _text(raw) if raw.strip() else "")


def _read(
    path: Path, faults: Faults, contents: dict[Path, bytes], parsed: Callable[[bytes], T | None]
) -> T | None:
    try:
        contents[path] = raw = _bytes(path)
        return parsed(raw)
    except _Refused as refusal:
        faults.add(Fault(shown(path), refusal.line, refusal.column, "", refusal.message))
    return None


def shown(path: Path) -> str:
    """Path for messages: relative to the working directory if it lies below."""
    try:
        return str(path.absolute().relative_to(Path.cwd()))
    except (ValueError, OSError):
        return str(path)


class _Refused(Exception):
    def __init__(self, message: str, line: int = 0, column: int = 0) -> None:
        self.message, self.line, self.column = message, line, column


def _bytes(path: Path) -> bytes:
    if _UNPRINTABLE.search(path.name):
        raise _Refused("has control characters, or bytes that are not text, in its name: rename it")
    try:
        status = os.stat(path)
        if stat.S_ISDIR(status.st_mode):
            raise _Refused("is a directory: a file is needed")
        if not stat.S_ISREG(status.st_mode):
            raise _Refused("is not a regular file: a file is needed")
        if status.st_size > MAX_BYTES:
            raise _Refused(f"has {status.st_size} bytes: allowed are up to {MAX_BYTES}")
        with open(path, "rb", opener=_at_once) as file:
            raw = file.read(MAX_BYTES + 1) or b""
        if len(raw) > MAX_BYTES:  # a growing file, or one in /proc with a reported size of 0
            raise _Refused(f"has more than {MAX_BYTES} bytes: allowed are up to {MAX_BYTES}")
        return raw
    except FileNotFoundError:
        raise _Refused(f"no such file{_neighbour(path)}") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not a usable file name"
        raise _Refused(f"cannot be read: {reason}") from None


def _at_once(path: str, flags: int) -> int:
    """Open a file without blocking, as on a pipe without a writer."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _neighbour(path: Path) -> str:
    if path.is_symlink():
        return " at the end of this link"
    try:
        stems = {entry.stem: entry for entry in path.parent.iterdir() if entry.suffix == ".yaml"}
    except (OSError, ValueError):
        return ""
    close = difflib.get_close_matches(path.stem, stems, n=1)
    return f" (did you mean {shown(stems[close[0]])}?)" if close else ""


def _text(raw: bytes) -> str:
    if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        raise _Refused("is text in UTF-16: save it as UTF-8")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        raise _Refused(
            f"is not text in UTF-8: byte 0x{raw[error.start]:02x} cannot be read", line, 1
        ) from None
    if "\0" in text:
        raise _Refused("is a binary file: a YAML text file is needed")
    if not text.strip():
        raise _Refused("the file is empty: a mapping (key: value) is needed")
    return text


class _Composer:
    """Builds nodes from the parse events of one document."""

    def __init__(self, file: str, faults: Faults) -> None:
        self.file = file
        self.faults = faults
        self.anchors: dict[str, Node | None] = {}
        self.values = 0
        self.duplicates: list[tuple[Node, str, Any]] = []

    def root(self, text: str) -> Node | None:
        """Compose the root mapping; raises _Refused if the text is unusable."""
        self.events = yaml.parse(text, Loader=_LOADER)
        try:
            root = self._document()
        except yaml.YAMLError as error:
            raise _not_yaml(error, text) from None
        if root is None or root.value is None:
            raise _Refused("the file is empty: a mapping (key: value) is needed")
        if not isinstance(root.value, dict):
            raise self._refused(
                f"the file must hold a mapping (key: value), not {_kind(root)}", root
            )
        set_paths(root)
        self._report_duplicates()
        return root

    def _report_duplicates(self) -> None:
        for node, key, event in self.duplicates:
            first = node.at(key).key or (0, 0)
            message = f"duplicate key: given again, first in line {first[0]}; allowed: once"
            self.faults.add(Fault(self.file, *_position(event), joined(node.path, key), message))

    def _document(self) -> Node | None:
        root = None
        for event in self.events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    raise self._refused("only one YAML document per file is allowed", event)
                root = self._node(next(self.events), 0)
        return root

    def _node(self, event: Any, depth: int) -> Node:
        if depth > MAX_DEPTH:
            raise self._refused(_TOO_DEEP, event)
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event)
        if event.tag is not None and event.tag != "!":
            self._fault(f"tags are not allowed: given '{event.tag}'", event)
        if event.anchor:
            self.anchors[event.anchor] = None
        node = self._content(event, depth)
        if event.anchor:
            self.anchors[event.anchor] = node
        return node

    def _content(self, event: Any, depth: int) -> Node:
        mark = event.start_mark
        node = Node(None, self.file, mark.line + 1, mark.column + 1)
        if isinstance(event, yaml.ScalarEvent):
            node.raw = event.value
            node.value = resolve(event.value) if event.implicit[0] else event.value
        elif isinstance(event, yaml.MappingStartEvent):
            self._mapping(node, depth)
        else:
            node.value = self._sequence(depth)
        node.size += sum(child.size for _, child in node.items())
        self._count(1, event)
        return node

    def _count(self, values: int, event: Any) -> None:
        self.values += values
        if self.values > MAX_VALUES:
            raise self._refused(f"holds more than {MAX_VALUES} values", event)

    def _mapping(self, node: Node, depth: int) -> None:
        entries: dict[str, Node] = {}
        node.value = entries
        while not isinstance(event := next(self.events), yaml.MappingEndEvent):
            key = self._key(event, depth)
            child = self._node(next(self.events), depth + 1)
            child.key = _position(event)
            if key == MERGE:
                self._fault(f"merge keys ({MERGE}) are not read: write the keys themselves", event)
            elif key in entries:
                self.duplicates.append((node, key, event))
            else:
                entries[key] = child

    def _key(self, event: Any, depth: int) -> str:
        if isinstance(event, yaml.ScalarEvent):
            return str(event.value)
        self._fault("a key must be a plain word", event)
        self._node(event, depth + 1)
        return "?"

    def _sequence(self, depth: int) -> list[Node]:
        items = []
        while not isinstance(event := next(self.events), yaml.SequenceEndEvent):
            items.append(self._node(event, depth + 1))
        return items

    def _alias(self, event: Any) -> Node:
        node = self.anchors.get(event.anchor)
        if node is None:
            known = event.anchor in self.anchors
            why = "refers to itself" if known else "has no anchor before it"
            raise self._refused(f"alias '*{event.anchor}' {why}", event)
        self._count(node.size, event)
        return node.copy()

    def _refused(self, message: str, place: Any) -> _Refused:
        return _Refused(message, *_position(place))

    def _fault(self, message: str, place: Any) -> None:
        self.faults.add(Fault(self.file, *_position(place), "", message))


def resolve(text: str) -> Scalar:
    """The value a plain (unquoted) scalar stands for."""
    if text in _WORDS:
        return _WORDS[text]
    if _INTEGER.fullmatch(text):
        return int(text, 0) if text[:2] in ("0o", "0x") else int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    return text


def _not_yaml(error: Exception, text: str) -> _Refused:
    mark: Any = getattr(error, "problem_mark", None)
    line = "".join(text.splitlines()[mark.line : mark.line + 1]) if mark else ""
    if mark and "\t" in line[: mark.column + 1]:
        tabbed = "a tab is used where YAML needs spaces: indent with spaces only"
        return _Refused(tabbed, mark.line + 1, mark.column + 1)
    if mark is None:
        return _Refused("is not YAML: " + (str(error) or "cannot be parsed").splitlines()[0], 1, 1)
    problem = getattr(error, "problem", None) or "cannot be parsed"
    if "maximum nesting depth" in problem:  # libyaml's own limit, met before the first event
        return _Refused(_TOO_DEEP, mark.line + 1, mark.column + 1)
    above = text.splitlines()[max(mark.line - 1, 0) : mark.line]
    if tight := TIGHT.search(line) or TIGHT.search("".join(above)):
        lacking = f"is not YAML: put a space after the colon of '{tight[1]}:'"
        return _Refused(lacking, mark.line + (line == tight.string), tight.end(1) + 1)
    context = getattr(error, "context", None)
    what = f"{problem}, {context}" if context else str(problem)
    return _Refused(f"is not YAML: {what}", mark.line + 1, mark.column + 1)


def _position(place: Any) -> tuple[int, int]:
    if isinstance(place, Node):
        return place.line, place.column
    return place.start_mark.line + 1, place.start_mark.column + 1


def _kind(node: Node) -> str:
    return "a list" if isinstance(node.value, list) else f"'{node.raw[:40]}'"
