"""Frequencies beyond what elements of a given length can represent."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from rotordyn.analyses.registry import analysis
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.shaft import half_wave
from rotordyn.machine.spindle import Spindle
from rotordyn.results.display import RPM
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.spec import Spec


def beyond_elements(
    spindle: Spindle, conditions: Conditions, analyses: Mapping[str, Spec], top: float
) -> Iterator[str]:
    """A sentence for every analysis with frequencies at which an element exceeds half a wave.

    ``top``: highest speed [rad/s]. Elements refined to an accuracy have no such limit.
    """
    longest = conditions.element_length
    fastest = top * max(abs(ratio) for ratio in spindle.ratios.values())
    frequencies = {name: _highest(name, spec, fastest) for name, spec in analyses.items()}
    if longest is None or conditions.rotor == "rigid" or not any(frequencies.values()):
        return
    meshes = build_mesh(spindle, longest).of_rotors
    limits = {
        name: half_wave(spindle.part(name), meshes[name], abs(ratio) * top) / (2.0 * math.pi)
        for name, ratio in spindle.ratios.items()
    }
    weakest = min(limits, key=lambda name: limits[name])
    limit, mesh = limits[weakest], meshes[weakest]
    for name, highest in frequencies.items():
        if highest > limit:
            of_rotation = math.isclose(2.0 * math.pi * highest, fastest)  # a force of the rotation
            in_rpm = f" ({fastest * RPM.factor:.0f} rpm)" if of_rotation else ""
            yield (
                f"{name} goes up to {highest:.6g} Hz{in_rpm}, but an element of "
                f"{mesh.length.max() * 1e3:.4g} mm resolves bending up to {limit:.4g} Hz only "
                "(half a wavelength): allowed: shorter elements, or accuracy instead"
            )


def _highest(name: str, spec: Spec, top: float) -> float:
    """Highest frequency of a force [Hz], 0 without one; ``top``: highest speed of all rotors."""
    record = analysis(name)
    return record.highest(spec, top) if record.forced else 0.0
