"""Results of studies, as the tables of their folders."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from os import PathLike, fsdecode
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any
from warnings import warn

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._tables import Table, Tabular

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

# Most curves that a plot names.
MOST_NAMED = 12


@dataclass(frozen=True, eq=False, repr=False)
class StudyResults(Tabular):
    """Results of a study, as the tables that `wall study ida` writes."""

    _main = "fragilities"

    levels: Table
    """Every run; `overturn_time_s` is NaN for a wall that stood."""
    collapses: Table
    """The collapse of every wall, damping model and record; `collapse_g` is NaN where there is none. Columns
    of intensities end with the unit of the measure."""
    fragilities: Table
    """The fragility of every wall, damping model and limit state: medians, θ and β of lognormal curves, with
    95 % intervals, of medians by percentiles, of θ and β studentised. A number above the levels is infinite;
    one of which only bounds are known is NaN."""
    curves: Table
    """The curve of every wall, then of every class, for each damping model and limit state: θ, and β with
    its parts due to records, walls and modelling. `wall` is the name of the wall or class."""
    rates: Table | None
    """The annual rate of each of these curves between the points of the hazard curve, with the ends of its
    95 % interval over resampled records (`annual_rate_low`, `_high`, studentised), return period and
    probability; of a class `annual_rate_of_walls` is the mean of its walls. What may lie outside the points
    stands apart: `beyond_last_point_continued` if the curve goes on as it ends, and `annual_rate_most` with
    the most that is possible. None for a study without `hazard`."""
    rate_shares: Table | None
    """The part of each rate from each segment of the hazard curve; None for a study without `hazard`."""
    vulnerability: Table | None
    """The mean loss ratio of each wall and class by intensity; None without `loss_ratios` in `report`."""
    losses: Table | None
    """The average annual loss, of the value of the wall; None without `loss_ratios` and `hazard`."""
    samples: Table | None
    """The values of the samples of each wall; None without `uncertain`."""
    sensitivity: Table | None
    """How far each parameter explains θ over the samples; None without `uncertain`."""
    variance: Table | None
    """The parts of the variance of ln IM: records, each parameter, modelling; None without `uncertain`."""
    cloud: Table | None
    """The regression of every wall and damping model, ln(u_max/u_ins) = a + b ln IM with the standard
    deviation sigma; None for levels of another method than "cloud"."""
    measures: Table | None
    """The intensity measures that the study compares, of every wall and damping model, then of all walls: σ
    of ln θ at collapse, the regression ln D = a + b ln IM with its σ, and p-values of the slopes of residuals
    over duration, magnitude and distance. None without `compare` in `intensity`."""
    given: Table | None
    """Fragilities of the last shock by the state of the wall before it; None without `given`."""
    records: Table | None
    """Factors and weights of the records; None where no list states any, and no weights are given."""
    ties: Table | None
    """Force and elongation of ties that may yield; None where there is none."""
    nrml: str | None
    """The curves as NRML, which OpenQuake reads; None where NRML has no name for the measure."""

    def __repr__(self) -> str:
        runs, curves = len(self.levels["wall"]), len(self.collapses["wall"])
        return f"StudyResults({runs} runs, {curves} curves)"

    def _repr_html_(self) -> str:
        return self.fragilities._repr_html_()

    def to_nrml(self, path: str | PathLike[str]) -> None:
        """Writes the curves of walls and classes as NRML.

        Raises `ValueError` where NRML has no name for the intensity measure, `FileExistsError` for a file
        that exists.
        """
        if self.nrml is None:
            known = "PGA, PGV, PGD, Sa(T), AvgSA, IA and CAV"
            raise ValueError(f"OpenQuake knows {known}; run the study with one of these measures")
        with open(path, "x", encoding="utf-8", newline="") as file:
            file.write(self.nrml)

    def to_xarray(self) -> xarray.Dataset:
        """Returns the fragilities by wall, model and limit state and the collapses by wall, model and record
        as a Dataset of xarray, which has to be installed with pandas."""
        fragilities = self.fragilities.to_xarray("wall", "model", "u_max_over_u_ins")
        return fragilities.merge(self.collapses.to_xarray("wall", "model", "record"))

    def plot(self, names: Sequence[str] | str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the curves of the highest limit state of some walls and classes, by default of all. In a
        study of many walls name the class.

        Needs matplotlib. Raises `ValueError` for a name that is not there.
        """
        from matplotlib import pyplot

        curves = self.curves
        names = [names] if isinstance(names, str) else names
        missing = sorted(set(names or ()) - set(curves["wall"].tolist()))
        if missing:
            raise ValueError(f"the study has no wall or class {missing[0]!r}")
        ax = pyplot.subplots()[1] if ax is None else ax
        highest = curves["u_max_over_u_ins"] == curves["u_max_over_u_ins"].max()
        for row in Table({name: column[highest] for name, column in curves.items()}).rows():
            theta, beta = row["theta"], row["beta"]
            if (names is None or row["wall"] in names) and math.isfinite(theta) and beta > 0:
                x = theta * np.exp(np.linspace(-3, 3, 121) * beta)
                y = [0.5 * math.erfc(-z / math.sqrt(2)) for z in np.log(x / theta) / beta]
                ax.plot(x, y, label=f"{row['wall']}, {row['model']}")
        measure = f"{curves['measure'][0]} ({curves['unit'][0]})"
        ax.set(xlabel=measure, ylabel="probability of exceedance", ylim=(0, 1))
        if len(ax.lines) <= MOST_NAMED:
            ax.legend()
        return ax


