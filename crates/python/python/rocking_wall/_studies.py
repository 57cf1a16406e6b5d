"""Incremental dynamic analyses."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fsdecode
from os.path import abspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias
from warnings import warn

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._folders import ReliabilityResults, StudyResults, bar, place, read_results, read_table, tell
from ._given import Attribute
from ._records import Motion, Record, listed, motion_of, read_record
from ._tables import Table, printable, toml, toml_lines
from ._walls import Wall

if TYPE_CHECKING:
    import pandas

    from . import options

    AWall: TypeAlias = Wall | Mapping[str, Any]
    Walls: TypeAlias = pandas.DataFrame | Table | Wall | Sequence[AWall] | Mapping[str, AWall]
    ARecord: TypeAlias = Record | str | PathLike[str]
    Records: TypeAlias = ARecord | Sequence[ARecord] | Mapping[str, ARecord]


Polarity = Literal["as_recorded", "reversed", "both", "worst"]


class Study:
    """An incremental dynamic analysis: walls, records, damping models, intensity measure and levels.

    It is a file, that of `wall study ida`, beside which scenes and records are looked up; or its parts by the
    keys of such a file.

    >>> from rocking_wall import Wall, synthetic_record
    >>> study = Study(
    ...     walls={"low": Wall(height=1.5, thickness=0.25), "high": Wall(height=3, thickness=0.25)},
    ...     records=[synthetic_record(seed, duration=12) for seed in (1, 2, 3)],
    ...     models=["CR", "CDC"],
    ...     levels={"method": "step", "step": 0.5, "top": 10},
    ... )
    >>> study
    Study('Incremental dynamic analysis', 2 walls, 3 records, 2 damping models)
    """

    title = Attribute[str]("Title.")
    walls = Attribute[list[str]]("Names of the walls.")
    records = Attribute[list[str]]("Names of the records.")
    models = Attribute[list[str]]("Names of the damping models.")
    measure = Attribute[str]("Name of the intensity measure.")

    def __init__(
        self,
        path: str | PathLike[str] | None = None,
        *,
        walls: Walls | None = None,
        records: Records | None = None,
        models: Sequence[str | options.Model] | None = None,
        levels: options.Levels | None = None,
        title: str | None = None,
        intensity: options.Intensity | None = None,
        tail: float | None = None,
        collapse_is: Literal["exceeds", "falls"] | None = None,
        polarity: Polarity | None = None,
        scaled_shocks: Literal["all", "last"] | None = None,
        report: options.Report | None = None,
        classes: Sequence[options.Class] | None = None,
        hazard: options.Hazard | None = None,
        uncertain: options.Uncertain | None = None,
        check: options.Check | options.Fractions | None = None,
        reliability: options.Reliability | None = None,
    ) -> None:
        """Reads a study file, or makes a study of its parts. `help(rocking_wall.options)` lists the keys of
        dictionaries. A NumPy generator in place of a seed draws one.

        :param walls: A DataFrame, a Dataset or other table with a column for each parameter, a row for each
            wall, and their names in a column `name` or the index; or walls, or dictionaries of parameters, in
            a list or by their names. What is missing has its default, but no gap of a table in height,
            thickness or density. Damping and impact are those of the models; ξ and c̄ serve those that have
            none of their own.
        :param records: Records, or paths of records, in a list or by their names. Lists with factors and
            weights, and stripes of their own records, are those of a study file.
        :param models: Damping models by the names of study files, such as CR (restitution), "CR rigid", CDC
            (constant coefficient) and CDR (constant ratio).
        :param levels: The levels of intensity, such as `{"method": "step", "step": 0.1, "top": 5}` in the
            unit of results: g, cm/s of PGV, cm of PGD and Housner, m/s of Arias, g s of CAV. `{"method":
            "cloud"}` runs each record once, and takes a regression.
        :param intensity: The intensity measure, such as `{"measure": "Sa", "period": 0.5}`; by default AvgSA.
            Others are PGA, PGV, PGD, Arias, CAV and Housner; `{"measure": "code"}` is a_g of the site that
            `check` states. `"compare": ["PGA", "PGV", "Sa(0.5)"]` compares measures by the runs.
        :param tail: Free vibration after each record [s]; by default 10.
        :param collapse_is: Which runs have collapsed: those that exceed u_ins ("exceeds", the default), or
            those that do not come back ("falls").
        :param polarity: The signs with which records are run: "as_recorded" (the default), "reversed", "both"
            as two records, or "worst", at each level the one that demands more of the wall.
        :param scaled_shocks: What the levels scale of a `sequence`: "all" (the default) or the "last" shock.
        :param report: Limit states and bootstrap, such as `{"fractions": [0.4, 1.0]}`.
        :param classes: Classes of walls, such as `{"name": "all", "walls": ["low", "high"]}`.
        :param hazard: The hazard of the site, such as `{"points": [[0.1, 0.01], [0.4, 4e-4]]}` (intensities
            in the unit of results, and annual rates at which they are exceeded), or `{"file": "curve.csv"}`;
            for annual rates.
        :param uncertain: Distributions of parameters, of which each wall stands for samples, such as
            `{"samples": 100, "parameters": {"height": {"normal": [3.0, 0.1]}}}`.
        :param check: The table `[check]`, for `reliability`.
        :param reliability: What `reliability` asks, such as `{"probability": 0.1}`.

        Raises `ValueError` and `TypeError` for what cannot be used, `FileNotFoundError` for a file that is
        missing.
        """
        parts: dict[str, Any] = {"walls": walls, "records": records, "models": models, "levels": levels}
        parts |= {"title": title, "intensity": intensity, "tail": tail, "report": report}
        parts |= {"classes": classes, "collapse_is": collapse_is, "hazard": hazard, "check": check}
        parts |= {"reliability": reliability, "uncertain": uncertain, "polarity": polarity}
        parts |= {"scaled_shocks": scaled_shocks}
        given = {name: part for name, part in parts.items() if part is not None}
        if path is None:
            missing = [name for name in ("walls", "records", "models", "levels") if name not in given]
            if missing:
                raise TypeError(f"a study needs a path, or its parts: {', '.join(missing)} missing")
            if not isinstance(levels, Mapping):
                remedy = 'such as {"method": "grid", "values": [0.1, 0.2]}'
                raise TypeError(f"levels = {levels!r} must be a dictionary, {remedy}")
            del given["walls"], given["records"]
            text = toml_lines(given)
            self._native = _native.Study.of_parts(text, named_walls(walls), named_records(records))
            self._name = "study" if title is None else title
            self._is_file = False
        else:
            if given:
                raise TypeError(f"a study file has its own {', '.join(given)}; leave them out")
            self._native = _native.Study(fsdecode(path))
            self._name = Path(fsdecode(path)).stem
            self._is_file = True
        for warning in self._native.warnings:
            warn(warning, stacklevel=2)

    @classmethod
    def from_toml(cls, path: str | PathLike[str]) -> Study:
        """Reads a study file."""
        return cls(path)

    def __getstate__(self) -> tuple[Any, ...]:
        return (self._name, self._is_file, self._native.sent())

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self._name, self._is_file, values = state
        self._native = _native.Study.received(values)

    def to_toml(self, path: str | PathLike[str]) -> None:
        """Writes a study that was made of parts as a study file, for `wall study ida` and for colleagues: the
        same results to the last bit. The records are in the folder `PATH_records` beside it, as numbers in
        text files of their names. A sequence has a file for each shock, and goes by the names of these. Other
        files that the study names, such as that of a hazard, stay where they are, by their absolute paths.

        Raises `FileExistsError` for a file that exists, `ValueError` for what a study file cannot hold:
        walls on storeys, records with several steps, names that are not those of files.
        """
        if self._is_file:
            raise ValueError(f"the study {self._name!r} is a file already; copy it and what it names")
        write_study(Path(fsdecode(path)), *self._native.sent()[:3])

    def __repr__(self) -> str:
        walls, records, models = len(self.walls), len(self.records), len(self.models)
        return printable(f"Study({self.title!r}, {walls} walls, {records} records, {models} damping models)")

    def __len__(self) -> int:
        return len(self._native)

    def run(
        self,
        folder: str | PathLike[str] | None = None,
        *,
        threads: int | None = None,
        progress: bool = True,
    ) -> StudyResults:
        """Runs the study on all cores, or on some threads, fits the fragilities, and returns the results.

        :param folder: Where runs, tables and a page are kept, as `wall study ida` does. A study that was
            stopped continues there, and `read_results` reads it again. By default nothing is kept.

        Shows a bar where tqdm is installed. Ctrl-C stops it. The results do not depend on the number of
        threads. Raises `ValueError` if the folder holds another study.
        """
        with place(folder) as path:
            tell(self._complete(path, threads, progress).finish(threads)[1])
            return read_results(path)

    def reliability(
        self,
        folder: str | PathLike[str] | None = None,
        *,
        threads: int | None = None,
        progress: bool = True,
    ) -> ReliabilityResults:
        """Runs the study and asks how safe its walls are where they just pass their check.

        The study needs `check`, and `intensity={"measure": "code"}`. Walls that cannot be checked are left
        out, with a warning. Otherwise as `run`.
        """
        with place(folder) as path:
            kept = self._complete(path, threads, progress)
            tell(kept.finish(threads)[1])
            tell(kept.reliability(self._native, threads)[1])
            names = ("reliability", "reliability_rules", "reliability_summary")
            tables = (read_table(Path(path, f"{name}.csv")) for name in names)
            return ReliabilityResults(*(Table({}) if table is None else table for table in tables))

    def compute(
        self,
        folder: str | PathLike[str],
        shard: tuple[int, int] = (1, 1),
        *,
        threads: int | None = None,
        progress: bool = True,
    ) -> None:
        """Computes the runs of one share of several, such as `(2, 8)`, into a folder, without any results.

        The shares of a study may have folders of their own, or one that they share; `rocking_wall.merge`
        makes the results once all are there.
        """
        numbers = [number for number in np.ravel(shard).tolist() if type(number) is int]
        if len(numbers) != 2 or not 1 <= numbers[0] <= numbers[1]:
            raise ValueError(f"shard = {shard} must be a number and how many there are, such as (2, 8)")
        self._complete(fsdecode(folder), threads, progress, (numbers[0], numbers[1]))

    def _complete(
        self, path: str, threads: int | None, progress: bool, shard: tuple[int, int] = (1, 1)
    ) -> _native.Folder:
        kept = _native.Folder(path, self._native)
        missing, damage = kept.missing(*shard)
        tell(damage, 4)
        with bar(kept.count(missing), progress) as report:
            kept.compute(self._native, missing, threads, report)
        return kept


def named_walls(walls: Any) -> list[tuple[str, Any]]:
    """Returns names, and walls or dictionaries of their parameters."""
    if isinstance(walls, Wall):
        walls = [walls]
    elif hasattr(walls, "to_dataframe") and len(walls.dims) > 0 and hasattr(walls, "data_vars"):
        # a Dataset of xarray has coordinates beside its columns
        walls = rows_of(walls.to_dataframe())
    elif hasattr(walls, "columns"):
        walls = rows_of(walls.collect() if hasattr(walls, "collect") else walls)
    elif isinstance(walls, Mapping):
        if not all(isinstance(wall, Wall | Mapping) for wall in walls.values()):
            walls = rows_of_columns(walls)
        else:
            return [(str(name), one_wall(wall, str(name))) for name, wall in walls.items()]
    if not isinstance(walls, Iterable) or isinstance(walls, str | PathLike):
        remedy = "give a table, walls, or dictionaries of parameters; a study file goes to Study.from_toml"
        raise TypeError(f"walls = {walls!r}: {remedy}")
    return [(name_of(wall, number), one_wall(wall, number)) for number, wall in enumerate(walls, 1)]


def rows_of(frame: Any) -> list[dict[str, Any]]:
    """Returns the rows of a table that have content.

    An index with a name is a column, and one without has the names of the walls; but for numbers from 0 on.
    """
    index: Any = getattr(frame, "index", None)
    levels = list(getattr(index, "names", ()))
    is_counted = type(index).__name__ == "RangeIndex" and (index.start, index.step) == (0, 1)
    if levels == [None] and "name" not in frame.columns and not is_counted:
        frame = frame.rename_axis("name").reset_index()
    elif levels not in ([], [None]) and not is_counted:
        twice = [level for level in levels if level in frame.columns]
        frame = frame.reset_index(twice, drop=True) if twice else frame
        frame = frame.reset_index() if len(twice) < len(levels) else frame
    # a table of pyarrow has names beside its columns
    columns = list(getattr(frame, "column_names", frame.columns))
    names = [str(name) for name in columns]
    twins = sorted({name for name in names if names.count(name) > 1})
    if twins:
        raise ValueError(f"the table of walls has two columns {twins[0]!r}; give each column its own name")
    return rows_of_columns({name: frame[column] for name, column in zip(names, columns)})


def rows_of_columns(columns: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Returns the rows of columns by their names that have content; each cell keeps its type.

    A row without a name is refused.
    """
    single = [name for name, each in columns.items() if isinstance(each, str) or not np.iterable(each)]
    if single:
        raise TypeError(
            f"the column {single[0]!r} of a table of walls is one value; give one wall as [{{...}}], or a "
            "list for each column"
        )
    cells = [each.to_pylist() if hasattr(each, "to_pylist") else list(each) for each in columns.values()]
    if len({len(column) for column in cells}) > 1:
        found = ", ".join(f"{name!r} has {len(column)}" for name, column in zip(columns, cells))
        raise ValueError(f"the columns of a table of walls need one length: {found}; complete the short ones")
    filled = []
    for number, row in enumerate((dict(zip(columns, row)) for row in zip(*cells)), 1):
        if all(is_missing(value) for value in row.values()):
            continue
        if "name" in row and is_missing(row["name"]):
            raise ValueError(f"row {number} of the table of walls has no name; write one, or delete the row")
        filled.append(row)
    return filled


