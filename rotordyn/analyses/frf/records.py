"""Measured frequency responses from files: a record of UFF type 58, or columns of a CSV table."""

from __future__ import annotations

import cmath
import math
import os
import re
import warnings
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from rotordyn.analyses.measured_response import NO_RESPONSE, QUANTITIES, out_of_range
from rotordyn.delimited import Row
from rotordyn.delimited import rows as rows_of
from rotordyn.errors import InvalidInput
from rotordyn.quantity import FREQUENCY
from rotordyn.results.display import is_rotation, response_unit
from rotordyn.units import STANDARD_GRAVITY, parse_unit, shown, without_brackets

_MOTIONS = {8: "receptance", 11: "mobility", 12: "inertance"}
_OF_FILE = ("length of a metre", "force of a newton")  # in the units of a file
_FRF, _COHERENCE, _COMPLEX = 4, 6, (5, 6)
_ROTATION, AXES = 19, 3  # kind of the third axis; directions beyond three are rotations
_COLUMN = re.compile(r"\s*(.*?)\s*\[([^\[\]]*)\]\s*")
_WORDS = {
    "frequency": "frequency",
    "real": "real",
    "imaginary": "imaginary",
    "imag": "imaginary",
    "amplitude": "amplitude",
    "phase": "phase",
    "coherence": "coherence",
}
# Units as analysers write them in capitals; none of these means another unit.
_CAPITALS = {unit.upper(): unit for unit in ("m", "mm", "um", "s", "g", "rad", "kN", "in", "lbf")}
_SAME = ("rsp_node", "rsp_dir", "ref_node", "ref_dir", "z_axis_value")
_FORMS = "frequency with real and imaginary, or with amplitude and phase"


class Record(NamedTuple):
    """A measured ``quantity`` of ``QUANTITIES`` in SI over frequency [Hz]; ``coherence`` γ² and
    ``speed`` [rad/s] of the spindle where the file has them."""

    quantity: str
    frequency: tuple[float, ...]
    values: tuple[complex, ...]
    coherence: tuple[float, ...] = ()
    speed: float | None = None


def read_record(path: Path, pair: str, number: int | None) -> Record:
    """The response ``pair`` (``tip.y / tip.y``) in a file; ``number`` of the record, from 1.

    Files that end in .csv are tables, all others UFF.

    Raises
    ------
    InvalidInput : the file cannot be read, or holds something else; one sentence
    """
    if not os.path.isfile(path):  # False for an invalid name, too
        raise InvalidInput("no such file")
    if path.suffix.lower() != ".csv":
        return _from_uff(path, pair, number)
    if number is not None:
        raise InvalidInput("a CSV table has no records: leave record out")
    return _from_table(path, pair)


def _from_uff(path: Path, pair: str, number: int | None) -> Record:
    sets = _sets_58(path)
    frf_sets = [data_set for data_set in sets if data_set.get("func_type") == _FRF]
    if number is None and len(sets) > 1 and len(frf_sets) != 1:
        raise InvalidInput(f"{len(sets)} records of type 58: give record, 1 to {len(sets)}")
    if number is not None and number > len(sets):
        raise InvalidInput(f"no record {number}: the file has {len(sets)} of type 58")
    data_set = sets[number - 1] if number is not None else [*frf_sets, *sets][0]
    if data_set.get("func_type") != _FRF or data_set.get("ord_data_type") not in _COMPLEX:
        raise InvalidInput("the record is not a complex frequency response function")
    frequency, values = [float(f) for f in data_set["x"]], [complex(v) for v in data_set["data"]]
    if _label(data_set, "abscissa").upper() not in ("", "HZ"):
        raise InvalidInput(f"frequency in {shown(_label(data_set, 'abscissa'))}; allowed: Hz")
    quantity, scale = _uff_unit(data_set, pair)
    scale *= _sign(data_set, pair)
    coherence = next((other for other in sets if _coherence_of(data_set, other)), None)
    gamma = () if coherence is None else [complex(value).real for value in coherence["data"]]
    record = _record(pair, quantity, frequency, [scale * value for value in values], gamma)
    return record._replace(speed=_speed(data_set))


