"""Rocking spectra."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._tables import Table

if TYPE_CHECKING:
    import pandas

LABELS = {
    "height_m": "height h (m)",
    "semi_diagonal_m": "semi-diagonal R (m)",
    "slenderness": "slenderness h/b",
    "angle_rad": "slenderness angle α (rad)",
    "frequency_ratio": "ω_p / p",
    "amplitude_ratio": "a_p / a₀",
}
"""What stands on an axis of each name."""


@dataclass(frozen=True, eq=False, repr=False)
class RockingSpectrum:
    """u_max/u_ins over walls under one motion, or over pulses on one wall.

    Each wall starts upright and at rest, and is followed until its peak has come.
    """

    column_name: str
    """What the columns are: height_m, semi_diagonal_m or frequency_ratio."""
    row_name: str
    """What the rows are: slenderness, angle_rad or amplitude_ratio."""
    columns: NDArray[np.float64]
    """Values along the columns, as many as there are columns."""
    rows: NDArray[np.float64]
    """Values along the rows, as many as there are rows."""
    u_ratio_max: NDArray[np.float64]
    """Largest |u|/u_ins [-], rows × columns; 1 where the wall overturned."""
    rocked: NDArray[np.bool_]
    """Whether the wall left its elastic branch, rows × columns."""
    overturn_time: NDArray[np.float64]
    """Time of overturning [s], rows × columns; NaN for none."""

    def __repr__(self) -> str:
        rows, columns = self.u_ratio_max.shape
        return (
            f"RockingSpectrum({self.row_name} × {self.column_name}, {rows} × {columns}, "
            f"{int(self.overturned.sum())} overturned)"
        )

    @property
    def overturned(self) -> NDArray[np.bool_]:
        """Whether the wall overturned, rows × columns."""
        return ~np.isnan(self.overturn_time)

    @property
    def table(self) -> Table:
        """A row for each point, as `wall study spectrum --csv` writes them."""
        rows, columns = self.u_ratio_max.shape
        return Table(
            {
                self.column_name: np.tile(self.columns, rows),
                self.row_name: np.repeat(self.rows, columns),
                "u_ratio_max": self.u_ratio_max.ravel(),
                "rocked": self.rocked.ravel(),
                "overturned": self.overturned.ravel(),
                "overturn_time_s": self.overturn_time.ravel(),
            }
        )

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table as a DataFrame of pandas, which has to be installed."""
        return self.table.to_pandas()

    def _repr_svg_(self) -> str:
        values = zip(self.u_ratio_max.tolist(), self.rocked.tolist(), self.overturn_time.tolist())
        points = [list(zip(*row)) for row in values]
        labels = (LABELS[self.column_name], LABELS[self.row_name])
        axes = (self.columns.tolist(), self.rows.tolist())
        return _native.picture_of_spectrum(*axes, points, "Rocking spectrum", labels)
