"""Out-of-plane rocking of masonry walls under earthquakes.

>>> import rocking_wall as rw
>>> wall = rw.Wall(height=3, thickness=0.25)
>>> response = wall.simulate(rw.synthetic_record(pga=1.0))
>>> response.overturned
False

Parameters have the names, units and defaults of the FMU's variables: `help(rw.Wall)` lists them. All numbers
are in SI units, except for intensities of a study: the names of their columns end in the unit, such as `_g`,
and `curves` has a column `unit`. What cannot be used raises `ValueError`, a file that is missing
`FileNotFoundError`, and an unknown parameter `TypeError`.
"""

from warnings import warn

from . import dask, options
from ._buildings import Building, BuildingResponse, BuildingWallResponse, FloorResponse
from ._folders import ReliabilityResults, StudyResults, merge, read_results
from ._many import simulate_many
from ._native import VERSION as __version__
from ._parameters import Parameters
from ._records import (
    Record,
    half_sine,
    harmonic,
    read_channels,
    read_record,
    ricker,
    sequence,
    sine_cycle,
    synthetic_record,
)
from ._responses import Demands, Extremes, Instant, Peaks, Response, Shock, Threshold
from ._results import Calibration, RockingSpectrum, TieStudy, Verdict, verify
from ._studies import Study
from ._tables import Table
from ._walls import Description, Storey, Wall, package

__all__ = [
    "Building",
    "BuildingResponse",
    "BuildingWallResponse",
    "Calibration",
    "Demands",
    "Description",
    "Extremes",
    "FloorResponse",
    "Instant",
    "Parameters",
    "Peaks",
    "Record",
    "ReliabilityResults",
    "Response",
    "RockingSpectrum",
    "Shock",
    "Storey",
    "Study",
    "StudyResults",
    "Table",
    "Threshold",
    "TieStudy",
    "Verdict",
    "Wall",
    "__version__",
    "dask",
    "half_sine",
    "harmonic",
    "merge",
    "options",
    "package",
    "read_channels",
    "read_record",
    "read_results",
    "ricker",
    "sequence",
    "simulate_many",
    "sine_cycle",
    "synthetic_record",
    "verify",
]

if __version__.endswith(".dev"):
    warn(f"rocking_wall {__version__} is slow, built without optimisation; use a release", stacklevel=2)
del warn
