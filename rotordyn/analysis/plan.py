"""What structure and questions of a machine spare: stages never run, work done once for many."""

from __future__ import annotations

from collections.abc import Iterator

from rotordyn.analysis.scene import Scene
from rotordyn.system.lateral import LateralSystem

UNASKED = "no analysis of this case needs it"
VIBRATIONS = ("rotor", "bending", "axial", "torsion")


def reasons(scene: Scene) -> dict[str, str]:
    """Why each stage that did not run did not."""
    return {name: _reason(scene, name) for name in scene.skipped}


def _reason(scene: Scene, name: str) -> str:
    stem = name.removesuffix("_modes")
    coupled = stem in scene.coupled_motions and "coupled" in scene.solved
    vibrates = any(motion in scene.solved for motion in VIBRATIONS)
    known = (
        (
            stem == "coupled" and not scene.coupled_motions,
            "no support or housing couples its motions",
        ),
        (name in ("preload", "tangents") and not scene.spindle.seats, "supports are linear"),
        (name == "shaft_force" and not scene.conditions.axial_stiffening, "it does not act here"),
        (name != stem and coupled, "it is part of the coupled system"),
        (stem in VIBRATIONS and not vibrates, "no analysis asks for vibration"),
    )
    return next((why for holds, why in known if holds), UNASKED)


def spared(scene: Scene) -> tuple[str, ...]:
    """Sentences on what was done once for many, or not at all, by the structure of the machine."""
    return (*_taken(scene), *_bearings(scene), *_vibration(scene))


def _taken(scene: Scene) -> Iterator[str]:
    if scene.taken:
        yield f"solved before for another variant: {', '.join(sorted(scene.taken))}"


def _bearings(scene: Scene) -> Iterator[str]:
    if "preload" not in scene.solved:
        return
    bearings = scene.preload.network.arrangement.bearings
    names = [seat.name for seat in scene.spindle.seats]
    for bearing in bearings:
        if len(bearing.seats) > 1:
            twins = ", ".join(names[seat] for seat in bearing.seats)
            yield f"bearings {twins} are alike and share their load: one of them is solved"
    balls = sorted({bearing.model.balls for bearing in bearings})
    counts = " or ".join(map(str, balls))
    yield f"under axial load all balls of a bearing are alike: one of {counts} is solved"
    if len(scene.bearing_speed) < len(scene.speed):
        yield f"bearings keep their state at rest: solved once for {len(scene.speed)} speeds"


def _vibration(scene: Scene) -> Iterator[str]:
    bending = scene.solved.get("bending")
    if isinstance(bending, LateralSystem) and bending.isotropic:
        yield (
            "every bearing and support answers alike in all directions: both planes of bending are "
            "one complex coordinate, half the unknowns"
        )
    unreduced = None if bending is None else bending.unreduced
    if unreduced is not None:
        all_freedoms, kept = unreduced.basis.vectors.shape
        yield f"bending of the rotor: {kept} coordinates a plane for {all_freedoms} freedoms"
    if "torsion_modes" in scene.solved and "torsion" not in scene.coupled_motions:
        yield "nothing in torsion follows the speed: solved once for all"
