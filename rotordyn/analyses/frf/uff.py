"""Frequency responses in the Universal File Format, through ``pyuff``.

A record of units (type 164: SI), the points as nodes on the axis of the rotor (type 2411), then one
function (type 58) per slice speed and pair. The format allows ASCII only.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rotordyn.analyses.contract import File
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.arrays import Array
from rotordyn.errors import LeftOut
from rotordyn.plain import plain
from rotordyn.results.declaration import declared
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, is_rotation

if TYPE_CHECKING:
    from rotordyn.machine.rotor import Place

_UNITS = {
    "type": 164,
    "units_code": 1,
    "units_description": "SI: Meter (newton)",
    "temp_mode": 2,
    "length": 1.0,
    "force": 1.0,
    "temp": 1.0,
    "temp_offset": 273.15,
}
_DIRECTION = {"x": 1, "y": 2, "z": 3, "thx": 4, "thy": 5, "thz": 6}
HEAD = 12  # lines of a binary record before its data
_FREQUENCY, _FORCE, _RPM = 18, 13, 19


class Motion(NamedTuple):
    """Motion of a kind of response: code of the format, name, unit after metre or radian."""

    code: int
    name: str
    per_time: str


MOTION = {
    "receptance": Motion(8, "displacement", ""),
    "mobility": Motion(11, "velocity", "/s"),
    "inertance": Motion(12, "acceleration", "/s^2"),
}


def files(folder: Path, case: Described, result: FrequencyResponse) -> Iterator[File]:
    """``frf.uff`` with the named points of the machine as nodes."""
    places = {} if case.spindle is None else case.spindle.places
    path = folder / "frf.uff"
    write = partial(write_uff, path, result, case=case.name, places=places)
    yield path.name, _no_record if len(result.frequency) == 1 else write


def _no_record() -> None:
    raise LeftOut("one frequency, but a record needs two or more: give more frequencies")


def write_uff(
    path: Path,
    result: FrequencyResponse,
    *,
    case: str,
    places: Mapping[str, Place],
    binary: bool = True,
) -> int:
    """Write one function per slice speed and pair; returns how many there are.

    ``places``: of each named point, which become the nodes 1, 2 … in this order. ``binary``: type
    58b, exact; otherwise text of twelve digits. Without any function there is no file.
    """
    import pyuff

    nodes = {name: number for number, name in enumerate(places, start=1)}
    sets = [
        _record(result, index, place, case=case, nodes=nodes, binary=binary)
        for index in np.flatnonzero(result.is_slice).tolist()
        for place in range(len(result.pair))
        if len(result.frequency) > 1 and np.isfinite(result.curve(index, place)[1]).all()
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)  # pyuff leaves closing to the interpreter
        path.unlink(missing_ok=True)  # its mode "overwrite" loses the head of a binary record
        if sets:
            pyuff.UFF(str(path)).write_sets([_UNITS, _nodes(places), *sets], "add")
    if sets and binary:
        _correct_sizes(path, sets)
    return len(sets)


def _correct_sizes(path: Path, sets: Sequence[Mapping[str, Any]]) -> None:
    """Correct the byte counts in the heads of binary records: ``pyuff`` writes those of one real
    number per point, and readers that rely on them would lose the rest."""
    content, at = bytearray(path.read_bytes()), 0
    for data_set in sets:
        at = content.index(b"    58b", at)
        size = data_set["num_pts"] * (16 if data_set["abscissa_spacing"] else 24)
        content[at + 31 : at + 43] = b"%12d" % size
        for _ in range(HEAD):
            at = content.index(b"\n", at) + 1
        at += size
    path.write_bytes(content)


def _nodes(places: Mapping[str, Place]) -> dict[str, Any]:
    station = [float(place.x) for place in places.values()]
    numbers, zeros = list(range(1, len(station) + 1)), [0] * len(station)
    systems = {"def_cs": zeros, "disp_cs": zeros, "color": zeros}
    return {"type": 2411, "node_nums": numbers, "x": station, "y": zeros, "z": zeros, **systems}


def _record(
    result: FrequencyResponse,
    index: int,
    place: int,
    *,
    case: str,
    nodes: Mapping[str, int],
    binary: bool,
) -> dict[str, Any]:
    """The fields of one function at one slice; units are SI."""
    pair, rpm = result.pair[place], float(result.speed[index]) * RPM.factor
    (out, out_dof), (inp, in_dof) = (port.rpartition(".")[::2] for port in pair.split(" / "))
    motion = MOTION[result.kind]
    response = f"[{'rad' if is_rotation(out_dof) else 'm'}{motion.per_time}]"
    load = "[N m]" if is_rotation(in_dof) else "[N]"
    frequency, values = result.curve(index, place)
    labels = {name: field.metadata["label"] for name, field in declared(result).items()}
    step = _even_step(frequency)
    return {
        "type": 58,
        "binary": int(binary),
        "func_type": 4,
        "id1": plain(f"{result.kind} {pair} [{result.unit(place)}]")[:80],
        "id2": plain(f"case {case}")[:80],
        "id3": f"speed {rpm:.6g} rpm ({float(result.speed[index]):.9g} rad/s)",
        "id4": plain(f"computed by rotordyn, SI units; {labels[result.kind]}")[:80],
        "id5": "NONE",
        "load_case_id": 0,
        "ver_num": index + 1,
        "rsp_ent_name": plain(out)[:10],
        "rsp_node": nodes[out],
        "rsp_dir": _DIRECTION[out_dof],
        "ref_ent_name": plain(inp)[:10],
        "ref_node": nodes[inp],
        "ref_dir": _DIRECTION[in_dof],
        "ord_data_type": 6,
        "abscissa_spacing": int(step > 0.0),
        "abscissa_min": frequency[0],
        "abscissa_inc": step,
        "num_pts": frequency.size,
        "z_axis_value": rpm,
        "abscissa_spec_data_type": _FREQUENCY,
        "abscissa_axis_lab": labels["frequency"][:20],
        "abscissa_axis_units_lab": "Hz",
        "ordinate_spec_data_type": motion.code,
        "ordinate_axis_lab": motion.name,
        "ordinate_axis_units_lab": response,
        "orddenom_spec_data_type": _FORCE,
        "orddenom_axis_lab": "excitation",
        "orddenom_axis_units_lab": load,
        "z_axis_spec_data_type": _RPM,
        "z_axis_axis_lab": "speed",
        "z_axis_axis_units_lab": "rpm",
        "data": values,
        "x": frequency,
    }


def _even_step(frequency: Array) -> float:
    """Step of an even axis [Hz]; 0 where the six digits of the header do not reproduce it."""
    if frequency.size < 2:
        return 0.0
    first, step = (float(f"{v:.5e}") for v in (frequency[0], frequency[1] - frequency[0]))
    even = np.allclose(first + step * np.arange(frequency.size), frequency, rtol=0.0, atol=1e-9)
    return step if even else 0.0
