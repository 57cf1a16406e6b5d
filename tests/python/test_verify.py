"""`wall verify --fmu`: the library of an FMU through its C interface, and a planted error."""

import json
import os
import re
import subprocess
import zipfile

UNIT, PROGRAM = os.environ["ROCKING_WALL_FMU"], os.environ["ROCKING_WALL_BIN"]


def verified(path):
    ended = subprocess.run([PROGRAM, "verify", "--fmu", path, "--json"], capture_output=True, text=True)
    assert ended.stderr == ""
    return ended.returncode, json.loads(ended.stdout)


def test_the_fmu_passes():
    code, found = verified(UNIT)
    # full rotations of two walls and a multilinear law, which this FMU does not have
    assert (code, found["failed"], found["missing"]) == (0, 0, 3)
    assert found["passed"] > 90


def test_an_fmu_that_gives_other_numbers_fails(tmp_path):
    """Its F0 is F0_negative, and the other way round: the two differ where the load is eccentric."""
    planted = tmp_path / "planted.fmu"
    with zipfile.ZipFile(UNIT) as unit, zipfile.ZipFile(planted, "w") as other:
        for name in unit.namelist():
            content = unit.read(name)
            if name == "modelDescription.xml":
                swapped = {"F0": "F0_negative", "F0_negative": "F0"}
                pattern = r'name="(F0|F0_negative)"'
                text, count = re.subn(pattern, lambda found: f'name="{swapped[found[1]]}"', content.decode())
                assert count == 2
                content = text.encode()
            other.writestr(name, content)
    code, found = verified(planted)
    failed = [
        (check["case"], check["quantity"])
        for formula in found["formulas"]
        for check in formula["checks"]
        if check["result"] == "FAIL"
    ]
    expected = [(case, name) for case in ["parapet_loaded", "strip_loaded"] for name in ["F0", "F0_negative"]]
    assert (code, failed) == (1, expected)
