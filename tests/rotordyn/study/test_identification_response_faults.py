"""Frequency responses that cannot be used: a sentence for each fault."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import pyuff

from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.measured_response import MeasuredResponse
from rotordyn.errors import InvalidInput
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.solve import identify
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import Unknown
from tests.rotordyn.study.rotor_twin import (
    FREQUENCY,
    OUTER,
    blank,
    case,
    measured,
    spindle,
    unknowns,
)

Values = np.ndarray[Any, np.dtype[np.complex128]]
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")


def changed(of: Responses, **how: object) -> Responses:
    return replace(of, **{"noise": of.noise, **how})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ({"noise": None}, "give noise, or averages beside a coherence"),
        ({"noise": 0.8}, "noise: given 0.8"),
        ({"averages": 10}, "has no coherence, which averages need"),
        ({"gain": 1.0}, "gain: given 1"),
        ({"responses": ()}, "holds no responses"),
    ],
)
def test_faults_of_a_measurement(taps: Responses, how: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        changed(taps, **how)


def test_responses_of_another_length_are_refused(taps: Responses) -> None:
    first, second, *rest = taps.responses
    short = replace(
        second,
        frequency=second.frequency[:90],
        real=second.real[:90],
        imaginary=second.imaginary[:90],
    )
    with pytest.raises(InvalidInput, match=r"tail\.y / tip\.y at 0 rpm has 90 frequencies"):
        changed(taps, responses=(first, short, *rest))
    with pytest.raises(InvalidInput, match="given twice"):
        changed(taps, responses=(first, first))


def test_a_coherence_that_says_nothing_swamps(taps: Responses) -> None:
    first = replace(taps.responses[0], coherence=(0.05,) * len(FREQUENCY))
    with pytest.raises(InvalidInput, match="noise dominates it"):
        Responses(name="taps", responses=(first,), averages=10)


def test_noise_alone_is_no_response(taps: Responses) -> None:
    rng, first = np.random.default_rng(3), taps.responses[0]
    values = rng.normal(size=(2, len(FREQUENCY)))
    alone = replace(first, real=tuple(values[0].tolist()), imaginary=tuple(values[1].tolist()))
    with pytest.raises(InvalidInput, match=r"noise dominates .* at 0 rpm: no sum"):
        assert Responses(name="taps", responses=(alone,), noise=0.02).data


@pytest.mark.parametrize("speed", [0.0, 700.0])
@pytest.mark.parametrize(
    ("turned", "sentence"),
    [
        (np.conj, r"imaginary part is positive: sign convention e\^\{−iωt\}"),
        (np.negative, "a sensor opposite to the force"),
    ],
)
def test_signs_of_driving_points_are_reported(
    taps: Responses, speed: float, turned: Callable[[Values], Values], sentence: str
) -> None:
    """Of a rotor at rest and in rotation; other responses may have any phase."""
    one = next(r for r in taps.responses if r.speed == speed and r.response == r.excitation)
    values = turned(np.array(one.real) + 1j * np.array(one.imaginary))
    wrong = replace(one, real=tuple(values.real.tolist()), imaginary=tuple(values.imag.tolist()))
    with pytest.raises(
        InvalidInput, match=rf"tip\.y at .* rpm is not that of a driving point: .*{sentence}"
    ):
        assert Responses(name="taps", responses=(wrong,), noise=0.02).data
    across = replace(wrong, response=replace(wrong.response, point="tail"))
    assert not Responses(name="taps", responses=(across,), noise=0.02)._turned(across)


def test_unknown_points_are_refused_before_anything_is_solved(taps: Responses) -> None:
    bare = replace(spindle(), points={"tip": 0.0})
    with pytest.raises(InvalidInput, match=r"measurement taps: .*'tail'"):
        identify(case(bare), unknowns(0.1), [taps], workers=1)


def test_more_unknowns_than_modes_carry_are_refused(taps: Responses) -> None:
    """Below the first mode one pole says all: 2 numbers, and 3 of its residue and a constant."""
    one = taps.responses[0]
    inside = [k for k, f in enumerate(one.frequency) if f < 240.0]
    parts = ("frequency", "real", "imaginary")
    cut = replace(one, **{name: tuple(getattr(one, name)[k] for k in inside) for name in parts})
    of = Responses(name="taps", responses=(cut,), noise=0.02)
    assert of.carried < 10
    sections = spindle().shaft.sections
    asked = dict(unknowns(0.1))
    for k, part in enumerate(sections):
        path = f"spindle.shaft.sections.s{k}."
        asked[path + "length"] = Unknown(0.9 * part.length, 1.1 * part.length)
        asked.setdefault(path + "outer_diameter", Unknown(0.6 * OUTER[k], 1.5 * OUTER[k]))
    with pytest.raises(
        InvalidInput, match=rf"12 are given, more than numbers measured \({of.carried}\)"
    ):
        identify(case(spindle()), asked, [of], workers=1)


def test_coherence_comes_with_its_response(tmp_path: Path) -> None:
    """Of a UFF file that of the same points; of a table its column. √((1 − γ²)/(2 n γ²)) of ten
    averages and γ² = 0.9921 is 2 %."""
    uff, table = tmp_path / "tap.uff", tmp_path / "tap.csv"
    same = {"type": 58, "rsp_node": 1, "rsp_dir": 2, "ref_node": 1, "ref_dir": 2, "x": FREQUENCY}
    ordinate = {"ordinate_spec_data_type": 8, "orddenom_spec_data_type": 13}
    same |= {"abscissa_spec_data_type": 18, "num_pts": len(FREQUENCY)}
    whole = np.full(len(FREQUENCY), 1e-6 + 1e-7j)
    records = (
        {**same, **ordinate, "func_type": 4, "ord_data_type": 5, "data": whole},
        {
            **same,
            **dict.fromkeys(ordinate, 0),
            "func_type": 6,
            "ord_data_type": 2,
            "data": np.full(len(FREQUENCY), 0.9921),
        },
    )
    for record in records:
        even = {"abscissa_spacing": 1, "abscissa_min": 150.0, "abscissa_inc": FREQUENCY[1] - 150.0}
        pyuff.UFF(str(uff)).write_sets({**record, **even}, "add")
    lines = [f"{f:g},1,0.1,0.9921" for f in FREQUENCY]
    head = "frequency [Hz],real [um/N],imaginary [um/N],coherence"
    table.write_text("\n".join([head, *lines]) + "\n")
    for path in (uff, table):
        record = read_record(path, "tip.y / tip.y", None)
        np.testing.assert_allclose(record.coherence, 0.9921, rtol=1e-4)
        np.testing.assert_allclose(record.values, 1e-6 + 1e-7j, rtol=1e-4)
        one = replace(blank("tip", 0.0), coherence=record.coherence)
        relative = Responses(name="taps", responses=(one,), averages=10)._relative(one)
        np.testing.assert_allclose(relative, 0.02, rtol=0.01)
    table.write_text("\n".join([head, *lines[:3], f"{FREQUENCY[3]:g},1,0.1,1.2"]) + "\n")
    with pytest.raises(InvalidInput, match=r"coherence: given 1\.2; allowed: from 0 to 1"):
        read_record(table, "tip.y / tip.y", None)


ASKED = """case: grinding_spindle
unknowns:
  spindle.discs.wheel.width: {from: 20 mm, to: 45 mm}
