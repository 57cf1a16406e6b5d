"""The check of a wall by a code."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any

from . import _native
from ._tables import Table, toml

FRACTIONS = {"spectrum", "unit", "damping", "displacement_fraction", "secant_fraction"}
"""Statements of the code "fractions"."""


@dataclass(frozen=True, repr=False)
class Verdict:
    """The check of a wall by a code."""

    code: str
    """The code."""
    passed: bool
    """Whether the wall passes."""
    governs: str
    """The limit state that governs."""
    side: str
    """The side that governs: "u > 0", "u < 0" or "both sides"."""
    zeta_E: float
    """ζ_E, capacity over demand of what governs [-]."""
    headline: str
    """The verdict in a line."""
    values: Mapping[str, Any]
    """All numbers, as `wall check --json` prints them: SI units, a_g in g."""
    warnings: tuple[str, ...]
    """What the engineer should know; none of it stops the check."""
    table: Table = field(compare=False)
    """A row for each limit state of each side: ζ_E, capacity and demand [m/s² or m]."""
    _picture: str = field(default="", compare=False)

    def __repr__(self) -> str:
        return f"Verdict({self.headline})"

    def _repr_html_(self) -> str:
        warnings = "".join(f"<p>warning: {escape(warning)}</p>" for warning in self.warnings)
        return f"<p><b>{escape(self.headline)}</b></p>{self.table._repr_html_()}{warnings}{self._picture}"


def checked(
    wall: _native.Wall, records: Sequence[tuple[str, Any]], statements: Mapping[str, Any]
) -> Verdict:
    """Checks a wall by the keys of a table `[check]`, with records by their names."""
    table = dict(statements)
    if "spectrum" in table:
        periods, accelerations = table["spectrum"]
        if len(periods) != len(accelerations):
            found = f"{len(periods)} periods and {len(accelerations)} values of Sa"
            raise ValueError(f"the spectrum has {found}; give one Sa for each period")
        table["spectrum"] = [[float(t), float(sa)] for t, sa in zip(periods, accelerations)]
    if records and table["code"] != "fractions":
        # their motions are handed over beside the text
        table["records"] = {}
    text = "[check]\n" + "".join(f"{name} = {toml(value)}\n" for name, value in table.items())
    values, rows, picture = _native.check_wall(wall, text, list(records))
    made = json.loads(values)
    return Verdict(
        **{**made, "warnings": tuple(made["warnings"])}, table=Table(rows), _picture=picture
    )
