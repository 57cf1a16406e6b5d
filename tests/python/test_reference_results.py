"""Holds the FMUs to the reference results inside them (fmi-ls-ref), which come from the equations alone.

The files say what to run: start values, input, steps and tolerance. FMPy reads them and compares. The format
has no place for the largest error; the description of an experiment states it:

- Co-Simulation is exact. The reference takes about 1000 steps at 1e-13: 1e-10.
- In Model Exchange, CVODE takes about 1e4 steps at 1e-10, and rocking amplifies: 1e-5.
"""

import re
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.ssp.ssd import read_ssv
from fmpy.util import read_csv, validate_result
from lxml import etree

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
KINDS = {"Co-Simulation": "CoSimulation", "Model Exchange": "ModelExchange"}
NAMES = {f"{motion}, {kind}" for motion in ("free rocking", "shaken wall") for kind in KINDS}
LS = "{http://fmi-standard.org/fmi-ls-manifest}"
U_INS = 0.2


@pytest.fixture
def folder(either):
    return Path(either.folder) / FOLDER


def experiments(folder):
    return {one.get("name"): one for one in etree.parse(folder / "wall.exp").iter("Experiment")}


def test_the_manifest_lists_every_file(folder):
    manifest = etree.parse(folder / "fmi-ls-manifest.xml").getroot()
    assert manifest.get(f"{LS}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    sources = [related.get("source") for related in manifest.iter("Related")]
    assert sorted([*sources, "fmi-ls-manifest.xml"]) == sorted(path.name for path in folder.iterdir())
    assert set(experiments(folder)) == NAMES
    for experiment in experiments(folder).values():
        assert {one.get("source") for one in experiment.iterfind("*[@source]")} <= set(sources)


@pytest.mark.parametrize("name", sorted(NAMES))
def test_fmpy_gets_the_reference_result(either, folder, name):
    experiment = experiments(folder)[name]
    setting = experiment.find("TransientSimulation")
    source = {one.tag: folder / one.get("source") for one in experiment.iterfind("*[@source]")}
    starts = {}
    if "Parameters" in source:
        starts = {one.name: one.value for one in read_ssv(str(source["Parameters"])).parameters}
        assert starts
    reference = read_csv(source["References"])
    result = simulate_fmu(
        either.path,
        fmi_type=KINDS[name.split(", ")[1]],
        start_time=float(setting.get("startTime")),
        stop_time=float(setting.get("stopTime")),
        output_interval=float(setting.get("stepSize")),
        relative_tolerance=float(experiment.get("tolerance")),
        start_values=starts,
        input=read_csv(source["Stimuli"]) if "Stimuli" in source else None,
        output=["u", "u_dot"],
    )
    assert validate_result(result, reference) == 0
    # FMPy's band is wide
    within = float(re.search(r"within (\S+) u_ins", experiment.get("description"))[1]) * U_INS
    at = np.searchsorted(result["time"], reference["time"] - 1e-9)
    assert np.abs(result["time"][at] - reference["time"]).max() < 1e-9
    error = np.abs(result["u"][at] - reference["u"]).max()
    assert error <= within, f"error {error / U_INS:.1e} u_ins"
