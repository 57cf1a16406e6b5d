"""Four masters that move the same system with the same scheme: Jacobi, inputs held, one step for all.

Each takes a `Building` and returns the watched variables, one row for each step. Packages are imported where
they are used, so that a missing one fails only its own test. Masters with libraries of their own run in a
process of their own, because these conflict (libcosim's logging crashes the container):

    python masters.py MASTER SSP STEP STEPS OUTPUT.npy WATCHED...
"""

import contextlib
import ctypes
import json
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd

sys.path.insert(0, str(Path(__file__).parents[2] / "examples/coupling"))
from master import Archive, System, Unit  # noqa: E402


class Building:
    """An SSP, unpacked into a folder: FMUs and connections by component."""

    def __init__(self, path, folder):
        self.path, self.folder = path, Path(folder)
        description = read_ssd(str(path))
        self.elements = description.system.elements
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        self.fmus = {element.name: Path(folder) / element.source for element in self.elements}
        self.connections = [
            (c.startElement, c.startConnector, c.endElement, c.endConnector)
            for c in description.system.connections
        ]


def own(building, step, steps, watched, loop=False):
    """Runs the master of examples/coupling, on FMPy's instances; `loop` closes the loop before each step."""
    archives = {path: Archive(path) for path in set(building.fmus.values())}
    with contextlib.ExitStack() as stack:
        for archive in archives.values():
            stack.enter_context(archive)
        units = [Unit(archives[path], name) for name, path in building.fmus.items()]
        ends = [(f"{a}.{b}", f"{c}.{d}") for a, b, c, d in building.connections]
        system = System(units, ends)
        system.initialize(loop=loop)
        history = []
        for _ in range(steps):
            system.jacobi(step, loop=loop)
            history.append([system.get(name) for name in watched])
    return np.array(history)


def fmpy(building, step, steps, watched):
    """Runs FMPy's `simulate_ssp`."""
    # half a step before the end: it adds up the time and stops at or beyond the end
    result = simulate_ssp(str(building.path), stop_time=(steps - 0.5) * step, step_size=step)
    return np.array([result[name] for name in watched]).T


def ecos(building, step, steps, watched):
    """Runs Ecos. It needs libtbb from the system or the package `tbb`."""
    load_tbb()
    from ecospy import EcosSimulation

    with EcosSimulation(ssp_path=str(building.path), step_size=step) as simulation:
        assert simulation.init()
        history = []
        for _ in range(steps):
            simulation.step()
            history.append([simulation.get_real(name.replace(".", "::")) for name in watched])
        simulation.terminate()
    return np.array(history)


def load_tbb():
    for folder in (Path(sys.prefix) / "lib", Path(sys.prefix) / "Library/bin"):
        for library in (*folder.glob("libtbb.so.12"), *folder.glob("tbb12.dll")):
            ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)


def libcosim(building, step, steps, watched):
    """Runs libcosim, with the step that the SSP states."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_ssp_file(ssp_path=str(building.path))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer=observer)
    places = []
    for name in watched:
        component, variable = name.split(".")
        variables = {
            v.name: v.valueReference
            for v in read_model_description(str(building.fmus[component])).modelVariables
        }
        places.append((execution.slave_index_from_instance_name(component), [variables[variable]]))
    history = []
    for _ in range(steps):
        assert execution.step()
        history.append([observer.last_real_values(slave, reference)[0] for slave, reference in places])
    nanoseconds = execution.status().current_time
    assert nanoseconds == round(steps * step * 1e9), "the step is the SSP's"
    return np.array(history)


def container(building, step, steps, watched):
    """Puts all units into one FMU with fmu-manipulation-toolbox, and simulates it in FMPy."""
    from fmu_manipulation_toolbox.assembly import Assembly

    folder = building.folder / "container"
    folder.mkdir()
    files = {}
    for name, path in building.fmus.items():
        files[name] = f"{name}.fmu"
        (folder / files[name]).write_bytes(path.read_bytes())
    description = {
        "name": "building.fmu", "step_size": step, "mt": False,
        "auto_link": False, "auto_input": False, "auto_output": False,
        "fmu": list(files.values()),
        "link": [[files[a], b, files[c], d] for a, b, c, d in building.connections],
        "output": [
            [files[name.split(".")[0]], name.split(".")[1], name.replace(".", "_")] for name in watched
        ],
    }  # fmt: skip
    (folder / "building.json").write_text(json.dumps(description))
    Assembly("building.json", fmu_directory=folder).make_fmu()
    result = simulate_fmu(
        str(folder / "building.fmu"),
        step_size=step,
        output_interval=step,
        stop_time=steps * step,
        fmi_type="CoSimulation",
    )
    return np.array([result[name.replace(".", "_")] for name in watched]).T[1:]


MASTERS = {"own": own, "FMPy": fmpy, "Ecos": ecos, "libcosim": libcosim, "container": container}


def main():
    master, path, step, steps, output, *watched = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        history = MASTERS[master](Building(path, folder), float(step), int(steps), watched)
    np.save(output, history)


if __name__ == "__main__":
    main()
