"""Frequency responses at independent speed and frequency."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Complex, Flags, Words
from rotordyn.results.declaration import Absence, coordinate, declared, quantity
from rotordyn.results.display import response_unit

AS_COMPUTED = "SI, as computed"  # unit of fields whose entries have those of their pairs


FEWER = Absence("beyond the last peak", last="resonance")
NO_TIP = Absence("of a response that is not a coupled tip", by=("measured",))
BEYOND = Absence("beyond the last frequency of the slice", last="place")


@dataclass(frozen=True)
class FrequencyResponse:
    """Complex frequency responses at independent speed and frequency; ``pair`` reads ``out / in``.

    Subclasses add the values at the frequencies of the case, in a field named by ``kind``. Every
    peak at and between them is solved for: ``peak_frequency`` and ``peak_value``, ascending, NaN
    where there are fewer, infinite for an undamped mode. ``peak_damping``: NaN for a peak that no
    single mode makes; ``light_mode``: empty for damping ratios from ``LIGHT`` up. ``slice_value``:
    response at the slice speeds, at the frequencies of the case and further ones about every mode,
    NaN beyond the last. ``line_value``: response along the engine orders at the speeds of the case;
    ``line_curve``: also at speeds about the critical ones, NaN at which a stop closes. ``measured``
    responses have their own frequencies, NaN beyond the last ``sample``; their highest peaks are
    paired with the nearest computed ones, NaN where there are fewer. ``unstable``: a mode is
    unstable, so that the steady solution given is not reached. ``frac``: frequency response
    assurance criterion.
    """

    kind: ClassVar[str]
    turning_frame: ClassVar[bool] = False

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    frequency: Array = coordinate("frequency", unit="Hz", label="frequency")
    pair: Words = coordinate("pair", unit="", label="response / excitation")
    outcome: Words = quantity("speed", unit="", label="outcome")
    unstable: Flags = quantity("speed", unit="", label="not reached: the machine is unstable")
    is_slice: Flags = quantity("speed", unit="", label="drawn as slice")
    error: Array = quantity("pair", unit="1", label="estimated error over the largest value")
    error_asked: float = quantity(
        unit="1",
        label="largest error asked for, over the largest value",
        infinite=(Absence("where none is asked for"),),
    )
    resonance: NDArray[np.int_] = coordinate("resonance", unit="", label="resonance")
    peak_frequency: Array = quantity(
        "speed", "pair", "resonance", unit="Hz", label="frequency of the peak", absent=(FEWER,)
    )
    peak_value: Complex = quantity(
        "speed",
        "pair",
        "resonance",
        unit=AS_COMPUTED,
        label="response at the peak",
        absent=(FEWER,),
        infinite=(Absence("of a mode without damping", beside="peak_damping"),),
    )
    peak_damping: Array = quantity(
        *("speed", "pair", "resonance"),
        unit="1",
        label="damping ratio of the mode at the peak",
        absent=(
            FEWER,
            Absence(
                "of a peak that is not due to a single mode", by=("speed", "pair", "resonance")
            ),
        ),
    )
    light_mode: Words = quantity(
        "pair", unit="", label="mode of the highest peak, if lightly damped"
    )
    slice_speed: Array = coordinate("slice_speed", unit="rad/s", label="speed")
    place: NDArray[np.int_] = coordinate("place", unit="", label="place")
    slice_frequency: Array = quantity(
        "slice_speed", "place", unit="Hz", label="frequency", absent=(BEYOND,)
    )
    slice_value: Complex = quantity(
        "slice_speed",
        "pair",
        "place",
        unit=AS_COMPUTED,
        label="response of the slice",
        absent=(BEYOND,),
    )
    line: Words = coordinate("line", unit="", label="engine order")
    line_rotor: Words = quantity("line", unit="", label="rotor")
    line_order: Array = quantity("line", unit="1", label="multiple of its speed")
    line_frequency: Array = quantity("speed", "line", unit="Hz", label="frequency")
    line_value: Complex = quantity("speed", "line", "pair", unit=AS_COMPUTED, label="response")
    step: NDArray[np.int_] = coordinate("step", unit="", label="step")
    line_speed: Array = quantity(
        "line",
        "step",
        unit="rad/s",
        label="speed",
        absent=(Absence("beyond the last speed of the line", last="step"),),
    )
    line_curve: Complex = quantity(
        "line",
        "step",
        "pair",
        unit=AS_COMPUTED,
        label="response",
        absent=(
            Absence("beyond the last speed of the line", last="step"),
            Absence("at a speed at which a stop closes", by=("line", "step")),
        ),
    )
    crossing: NDArray[np.int_] = coordinate("crossing", unit="", label="peak of the line")
    line_peak_speed: Array = quantity(
        "line",
        "pair",
        "crossing",
        unit="rad/s",
        label="speed of the peak",
        absent=(Absence("beyond the last peak of the line", last="crossing"),),
    )
    line_peak_value: Complex = quantity(
        "line",
        "pair",
        "crossing",
        unit=AS_COMPUTED,
        label="response at the peak",
        absent=(Absence("beyond the last peak of the line", last="crossing"),),
    )
    measured: Words = coordinate("measured", unit="", label="measured response")
    sample: NDArray[np.int_] = coordinate("sample", unit="", label="sample")
    peak: NDArray[np.int_] = coordinate("peak", unit="", label="peak")
    measured_pair: Words = quantity("measured", unit="", label="response / excitation")
    measured_speed: Array = quantity("measured", unit="rad/s", label="speed")
    measured_frequency: Array = quantity(
        "measured",
        "sample",
        unit="Hz",
        label="frequency",
        absent=(Absence("beyond the last sample", last="sample"),),
    )
    measured_response: Complex = quantity(
        "measured",
        "sample",
        unit=AS_COMPUTED,
        label="measured response, as the computed quantity",
        absent=(Absence("beyond the last sample", last="sample"),),
    )
    measured_peak: Array = quantity(
        "measured",
        "peak",
        unit="Hz",
        label="measured peak",
        absent=(Absence("beyond the last peak", last="peak"),),
    )
    measured_peak_amplitude: Array = quantity(
        "measured",
        "peak",
        unit=AS_COMPUTED,
        label="amplitude of the measured peak",
        absent=(Absence("beyond the last peak", last="peak"),),
    )
    measured_peak_error: Array = quantity(
        "measured",
        "peak",
        unit="1",
        label="standard error of the measured amplitude",
        absent=(Absence("where the highest sample is the peak", by=("measured", "peak")),),
        infinite=(
            Absence("where frequencies are too far apart for the peak", by=("measured", "peak")),
        ),
    )
    computed_peak: Array = quantity(
        "measured",
        "peak",
        unit="Hz",
        label="computed peak",
        absent=(Absence("beyond the last peak", last="peak"),),
    )
    computed_peak_amplitude: Array = quantity(
        "measured",
        "peak",
        unit=AS_COMPUTED,
        label="amplitude of the computed peak",
        absent=(Absence("beyond the last peak", last="peak"),),
    )
    frac: Array = quantity(
        "measured",
        unit="1",
        label="FRAC of measured and computed response",
        absent=(
            Absence(
                "with too few samples within the frequencies, or without a response there",
                by=("measured",),
            ),
        ),
    )
    measured_error: Array = quantity(
        "measured",
        unit="1",
        label="relative error of a coupled tip by noise",
        absent=(NO_TIP,),
    )
    measured_calibration: Array = quantity(
        "measured",
        unit="1",
        label="relative error of a coupled tip over that of the responses",
        absent=(NO_TIP,),
    )
    measured_doubt: Words = quantity(
        "measured", unit="", label="why the coupled tip FRF is unreliable"
    )

    def highest(self, pair: int) -> tuple[int, int] | None:
        """Speed and resonance of the highest peak of a pair, None where there is none."""
        size = np.abs(self.peak_value[:, pair])
        if not np.isfinite(self.peak_frequency[:, pair]).any():
            return None
        row, place = np.unravel_index(np.nanargmax(size), size.shape)
        return int(row), int(place)

    @property
    def response(self) -> Complex:
        """Responses of the kind of the result (speeds, pairs, frequencies)."""
        values: Complex = getattr(self, self.kind)
        return values

    def curve(self, index: int, pair: int) -> tuple[Array, Complex]:
        """Frequencies [Hz] and values of a pair at a slice speed, whose ``index`` counts all
        speeds."""
        row = int(np.flatnonzero(np.flatnonzero(self.is_slice) == index)[0])
        finite = np.isfinite(self.slice_frequency[row])
        return self.slice_frequency[row, finite], self.slice_value[row, pair, finite]

    def unit(self, pair: int) -> str:
        """SI unit of the values of a pair."""
        return response_unit(self.pair[pair], self.kind)

    def entry_units(self, name: str) -> tuple[str, ...]:
        """SI units of a field along its pairs; empty for a field that has one unit."""
        declaration = declared(self)[name].metadata
        if name != self.kind and declaration["unit"] != AS_COMPUTED:
            return ()
        measured = "measured" in declaration["dims"] and self.measured_pair
        pairs = self.measured_pair if measured else self.pair
        return tuple(self.unit(self.pair.index(pair)) for pair in pairs)


@dataclass(frozen=True)
class FrfResult(FrequencyResponse):
    """Receptance: displacement over force."""

    kind: ClassVar[str] = "receptance"

    receptance: Complex = quantity(
        "speed", "pair", "frequency", unit="m/N, rad/N, rad/(N·m)", label="receptance"
    )


@dataclass(frozen=True)
class MobilityResult(FrequencyResponse):
    """Mobility: velocity over force, iω times the receptance."""

    kind: ClassVar[str] = "mobility"

    mobility: Complex = quantity(
        *("speed", "pair", "frequency"),
        unit="(m/s)/N, (rad/s)/N, (rad/s)/(N·m)",
        label="mobility",
    )


@dataclass(frozen=True)
class InertanceResult(FrequencyResponse):
    """Inertance: acceleration over force, −ω² times the receptance."""

    kind: ClassVar[str] = "inertance"

    inertance: Complex = quantity(
        *("speed", "pair", "frequency"),
        unit="(m/s²)/N, (rad/s²)/N, (rad/s²)/(N·m)",
        label="inertance",
    )


@dataclass(frozen=True)
class TurningFrfResult(FrfResult):
    """Receptance in the frame that rotates with the shaft, as are y, z, force and frequency.

    In complex form, H of the rotating frame at ω is H of the fixed frame at ω + Ω. Axial motion and
    torsion are the same in both.
    """

    turning_frame: ClassVar[bool] = True

    frequency: Array = coordinate("frequency", unit="Hz", label="frequency in the rotating frame")
    receptance: Complex = quantity(
        "speed",
        "pair",
        "frequency",
        unit="m/N, rad/N, rad/(N·m)",
        label="receptance in the rotating frame",
    )
