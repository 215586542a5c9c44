"""What an analysis declares, once, in the ``__init__`` of its folder: ``ANALYSIS = in_folder(…)``.

To add an analysis:

1. ``spec.py``: a frozen ``Spec`` (``scene.spec``) in SI, the input of the analysis: its fields are
   the keys of files, its rules those of the analysis. It imports nothing heavy.
2. ``result.py``: a frozen dataclass whose fields are declared with ``coordinate`` and ``quantity``
   (``results.declaration``); a field ``speed`` and an ``outcome`` that says why values are missing.
   Datasets and ``results.nc`` follow from the declaration.
3. ``solve.py``: ``solve(scene, spec)`` for a spindle, for a single bearing
   ``solve(bearing, conditions, speed, spec)``; gives the result.
4. ``tables.py``: a ``Layout`` for every CSV table.
5. ``summary.py``: its lines of the summary, its headline numbers, its accuracy, its warnings.
6. ``figures/``: ``__init__`` says which figures a result has, further files draw them; only
   these import matplotlib. The main figure is drawn onto axes that its function is given.
7. ``known.py``: values to compare with published and measured ones.
8. ``page.py``: blocks of an HTML page besides curves and headline numbers.
9. The record in ``__init__.py``: ``in_folder(__name__, …)`` for code in the files above, under the
   names of ``PLACES``. Code is named by text, ``Code(__name__, "uff:files")``, and imported when it
   is first called: reading a case imports specs alone.

An analysis of another package is found by its entry point in the group ``rotordyn.analyses``: its
name, and ``package.module:ANALYSIS``. An analysis never imports another one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol

from rotordyn.results.layout import Layout, Table
from rotordyn.scene.spec import Spec

if TYPE_CHECKING:
    from rotordyn.figures.draw import Pictures
    from rotordyn.page.blocks import Block
    from rotordyn.results.headline import Curve, Number

File = tuple[str, Callable[[], object]]


class Result(Protocol):
    """Declared arrays over ``speed``; ``outcome`` says why values are missing."""

    @property
    def speed(self) -> Any: ...
    @property
    def outcome(self) -> Any: ...


@dataclass(frozen=True, slots=True)
class Code:
    """A function named ``"module:function"`` in a package, imported when it is first called."""

    package: str
    path: str

    def __call__(self, *arguments: Any) -> Any:
        """Call the function."""
        module, _, name = self.path.partition(":")
        return getattr(import_module(f"{self.package}.{module}"), name)(*arguments)


def _nothing(*_: Any) -> tuple[Any, ...]:
    return ()


def _zero(*_: Any) -> float:
    return 0.0


def _no(*_: Any) -> bool:
    return False


def _same(spec: Any) -> Any:
    return spec


@dataclass(frozen=True, slots=True, kw_only=True)
class Analysis:
    """Record of an analysis; a ``case`` is given as ``results.described.Described``.

    ``name``: in cases and results. ``machine``: what it analyses. ``spec``: class of its input.
    ``place``: its order in lists, summaries and tables. ``bearings``: it needs a spindle with
    bearings. ``solve``: from the scene (or the bearing) and the spec to the result.

    Before it is solved:

    - ``highest(spec, top)``: highest frequency it needs [Hz], ``top`` the fastest rotor [rad/s];
    - ``forced``: forces act up to that frequency, at which elements must be accurate;
    - ``over_time(spec)``: motion is followed over time from rest on, finite also without
      damping;
    - ``unsteady``: it has a result also where no speed has a steady state;
    - ``ports(spec)``: points and stations [m] where forces act or responses are read;
    - ``marks(spindle, spec)``: the spindle with what the spec mounts on it.

    From a result:

    - ``figures(case, result, results)``: pairs of name and function that draws, ``results`` all of
      the case; ``costs``: of figures that take long; the highest are drawn first;
    - ``tables``, and ``further_tables(result)``: tables without a layout;
    - ``files(folder, case, result)``: further files, pairs of name and function that writes;
      one whose package is missing, or that raises ``LeftOut``, is omitted with a note;
    - ``pictures(parts, beside)``: pictures that another process renders meanwhile, a context
      (``figures.draw.Pictures``); ``parts``: case and result by folder; ``beside``: where its files
      may be, None for the system's folder of temporary files;
    - ``summary(result)``: lines; ``accuracy(result)``: phrases; ``warnings(result)``: sentences.

    Variants are compared by what these declare, without further code:

    - ``panels(spec, variants)``: figures drawn small, once for each variant (``figures.panels``);
    - ``curves(spec, variant)``: headline curves (``results.headline.Curve``) of one variant
      (``results.described.Shown``), overlaid with those of the others;
    - ``numbers(result, case)``: headline numbers (``results.headline.Number``), a row of the table
      under ``heading``; ``over``: the coordinate of their speeds;
    - ``lacking(result)``: headline numbers, NaN, that other machines have and this one has not;
      ``missing_entries(result)``: coordinates of words, and entries that other machines have.

    An HTML page shows, in a section named ``title`` (by default its name):

    - ``page(spec, variants)``: blocks (``page.blocks``) made of the variants of a case, or of its
      only machine (``results.described.Shown``). Without it: its ``curves``, or, without any,
      its declared quantities over speed.

    Many machines are solved for these numbers and curves alone (intervals):

    - ``lean(spec)``: a spec that costs less and gives the same numbers and curves;
    - ``speeds(spec)``: speeds [rad/s] at which they are needed, besides the first and the last.

    For comparison with published or measured values:

    - ``known(reference, result, spindle)``: values (SI) to compare with a reference, NaN at speeds
      without one, or None for a reference of other quantities.
    """

    name: str
    machine: Literal["spindle", "bearing"]
    spec: type[Spec]
    solve: Callable[..., Result]
    place: int = 100
    bearings: bool = False
    highest: Callable[[Any, float], float] = _zero
    forced: bool = False
    over_time: Callable[[Any], bool] = _no
    unsteady: bool = False
    ports: Callable[[Any], Iterable[str | float]] = _nothing
    marks: Callable[[Any, Any], Any] | None = None
    figures: Callable[[Any, Any, Any], Iterable[tuple[str, Callable[[], Any]]]] = _nothing
    panels: Callable[[Any, Any], Iterable[Any]] = _nothing
    curves: Callable[[Any, Any], Iterable[Curve]] = _nothing
    costs: Mapping[str, int] = field(default_factory=dict)
    tables: tuple[Layout, ...] = ()
    further_tables: Callable[[Any], Iterable[Table]] = _nothing
    files: Callable[[Path, Any, Any], Iterable[File]] = _nothing
    pictures: Callable[[Any, Path | None], Pictures] | None = None
    summary: Callable[[Any], Iterable[str]] = _nothing
    accuracy: Callable[[Any], Iterable[str]] = _nothing
    warnings: Callable[[Any], Iterable[str]] = _nothing
    heading: str = ""
    over: str = "speed"
    numbers: Callable[[Any, Any], Iterable[Number]] = _nothing
    lacking: Callable[[Any], Iterable[Number]] = _nothing
    missing_entries: Callable[[Any], Iterable[tuple[str, Sequence[str]]]] = _nothing
    lean: Callable[[Any], Any] = _same
    speeds: Callable[[Any], Iterable[float]] = _nothing
    known: Callable[[Any, Any, Any], Any] | None = None
    title: str = ""
    page: Callable[[Any, Any], Iterable[Block]] | None = None


PLACES = {
    "solve": "solve:solve",
    "figures": "figures:figures",
    "panels": "figures:panels",
    "curves": "figures:headline_curves",
    "summary": "summary:summary",
    "accuracy": "summary:accuracy",
    "warnings": "summary:warnings",
    "numbers": "summary:numbers",
    "lacking": "summary:lacking",
    "missing_entries": "summary:missing_entries",
    "known": "known:known",
    "page": "page:page",
}


def in_folder(package: str, *also: str, **declared: Any) -> Analysis:
    """The analysis whose folder is ``package``, which gives its name. Its code is at ``PLACES``:
    solver, figures, curves and summary, numbers where it has a ``heading``, and the parts named
    by ``also``. ``declared``: further fields of ``Analysis``."""
    parts = (
        "solve",
        "figures",
        "curves",
        "summary",
        *("numbers",) * ("heading" in declared),
        *also,
    )
    code = {part: Code(package, PLACES[part]) for part in parts}
    return Analysis(name=package.rpartition(".")[2], **{**code, **declared})
