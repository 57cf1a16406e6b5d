"""A simulation that goes on in another process, from the bytes of a saved state.

    python examples/python/restart.py [FOLDER]             both FMUs in fmu_out, from `cargo xtask fmu`
    python examples/python/restart.py save UNIT STATE      simulates UNIT for 2 s and writes its state
    python examples/python/restart.py resume UNIT STATE    goes on to 5 s, and prints u there

`save` and `resume` may run on different platforms, and with the FMI 2.0 and the FMI 3.0 unit of one version.
"""

import contextlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
UNITS = {"FMI 2.0": "wall.fmu", "FMI 3.0": "fmi3/wall.fmu"}
STEP, BREAK, END = 0.01, 200, 500


# %% An instance for Co-Simulation; a wall with the start values of the FMU rocks freely.
@contextlib.contextmanager
def instance_of(unit):
    folder = fmpy.extract(unit)
    try:
        description = fmpy.read_model_description(folder)
        instance = fmpy.instantiate_fmu(folder, description, "CoSimulation")
        try:
            yield description, instance
        finally:
            instance.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def start(description, instance):
    if description.fmiVersion == "2.0":
        instance.setupExperiment()
    instance.enterInitializationMode()
    instance.exitInitializationMode()


# %% Communication points are multiples of the step, so that a resumed run has those of one without a break.
def run(instance, first, last):
    for index in range(first, last):
        instance.doStep(currentCommunicationPoint=index * STEP, communicationStepSize=STEP)


def displacement(description, instance):
    (reference,) = (v.valueReference for v in description.modelVariables if v.name == "u")
    get = instance.getReal if description.fmiVersion == "2.0" else instance.getFloat64
    return get([reference])[0]


# %% The two halves. The state has the parameters, the inputs and the time as well.
def save(unit, file):
    with instance_of(unit) as (description, instance):
        start(description, instance)
        run(instance, 0, BREAK)
        state = instance.getFMUState()
        Path(file).write_bytes(instance.serializeFMUState(state))
        instance.freeFMUState(state)


def resume(unit, file):
    with instance_of(unit) as (description, instance):
        state = instance.deserializeFMUState(Path(file).read_bytes())
        instance.setFMUState(state)
        instance.freeFMUState(state)
        run(instance, BREAK, END)
        return displacement(description, instance)


def without_break(unit):
    with instance_of(unit) as (description, instance):
        start(description, instance)
        run(instance, 0, END)
        return displacement(description, instance)


# %% Each half in a process of its own; what one version of FMI saved, the other resumes too.
def demonstrate(of):
    units = {version: of / name for version, name in UNITS.items()}
    missing = [str(unit) for unit in units.values() if not unit.is_file()]
    if missing:
        sys.exit(f"missing: {', '.join(missing)}; make them with `cargo xtask fmu`")
    with tempfile.TemporaryDirectory() as folder:
        for saved in units:
            state = Path(folder) / f"{saved}.state"
            half("save", units[saved], state)
            expected = without_break(units[saved])
            for resumed in units:
                found = float(half("resume", units[resumed], state))
                print(f"saved in {saved} ({state.stat().st_size} bytes), resumed in {resumed}: u = {found} m")
                if found != expected:
                    sys.exit(f"differs from the run without a break: {expected} m")


def half(*arguments):
    command = [sys.executable, __file__, *map(str, arguments)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


try:
    import fmpy
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit()

match sys.argv[1:]:
    case []:
        demonstrate(ROOT / "fmu_out")
    case ["save", unit, file]:
        save(unit, file)
    case ["resume", unit, file]:
        print(resume(unit, file))
    case [folder]:
        demonstrate(Path(folder))
    case _:
        sys.exit(__doc__)
