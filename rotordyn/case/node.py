"""A value read from a file, together with the place it was written at."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

Key = str | int


class Unknown:
    """Stands for a value whose fault is already reported, so that the rest can be checked."""

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN = Unknown()


@dataclass(slots=True)
class Node:
    """A scalar, mapping or list of a file.

    ``value``: a scalar, ``dict[str, Node]``, ``list[Node]`` or ``UNKNOWN``. ``line`` and
    ``column`` count from 1; ``key``: line and column of its key, where it has one; ``path``: its
    dotted path in ``file``; ``raw``: a scalar as it was written; ``size``: number of values in it;
    ``shared``: it is given once for several items, of which this one gives none itself; ``named``:
    where a file names the one of which it is the whole.
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
        """Children with the key or index each is found by."""
        if isinstance(self.value, dict):
            yield from self.value.items()
        elif isinstance(self.value, list):
            yield from enumerate(self.value)

    def child(self, *keys: object) -> Node | None:
        """What is found by ``keys``, one after the other; None where there is nothing."""
        node: Node | None = self
        for key in keys:
            held = None if node is None else node.value
            if isinstance(held, list):
                node = held[key] if isinstance(key, int) and 0 <= key < len(held) else None
            else:
                node = held.get(key) if isinstance(held, dict) else None
        return node

    def listed(self, *keys: object) -> list[Node]:
        """Items of the list found by ``keys``; none where there is no list."""
        found = self.child(*keys)
        return found.value if found is not None and isinstance(found.value, list) else []

    def entries(self, *keys: object) -> dict[str, Node]:
        """Entries of the mapping found by ``keys``; none where there is no mapping."""
        found = self.child(*keys)
        return found.value if found is not None and isinstance(found.value, dict) else {}

    def at(self, *keys: object) -> Node:
        """The deepest node on the way ``keys``; a key that does not exist is passed over."""
        node = self
        for key in keys:
            node = node.child(key) or node
        return node

    @property
    def name(self) -> str:
        """The text under its key ``name``, empty where there is none."""
        named = self.child("name")
        return named.value if named is not None and isinstance(named.value, str) else ""

    def copy(self) -> Node:
        """The same with mappings and lists of its own, free to be changed."""
        value = self.value
        if isinstance(value, dict):
            value = {key: child.copy() for key, child in value.items()}
        elif isinstance(value, list):
            value = [child.copy() for child in value]
        return replace(self, value=value)

    def plain(self) -> Any:
        """The bare value: scalars, dicts and lists, for validation."""
        if isinstance(self.value, dict):
            return {key: child.plain() for key, child in self.value.items()}
        if isinstance(self.value, list):
            return [child.plain() for child in self.value]
        return self.value


def merged(base: Node | None, more: Node | None) -> Node | None:
    """Two mappings or two lists as one, at the place of the first; else ``more`` where there is."""
    if base is None or more is None:
        return base or more
    if isinstance(base.value, dict) and isinstance(more.value, dict):
        kept = {key: value for key, value in base.value.items() if key not in more.value}
        return replace(base, value={**kept, **more.value})  # what ``more`` says comes last
    if isinstance(base.value, list) and isinstance(more.value, list):
        return replace(base, value=[*base.value, *more.value])
    return more


def overlaid(base: Node | None, more: Node) -> Node:
    """``more`` laid over ``base``: mappings key by key at any depth, all else as a whole."""
    if base is None or not (isinstance(base.value, dict) and isinstance(more.value, dict)):
        return more
    kept = {key: value for key, value in base.value.items() if key not in more.value}
    laid = {key: overlaid(base.child(key), value) for key, value in more.value.items()}
    return replace(base, value={**kept, **laid})


def joined(path: str, key: Key) -> str:
    """``path`` extended by a key, or by the place of an item of a list, counted from 1 as in paths
    that are varied."""
    if isinstance(key, int):
        key = f"{key + 1}"
    return f"{path}.{key}" if path else key


def set_paths(node: Node, path: str = "") -> None:
    """Write into each node its path; items of a list go by their ``name`` where they have one."""
    node.path = path
    for key, child in node.items():
        set_paths(child, joined(path, _label(child, key)))


def _label(child: Node, key: Key) -> Key:
    return child.name or key if isinstance(key, int) else key


def matching(node: Node, way: tuple[str, ...]) -> Iterator[Node]:
    """Mappings reached by ``way``, where ``*`` stands for every item of a list."""
    if not way:
        if isinstance(node.value, dict):
            yield node
        return
    for key, child in node.items():
        if way[0] == key or (way[0] == "*" and isinstance(key, int)):
            yield from matching(child, way[1:])
