"""Tables: columns by their names."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from html import escape
from os import PathLike, fsdecode
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas
    import xarray


class Table(dict[str, NDArray[Any]]):
    """A table: a dictionary of columns, which are arrays of one length.

    >>> table = Table({"wall": ["a", "b"], "theta_g": [0.5, 0.75]})
    >>> table["theta_g"][1]
    np.float64(0.75)
    """

    def __init__(self, columns: Mapping[str, Sequence[Any] | NDArray[Any]]) -> None:
        super().__init__((name, np.asarray(column)) for name, column in columns.items())

    def rows(self) -> list[dict[str, Any]]:
        """Returns the rows as dictionaries."""
        return [dict(zip(self, row)) for row in zip(*self.values())]

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table as a DataFrame of pandas, which has to be installed."""
        import pandas

        return pandas.DataFrame(dict(self))

    def to_xarray(self, *dims: str) -> xarray.Dataset:
        """Returns the table as a Dataset of xarray, which has to be installed with pandas. The columns `dims`
        are its dimensions, in the order of the table."""
        dataset: xarray.Dataset = self.to_pandas().set_index(list(dims)).to_xarray()
        return dataset.reindex({dim: list(dict.fromkeys(self[dim].tolist())) for dim in dims})

    def _repr_html_(self) -> str:
        def row(cells: Sequence[Any], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{escape(shown(cell))}</{tag}>" for cell in cells) + "</tr>"

        body = "".join(row(list(cells.values()), "td") for cells in self.rows()[:MOST_ROWS])
        return f"<table><thead>{row(list(self), 'th')}</thead><tbody>{body}</tbody></table>"


class Tabular:
    """Results of which one table is the main one."""

    _main = "table"

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the main table as a DataFrame of pandas, which has to be installed."""
        table: Table = getattr(self, self._main)
        return table.to_pandas()


MOST_ROWS = 100
"""Rows that a notebook shows."""


def shown(value: object) -> str:
    """Formats a value of a table for people: numbers with five digits."""
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def printable(text: str) -> str:
    """Returns a text that the console can print: cp932, gbk and cp1250 have no ² and no ω."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    return text.encode(encoding, "backslashreplace").decode(encoding)


def toml_lines(values: Mapping[str, object]) -> str:
    """Returns the lines of a table in TOML."""
    return "".join(f"{name} = {toml(value, name)}\n" for name, value in values.items())


def drawn(seed: int | np.random.Generator) -> int:
    """Returns a seed, which a generator draws."""
    return int(seed.integers(2**32)) if isinstance(seed, np.random.Generator) else seed


def toml(value: object, name: str = "a value") -> str:
    """Returns the text of a value in TOML; `name` stands for it in messages."""
    if isinstance(value, Mapping):
        entries = (f"{json.dumps(str(key))} = {toml(each, str(key))}" for key, each in value.items())
        return "{ " + ", ".join(entries) + " }"
    if isinstance(value, np.random.Generator):
        return str(drawn(value))
    if isinstance(value, np.ndarray | np.generic) and not hasattr(value, "unit"):
        value = value.tolist()
    if isinstance(value, PathLike):
        value = fsdecode(value)
    if isinstance(value, list | tuple | range):
        return "[" + ", ".join(toml(each, name) for each in value) + "]"
    if isinstance(value, float):
        # also nan and inf
        return repr(value)
    if isinstance(value, str | bool | int):
        return json.dumps(value, ensure_ascii=False)
    found = type(value).__name__
    expected = "expected numbers, texts, lists and dictionaries"
    raise TypeError(f"{name}: {expected}, found a value of the type {found}")
