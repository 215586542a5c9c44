"""The load history of a spindle: steps of a path, each of which changes one thing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults, Path
from rotordyn.quantity import Force, Speed

CHANGES = ("warm", "speed", "run_up", "axial_force")


@dataclass(frozen=True, slots=True)
class HistoryStep(Description):
    """One change after the step before [rad/s], [N]; the first one starts from rest, as assembled,
    under the weight alone."""

    warm: Annotated[
        bool | None, "`true`: the temperatures of the conditions, `false`: those of assembly"
    ] = None
    speed: Annotated[Speed | None, "speed to run to"] = None
    run_up: Annotated[
        bool,
        "run to every speed of the case, up or down from the present one; every step after this "
        "one is made at each of them",
    ] = False
    axial_force: Annotated[Force | None, "axial force on the shaft towards +x"] = None

    def _faults(self) -> Faults:
        given = [key for key in CHANGES if getattr(self, key) is not None]
        given = [key for key in given if key != "run_up" or self.run_up]
        if len(given) != 1:
            names = " and ".join(given) or "nothing"
            yield (
                (),
                f"a step changes one thing: given {names}; allowed: one of " + ", ".join(CHANGES),
            )


def history_faults(steps: Sequence[HistoryStep]) -> Faults:
    """Yield contradictions in the order of the steps, by path from the history on."""
    run_ups = [k for k, step in enumerate(steps) if step.run_up]
    for index in run_ups[1:]:
        path: Path = (index, "run_up")
        yield path, "a history runs up once: given again; leave it out, or the first"
    for k, step in enumerate(steps):
        if run_ups and k > run_ups[0] and step.speed is not None:
            yield (
                (k, "speed"),
                "after the run-up every step is made at each speed of the case: given {given}; "
                "allowed: before run_up, or warm and axial_force",
            )


@dataclass(frozen=True, slots=True)
class Past:
    """``steps`` from assembly on, with the ``weight`` acting throughout [N]; without steps the
    temperatures are applied first, then the run-up."""

    steps: tuple[HistoryStep, ...] = ()
    weight: float = 0.0

    @property
    def before(self) -> tuple[HistoryStep, ...]:
        """Steps before the run-up."""
        return self.steps[: self._run_up] if self.steps else (HistoryStep(warm=True),)

    @property
    def after(self) -> tuple[HistoryStep, ...]:
        """Steps at every speed."""
        return self.steps[self._run_up + 1 :]

    @property
    def speeds(self) -> tuple[float, ...]:
        """Zero, and the speeds of the steps [rad/s]."""
        return 0.0, *(step.speed for step in self.steps if step.speed is not None)

    @property
    def cold(self) -> bool:
        """Whether some speed is passed at the temperatures of assembly."""
        begins_warm = any(step.warm for step in self.before[:1])
        return not begins_warm or any(step.warm is False for step in self.steps)

    @property
    def _run_up(self) -> int:
        run_ups = (k for k, step in enumerate(self.steps) if step.run_up)
        return next(run_ups, len(self.steps))


ASSEMBLED = Past()
