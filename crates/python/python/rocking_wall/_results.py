"""Results of checks, spectra, ties and calibrations, and of the verification of every formula."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._native import verify_formulas
from ._tables import Table, Tabular, printable, toml_lines


@dataclass(frozen=True, repr=False)
class Verdict:
    """The check of a wall by a code."""

    code: str
    """The code."""
    passed: bool
    """Whether the wall passes."""
    governs: str
    """The check that governs, such as SLV."""
    side: str
    """The side that governs: "u > 0", "u < 0" or "both sides"."""
    zeta: float
    """Capacity over demand of what governs [-]."""
    headline: str
    """The verdict in a line."""
    table: Table = field(compare=False)
    """A row for each check of each side: capacity and demand [m/s2 or m], and the ground's a_g [g]."""
    notes: list[str]
    """What is to be said of the rows."""
    warnings: list[str]
    """What the engineer should know; none of it stops the check."""
    numbers: dict[str, Any]
    """All numbers by the names of `wall check --json`, in SI units."""
    _picture: str = field(compare=False)
    _given: tuple[Any, ...] = field(compare=False, repr=False)

    def __repr__(self) -> str:
        return printable(f"Verdict({self.headline})")

    def write_report(
        self, path: str | PathLike[str], *, title: str | None = None, **project: Any
    ) -> None:
        """Writes the report for a calculation file as a page, as `wall check --report` does.

        :param title: Title; by default that of the wall.
        :param project: Keys of the table `[report]`, such as `language="it"`, `project`, `designer`, `date`.

        Raises `FileExistsError` for a file that exists, `ValueError` for a key that is not known.
        """
        wall, text, records = self._given
        text += "[report]\n" + toml_lines(project)
        page = _native.check_report(wall._native, text, records, title)
        with open(path, "x", encoding="utf-8", newline="") as file:
            file.write(page)

    def _repr_html_(self) -> str:
        lines = [*self.notes, *(f"warning: {warning}" for warning in self.warnings)]
        said = "".join(f"<p>{escape(line)}</p>" for line in lines)
        return f"<p><b>{escape(self.headline)}</b></p>{self.table._repr_html_()}{said}{self._picture}"


@dataclass(frozen=True, eq=False, repr=False)
class RockingSpectrum(Tabular):
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
            f"RockingSpectrum({self.row_name} x {self.column_name}, {rows} x {columns}, "
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

    def _repr_svg_(self) -> str:
        return self._picture


@dataclass(frozen=True, eq=False, repr=False)
class TieStudy(Tabular):
    """Demands on a tie and displacement of the wall over a parameter of the tie.

    Arrays of two dimensions have a row for each value and a column for each motion; with both polarities the
    motions of the other sign come last.
    """

    varied: str
    """The parameter that is varied, such as tie_stiffness."""
    values: NDArray[np.float64]
    """Its values, in order, in SI units."""
    force: NDArray[np.float64]
    """Peak force of the tie [N], values × motions."""
    u_ratio_max: NDArray[np.float64]
    """Largest |u|/u_ins [-], values × motions; 1 where the wall falls."""
    falls: NDArray[np.bool_]
    """Whether the wall falls, values × motions."""
    falls_away_from_tie: NDArray[np.bool_]
    """Whether it falls to the side on which no tie holds it, values × motions."""
    beyond_u_ins_and_back: NDArray[np.bool_]
    """Whether |u| exceeds u_ins and the wall comes back, values × motions."""
    strength_reached: NDArray[np.bool_]
    """Whether the force reached the strength of the tie, values × motions."""
    elongation: NDArray[np.float64]
    """Plastic elongation of the tie at the end [m], the larger one of two, values × motions."""
    broken: NDArray[np.bool_]
    """Whether a tie broke, values × motions."""
    table: Table
    """Medians, largest values and counts over the motions, as `wall study tie --csv` writes them."""
    alike_on_both_sides: bool
    """Whether both polarities were asked for and one was run, because the wall is alike on both sides."""
    _picture: str

    def __repr__(self) -> str:
        rows, columns = self.force.shape
        return f"TieStudy({rows} values of {self.varied}, {columns} motions, {int(self.falls.sum())} falls)"

    def _repr_html_(self) -> str:
        return self.table._repr_html_() + self._picture


@dataclass(frozen=True, eq=False, repr=False)
class Calibration(Tabular):
    """Damping that matches the free rocking of a wall with restitution, section 5 of the paper."""

    _main = "coefficients"

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

    def _repr_html_(self) -> str:
        return self.coefficients._repr_html_() + self.laws._repr_html_() + "".join(self._pictures)


def verify() -> Table:
    """Checks every formula of the model against a reference of its own, as `wall verify formulas` does.

    A row is a number: its formula, case, quantity and unit, the reference and the computed number, the error
    and the bound on it, both over the scale, and whether it passes.

    >>> verify()["passes"].all()
    np.True_
    """
    return Table(verify_formulas())
