"""Frequency responses as Universal File Format data sets of type 58, through ``pyuff``."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.results.declaration import declared
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, is_rotation

_DIRECTION = {"x": 1, "y": 2, "z": 3, "thx": 4, "thy": 5, "thz": 6}
_FREQUENCY, _FORCE, _RPM = 18, 13, 19


class Motion(NamedTuple):
    """What the response of a kind is: code of the format, name, unit past metre or radian."""

    code: int
    name: str
    per_time: str


MOTION = {
    "receptance": Motion(8, "displacement", ""),
    "mobility": Motion(11, "velocity", "/s"),
    "inertance": Motion(12, "acceleration", "/s^2"),
}


def write_file(folder: Path, case: Described, result: FrequencyResponse) -> int:
    """``frf.uff`` with the named points of the machine as nodes; returns the number of records."""
    places = () if case.spindle is None else case.spindle.places
    nodes = {name: k for k, name in enumerate(places, start=1)}
    return write_uff(folder / "frf.uff", result, case=case.name, nodes=nodes)


def write_uff(
    path: Path,
    result: FrequencyResponse,
    *,
    case: str,
    nodes: Mapping[str, int],
    binary: bool = True,
) -> int:
    """Write one record per slice speed and pair; returns how many there are.

    ``nodes``: number of each named point, as it will stand in the file. ``binary``: type 58b,
    exact; otherwise text of twelve digits.
    """
    import pyuff

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
            pyuff.UFF(str(path)).write_sets(sets, "add")
    return len(sets)


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
        "id1": f"{result.kind} {pair} [{result.unit(place)}]"[:80],
        "id2": f"case {case}"[:80],
        "id3": f"speed {rpm:.6g} rpm ({float(result.speed[index]):.9g} rad/s)",
        "id4": f"computed by rotordyn, SI units; {labels[result.kind]}",
        "id5": "NONE",
        "load_case_id": 0,
        "ver_num": index + 1,
        "rsp_ent_name": out[:10],
        "rsp_node": nodes[out],
        "rsp_dir": _DIRECTION[out_dof],
        "ref_ent_name": inp[:10],
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


def _even_step(frequency: NDArray[np.float64]) -> float:
    """The step of an even axis [Hz]; 0 where the six digits of the header would bend it."""
    if frequency.size < 2:
        return 0.0
    first, step = (float(f"{v:.5e}") for v in (frequency[0], frequency[1] - frequency[0]))
    even = np.allclose(first + step * np.arange(frequency.size), frequency, rtol=0.0, atol=1e-9)
    return step if even else 0.0
