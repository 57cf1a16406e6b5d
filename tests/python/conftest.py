"""Finds the FMUs and the program for the tests; `cargo xtask test` sets the paths."""

import os
import shutil
from pathlib import Path
from xml.etree import ElementTree

import pytest
from selenium import webdriver

from unit import Unit

ROOT = Path(__file__).parents[2]
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
)  # fmt: skip


def items(enumeration):
    """Returns the names of the items of an enumeration of the model description."""
    description = ElementTree.parse(ROOT / "modelDescription/modelDescription.xml")
    return [item.get("name") for item in description.iterfind(f".//SimpleType[@name='{enumeration}']//Item")]


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


def of_fmi3(fmu):
    """Path of the FMI 3.0 unit that is made beside an FMI 2.0 one."""
    return fmu.parent / "fmi3" / fmu.name


@pytest.fixture(scope="session")
def fmu3(fmu):
    """Path of the general FMU, FMI 3.0."""
    return of_fmi3(fmu)


@pytest.fixture(scope="session")
def unpacked2(fmu):
    """The general FMU, FMI 2.0, unpacked once."""
    with Unit.unpack(fmu) as unpacked:
        yield unpacked


@pytest.fixture(scope="session")
def unpacked3(fmu3):
    """The general FMU, FMI 3.0, unpacked once."""
    with Unit.unpack(fmu3) as unpacked:
        yield unpacked


@pytest.fixture(scope="session")
def unpacked(unpacked2):
    """The general FMU; modules that test both versions have their own."""
    return unpacked2


@pytest.fixture(params=["2.0", "3.0"])
def either(request):
    """The general FMU in each version of FMI."""
    return request.getfixturevalue("unpacked2" if request.param == "2.0" else "unpacked3")


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


@pytest.fixture(scope="module")
def browser():
    """A headless Chromium."""
    binary = next((path for path in map(shutil.which, BROWSERS) if path), None)
    driver = shutil.which("chromedriver")
    if binary is None or driver is None:
        pytest.skip("not run: no Chromium with its driver; install chromium and chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = binary
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    yield browser
    browser.quit()
