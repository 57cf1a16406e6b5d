"""An FMU of a scene, run in FMPy where it is installed.

    python examples/python/fmu.py
"""

import tempfile
from pathlib import Path

import rocking_wall as rw

SCENE = Path(__file__).parents[2] / "scenes" / "shaken_parapet.toml"

with tempfile.TemporaryDirectory() as folder:
    # %% The FMU has the motion of the scene inside, and only the variables that the scene uses.
    unit = Path(folder) / "parapet.fmu"
    print("variables:", rw.package(SCENE, unit))

    # %% In FMPy it gives the response of the scene.
    response = rw.Wall.from_toml(SCENE).simulate()
    try:
        from fmpy import simulate_fmu
    except ImportError as error:
        print(f"skipped: {error}")
    else:
        result = simulate_fmu(str(unit))
        print(f"{result['u_max'][-1]:.9f} m in FMPy, {response.u_max:.9f} m here")
