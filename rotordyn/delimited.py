"""Tables in text files, delimited by commas, semicolons or tabs."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import NamedTuple

from rotordyn.errors import InvalidInput


class Row(NamedTuple):
    """Cells of a line of the file."""

    line: int
    cells: Sequence[str]


def rows(text: str) -> list[Row]:
    """Read the header and the rows; empty lines, comments (``#``) and a ``sep=;`` of spreadsheets
    are skipped.

    Raises
    ------
    InvalidInput : not a table
    """
    header = next((line for line in text.splitlines() if _holds([line])), "")
    separator = max(",;\t", key=header.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    try:
        return [Row(reader.line_num, row) for row in reader if _holds(row)]
    except csv.Error as error:
        raise InvalidInput(f"not a table: {error}") from None


def _holds(row: Sequence[str]) -> bool:
    return any(cell.strip() for cell in row) and not row[0].lstrip().startswith(("#", "sep="))
