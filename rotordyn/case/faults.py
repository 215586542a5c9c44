"""Collects what is wrong, each fault at the place in a file where it can be put right."""

from __future__ import annotations

from rotordyn.case.node import UNKNOWN, Node, joined
from rotordyn.errors import Fault, InvalidInput, TooManyFaults, printable

MOST = 200  # faults, after which nothing more is read
LONGEST_PATH, LONGEST = 160, 700  # characters of a fault


class Faults:
    """The faults of one case, in the order found; the same one is kept once.

    ``variant``: which one is being read, empty for the case itself. A fault that it makes elsewhere
    than in its own entry is said to be its. ``count``: of all that were met, also of those that are
    known: a model that two seats name has its faults twice and tells them once.
    """

    def __init__(self) -> None:
        self.reported: list[Fault] = []
        self.count = 0
        self.variant = ""

    def at(self, node: Node, message: str) -> None:
        """A fault of a value."""
        self.add(Fault(node.file, node.line, node.column, node.path, message))

    def at_key(self, node: Node, message: str) -> None:
        """A fault of a key itself, not of its value."""
        line, column = node.key or (node.line, node.column)
        self.add(Fault(node.file, line, column, node.path, message))

    def missing(self, node: Node, key: str | int, message: str) -> None:
        """A fault of a key that is not there, at the mapping that should hold it."""
        line, column = node.key or (node.line, node.column)
        self.add(Fault(node.file, line, column, joined(node.path, str(key)), message))

    def told(self, node: Node) -> bool:
        """A fault of this value is reported already."""
        here = node.file, node.line, node.column
        found = ((fault.file, fault.line, fault.column) for fault in self.reported)
        return node.value is UNKNOWN or here in found

    def add(self, fault: Fault) -> None:
        """Keeps ``fault`` on one line, unless it is known."""
        path, prefix = printable(fault.path), f"compare.{self.variant}."
        whose = f"variant {self.variant}: " if self.variant and not path.startswith(prefix) else ""
        message = printable(whose + fault.message)
        path, message = _cut(path, LONGEST_PATH), _cut(message, LONGEST)
        line = Fault(fault.file, fault.line, fault.column, path, message)
        self.count += 1
        if line not in self.reported:
            self.reported.append(line)
        if len(self.reported) >= MOST:
            raise TooManyFaults(self.reported)

    def require_none(self, first: str = "") -> None:
        """Raises InvalidInput where there are any: those of the file ``first``, then by the files
        as they were met, and by line."""
        files = [first, *(fault.file for fault in self.reported)]
        if self:
            order = sorted(self.reported, key=lambda f: (files.index(f.file), f.line, f.column))
            raise InvalidInput(order)

    def __bool__(self) -> bool:
        return bool(self.reported)


def _cut(text: str, longest: int) -> str:
    """Both ends of a text that is too long to be read."""
    if len(text) <= longest:
        return text
    return f"{text[: longest // 2]} … {text[-longest // 2 :]}"
