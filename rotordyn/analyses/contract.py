"""What every analysis is."""

from __future__ import annotations

from typing import Any, Protocol

from rotordyn.description import Description

Spec = Description


class Result(Protocol):
    """Declared arrays over speed; ``outcome`` says why values are missing."""

    @property
    def outcome(self) -> Any: ...