measurements:
  taps:
    kind: frequency responses
%s"""


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ("    noise: 2 %\n", "responses: missing key"),
        ("    noise: 2 %\n    responses: [{file: no.csv, response: nose.y, excitation: nose.y}]\n",
         "no.csv: no such file"),
        ("    noise: 2 N\n    responses: [{file: no.csv, response: nose.y, excitation: nose.y}]\n",
         "noise"),
    ],
)  # fmt: skip
def test_faults_of_a_file_have_their_line(tmp_path: Path, keys: str, sentence: str) -> None:
    path = tmp_path / "taps.yaml"
    path.write_text(ASKED % keys)
    with pytest.raises(InvalidInput, match=rf"taps\.yaml:\d+.*{sentence}"):
        read_identification(path)


DRIFT = 2000.0  # m/N Hz⁴: of the charge amplifier of an accelerometer, at low frequencies


def with_floor(seed: int, *, coherent: bool) -> Responses:
    """Responses of the synthetic rotor whose noise is 1 % and a drift, which swamps the
    lowest lines; the coherence of ten averages shows it."""
    exact, rng = measured(spindle(), noise=0.0), np.random.default_rng(seed)

    def noisy(one: MeasuredResponse) -> MeasuredResponse:
        value = np.array(one.real) + 1j * np.array(one.imaginary)
        deviation = np.hypot(0.01 * np.abs(value), DRIFT / FREQUENCY**4)
        coherence = 1.0 / (1.0 + 20.0 * (deviation / np.abs(value)) ** 2)
        real, imaginary = rng.normal(size=(2, len(value))) * deviation
        return replace(
            one,
            real=tuple((value.real + real).tolist()),
            imaginary=tuple((value.imag + imaginary).tolist()),
            coherence=tuple(coherence.tolist()),
        )

    responses = tuple(map(noisy, exact.responses))
    ways: Any = {"averages": 10} if coherent else {"noise": 0.02}
    return Responses(name="taps", responses=responses, **ways)


@pytest.mark.parametrize("seed", range(3))
def test_lines_that_the_coherence_says_are_noise_do_not_count(seed: int) -> None:
    """The others scatter about the true machine as their coherence says: χ² of as many values, of
    which a fit to the same samples takes a few."""
    of = with_floor(seed, coherent=True)
    exact = of.predicted(Trial(case(spindle())))
    every = 2 * len(FREQUENCY) * len(of.responses)
    assert 0.5 * every < len(of.data.observed) < 0.95 * every
    square = np.mean(((of.data.observed - exact) / of.data.deviation) ** 2)
    assert square == pytest.approx(1.0, abs=4.0 * np.sqrt(2.0 / len(exact)))


def test_lines_that_swamp_are_named_where_no_coherence_tells_of_them() -> None:
    with pytest.raises(InvalidInput, match=r"of its 160 lines, 150 to [\d.]+ Hz, make 90 %.*omit"):
        assert with_floor(0, coherent=False).data


def test_lines_that_are_alone_are_named_and_are_no_modes(taps: Responses) -> None:
    """Three of them twice their size off, none within two lines of a mode."""
    wrong, first = [40, 70, 120], taps.responses[0]
    factor = np.ones(len(FREQUENCY))
    factor[wrong] = 3.0
    parts = {
        name: tuple((factor * getattr(first, name)).tolist()) for name in ("real", "imaginary")
    }
    of = replace(taps, responses=(replace(first, **parts), *taps.responses[1:]))
    true = Trial(case(spindle()))
    remarks = " ".join(of.beside(true).remarks)
    assert "lacks" not in remarks
    named = ", ".join(f"{FREQUENCY[k]:.6g}" for k in wrong)
    assert f"at 0 rpm isolated lines belong to no mode: {named} Hz; they are not" in remarks
    assert not {*FREQUENCY[wrong]} & {*of.data.at[["0 rpm" in s for s in of.data.series]]}
    square = np.mean(((of.data.observed - of.predicted(true)) / of.data.deviation) ** 2)
    assert square == pytest.approx(1.0, abs=0.2)
    assert "isolated lines" not in " ".join(taps.beside(true).remarks)


def test_a_peak_of_two_close_modes_has_no_outliers() -> None:
    """At 984 Hz in rotation, of which the second is hardly evident, and a few lines wide."""
    for seed in (5, 23):
        assert not measured(spindle(), seed=seed).modes[700.0].outliers.size
