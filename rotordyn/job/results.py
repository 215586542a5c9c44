"""Results of a case: datasets by name, summary, warnings, figures, and saving."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from bearings.arguments import typed
from rotordyn.analyses.registry import analysis
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput, printable
from rotordyn.markup import preformatted, table

if TYPE_CHECKING:
    import xarray as xr

    from rotordyn.figures.draw import Figure, Pictures
    from rotordyn.results.interval import Interval

DATE = "%Y-%m-%d %H:%M UTC"


class Part(NamedTuple):
    """One machine of a case, and its results by the name of the analysis."""

    case: Case
    results: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Origin:
    """Provenance of a run: versions of programs, date, digest of its input."""

    versions: Mapping[str, str] = field(default_factory=dict)
    date: str = ""
    digest: str = ""
    inputs: Sequence[str] = ()


def inputs_of(case: Case) -> tuple[str, ...]:
    """Files read, each by its folder and name."""
    return tuple(printable("/".join(path.absolute().parts[-2:])) for path in case.files)


class Results(Mapping[str, "xr.Dataset"]):
    """Results of a case: a mapping from the name of an analysis to its xarray Dataset.

    The names are those in the case, such as ``"campbell"``; with variants ``"variant/campbell"``.
    Datasets are in SI units with the unit of every variable in its attributes; complex quantities
    are complex. Each is made at first access.

    ``rotordyn.run`` solves a case and returns this; ``rotordyn.open`` reads it from a folder.
    """

    @property
    @abstractmethod
    def case(self) -> Case:
        """The case that was solved; raises InvalidInput if a folder holds no readable one."""

    @property
    @abstractmethod
    def summary(self) -> str:
        """Summary of the run in plain text, as in ``summary.txt``."""

    @property
    @abstractmethod
    def warnings(self) -> tuple[str, ...]:
        """Warnings, a sentence each; preceded by the variant if there are any."""

    @property
    @abstractmethod
    def notes(self) -> tuple[str, ...]:
        """Notes on choices that affect how results are read, a sentence each."""

    @property
    @abstractmethod
    def held_intervals(self) -> Mapping[str, Interval]:
        """Interval of each part by its name; empty if the run was without intervals."""

    @property
    def intervals(self) -> dict[str, xr.Dataset]:
        """Intervals of the results by variant ("" without variants)."""
        from rotordyn.report.datasets import dataset

        return {part: dataset(interval) for part, interval in self.held_intervals.items()}

    @property
    def interval(self) -> xr.Dataset:
        """Interval of the results: ranges of numbers and curves over the uncertainties.

        Raises
        ------
        InvalidInput : the case was run without ``interval=True`` (``--interval``), or has variants
        """
        intervals = self.intervals
        if "" not in intervals:
            instead = (
                "each variant has its own in intervals" if intervals else "run the case with it"
            )
            raise InvalidInput(f"no interval of the whole case: {instead}")
        return intervals[""]

    @property
    @abstractmethod
    def unsolved(self) -> tuple[str, ...]:
        """Why speeds, or whole variants, have no solution; empty where everything was solved."""

    @property
    @abstractmethod
    def origin(self) -> Origin:
        """Versions, date and digest of the run."""

    def report(self, path: str | Path) -> Path:
        """Write one self-contained HTML page that opens without network; return its path.

        Needs the package plotly (extra ``report``).

        Raises
        ------
        InvalidInput : the page cannot be written; the case of an opened folder cannot be read
        """
        from rotordyn.job.pages.whole import write_page

        write_page(Path(path), self)
        return Path(path)

    @abstractmethod
    def save(self, folder: str | Path) -> Path:
        """Write the folder that ``rotordyn run`` writes, completely or not at all; return its path.

        The path is ``folder_2`` if a file of ``folder`` is open in another program (Windows).

        Raises
        ------
        OutputRefused : ``folder`` holds something that is not a results folder
        InvalidInput : the folder cannot be created
        """

    @property
    @abstractmethod
    def parts(self) -> dict[str, Part]:
        """Machines by the name of their folder: "" without variants."""

    @abstractmethod
    def _dataset(self, name: str) -> xr.Dataset:
        """Make the dataset of a name among ``_names``."""

    @abstractmethod
    def _names(self) -> tuple[str, ...]:
        """Names of the datasets, in order."""

    @abstractmethod
    def _heading(self) -> tuple[str, str]:
        """Name and title of the case."""

    @cached_property
    def _made(self) -> dict[str, xr.Dataset]:
        return {}

    def __getitem__(self, name: str) -> xr.Dataset:
        if name not in self._names():
            raise KeyError(f"no results {name}: there are {', '.join(self._names())}")
        if name not in self._made:
            self._made[name] = self._dataset(name)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names())

    def __len__(self) -> int:
        return len(self._names())

    def __contains__(self, name: object) -> bool:
        return name in self._names()

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of the figures that ``plot`` draws, as those of the files in a results folder."""
        apart = [name for each in self.pictures() for name in each.names]
        return tuple(sorted([*self.drawings(), *apart]))

    @typed(InvalidInput)
    def plot(self, name: str = "") -> Figure:
        """Draw the figure ``name`` of ``figures``, such as ``"campbell"``.

        The matplotlib Figure belongs to the caller: notebooks show it, ``savefig`` writes it.
        pyplot, its backend and rcParams are neither used nor changed.

        Raises
        ------
        InvalidInput : there is no figure of that name (the message lists all), the case of an
            opened folder cannot be read, or nothing can be drawn in space on this computer
        """
        from rotordyn.figures.draw import drawn

        drawings = self.drawings()
        if name in drawings:
            return drawn(drawings[name])
        for each in self.pictures():
            if name in each.names:
                with each as running:
                    return running.figure(name)
        wanted = f"no figure {name:.60}" if name else "plot takes the name of a figure"
        raise InvalidInput(f"{wanted}: there are {', '.join(self.figures) or 'none'}")

    def drawings(self) -> dict[str, Callable[[], Figure]]:
        """Drawing functions by the name of the figure; nothing is drawn yet."""
        from rotordyn.job.figures import comparison_figures, figures, interval_figures
        from rotordyn.job.side_by_side import scale_of

        parts = self.parts
        sure = interval_figures(parts, self.held_intervals)
        if "" in parts:
            return dict([*figures(*parts[""]), *sure])
        scale = scale_of([part.case for part in parts.values()])
        return dict([*comparison_figures(list(parts.values()), self.case.title, scale), *sure])

    def pictures(self, beside: Path | None = None) -> list[Pictures]:
        """Figures drawn by another process, which starts when their context is entered.

        Its files are written to ``beside``, or to the folder for temporary files.
        """
        drawn = []
        for name in dict.fromkeys(name for part in self.parts.values() for name in part.results):
            made = analysis(name).pictures
            if made is not None:
                parts = self.parts.items()
                by_part = {
                    k: (case, results[name]) for k, (case, results) in parts if name in results
                }
                drawn.append(made(by_part, beside))
        return drawn

    def __repr__(self) -> str:
        (name, title), names = self._heading(), ", ".join(self._names())
        words = [f"<Results of {name}" + (f" ({title})" if title else ""), f"{names}"]
        counted = (("warning", self.warnings), ("reason for no solution", self.unsolved))
        ends = [f"{len(each)} {word}{'s' * (len(each) > 1)}" for word, each in counted if each]
        return "; ".join([": ".join(words), *ends]) + ">"

    def _repr_html_(self) -> str:
        """A short table that notebooks show, the summary folded below it."""
        name, title = self._heading()
        rows = [("case", name), ("results", ", ".join(self._names()))]
        listed = (("warning", self.warnings), ("not solved", self.unsolved), ("note", self.notes))
        rows += [(word, sentence) for word, sentences in listed for sentence in sentences]
        return table(title or name, rows) + preformatted("summary", self.summary)
