"""Whether errors are estimated with a finer model, and the largest ones so far."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Checks:
    """Error estimation by refinement: whether it is ``wanted``, else errors are NaN; its outcome.

    Largest errors so far over the allowed error, infinite where modes appear or vanish: ``worst``
    of the models whose results are taken, or of the last model before them where these are not
    refined; ``first`` of the initial models.
    """

    wanted: bool = True
    worst: float = 0.0
    first: float = 0.0

    def add(self, error: float) -> None:
        """Add an error of a result, over the allowed one."""
        self.worst = max(self.worst, error)