def _sign(data_set: dict[str, Any], pair: str) -> float:
    """Sign of a record: −1 where motion and force have opposite directions, such as −y and +y.

    Axes of the record may have other names than those of the case, but the same for both ends; a
    direction of 0 is unknown.
    """
    directions = [int(data_set.get(key) or 0) for key in ("rsp_dir", "ref_dir")]
    ends = [port.rpartition(".")[2] for port in pair.split(" / ")]
    for direction, end, what in zip(directions, ends, ("response", "excitation"), strict=True):
        if direction and (abs(direction) > AXES) != is_rotation(end):
            raise InvalidInput(
                f"the record has its {what} in direction {direction}, a "
                f"{'rotation' if abs(direction) > AXES else 'translation'}, but {end} of {pair} is "
                "not one"
            )
    if all(directions) and ends[0] == ends[1] and abs(directions[0]) != abs(directions[1]):
        raise InvalidInput(
            f"the record has its response in direction {directions[0]} and its excitation in "
            f"{directions[1]}, but {pair} has both in one direction"
        )
    if all(directions) and ends[0] != ends[1] and abs(directions[0]) == abs(directions[1]):
        raise InvalidInput(
            f"the record has response and excitation in direction {abs(directions[0])}, "
            f"but {pair} has them in two directions"
        )
    return -1.0 if directions[0] * directions[1] < 0 else 1.0


def _speed(data_set: dict[str, Any]) -> float | None:
    """Spindle speed [rad/s], without sign, where the third axis of a record gives it in a known
    unit, Hz among them (rpm without a unit); else None. 0 counts as unknown."""
    if data_set.get("z_axis_spec_data_type") != _ROTATION:
        return None
    try:
        unit = _label(data_set, "z_axis")
        unit = "rpm" if unit.lower() in ("", "rpm") else unit
        is_hertz = unit.upper() == "HZ"
        scale = math.tau if is_hertz else _plain(unit, "rpm", "speed", "rpm, rad/s")
    except InvalidInput:
        return None
    return abs(float(data_set["z_axis_value"])) * scale or None


def _coherence_of(data_set: dict[str, Any], other: dict[str, Any]) -> bool:
    """Whether another record is the coherence of a response."""
    return other.get("func_type") == _COHERENCE and all(
        other.get(key) == data_set.get(key) for key in _SAME
    )


def _sets_58(path: Path) -> list[dict[str, Any]]:
    import pyuff

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # files left open, old numpy calls
        try:
            file = pyuff.UFF(str(path))
            kinds = [*enumerate(file.get_set_types())]
            data_sets = [file.read_sets(k) for k, kind in kinds if kind == 58]
            units = [file.read_sets(k) for k, kind in kinds if kind == 164]
        except Exception as error:  # noqa: BLE001 - pyuff raises what its parser meets
            raise InvalidInput(f"not a UFF file that can be read: {error}") from None
    if not data_sets:
        raise InvalidInput("the file has no record of type 58")
    sizes = [units[-1][key] for key in ("length", "force")] if units else [1.0, 1.0]
    return [{**data_set, **dict(zip(_OF_FILE, sizes, strict=True))} for data_set in data_sets]


def _label(data_set: dict[str, Any], axis: str) -> str:
    text = str(data_set.get(f"{axis}_axis_units_lab") or "").strip().strip("[]")
    return "" if text.upper() == "NONE" else text


def _uff_unit(data_set: dict[str, Any], pair: str) -> tuple[str, float]:
    """Quantity and factor to SI of a record. A single label holds the whole unit, or the missing
    part is in SI. A record without labels is in the units of its file, by default SI."""
    code = data_set.get("ordinate_spec_data_type")
    motion, load = _label(data_set, "ordinate"), _label(data_set, "orddenom")
    if code in _MOTIONS and not (motion or load):
        return _MOTIONS[code], _of_file(data_set, pair)
    quantity, scale = _unit(_response(motion, load, code, pair), pair)
    if code in _MOTIONS and quantity != _MOTIONS[code]:
        raise InvalidInput(
            f"the data type of the record is {_MOTIONS[code]}, but its unit is that of {quantity}"
        )
    return quantity, scale


