"""Runs the commands that README, the documents and the pages of crates print, as they are printed.

Each block runs in a folder of its own, with the files that it is about. Commands that install, build or
publish are listed with the reason why they are not run; any other command is run. Tutorials, which write
their own files and show what is printed, are run by `test_tutorials.py`.
"""

import gzip
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from commands import BLOCK, printed
from conftest import ROOT, of_fmi3

DOCUMENTS = ["README.md", "CONTRIBUTING.md", "docs/*.md", "crates/*/README.md", "examples/**/README.md"]
RUN = ("wall", "fmpy", "python", "zcat")
# The beginning of a command, and why it is not run here.
NOT_RUN = {
    "cargo xtask": "builds; `.ci/run` runs demo, test, portable and fuzz, a release the others",
    "cargo install": "builds and installs; `cargo xtask test` builds the same programs",
    "cargo new": "makes a crate; xtask/tests/it/documents.rs compares its files with examples/fmu",
    "cargo add": "needs the crates of a registry; examples/fmu names them in its Cargo.toml",
    "cargo build": "builds; `cargo xtask test` builds examples/fmu, and test_example.py runs it",
    "fmu-pack": "`cargo xtask test` packs the library of examples/fmu, in both versions",
    "printf": "writes a line of the Cargo.toml of examples/fmu",
    "mkdir": "makes the documentation folder of examples/fmu",
    "pip install": "installs; `cargo xtask test` installs the wheel and the packages of the lock files",
    "rustup": "installs; `.ci/run` adds the targets",
    "git clone": "needs a published repository",
    "cd": "the folder of a published release",
    "gh": "needs a published release",
}
# Each takes minutes with programs that are not optimised; where else they are run.
SLOW = {
    "python examples/coupling/run.py building": "test_coupling.py checks the schemes that it compares",
    "wall verify paper": "test_reproduce_page.py",
    "python examples/python/passing_walls.py": "an hour; test_reliability.py makes a part",
}
# What has to be done before, where a document says so in words: every job of an array.
BEFORE = {"wall study merge shards": "wall study ida study.toml -o shards"}
# Files that a document names and a reader has.
CHECK = """
[check]
code = "circolare-2019"
before_activation = "law"
soil = "B"
SLV = { ag = 0.15, F0 = 2.45, TC = 0.32 }
"""
STUDY = f"""
models = ["CR"]
levels = {{ method = "hunt", first = 0.1, increase = 0.1, top = 3 }}
intensity = {{ measure = "code" }}
records = {{ synthetic = {{ count = 6 }} }}
{CHECK}
[reliability]
probability = 0.10
[[walls]]
name = "low"
geometry = {{ height = 1.0, thickness = 0.3, density = 1800 }}
force_law = {{ a1 = 0.05 }}
"""
# A browser that fetches the page it is given, so that the plot is served and the program ends.
BROWSER = "import sys, urllib.request as r; open('plot.html', 'wb').write(r.urlopen(sys.argv[1]).read())"


def blocks():
    """The blocks of commands of all documents, each with its place."""
    for path in sorted(path for pattern in DOCUMENTS for path in ROOT.glob(pattern)):
        text = path.read_text()
        for block in BLOCK.finditer(text):
            if block["kind"] == "sh":
                place = f"{path.relative_to(ROOT)}:{text[: block.start('text')].count(chr(10)) + 1}"
                yield pytest.param(block["text"], id=place)


def words(command):
    """The words of a command without what is set before it: the program comes first."""
    return re.sub(r"^(\w+=\S+ +)+", "", command).split("#")[0].split()


def reason_not_to_run(command):
    """Why a command is not run; none for one that is."""
    text = " ".join(words(command))
    return next((why for start, why in (NOT_RUN | SLOW).items() if f"{text} ".startswith(f"{start} ")), None)


def at2(peak, frequency):
    """A record of 6 s as PEER writes it, a swelling and fading sine of `peak` [g]."""
    t = 0.01 * np.arange(600)
    samples = peak * np.sin(np.pi * t / 6.0) ** 2 * np.sin(2 * np.pi * frequency * t)
    lines = (" ".join(f"{a:15.7E}" for a in samples[at : at + 5]) for at in range(0, 600, 5))
    head = "PEER NGA STRONG MOTION DATABASE RECORD\nA sine\nACCELERATION TIME SERIES IN UNITS OF G\n"
    return f"{head}NPTS=    600, DT=   .0100 SEC\n" + "\n".join(lines) + "\n"


