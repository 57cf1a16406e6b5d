"""Viscous damping that matches restitution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ._tables import Table

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False, repr=False)
class Calibration:
    """Damping that matches the free rocking of a wall with restitution, section 5 of the paper."""

    fits: Table
    """One fit for each damping model, a1, u0/u_ins and e: the damping, the error of Eq. (18), and the number
    of samples compared."""
    coefficients: Table
    """x of ξ = -x ln e, Eq. (19), for each damping model, a1 and u0/u_ins; `x_paper` is what the paper
    prints, NaN for nothing."""
    laws: Table
    """q and r of x = q a1^r, Eqs. (20) to (22), for each damping model and u0/u_ins."""
    _pictures: list[str]

    def __repr__(self) -> str:
        return f"Calibration({len(self.fits['a1'])} fits, {len(self.coefficients['a1'])} coefficients)"

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the coefficients as a DataFrame of pandas, which has to be installed."""
        return self.coefficients.to_pandas()

    def _repr_html_(self) -> str:
        return self.coefficients._repr_html_() + self.laws._repr_html_() + "".join(self._pictures)
