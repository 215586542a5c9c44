"""Pack the data of charts: JSON text followed by numbers as 32-bit arrays, compressed.

Browsers decompress it (``DecompressionStream``: Chrome 80, Firefox 113, Safari 16.4). An array is
written in the text as ``{"$": kind, "at": byte, "n": length, "w": [row, …]}``.
"""

from __future__ import annotations

import base64
import gzip
import json
import math
import struct
from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np

from rotordyn.page.blocks import Markup

LEVEL = 4  # of compression: level 6 takes half as long again and saves 4 %


def packed(content: Any) -> str:
    """Pack lists, mappings, numbers, texts and arrays as base64 of compressed bytes.

    Texts other than ``Markup`` are escaped, as plotly.js interprets entities.
    """
    numbers = bytearray()
    text = json.dumps(_plain(content, numbers), ensure_ascii=False, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    return compressed(struct.pack("<I", len(text)) + text + bytes(numbers))


def compressed(raw: bytes) -> str:
    """Compress bytes with gzip as base64; deterministic."""
    return base64.b64encode(gzip.compress(raw, LEVEL, mtime=0)).decode("ascii")


def _plain(value: Any, numbers: bytearray) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(each, numbers) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return _array(value, numbers)
    if isinstance(value, list | tuple):
        return [_plain(each, numbers) for each in value]
    if isinstance(value, str):
        return str(value) if isinstance(value, Markup) else escape(value, quote=False)
    if isinstance(value, bool | int) or value is None:
        return value
    number = float(value)
    return float(f"{number:.7g}") if math.isfinite(number) else None


def _array(values: np.ndarray[Any, Any], numbers: bytearray) -> Any:
    if values.dtype.kind in "US":
        return [escape(str(each), quote=False) for each in values.ravel()]
    whole = values.dtype.kind in "iub"
    kept = np.ascontiguousarray(values, "<i4" if whole else "<f4")
    if not whole:
        kept = np.where(np.isfinite(kept), kept, np.float32(np.nan))  # an infinite peak is a gap
    at = len(numbers)
    numbers += kept.tobytes()
    return {"$": "i" if whole else "f", "at": at, "n": kept.size, "w": list(kept.shape)}


def rounded(values: np.ndarray[Any, Any], bits: int = 15) -> np.ndarray[Any, Any]:
    """Round ``values`` to 32-bit numbers with ``bits`` binary digits, which compress to about half.

    The relative error is at most 2^(−bits), 3e-5.
    """
    kept = np.asarray(values, np.float32).view(np.uint32)
    drop = 23 - bits
    half = np.uint32(1 << (drop - 1))
    even = (kept + half) & np.uint32(0xFFFFFFFF << drop & 0xFFFFFFFF)
    finite = np.isfinite(np.asarray(values, np.float32))
    return np.where(finite, even, kept).astype(np.uint32).view(np.float32)