def name_of(wall: object, number: object) -> str:
    """Returns the name of a wall of a list, or else its number."""
    name = wall.get("name") if isinstance(wall, Mapping) else None
    return str(number if is_missing(name) else name)


def one_wall(wall: object, name: object) -> Any:
    """Returns a wall, or its parameters without those that are missing."""
    if isinstance(wall, Wall):
        return wall._native
    if isinstance(wall, Mapping):
        if not isinstance(name, int) and str(wall.get("name", name)) != str(name):
            raise ValueError(f"the wall {name!r} is called {wall['name']!r}, too; leave one name out")
        gaps = [key for key in WITHOUT_GAPS if key in wall and is_missing(wall[key])]
        if gaps:
            called = name_of(wall, name)
            raise ValueError(f"the wall {called!r} has no {gaps[0]}; write it, or leave row or column out")
        return {name: value for name, value in wall.items() if name != "name" and not is_missing(value)}
    found = type(wall).__name__
    raise TypeError(
        f"a wall of a study is a Wall or a dictionary of parameters, found a value of the type {found}"
    )


WITHOUT_GAPS = ("height", "thickness", "density")
"""Parameters that every wall of a table has if one has it."""


def is_missing(value: Any) -> bool:
    """Returns whether a cell of a table is empty."""
    if isinstance(value, str):
        return value.strip() == ""
    # that of pandas cannot be compared; NaN, NaT and their like differ from themselves
    is_none = value is None or value is np.ma.masked or type(value).__name__ == "NAType"
    return is_none or (np.ndim(value) == 0 and bool(value != value))


