"""Solve a study into its folder: points as they come, then dataset, table, summary, figures."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rotordyn.errors import InvalidInput
from rotordyn.figures.style import USUAL_FORMATS
from rotordyn.study.dataset import DATASET
from rotordyn.study.figures import figures
from rotordyn.study.point import Study
from rotordyn.study.solve import Progress, solved
from rotordyn.study.summary import SUMMARY, summary, write_points
from rotordyn.whole import whole_files

LEAST_ROOM = 1_000_000  # bytes of free disk space, beside the dataset


@dataclass(frozen=True, slots=True)
class Delivered:
    """Folder and summary of a study, number of its ``points`` and of those ``solved``."""

    folder: Path
    summary: str
    points: int
    solved: int


def deliver(
    study: Study,
    folder: Path,
    *,
    workers: int | None = None,
    cluster: str | None = None,
    progress: Progress = lambda done, of: None,
    yes: bool = False,
    draw: bool = True,
    formats: Sequence[str] = USUAL_FORMATS,
) -> Delivered:
    """Solve ``study`` and write its results into ``folder``.

    Raises
    ------
    InvalidInput : see ``sweep``, or the disk is full; the points that are solved stay in the folder
    """
    data, outcomes = solved(study, workers, cluster, folder, progress, yes=yes)
    text = summary(study, outcomes)
    try:
        _require_room(folder, 2 * data.nbytes + LEAST_ROOM)
        with whole_files(folder) as place:
            # NetCDF lists the names of such coordinates between spaces.
            spaced = [name for name in data.coords if " " in str(name) and name not in data.dims]
            data.reset_coords(spaced).to_netcdf(place / DATASET, engine="h5netcdf")
            write_points(place, study, outcomes)
            (place / SUMMARY).write_text(text + "\n", encoding="utf-8")
            if draw:
                from rotordyn.figures.draw import draw_one

                for name, drawing in figures(study, outcomes):
                    draw_one(name, drawing, place, formats)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror or error}") from None
    solved_points = sum(row.solved for row in outcomes.values())
    return Delivered(folder, text, study.design.count, solved_points)


def _require_room(folder: Path, size: int) -> None:
    """Raise OSError if the disk has no room: HDF5 would end the process on a full disk."""
    if shutil.disk_usage(folder).free < size:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
