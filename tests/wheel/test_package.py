"""The package as it is installed: types, documentation, examples, and what it needs."""

import doctest
import importlib
import importlib.metadata
import json
import os
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import pytest

import parameters
import rocking_wall as rw
from rocking_wall import _native

ROOT = Path(__file__).parents[2]
PARTS = (
    "buildings records responses results studies tables walls"
)
MODULES = ["rocking_wall"] + [f"rocking_wall._{part}" for part in PARTS.split()]
CONFIG = ROOT / "tests/wheel/mypy.ini"
EXAMPLES = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "examples/python").glob("*.py")}
# they skip a part where numpy is alone; FMPy is in another environment
LARGER = [name for name, text in EXAMPLES.items() if "skipped" in text and "fmpy" not in text]


def run(*command, **options):
    """Runs a program; its output is in the message of a failure."""
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_parameters_are_those_of_the_model_description():
    assert parameters.stale() == [], "run `cargo xtask generate python`"


def test_the_version_has_commit_and_profile():
    version = importlib.metadata.version("rocking-wall")
    assert re.fullmatch(rf"{re.escape(version)}\+([0-9a-f]{{10}}|unknown)\.[a-z]+", rw.__version__)


def test_help_names_every_parameter_with_its_unit():
    for name in rw.Wall().parameters:
        assert f"- {name}: " in rw.Wall.__doc__
    text = "- gravity: Acceleration of gravity [m/s2], at least 0.001, at most 1000; default 9.81."
    assert text in rw.Wall.__doc__


@pytest.mark.parametrize("module", MODULES)
def test_examples_in_the_documentation(module):
    module = importlib.import_module(module)
    names = {**vars(rw), **vars(module)}
    assert doctest.testmod(module, extraglobs=names).failed == 0


def test_help_names_the_keys_of_a_study():
    told = pydoc.render_doc(rw.options, renderer=pydoc.plaintext)
    parts = re.split(r"\n    (?=\w+: )", told)
    schema = json.loads(_native.schemas()[1])
    for table in ("Intensity", "Levels", "Report", "Class", "Hazard", "Uncertain", "Reliability"):
        for key in schema["$defs"][f"{table}Table"]["properties"]:
            keys = next(part for part in parts if part.startswith(f"{table}: "))
            assert f"- {key}: " in keys, (table, key)


def test_every_public_name_is_documented():
    for name in rw.__all__:
        assert getattr(rw, name).__doc__, name


def test_types(tmp_path):
    (tmp_path / "used.py").write_text(
        "import rocking_wall as rw\n"
        "u: float = rw.Wall(height=3, damping_model='none').simulate(rw.synthetic_record()).u_max\n"
        "rw.Wall(hight=3)  # type: ignore[call-arg]\n"
        "rw.Wall(impact='hard')  # type: ignore[arg-type]\n"
        "levels: rw.options.Levels = {'method': 'grid', 'values': [1.0]}\n"
        "rw.Study(walls=rw.Wall(), records=rw.synthetic_record(), models=['CR'], levels=levels)\n"
        "levels = {'method': 'grid', 'valeus': [1.0]}  # type: ignore[typeddict-unknown-key]\n",
        encoding="utf-8",
    )
    mypy = [sys.executable, "-m", "mypy", "--config-file", CONFIG]
    # what it knows of numpy's types is kept in the environment
    mypy += ["--cache-dir", Path(sys.prefix) / "mypy"]
    run(*mypy, "-p", "rocking_wall", "-m", "used", cwd=tmp_path)


def test_examples(tmp_path):
    # one process imports the large packages once
    paths = [str(ROOT / "examples/python" / name) for name in LARGER]
    code = f"import runpy; [runpy.run_path(path, run_name='__main__') for path in {paths}]"
    assert len(paths) > 3 and "skipped" not in run(sys.executable, "-c", code, cwd=tmp_path)


def other_python(variable):
    """Returns the path of a Python that has the wheel too."""
    if variable not in os.environ:
        pytest.skip(f"{variable} is not set; `cargo xtask test` sets it")
    return os.environ[variable]


def test_an_fmu_of_a_scene_in_fmpy(tmp_path):
    python = other_python("ROCKING_WALL_FMPY_PYTHON")
    told = run(python, ROOT / "examples/python/fmu.py", cwd=tmp_path).split()
    there, here = (float(told[told.index("m") - 1]), float(told[-3]))
    assert there == pytest.approx(here, rel=1e-9)


def test_the_wheel_needs_numpy_alone():
    python = other_python("ROCKING_WALL_BARE_PYTHON")
    code = "import importlib.metadata as m; print(*(found.name for found in m.distributions()))"
    assert set(run(python, "-c", code).lower().split()) == {"numpy", "rocking-wall"}


# Runs each example in a folder of its own.
EACH = """
import json, os, pathlib, runpy, sys, tempfile, traceback
out, *paths = sys.argv[1:]
failed = {}
for path in paths:
    sys.argv = [path]
    os.chdir(tempfile.mkdtemp(dir=pathlib.Path(out).parent))
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as end:
        failed |= {path: str(end.code)} if end.code else {}
    except Exception:
        failed[path] = traceback.format_exc()
pathlib.Path(out).write_text(json.dumps(failed))
"""


@pytest.fixture(scope="module")
def failures(tmp_path_factory):
    """The examples that fail where numpy is alone, with their errors, by path; one process imports numpy."""
    out = tmp_path_factory.mktemp("examples") / "failures.json"
    python = other_python("ROCKING_WALL_BARE_PYTHON")
    run(python, "-c", EACH, out, *(ROOT / "examples/python" / name for name in EXAMPLES))
    return json.loads(out.read_text())


@pytest.mark.parametrize("example", EXAMPLES)
def test_examples_with_numpy_alone(example, failures):
    error = failures.get(str(ROOT / "examples/python" / example))
    assert error is None, error


def test_pictures(record):
    wall = rw.Wall(height=3, thickness=0.25)
    for shown in (record._repr_svg_(), wall.simulate(record)._repr_svg_()):
        assert shown.startswith("<svg") or "<svg" in shown[:200]
    html = wall.describe()._repr_html_()
    assert "u_ins" in html and "the wall to scale" in html and html.count("<svg") == 2


def test_tables_and_plots(record):
    pytest.importorskip("pandas")
    pytest.importorskip("matplotlib").use("agg")
    # a wall that stands: the peak of one that falls ends at u_ins
    response = rw.Wall(height=3, thickness=0.25).simulate(record, scale=0.5)
    frame = response.to_pandas()
    assert frame.index.name == "time" and frame["u"].abs().max() <= response.u_max
    assert response.plot().get_ylabel() == "u / u_ins"
    assert record.plot().get_xlabel() == "time (s)"
    peaks = rw.Wall(height=3, thickness=0.25).peaks(record, [0.5, 9.0])
    assert peaks.to_pandas()["overturned"].tolist() == [False, True]
