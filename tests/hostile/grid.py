"""Hostile files by the thousand: every odd value at every place, every size, every header."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from tests.hostile.files import (
    CASE,
    SHAFT,
    UFF,
    Writer,
    case,
    header,
    housed,
    measured,
    npy,
    npz,
)  # fmt: skip

PLACES = (
    "title: hostile", "title: shaft", "500 mm, outer", "outer_diameter: 50 mm", "name: one",
    "x: 500 mm", "yy: 100 N/um", "mid: 250 mm", "0 rpm", "1500 Hz", "start: 0 mm", "steel_rotor",
    "name: a",
)  # fmt: skip
VALUES = (
    "1e200", "1e308", "-1e308", "5e-324", "1e200 m", "1e308 rpm", "-1e300 N/um", "1e-300 Hz",
    "1e-320 mm", "1e22 kg", ".nan", ".inf", "-.inf", "nan mm", "inf Hz", "1e400", "0x7fffffff",
    "1_000 mm", "1,5 mm", "1.5.2 mm", "--5 mm", "5 mm mm", "mm", "5 m^99999999999", "5 m*s/kg",
    "5 µm", "5 µµm", "٣ mm", "+-3 mm", "9" * 400, "9" * 5000, "1" + "0" * 300 + " mm", "y" * 5000,
    "'a\tb'", '"a\\0b"', '"\\e[2J"', '"\\x07"', '"\\N"', '"\\u2028"', '"\\ud800"', "'../../etc'",
    "/etc/passwd", "/dev/zero", "~", "[]", "{}", "[[[[1]]]]", "{a: {b: {c: 1}}}", "[1 mm, 2 mm]",
    "true", "2024-01-01", "12:30:45", "!!float x", "!!python/name:os.system ''", "&a [*a]", "*b",
    "<<", "'<script>alert(1)</script>'", "'$(id)'", "'%s%n'", "'{given}'", "'{0.__class__}'",
)  # fmt: skip
SIZES = (1, 30, 300, 3000, 30_000)


def grid() -> dict[str, Writer]:
    """All of them by name, as ``files.FILES``."""
    return {
        **dict(_values()), **dict(_sized()), **dict(_curves()), **dict(_matrices())
    }  # fmt: skip


def _values() -> Iterator[tuple[str, Writer]]:
    for (k, place), (n, value) in product(enumerate(PLACES), enumerate(VALUES)):
        key, _, old = place.rpartition(": ")
        old = old.split(",")[0] if key == "" else old
        new = f"{key}: {value}" if key else place.replace(old, value)
        yield f"value_{k}_{n}", case(SHAFT.replace(place, new))


def _sized() -> Iterator[tuple[str, Writer]]:
    made = {
        "anchors": lambda n: CASE + "note: [" + ", ".join(f"&a{k} {k}" for k in range(n)) + "]\n",
        "unknown": lambda n: CASE + "".join(f"k{k}: 1\n" for k in range(n)),
        "within": lambda n: CASE.replace("0 Hz", "0 Hz" + "".join(f", k{k}: 1" for k in range(n))),
        "duplicates": lambda n: CASE + "note: x\n" * n,
        "orders": lambda n: CASE.replace(
            "1500 Hz}", f"1500 Hz, engine_orders: {[1 + k for k in range(n)]}}}"
        ),
        "variants": lambda n: CASE + "compare:\n" + "".join(f"  v{k}: {{}}\n" for k in range(n)),
        "overrides": lambda n: (
            CASE + "override:\n" + "".join(f"  points.p{k}: x\n" for k in range(n))
        ),
        "depth": lambda n: "a: " + "[" * n + "]" * n,
        "depth of mappings": lambda n: "a: " + "{b: " * n + "1" + "}" * n,
        "quotes": lambda n: CASE + 'note: "' + "x" * n,
        "names": lambda n: CASE.replace("grinding_spindle", "g" * n),
        "titles": lambda n: CASE.replace("hostile", '"' + "\\x01" * n + '"'),
        "lines": lambda n: CASE + "\n" * n + "x: 1\n",
        "spaces": lambda n: CASE + " " * n + "x: 1\n",
        "tabs": lambda n: CASE + "\t" * n + "x: 1\n",
        "speeds": lambda n: CASE.replace(
            "0 rpm, 6000 rpm", ", ".join(f"{k} rpm" for k in range(n))
        ),
    }
    for (name, text), size in product(made.items(), SIZES):
        yield f"{name}_{size}", case(text(size))


def _curves() -> Iterator[tuple[str, Writer]]:
    head = b"frequency [Hz],real [m/N],imaginary [m/N]\n"
    numbers = (b"1e200", b"1e307", b"-1e308", b"1e309", b"nan", b"5e-324", b"x", b"", b"1e", b"0x1")
    for (k, value), column in product(enumerate(numbers), range(3)):
        rows = [[b"%d" % f, b"1e-8", b"1e-9"] for f in range(10, 900, 10)]
        for row in rows[:: 1 + column]:
            row[column] = value
        text = head + b"".join(b",".join(row) + b"\n" for row in rows)
        yield f"csv_{k}_{column}", measured("m.csv", text)
    counts = (0, -1, 3, 10_000, 2_147_483_647, 9_999_999_999)
    data = ("1 2 3", "", "1e308 " * 6, "nan " * 6, "x " * 9, "1.0e-8 1.0e-9 " * 3)
    for (k, count), code, (n, words) in product(
        enumerate(counts), (2, 4, 5, 6, 77), enumerate(data)
    ):
        text = UFF.format(code=code, count=count, data=words)
        yield f"uff_{k}_{code}_{n}", measured("m.uff", text.encode())


def _matrices() -> Iterator[tuple[str, Writer]]:
    whole = (0, 1, 2, -2, 401, 10**9, 10**19)
    for rows, entries, place in product(whole, whole, (1, 3, 10**12)):
        text = f"%%MatrixMarket matrix coordinate real general\n{rows} {rows} {entries}\n"
        files = {"m.mtx": (text + f"{place} 1 1.0\n").encode(), "k.mtx": text.encode()}
        asked = "{mass: m.mtx, stiffness: k.mtx, places: [one.y, two.y]}"
        yield f"mtx_{rows}_{entries}_{place}", housed(asked, files)
    good = {"mass.npy": npy(np.eye(2)), "stiffness.npy": npy(np.eye(2))}
    good["places.npy"] = npy(np.array(["one.y", "two.y"]))
    shapes = (
        "()",
        "(0,)",
        "(2, 2)",
        "(-2, 2)",
        "(10**9,)",
        "(1000000000, 1000000000)",
        "(2.5, 2)",
        "x",
    )
    for (k, shape), kind, name in product(
        enumerate(shapes), ("<f8", "<c16", "|O", "<U9999", "zz"), ("mass.npy", "places.npy")
    ):
        members = {**good, name: header(shape, kind) + b"\0" * 64}
        yield f"npz_{k}_{kind.strip('<|')}_{name[0]}", housed("m.npz", {"m.npz": npz(members)})
