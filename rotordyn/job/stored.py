"""Results read from a results folder."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bearings.arguments import typed
from bearings.errors import BearingError
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.job.results import DATE, Origin, Part, Results
from rotordyn.job.solving import labelled

if TYPE_CHECKING:
    import xarray as xr

    from rotordyn.results.interval import Interval


@typed(InvalidInput)
def open(folder: str | Path) -> Results:
    """Open a folder that ``rotordyn run`` or ``Results.save`` has written.

    Datasets are read at first access, so the folder must not change until then. Warnings and notes
    are those of the run; ``plot`` draws figures again.

    Raises
    ------
    InvalidInput : not a results folder, or written by an older or newer version
    """
    return StoredResults(Path(folder))


class StoredResults(Results):
    """Results in a folder; see ``open``."""

    def __init__(self, folder: Path) -> None:
        from rotordyn.report.folder import CASE, RECORD
        from rotordyn.report.manifest import read_record
        from rotordyn.report.netcdf import read_results

        self._record = read_record(folder)
        self._folder = folder.resolve()
        try:
            for name in ("results.nc", "summary.txt", CASE):
                if not (folder / name).is_file():
                    raise FileNotFoundError(f"no file {name}")
            self._datasets = read_results(self._folder / "results.nc")
            self._summary = (folder / "summary.txt").read_text(encoding="utf-8").rstrip("\n")
            self._case_text = (folder / CASE).read_text(encoding="utf-8")
        except (OSError, ValueError) as error:
            raise InvalidInput(
                f"{folder} is incomplete although it has its {RECORD} ({error}): run the case again"
            ) from None

    @cached_property
    def case(self) -> Case:
        from rotordyn.case.archive import restored

        try:
            case = restored(json.loads(self._case_text))
            if not isinstance(case, Case):
                raise ValueError("it is none")
        except (InvalidInput, BearingError, ValueError, RecursionError) as error:
            by = self._record["versions"]["rotordyn"]
            raise InvalidInput(
                f"the case in {self._folder}, written by rotordyn {by}, cannot be read ({error}): "
                "load its file with rotordyn.load and run it"
            ) from None
        return case

    @property
    def summary(self) -> str:
        return self._summary

    @property
    def warnings(self) -> tuple[str, ...]:
        return tuple(self._record["warnings"])

    @property
    def notes(self) -> tuple[str, ...]:
        return tuple(self._record["notes"])

    @cached_property
    def held_intervals(self) -> Mapping[str, Interval]:
        from rotordyn.report.interval import kept

        return kept(self._folder)

    @property
    def origin(self) -> Origin:
        from rotordyn.report.folder import RECORD

        written = datetime.fromtimestamp((self._folder / RECORD).stat().st_mtime, UTC)
        record = self._record
        date = written.strftime(DATE)
        return Origin(record["versions"], date, record["digest"], record["inputs"])

    @property
    def unsolved(self) -> tuple[str, ...]:
        return tuple(self._record["unsolved"])

    @typed(InvalidInput)
    def save(self, folder: str | Path) -> Path:
        """Copy the folder, completely or not at all; see ``Results.save``.

        Raises
        ------
        OutputRefused : ``folder`` holds something that is not a results folder
        InvalidInput : the folder cannot be created
        """
        from rotordyn.report.folder import absolute, results_folder

        target = Path(folder)
        if absolute(target) == self._folder:
            return target
        paths = sorted(self._folder.rglob("*"))
        with results_folder(target) as place:
            for path in paths:
                copy = place.folder / path.relative_to(self._folder)
                if path.is_dir():
                    copy.mkdir()
                else:
                    shutil.copy2(path, copy)
        return place.target

    @cached_property
    def parts(self) -> dict[str, Part]:
        case = self.case
        if not case.variants:
            return {"": Part(case, _Read(self, ""))}
        solved = {name.partition("/")[0] for name in self}
        cases = labelled(case).items()
        return {
            name: Part(part_case, _Read(self, f"{name}/"))
            for name, part_case in cases
            if name in solved
        }

    def _names(self) -> tuple[str, ...]:
        return tuple(self._datasets)

    def _heading(self) -> tuple[str, str]:
        return self._record["case"], self._record["title"]

    def _dataset(self, name: str) -> xr.Dataset:
        return self._datasets[name]


class _Read(Mapping[str, Any]):
    """Results of one part, built from its datasets at first access."""

    def __init__(self, results: Results, prefix: str) -> None:
        self._results, self._prefix = results, prefix
        self._known: dict[str, Any] = {}

    def __iter__(self) -> Iterator[str]:
        start = len(self._prefix)
        return (name[start:] for name in self._results if name.startswith(self._prefix))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __contains__(self, name: object) -> bool:
        return f"{self._prefix}{name}" in self._results

    def __getitem__(self, name: str) -> Any:
        from rotordyn.report.datasets import result_of

        if name not in self._known:
            try:
                self._known[name] = result_of(name, self._results[f"{self._prefix}{name}"])
            except ValueError as error:
                raise InvalidInput(
                    f"{name} was written by another version of rotordyn ({error}): "
                    "run the case again to draw it"
                ) from None
        return self._known[name]
