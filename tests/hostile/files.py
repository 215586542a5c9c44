"""Hostile files by name: each a folder's content, and the words of the command that reads it."""

from __future__ import annotations

import io
import json
import struct
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

CASE = """title: hostile
spindle: grinding_spindle
speeds: [0 rpm, 6000 rpm]
analyses:
  campbell: {max_frequency: 1500 Hz}
"""
SHAFT = """title: hostile
spindle:
  title: shaft
  shaft:
    start: 0 mm
    material: steel_rotor
    sections: [{name: a, length: 500 mm, outer_diameter: 50 mm}]
  supports:
    - {name: one, x: 0 mm, stiffness: {yy: 100 N/um, zz: 100 N/um}}
    - {name: two, x: 500 mm, stiffness: {yy: 100 N/um, zz: 100 N/um}}
  points: {mid: 250 mm}
speeds: [0 rpm, 6000 rpm]
analyses:
  campbell: {max_frequency: 1500 Hz}
"""
Writer = Callable[[Path], None]
FILES: dict[str, Writer] = {}


def file(writer: Writer) -> Writer:
    """Registers a folder of files; the case is ``case.yaml``."""
    FILES[writer.__name__] = writer
    return writer


def case(text: str) -> Writer:
    return lambda folder: (folder / "case.yaml").write_text(text, encoding="utf-8") and None


