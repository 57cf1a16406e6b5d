"""Rocking spectra."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._tables import Table

if TYPE_CHECKING:
    import pandas

@dataclass(frozen=True, eq=False, repr=False)
class RockingSpectrum:
    """u_max/u_ins over walls under one motion, or over pulses on one wall.

    Each wall starts upright and at rest, and is followed until its peak has come.
    """

    columns: NDArray[np.float64]
    """Values along the columns, as many as there are columns."""
    rows: NDArray[np.float64]
    """Values along the rows, as many as there are rows."""
    table: Table
    """A row for each point, as `wall study spectrum --csv` writes them."""
    _picture: str

    def __repr__(self) -> str:
        rows, columns = self.u_ratio_max.shape
        return (
            f"RockingSpectrum({self.row_name} × {self.column_name}, {rows} × {columns}, "
            f"{int(self.overturned.sum())} overturned)"
        )

    def _over(self, name: str) -> NDArray[Any]:
        return self.table[name].reshape(len(self.rows), len(self.columns))

    @property
    def column_name(self) -> str:
        """What the columns are: height_m, semi_diagonal_m or frequency_ratio."""
        return list(self.table)[0]

    @property
    def row_name(self) -> str:
        """What the rows are: slenderness, angle_rad or amplitude_ratio."""
        return list(self.table)[1]

    @property
    def u_ratio_max(self) -> NDArray[np.float64]:
        """Largest |u|/u_ins [-], rows × columns; 1 where the wall overturned."""
        return self._over("u_ratio_max")

    @property
    def rocked(self) -> NDArray[np.bool_]:
        """Whether the wall left its elastic branch, rows × columns."""
        return self._over("rocked")

    @property
    def overturned(self) -> NDArray[np.bool_]:
        """Whether the wall overturned, rows × columns."""
        return self._over("overturned")

    @property
    def overturn_time(self) -> NDArray[np.float64]:
        """Time of overturning [s], rows × columns; NaN for none."""
        return self._over("overturn_time_s")

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table as a DataFrame of pandas, which has to be installed."""
        return self.table.to_pandas()

    def _repr_svg_(self) -> str:
        return self._picture
