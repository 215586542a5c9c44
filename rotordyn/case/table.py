"""Read a table of a support over speed from a CSV file into the keys that it replaces.

The first line names the columns, each with its unit: ``speed [rpm], stiffness.yy [N/um],
damping.yy [N s/m]``, between commas, semicolons or tabs. Further lines hold plain numbers; empty
lines and those that begin with ``#`` are passed over. Every value keeps its place in that file.
"""

from __future__ import annotations

import re
from pathlib import Path

from rotordyn.case.document import read_text, shown
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.override import apply
from rotordyn.delimited import Row
from rotordyn.delimited import rows as rows_of
from rotordyn.errors import Fault, InvalidInput

_HEAD = re.compile(r"\s*(speed|(stiffness|damping)\.(\w+))\s*\[([^\]]+)\]\s*")
_ALLOWED = "speed [rpm], stiffness.yy [N/um], damping.yy [N s/m] and other entries"


def tabled(support: Node, path: Path, faults: Faults, contents: dict[Path, bytes]) -> None:
    """Put the columns of the CSV file at ``path`` into the support that names it as its table."""
    text = read_text(path, faults, contents)
    if text is None:
        return
    file = shown(path)
    try:
        rows = rows_of(text)
    except InvalidInput as error:
        faults.add(Fault(file, 0, 0, "", str(error)))
        return
    columns = _columns(rows, file, faults)
    for column, (way, unit) in enumerate(columns):
        cells = [
            Node(f"{row[column].strip()} {unit}", file, line, column + 1, raw=row[column].strip())
            for line, row in rows[1:]
        ]
        *above, key = way
        if {key, "dof", "matrix"} & {*support.entries(*above)}:
            given = ".".join(way)
            faults.at(support.at("table"), f"both in the table and outside it: given {given}")
        elif isinstance(support.at(*above).value, dict):  # else reported by the schema
            apply({".".join(way): Node(cells, file, rows[0][0], column + 1)}, support, faults)


def _columns(rows: list[Row], file: str, faults: Faults) -> list[tuple[tuple[str, ...], str]]:
    """Path of the key and unit of every column; empty if the file is not a table."""
    if not rows:
        faults.add(Fault(file, 0, 0, "", f"holds no table: allowed: columns {_ALLOWED}"))
        return []
    line, head = rows[0]
    wrong: list[Fault] = []
    columns: list[tuple[tuple[str, ...], str]] = []
    for column, name in enumerate(head, start=1):
        match = _HEAD.fullmatch(name)
        if match is None:
            message = f"not a column of a table: given '{name.strip()}'; allowed: {_ALLOWED}"
            wrong.append(Fault(file, line, column, "", message))
            continue
        whole, which, entry, unit = match.groups()
        way = ("speeds",) if whole == "speed" else (str(which), str(entry))
        if way in [known for known, _ in columns]:
            wrong.append(Fault(file, line, column, "", f"column repeated: given '{whole}'"))
        columns.append((way, unit.strip()))
    if not wrong and ("speeds",) not in [way for way, _ in columns]:
        wrong.append(Fault(file, line, 1, "", "column missing: 'speed [rpm]' must be given"))
    for where, row in rows[1:]:
        if len(row) != len(head):
            message = f"not as many values as columns: given {len(row)} for {len(head)}"
            wrong.append(Fault(file, where, 1, "", message))
    for fault in wrong:
        faults.add(fault)
    return [] if wrong else columns
