"""OpenSeesPy: ElasticMultiLinear and Viscous in parallel on a zero-length element, Newmark's average
acceleration.
"""

import ctypes
import importlib.util
import sys
from pathlib import Path

from measuring import in_short, measure

SUBSTEPS = (1, 2, 4, 16, 64)


def import_opensees():
    """Loads OpenSeesPy's libraries in order, which its extension does not find by itself, then imports it."""
    spec = importlib.util.find_spec("openseespylinux") if sys.platform.startswith("linux") else None
    if spec is not None:
        folder = Path(spec.origin).parent / "lib"
        for name in (
            "libquadmath.so.0",
            "libgfortran.so.5",
            "libblas.so.3",
            "liblapack.so.3",
            "libgomp.so.1",
        ):
            if (folder / name).is_file():
                ctypes.CDLL(str(folder / name), mode=ctypes.RTLD_GLOBAL)
    import openseespy.opensees

    return openseespy.opensees


def run(writer, problem):
    ops = import_opensees()
    if not problem.constant:
        name = "not offered: no damping ratio on the secant frequency"
        writer.writerow([problem.scene, "OpenSeesPy", name, "", "", "", "", ""])
        return
    intervals = len(problem.samples) - 1
    for count in SUBSTEPS:
        step = problem.step / count

        def analyze(steps):
            if ops.analyze(steps, step) != 0:
                raise RuntimeError(f"no convergence at {ops.getTime()} s")

        def history():
            found = [0.0]
            for _ in range(intervals):
                analyze(count)
                found.append(ops.nodeDisp(2, 1))
            return found

        def step_loop():
            """Runs the steps and records nothing."""
            call = ops.analyze
            for _ in range(intervals * count):
                if call(1, step) != 0:
                    raise RuntimeError(f"no convergence at {ops.getTime()} s")

        setting = f"newmark {in_short(step, 3)} s"
        measure(
            writer, problem, "OpenSeesPy", setting, history, lambda: build(ops, problem), step_loop
        )
    ops.wipe()


def build(ops, problem):
    mass = problem.effective_mass
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, mass)
    displacements = [u for u, _ in problem.force_points]
    forces = [f * mass for _, f in problem.force_points]
    ops.uniaxialMaterial("ElasticMultiLinear", 1, "-strain", *displacements, "-stress", *forces)
    ops.uniaxialMaterial("Viscous", 2, problem.elastic_damping * mass, 1.0)
    ops.uniaxialMaterial("Parallel", 3, 1, 2)
    ops.element("zeroLength", 1, 1, 2, "-mat", 3, "-dir", 1)
    ops.timeSeries(
        "Path", 1, "-dt", problem.step, "-values", *problem.samples, "-factor", problem.participation
    )
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    # the cheapest of its solvers and tests here: a step on one branch takes one iteration
    ops.system("ProfileSPD")
    ops.test("NormUnbalance", 1e-10 * max(forces[1:-1]), 100)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
