"""Error of a path that cannot be followed any further."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.errors import NoSolution
from rotordyn.state.network import Step


class NoEquilibrium(NoSolution):
    """A body has no equilibrium beyond some place of the path.

    ``share`` of the step done; ``body`` that runs away.
    """

    def __init__(self, share: float, body: str, sentence: str) -> None:
        self.share, self.body = share, body
        super().__init__(sentence)


def endless(step: Step, share: float, v: Array) -> NoEquilibrium:
    """Error of contacts that change back and forth; ``v`` (bodies,): rates of the positions."""
    body = step.network.bodies[int(np.abs(v).argmax())]
    return NoEquilibrium(
        share,
        body,
        f"body {body}: which of its contacts stick, slide or close changes with rounding; "
        "change a limit of friction or a force of the step by a thousandth of it",
    )


def runaway(step: Step, share: float, v: Array) -> NoEquilibrium:
    """Error of a body that runs away; ``v`` (bodies,): rates of the positions."""
    bodies, force = step.network.bodies, step.load(share).force
    body = bodies[int(np.abs(v).argmax())]
    pushed = int(np.abs(force).argmax())
    under = f"{force[pushed]:.6g} N on {bodies[pushed]}" if force[pushed] else "no external force"
    return NoEquilibrium(
        share,
        body,
        f"body {body} has no equilibrium under {under}: it is no longer restrained; lower the "
        "force, or restrain it by a spring or a stop",
    )
