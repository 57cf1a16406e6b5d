"""Runs the tutorials: their files are written, their commands run, and what they show is printed."""

import os
import shlex
import shutil
import subprocess

import pytest

from commands import BLOCK, printed as commands_of
from conftest import BROWSERS, ROOT

TUTORIALS = sorted((ROOT / "docs/tutorials").glob("*.md"))


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_a_tutorial_does_what_it_says(path, wall, tmp_path):
    printed, commands, shown = "", 0, 0
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    environment = os.environ | {"PATH": f"{wall.parent}{os.pathsep}{os.environ['PATH']}"}
    for block in BLOCK.finditer(path.read_text()):
        kind, text = block["kind"], block["text"]
        if block["file"]:
            (tmp_path / block["file"]).write_text(text)
        elif kind == "sh":
            printed = ""
            for line in commands_of(text):
                command, _, file = line.partition(" > ")
                command = shlex.split(command, comments=True)
                if command[0] == "chromium":
                    if browser is None:
                        continue
                    command[:1] = [browser, "--no-sandbox"]
                run = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
                assert run.returncode == 0, f"{line}\n{run.stderr}"
                if file:
                    (tmp_path / file).write_text(run.stdout)
                else:
                    printed += run.stdout + run.stderr
                commands += 1
        elif kind == "text":
            for line in text.splitlines():
                assert line in printed, f"{line!r} is not in\n{printed}"
                shown += 1
        else:
            pytest.fail(f"a block of {kind} that is no file")
    assert commands > 0 and shown + len(list(tmp_path.iterdir())) > 3
    if browser is None and "\nchromium " in path.read_text():
        pytest.skip("no Chromium: the PDF of the tutorial was not made; install chromium")