def named_records(records: Any) -> list[tuple[str, Motion]]:
    """Returns names and motions of records, which are read where they are paths."""
    if isinstance(records, str | PathLike):
        records = [records]
    if isinstance(records, Mapping):
        of_file = [key for key in ("selection", "files", "sequences", "synthetic") if key in records]
        if of_file and not isinstance(records[of_file[0]], Record):
            remedy = "write them there, and read it with rw.Study(path); here give Records or paths"
            raise TypeError(f"{of_file[0]} = ... states the records of a study file; {remedy}")
        return [(str(name), motion_of(read(record))) for name, record in records.items()]
    return [(getattr(record, "name", ""), motion_of(record)) for record in map(read, listed(records))]


def read(record: object) -> object:
    """Reads a record where it is a path."""
    return read_record(record) if isinstance(record, str | PathLike) else record


def anchored(text: str) -> str:
    """Returns options with absolute paths of the files that they name."""
    options = tomllib.loads(text)
    files = (
        ("hazard", "file"),
        ("intensity", "records_table"),
        ("check", "site", "grid"),
        ("check", "spectrum"),
    )
    for *tables, key in files:
        table = options
        for name in tables:
            table = table.get(name, {})
        if isinstance(table.get(key), str):
            table[key] = abspath(table[key])
    return toml_lines(options)


