"""The portable FMUs: libraries of every platform, and Windows under wine. `cargo xtask portable` runs this.

On Windows every value is that of Linux to the last bit. The libraries of macOS are inspected, not run.
"""

import os
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

import test_cases
from conftest import ROOT
from library import problems
from test_restart import BREAK, END, STEP, restart
from unit import Unit
from windows import RecordingUnit, Wine, digits, windows_path

# bytes of the FMU for a processor, small enough for a mail or a repository
LARGEST = 450_000
PLATFORMS = {"linux64": "so", "win64": "dll", "darwin64": "dylib"}
DRIVER = "ROCKING_WALL_DRIVER"

pytestmark = pytest.mark.skipif(DRIVER not in os.environ, reason="`cargo xtask portable` runs these tests")


@pytest.fixture(scope="session")
def wine():
    program = shutil.which("wine")
    if program is None:
        pytest.skip("wine is missing: `apt-get install wine wine64`")
    return Wine(program, os.environ[DRIVER], os.environ["ROCKING_WALL_EXE"])


@pytest.mark.parametrize("platform", [*PLATFORMS, "aarch64-linux"])
@pytest.mark.parametrize("name", ["wall", "floor"])
def test_library(name, platform, fmu, floor_fmu, tmp_path):
    library = f"binaries/{platform}/{name}.{PLATFORMS.get(platform, 'so')}"
    unit = {"wall": fmu, "floor": floor_fmu}[name]
    if platform not in PLATFORMS:
        # FMI 2.0 has no name for it
        unit = unit.parent / "fmi3" / unit.name
    with zipfile.ZipFile(unit) as archive:
        archive.extract(library, tmp_path)
    assert problems(tmp_path / library) == []
    content = (tmp_path / library).read_bytes()
    assert str(ROOT).encode() not in content, "the folder of the build is in the library"


def test_size(fmu):
    with zipfile.ZipFile(fmu) as archive:
        libraries = [name for name in archive.namelist() if name.startswith("binaries/")]
    # the library of macOS is for two
    processors = sum(1 + ("darwin" in name) for name in libraries)
    assert fmu.stat().st_size < LARGEST * processors


@pytest.fixture(scope="session")
def shaken(fmu, wall, tmp_path_factory):
    """The FMU of a scene with a motion, in a folder whose name has to be escaped in a URI."""
    path = tmp_path_factory.mktemp("scene") / "shaken.fmu"
    command = [wall, "package", ROOT / "scenes/shaken_parapet.toml", "--base", fmu, "--output", path]
    subprocess.run(command, check=True, cwd=ROOT)
    with Unit.unpack(path) as unpacked:
        folder = Path(unpacked.folder)
        unpacked.folder = str(folder.rename(folder.with_name(folder.name + " ü 100%")))
        yield unpacked


def test_scenes_keep_the_platforms(shaken):
    libraries = {path.name for path in Path(shaken.folder).glob("binaries/*/*")}
    assert libraries == {f"wall.{ending}" for ending in PLATFORMS.values()}


def check(unit, wine):
    count, different = unit.repeat(wine)
    largest = {}
    for name, linux, windows in different:
        largest[name] = max(largest.get(name, 0.0), abs(linux - windows))
    assert not different, f"{len(different)} of {count} values differ, at most by {largest}"
    assert count > 100


@pytest.mark.parametrize("name", test_cases.NAMES)
def test_reference_case_on_windows(name, unpacked, wine):
    with RecordingUnit(unpacked) as unit:
        test_cases.test_case(name, unit)
        check(unit, wine)


def test_resources_on_windows(shaken, wine):
    with RecordingUnit(shaken) as unit:
        unit.start()
        for _ in range(500):
            unit.step(0.02)
        assert unit.get("u_max") > 0
        check(unit, wine)


def test_floor_on_windows(unpacked_floor, wine):
    with RecordingUnit(unpacked_floor) as unit:
        unit.start(hysteresis="bilinear", yield_force=6e4, hardening_ratio=0.1)
        for index in range(500):
            unit.set(a_g=3.0 * (-1) ** (index // 20)).step(0.01)
        check(unit, wine)


def test_a_state_goes_to_windows_and_back(unpacked, fmu3, wine, tmp_path):
    """`restart.py` saves and resumes on Linux; on Windows the driver does."""
    linux, windows = tmp_path / "linux.state", tmp_path / "windows.state"
    restart("save", unpacked.path, linux)
    u = float(restart("resume", unpacked.path, linux))
    (reference,) = (v.valueReference for v in unpacked.description.modelVariables if v.name == "u")

    def steps(first, last):
        return [f"step {digits(index * STEP)} {digits(STEP)}" for index in range(first, last)]

    # from Linux to Windows
    last = f"get {reference:x} {digits(u)}"
    calls = [f"resume {windows_path(linux)}", *steps(BREAK, END), last]
    assert wine.drive(unpacked, calls) == "1 compared\n"
    # and back: Windows saves the bytes of Linux, which the FMI 3.0 unit resumes too
    begin = [f"setup 0 {digits(0.0)} {digits(0.0)}", "enter", "exit"]
    assert wine.drive(unpacked, [*begin, *steps(0, BREAK), f"save {windows_path(windows)}"]) == "0 compared\n"
    assert windows.read_bytes() == linux.read_bytes()
    assert float(restart("resume", fmu3, windows)) == u


@pytest.mark.parametrize("scene", ["shaken_parapet", "plain_parapet"])
def test_histories_on_windows(scene, wall, wine, tmp_path):
    scene = ROOT / f"scenes/{scene}.toml"
    subprocess.run([wall, "simulate", scene, "--csv", tmp_path / "linux.csv"], check=True, cwd=ROOT)
    wine.run(wine.wall, "simulate", windows_path(scene), "--csv", windows_path(tmp_path / "windows.csv"))
    assert (tmp_path / "windows.csv").read_bytes() == (tmp_path / "linux.csv").read_bytes()
