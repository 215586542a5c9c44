"""What structure and analyses of a machine save: stages never run, work shared by many."""

from __future__ import annotations

from collections.abc import Iterator

from rotordyn.scene.scene import Scene

UNASKED = "no analysis of this case needs it"


def reasons(scene: Scene) -> dict[str, str]:
    """Return the reason why each skipped stage did not run."""
    return {name: _reason(scene, name) for name in scene.skipped}


def _reason(scene: Scene, name: str) -> str:
    causes = (
        (name in ("preload", "tangents") and not scene.spindle.seats, "supports are linear"),
        (name == "shaft_force" and not scene.conditions.axial_stiffening, "it does not act here"),
        (name in ("rotor", "subsystems"), "no analysis needs vibration"),
    )
    return next((why for holds, why in causes if holds), UNASKED)


def spared(scene: Scene) -> tuple[str, ...]:
    """Return sentences on work that the structure of the machine saves, or does once for many."""
    return (*_reused(scene), *_bearings(scene), *_vibration(scene))


def _reused(scene: Scene) -> Iterator[str]:
    if scene.reused:
        yield f"the same as of another variant, solved once: {', '.join(sorted(scene.reused))}"


def _bearings(scene: Scene) -> Iterator[str]:
    if "preload" not in scene.solved:
        return
    bearings = scene.preload.network.arrangement.bearings
    names = [seat.name for seat in scene.spindle.seats]
    for bearing in bearings:
        if len(bearing.seats) > 1:
            tandem = ", ".join(names[seat] for seat in bearing.seats)
            yield f"bearings {tandem} are alike and share their load: one of them is solved"
    balls = sorted({bearing.model.balls for bearing in bearings})
    counts = " or ".join(map(str, balls))
    if scene.loaded:
        return
    yield f"under axial load all balls of a bearing are alike: one of {counts} is solved"
    if len(scene.bearing_speed) < len(scene.speed):
        yield f"bearings keep their state at rest: solved once for {len(scene.speed)} speeds"


def _vibration(scene: Scene) -> Iterator[str]:
    for system in scene.systems.values():
        linear, name = system.linear, " and ".join(sorted(system.linear.kinds))
        if linear.axisymmetric:
            yield (
                "every bearing and support is isotropic: both planes of bending "
                "are one complex plane, half the unknowns"
            )
        if system.solved_once and len(linear.speed) > 1:
            yield f"nothing in {name} depends on speed: solved once for all"
        if "bending" in linear.kinds:
            dofs = sum(len(component.dofs) for component in linear.components)
            yield f"{name}: {linear.size} coordinates for {dofs} degrees of freedom"
