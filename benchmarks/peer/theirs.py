"""The side of the peer, run by its interpreter; it shares only the numbers of the machine.

``python -m benchmarks.peer.theirs FOLDER REPEATS [--sample]`` writes times (``theirs.json``) and
results (``theirs.npz``) into FOLDER; ``--sample`` takes few speeds and frequencies, times only.
Axes x, y (across) and z (along) of the peer are y, z and x of rotordyn. The rotor keeps a modal
analysis, so every repeat has a new rotor. The FRF of the peer rotates the shaft at the frequency of
the force (``run_freq_response``); at one speed the transfer matrix is computed per frequency.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import time
from importlib.metadata import version
from pathlib import Path
from statistics import median

BEGIN = time.perf_counter()
import ross  # noqa: E402

IMPORTED = time.perf_counter() - BEGIN

import numpy as np  # noqa: E402

from benchmarks.peer import machine  # noqa: E402

LIBRARIES = ("ross-rotordynamics", "numpy", "scipy", "plotly", "pint")
FEW_SPEEDS, FEW_FREQUENCIES, SYNCHRONOUS = 3, 10, 5
AXES = {"y": "x", "z": "y", "x": "z"}
FREEDOMS = (0, 1, 3, 4)  # x, y, α, β of a node: y, z, thy, thz of rotordyn


def rotor(kind):
    """The machine with bearings of a kind."""
    young, poisson, density = machine.STEEL
    steel = ross.Material(name="steel", rho=density, E=young, Poisson=poisson)
    shaft = [
        ross.ShaftElement(L=machine.ELEMENT, idl=inner, odl=outer, material=steel, n=k)
        for k, (outer, inner) in enumerate(machine.diameters())
    ]
    held = [
        ross.BearingElement(node, **_entries("k", stiffness), **_entries("c", damping))
        for node, (stiffness, damping) in machine.supports(kind).items()
    ]
    return ross.Rotor(shaft, bearing_elements=held)


def _entries(letter, given):
    every = {letter + AXES[a] + AXES[b]: 0.0 for a, b in ("yy", "zz", "yz", "zy", "xx")}
    return every | {letter + AXES[a] + AXES[b]: value for (a, b), value in given.items()}


def campbell(kind, speeds):
    """Seconds of a Campbell diagram, and its poles (speeds, modes)."""
    fresh = rotor(kind)
    begin = time.perf_counter()
    found = fresh.run_campbell(np.array(speeds), frequencies=machine.MODES)
    seconds = time.perf_counter() - begin
    ratio = found.damping_ratio
    return seconds, found.wd * (1j - ratio / np.sqrt(1.0 - ratio**2))


def response(kind, frequencies):
    """Seconds per frequency of the whole transfer matrix; one column (frequencies, nodes, 4)."""
    fresh, column = rotor(kind), 6 * machine.INPUT
    omega = [2.0 * math.pi * f for f in frequencies]
    begin = time.perf_counter()
    found = [fresh.transfer_matrix(speed=machine.SPEED, frequency=w) for w in omega]
    seconds = (time.perf_counter() - begin) / len(omega)
    return seconds, np.array([h[:, column].reshape(-1, 6)[:, FREEDOMS] for h in found])


def synchronous(kind, frequencies):
    """Seconds per frequency of the FRF of the peer, with the speed equal to the frequency."""
    omega = 2.0 * math.pi * np.array(frequencies)
    fresh, begin = rotor(kind), time.perf_counter()
    fresh.run_freq_response(speed_range=omega)
    return (time.perf_counter() - begin) / len(omega)


def measured(kind, repeats, few):
    """Times of all works with bearings of a kind, and the results of the last repeat."""
    speeds = machine.SPEEDS[-FEW_SPEEDS:] if few else machine.SPEEDS
    frequencies = machine.FREQUENCIES[machine.SAMPLE]
    if few:
        frequencies = frequencies[:: len(frequencies) // FEW_FREQUENCIES]
    campbell(kind, machine.SPEEDS[:1])  # compiles, fills caches
    begin = time.perf_counter()
    made = rotor(kind)
    build = time.perf_counter() - begin
    diagrams = [campbell(kind, speeds) for _ in range(repeats)]
    responses = [response(kind, frequencies) for _ in range(repeats)]
    line = {
        "kind": kind,
        "build": build,
        "speeds": len(speeds),
        "frequencies": len(frequencies),
        "repeats": repeats,
        "per_speed": median(seconds for seconds, _ in diagrams) / len(speeds),
        "per_frequency": median(seconds for seconds, _ in responses),
        "synchronous": synchronous(kind, frequencies[:SYNCHRONOUS]),
    }
    arrays = {"pole": diagrams[-1][1], "response": responses[-1][1]}
    arrays |= {"mass": made.M(0), "stiffness": made.K(0), "damping": made.C(0), "spin": made.G()}
    return line, arrays


def main():
    """Measure all works and write the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("repeats", type=int)
    parser.add_argument("--sample", action="store_true")
    asked = parser.parse_args()
    found = {
        "import": IMPORTED,
        "python": platform.python_version(),
        "libraries": {name: version(name) for name in LIBRARIES},
        "works": [],
    }
    arrays = {}
    for kind in machine.KINDS:
        line, own = measured(kind, asked.repeats, asked.sample)
        found["works"].append(line)
        arrays |= {f"{kind}: {name}": value for name, value in own.items()}
    if not asked.sample:
        found["at_rest"] = campbell(machine.ISOTROPIC, (0.0,))[0]
    (asked.folder / "theirs.json").write_text(json.dumps(found))
    np.savez(asked.folder / "theirs.npz", **arrays)


if __name__ == "__main__":
    main()
