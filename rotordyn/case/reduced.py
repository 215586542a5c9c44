"""Reduced models of housings from files: numpy archives (.npz) or Matrix Market (.mtx), SI units.

An archive contains ``places`` with either ``mass``, ``stiffness`` (and ``damping``), n × n, or
``frequency`` [Hz], ``damping_ratio`` and ``shape`` (places × n) of modes of unit modal mass
[1/√kg]. With matrices, ``places`` names every coordinate, internal ones by an empty text.
"""

from __future__ import annotations

import io
import math
import zlib
from collections.abc import Mapping, Sequence
from typing import Any
from zipfile import BadZipFile, ZipFile

import numpy as np

from rotordyn.arrays import Array
from rotordyn.case.document import read_bytes
from rotordyn.case.keys import ModelFiles
from rotordyn.case.matrix_market import MarketFile
from rotordyn.case.node import Node
from rotordyn.case.reading import Reading
from rotordyn.quantity import DAMPING_RATIO, suggestion
from rotordyn.units import shown

Held = dict[str, Any]  # places, shape, mass, stiffness, damping
MOST = 400  # coordinates of a reduced model
MOST_BYTES = 16 * MOST * MOST  # of an array
_BROKEN = (BadZipFile, zlib.error, OverflowError, NotImplementedError, RuntimeError)
_MODAL = ("frequency", "damping_ratio", "shape")
_MATRICES = ("mass", "stiffness", "damping")
_KNOWN = ("places", *_MATRICES, *_MODAL)
_FORMS = f"places with mass, stiffness (and damping), or with {', '.join(_MODAL)}"


class NoModel(Exception):
    """A file contains no reduced model; the message gives the reason."""


def reduced_model(reference: Node, reading: Reading) -> Held:
    """Read a model from an archive or Matrix Market files as fields of ``ReducedHousing``; empty if
    it has faults, which are reported."""
    try:
        if isinstance(reference.value, dict):
            return _from_files(reference, reading)
        if isinstance(reference.value, str):
            content = _bytes(reference, reading)
            return {} if content is None else from_archive(content)
    except NoModel as error:
        reading.faults.at(reference, f"no reduced model: {error}")
        return {}
    reading.faults.at(reference, "not a model: a .npz file or a mapping of files is needed")
    return {}


def _from_files(reference: Node, reading: Reading) -> Held:
    before = reading.faults.count
    listed = reading.value(ModelFiles, reference)
    if reading.faults.count > before:
        return {}
    raw: dict[str, bytes] = {}
    for key in _MATRICES:
        if getattr(listed, key):
            content = _bytes(reference.at(key), reading)
            if content is None:
                return {}
            raw[key] = content
    return from_market(raw, listed.places)


def _bytes(reference: Node, reading: Reading) -> bytes | None:
    path = reading.files.beside(reference)
    return None if path is None else read_bytes(path, reading.faults, reading.files.contents)


def from_archive(raw: bytes) -> Held:
    """Read the model in a numpy archive; raises NoModel."""
    try:
        with np.load(io.BytesIO(raw), allow_pickle=False) as archive:
            for name in archive.zip.namelist():
                _require_small(name, archive.zip)
            arrays: dict[str, Any] = {name: archive[name] for name in archive.files}
    except (ValueError, OSError, EOFError, KeyError, TypeError, AttributeError, *_BROKEN):
        raise NoModel("is not a numpy archive (.npz) of plain arrays") from None
    for name in arrays:
        if name not in _KNOWN:
            hint = suggestion(name, _KNOWN)
            raise NoModel(f"unknown array: given {shown(name)}; allowed: {', '.join(_KNOWN)}{hint}")
    if "places" not in arrays:
        raise NoModel(_lacks("places", arrays))
    both = [[name for name in kind if name in arrays] for kind in (_MATRICES, _MODAL)]
    if all(both):
        matrices, modal = (", ".join(names) for names in both)
        raise NoModel(
            f"holds both matrices and modes: given {matrices} and {modal}; allowed: {_FORMS}"
        )
    places = [str(place) for place in np.atleast_1d(arrays["places"])]
    if any(name in arrays for name in _MODAL):
        return _from_modes(places, arrays)
    return from_matrices(places, arrays)