@dataclass(frozen=True, eq=False, repr=False)
class ReliabilityResults(Tabular):
    """How safe the walls of a study are where they just pass their check, as the tables that
    `wall study reliability` writes."""

    _main = "walls"

    walls: Table
    """A row for each wall, damping model, check and event: a_g with which the wall just passes, θ and β of
    the event, margin θ/a_g and probability P, with 95 % intervals."""
    rules: Table
    """The numbers of the code that would give the stated probability of a fall."""
    summary: Table
    """Fractiles of margins and probabilities over the walls."""

    def __repr__(self) -> str:
        return f"ReliabilityResults({len(set(self.walls['wall']))} walls)"

    def _repr_html_(self) -> str:
        return self.summary._repr_html_()


def read_results(folder: str | PathLike[str]) -> StudyResults:
    """Reads the results of a study from its folder, that of `Study.run`, `wall study ida` or
    `rocking_wall.dask.run`.

    Raises `FileNotFoundError` where there is no study, `ValueError` for one whose runs or results are not
    complete.
    """
    path = Path(folder)
    kept = _native.Folder.open(fsdecode(path))
    levels, collapses = kept.curves()
    if not (path / "study.html").exists():
        raise ValueError(f"{path}: has no results yet; run the study with this folder to make them")
    tables = {name: read_table(path / f"{name}.csv") for name in TABLES}
    xml = path / "fragilities.xml"
    return StudyResults(
        levels=Table(levels),
        collapses=Table(collapses),
        fragilities=read_table(path / "fragilities.csv") or Table({}),
        curves=read_table(path / "fragility_curves.csv") or Table({}),
        **tables,
        nrml=xml.read_text(encoding="utf-8") if xml.exists() else None,
    )


def merge(
    folders: Sequence[str | PathLike[str]] | str | PathLike[str],
    into: str | PathLike[str] | None = None,
    *,
    threads: int | None = None,
) -> StudyResults:
    """Merges the shards of a study, as `wall study merge` does, and returns the results.

    :param folders: The folders of the shards, or the one that they share.
    :param into: The folder of the merged study; not needed where they share one.

    Raises `ValueError` where runs are missing or the folders hold different studies.
    """
    folders = [folders] if isinstance(folders, str | PathLike) else folders
    paths = [fsdecode(folder) for folder in folders]
    kept = _native.Folder.merged(paths, None if into is None else fsdecode(into))
    tell(kept.finish(threads)[1])
    return read_results(kept.path)


def read_table(path: Path) -> Table | None:
    """Reads a table of a folder, if it is there."""
    if not path.exists():
        return None
    with open(path, encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    columns = zip(*rows) if rows else [()] * len(head)
    return Table({name: column_of(name, cells) for name, cells in zip(head, columns)})


TABLES = (
    "rates",
    "rate_shares",
    "vulnerability",
    "losses",
    "samples",
    "sensitivity",
    "variance",
    "cloud",
    "measures",
    "given",
    "records",
    "ties",
)
"""Tables that only some studies have."""

NAMES = {"wall", "of", "model", "part", "record", "parameter", "measure", "unit"}
"""Columns of words, even where a name is a number."""


def column_of(name: str, cells: Sequence[str]) -> NDArray[Any]:
    """Makes an array of counts, flags, numbers or words from the cells of a column of a file."""
    if name not in NAMES and cells:
        if all(re.fullmatch("[0-9]+", cell) for cell in cells):
            return np.array([int(cell) for cell in cells])
        if all(cell in FLAGS for cell in cells):
            return np.array([cell == "true" for cell in cells])
        try:
            return np.array([number(cell) for cell in cells])
        except ValueError:
            pass
    return np.array(cells, dtype=str)


FLAGS = {"true": 1.0, "false": 0.0}


def number(cell: str) -> float:
    """Returns a number: NaN for none and for one that is not known, infinity for one above the levels, 1 or 0
    for a flag among empty cells."""
    if cell in FLAGS:
        return FLAGS[cell]
    if cell.startswith("open"):
        return math.inf if cell.startswith("open >") else math.nan
    return float(cell) if cell else math.nan


def place(folder: str | PathLike[str] | None) -> AbstractContextManager[str]:
    """Gives the folder of a study: a temporary one where none is named."""
    return TemporaryDirectory(prefix="rocking_wall_") if folder is None else nullcontext(fsdecode(folder))


def tell(warnings: Iterable[str], level: int = 3) -> None:
    """Warns of damaged parts of a study, of its fits and rates."""
    for warning in warnings:
        warn(warning, stacklevel=level)


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
