"""Runs of many walls through many records."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._records import Record, motion_of
from ._responses import Peaks
from ._walls import Wall

Objects: TypeAlias = NDArray[np.object_]


def simulate_many(
    walls: Wall | list[Any] | tuple[Any, ...] | Objects,
    records: Record | list[Any] | tuple[Any, ...] | Objects,
    factors: ArrayLike = 1.0,
    *,
    tail: float = 10.0,
    threads: int | None = None,
) -> Peaks:
    """Computes the peaks of many runs, each of a wall under a record multiplied by a factor.

    Walls, records and factors are broadcast as numpy does, and the results have the shape that comes out:
    three sequences of one length give that many runs. Runs go side by side on all cores, whatever their
    walls, records and factors. Each has the peaks of `Wall.peaks`, which works on one core. Ctrl-C stops the
    work.

    :param walls: A wall, a list of walls, nested lists (`[[wall] for wall in walls]` is a column), or an
        array of objects.
    :param records: A record, or records likewise.
    :param factors: Factors on the records.
    :param tail: Free vibration after each record [s].
    :param threads: Number of threads; by default one for each core.

    Raises `ValueError` for shapes that do not fit, and `RuntimeError` for a run that cannot be followed, with
    its number in the order of `ravel`.

    >>> from rocking_wall import synthetic_record
    >>> walls = [Wall(height=height, thickness=0.25) for height in (2, 3, 4)]
    >>> records = [synthetic_record(seed=seed) for seed in (1, 2)]
    >>> peaks = simulate_many([[wall] for wall in walls], records, 0.5)
    >>> peaks.u_ratio_max.shape
    (3, 2)
    >>> bool(peaks.u_max[2, 1] == walls[2].peaks(records[1], [0.5]).u_max[0])
    True
    """
    all_factors = _native.plain(factors)
    given = (_objects(walls, Wall, "walls"), _objects(records, Record, "records"))
    try:
        of_walls, of_records, of_factors = np.broadcast_arrays(*given, all_factors)
    except ValueError:
        shapes = f"{given[0].shape}, {given[1].shape} and {all_factors.shape}"
        raise ValueError(f"walls, records and factors have the shapes {shapes}, which do not fit") from None
    (all_walls, wall_of), (all_records, record_of) = _numbered(of_walls), _numbered(of_records)
    found = _native.simulate_many(
        [wall._native for wall in all_walls],
        [motion_of(record) for record in all_records],
        wall_of,
        record_of,
        of_factors.ravel(),
        tail,
        threads,
    )
    u_max, u_ratio_max, overturn_time = (array.reshape(of_factors.shape) for array in found)
    return Peaks(np.array(of_factors, dtype=np.float64), u_max, u_ratio_max, overturn_time)


def _objects(given: Any, kind: type, name: str) -> Objects:
    """Makes an array of a value of a kind, or of nested sequences of them."""
    if isinstance(given, (list, tuple)):
        parts = [_objects(each, kind, f"{name}[{index}]") for index, each in enumerate(given)]
        if len({part.shape for part in parts}) > 1:
            raise ValueError(f"{name} has parts of different shapes; nest lists of equal lengths")
        return np.stack(parts) if parts else np.empty(0, dtype=object)
    array: Objects = given
    if not (isinstance(given, np.ndarray) and given.dtype == object):
        array = np.empty((), dtype=object)
        array[()] = given
    for index, each in np.ndenumerate(array):
        if not isinstance(each, kind):
            place = f"{name}{list(index)}" if index else name
            if kind is Record:
                motion_of(each, place)
            found = f"found a value of the type {type(each).__name__}"
            raise TypeError(f"{place} must be a {kind.__name__}, {found}")
    return array


def _numbered(objects: Objects) -> tuple[list[Any], list[int]]:
    """Returns the different objects, and for each element the number of its own."""
    different = {id(each): each for each in objects.ravel()}
    places = {identity: place for place, identity in enumerate(different)}
    return list(different.values()), [places[id(each)] for each in objects.ravel()]
