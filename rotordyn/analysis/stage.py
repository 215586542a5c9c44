"""Results that several questions share: solved on first use, kept and timed."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, TypeVar

T = TypeVar("T")


class stage(property):  # noqa: N801
    """A shared result: solved on first use, kept, its own time noted without that of others."""

    def __init__(self, solve: Callable[[Any], Any]) -> None:
        name = solve.__name__

        def get(staged: Staged) -> Any:
            if name not in staged.solved:
                staged.solved[name] = staged.timed(name, lambda: solve(staged))
            return staged.solved[name]

        super().__init__(get, doc=solve.__doc__)
        self.name = name


class Staged:
    """Holds what its stages have solved, the seconds each of them took, and who ``asked`` first.

    What nothing else asked for was asked for by the case (``""``).
    """

    def __init__(self) -> None:
        self.solved: dict[str, Any] = {}
        self.seconds: dict[str, float] = {}
        self.asked: dict[str, str] = {}
        self._running: list[tuple[str, float]] = []

    def timed(self, name: str, work: Callable[[], T]) -> T:
        """Run ``work`` and add its own seconds, without those of stages inside it, to ``name``."""
        begin = time.perf_counter()
        self.asked.setdefault(name, self._running[-1][0] if self._running else "")
        self._running.append((name, 0.0))
        try:
            return work()
        finally:
            _, inside = self._running.pop()
            spent = time.perf_counter() - begin
            self.seconds[name] = self.seconds.get(name, 0.0) + spent - inside
            if self._running:
                outer, before = self._running[-1]
                self._running[-1] = outer, before + spent

    @property
    def skipped(self) -> tuple[str, ...]:
        """Stages that no question asked for."""
        return tuple(
            name
            for kind in reversed(type(self).__mro__)
            for name, value in vars(kind).items()
            if isinstance(value, stage) and name not in self.solved
        )
