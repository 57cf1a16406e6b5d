"""Incremental dynamic analyses."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any
from warnings import warn

from . import _native
from ._tables import Table

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False, repr=False)
class StudyResults:
    """Results of a study, as the tables that `wall ida` writes."""

    levels: Table
    """Every run; `overturn_time_s` is NaN for a wall that stood."""
    collapses: Table
    """The collapse of every wall, damping model and record; `collapse_g` is NaN where there is none."""
    fragilities: Table
    """The fragility of every wall, damping model and limit state: medians, θ and β of lognormal curves, with
    95 % intervals. A number above the levels is infinite; one of which only bounds are known is NaN."""

    def __repr__(self) -> str:
        runs, curves = len(self.levels["wall"]), len(self.collapses["wall"])
        return f"StudyResults({runs} runs, {curves} curves)"

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the fragilities as a DataFrame of pandas, which has to be installed."""
        return self.fragilities.to_pandas()

    def _repr_html_(self) -> str:
        return self.fragilities._repr_html_()


class Study:
    """An incremental dynamic analysis: walls, records, damping models, intensity measure and levels.

    The file is that of `wall ida`; scenes and records that it names are looked up beside it.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        self._native = _native.Study(fspath(path))
        self._name = Path(path).stem
        for warning in self._native.warnings:
            warn(warning, stacklevel=2)

    @classmethod
    def from_toml(cls, path: str | PathLike[str]) -> Study:
        """Reads a study file."""
        return cls(path)

    def __getstate__(self) -> tuple[Any, ...]:
        return (self._name, self._native.sent())

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self._name, values = state
        self._native = _native.Study.received(values)

    def __repr__(self) -> str:
        walls, records, models = len(self.walls), len(self.records), len(self.models)
        return f"Study({self.title!r}, {walls} walls, {records} records, {models} damping models)"

    def __len__(self) -> int:
        return len(self._native)

    @property
    def title(self) -> str:
        """Title."""
        return self._native.title

    @property
    def walls(self) -> list[str]:
        """Names of the walls."""
        return self._native.walls

    @property
    def records(self) -> list[str]:
        """Names of the records."""
        return self._native.records

    @property
    def models(self) -> list[str]:
        """Names of the damping models."""
        return self._native.models

    @property
    def measure(self) -> str:
        """Name of the intensity measure."""
        return self._native.measure

    def run(self, *, threads: int | None = None, progress: bool = True) -> StudyResults:
        """Runs the study on all cores, or on some threads, and fits the fragilities.

        Shows a bar where tqdm is installed. Ctrl-C stops it. The results do not depend on the number of
        threads. They stay in memory: a large study, or one that is stopped and continued, is for `wall ida`
        or `rocking_wall.dask`.
        """
        with bar(len(self), progress) as report:
            tables = self._native.run(threads, report)
        return StudyResults(*(Table(table) for table in tables))


@contextmanager
def bar(total: int, wanted: bool, unit: str = " curves") -> Iterator[Callable[[int], None]]:
    """Shows progress where tqdm is installed."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        wanted = False
    if not wanted:
        yield lambda done: None
        return
    with tqdm(total=total, unit=unit) as shown:

        def report(done: int) -> None:
            shown.update(done - shown.n)

        yield report
        if shown.n < total:
            report(total)
