"""Collects faults, each with the place in a file where it can be corrected."""

from __future__ import annotations

from rotordyn.case.node import UNKNOWN, Node, joined
from rotordyn.errors import Fault, InvalidInput, TooManyFaults, printable

MOST = 200  # faults, after which nothing more is read
LONGEST_PATH, LONGEST = 160, 700  # characters of a fault


class Faults:
    """Faults of one case in the order of discovery, without repetitions.

    ``variant``: name of the variant being read, empty for the case itself; messages on faults
    outside its own entry name it. ``count``: number of faults including repetitions, as in a model
    that two bearings name.
    """

    def __init__(self) -> None:
        self.reported: list[Fault] = []
        self.count = 0
        self.variant = ""

    def at(self, node: Node, message: str) -> None:
        """Report a fault of a value."""
        self.add(Fault(node.file, node.line, node.column, node.path, message))

    def at_key(self, node: Node, message: str) -> None:
        """Report a fault of a key itself, not of its value."""
        line, column = node.key or (node.line, node.column)
        self.add(Fault(node.file, line, column, node.path, message))

    def missing(self, node: Node, key: str | int, message: str) -> None:
        """Report a missing key, at the mapping that should contain it."""
        line, column = node.key or (node.line, node.column)
        self.add(Fault(node.file, line, column, joined(node.path, str(key)), message))

    def is_reported(self, node: Node) -> bool:
        """Whether a fault of this value is already reported."""
        position = node.file, node.line, node.column
        positions = ((fault.file, fault.line, fault.column) for fault in self.reported)
        return node.value is UNKNOWN or position in positions

    def add(self, fault: Fault) -> None:
        """Add ``fault`` on one line, unless it is already reported."""
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
        """Raise InvalidInput if there are faults, sorted by file (``first`` before others, in the
        order of discovery) and line."""
        files = [first, *(fault.file for fault in self.reported)]
        if self:
            order = sorted(self.reported, key=lambda f: (files.index(f.file), f.line, f.column))
            raise InvalidInput(order)

    def __bool__(self) -> bool:
        return bool(self.reported)


def _cut(text: str, longest: int) -> str:
    """Shorten a long text to its beginning and end."""
    if len(text) <= longest:
        return text
    return f"{text[: longest // 2]} … {text[-longest // 2 :]}"