def _response(motion: str, load: str, code: object, pair: str) -> str:
    """Unit of a response from its labels, of which one may be missing."""
    kind = _MOTIONS.get(code, "") if isinstance(code, int) else ""
    si_parts = response_unit(pair, kind or "receptance").rpartition("/")
    if motion and not load:
        try:
            _unit(motion, pair)
        except InvalidInput:
            return f"({motion})/({si_parts[2]})"
        return motion
    return f"({motion or (si_parts[0] if kind else '')})/({load})"


def _of_file(data_set: dict[str, Any], pair: str) -> float:
    """Factor to SI of a response in the units of its file (a set of type 164)."""
    length, force = (1.0 / float(data_set[key]) for key in _OF_FILE)
    response, excitation = (is_rotation(port.rpartition(".")[2]) for port in pair.split(" / "))
    return (1.0 if response else length) / (force * length if excitation else force)


def _unit(text: str, pair: str) -> tuple[str, float]:
    """Quantity and factor to SI of a unit such as ``(mm/s)/N`` or ``rad/(N·m)``; g over a force is
    the standard acceleration of gravity."""
    spelled = _flat(
        re.sub(r"\b[A-Z]+(?![a-z])", lambda word: _CAPITALS.get(word[0], word[0]), text)
    )
    accelerated = re.sub(r"^\s*gn?\s*(?=/)", "m/s^2", spelled)
    try:
        unit = parse_unit(accelerated)
    except InvalidInput:
        unit = None
    factor = 1.0 if accelerated == spelled else STANDARD_GRAVITY
    for quantity in QUANTITIES:
        si_unit = parse_unit(_flat(response_unit(pair, quantity)))
        if unit is not None and unit.dimension == si_unit.dimension:
            return quantity, unit.scale * factor
    allowed = ", ".join(response_unit(pair, quantity) for quantity in QUANTITIES)
    raise InvalidInput(f"not a unit of {pair}: given {shown(text)}; allowed: {allowed}")


def _flat(text: str) -> str:
    """A unit without brackets, in which s2 is s²."""
    return re.sub(r"(?<=s)2\b", "^2", without_brackets(text))


def _from_table(path: Path, pair: str) -> Record:
    rows = _rows(path)
    columns = _columns(rows[0].cells, pair)
    _refuse_widths(rows)
    numbers = rows[1:]
    frequency = _scaled(numbers, columns["frequency"], _hertz(columns["frequency"][1]))
    first, second = (("real", "imaginary"), ("amplitude", "phase"))["amplitude" in columns]
    coherence_column = columns.get("coherence")
    coherence = [] if coherence_column is None else _scaled(numbers, coherence_column, 1.0)
    quantity, scale = _unit(columns[first][1], pair)
    first_part = _scaled(numbers, columns[first], scale)
    if second == "imaginary":
        other, factor = _unit(columns[second][1], pair)
        if other != quantity:
            raise InvalidInput(
                f"real part in a unit of {quantity}, imaginary part in a unit of {other}"
            )
        imaginary = _scaled(numbers, columns[second], factor)
        return _record(
            pair, quantity, frequency, list(map(complex, first_part, imaginary)), coherence
        )
    phase = _scaled(numbers, columns[second], _angle(columns[second][1]))
    if min(first_part, default=0.0) < 0.0:
        raise InvalidInput(f"an amplitude below zero: given {min(first_part) / scale:g}")
    values = [cmath.rect(a, p) for a, p in zip(first_part, phase, strict=True)]
    return _record(pair, quantity, frequency, values, coherence)


