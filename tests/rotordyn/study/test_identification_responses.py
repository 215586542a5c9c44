"""The rotor from frequency responses: a twin, what wrong models show, a sentence for each fault."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import pyuff

import rotordyn
from bearings.materials import Material
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.records import read_record
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.errors import InvalidInput
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.measured_modes import Modes
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.search import search
from rotordyn.study.identification.solve import identify
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import Unknown, sought
from tests.rotordyn.page.conftest import array, held

pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")
STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
FREQUENCY = np.linspace(150.0, 1900.0, 160)
SPEEDS, OTHER = (0.0, 700.0), 1500.0  # rad/s
OUTER = (0.030, 0.050, 0.060, 0.050, 0.040)
DAMPING = (300.0, 200.0)


def spindle() -> Spindle:
    """Five sections, a disc, two damped supports."""
    lengths = (0.10, 0.14, 0.12, 0.14, 0.11)
    sections = tuple(
        Section(a, d, 0.0, STEEL, name=f"s{k}")
        for k, (a, d) in enumerate(zip(lengths, OUTER, strict=True))
    )
    supports = tuple(
        LinearSupport(name, x, {("y", "y"): k, ("z", "z"): k}, {("y", "y"): c, ("z", "z"): c})
        for name, x, k, c in zip(("front", "rear"), (0.12, 0.52), (8e7, 5e7), DAMPING, strict=True)
    )
    points = {"tip": 0.0, "tail": 0.61}
    disc = Disc("disc", 0.30, 0.16, 0.06, 0.03, STEEL)
    return Spindle("twin", Shaft(0.0, sections), discs=(disc,), supports=supports, points=points)


def case(of: Spindle) -> rotordyn.Case:
    speeds = (*SPEEDS, OTHER)
    return rotordyn.Case("twin", "twin", speeds, {"campbell": CampbellSpec(1900.0)}, spindle=of)


def blank(point: str, speed: float, way: str = "y") -> MeasuredResponse:
    nothing = (1.0,) * len(FREQUENCY)
    ports = Port(point, way), Port("tip", way)
    return MeasuredResponse("r", *ports, tuple(FREQUENCY.tolist()), nothing, nothing, speed)


def measured(of: Spindle, seed: int = 1, noise: float = 0.02, ways: str = "y") -> Responses:
    rng = np.random.default_rng(seed)
    asked = tuple(
        blank(point, speed, way) for speed in SPEEDS for point in of.points for way in ways
    )
    whole = Responses(name="taps", responses=asked, noise=0.02)
    found = whole.computed(Trial(case(of)), dict.fromkeys(SPEEDS, 2.0 * np.pi * FREQUENCY))

    def noisy(one: MeasuredResponse) -> MeasuredResponse:
        parts = rng.normal(size=(2, len(FREQUENCY)))
        values = found[one.speed][one.pair] * (1.0 + noise * (parts[0] + 1j * parts[1]))
        return replace(one, real=tuple(values.real.tolist()), imaginary=tuple(values.imag.tolist()))

    return replace(whole, responses=tuple(map(noisy, asked)))


def unknowns(off: float) -> dict[str, Unknown]:
    """Three diameters from ``off`` below and above, both dampings from a third and three times."""
    found = {
        f"spindle.shaft.sections.s{k}.outer_diameter": Unknown(
            0.6 * OUTER[k], 1.5 * OUTER[k], start=OUTER[k] * (1.0 + way * off)
        )
        for k, way in ((0, -1.0), (2, 1.0), (4, -1.0))
    }
    for name, size, begin in zip(("front", "rear"), DAMPING, (0.35, 3.0), strict=True):
        path = f"spindle.supports.{name}.damping."
        found[path + "yy"] = Unknown(
            size / 20.0, 20.0 * size, start=begin * size, also=(path + "zz",)
        )
    return found


def frequencies(of: Spindle) -> np.ndarray:
    """|λ|/2π at the speed that was not measured [Hz]."""
    scene = Scene(of, Conditions(), np.array([OTHER]), 1900.0)
    pole = scene.system(scene.with_motions(("bending",))[0]).pole[0]
    found = np.sort(np.abs(pole[pole.imag > 1.0])) / (2.0 * np.pi)
    return found[found < 1900.0]


@pytest.fixture(scope="module")
def taps() -> Responses:
    return measured(spindle())


def test_sections_and_dampings_from_20_percent_off(taps: Responses, tmp_path: Path) -> None:
    """Frequencies of a speed that was not measured within 0.5 %; every true value in its interval
    of four deviations; χ² as the noise stated."""
    found = identify(case(spindle()), unknowns(0.2), [taps], workers=1)
    best = found.explained
    assert found.sufficient
    assert best.sure.reduced == pytest.approx(1.0, abs=0.12)
    true = np.array([OUTER[0], OUTER[2], OUTER[4], *DAMPING])
    assert (np.abs(best.fit.values - true) < 4.0 * best.sure.deviation).all()
    assert found.best.spindle is not None
    pair = frequencies(spindle()), frequencies(found.best.spindle)
    assert len(pair[0]) > 5
    np.testing.assert_allclose(pair[1], pair[0], rtol=5e-3)
    (beside,) = best.beside
    assert not beside.remarks
    assert all(float(row[-1]) > 0.98 for row in beside.rows)
    assert {"taps_responses", "correlation"} <= set(found.figures)
    assert "machine [Hz]" in found.summary
    pytest.importorskip("plotly", reason="the extra report is not installed")
    found.save(tmp_path, draw=False)
    page = rotordyn.write_report(tmp_path, tmp_path / "page.html").read_text(encoding="utf-8")
    assert ">taps modes</" in page
    content, numbers = held(page)
    chart = next(c for c in content.values() if len(c["traces"]) == 4 and c["controls"])
    assert chart["controls"][0]["options"][1] == "tail.y / tip.y, 0 rpm"
    x, y = (array(chart["traces"][0]["moving"][key], numbers) for key in "xy")
    size = np.hypot(taps.responses[1].real, taps.responses[1].imaginary)
    np.testing.assert_allclose(x[1], FREQUENCY, rtol=1e-6)
    np.testing.assert_allclose(y[1], size * 1e6, rtol=1e-5)


def test_stiffness_of_a_joint_is_found() -> None:
    """Tilt as of half a diameter of shaft, beside a diameter, from twice and 10 % off."""
    true = 2.1e11 * np.pi / 64.0 * 0.05**4 / 0.025
    jointed = replace(spindle(), joints=(Joint("joint", 0.24, tilt=true),))
    asked = {path: each for path, each in unknowns(0.1).items() if ".s2." in path}
    asked["spindle.joints.joint.tilt"] = Unknown(0.2 * true, 5.0 * true, start=2.0 * true)
    found = identify(case(jointed), asked, [measured(jointed, 5)], workers=1)
    best = found.explained.sure
    assert found.sufficient
    assert (np.abs(best.values - [OUTER[2], true]) < 4.0 * best.deviation).all()
    assert best.deviation[1] < 0.05 * true


def test_both_stiffnesses_of_an_anisotropic_support_are_found() -> None:
    """80 and 50 N/µm from 65 both, taps in both directions."""
    front, rear = spindle().supports
    pair = {("y", "y"): 8e7, ("z", "z"): 5e7}
    unlike = replace(spindle(), supports=(replace(front, stiffness=pair), rear))
    path = "spindle.supports.front.stiffness."
    asked = {path + way: Unknown(2e7, 2e8, start=6.5e7) for way in ("yy", "zz")}
    taps = measured(unlike, 6, ways="yz")
    found = identify(case(unlike), asked, [taps], workers=1)
    best = found.explained.sure
    assert found.sufficient
    assert (np.abs(best.values - [*pair.values()]) < 4.0 * best.deviation).all()
    assert (best.deviation < 0.02 * best.values).all()


def modes(of: Spindle, rng: np.random.Generator) -> Modes:
    """Of the lowest three whirl pairs at both speeds, 0.05 % and 3 % noise."""
    scene = Scene(of, Conditions(), np.array(SPEEDS), 2500.0)
    found = scene.system(scene.with_motions(("bending",))[0])
    rows = []
    for row, speed in enumerate(SPEEDS):
        order = np.argsort(np.abs(found.pole[row]))
        for k in [k for k in order if found.pole[row, k].imag > 1.0][:6]:
            rows.append((speed, found.pole[row, k], found.whirl[row, k]))
    pole = np.array([each for _, each, _ in rows])
    return Modes(
        name="modal test",
        speed=np.array([speed for speed, _, _ in rows]),
        frequency=np.abs(pole) / (2.0 * np.pi) * (1.0 + 5e-4 * rng.normal(size=len(pole))),
        deviation=5e-4,
        damping=-pole.real / np.abs(pole) * (1.0 + 0.03 * rng.normal(size=len(pole))),
        damping_deviation=0.03,
        whirl=tuple("forward" if way > 0.0 else "backward" for _, _, way in rows),
    )


def test_sections_and_dampings_from_modes_alone() -> None:
    """From 10 % off; every value within four deviations, χ² as the noise stated."""
    measured = modes(spindle(), np.random.default_rng(4))
    found = identify(case(spindle()), unknowns(0.1), [measured], workers=1)
    best = found.explained
    assert found.sufficient
    true = np.array([OUTER[0], OUTER[2], OUTER[4], *DAMPING])
    assert (np.abs(best.fit.values - true) < 4.0 * best.sure.deviation).all()
    assert (best.sure.deviation[:3] < 0.02 * true[:3]).all()


def test_modes_are_paired_by_their_whirl() -> None:
    """A backward one, most of the way to the forward one, is nearer to that and still the backward;
    elements of another fineness move both by 1e-5."""
    scene = Scene(spindle(), Conditions(), np.array([700.0]), 2500.0)
    found = scene.system(scene.with_motions(("bending",))[0])
    lowest = {
        way: float(np.abs(found.pole[0][(found.whirl[0] == sign)]).min()) / (2.0 * np.pi)
        for way, sign in (("forward", 1.0), ("backward", -1.0))
    }
    high = lowest["backward"] + 0.7 * (lowest["forward"] - lowest["backward"])
    for whirl, meant in ((("backward",), "backward"), ((), "forward")):
        one = Modes(
            name="m",
            speed=np.array([700.0]),
            frequency=np.array([high]),
            deviation=1e-3,
            whirl=whirl,
        )
        np.testing.assert_allclose(one.predicted(Trial(case(spindle()))), lowest[meant], rtol=1e-4)


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ({"frequency": np.array([100.0])}, "as many frequencies"),
        ({"damping": np.array([0.01, 0.01])}, "dampings have a deviation"),
        ({"whirl": ("forward", "sideways")}, "whirl 'sideways'"),
        ({"frequency": np.array([100.0, 100.0])}, "given twice"),
    ],
)
def test_faults_of_modes(how: dict[str, object], sentence: str) -> None:
    given = {"speed": np.zeros(2), "frequency": np.array([100.0, 200.0]), "deviation": 1e-3}
    with pytest.raises(InvalidInput, match=sentence):
        Modes(name="m", **{**given, **how})  # type: ignore[arg-type]


def test_without_blurred_responses_the_search_stops_at_other_peaks(taps: Responses) -> None:
    """So that what leads it there is needed: the same start, samples alone."""
    asked = sought(case(spindle()), unknowns(0.2))
    sharp = replace_blurred(taps)
    found = search(problem := Problem(case(spindle()), asked, (sharp,)), problem.start)
    assert found.cost > 10.0 * problem.count


def replace_blurred(of: Responses) -> Responses:
    class Sharp(Responses):
        blurred = ()

    return Sharp(name=of.name, responses=of.responses, noise=of.noise)


def test_a_joint_that_the_model_lacks_is_found_out() -> None:
    """Tilt as of half a diameter of shaft."""
    bending = 2.1e11 * np.pi / 64.0 * 0.05**4
    joint = Joint("joint", 0.24, tilt=bending / 0.025)
    taps = measured(replace(spindle(), joints=(joint,)))
    few = {path: each for path, each in unknowns(0.1).items() if ".s2." in path}
    found = identify(case(spindle()), few, [taps], workers=1)
    assert not found.sufficient
    assert "times the stated noise" in found.verdict[0]
    assert f"at {found.explained.problem.count - 1} degrees of freedom" in found.verdict[0]


def test_a_mode_that_the_machine_lacks_is_named(taps: Responses) -> None:
    """Beside a machine without its disc, and one without supports of the rear."""
    light = replace(spindle(), discs=())
    remarks = taps.beside(Trial(case(light))).remarks
    right = taps.beside(Trial(case(spindle()))).remarks
    assert not right
    assert any("lacks" in each or "not measured" in each for each in remarks)


def test_noise_above_the_stated_one_is_said() -> None:
    noisy = measured(spindle(), noise=0.05)
    remarks = noisy.beside(Trial(case(spindle()))).remarks
    assert any("scatter 2.5 times" in each or "scatter 2.4 times" in each for each in remarks)


def test_gains_of_sensors_are_taken_out(taps: Responses) -> None:
    """A response 5 % too large costs nothing where gains are unknown by 5 %."""
    first = taps.responses[0]
    large = replace(
        first,
        real=tuple(1.05 * v for v in first.real),
        imaginary=tuple(1.05 * v for v in first.imaginary),
    )
    responses = (large, *taps.responses[1:])
    costs = []
    for gain in (0.0, 0.05):
        of = Responses(name="taps", responses=responses, noise=0.02, gain=gain)
        problem = Problem(case(spindle()), sought(case(spindle()), unknowns(0.0)), (of,))
        predicted = problem.predicted(np.array([OUTER[0], OUTER[2], OUTER[4], *DAMPING]))
        assert predicted is not None
        rows = of.data.observed - predicted[0]
        weighed = problem.weighings[0].weighed(rows)
        costs.append(float(weighed @ weighed) / len(rows))
    assert costs[0] > 1.5
    assert costs[1] == pytest.approx(1.0, abs=0.15)


def changed(of: Responses, **how: object) -> Responses:
    return replace(of, **{"noise": of.noise, **how})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ({"noise": None}, "give noise, or averages beside a coherence"),
        ({"noise": 0.8}, "noise: given 0.8"),
        ({"averages": 10}, "has no coherence, which averages are for"),
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
    with pytest.raises(InvalidInput, match="noise swamps it"):
        Responses(name="taps", responses=(first,), averages=10)


def test_noise_alone_is_no_response(taps: Responses) -> None:
    rng, first = np.random.default_rng(3), taps.responses[0]
    values = rng.normal(size=(2, len(FREQUENCY)))
    alone = replace(first, real=tuple(values[0].tolist()), imaginary=tuple(values[1].tolist()))
    with pytest.raises(InvalidInput, match="noise swamps the responses at 0 rpm"):
        assert Responses(name="taps", responses=(alone,), noise=0.02).data


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
    with pytest.raises(InvalidInput, match=f"12 unknowns, but the measurements have {of.carried}"):
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


def test_the_shipped_twin_knows_its_modes() -> None:
    """At the true values of ``docs/generate/response_twins.py``: no mode lacks, χ² of the noise."""
    asked = read_identification("cases/identification/grinding_spindle_taps.yaml")
    problem = asked.searches.problem(0)
    true = np.array([88e-3, 74e-3, 46e-3, 36e-3, 1.85, 800.0, 350.0])
    predicted = problem.predicted(true)
    assert predicted is not None
    rows = problem.rows(predicted, true)
    assert float(rows @ rows) / len(rows) == pytest.approx(1.0, abs=0.1)
    trial = problem.trial(true)
    for each in problem.measurements:
        assert isinstance(each, Responses)
        assert not each.beside(trial).remarks
