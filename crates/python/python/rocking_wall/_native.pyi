"""The part of `rocking_wall` that is in Rust."""

from collections.abc import Callable, Mapping
from typing import Any, Final, TypedDict, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Numbers = NDArray[np.float64]
_Motion = tuple[float, _Numbers]
_Given = tuple[float, ArrayLike]
_Columns = dict[str, Any]
_Motions = tuple[_Given, _Given | None]
_WallValues = tuple[str, list[tuple[str, str]], float | None, _Motions | None, list[str]]
_Values = tuple[str, list[tuple[str, str]], list[tuple[str, float, _Numbers]]]

_Map = NDArray[np.float64]
_Spectrum = tuple[_Numbers, _Numbers, _Map, NDArray[np.bool_], _Map]

VERSION: Final[str]

__all__ = [
    "Building",
    "Folder",
    "Study",
    "VERSION",
    "Wall",
    "average_sa",
    "calculated",
    "calibrate_wall",
    "check_wall",
    "in_si",
    "picture",
    "picture_of_building",
    "picture_of_response",
    "picture_of_spectrum",
    "pulse",
    "read_channels",
    "scaled",
    "scaled_to",
    "spectrum",
    "spectrum_over_pulses",
    "spectrum_over_walls",
    "synthetic",
    "tie_of_wall",
    "trimmed",
    "variables",
    "verify_formulas",
    "warnings_of_channel",
]

class _Channel(TypedDict):
    motion: _Motion
    channel: str | None
    format: str
    unit: str
    header: list[str]
    warnings: list[str]

class _Variable(TypedDict):
    name: str
    group: str
    description: str
    unit: str
    default: float | str
    limits: tuple[float | None, float | None]
    choices: list[str]

def variables() -> list[_Variable]: ...
def calculated() -> list[tuple[str, str, str]]: ...
def read_channels(
    path: str,
    unit: str | None,
    dt: float | None,
    column: str | None,
    channel: str | None,
    format: str | None,
) -> list[_Channel]: ...
def pulse(
    shape: str,
    amplitude: float,
    frequency: float,
    centre: float | None,
    phase: float,
    duration: float | None,
) -> _Motion: ...
def synthetic(seed: int, duration: float, dt: float, pga: float) -> _Motion: ...
def warnings_of_channel(code: str) -> list[str]: ...
def in_si(given: _Given, unit: str) -> _Motion: ...
def scaled(given: _Given, factor: float) -> _Motion: ...
def scaled_to(given: _Given, pga: float) -> _Motion: ...
def trimmed(given: _Given, start: float, end: float) -> _Motion: ...
def spectrum(given: _Given, periods: ArrayLike, damping: float, at_samples: bool) -> _Numbers: ...
def average_sa(given: _Given, periods: ArrayLike, damping: float, at_samples: bool) -> float: ...
def picture(given: _Given, periods: ArrayLike, name: str) -> str: ...
def picture_of_building(
    time: list[float], ground: list[float], accelerations: list[list[float]], u_ratios: list[list[float]]
) -> str: ...
def picture_of_response(time: ArrayLike, a_bottom: ArrayLike, u_ratio: ArrayLike) -> str: ...
def check_wall(
    wall: Wall, text: str, records: list[tuple[str, _Motion]]
) -> tuple[str, dict[str, Any], str]: ...
def spectrum_over_walls(
    wall: Wall,
    record: _Given | None,
    sizes: tuple[bool, ArrayLike],
    slendernesses: tuple[bool, ArrayLike],
    threads: int | None,
) -> _Spectrum: ...
def spectrum_over_pulses(
    wall: Wall, form: str, columns: ArrayLike, rows: ArrayLike, threads: int | None
) -> _Spectrum: ...
def picture_of_spectrum(
    columns: list[float],
    rows: list[float],
    points: list[list[tuple[float, bool, float]]],
    title: str,
    labels: tuple[str, str],
) -> str: ...
def tie_of_wall(
    wall: Wall,
    records: list[_Motion],
    stiffness: ArrayLike | None,
    both_polarities: bool,
    threads: int | None,
) -> tuple[dict[str, Any], _Columns, str, bool]: ...
def verify_formulas() -> _Columns: ...
def calibrate_wall(
    wall: Wall,
    models: list[str] | None,
    restitution: ArrayLike | None,
    a1: ArrayLike | None,
    start: ArrayLike,
    step: float,
    threads: int | None,
) -> tuple[list[_Columns], list[str]]: ...
@final
class Wall:
    def __new__(cls, parameters: Mapping[str, Any]) -> Wall: ...
    @staticmethod
    def from_toml(path: str) -> Wall: ...
    def replaced(self, parameters: Mapping[str, Any]) -> Wall: ...
    def on_storeys(
        self,
        storeys: list[tuple[float | None, float | None, float | None, float | None]],
        bottom: int | None,
        top: int | None,
        drift: bool,
    ) -> Wall: ...
    def sent(self) -> _WallValues: ...
    @staticmethod
    def received(values: _WallValues) -> Wall: ...
    def equals(self, other: Wall) -> bool: ...
    def calculated(self, name: str) -> float: ...
    def parameter(self, name: str) -> Any: ...
    @property
    def title(self) -> str: ...
    @property
    def has_storeys(self) -> bool: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def parameters(self) -> list[tuple[str, str]]: ...
    def facts(self) -> list[tuple[str, str, float, str]]: ...
    def method(self) -> str: ...
    def backbone(self) -> list[_Numbers]: ...
    def picture(self) -> str: ...
    def simulate(
        self,
        record: _Given | None,
        *,
        top: _Given | None,
        tail: float,
        stop_time: float | None,
        output_step: float | None,
        thresholds: list[float] | None,
        hold: bool,
    ) -> dict[str, Any]: ...
    def peaks(self, record: _Given, factors: ArrayLike, tail: float) -> list[_Numbers]: ...
    def package(self, path: str, base: str) -> int: ...

@final
class Building:
    def __new__(cls, path: str) -> Building: ...
    @property
    def title(self) -> str: ...
    @property
    def floors(self) -> list[str]: ...
    @property
    def walls(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...
    def run(self, ground: _Given, tail: float, tolerance: float) -> dict[str, Any]: ...

@final
class Study:
    def __new__(cls, path: str) -> Study: ...
    def __len__(self) -> int: ...
    @property
    def title(self) -> str: ...
    @property
    def measure(self) -> str: ...
    @property
    def walls(self) -> list[str]: ...
    @property
    def records(self) -> list[str]: ...
    @property
    def models(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def parts(self) -> int: ...
    def part(self, part: int) -> bytes: ...
    def sent(self) -> _Values: ...
    @staticmethod
    def of_parts(
        text: str, walls: list[tuple[str, Wall | dict[str, Any]]], records: list[tuple[str, _Given]]
    ) -> Study: ...
    @staticmethod
    def received(values: _Values) -> Study: ...
    def run(self, threads: int | None, progress: Callable[[int], None]) -> list[_Columns]: ...

@final
class Folder:
    def __new__(cls, path: str, study: Study) -> Folder: ...
    def missing(self) -> tuple[list[int], str | None]: ...
    def keep(self, part: int, bytes: bytes) -> None: ...
    def finish(self, threads: int | None) -> tuple[str, str | None]: ...
