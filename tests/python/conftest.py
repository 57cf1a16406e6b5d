"""Finds the FMUs and the program for the tests; `cargo xtask test` sets the paths."""

import math
import os
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest
from selenium import webdriver
from xdist.scheduler import LoadFileScheduling

from unit import Unit

ROOT = Path(__file__).parents[2]
OF_PAGES = ("test_page.py", "test_paper.py", "test_playground.py", "test_reproduce_page.py")
LINES = ["PEER", "A TEST", "ACCELERATION TIME SERIES IN UNITS OF G", "NPTS= 1000, DT= .01 SEC"]
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


class WholeFiles(LoadFileScheduling):
    """Runs each file in one process, and those of pages in the same: what they build is made once."""

    def _split_scope(self, nodeid):
        file = Path(super()._split_scope(nodeid)).name
        return "pages" if file in OF_PAGES else file


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    return WholeFiles(config, log)


@pytest.fixture(scope="session")
def chromium():
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
    chromium = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    yield chromium
    chromium.quit()


@pytest.fixture(scope="module")
def browser(chromium):
    """A tab of the browser, without sizes and colours of other tabs."""
    first = chromium.current_window_handle
    chromium.switch_to.new_window("tab")
    yield chromium
    chromium.close()
    chromium.switch_to.window(first)


@pytest.fixture(scope="session")
def playground():
    """Path of the playground."""
    path = os.environ.get("ROCKING_WALL_PLAYGROUND")
    if path is None:
        pytest.skip("not run: no playground; run `cargo xtask playground` and name the page in "
                    "ROCKING_WALL_PLAYGROUND")  # fmt: skip
    return Path(path).absolute()


@pytest.fixture(scope="session")
def reproduced(wall, tmp_path_factory):
    """The folder in which `wall verify paper` has written its page, and what it has told."""
    folder = tmp_path_factory.mktemp("reproduce")
    records = folder / "records"
    records.mkdir()
    (records / "notes.md").write_text("# no record\n")
    for number in (1, 2, 3):
        samples = (
            0.3 * math.sin(4.0 * number * 0.01 * i) * math.sin(math.pi * i / 1000) for i in range(1000)
        )
        (records / f"{number}.AT2").write_text("\n".join(LINES + [f"{a:15.7E}" for a in samples]) + "\n")
    command = [wall, "verify", "paper", "--records", "records", "-o", "paper.html"]
    return folder, subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)


@pytest.fixture(scope="session")
def reproduction(reproduced):
    """The page of `wall verify paper` with three records."""
    folder, _ = reproduced
    return folder / "paper.html"


@pytest.fixture(scope="session")
def calibration(wall, tmp_path_factory):
    """The page of a calibration."""
    path = tmp_path_factory.mktemp("calibrate") / "calibration.html"
    command = [wall, "study", "calibrate", "--restitution", "0.84,0.92", "--a1", "0.02,0.05", "--html", path]
    subprocess.run(command, check=True, capture_output=True)
    return path


@pytest.fixture(scope="session")
def building(wall, tmp_path_factory):
    """The page of a building under the synthetic motion."""
    page = tmp_path_factory.mktemp("page") / "building.html"
    scene = ROOT / "scenes/building/three_storeys.toml"
    motion = ["--synthetic", "--tail", "2"]
    subprocess.run([wall, "building", scene, *motion, "--html", page], check=True, capture_output=True)
    return page
