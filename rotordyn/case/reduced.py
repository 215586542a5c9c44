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
    from rotordyn.case.reduced_files import from_archive, from_market

    named, places = {"": reference}, tuple[str, ...]()
    if isinstance(reference.value, dict):
        before = len(files.faults.reported)
        listed = reading.value(ModelFiles, reference)
        if len(files.faults.reported) > before:
            return None
        places = listed.places
        named = {key: reference.at(key) for key in ("mass", "stiffness", "damping")}
        named = {key: node for key, node in named.items() if getattr(listed, key)}
    elif not isinstance(reference.value, str):
        needed = "not a model: a .npz file or a mapping of files is needed"
        files.faults.at(reference, needed)
        return None
    raw: dict[str, bytes] = {}
    for key, node in named.items():
        path = files.beside(node)
        content = None if path is None else read_bytes(path, files.faults, files.contents)
        if content is None:
            return None
        raw[key] = content
    try:
        return from_market(raw, places) if places else from_archive(raw[""])
    except NoModel as error:
        files.faults.at(reference, f"no reduced model: {error}")
        return None
