"""What a reduced model of a housing is, and which files hold it; how they are read:
``case.reduced_files``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from rotordyn.case.document import read_bytes
from rotordyn.case.expand import Reader
from rotordyn.case.keys import ModelFiles
from rotordyn.case.node import Node
from rotordyn.case.reading import Reading

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class NoModel(Exception):
    """A file that holds no reduced model; the message says why."""


@dataclass(frozen=True, eq=False, slots=True)
class ReducedModel:
    """Matrices (n, n) and ``shape`` (places, n), as in ``machine.housing.ReducedHousing``."""

    places: tuple[str, ...]
    shape: Array
    mass: Array
    stiffness: Array
    damping: Array


def reduced_model(reference: Node, reading: Reading, files: Reader) -> ReducedModel | None:
    """The model in an archive or in Matrix Market files; None where its faults are reported."""
    from rotordyn.case.reduced_files import from_archive

    try:
        if isinstance(reference.value, dict):
            return _from_files(reference, reading, files)
        if isinstance(reference.value, str):
            content = _bytes(reference, files)
            return None if content is None else from_archive(content)
    except NoModel as error:
        files.faults.at(reference, f"no reduced model: {error}")
        return None
    files.faults.at(reference, "not a model: a .npz file or a mapping of files is needed")
    return None


def _from_files(reference: Node, reading: Reading, files: Reader) -> ReducedModel | None:
    from rotordyn.case.reduced_files import from_market

    before = files.faults.count
    listed = reading.value(ModelFiles, reference)
    if files.faults.count > before:
        return None
    raw: dict[str, bytes] = {}
    for key in ("mass", "stiffness", "damping"):
        if getattr(listed, key):
            content = _bytes(reference.at(key), files)
            if content is None:
                return None
            raw[key] = content
    return from_market(raw, listed.places)


def _bytes(reference: Node, files: Reader) -> bytes | None:
    path = files.beside(reference)
    return None if path is None else read_bytes(path, files.faults, files.contents)
