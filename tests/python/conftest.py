"""Where the tests find the unit and the program; `cargo xtask test` sets both."""

import os
from pathlib import Path

import pytest

from unit import Unit

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def fmu():
    """Path of the general FMU."""
    path = Path(os.environ.get("ROCKING_WALL_FMU", ROOT / "fmu_out/wall.fmu"))
    assert path.is_file(), f"{path} is missing: run `cargo xtask fmu`"
    return path


@pytest.fixture(scope="session")
def wall():
    """Path of the program `wall`."""
    path = Path(os.environ.get("ROCKING_WALL_BIN", ROOT / "target/release/wall"))
    assert path.is_file(), f"{path} is missing: run `cargo build --release --bin wall`"
    return path


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
    path = Path(os.environ.get("ROCKING_FLOOR_FMU", ROOT / "fmu_out/floor.fmu"))
    assert path.is_file(), f"{path} is missing: run `cargo xtask fmu`"
    return path


@pytest.fixture(scope="session")
def unpacked_floor(floor_fmu):
    """The floor's FMU, unpacked once."""
    with Unit.unpack(floor_fmu) as unpacked:
        yield unpacked