def example_files(path):
    """The files that a document shows, by the name that stands before them."""
    text = path.read_text()
    marked = {block["file"]: block["text"] for block in BLOCK.finditer(text) if block["file"]}
    named = re.finditer(r"`(?P<file>[\w.]+\.(?:toml|csv))`[^`]*```\w+\n(?P<text>.*?)```", text, re.S)
    return {match["file"]: match["text"] for match in named} | marked


@pytest.fixture
def work(tmp_path, fmu, floor_fmu, wall):
    """A folder as a reader has it, with a quick study of Table 5: the repository, its FMUs, and own files."""
    for name in ("scenes", "examples", "tests"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "studies").mkdir()
    for study in (ROOT / "studies").iterdir():
        (tmp_path / "studies" / study.name).symlink_to(study)
    # with a tenth of its records; crates/wall-cli/tests/it/ida.rs runs a part of the whole one
    table_5 = (ROOT / "studies/table_5.toml").read_text()
    assert "count = 20," in table_5
    (tmp_path / "studies/table_5.toml").unlink()
    (tmp_path / "studies/table_5.toml").write_text(table_5.replace("count = 20,", "count = 2,"))
    (tmp_path / "fmu_out/fmi3").mkdir(parents=True)
    for path in (fmu, floor_fmu):
        (tmp_path / "fmu_out" / path.name).symlink_to(path)
        (tmp_path / "fmu_out/fmi3" / path.name).symlink_to(of_fmi3(path))
    (tmp_path / "RECORD.AT2").write_text(at2(0.3, 1.0))
    (tmp_path / "RECORD.AT2.gz").write_bytes(gzip.compress(at2(0.3, 1.0).encode()))
    (tmp_path / "records").mkdir()
    for frequency in (0.8, 1.2, 1.7):
        (tmp_path / f"records/{frequency}.AT2").write_text(at2(0.3, frequency))
    tied = (ROOT / "scenes/tied_facade.toml").read_text()
    (tmp_path / "facade.toml").write_text(tied + CHECK.replace("law", "rigid") + "overburden_mass = 1\n")
    for document in ("tutorials/check.md", "validation.md"):
        for name, text in example_files(ROOT / "docs" / document).items():
            (tmp_path / name).write_text(text)
    (tmp_path / "study.toml").write_text(STUDY)
    if ball := os.environ.get("ROCKING_WALL_BALL"):
        (tmp_path / "ball.fmu").symlink_to(ball)
    (tmp_path / "browser.py").write_text(BROWSER)
    return tmp_path


def run(command, work, wall):
    path = os.pathsep.join([str(wall.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = os.environ | {"PATH": path, "BROWSER": f"{sys.executable} {work / 'browser.py'} %s &"}
    done = subprocess.run(
        ["sh", "-c", command], cwd=work, env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"


# Commands that another document prints too: they need not run again.
DONE = set()


@pytest.mark.parametrize("text", list(blocks()))
def test_printed_commands_run(text, work, wall):
    for command in filter(words, printed(text)):
        if reason_not_to_run(command) or tuple(words(command)) in DONE:
            continue
        program = words(command)[0]
        assert program in RUN, f"{command}: run {program} here, or say in NOT_RUN why it is not run"
        if "ball.fmu" in command and not (work / "ball.fmu").exists():
            pytest.skip("ROCKING_WALL_BALL is not set; `cargo xtask test` sets it")
        if before := BEFORE.get(" ".join(words(command))):
            run(before, work, wall)
        run(command, work, wall)
        if "--show-plot" in command:
            page = work / "plot.html"
            assert "plotly" in page.read_text(), command
            page.unlink()
        DONE.add(tuple(words(command)))


def test_reasons_are_needed():
    """Every reason is one of a command that a document prints, and most commands are run."""
    commands = [command for block in blocks() for command in printed(block.values[0]) if words(command)]
    for start in NOT_RUN | SLOW:
        assert any(" ".join(words(command)).startswith(start) for command in commands), start
    ran = [command for command in commands if not reason_not_to_run(command)]
    assert len(ran) > 40 and len(SLOW) <= 5