def _texts() -> Iterator[tuple[str, str]]:
    many = range(20_000)
    yield "anchors", CASE + "note: [" + ", ".join(f"&a{k} {k}" for k in many) + "]\n"
    yield "anchors_as_keys", CASE + "".join(f"k{k}: &a{k} 1\n" for k in range(5000))
    yield "aliases", CASE + "note: &a x\n" + "".join(f"k{k}: *a\n" for k in range(5000))
    yield (
        "laughs",
        "a0: &a0 [1,1,1,1,1,1,1,1,1]\n"
        + "".join(f"a{k}: &a{k} [{','.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 9)),
    )
    yield "unknown_keys", CASE + "".join(f"key_{k}: 1\n" for k in many)
    yield "unknown_long_keys", CASE + "".join(f"{'k' * 3000}{k}: 1\n" for k in range(300))
    yield (
        "unknown_keys_of_conditions",
        CASE + "conditions: {" + ", ".join(f"k{k}: 1" for k in many) + "}\n",
    )
    yield "duplicate_keys", CASE + "".join("speeds: [0 rpm]\n" for _ in many)
    yield "duplicates_apart", CASE + "".join(f"k{k % 5000}: 1\n" for k in range(10_000))
    yield (
        "engine_orders",
        CASE.replace(
            "1500 Hz}",
            "1500 Hz, engine_orders: [" + ", ".join(str(k + 1) for k in range(3000)) + "]}",
        ),
    )
    yield (
        "engine_orders_beyond",
        CASE.replace("1500 Hz}", "1500 Hz, engine_orders: [1e300, -1, x]}"),
    )
    yield "variants", CASE + "compare:\n" + "".join(f"  v{k}: {{}}\n" for k in range(4000))
    yield (
        "faulty_variants",
        CASE
        + "compare:\n"
        + "".join(f"  v{k}: {{override: {{shaf.t: 1}}}}\n" for k in range(3000)),
    )
    yield "overrides", CASE + "override:\n" + "".join(f"  points.p{k}: 1 mm\n" for k in range(5000))
    yield "long_override", CASE + "override:\n  " + ".".join(["a"] * 20_000) + ": 1\n"
    yield "speeds", CASE.replace("[0 rpm, 6000 rpm]", "{from: 0 rpm, to: 1000000 rpm, step: 1 rpm}")
    yield "same_speeds", CASE.replace("[0 rpm, 6000 rpm]", "[" + "6000 rpm, " * 10_000 + "]")
    yield "near_speeds", CASE.replace("[0 rpm, 6000 rpm]", "[6000 rpm, 6000.000000001 rpm]")
    yield "far_speeds", CASE.replace("[0 rpm, 6000 rpm]", "[0 rpm, 1000000 rpm]")
    yield "high_frequency", CASE.replace("1500 Hz", "1000000 Hz")


def _titles() -> Iterator[tuple[str, str]]:
    yield "control_title", CASE.replace("hostile", '"a\\x01\\x02\\e[31m\\x7f b"')
    yield "nel_title", CASE.replace("hostile", '"a\\Nb\\Lc\\Pd"')
    yield "lone_surrogate", CASE.replace("hostile", '"a\\ud800b"')
    yield "long_title", CASE.replace("hostile", "t" * 500_000)
    yield "long_name", CASE.replace("grinding_spindle", "g" * 100_000)
    yield "long_path", CASE.replace("grinding_spindle", "./" + "g" * 5000 + ".yaml")
    yield "path_of_many_folders", CASE.replace("grinding_spindle", "../" * 3000 + "a.yaml")
    yield "path_of_itself", CASE.replace("grinding_spindle", "case.yaml")
    yield "path_of_device", CASE.replace("grinding_spindle", "/dev/zero.yaml")
    yield "device", CASE.replace("grinding_spindle", "/dev/stdin/x.yaml")


def _values() -> Iterator[tuple[str, str]]:
    yield "huge_number", CASE.replace("6000 rpm", "1" * 5000 + " rpm")
    yield "huge_exponent", CASE.replace("6000 rpm", "1e99999 rpm")
    yield "huge_integer", CASE.replace("hostile", "9" * 6000)
    yield "underscores", CASE.replace("6000 rpm", "6_000 rpm")
    yield "sexagesimal", CASE.replace("6000 rpm", "1:30:00")
    yield "unit_bomb", CASE.replace("6000 rpm", "1 " + "*".join(["rpm"] * 3000))
    yield "unit_powers", CASE.replace("6000 rpm", "1 rpm^999999999")
    yield "deep_list", "a: " + "[" * 5000 + "]" * 5000
    yield "deep_mapping", "".join(" " * k + "a:\n" for k in range(900))
    yield "flow_open", CASE + "note: [" * 2000
    yield "empty", ""
    yield "comments", "# a\n" * 100_000
    yield "two_documents", CASE + "---\n" + CASE
    yield "tag", CASE + "note: !!python/object/apply:os.system [id]\n"
    yield "binary_tag", CASE + "note: !!binary aGVsbG8=\n"
    yield "merge_key", CASE + "<<: {note: x}\n"
    yield "complex_key", CASE + "? [a, b]\n: 1\n"
    yield "null_keys", CASE + "~: 1\n'': 2\nnull: 3\n"
    yield "list_root", "- a\n- b\n"
    yield "word_root", "hello\n"
    yield "dates", CASE.replace("hostile", "2024-01-01")
    yield "booleans", CASE.replace("hostile", "yes").replace("6000 rpm", "on")
    yield "nan_speed", CASE.replace("6000 rpm", ".nan").replace("0 rpm", ".inf")
    yield "right_to_left", CASE.replace("hostile", "\u202eabc\u202c \u0000".replace("\u0000", ""))
    yield "emoji", CASE.replace("hostile", "🌀" * 500)


def _machines() -> Iterator[tuple[str, str]]:
    yield (
        "sections",
        SHAFT.replace(
            "[{name: a, length: 500 mm, outer_diameter: 50 mm}]",
            "["
            + ", ".join(
                f"{{name: s{k}, length: 0.05 mm, outer_diameter: 50 mm}}" for k in range(9000)
            )
            + "]",
        ),
    )
    yield "tiny_sections", SHAFT.replace("500 mm", "1e-300 mm")
    yield (
        "points",
        SHAFT.replace(
            "{mid: 250 mm}", "{" + ", ".join(f"p{k}: {k / 100} mm" for k in range(20_000)) + "}"
        ),
    )
    yield (
        "same_names",
        SHAFT.replace(
            "    - {name: two",
            "".join("    - {name: one, x: 1 mm, stiffness: {yy: 1 N/um}}\n" for _ in range(2000))
            + "    - {name: two",
        ),
    )
    yield "references", CASE + "references: [" + "{quantity: x}, " * 5000 + "]\n"
    asked = "pairs: [{response: mid.y, excitation: mid.y}]"
    frf = f"  frf:\n    frequencies: {{from: 1 Hz, to: 1000 Hz, step: 1 Hz}}\n    {asked}\n"
    beside = "    measured: [{file: m.csv, response: mid.y, excitation: mid.y}]\n"
    yield "missing_curve", SHAFT + frf + beside
    yield "frequencies", SHAFT + frf.replace("step: 1 Hz", "step: 0.01 Hz")
    yield "frequencies_beyond", SHAFT + frf.replace("step: 1 Hz", "step: 1e-9 Hz")
    many = "pairs: [" + "{response: mid.y, excitation: mid.y}, " * 3000 + "]"
    yield "pairs", SHAFT + frf.replace(asked, many)


for _name, _text in (*_texts(), *_titles(), *_values(), *_machines()):
    FILES[_name] = case(_text)

MEASURED = SHAFT.replace(
    "analyses:\n",
    """analyses:
  frf:
    frequencies: {from: 5 Hz, to: 1000 Hz, step: 5 Hz}
    pairs: [{response: mid.y, excitation: mid.y}]
    measured: [{file: FILE, response: mid.y, excitation: mid.y}]
""",
).replace("one, x: 0 mm,", "one, x: 0 mm, damping: {yy: 100 N s/m, zz: 100 N s/m},")


def measured(name: str, content: bytes) -> Writer:
    def write(folder: Path) -> None:
        (folder / "case.yaml").write_text(MEASURED.replace("FILE", name), encoding="utf-8")
        (folder / name).write_bytes(content)

    return write


UFF = (
    "    -1\n    58\nname\nnone\n01-Jan-20 00:00:00\nnone\nnone\n"
    "    4         0    1         0       NONE         1   2       NONE         1   2\n"
    "{code:10d}{count:10d}         1  0.00000e+00  1.00000e+00  0.00000e+00\n"
    "        18    0    0    0            Frequency                   Hz\n"
    "         8    0    0    0         Displacement                    m\n"
    "        13    0    0    0                Force                    N\n"
    "         0    0    0    0                 NONE                 NONE\n"
    "{data}\n    -1\n"
)


def named(name: str) -> Writer:
    """A case that asks for a spindle in a file of such a name."""

    def write(folder: Path) -> None:
        (folder / name).write_text(SHAFT, encoding="utf-8")
        asked = json.dumps(f"./{name}", ensure_ascii=False)
        (folder / "case.yaml").write_text(CASE.replace("grinding_spindle", asked), encoding="utf-8")

    return write


def linked(target: str) -> Writer:
    """A case that is a link."""
    return lambda folder: (folder / "case.yaml").symlink_to(target)


FILES |= {"name_of_lines": named("a\nb.yaml"), "name_of_escapes": named("\x1b[31mr.yaml")}
FILES |= {
    f"link_{number}": linked(target)
    for number, target in enumerate(
        ("case.yaml", "gone.yaml", ".", "/dev/zero", "/proc/self/pagemap", "/proc/self/environ")
    )
}


def _curves() -> Iterator[tuple[str, str, bytes]]:
    head = b"frequency [Hz],real [m/N],imaginary [m/N]\n"
    rows = b"".join(b"%d,1e-8,1e-9\n" % k for k in range(10, 900, 10))
    yield "csv_fine", "m.csv", head + rows
    yield "csv_wide_field", "m.csv", head + b'"' + b"x" * 200_000 + b'",1,1\n'
    yield "csv_nul", "m.csv", head + b"1,\x00,3\n"
    yield (
        "csv_huge_values",
        "m.csv",
        head + b"".join(b"%d,1e%d,1e300\n" % (k, 200 + k) for k in range(1, 108)),
    )
    yield "csv_many_columns", "m.csv", b",".join([b"a"] * 100_000) + b"\n"
    yield "csv_empty", "m.csv", b""
    yield "csv_head_alone", "m.csv", head
    yield "csv_unsorted", "m.csv", head + b"20,1,1\n10,1,1\n10,2,2\n"
    yield "csv_nan", "m.csv", head + b"10,nan,1\n20,1,inf\n"
    yield "csv_latin", "m.csv", head + b"10,\xe9,1\n"
    yield "csv_utf16", "m.csv", (head + rows).decode().encode("utf-16")
    yield "csv_long_name", "n" * 240 + ".csv", head + rows
    for name, count in (("zero", 0), ("negative", -5), ("huge", 999_999_999), ("more", 400)):
        text = UFF.format(code=5, count=count, data="  1.0e-8 1.0e-9" * 3)
        yield f"uff_{name}_count", "m.uff", text.encode()
    yield "uff_words", "m.uff", UFF.format(code=5, count=3, data="x y z").encode()
    yield "uff_code", "m.uff", UFF.format(code=77, count=3, data="1 2 3").encode()
    yield "uff_cut", "m.uff", UFF[:200].encode()
    yield (
        "uff_binary",
        "m.uff",
        b"    -1\n    58b     1     2          11   999999999     0     0           0           0\n"
        + b"\x00" * 900,
    )
    yield "uff_empty", "m.uff", b""


for _name, _path, _content in _curves():
    FILES[_name] = measured(_path, _content)

HOUSED = SHAFT.replace("  points:", "  housings: [{name: h, model: MODEL}]\n  points:")


def housed(reference: str, files: dict[str, bytes]) -> Writer:
    def write(folder: Path) -> None:
        (folder / "case.yaml").write_text(HOUSED.replace("MODEL", reference), encoding="utf-8")
        for name, content in files.items():
            (folder / name).write_bytes(content)

    return write


def npz(members: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", method) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return held.getvalue()


def npy(array: np.ndarray) -> bytes:  # type: ignore[type-arg]
    held = io.BytesIO()
    np.save(held, array, allow_pickle=True)
    return held.getvalue()


def header(shape: str, kind: str = "<f8") -> bytes:
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}"
    text += " " * (63 - (len(text) + 10) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode()


def _archives() -> Iterator[tuple[str, dict[str, bytes]]]:
    two = npy(np.eye(2))
    good = {"mass.npy": two, "stiffness.npy": two, "places.npy": npy(np.array(["one.y", "two.y"]))}
    yield "npz_terabytes", {**good, "mass.npy": header("(1000000000000,)") + b"\0" * 80}
    yield "npz_negative", {**good, "mass.npy": header("(-1, 2)") + b"\0" * 80}
    yield "npz_pickle", {**good, "places.npy": npy(np.array([{"a": 1}], dtype=object))}
    yield "npz_inflates", {**good, "mass.npy": header("(20000, 20000)") + b"\0" * 300_000_000}
    yield "npz_nan", {**good, "mass.npy": npy(np.full((2, 2), np.nan))}
    yield "npz_huge", {**good, "stiffness.npy": npy(np.full((2, 2), 1e308))}
    yield "npz_words", {**good, "mass.npy": npy(np.array([["a", "b"], ["c", "d"]]))}
    yield "npz_missing", {"mass.npy": two}
    yield "npz_dots", {**good, "../evil.npy": two}
    yield "npz_cut_header", {**good, "mass.npy": b"\x93NUMPY\x01\x00\xff\xff{"}
    yield "npz_shape_words", {**good, "mass.npy": header("('a', __import__('os'))")}


for _name, _members in _archives():
    FILES[_name] = lambda folder, m=_members: housed("m.npz", {"m.npz": npz(m)})(folder)
FILES["npz_broken"] = housed("m.npz", {"m.npz": npz({"mass.npy": npy(np.eye(300))})[:-400]})
FILES["npz_garbled"] = housed(
    "m.npz",
    {"m.npz": bytes(b ^ (k % 7 == 3) for k, b in enumerate(npz({"mass.npy": npy(np.eye(40))})))},
)
FILES["npz_text"] = housed("m.npz", {"m.npz": b"hello"})


def _markets() -> Iterator[tuple[str, bytes]]:
    head = b"%%MatrixMarket matrix coordinate real general\n"
    good = head + b"2 2 2\n1 1 1.0\n2 2 1.0\n"
    yield "mtx_fine", good
    yield "mtx_rows", head + b"1000000000 1000000000 1\n1 1 1.0\n"
    yield "mtx_entries", head + b"2 2 4600000000\n1 1 1.0\n"
    yield "mtx_overflow", head + b"2 2 1\n99999999999999999999999 1 1.0\n"
    yield "mtx_dense", b"%%MatrixMarket matrix array real general\n100000 100000\n1.0\n"
    yield "mtx_negative", head + b"-2 2 1\n1 1 1.0\n"
    yield "mtx_outside", head + b"2 2 1\n7 7 1.0\n"
    yield "mtx_words", head + b"2 2 1\n1 1 x\n"
    yield "mtx_empty", b""
    yield "mtx_pattern", b"%%MatrixMarket matrix coordinate pattern general\n2 2 1\n1 1\n"
    yield "mtx_complex", b"%%MatrixMarket matrix coordinate complex general\n2 2 1\n1 1 1 1\n"


for _name, _content in _markets():
    FILES[_name] = housed(
        "{mass: m.mtx, stiffness: k.mtx, places: [one.y, two.y]}",
        {
            "m.mtx": _content,
            "k.mtx": b"%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 1e8\n2 2 1e8\n",
        },
    )
