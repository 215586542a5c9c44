"""The files of ``cases/data``:  python -m docs.generate.case_data

No file contains measurements. ``oil_film.csv`` has values of the formulas of a short journal
bearing, ``housing_*.mtx`` the reduced matrices of a beam on springs. ``made_up_tap.csv`` is
computed by this program for a joint softer than that of its case, ``made_up_blank.csv`` for a blank
on a spindle, both with noise.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

import rotordyn
from docs.generate.places import ROOT
from rotordyn.analyses import FrfSpec, Port

Array = NDArray[np.float64]
DATA = ROOT / "cases" / "data"
RPM = math.pi / 30.0
ENTRIES = ("yy", "yz", "zy", "zz")

# Journal bearing of Friswell and others (2010), examples 5.5.1 and 5.9.6
LOAD, DIAMETER, LENGTH, CLEARANCE, VISCOSITY = 525.0, 0.1, 0.03, 1e-4, 0.1


def film(speed: float) -> tuple[float, Array, Array]:
    """Eccentricity, stiffness and damping (2, 2) of a short bearing at ``speed`` [rad/s].

    Half the circumference filled, Reynolds' equation along the axis only (Ocvirk), as in section
    5.5 of Friswell and others: the first direction across the load, the second along it.
    """
    modified = DIAMETER * speed * VISCOSITY * LENGTH**3 / (8.0 * LOAD * CLEARANCE**2)
    pi, s = math.pi**2, modified**2
    squares = np.roots([1.0, -4.0, 6.0 - s * (16.0 - pi), -(4.0 + pi * s), 1.0])
    inside = squares[(np.abs(squares.imag) < 1e-9) & (squares.real < 1.0)].real
    e = math.sqrt(float(inside.min()))
    rest = 1.0 - e**2
    root = math.sqrt(rest)
    size = 4.0 / (pi * rest + 16.0 * e**2) ** 1.5
    along = pi * rest * (1.0 + 2.0 * e**2) + 32.0 * e**2 * (1.0 + e**2)
    across = math.pi * (pi * rest**2 - 16.0 * e**4) / (e * root) / 4.0
    middle = pi * (1.0 + 2.0 * e**2) - 16.0 * e**2
    stiffness = size * np.array(
        [
            [pi * (2.0 - e**2) + 16.0 * e**2, across],
            [-math.pi * along / (4.0 * e * root), along / rest],
        ]
    )
    slant = -2.0 * middle
    damping = size * np.array(
        [
            [0.5 * math.pi * root * middle / e, slant],
            [slant, 0.5 * math.pi * (pi * rest**2 + 48.0 * e**2) / (e * root)],
        ]
    )
    return e, LOAD / CLEARANCE * stiffness, LOAD / (CLEARANCE * speed) * damping


def oil_film() -> str:
    """The table over speed."""
    lines = [
        "# Short journal bearing, diameter 100 mm, length 30 mm, radial clearance 0.1 mm, oil of",
        "# 0.1 Pa s, load 525 N along z: formulas of Friswell and others 2010, section 5.5,",
        "# computed by docs/generate/case_data.py",
        ", ".join(
            [
                "speed [rpm]",
                *(f"stiffness.{entry} [N/um]" for entry in ENTRIES),
                *(f"damping.{entry} [N s/m]" for entry in ENTRIES),
            ]
        ),
    ]
    for rpm in range(500, 4501, 100):
        _, stiffness, damping = film(rpm * RPM)
        values = [*(1e-6 * stiffness).ravel(), *damping.ravel()]
        lines.append(", ".join([str(rpm), *(f"{value:.6g}" for value in values)]))
    return "\n".join(lines) + "\n"


# Cartridge of a headstock: a steel tube with the stator in it, held at its flange
SEATS = {"a": 0.0286, "b": 0.0486, "c": 0.0844, "d": 0.3809, "e": 0.4024}  # of the MFW 2310 [m]
FLANGE, FLANGE_STIFFNESS, FLANGE_TILT = 0.12, 9e8, 1.6e7  # m, N/m, N·m/rad
TUBE = (0.156, 0.14)  # outer and inner diameter [m]
STATOR = (0.16, 0.31, 18.0)  # from, to [m], mass [kg]
ENDS = (0.01, 0.42)  # m
STEEL = (2.1e11, 7850.0)
RATIO, KEPT = 0.02, 3  # damping ratio of every mode; inner modes kept in each plane


def tube() -> tuple[Array, Array, Array]:
    """(stations, mass, stiffness) of the cartridge in a plane: Euler and Bernoulli, v and slope."""
    x = np.unique([*np.linspace(*ENDS, 21), *SEATS.values(), FLANGE, *STATOR[:2]])
    modulus, density = STEEL
    outer, inner = TUBE
    area = math.pi / 4.0 * (outer**2 - inner**2)
    bending = modulus * math.pi / 64.0 * (outer**4 - inner**4)
    mass, stiffness = np.zeros((2, 2 * len(x), 2 * len(x)))
    for k, h in enumerate(np.diff(x)):
        middle = x[k] + 0.5 * h
        line = density * area
        if STATOR[0] < middle < STATOR[1]:
            line += STATOR[2] / (STATOR[1] - STATOR[0])
        rows = slice(2 * k, 2 * k + 4)
        mass[rows, rows] += line * h / 420.0 * _beam(156.0, 22.0 * h, 54.0, -13.0 * h, 4.0, 3.0, h)
        stiffness[rows, rows] += bending / h**3 * _beam(12.0, 6.0 * h, -12.0, 6.0 * h, 4.0, -2.0, h)
    held = 2 * int(np.abs(x - FLANGE).argmin())
    stiffness[held, held] += FLANGE_STIFFNESS
    stiffness[held + 1, held + 1] += FLANGE_TILT
    return x, mass, stiffness


def _beam(a: float, b: float, c: float, d: float, e: float, f: float, h: float) -> Array:
    """The common pattern of mass and stiffness of a beam element."""
    e, f = e * h**2, -f * h**2
    return np.array([[a, b, c, d], [b, e, -d, f], [c, -d, a, -b], [d, f, -b, e]])


def housing() -> dict[str, Array]:
    """Mass, stiffness, damping of the cartridge, y of the seats and inner modes, then z.

    Fixed-interface modes and static constraint modes of the seats (Craig and Bampton 1968).
    """
    from scipy.linalg import block_diag, eigh

    x, mass, stiffness = tube()
    seats = [2 * int(np.abs(x - at).argmin()) for at in SEATS.values()]
    inner = np.setdiff1d(np.arange(len(mass)), seats)
    own = np.ix_(inner, inner)
    _, modes = eigh(stiffness[own], mass[own], subset_by_index=[0, KEPT - 1])
    basis = np.zeros((len(mass), len(seats) + KEPT))
    basis[seats, range(len(seats))] = 1.0
    basis[inner, : len(seats)] = -np.linalg.solve(stiffness[own], stiffness[np.ix_(inner, seats)])
    basis[inner, len(seats) :] = modes
    m, k = basis.T @ mass @ basis, basis.T @ stiffness @ basis
    squares, shapes = eigh(k, m)
    weighted = m @ shapes
    c = weighted * (2.0 * RATIO * np.sqrt(squares)) @ weighted.T
    return {name: block_diag(a, a) for name, a in (("mass", m), ("stiffness", k), ("damping", c))}


def _market(matrix: Array) -> str:
    """A full matrix as a Matrix Market file."""
    head = [
        "%%MatrixMarket matrix array real general",
        "% cartridge of a headstock, a beam on springs: computed by docs/generate/case_data.py",
        "{} {}".format(*matrix.shape),
    ]
    return "\n".join([*head, *(f"{value:.10g}" for value in matrix.T.ravel())]) + "\n"


TILT, TILT_DAMPING = 2.4e6, 60.0  # N·m/rad, N·m·s/rad
NOISE_OF_BLANK = 0.01
NOISE, FLOOR, SEED = 0.03, 0.004, 2310  # of the value; of the largest; of the generator


def tap() -> tuple[Array, NDArray[np.complex128]]:
    """Frequencies [Hz] and inertances [1/kg] of the tool with another joint, with noise."""
    tool = rotordyn.model("tools", DATA / "exciter_on_hsk.yaml")
    (joint,) = tool.joints
    other = replace(tool, joints=(replace(joint, tilt=TILT, tilt_damping=TILT_DAMPING),))
    frequency = np.arange(50.0, 3000.1, 10.0)
    end = Port("Oc2", "y")
    asked = replace(
        rotordyn.load(ROOT / "cases" / "mfw2310.yaml"),
        spindle=rotordyn.model("spindles", "mfw2310").with_tool(other),
        speeds=(0.0,),
        analyses={"frf": FrfSpec(tuple(frequency), ((end, end),), quantity="inertance")},
    )
    return frequency, _noisy(rotordyn.run(asked)["frf"].inertance.values[0, 0])


def _noisy(exact: NDArray[np.complex128]) -> NDArray[np.complex128]:
    parts = np.random.default_rng(SEED).normal(size=(4, len(exact))) / math.sqrt(2.0)
    share, floor = parts[0] + 1j * parts[1], parts[2] + 1j * parts[3]
    return exact * (1.0 + NOISE * share) + FLOOR * np.abs(exact).max() * floor


def made_up_tap() -> str:
    """The table that replaces a tap test."""
    lines = [
        "# NOT A MEASUREMENT. Computed by rotordyn for tool_holder_joint.yaml with a joint of",
        f"# {TILT / 1e6:g} MN m/rad, with noise of {NOISE:.0%} and a floor, by "
        "docs/generate/case_data.py",
        "frequency [Hz], real [(m/s²)/N], imaginary [(m/s²)/N]",
    ]
    values = zip(*tap(), strict=True)
    lines += [f"{f:g}, {value.real:.5g}, {value.imag:.5g}" for f, value in values]
    return "\n".join(lines) + "\n"


def blank() -> str:
    """The table that replaces a test of a blank at two points, at rest."""
    frequency = np.arange(100.0, 5000.1, 5.0)
    ends = [Port(point, "y") for point in ("tip", "inner")]
    pairs = ((ends[0], ends[0]), (ends[0], ends[1]), (ends[1], ends[1]))
    case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
    spindle = rotordyn.model("spindles", "mfw2310")
    asked = replace(
        case,
        spindle=spindle.with_tool(rotordyn.model("tools", "hsk63_blank_60")),
        speeds=(0.0,),
        analyses={"frf": FrfSpec(tuple(frequency), pairs)},
    )
    exact = rotordyn.run(asked)["frf"].receptance.values[0]
    parts = np.random.default_rng(SEED).normal(size=(2, *exact.shape)) / math.sqrt(2.0)
    noisy = exact * (1.0 + NOISE_OF_BLANK * (parts[0] + 1j * parts[1]))
    names = [f"{response} / {excitation}" for response, excitation in pairs]
    heads = [f"{n} {part} [m/N]" for n in names for part in ("real", "imaginary")]
    lines = [
        "# NOT A MEASUREMENT. Computed by rotordyn for hsk63_blank_60 on mfw2310 at rest, with",
        f"# noise of {NOISE_OF_BLANK:.0%} of each value, by docs/generate/case_data.py",
        ", ".join(["frequency [Hz]", *heads]),
    ]
    for f, values in zip(frequency, noisy.T, strict=True):
        cells = [f"{part:.6g}" for value in values for part in (value.real, value.imag)]
        lines.append(", ".join([f"{f:g}", *cells]))
    return "\n".join(lines) + "\n"


def files() -> Iterator[tuple[str, str]]:
    """Names and contents."""
    yield "oil_film.csv", oil_film()
    for name, matrix in housing().items():
        yield f"housing_{name}.mtx", _market(matrix)
    yield "made_up_tap.csv", made_up_tap()
    yield "made_up_blank.csv", blank()


def write_case_data() -> None:
    """Write all files."""
    DATA.mkdir(exist_ok=True)
    for name, text in files():
        (DATA / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write_case_data()
