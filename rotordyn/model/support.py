"""Linear supports: 6×6 matrices, some of them tables over speed."""

from __future__ import annotations

from collections.abc import Callable

from rotordyn.elements.support import support_matrices
from rotordyn.machine.support import LinearSupport
from rotordyn.model.term import LinkMatrices, State


def matrices_of(support: LinearSupport) -> Callable[[State], LinkMatrices]:
    """Stiffness and damping over the six directions (s or 1, 6, 6).

    Raises
    ------
    InvalidInput : its table does not reach one of the speeds
    """

    def matrices(state: State) -> LinkMatrices:
        speed = state.speed if support.speeds else state.speed[:1]
        return LinkMatrices(
            support_matrices(support, "stiffness", speed),
            support_matrices(support, "damping", speed),
        )

    return matrices
