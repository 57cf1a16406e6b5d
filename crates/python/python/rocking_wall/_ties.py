"""Ties of any stiffness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._tables import Table

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False, repr=False)
class TieStudy:
    """Force of a parapet's tie and displacement of the wall over the stiffness of the tie.

    Arrays of two dimensions have a row for each stiffness and a column for each motion; with both polarities
    the motions of the other sign come last.
    """

    stiffness: NDArray[np.float64]
    """Stiffnesses of the tie, in order; 0 for none [N/m]."""
    force: NDArray[np.float64]
    """Peak force of the tie [N], stiffnesses × motions."""
    u_ratio_max: NDArray[np.float64]
    """Largest |u|/u_ins [-], stiffnesses × motions; 1 where the wall falls."""
    falls: NDArray[np.bool_]
    """Whether the wall falls, stiffnesses × motions."""
    falls_away_from_tie: NDArray[np.bool_]
    """Whether it falls to the side on which no tie holds it, stiffnesses × motions."""
    beyond_u_ins_and_back: NDArray[np.bool_]
    """Whether |u| exceeds u_ins and the wall comes back, stiffnesses × motions."""
    strength_reached: NDArray[np.bool_]
    """Whether the force reached the strength of the tie, stiffnesses × motions."""
    table: Table
    """Medians, largest values and counts over the motions, as `wall study tie --csv` writes them."""
    alike_on_both_sides: bool
    """Whether both polarities were asked for and one was run, because the wall is alike on both sides."""
    _picture: str

    def __repr__(self) -> str:
        rows, columns = self.force.shape
        return f"TieStudy({rows} stiffnesses, {columns} motions, {int(self.falls.sum())} falls)"

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table as a DataFrame of pandas, which has to be installed."""
        return self.table.to_pandas()

    def _repr_html_(self) -> str:
        return self.table._repr_html_() + self._picture