def shocks_of(file: str, motion: Motion) -> dict[str, NDArray[np.float64]]:
    """Returns files and samples of the shocks of a record, with the pause after each; of one record all.

    The files of a sequence have the names that its own name joins, each in a folder of its number.
    """
    _, samples, later = motion
    if not later:
        return {file: samples}
    names = file.rpartition("/")[2].split(" + ")
    if len(names) != len(later) + 1:
        names = [f"{names[0]} {number}" for number in range(1, len(later) + 2)]
    shocks = zip(names, np.split(samples, later), strict=True)
    return {f"{file}/{number}/{name}": shock for number, (name, shock) in enumerate(shocks, 1)}


def write_study(
    path: Path,
    text: str,
    walls: Sequence[tuple[str, str, Sequence[str]]],
    records: Sequence[tuple[str, Motion]],
) -> None:
    """Writes a study file with its walls, without what nobody stated of them, and its records beside it."""
    tables = []
    for name, whole, assumed in walls:
        lines = whole.splitlines(keepends=True)
        wall = "".join(line for line in lines if line.partition(" =")[0] not in assumed)
        if "[storeys" in wall or "[supports" in wall:
            raise ValueError(f"wall {name!r} stands on storeys, which this file would need for all walls")
        groups = wall.replace("\n[", "\n[walls.").replace("[", "[walls.", 1)
        tables.append(f"\n[[walls]]\nname = {toml(name)}\n{groups}")
    steps = {step for _, (step, *_) in records}
    if len(steps) > 1:
        shown = " and ".join(f"{step:g} s" for step in sorted(steps)[:2])
        raise ValueError(f"the records have steps of {shown}, and those of a study file have one")
    for name, *_ in records:
        if name in ("", ".", "..") or not set(name).isdisjoint('/\\:*?"<>|'):
            raise ValueError(f"the record {name!r} has no name of a file; give it another one")
    folder = path.with_name(f"{path.stem}_records")
    shocks = [shocks_of(f"{folder.name}/{name}", motion) for name, motion in records]
    described = {"format": "numbers", "step": steps.pop(), "unit": "m/s2"}
    if any(len(each) > 1 for each in shocks):
        # a list of one file is that record alone; `files` would come first, in another order
        described |= {"sequences": [list(each) for each in shocks], "pause": 0}
    else:
        described["files"] = [name for each in shocks for name in each]
    if folder.exists():
        raise FileExistsError(f"{folder}: exists; remove it, or write the study elsewhere")
    with open(path, "x", encoding="utf-8", newline="") as file:
        for name, samples in (item for each in shocks for item in each.items()):
            numbers = "".join(f"{sample!r}\n" for sample in samples.tolist())
            (path.parent / name).parent.mkdir(parents=True, exist_ok=True)
            (path.parent / name).write_text(numbers, encoding="utf-8", newline="")
        file.write(f"{anchored(text)}records = {toml(described)}\n{''.join(tables)}")
