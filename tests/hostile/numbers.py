"""No number without a word: where results are NaN or infinite, and what they say of that.

A place of a quantity is explained by an outcome, a state or an absence of the same result (a text
over some of its dimensions that is not empty there), or by what is declared of the quantity, which
goes with its data: then it must be just where that says.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.report.datasets import result_of
from rotordyn.report.netcdf import read_results
from rotordyn.report.variables import as_array
from rotordyn.results.declaration import Absence, declared

Flags = NDArray[np.bool_]
_NAN = re.compile(r"(?<![\w.])[-+]?(nan|inf)(?![\w.])", re.IGNORECASE)
ROUNDING = 1e-9  # of a damping ratio: less is none
OUTCOMES = ("outcome", "state", "absence")


def words_of_nan(folder: Path) -> str:
    """What the results in a folder leave unexplained, and what its summary says that is no number;
    empty where there is nothing of that."""
    path, words = folder / "summary.txt", without_a_word(folder)
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else ():
        if found := _NAN.search(line):
            words.append(f"{path.name}: {found[0]} in {line[:200]!r}")
    return "\n".join(words)


def without_a_word(folder: Path) -> list[str]:
    """What the results in a folder leave unexplained, a sentence for each quantity."""
    path = folder / "results.nc"
    if not path.exists():
        return []
    groups = read_results(path)
    return [
        f"{name}: {fault}"
        for name in groups
        for fault in unexplained(result_of(name.rpartition("/")[2], groups[name]))
    ]


def unexplained(result: Any) -> Iterator[str]:
    """The same of one result."""
    for name, field in declared(result).items():
        values = as_array(getattr(result, name))
        if values.dtype.kind not in "fc":
            continue
        told = _told(result, field.metadata["dims"], values.shape)
        endless = np.isinf(values)
        for word, odd in (("absent", np.isnan(values) & ~endless), ("infinite", endless)):
            left = odd & ~told
            for each in field.metadata.get(word, ()):
                left &= ~_where(result, field.metadata["dims"], each, odd | told)
            if left.any():
                place = tuple(int(k) for k in np.argwhere(left)[0])
                yield f"{name} {word} at {int(left.sum())} of {left.size}, first at {place}"


def _told(result: Any, dims: tuple[str, ...], shape: tuple[int, ...]) -> Flags:
    """Where a text of the result says why there is no number."""
    told = np.zeros(shape, dtype=bool)
    for name, field in declared(result).items():
        if name.split("_")[-1] in OUTCOMES and {*field.metadata["dims"]} <= {*dims}:
            told |= _over(dims, field.metadata["dims"], as_array(getattr(result, name)) != "")
    return told


def _where(result: Any, dims: tuple[str, ...], said: Absence, odd: Flags) -> Flags:
    """Where a declared absence holds; ``odd``: no number, or told."""
    if said.beside:
        other = declared(result)[said.beside].metadata["dims"]
        return _over(dims, other, _nothing(as_array(getattr(result, said.beside))))
    if said.last:
        axis = dims.index(said.last)
        return np.flip(np.logical_and.accumulate(np.flip(odd, axis), axis), axis)
    axes = tuple(k for k, dim in enumerate(dims) if dim not in said.by)
    return np.broadcast_to(odd.all(axis=axes, keepdims=True), odd.shape)


def _nothing(values: NDArray[Any]) -> Flags:
    if values.dtype.kind in "US":
        return np.asarray(values == "")
    return np.asarray(~np.isfinite(values) | (np.abs(values) <= ROUNDING))


def _over(dims: tuple[str, ...], some: tuple[str, ...], flags: NDArray[Any]) -> Flags:
    """Flags over some dimensions, broadcast to all; over others of their own, any of them."""
    beyond = tuple(k for k, dim in enumerate(some) if dim not in dims)
    some = tuple(dim for dim in some if dim in dims)
    order = sorted(range(len(some)), key=lambda k: dims.index(some[k]))
    flags = np.transpose(np.asarray(flags).any(axis=beyond), order)
    shape = iter(flags.shape)
    return flags.reshape([next(shape) if dim in some else 1 for dim in dims])
