"""Values that make no sense as an argument, by name."""

from __future__ import annotations

import math
from datetime import date
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from tempfile import gettempdir
from typing import Any

import numpy as np

GONE = Path(gettempdir()) / "no such folder"


class _Odd:
    """Equal to nothing, not even to itself; a number only by what it says."""

    def __eq__(self, other: object) -> bool:
        return False

    __hash__ = None  # type: ignore[assignment]

    def __float__(self) -> float:
        return 1.0

    def __len__(self) -> int:
        return 3


NONSENSE: dict[str, Any] = {
    "None": None,
    "True": True,
    "nan": math.nan,
    "inf": math.inf,
    "-inf": -math.inf,
    "zero": 0,
    "negative": -1.0,
    "tiny": 5e-324,
    "huge": 1e308,
    "huge integer": 10**400,
    "negative huge integer": -(10**400),
    "fraction": Fraction(1, 3),
    "huge fraction": Fraction(10**400, 3),
    "decimal": Decimal("1e5000"),
    "signalling": Decimal("sNaN"),
    "complex": 1j,
    "0-d": np.array(1.0),
    "0-d text": np.array("y"),
    "0-d object": np.array(None, dtype=object),
    "empty array": np.zeros(0),
    "array": np.array([1.0, 2.0, 3.0]),
    "array of flags": np.array([True, False]),
    "array of nan": np.full((2, 2), math.nan),
    "big shape": np.broadcast_to(1.0, (7, 1, 3)),
    "array of text": np.array(["y", "z"]),
    "array of objects": np.array([{}, None], dtype=object),
    "masked": np.ma.masked,
    "numpy integer": np.int64(-3),
    "float16": np.float16(math.inf),
    "date of numpy": np.datetime64("2024-01-01"),
    "empty text": "",
    "text": "nonsense",
    "number as text": "1",
    "quantity": "1 mm",
    "other quantity": "1e400 rpm",
    "nul": "\0",
    "surrogate": "\ud800",
    "long text": "y" * 100_000,
    "digits": "9" * 10_000,
    "arabic digits": "١٢",
    "bytes": b"y",
    "empty list": [],
    "list": [1.0, None, "x"],
    "ragged list": [[1.0], [1.0, 2.0]],
    "nested list": [[[[[[1.0]]]]]],
    "list of itself": [],
    "tuple of text": ("y", "y"),
    "set": {1.0},
    "mapping": {"a": 1.0},
    "mapping of odd keys": {1: None, None: (), math.nan: []},
    "range": range(3),
    "generator": None,
    "function": len,
    "class": int,
    "module": math,
    "object": None,
    "odd": None,
    "exception": ValueError("x"),
    "path": GONE,
    "date": date(2024, 1, 1),
    "slice": slice(None),
    "ellipsis": ...,
}  # fmt: skip
NONSENSE["list of itself"].append(NONSENSE["list of itself"])
_MADE = {"generator": lambda: iter([1.0, 2.0]), "object": object, "odd": _Odd}


def nonsense(name: str) -> Any:
    """A value by its name, made again where a call would use it up."""
    return _MADE[name]() if name in _MADE else NONSENSE[name]
