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
from rotordyn.whole import locked

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
        self._lock: int | None = None

    def __enter__(self) -> Journal:
        path = self.folder / JOURNAL
        try:
            if not path.exists():
                self._require_free()
            self.folder.mkdir(parents=True, exist_ok=True)
            self._lock = self._locked()
            self._file = path.open("ab")
            raw = path.read_bytes()
            os.truncate(path, raw.rfind(b"\n") + 1)
        except OSError as error:
            raise InvalidInput(f"{self.folder}: cannot be written: {error.strerror}") from None
        if b"\n" not in raw:
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
        if self._lock is not None:
            os.close(self._lock)

    def _locked(self) -> int | None:
        try:
            return locked(self.folder)
        except BlockingIOError:
            raise InvalidInput(
                f"{self.folder}: another process solves the points of a study there: wait for it, "
                "or choose another folder"
            ) from None
        except OSError:  # a file system without locks
            return None

    def known(self) -> dict[int, Outcome]:
        """Outcomes kept so far, by the number of the point, those whose results are there.

        Raises
        ------
        InvalidInput : they are of another study, or of none
        """
        path = self.folder / JOURNAL
        try:
            entries = [json.loads(line) for line in path.read_bytes().splitlines()]
            if entries[0] != self._head:
                raise InvalidInput(
                    f"{self.folder}: holds the points of another study ({entries[0]['points']} "
                    "points): choose another folder, or remove that one"
                )
            found = dict(map(_read, entries[1:]))
        except (ValueError, KeyError, TypeError):
            raise InvalidInput(f"{path}: is no record of a study: choose another folder") from None
        whole = self.study.results
        return {
            number: each
            for number, each in found.items()
            if not (whole and each.numbers) or self._place(number).exists()
        }

    def _require_free(self) -> None:
        if self.folder.is_dir() and any(self.folder.iterdir()):
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
        part = place.with_suffix(".part")
        try:
            place.parent.mkdir(exist_ok=True)
            write_results(part, outcome.results)
            part.replace(place)
        except OSError as error:
            raise InvalidInput(f"{place}: cannot be written: {error.strerror}") from None

    def _place(self, number: int) -> Path:
        return self.folder / RESULTS / f"{number:08d}.nc"

    def datasets(self, outcome: Outcome) -> dict[str, xr.Dataset]:
        """What is kept whole of a point, from memory or from disk."""
        if outcome.results or not outcome.numbers:
            return {name: dataset(each) for name, each in outcome.results.items()}
        place = self._place(outcome.number)
        try:
            return dict(read_results(place))
        except OSError:
            raise InvalidInput(
                f"{place}: cannot be read: remove it, and the same study solves its point again"
            ) from None


def _read(entry: dict[str, Any]) -> tuple[int, Outcome]:
    numbers = {name: (float(v), str(unit)) for name, (v, unit) in entry["numbers"].items()}
    number = int(entry["point"])
    said = (str(entry["sentence"]), tuple(entry["warnings"]), float(entry["seconds"]))
    error = None if entry["error"] is None else float(entry["error"])
    return number, Outcome(number, numbers, *said, error)
