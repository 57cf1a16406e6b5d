"""Buildings: storeys and walls as one system."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike, fsdecode
from typing import Any
from warnings import warn

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._given import Attribute
from ._records import Record, motion_of, scaled
from ._responses import Instant
from ._tables import Table, printable

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FloorResponse:
    """A floor in time; each history has its largest absolute value, with its sign and its time, beside it."""

    acceleration: Array
    """Absolute acceleration [m/s²]."""
    acceleration_peak: Instant
    """Its peak between the samples too."""
    drift: Array
    """Displacement relative to what the floor stands on [m]."""
    drift_peak: Instant
    """Its peak between the samples too."""


@dataclass(frozen=True, eq=False)
class BuildingWallResponse:
    """A wall of a building in time; each history has its largest absolute value beside it."""

    u: Array
    """Displacement relative to the supports [m]."""
    u_peak: Instant
    """Its peak; u_ins of its side for a wall that falls."""
    u_ratio: Array
    """u/u_ins of its side [-]."""
    u_ratio_peak: Instant
    """Its peak; 1 or -1 for a wall that falls."""
    reaction_bottom: Array
    """Force of the bottom support on the wall [N]."""
    reaction_bottom_peak: Instant
    """Its peak between the samples too."""
    reaction_top: Array
    """Force of the top support on the wall [N]; 0 for a parapet."""
    reaction_top_peak: Instant
    """Its peak between the samples too."""
    u_max: float
    """Largest |u| between the samples too [m]; u_ins of its side for a wall that falls."""
    overturn_time: float | None
    """When |u| first exceeded u_ins [s]; None for never."""
    falls: bool
    """Whether the wall falls; one that overturned can come back."""
    tie_elongation: float
    """Plastic elongation of its tie at the end, the larger one of two [m]; 0 for one that stays elastic."""
    tie_break_time: float | None
    """When a tie first broke [s]; None for never."""

    @property
    def overturned(self) -> bool:
        """Whether |u| exceeded u_ins."""
        return self.overturn_time is not None


@dataclass(frozen=True, eq=False, repr=False)
class BuildingResponse:
    """The response of a building: histories at the samples of the record, and on at its step."""

    title: str
    """Title of the building."""
    time: Array
    """Time [s]."""
    ground: Array
    """Acceleration of the ground [m/s²]."""
    floors: dict[str, FloorResponse]
    """Floors by their names."""
    walls: dict[str, BuildingWallResponse]
    """Walls by their names."""
    step: float
    """Communication step [s], short enough for the tolerance."""
    change: float
    """Largest change of a peak by the last halving of the step, over the peak [-]."""
    _picture: str

    def __repr__(self) -> str:
        fallen = [name for name, wall in self.walls.items() if wall.falls]
        fate = f"fallen: {', '.join(fallen)}" if fallen else "all walls standing"
        return printable(f"BuildingResponse({self.title!r}, {self.time[-1]:g} s, {fate})")

    @property
    def peaks(self) -> Table:
        """Peaks of the walls: largest |u|, u/u_ins, forces of the supports, and the time of overturning."""
        walls = self.walls.values()
        times = [np.nan if wall.overturn_time is None else wall.overturn_time for wall in walls]
        return Table(
            {
                "wall": list(self.walls),
                "u_max": [wall.u_max for wall in walls],
                "u_ratio_peak": [wall.u_ratio_peak["value"] for wall in walls],
                "reaction_bottom_peak": [wall.reaction_bottom_peak["value"] for wall in walls],
                "reaction_top_peak": [wall.reaction_top_peak["value"] for wall in walls],
                "overturned": [wall.overturned for wall in walls],
                "falls": [wall.falls for wall in walls],
                "overturn_time": times,
            }
        )

    def _repr_html_(self) -> str:
        return self.peaks._repr_html_() + self._picture


class Building:
    """Storeys and walls that act on each other, under a record.

    The file is that of `wall building`; scenes of its walls are looked up beside it.
    """

    title = Attribute[str]("Title.")
    floors = Attribute[list[str]]("Names of the floors.")
    walls = Attribute[list[str]]("Names of the walls.")

    def __init__(self, path: str | PathLike[str]) -> None:
        self._native = _native.Building(fsdecode(path))
        for warning in self._native.warnings:
            warn(warning, stacklevel=2)

    @classmethod
    def from_toml(cls, path: str | PathLike[str]) -> Building:
        """Reads the file of a building."""
        return cls(path)

    def __repr__(self) -> str:
        return printable(f"Building({self.title!r}, {len(self.floors)} floors, {len(self.walls)} walls)")

    def simulate(
        self, record: Record, *, scale: float = 1.0, tail: float = 10.0, tolerance: float = 0.01
    ) -> BuildingResponse:
        """Runs the building under a record, floors and walls in one loop. Ctrl-C stops the run.

        :param scale: Factor on the record.
        :param tail: Free vibration after the record [s].
        :param tolerance: Change of any peak by halving the step, over the peak, at which the step is short
            enough.

        Raises `ValueError` for a tail or tolerance out of range, and `RuntimeError` where no step is short
        enough.
        """
        ground = scaled(motion_of(record), scale, "scale")
        values: dict[str, Any] = self._native.run(ground, tail, tolerance)
        floors = {name: FloorResponse(**floor) for name, floor in values.pop("floors").items()}
        walls = {name: BuildingWallResponse(**wall) for name, wall in values.pop("walls").items()}
        return BuildingResponse(**values, floors=floors, walls=walls)
