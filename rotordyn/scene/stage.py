"""Results that several analyses share: pure functions of a machine, kept in one memo by what they
depend on, and timed."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from functools import partial
from typing import Any, TypeVar

from rotordyn.allowance import require_time

T = TypeVar("T")
Inputs = tuple[Any, ...]
SOLVE = "solve "  # before the name of an analysis: the name of its stage


@dataclass
class Memo:
    """Values of stages by name and by a hash of their inputs, with these inputs.

    Machines that differ little (variants, other speeds, a finer model) share one memo. ``ahead``:
    preload states of later machines, which are solved together, with the inputs of each.
    """

    ahead: list[tuple[Inputs, Any]] = field(default_factory=list)
    values: dict[str, dict[int, list[tuple[Inputs, Any]]]] = field(default_factory=dict)

    def known(self, name: str, inputs: Inputs) -> tuple[Any] | None:
        """Return the value of a stage for equal inputs, in a tuple, or None."""
        for other, value in self.values.get(name, {}).get(_hash(inputs), ()):
            if other == inputs:
                return (value,)
        return None

    def keep(self, name: str, inputs: Inputs, value: Any) -> None:
        """Store a value."""
        values = self.values.setdefault(name, {})
        values.setdefault(_hash(inputs), []).append((inputs, value))

    def forget(self, latest: int) -> None:
        """Keep the first and the ``latest`` most recent values of every stage."""
        for values in self.values.values():
            entries = [(number, entry) for number, kept in values.items() for entry in kept]
            values.clear()
            for number, entry in [*entries[:1], *entries[1:][-latest:]]:
                values.setdefault(number, []).append(entry)


def _hash(inputs: Any) -> int:
    """Return a hash that equal inputs share, for a quick search among many variants."""
    try:
        return hash(inputs)
    except TypeError:
        pass
    if isinstance(inputs, Mapping):
        return hash(frozenset((key, _hash(value)) for key, value in inputs.items()))
    if isinstance(inputs, tuple):
        return hash(tuple(map(_hash, inputs)))
    if is_dataclass(inputs):
        return hash(tuple(_hash(getattr(inputs, item.name)) for item in fields(inputs)))
    return 0


@dataclass
class Clock:
    """Seconds of every stage without those of nested stages, and the stage that ``asked`` for it
    first ("": the case). ``reached``: stages of any machine that it times, taken from the memo or
    not. ``report`` is called with the progress of a long analysis."""

    seconds: dict[str, float] = field(default_factory=dict)
    asked: dict[str, str] = field(default_factory=dict)
    reached: set[str] = field(default_factory=set)
    report: Callable[[str], None] = lambda _: None
    _running: list[tuple[str, float]] = field(default_factory=list)

    def progress(self, done: str) -> None:
        """Report what is ``done`` of the analysis that is solved."""
        self.report(f"{self._running[0][0].removeprefix(SOLVE) if self._running else ''}, {done}")

    def timed(self, name: str, work: Callable[[], T]) -> T:
        """Run ``work`` and add its own seconds to ``name``."""
        require_time(name)
        begin = time.perf_counter()
        self.asked.setdefault(name, self._running[-1][0] if self._running else "")
        self._running.append((name, 0.0))
        try:
            return work()
        finally:
            _, nested = self._running.pop()
            spent = time.perf_counter() - begin
            self.seconds[name] = self.seconds.get(name, 0.0) + spent - nested
            if self._running:
                outer, earlier = self._running[-1]
                self._running[-1] = outer, earlier + spent


class stage(property):  # noqa: N801
    """A shared result: a property solved on first use.

    ``follows``: inputs that the value depends on; all machines of the same memo with equal inputs
    share it. ``own``: adapts the shared value to a machine, where little of it depends on more.
    """

    def __init__(
        self,
        solve: Callable[[Any], Any],
        follows: Callable[[Any], Inputs] | None = None,
        own: Callable[[Any, Any], Any] = lambda staged, value: value,
    ) -> None:
        name = solve.__name__

        def get(staged: Staged) -> Any:
            if name not in staged.solved:
                staged.clock.reached.add(name)
                work = partial(solve, staged)
                value = (
                    staged.shared(name, follows(staged), work)
                    if follows
                    else staged.timed(name, work)
                )
                staged.solved[name] = own(staged, value)
            return staged.solved[name]

        super().__init__(get, doc=solve.__doc__)
        self.name = name


def stage_of(
    follows: Callable[[Any], Inputs], own: Callable[[Any, Any], Any] = lambda staged, value: value
) -> Callable[[Callable[[Any], Any]], stage]:
    """Return a stage whose value depends on ``follows`` alone, but for what ``own`` adds."""
    return lambda solve: stage(solve, follows, own)


class Staged:
    """A machine with its stages: what it has ``solved``, and what was ``reused`` from the memo."""

    def __init__(self, memo: Memo | None = None, clock: Clock | None = None) -> None:
        self.memo, self.clock = memo or Memo(), clock or Clock()
        self.solved: dict[str, Any] = {}
        self.reused: set[str] = set()

    def timed(self, name: str, work: Callable[[], T]) -> T:
        """Run ``work`` and note its seconds."""
        return self.clock.timed(name, work)

    def shared(self, name: str, inputs: Inputs, work: Callable[[], T]) -> T:
        """Return a value that depends on ``inputs`` alone, from the memo where it is known."""
        stored = self.memo.known(name, inputs)
        if stored is None:
            stored = (self.timed(name, work),)
            self.memo.keep(name, inputs, stored[0])
        else:
            self.reused.add(name)
        value: T = stored[0]
        return value

    @property
    def skipped(self) -> tuple[str, ...]:
        """Stages that no analysis asked for, at any speeds."""
        return tuple(
            name
            for kind in reversed(type(self).__mro__)
            for name, value in vars(kind).items()
            if isinstance(value, stage) and name not in self.clock.reached
        )
