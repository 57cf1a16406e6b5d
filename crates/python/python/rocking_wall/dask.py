"""Studies on Dask distributed: a part of the study is a task.

    from distributed import Client
    import rocking_wall as rw

    client = Client("scheduler:8786")
    folder = rw.dask.run(rw.Study.from_toml("study.toml"), client)

The package `distributed` has to be installed here and on the workers, and this package on both in the same
version. Workers need no files: walls and records are sent to each of them once.
"""

from __future__ import annotations

from itertools import islice
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._folders import bar, tell
from ._studies import Study

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["run"]

AHEAD = 4
"""Parts that wait at the scheduler for each thread of the workers."""


def run(
    study: Study,
    client: Client,
    folder: str | PathLike[str] | None = None,
    *,
    threads: int | None = None,
    progress: bool = True,
) -> Path:
    """Runs a study on the workers of a client and writes its results; returns their folder.

    The folder, by default the study's name and `_results`, is that of `wall study ida`, with the same bytes:
    parts in `runs/` (Parquet), tables and a page; `rocking_wall.read_results` reads it. Parts appear as they
    come. A study that is started again, here or with `wall study ida`, continues where it stopped. A worker
    that is lost costs the parts that it was computing: they are computed again elsewhere. `threads` are those
    of this process, which fits the fragilities.

    Raises `ValueError` if the folder holds another study, and what a task has raised.
    """
    from distributed import as_completed

    path = Path(f"{study._name}_results" if folder is None else folder)
    kept = _native.Folder(fspath(path), study._native)
    missing, damage = kept.missing(1, 1)
    tell(damage)
    parts = iter(missing)
    with bar(len(missing), progress, " parts") as report:
        if missing:
            sent = client.scatter(study, broadcast=True)
            threads_there = max(1, sum(client.nthreads().values()))

            def submit(count: int) -> Any:
                return client.map(compute, list(islice(parts, count)), study=sent, pure=False)

            done = 0
            tasks = as_completed(submit(AHEAD * threads_there), with_results=True)
            for batch in tasks.batches():
                for _, computed in batch:
                    kept.keep(*computed)
                done += len(batch)
                report(done)
                tasks.update(submit(len(batch)))
    summary, warnings = kept.finish(threads)
    tell(warnings)
    if progress:
        print(summary, end="")
    return path


def compute(part: int, study: Study) -> tuple[int, bytes]:
    """Computes a part on a worker: its number and the bytes of its file."""
    return part, study._native.part(part)