def _require_small(name: str, archive: ZipFile) -> None:
    """Raise NoModel if an array is too large for a reduced model, before it is read."""
    with archive.open(name) as member:
        version = np.lib.format.read_magic(member)
        read = (
            np.lib.format.read_array_header_1_0
            if version == (1, 0)
            else np.lib.format.read_array_header_2_0
        )
        shape, _, kind = read(member)
    size = math.prod(map(int, shape)) * kind.itemsize
    if min(shape, default=0) < 0 or size > MOST_BYTES:
        array = name.removesuffix(".npy")
        raise NoModel(
            f"{array} takes {size:.3g} bytes: allowed are up to {MOST_BYTES}, {MOST} coordinates"
        )


def from_market(raw: Mapping[str, bytes], places: Sequence[str]) -> Held:
    """Read the model in Matrix Market files, given by the names of the matrices; raises NoModel."""
    matrices: dict[str, Any] = {}
    for name, content in raw.items():
        try:
            file = MarketFile(content)
            rows, columns = file.shape
            if max(rows, columns) > MOST or file.entries > MOST * MOST:
                raise NoModel(
                    f"{name} has {rows} × {columns} places, {file.entries} entries: allowed are up "
                    f"to {MOST} coordinates; reduce it further"
                )
            matrices[name] = file.matrix()
        except (ValueError, LookupError):
            raise NoModel(f"{name} is not a Matrix Market file of real numbers") from None
    return from_matrices(list(places), matrices)


def from_matrices(places: list[str], given: Mapping[str, Any]) -> Held:
    """Build the model from its matrices; ``places`` names every coordinate; raises NoModel."""
    for name in ("mass", "stiffness"):
        if name not in given:
            raise NoModel(_lacks(name, given))
    n = len(places)
    if n > MOST:
        raise NoModel(f"has {n} coordinates: allowed are up to {MOST}; reduce it further")
    square = (n, n)
    matrices = {name: _real(name, given[name], square) for name in _MATRICES if name in given}
    used = [k for k, place in enumerate(places) if place]
    damping = matrices.get("damping", np.zeros(square))
    mass, stiffness = _positive(matrices["mass"]), matrices["stiffness"]
    return _held([places[k] for k in used], np.eye(n)[used], mass, stiffness, damping)


def _from_modes(places: list[str], given: Mapping[str, Any]) -> Held:
    for name in _MODAL:
        if name not in given:
            raise NoModel(_lacks(name, given))
    n = len(np.atleast_1d(given["frequency"]))
    if n > MOST:
        raise NoModel(f"has {n} modes: allowed are up to {MOST}")
    frequency = _real("frequency", np.atleast_1d(given["frequency"]), (n,))
    ratio = _real("damping_ratio", np.atleast_1d(given["damping_ratio"]), (n,))
    shape = _real("shape", given["shape"], (len(places), n))
    if (frequency < 0.0).any():
        raise NoModel(f"frequency below zero: given {frequency.min():g} Hz; allowed: from 0 Hz")
    for value in ratio:
        if refusal := DAMPING_RATIO.refusal(float(value)):
            raise NoModel(f"damping_ratio: {refusal}")
    omega = 2.0 * math.pi * frequency
    return _held(places, shape, np.eye(n), np.diag(omega**2), np.diag(2.0 * ratio * omega))


def _held(places: list[str], *matrices: Array) -> Held:
    rows = (tuple(map(tuple, matrix.tolist())) for matrix in matrices)
    return {"places": tuple(places), **dict(zip(("shape", *_MATRICES), rows, strict=True))}


def _real(name: str, value: Any, shape: tuple[int, ...]) -> Array:
    array = np.asarray(value)
    if array.shape != shape:
        given, wanted = (" × ".join(map(str, s)) or "one value" for s in (array.shape, shape))
        raise NoModel(
            f"{name} does not have the shape that its places need: given {given}; allowed: {wanted}"
        )
    if array.dtype.kind not in "iuf" or not np.isfinite(array).all():
        raise NoModel(f"{name} holds a value that is not a finite real number")
    return np.asarray(array, dtype=np.float64)


def _positive(mass: Array) -> Array:
    largest = np.abs(mass).max(initial=0.0)
    if np.abs(mass - mass.T).max(initial=0.0) > 1e-6 * largest:
        raise NoModel("mass is not symmetric")
    try:
        np.linalg.cholesky(mass)
    except np.linalg.LinAlgError:
        raise NoModel("mass is not positive definite; leave out coordinates without mass") from None
    return mass


def _lacks(name: str, given: Mapping[str, Any]) -> str:
    return f"lacks {name}: given {', '.join(given) or 'nothing'}; allowed: {_FORMS}"