def _rows(path: Path) -> list[Row]:
    """Rows of a table in UTF-8, the header first."""
    try:
        rows = rows_of(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError as error:
        raise InvalidInput(f"not a table in UTF-8: {error}") from None
    if not rows:
        raise InvalidInput("the file is empty")
    return rows


def _columns(header: Sequence[str], pair: str) -> dict[str, tuple[int, str]]:
    """Index and unit of every column in use; of several of one kind, that which names the pair."""
    columns: dict[str, list[tuple[int, str, str]]] = {}
    for place, cell in enumerate(header):
        match = _COLUMN.fullmatch(cell)
        words = (match[1] if match else cell).lower().split()
        if words and words[-1] in _WORDS:
            unit = match[2] if match else ""
            columns.setdefault(_WORDS[words[-1]], []).append((place, unit, cell))
    chosen = {}
    for word, places in columns.items():
        naming_pair = [entry for entry in places if pair in entry[2]]
        if len(places) > 1 and len(naming_pair) != 1:
            raise InvalidInput(f"{len(places)} columns for {word}: one must name {pair}")
        place, unit, cell = (naming_pair or places)[0]
        if not unit.strip() and word != "coherence":
            raise InvalidInput(f"column {shown(cell)} has no unit: write it as '{word} [unit]'")
        chosen[word] = (place, unit)
    complete = {"real", "imaginary"} <= chosen.keys() or {"amplitude", "phase"} <= chosen.keys()
    if "frequency" not in chosen or not complete:
        raise InvalidInput(f"columns missing: given {shown(', '.join(header))}; allowed: {_FORMS}")
    return chosen


def _refuse_widths(rows: Sequence[Row]) -> None:
    width = len(rows[0].cells)
    for line, cells in rows[1:]:
        if len(cells) != width:
            raise InvalidInput(f"line {line} has {len(cells)} values where the header has {width}")


def _scaled(rows: Sequence[Row], column: tuple[int, str], scale: float) -> list[float]:
    """Values of a column in SI; columns not in use are not checked."""
    place, values = column[0], []
    for line, cells in rows:
        value = _number(cells[place]) * scale
        if not math.isfinite(value):
            raise InvalidInput(
                f"line {line}, column {place + 1}: not a finite number: given "
                f"{shown(cells[place].strip())}; allowed: such as 0.00125 or 1.25e-3"
            )
        values.append(value)
    return values


def _number(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return math.nan


def _hertz(unit: str) -> float:
    return _plain(unit, "Hz", "frequency", "Hz, kHz")


def _angle(unit: str) -> float:
    return _plain(unit, "rad", "phase", "deg, rad")


def _plain(text: str, like: str, what: str, allowed: str) -> float:
    try:
        unit = parse_unit(text)
    except InvalidInput:
        unit = None
    if unit is None or unit.dimension != parse_unit(like).dimension:
        raise InvalidInput(f"not a unit of {what}: given {shown(text)}; allowed: {allowed}")
    return unit.scale


def _record(
    pair: str,
    quantity: str,
    frequency: list[float],
    values: list[complex],
    coherence: Sequence[float] = (),
) -> Record:
    if len(frequency) != len(values):
        raise InvalidInput(f"{len(values)} values at {len(frequency)} frequencies")
    if coherence and len(coherence) != len(frequency):
        raise InvalidInput(f"{len(coherence)} values of coherence at {len(frequency)} frequencies")
    if frequency[:1] == [0.0]:  # the DC line, with which records of analysers begin
        frequency, values, coherence = frequency[1:], values[1:], coherence[1:]
    _refuse_frequencies(frequency)
    if not any(values):
        raise InvalidInput(NO_RESPONSE)
    if not all(map(cmath.isfinite, values)):
        raise InvalidInput("a value is not a finite number")
    if why := out_of_range(frequency, values, response_unit(pair, quantity)):
        raise InvalidInput(why)
    for value in coherence:
        if not 0.0 <= value <= 1.0:
            raise InvalidInput(f"coherence: given {value:g}; allowed: from 0 to 1")
    return Record(quantity, tuple(frequency), tuple(values), tuple(coherence))


def _refuse_frequencies(frequency: Sequence[float]) -> None:
    """Refuse fewer than two [Hz], those out of range, and any that do not ascend."""
    if len(frequency) < 2:
        raise InvalidInput(f"too few frequencies: given {len(frequency)}; allowed: at least 2")
    for refusal in filter(None, map(FREQUENCY.refusal, frequency)):
        raise InvalidInput(refusal)
    for place, (previous, value) in enumerate(pairwise(frequency), start=2):
        if value <= previous:
            how = "repeated" if value == previous else "not in ascending order"
            raise InvalidInput(f"frequency {place}: {how}: given {value:.6g} after {previous:.6g}")
