"""The machine of the comparison, as numbers that both sides read (SI); no library is imported.

A stepped spindle rotor of 0.6 m in 60 equal elements on five linear bearings. Axes: x along
the shaft, y and z across it.
"""

from __future__ import annotations

RPM = 0.10471975511965977  # rad/s
ELEMENT = 0.010  # length [m]
# Elements, outer and inner diameter of each section.
SECTIONS = (
    (6, 0.040, 0.000),
    (8, 0.070, 0.025),
    (14, 0.080, 0.030),
    (16, 0.075, 0.030),
    (10, 0.065, 0.030),
    (6, 0.050, 0.020),
)
STEEL = (2.1e11, 0.3, 7850.0)  # E [Pa], ν, ρ [kg/m³]
FRONT, REAR = (8, 11, 14), (46, 49)  # nodes of the bearings
AXIAL = 2.0e7  # N/m of each bearing
NODES = sum(count for count, _, _ in SECTIONS) + 1
STATIONS = tuple(round(ELEMENT * node, 9) for node in range(NODES))

SPEEDS = tuple(500.0 * (step + 1) * RPM for step in range(49))
JUDGED = slice(None, None, 12)  # of the speeds: where errors are computed
MODES, BAND = 12, 5000.0  # modes at every speed, and a frequency above them [Hz]
INPUT = 0  # node where a force acts, along y
SPEED = 12000.0 * RPM  # of the single response
FREQUENCIES = tuple(2.0 * (k + 1) for k in range(2000))  # Hz
SAMPLE = slice(39, None, 40)  # of the frequencies: where errors are computed, and the peer is timed
MAP_SPEEDS = SPEEDS[::2]
MOTIONS = ("y", "z", "thy", "thz")  # of every node, whose response is compared

Entries = dict[str, float]
ISOTROPIC, GENERAL = "isotropic, undamped", "anisotropic, damped"
KINDS = (ISOTROPIC, GENERAL)


def supports(kind: str) -> dict[int, tuple[Entries, Entries]]:
    """Stiffness and damping of the bearing at each node, entries such as ``yz``."""
    plain = {"yy": 1.0, "zz": 1.0}
    uneven = {"yy": 1.0, "zz": 0.75, "yz": 0.06, "zy": 0.03}
    damped = {"yy": 900.0, "zz": 700.0, "yz": 40.0, "zy": 40.0}
    found = {}
    for node in (*FRONT, *REAR):
        radial = 1.6e8 if node in FRONT else 1.2e8
        share = plain if kind == ISOTROPIC else uneven
        stiffness = {name: radial * part for name, part in share.items()} | {"xx": AXIAL}
        damping = {} if kind == ISOTROPIC else damped | {"xx": 500.0}
        found[node] = (stiffness, damping)
    return found


def diameters() -> list[tuple[float, float]]:
    """Outer and inner diameter of each element."""
    return [(outer, inner) for count, outer, inner in SECTIONS for _ in range(count)]
