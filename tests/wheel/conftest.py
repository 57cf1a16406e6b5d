"""Finds the program and the FMU for the tests of the wheel; `cargo xtask test` sets the paths."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import rocking_wall as rw

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def fmu():
    """Path of the general FMU."""
    return Path(os.environ.get("ROCKING_WALL_FMU", ROOT / "fmu_out/wall.fmu"))


@pytest.fixture(scope="session")
def program():
    """Runs the program `wall` and returns what it prints, as JSON where it is asked for."""
    path = os.environ.get("ROCKING_WALL_BIN", ROOT / "target/release/wall")

    def run(*arguments, code=0):
        command = [str(path), *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
        assert done.returncode == code, done.stderr
        if code:
            return done.stderr
        return json.loads(done.stdout) if "--json" in arguments else done.stdout

    return run


@pytest.fixture(scope="session")
def record():
    """The synthetic record of the program."""
    return rw.synthetic_record()
