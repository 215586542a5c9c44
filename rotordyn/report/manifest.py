"""The record of a run, ``run.json``: its inputs and outcomes, accuracy, and times."""

from __future__ import annotations

import json
import math
import platform
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

import rotordyn
from rotordyn.errors import InvalidInput
from rotordyn.report.folder import MARKER, RECORD, record_in

FORMAT = 2
_LIBRARIES = (
    "numpy",
    "scipy",
    "xarray",
    "h5py",
    "matplotlib",
    "pyuff",
    "meshio",
)


@dataclass(frozen=True, slots=True)
class RunRecord:
    """Record of a run besides its results.

    ``digest``: hash of all ``inputs`` read. ``outcomes``: analysis -> outcome word -> speeds [rpm]
    with it. ``tolerances``: name -> the residual reached. ``stages`` and ``figures``: seconds.
    ``skipped``: stages and files not made -> why. ``warnings``, ``notes``, ``unsolved``: sentences.
    ``ended``: the run was ended before all was solved.
    """

    case: str
    digest: str
    inputs: tuple[str, ...] = ()
    title: str = ""
    settings: Mapping[str, Any] = field(default_factory=dict)
    outcomes: Mapping[str, Mapping[str, list[float]]] = field(default_factory=dict)
    tolerances: Mapping[str, float] = field(default_factory=dict)
    stages: Mapping[str, float] = field(default_factory=dict)
    figures: Mapping[str, float] = field(default_factory=dict)
    skipped: Mapping[str, str] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    unsolved: tuple[str, ...] = ()
    ended: bool = False


def versions() -> dict[str, str]:
    """Python, platform, rotordyn and the libraries this process has loaded."""
    base = {
        "python": platform.python_version(),
        "platform": f"{sys.platform} {platform.machine()}",
        "rotordyn": rotordyn.__version__,
    }
    loaded = {name: sys.modules[name] for name in _LIBRARIES if name in sys.modules}
    return base | {n: str(getattr(m, "__version__", "unknown")) for n, m in loaded.items()}


def outcomes(results: Mapping[str, Any]) -> dict[str, dict[str, list[float]]]:
    """For each analysis: every outcome word and the speeds [rpm] that ended with it."""
    table: dict[str, dict[str, list[float]]] = {}
    for name, result in results.items():
        speeds: dict[str, list[float]] = table.setdefault(name, {})
        for speed, word in zip(result.speed, result.outcome, strict=True):
            for text in sorted(set(map(str, np.ravel(word)))):
                speeds.setdefault(text, []).append(round(float(speed) * 30.0 / math.pi, 3))
    return table


def content(record: RunRecord, files: Iterable[str]) -> dict[str, Any]:
    """The record as plain values, ready for JSON; ``files`` are those of the results folder."""
    entries = {f.name: getattr(record, f.name) for f in fields(record)}
    head = {MARKER: FORMAT, "versions": versions(), "files": sorted({*files, RECORD})}
    return {key: _plain(value) for key, value in (head | entries).items()}


def write_record(folder: Path, record: RunRecord) -> None:
    """Write the record into ``folder``, listing the files that are there; do it last."""
    files = [p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()]
    text = json.dumps(content(record, files), indent=1, ensure_ascii=False, allow_nan=False)
    (folder / RECORD).write_text(text + "\n", encoding="utf-8")


def read_record(folder: Path) -> dict[str, Any]:
    """The record in ``folder`` as plain values.

    Raises
    ------
    InvalidInput : there is none, or another version wrote it in another form
    """
    record = record_in(folder)
    if record is None:
        raise InvalidInput(
            f"{str(folder)[:300]} is no results folder: it holds no {RECORD} of rotordyn"
        )
    versions = record.get("versions")
    version = isinstance(versions, dict) and versions.get("rotordyn")
    if record[MARKER] != FORMAT:
        raise InvalidInput(
            f"{folder} was written by rotordyn {version or 'of another version'} in a form that "
            f"rotordyn {rotordyn.__version__} does not read: run the case again"
        )
    if not (version and _complete(record)):
        raise InvalidInput(f"{folder / RECORD} is damaged: run the case again")
    return record


def _complete(record: Mapping[str, Any]) -> bool:
    """Whether a record has the fields that are read: texts, and lists of texts."""
    texts = [record.get(name) for name in ("case", "title", "digest")]
    texts += record["versions"].values()
    for name in ("inputs", "warnings", "notes", "unsolved"):
        listed = record.get(name)
        texts += listed if isinstance(listed, list) else [None]
    return all(isinstance(text, str) for text in texts)


def _plain(value: Any) -> Any:
    """Convert a value for JSON: numbers that are not finite become words, others six digits."""
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [_plain(v) for v in value]
    if isinstance(value, bool | int | str) or value is None:
        return value
    if isinstance(value, float) or hasattr(value, "__float__"):
        number = float(value)
        return float(f"{number:.6g}") if math.isfinite(number) else str(number)
    return str(value)
