"""Records and pulses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fsdecode
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload
from warnings import warn

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _native
from ._tables import drawn, printable

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Unit = Literal["m/s2", "cm/s2", "mm/s2", "g"]
Motion = tuple[float, NDArray[np.float64], tuple[int, ...]]
Maxima = Literal["everywhere", "at_samples"]

def is_number(value: object) -> bool:
    """Returns whether a value is a real number; neither a truth value nor a span of time is one."""
    is_real = isinstance(value, int | float | np.integer | np.floating)
    return is_real and not isinstance(value, bool | np.timedelta64)


AVERAGE_PERIODS = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4)
"""Usual periods of AvgSA [s]."""


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Record:
    """An accelerogram at a uniform step.

    The acceleration is linear between samples and zero outside. Samples are copied: a list, a slice of an
    array, an array of another type of real numbers or in another byte order will do.

    >>> import numpy as np
    >>> record = Record(0.01, np.sin(np.arange(0, 10, 0.01))[::2])
    >>> record.duration, len(record)
    (4.99, 500)

    A slice is a record, which starts again at time 0; with a stride of two it has every second sample.
    `numpy` takes a record as the array of its samples.

    >>> 2 * record[100:300] == Record(0.01, 2 * record.a[100:300])
    True
    >>> record[::2].dt, float(np.abs(record).max()) == record.pga
    (0.02, True)
    """

    dt: float
    """Time between samples [s]."""
    a: NDArray[np.float64]
    """Ground acceleration at the samples [m/s²]; read-only."""
    name: str
    """Name, for people."""
    warnings: tuple[str, ...]
    """Warnings from a quick check of the file."""
    later: tuple[int, ...]
    """First samples of the shocks of a `sequence` after the first one; empty of a single record."""

    # so that numpy leaves `2 * record` to `Record.__rmul__`
    __array_priority__ = 1000.0

    def __init__(
        self,
        dt: float,
        a: ArrayLike,
        *,
        unit: Unit = "m/s2",
        name: str = "record",
        warnings: tuple[str, ...] = (),
    ) -> None:
        """Makes a record of its samples, at least two, in a `unit`: m/s2, cm/s2 (gal), mm/s2 or g.

        Warns of a step that no record has. Raises `TypeError` for what are not numbers and `ValueError` for
        samples that are not finite and at most 1e6 m/s², not in one dimension, or have times or a unit of
        their own that differ, for a step that is not positive, and for an unknown unit.
        """
        if not is_number(dt):
            swapped = "; they are swapped" if np.ndim(a) == 0 else ""
            raise TypeError(
                f"Record(dt, samples): dt must be the time between samples in s, found a value of the type "
                f"{type(dt).__name__}{swapped}"
            )
        if isinstance(a, Record) or hasattr(a, "stats"):
            remedy = "record.a" if isinstance(a, Record) else "Record.from_trace(trace, unit)"
            raise TypeError(f"samples are a {type(a).__name__}, which has a step of its own; use {remedy}")
        check_times(a, float(dt))
        dt, samples, _ = _native.in_si((float(dt), a), unit)
        for warning in set(_native.warnings_of(dt, "")).difference(warnings):
            warn(f"{name}: {warning}", stacklevel=2)
            warnings = (*warnings, warning)
        self.__setstate__({"dt": dt, "a": samples, "name": name, "warnings": tuple(warnings), "later": ()})

    @classmethod
    def _of(cls, motion: Motion, name: str, warnings: Sequence[str] = ()) -> Record:
        """Makes a record of a motion whose step needs no warning."""
        (dt, samples, _), record = _native.in_si(motion[:2], "m/s2"), cls.__new__(cls)
        state = {"dt": dt, "a": samples, "name": name, "warnings": tuple(warnings), "later": motion[2]}
        record.__setstate__(state)
        return record

    @classmethod
    def from_trace(cls, trace: Any, unit: Unit | None = None, *, name: str | None = None) -> Record:
        """Makes a record of an ObsPy trace, or of anything with `data` and `stats.delta` [s].

        A trace states no `unit`: give that of its data, once the response of the instrument is removed. A
        vertical channel (`HNZ`) is warned of.

        >>> from types import SimpleNamespace
        >>> trace = SimpleNamespace(data=[0.0, 12.5, -3.0], stats=SimpleNamespace(delta=0.01, channel="HNE"))
        >>> Record.from_trace(trace, "cm/s2")
        Record('HNE', 3 samples of 0.01 s, PGA 0.125 m/s2)
        """
        data, stats = getattr(trace, "data", None), getattr(trace, "stats", None)
        delta = getattr(stats, "delta", None)
        if data is None or delta is None:
            raise TypeError(
                f"expected a trace with data and stats.delta, found a value of the type "
                f"{type(trace).__name__}; of a stream take one trace, stream[0]"
            )
        if unit is None:
            raise ValueError("a trace states no unit of its data; give unit: m/s2, cm/s2, mm/s2 or g")
        if np.ma.is_masked(data):
            raise ValueError("the trace has gaps; merge it with a fill_value, or cut a part without gaps")
        channel = str(getattr(stats, "channel", ""))
        warnings = tuple(_native.warnings_of(float(delta), channel))
        name = name or str(getattr(trace, "id", "") or channel or "trace")
        record = cls(float(delta), data, unit=unit, name=name, warnings=warnings)
        for warning in warnings:
            warn(f"{name}: {warning}", stacklevel=2)
        return record

    def __repr__(self) -> str:
        size = f"{len(self.a)} samples of {self.dt:g} s"
        return printable(f"Record({self.name!r}, {size}, PGA {self.pga:.4g} m/s2)")

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        # numpy's copies are writable
        self.a.flags.writeable = False

    def __eq__(self, other: object) -> bool:
        """Whether both have the same step and samples; names do not count."""
        if not isinstance(other, Record):
            return NotImplemented
        return self.dt == other.dt and np.array_equal(self.a, other.a)

    def __hash__(self) -> int:
        # zeros of both signs are equal
        return hash((self.dt, (self.a + 0.0).tobytes()))

    def __len__(self) -> int:
        return len(self.a)

    @overload
    def __getitem__(self, at: int) -> float: ...
    @overload
    def __getitem__(self, at: slice) -> Record: ...
    def __getitem__(self, at: int | slice) -> float | Record:
        if not isinstance(at, slice):
            return float(self.a[at])
        start, stop, step = at.indices(len(self))
        if step < 0:
            raise ValueError(f"a slice of a record goes forward in time, found the stride {step}")
        return self._with((self.dt * step, self.a[start:stop:step], ()))

    def __mul__(self, factor: float) -> Record:
        """Returns `scaled(factor)`."""
        if not is_number(factor):
            found = type(factor).__name__
            raise TypeError(f"expected a number, found a value of the type {found}; use record.a")
        return self.scaled(float(factor))

    __rmul__ = __mul__

    def __neg__(self) -> Record:
        """Returns the record of the opposite polarity."""
        return self.scaled(-1.0)

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.a, dtype=dtype, copy=copy)

    @property
    def _motion(self) -> Motion:
        return self.dt, self.a, self.later

    def _with(self, motion: Motion) -> Record:
        return Record._of(motion, self.name, self.warnings)

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the samples [s], from 0."""
        return np.arange(len(self.a), dtype=np.float64) * self.dt

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return (len(self.a) - 1) * self.dt

    @property
    def pga(self) -> float:
        """Peak ground acceleration [m/s²]."""
        return float(np.abs(self.a).max())

    @property
    def velocity(self) -> NDArray[np.float64]:
        """Velocity of the ground at the samples [m/s], from rest.

        It is the exact integral of the acceleration, which is linear between samples. The baseline is not
        corrected.

        >>> Record(2.0, [1.0, -1.0]).velocity, Record(2.0, [1.0, -1.0]).pgv
        (array([0., 0.]), 0.5)
        """
        velocity: NDArray[np.float64] = _native.velocity(self._motion)
        return velocity

    @property
    def displacement(self) -> NDArray[np.float64]:
        """Displacement of the ground at the samples [m], from rest; as `velocity`."""
        displacement: NDArray[np.float64] = _native.displacement(self._motion)
        return displacement

    @property
    def pgv(self) -> float:
        """Peak ground velocity [m/s], also between samples."""
        return float(_native.intensities(self._motion)[0])

    @property
    def pgd(self) -> float:
        """Peak ground displacement [m], also between samples.

        It means little for a record whose velocity does not end near zero.
        """
        return float(_native.intensities(self._motion)[1])

    @property
    def arias(self) -> float:
        """Arias intensity [m/s], π/(2 g) ∫ a² dt. It grows with the square of a scale factor."""
        return float(_native.intensities(self._motion)[2])

    @property
    def cav(self) -> float:
        """Cumulative absolute velocity [m/s], ∫ |a| dt."""
        return float(_native.intensities(self._motion)[3])

    def scaled(self, factor: float) -> Record:
        """Returns the record with every sample multiplied by `factor`."""
        return self._with(scaled(self._motion, factor, "factor"))

    def scaled_to(self, pga: float) -> Record:
        """Returns the record scaled to a peak ground acceleration [m/s²]."""
        return self._with(_native.scaled_to(self._motion, pga))

    def trimmed(self, start: float, end: float) -> Record:
        """Returns the part between two times [s]; it starts again at time 0."""
        return self._with(_native.trimmed(self._motion, start, end))

    def spectrum(
        self, periods: ArrayLike, *, damping: float = 0.05, maxima: Maxima = "everywhere"
    ) -> NDArray[np.float64]:
        """Computes the pseudo-spectral acceleration Sa [m/s²] at periods [s]; at 0 it is the PGA.

        Maxima are searched `everywhere` or, as many programs do, only `at_samples`.

        >>> record = synthetic_record()
        >>> record.spectrum([0.0]) == record.pga
        array([ True])
        """
        sa: NDArray[np.float64] = _native.spectrum(self._motion, periods, damping, at_samples(maxima))
        return sa

    def average_sa(
        self, periods: ArrayLike = AVERAGE_PERIODS, *, damping: float = 0.05, maxima: Maxima = "everywhere"
    ) -> float:
        """Computes AvgSA [m/s²], the geometric mean of Sa over periods [s]."""
        return _native.average_sa(self._motion, periods, damping, at_samples(maxima))

    def housner(self, *, damping: float = 0.05, maxima: Maxima = "everywhere") -> float:
        """Computes Housner's intensity [m], the integral of Sa T/(2π) over the periods T from 0.1 to 2.5 s.

        The trapezoidal rule takes the periods 0.10, 0.11 … 2.50 s.
        """
        return float(_native.housner(self._motion, damping, at_samples(maxima)))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the record with matplotlib, which has to be installed."""
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.subplots()[1]
        ax.plot(self.time, self.a, linewidth=0.8, label=self.name)
        ax.set(xlabel="time (s)", ylabel="a_g (m/s²)")
        return ax

    def _repr_svg_(self) -> str:
        return _native.picture(self._motion, self.name)


def check_times(samples: Any, dt: float) -> None:
    """Compares the times that samples of pandas or xarray bring along, if any, with their step [s]."""
    index = next(iter(getattr(samples, "indexes", {}).values()), getattr(samples, "index", None))
    kind = getattr(getattr(index, "dtype", None), "kind", "")
    if kind not in ("f", "m", "M") or len(samples) < 2:
        return
    steps = np.diff(np.asarray(index)) / (1.0 if kind == "f" else np.timedelta64(1, "s"))
    # times may be rounded
    if not (np.abs(steps - dt) < 0.5 * dt).all() or abs(steps.mean() - dt) > 1e-3 * dt:
        found = f"{steps.min():g} to {steps.max():g} s apart, and dt is {dt:g} s"
        raise ValueError(f"samples have times of their own, {found}; give that step, or samples.to_numpy()")


def motion_of(record: object, name: str = "record") -> Motion:
    """Returns the motion of what must be a record; `name` stands for it in messages."""
    if isinstance(record, Record):
        return record._motion
    if isinstance(record, (str, PathLike)):
        remedy = f"read it with rw.read_record({fsdecode(record)!r})"
    else:
        of_trace = ", or rw.Record.from_trace(trace, unit)" if hasattr(record, "stats") else ""
        remedy = f"make one with rw.Record(dt, samples) or rw.read_record(path){of_trace}"
    raise TypeError(f"{name} must be a Record, found a value of the type {type(record).__name__}: {remedy}")


def listed(records: Any) -> list[Any]:
    """Returns records as a list, also one alone."""
    if isinstance(records, Record):
        return [records]
    if not np.iterable(records) or hasattr(records, "columns"):
        motion_of(records, "records")
    return list(records)


def scaled(motion: Motion, factor: float, name: str) -> Motion:
    """Returns a motion multiplied by a factor; `name` stands for the factor in messages."""
    if not is_number(factor):
        raise TypeError(f"{name} = {factor!r} must be a finite number")
    if not np.isfinite(factor):
        raise ValueError(f"{name} = {factor} must be a finite number")
    if factor == 1.0:
        return motion
    try:
        return _native.scaled(motion, float(factor))
    except ValueError as error:
        raise ValueError(f"{name} = {factor}: {error}") from None


def at_samples(maxima: Maxima) -> bool:
    """Returns whether maxima are searched at the samples only."""
    if maxima not in ("everywhere", "at_samples"):
        raise ValueError(f"maxima = {maxima!r} is not one of everywhere, at_samples")
    return maxima == "at_samples"


def read_channels(
    path: str | PathLike[str],
    *,
    unit: Unit | None = None,
    dt: float | None = None,
    column: str | None = None,
    channel: str | None = None,
    format: str | None = None,
) -> list[Record]:
    """Reads every channel of a record file, or the one that is asked for; see `read_record`."""
    records = []
    for motion, found, warnings in _native.read_channels(fsdecode(path), unit, dt, column, channel, format):
        name = Path(fsdecode(path)).name + (f" [{found}]" if found else "")
        records.append(Record._of(motion, name, warnings))
    return records


def read_record(
    path: str | PathLike[str],
    *,
    unit: Unit | None = None,
    dt: float | None = None,
    column: str | None = None,
    channel: str | None = None,
    format: str | None = None,
) -> Record:
    """Reads a record in the format of an agency, CSV or text; an unknown `format` is told all of them.

    The format is found from the content. State `unit` or `dt` [s] where the file does not, the `column` of
    a table with several, and the `channel` of a file with several. Warns of what a quick check finds.
    """
    records = read_channels(path, unit=unit, dt=dt, column=column, channel=channel, format=format)
    if len(records) != 1:
        names = ", ".join(record.name for record in records)
        raise ValueError(f"{fsdecode(path)}: expected one channel, found {names}; state channel=")
    for warning in records[0].warnings:
        warn(f"{fsdecode(path)}: {warning}", stacklevel=2)
    return records[0]


def sequence(records: Sequence[Record], *, pause: float = 10.0, name: str | None = None) -> Record:
    """Joins records to one, from which a wall goes on to the next: each begins `pause` [s] after the last
    sample of the one before. A `Response` has the `shocks`. Raises `ValueError` for steps without a common
    part of at least a hundredth of the shortest; records stay the same motions at that step.

    >>> sequence([sine_cycle(2.0, 1.0)] * 2, pause=5).duration
    7.0
    """
    given = listed(records)
    motion = _native.sequence([motion_of(record, "records") for record in given], pause)
    return Record._of(motion, " + ".join(record.name for record in given) if name is None else name)


def synthetic_record(
    seed: int | np.random.Generator = 1, *, duration: float = 30.0, dt: float = 0.005, pga: float = 3.5
) -> Record:
    """Makes filtered noise with an envelope: another `seed` gives another record of the same kind.

    >>> synthetic_record(7, pga=2.0)
    Record('synthetic 7', 6001 samples of 0.005 s, PGA 2 m/s2)
    """
    seed = drawn(seed)
    return Record._of(_native.synthetic(seed, duration, dt, pga), f"synthetic {seed}")


def ricker(amplitude: float, frequency: float, *, centre: float | None = None) -> Record:
    """Makes a Ricker pulse with its peak `amplitude` [m/s²] at `centre` [s], by default 1.5/`frequency`.

    >>> round(ricker(2.0, 1.0).pga, 6)
    2.0
    """
    return pulse("ricker", amplitude, frequency, centre=centre)


def harmonic(amplitude: float, frequency: float, duration: float, *, phase: float = 0.0) -> Record:
    """Makes a harmonic motion A sin(2π f t + φ) of some duration [s]; the `phase` is in rad."""
    return pulse("harmonic", amplitude, frequency, phase=phase, duration=duration)


def sine_cycle(amplitude: float, frequency: float) -> Record:
    """Makes one cycle of a sine [m/s², Hz]."""
    return pulse("sine_cycle", amplitude, frequency)


def half_sine(amplitude: float, frequency: float) -> Record:
    """Makes half a cycle of a sine [m/s², Hz]."""
    return pulse("half_sine", amplitude, frequency)


def pulse(
    shape: str,
    amplitude: float,
    frequency: float,
    *,
    centre: float | None = None,
    phase: float = 0.0,
    duration: float | None = None,
) -> Record:
    """Samples a motion given by a formula."""
    motion = _native.pulse(shape, amplitude, frequency, centre, phase, duration)
    return Record._of(motion, shape.replace("_", " "))
