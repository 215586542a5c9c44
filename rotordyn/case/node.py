"""A value read from a file, with its line and column."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

Key = str | int


class Unknown:
    """Placeholder of a value whose fault is already reported, so that the rest can be checked."""

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN = Unknown()


@dataclass(frozen=True, slots=True)
class Read:
    """A value that needs no reading, such as one that is given for several items."""

    value: Any


class Shared(dict[str, Any]):
    """A mapping given in Python that an item has in common with others, as files spread it."""


@dataclass(slots=True)
class Node:
    """A scalar, mapping or list of a file.

    ``value``: a scalar, ``dict[str, Node]``, ``list[Node]`` or ``UNKNOWN``. ``line`` and
    ``column`` count from 1; ``key``: line and column of its key, where it has one; ``path``: its
    dotted path in ``file``; ``raw``: a scalar as it was written; ``size``: number of values in it;
    ``shared``: copied from a value given once for several items; ``named``: the reference in
    another file to the file of which this is the root.
    """

    value: Any
    file: str
    line: int
    column: int
    path: str = ""
    raw: str = ""
    key: tuple[int, int] | None = None
    size: int = 1
    shared: bool = False
    named: Node | None = None

    def items(self) -> Iterator[tuple[Key, Node]]:
        """Yield the children with their key or index."""
        if isinstance(self.value, dict):
            yield from self.value.items()
        elif isinstance(self.value, list):
            yield from enumerate(self.value)

    def child(self, *keys: object) -> Node | None:
        """Descend along ``keys``; None if a key does not exist."""
        node: Node | None = self
        for key in keys:
            content = None if node is None else node.value
            if isinstance(content, list):
                node = content[key] if isinstance(key, int) and 0 <= key < len(content) else None
            else:
                node = content.get(key) if isinstance(content, dict) else None
        return node

    def listed(self, *keys: object) -> list[Node]:
        """Items of the list at ``keys``; empty if there is no list."""
        node = self.child(*keys)
        return node.value if node is not None and isinstance(node.value, list) else []

    def entries(self, *keys: object) -> dict[str, Node]:
        """Entries of the mapping at ``keys``; empty if there is no mapping."""
        node = self.child(*keys)
        return node.value if node is not None and isinstance(node.value, dict) else {}

    def at(self, *keys: object) -> Node:
        """Deepest node along ``keys``; keys that do not exist are skipped."""
        node = self
        for key in keys:
            node = node.child(key) or node
        return node

    @property
    def name(self) -> str:
        """Text under the key ``name``; empty if there is none."""
        named = self.child("name")
        return named.value if named is not None and isinstance(named.value, str) else ""

    def copy(self) -> Node:
        """Deep copy, which may be changed."""
        value = self.value
        if isinstance(value, dict):
            value = {key: child.copy() for key, child in value.items()}
        elif isinstance(value, list):
            value = [child.copy() for child in value]
        return replace(self, value=value)

    def plain(self) -> Any:
        """Value without positions: scalars, dicts and lists."""
        if isinstance(self.value, dict):
            return {key: child.plain() for key, child in self.value.items()}
        if isinstance(self.value, list):
            return [child.plain() for child in self.value]
        return self.value


def merged(base: Node | None, more: Node | None) -> Node | None:
    """Merge two mappings or two lists at the position of the first; otherwise return ``more``, or
    ``base`` without it."""
    if base is None or more is None:
        return base or more
    if isinstance(base.value, dict) and isinstance(more.value, dict):
        kept = {key: value for key, value in base.value.items() if key not in more.value}
        return replace(base, value={**kept, **more.value})  # what ``more`` says comes last
    if isinstance(base.value, list) and isinstance(more.value, list):
        return replace(base, value=[*base.value, *more.value])
    return more


def overlaid(base: Node | None, more: Node) -> Node:
    """Overlay ``base`` with ``more``: mappings key by key at any depth, other values replaced."""
    if base is None or not (isinstance(base.value, dict) and isinstance(more.value, dict)):
        return more
    kept = {key: value for key, value in base.value.items() if key not in more.value}
    laid = {key: overlaid(base.child(key), value) for key, value in more.value.items()}
    return replace(base, value={**kept, **laid})


def joined(path: str, key: Key) -> str:
    """Append a key to ``path``, or the index of a list item, counted from 1 as in ``vary``."""
    if isinstance(key, int):
        key = f"{key + 1}"
    return f"{path}.{key}" if path else key


def set_paths(node: Node, path: str = "") -> None:
    """Set the path of each node; list items are addressed by their ``name`` if they have one."""
    node.path = path
    for key, child in node.items():
        set_paths(child, joined(path, _label(child, key)))


def _label(child: Node, key: Key) -> Key:
    return child.name or key if isinstance(key, int) else key


def matching(node: Node, way: tuple[str, ...]) -> Iterator[Node]:
    """Yield the mappings at the path ``way``, in which ``*`` stands for every item of a list."""
    if not way:
        if isinstance(node.value, dict):
            yield node
        return
    for key, child in node.items():
        if way[0] == key or (way[0] == "*" and isinstance(key, int)):
            yield from matching(child, way[1:])
