"""Builds examples/coupling/master.c and runs it on many walls.

python compiled.py WALL.fmu FLOOR.fmu WALLS SECONDS STEP
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from fmpy import extract, read_model_description

ROOT = Path(__file__).parents[2]
OF_A_WALL = ["a_bottom", "u_start", "thickness", "u", "reaction_bottom"]
OF_A_FLOOR = [
    "a_g",
    "reaction_1",
    "reaction_2",
    "mass",
    "stiffness",
    "acceleration_absolute",
    "reaction_bottom",
]


def run(wall, floor, walls, seconds, step):
    """Returns what the master prints: run time, memory, and two displacements to compare."""
    folders = []
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "master"
        source = ROOT / "examples/coupling/master.c"
        subprocess.run(["cc", "-O2", "-Wall", "-Wextra", "-o", program, source, "-ldl", "-lm"], check=True)
        command = [program]
        for path, names in ((wall, OF_A_WALL), (floor, OF_A_FLOOR)):
            folders.append(extract(str(path)))
            description = read_model_description(folders[-1])
            references = {variable.name: variable.valueReference for variable in description.modelVariables}
            identifier = description.coSimulation.modelIdentifier
            command += [f"{folders[-1]}/binaries/linux64/{identifier}.so", description.guid]
            command += [references[name] for name in names]
        command += [walls, seconds, step]
        output = subprocess.run(
            [str(word) for word in command], check=True, capture_output=True, text=True
        ).stdout
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)
    return json.loads(output)


if __name__ == "__main__":
    paths, numbers = sys.argv[1:3], sys.argv[3:]
    print(json.dumps(run(*paths, int(numbers[0]), *map(float, numbers[1:])), indent=1))
