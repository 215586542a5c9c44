"""Frames in which bending may be written, and the notes on each."""

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
        "formulation rotating: bending frequencies and receptances are those in a frame that "
        "rotates with the shaft"
    ),
    SOFTENED: (
        "formulation fixed-frame softening: Ω² M_ω is subtracted in the fixed frame, which has no "
        "physical basis; bending frequencies come out too low at speed"
    ),
}


def frame_notes(formulation: str) -> tuple[str, ...]:
    """Return the note on the formulation in force; none for the inertial one."""
    return (_SENTENCES[formulation],) if formulation in _SENTENCES else ()


def turned(quantity: str) -> str:
    """Say why a velocity or acceleration over force is not given in the rotating frame."""
    return (
        f"no sensor measures {quantity} in a frame that rotates with the shaft: take receptance, "
        "or formulation: inertial"
    )


def require_axisymmetric(scene: Scene) -> None:
    """Check that bending may be written in the rotating frame.

    Raises
    ------
    InvalidInput : there are anisotropic supports, housings, or supports that couple bending
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
        if not linear.axisymmetric:
            raise InvalidInput(
                "the rotating formulation needs isotropic supports, and those of this machine are "
                "anisotropic: use the inertial one"
            )
