"""The part of `rocking_wall` that is in Rust."""

from collections.abc import Callable, Mapping
from typing import Any, Final, TypedDict, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Numbers = NDArray[np.float64]
_Motion = tuple[float, _Numbers]
_Given = tuple[float, ArrayLike]
_Columns = dict[str, Any]

VERSION: Final[str]

__all__ = [
    "Study",
    "VERSION",
    "Wall",
    "average_sa",
    "picture",
    "picture_of_response",
    "pulse",
    "read_channels",
    "scaled",
    "scaled_to",
    "spectrum",
    "synthetic",
    "trimmed",
    "variables",
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
def scaled(given: _Given, factor: float) -> _Motion: ...
def scaled_to(given: _Given, pga: float) -> _Motion: ...
def trimmed(given: _Given, start: float, end: float) -> _Motion: ...
def spectrum(given: _Given, periods: ArrayLike, damping: float, at_samples: bool) -> _Numbers: ...
def average_sa(given: _Given, periods: ArrayLike, damping: float, at_samples: bool) -> float: ...
def picture(given: _Given, periods: ArrayLike, name: str) -> str: ...
def picture_of_response(time: ArrayLike, a_bottom: ArrayLike, u_ratio: ArrayLike) -> str: ...
@final
class Wall:
    def __new__(cls, parameters: Mapping[str, Any]) -> Wall: ...
    @staticmethod
    def from_toml(path: str) -> Wall: ...
    def replaced(self, parameters: Mapping[str, Any]) -> Wall: ...
    @property
    def title(self) -> str: ...
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
    def run(self, threads: int | None, progress: Callable[[int], None]) -> list[_Columns]: ...
