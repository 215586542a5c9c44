"""Outcomes on disk as they come, so that a study that was stopped goes on where it was.

A line of JSON for every point, in the order in which they were solved, below a line that says of
which study they are. A last line that was cut short is a point that was not solved. Floats are
written so that they are read back bit for bit.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import IO, TYPE_CHECKING, Any

from rotordyn.errors import InvalidInput
from rotordyn.report.datasets import dataset
from rotordyn.report.netcdf import read_results, write_results
from rotordyn.study.point import Outcome, Study

if TYPE_CHECKING:
    import xarray as xr

JOURNAL, RESULTS = "points.jsonl", "points"


def signature(study: Study) -> str:
    """What two studies have in common whose points are the same."""
    design = study.design
    shares = b"" if design.shares is None else design.shares.tobytes()
    case = replace(study.case, files=())
    words = repr((case, design.parameters, design.sampling, study.results)).encode()
    return hashlib.sha256(words + shares).hexdigest()


class Journal:
    """The outcomes in a folder; a context that holds the file open."""

    def __init__(self, folder: Path, study: Study) -> None:
        self.folder, self.study = folder, study
        self._head = {"study": signature(study), "points": study.design.count}
        self._file: IO[bytes] | None = None

    def __enter__(self) -> Journal:
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._file = (self.folder / JOURNAL).open("ab")
        except OSError as error:
            raise InvalidInput(f"{self.folder}: cannot be written: {error.strerror}") from None
        if self._file.tell() == 0:
            self._write(self._head)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        assert self._file is not None, "entered"
        self._file.close()

    def known(self) -> dict[int, Outcome]:
        """Outcomes kept so far, by the number of the point; what was cut short is cut away.

        Raises
        ------
        InvalidInput : they are of another study, or of none, or cannot be read
        """
        path = self.folder / JOURNAL
        try:
            if not path.is_file():
                self._require_free()
                return {}
            raw = path.read_bytes()
        except OSError as error:
            raise InvalidInput(f"{self.folder}: cannot be read: {error.strerror}") from None
        whole = raw[: raw.rfind(b"\n") + 1]
        lines = whole.splitlines()
        try:
            entries = [json.loads(line) for line in lines]
            if entries and entries[0] != self._head:
                raise InvalidInput(
                    f"{self.folder}: holds the points of another study ({entries[0]['points']} "
                    "points): choose another folder, or remove that one"
                )
            found = dict(map(_read, entries[1:]))
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            raise InvalidInput(f"{path}: is no record of a study: choose another folder") from None
        if len(whole) < len(raw):
            os.truncate(path, len(whole))
        return found

    def _require_free(self) -> None:
        if self.folder.exists() and any(self.folder.iterdir()):
            raise InvalidInput(
                f"{self.folder}: is a folder with other things in it, and no study: choose another"
            )

    def add(self, outcome: Outcome) -> None:
        """Keep an outcome; its results first, so that a line means all of it."""
        if outcome.results:
            self._keep(outcome)
        self._write(
            {
                "point": outcome.number,
                "numbers": outcome.numbers,
                "sentence": outcome.sentence,
                "warnings": outcome.warnings,
                "seconds": outcome.seconds,
                "error": outcome.error,
            }
        )

    def _write(self, entry: dict[str, Any]) -> None:
        assert self._file is not None, "entered"
        try:
            self._file.write(json.dumps(entry).encode() + b"\n")
            self._file.flush()
        except OSError as error:
            raise InvalidInput(f"{self.folder}: cannot be written: {error.strerror}") from None

    def _keep(self, outcome: Outcome) -> None:
        place = self._place(outcome.number)
        place.parent.mkdir(exist_ok=True)
        part = place.with_suffix(".part")
        write_results(part, outcome.results)
        part.replace(place)

    def _place(self, number: int) -> Path:
        return self.folder / RESULTS / f"{number:08d}.nc"

    def datasets(self, outcome: Outcome) -> dict[str, xr.Dataset]:
        """What is kept whole of a point, from memory or from disk."""
        if outcome.results or not outcome.numbers:
            return {name: dataset(each) for name, each in outcome.results.items()}
        return dict(read_results(self._place(outcome.number)))


def _read(entry: dict[str, Any]) -> tuple[int, Outcome]:
    numbers = {name: (float(v), str(unit)) for name, (v, unit) in entry["numbers"].items()}
    number = int(entry["point"])
    said = (str(entry["sentence"]), tuple(entry["warnings"]), float(entry["seconds"]))
    error = None if entry["error"] is None else float(entry["error"])
    return number, Outcome(number, numbers, *said, error)
