"""Data of a case, and of its variants, that figures, texts, pages and files need."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from bearings.bearing import BallBearing
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle


class Described(Protocol):
    """A case: its ``known`` values are published or measured; ``analyses``: specs by name."""

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def spindle(self) -> Spindle | None: ...
    @property
    def bearing(self) -> BallBearing | None: ...
    @property
    def conditions(self) -> Any: ...
    @property
    def known(self) -> Sequence[Reference]: ...
    @property
    def analyses(self) -> Mapping[str, Any]: ...


class Shown(NamedTuple):
    """A variant, or the only machine of a case: its title, its result, and known values."""

    title: str
    result: Any
    known: Sequence[Reference]
    spindle: Spindle | None
