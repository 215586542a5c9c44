"""The frames in which bending may be written, and what a user reads of each."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rotordyn.errors import InvalidInput

if TYPE_CHECKING:
    from rotordyn.scene.scene import Scene

INERTIAL = "inertial"
ROTATING = "rotating"
SOFTENED = "fixed-frame softening"
FORMULATIONS = (INERTIAL, ROTATING, SOFTENED)

_SENTENCES = {
    ROTATING: (
        "formulation rotating: bending frequencies and receptances are those seen from a frame "
        "that turns with the shaft"
    ),
    SOFTENED: (
        "formulation fixed-frame softening: Ω² M_ω is subtracted in the fixed frame, which no "
        "physics supports; bending frequencies come out too low at speed"
    ),
}


def frame_notes(formulation: str) -> tuple[str, ...]:
    """The sentence that says which formulation is in force; none for the inertial one."""
    return (_SENTENCES[formulation],) if formulation in _SENTENCES else ()


def turned(quantity: str) -> str:
    """Why a velocity or acceleration over force is not given in the turning frame."""
    return (
        f"{quantity} in a frame that turns with the shaft is what no sensor measures: take "
        "receptance, or formulation: inertial"
    )


def require_isotropic(scene: Scene) -> None:
    """Go on only where bending may be seen from the turning frame.

    Raises
    ------
    InvalidInput : supports do not answer alike in all directions, or couple bending to more
    """
    for k in scene.with_motions(("bending",)):
        linear = scene.system(k).linear
        if linear.kinds != {"bending"} or any(
            c.spindle is None and not c.way for c in linear.components
        ):
            raise InvalidInput(
                "the rotating formulation cannot describe supports that couple bending with "
                "another motion, nor housings: use the inertial one"
            )
        if not linear.isotropic:
            raise InvalidInput(
                "the rotating formulation needs supports that answer alike in all directions, and "
                "those of this machine do not: use the inertial one"
            )
