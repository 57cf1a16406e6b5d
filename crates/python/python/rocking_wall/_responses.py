"""Results of runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, NotRequired, TypedDict

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._tables import Table, Tabular

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

Array = NDArray[np.float64]


class Instant(TypedDict):
    """A value and its time [s]."""

    value: float
    time: float


class Extremes(TypedDict):
    """The highest and the lowest value of a quantity, located between samples too."""

    highest: Instant
    lowest: Instant


class Threshold(TypedDict):
    """The first time [s] at which |u| reached a fraction of u_ins, and u there [m]; None for never."""

    fraction: float
    time: float | None
    u: float | None


class TieDemands(TypedDict):
    """Demands on one of several ties."""

    tie_height: float
    tie_force: Instant
    tie_strength: Instant | None
    tie_elongation: NotRequired[float]
    tie_elongation_negative: NotRequired[float]
    tie_break_time: NotRequired[float | None]
    tie_break_time_negative: NotRequired[float | None]


class Demands(TypedDict):
    """Demands of a motion on a wall, up to overturning; in SI units.

    A wall with a tie has the peak of its force, and when that first reached the strength given. A tie that
    yields has its plastic elongations on u > 0 and on u < 0, and the times at which it broke. A wall with
    several ties has these of each in `ties`.
    """

    u: Extremes
    u_dot: Extremes
    u_ddot: Extremes
    reaction_bottom: Extremes
    reaction_top: Extremes
    thresholds: list[Threshold]
    half_cycles: int
    residual: NotRequired[float]
    tie_force: NotRequired[Instant]
    tie_strength: NotRequired[Instant | None]
    tie_elongation: NotRequired[float]
    tie_elongation_negative: NotRequired[float]
    tie_break_time: NotRequired[float | None]
    tie_break_time_negative: NotRequired[float | None]
    ties: NotRequired[list[TieDemands]]


class Shock(TypedDict):
    """A shock of a sequence, up to the first sample of the next; what ties remember is that of all so far."""

    start: float
    end: float
    fallen_before: bool
    u_max: float
    u_ratio_max: float
    overturned: bool
    falls: bool
    residual: float
    demands: Demands


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """The response of a wall: its history, and its peaks, which are located between samples too.

    >>> from rocking_wall import Wall
    >>> response = Wall().simulate()
    >>> response.u_max, len(response.u)
    (0.18, 3001)
    """

    time: Array
    """Time [s]."""
    u: Array
    """Displacement relative to the supports [m]."""
    u_dot: Array
    """Its velocity [m/s]."""
    u_ddot: Array
    """Its acceleration [m/s²]."""
    u_ratio: Array
    """u/u_ins of its side [-]."""
    restoring_force: Array
    """Restoring force [N]."""
    damping_force: Array
    """Damping force [N]."""
    reaction_bottom: Array
    """Force of the bottom support on the wall [N]."""
    reaction_top: Array
    """Force of the top support on the wall [N]; 0 for a parapet."""
    a_bottom: Array
    """Acceleration of the bottom support [m/s²]."""
    a_top: Array
    """Acceleration of the top support [m/s²]."""
    u_max: float
    """Largest |u| [m]; u_ins of its side for a wall that falls."""
    u_ratio_max: float
    """Largest |u|/u_ins [-]; 1 for a wall that falls, above 1 for one that comes back from beyond u_ins."""
    overturned: bool
    """Whether |u| exceeded u_ins."""
    overturn_time: float | None
    """When |u| first exceeded u_ins [s]; None for never."""
    falls: bool
    """Whether the wall falls: |u| is not below u_ins at the end of the run."""
    end_time: float
    """End of the run [s]."""
    demands: Demands
    """Extremes, first crossings of thresholds, half cycles and the residual displacement."""
    pieces: int
    """Pieces of motion that the solver took."""
    corners: int
    """Corners of the force that the motion passed."""
    impacts: int
    """Impacts."""
    tie_force: Array | None = None
    """Force of the tie [N]; None without one."""
    tie_elongation: Array | None = None
    """Plastic elongation of the tie on u > 0 [m]; None without one that yields."""
    tie_elongation_negative: Array | None = None
    """Plastic elongation of the tie on u < 0 [m]; None without one that yields."""
    tie_forces: tuple[Array, ...] = ()
    """Force of each tie of a wall with several [N]; `tie_force` is their sum, elongations are the largest."""
    shocks: Sequence[Shock] = ()
    """The shocks of a sequence of records, each with its demands; none of a single motion."""

    def __repr__(self) -> str:
        fate = f"overturned at {self.overturn_time:.4g} s" if self.overturned else "standing"
        return (
            f"Response({self.time[-1]:g} s, largest |u| {self.u_max:.4g} m = {self.u_ratio_max:.4g} u_ins, "
            f"{fate})"
        )

    @property
    def history(self) -> Table:
        """The history as a table; `wall simulate --csv` writes its columns with units in their names."""
        columns = {field.name: getattr(self, field.name) for field in fields(self)}
        columns |= {f"tie_{number}_force": force for number, force in enumerate(self.tie_forces, 1)}
        return Table({name: column for name, column in columns.items() if isinstance(column, np.ndarray)})

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the history as a DataFrame of pandas, which has to be installed, over the time."""
        return self.history.to_pandas().set_index("time")

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws u/u_ins over time with matplotlib, which has to be installed."""
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.subplots()[1]
        ax.plot(self.time, self.u_ratio, linewidth=1.0)
        for limit in (-1.0, 1.0):
            ax.axhline(limit, color="tab:red", linestyle="--", linewidth=0.8)
        ax.set(xlabel="time (s)", ylabel="u / u_ins")
        return ax

    def _repr_svg_(self) -> str:
        return _native.picture_of_response(self.time, self.a_bottom, self.u_ratio)


@dataclass(frozen=True, eq=False, repr=False)
class Peaks(Tabular):
    """Peaks of runs: of a wall under a record multiplied by factors, or of many walls and records.

    All arrays have the shape of the runs.
    """

    factor: Array
    """The factors."""
    u_max: Array
    """Largest |u| [m]; u_ins of its side for a wall that overturned, where its run stops."""
    u_ratio_max: Array
    """Largest |u|/u_ins [-]; 1 for a wall that overturned."""
    overturn_time: Array
    """Time of overturning [s]; NaN for none."""

    def __repr__(self) -> str:
        return f"Peaks({self.factor.size} runs, {int(self.overturned.sum())} overturned)"

    def __len__(self) -> int:
        return self.factor.size

    @property
    def overturned(self) -> NDArray[np.bool_]:
        """Whether |u| exceeded u_ins."""
        return ~np.isnan(self.overturn_time)

    @property
    def table(self) -> Table:
        """All of it as a table, a row for each run in the order of `ravel`."""
        columns = ("factor", "u_max", "u_ratio_max", "overturned", "overturn_time")
        return Table({name: getattr(self, name).ravel() for name in columns})

    def _repr_html_(self) -> str:
        return self.table._repr_html_()
