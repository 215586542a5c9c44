"""What an analysis declares, once, in the ``__init__`` of its folder: ``ANALYSIS = in_folder(…)``.

To add an analysis:

1. ``spec.py``: a frozen ``Spec`` (``scene.spec``) in SI, what a case asks: its fields are the keys
   of files, its rules those of the analysis. It imports nothing heavy.
2. ``result.py``: a frozen dataclass whose fields are declared with ``coordinate`` and ``quantity``
   (``results.declaration``); a field ``speed`` and an ``outcome`` that says why values are missing.
   Datasets and ``results.nc`` follow from the declaration.
3. ``solve.py``: ``answer(scene, spec)`` for a spindle, for a single bearing
   ``answer(bearing, conditions, speed, spec)``; gives the result.
4. ``tables.py``: a ``Layout`` for every CSV table.
5. ``summary.py``: its lines of the summary, its headline numbers, what is said of its accuracy, its
   warnings.
6. ``figures/``: ``__init__`` says which figures a result has, further files draw them; only
   these import matplotlib. What draws the main figure does so onto axes that it is given.
7. ``known.py``: what may be compared with published and measured values.
8. ``page.py``: what an HTML page shows beyond curves and headline numbers.
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
    """An analysis; ``case`` is what ``results.described.Described`` says of a case.

    ``name``: in cases and results. ``machine``: what it is asked of. ``spec``: class of what a case
    asks. ``place``: among the others, in lists, summaries and tables. ``bearings``: it needs a
    spindle with bearings. ``solve``: from the scene (or the bearing) and the spec to the result.

    Before it is solved:

    - ``highest(spec, top)``: highest frequency asked for [Hz], ``top`` the fastest rotor [rad/s];
    - ``forced``: a force swings up to that frequency, which elements must carry;
    - ``over_time(spec)``: motion is followed over time from rest on, with a limit also where
      nothing damps it;
    - ``unsteady``: it has an answer also where no speed has a steady state;
    - ``ports(spec)``: points and stations [m] where forces act or responses are read;
    - ``marks(spindle, spec)``: the spindle with what the spec puts on it.

    What is made of a result:

    - ``figures(case, result, results)``: pairs of name and function that draws, ``results`` all of
      the case; ``costs``: of figures that take long, drawn first where the number is higher;
    - ``tables``, and ``further_tables(result)``: those that no layout gives;
    - ``files(folder, case, result)``: further files, pairs of name and function that writes;
      one that lacks a package of others, or raises ``LeftOut``, is left out with a note;
    - ``pictures(parts, beside)``: pictures that another process makes meanwhile, a context
      (``figures.draw.Pictures``); ``parts``: case and result by folder; ``beside``: where its files
      may stand, None for the system's place of such files;
    - ``summary(result)``: lines; ``accuracy(result)``: phrases; ``warnings(result)``: sentences.

    Variants are compared by what these declare, without further code:

    - ``panels(spec, variants)``: figures drawn small, once for each variant (``figures.panels``);
    - ``curves(spec, variant)``: headline curves (``results.headline.Curve``) of one variant
      (``results.described.Shown``), laid over those of the others;
    - ``numbers(result, case)``: headline numbers (``results.headline.Number``), a row of the table
      under ``heading``; ``over``: the speeds of the result that they are about;
    - ``lacking(result)``: headline numbers, NaN, that other machines have where this one has none;
      ``unlisted(result)``: coordinates of words, and the entries that others have.

    An HTML page shows of it, in a section named ``title`` (by default its name):

    - ``page(spec, variants)``: blocks (``page.blocks``) made of the variants of a case, or of its
      only machine (``results.described.Shown``). Where it is left out: its ``curves``, or, without
      any, its declared quantities over speed.

    Many machines are solved for these numbers and curves alone (intervals):

    - ``lean(spec)``: a spec that costs less and gives the same numbers and curves;
    - ``speeds(spec)``: speeds [rad/s] at which they must be known, besides the first and the last.

    Beside what is published or measured:

    - ``known(reference, result, spindle)``: values (SI) to put beside a reference, NaN at speeds
      without one, or None where the reference is about something else.
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
    unlisted: Callable[[Any], Iterable[tuple[str, Sequence[str]]]] = _nothing
    lean: Callable[[Any], Any] = _same
    speeds: Callable[[Any], Iterable[float]] = _nothing
    known: Callable[[Any, Any, Any], Any] | None = None
    title: str = ""
    page: Callable[[Any, Any], Iterable[Block]] | None = None


PLACES = {
    "solve": "solve:answer",
    "figures": "figures:figures",
    "panels": "figures:panels",
    "curves": "figures:headline_curves",
    "summary": "summary:summary",
    "accuracy": "summary:accuracy",
    "warnings": "summary:warnings",
    "numbers": "summary:numbers",
    "lacking": "summary:lacking",
    "unlisted": "summary:unlisted",
    "known": "known:known",
    "page": "page:page",
}


def in_folder(package: str, *also: str, **declared: Any) -> Analysis:
    """The analysis whose folder is ``package``, which gives its name, with code in ``PLACES``:
    what solves, draws, lays curves over others and sums up, numbers where it has a ``heading``,
    and ``also`` the parts named. ``declared``: further fields of ``Analysis``."""
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
