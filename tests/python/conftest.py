"""Finds the FMUs and the program for the tests; `cargo xtask test` sets the paths."""

import os
from pathlib import Path

import pytest

from unit import Unit

ROOT = Path(__file__).parents[2]


def built(variable, default, command):
    """Returns the path in an environment variable, or the default path; `command` builds the file."""
    path = Path(os.environ.get(variable, ROOT / default))
    assert path.is_file(), f"{path} is missing: run `{command}`"
    return path


@pytest.fixture(scope="session")
def fmu():
    """Path of the general FMU."""
    return built("ROCKING_WALL_FMU", "fmu_out/wall.fmu", "cargo xtask fmu")


@pytest.fixture(scope="session")
def wall():
    """Path of the program `wall`."""
    return built("ROCKING_WALL_BIN", "target/release/wall", "cargo build --release --bin wall")


@pytest.fixture(scope="session")
def unpacked(fmu):
    """The general FMU, unpacked once."""
    with Unit.unpack(fmu) as unpacked:
        yield unpacked


@pytest.fixture
def unit(unpacked):
    """A fresh instance of the general FMU, not initialised."""
    with Unit(unpacked) as instance:
        yield instance


@pytest.fixture(scope="session")
def floor_fmu():
    """Path of the floor's FMU."""
    return built("ROCKING_FLOOR_FMU", "fmu_out/floor.fmu", "cargo xtask fmu")


@pytest.fixture(scope="session")
def unpacked_floor(floor_fmu):
    """The floor's FMU, unpacked once."""
    with Unit.unpack(floor_fmu) as unpacked:
        yield unpacked
