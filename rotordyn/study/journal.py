"""Outcomes of a study on disk: a line of a ``record`` for each, and files of whole results."""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotordyn.errors import InvalidInput
from rotordyn.report.datasets import dataset
from rotordyn.report.netcdf import read_results, write_results
from rotordyn.study import record
from rotordyn.study.point import Outcome, Study

if TYPE_CHECKING:
    import xarray as xr

JOURNAL, RESULTS = "points.jsonl", "points"


def signature(study: Study) -> str:
    """Hash of all that decides the points and results of a study."""
    design = study.design
    shares = b"" if design.shares is None else design.shares.tobytes()
    case = replace(study.case, files=())
    text = repr((case, design.parameters, design.sampling, study.results)).encode()
    return hashlib.sha256(text + shares).hexdigest()


class Journal:
    """File of the outcomes of a study, and the files of results kept whole, in a folder."""

    def __init__(self, folder: Path, study: Study) -> None:
        self.folder, self.study, self._path = folder, study, folder / JOURNAL

    @property
    def begun(self) -> bool:
        """Whether the file exists."""
        return self._path.exists()

    def begin(self) -> dict[int, Outcome]:
        """Return the outcomes kept so far by point number; create the file where there is none.

        Outcomes whose whole results are missing on disk are left to be solved again.

        Raises
        ------
        InvalidInput : the folder holds another study, or something else; it cannot be written
        """
        lines = record.begun(self._path, "study", signature(self.study), "points")
        try:
            outcomes = dict(map(_read, lines))
        except (ValueError, KeyError, TypeError, AttributeError):
            raise record.unreadable(self._path, "points") from None
        kept_whole = self.study.results
        return {
            number: outcome
            for number, outcome in outcomes.items()
            if not (kept_whole and outcome.solved) or self._place(number).exists()
        }

    def add(self, outcome: Outcome) -> None:
        """Append an outcome; its results are written first, so that a line implies them."""
        if outcome.results:
            self._keep(outcome)
        line = {f.name: getattr(outcome, f.name) for f in fields(outcome) if f.name != "results"}
        record.add(self._path, {"point": line.pop("number"), **line})

    def withdraw(self) -> None:
        """Remove the outcomes and the folder."""
        shutil.rmtree(self.folder / RESULTS, ignore_errors=True)
        record.withdraw(self._path)

    @property
    def size(self) -> int:
        """Bytes used on disk."""
        results = (self.folder / RESULTS).glob("*.nc")
        return sum(path.stat().st_size for path in (self._path, *results))

    @property
    def room(self) -> int:
        """Bytes free on the disk."""
        return shutil.disk_usage(self.folder).free

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
        """Datasets kept whole of a point, from memory or from disk."""
        if outcome.results or not outcome.solved:
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
    number, sentence, warnings = int(entry["point"]), str(entry["sentence"]), entry["warnings"]
    error = None if entry["error"] is None else float(entry["error"])
    seconds, any_solved = float(entry["seconds"]), bool(entry.get("solved", numbers))
    return number, Outcome(number, numbers, sentence, tuple(warnings), seconds, error, any_solved)
