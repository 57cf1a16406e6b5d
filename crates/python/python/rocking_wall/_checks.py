"""Checks of walls by building codes."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from typing import Any

from ._tables import Table


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

    def __repr__(self) -> str:
        return f"Verdict({self.headline})"

    def _repr_html_(self) -> str:
        lines = [*self.notes, *(f"warning: {warning}" for warning in self.warnings)]
        said = "".join(f"<p>{escape(line)}</p>" for line in lines)
        return f"<p><b>{escape(self.headline)}</b></p>{self.table._repr_html_()}{said}{self._picture}"
