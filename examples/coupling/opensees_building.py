"""Rocking walls on a building of OpenSees: a frame of three storeys, nonlinear and with damping of its own,
shakes a strip wall and two parapets of wall.fmu, and feels their reactions.

    pip install openseespy fmpy matplotlib     # OpenSees needs BLAS and LAPACK of the system
    wall record --synthetic --pga 2.2 --samples motion.csv
    python examples/coupling/opensees_building.py motion.csv figure.svg

With `linear` for the figure the storeys stay linear, as in scenes/building/three_storeys.toml. Replace
`frame()` by your model: the walls need accelerations and displacements of its floors, and a load on each.
"""

import sys
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from master import Archive, Unit

FMU = Path(__file__).parents[2] / "fmu_out/wall.fmu"
# with linear storeys, peak accelerations of the floors are within 1e-3 of those of `wall building`.
STEP = 5e-4
TAIL = 5.0

FLOORS = [1, 2, 3]  # nodes; the ground is node 0
MASS = [1.2e5, 1.2e5, 0.8e5]  # kg
STIFFNESS = [1.5e8, 1.2e8, 0.9e8]  # N/m
YIELD_DRIFT = 0.006  # m
DAMPING_RATIO = 0.04

LAW = {"a1": 0.05, "damping_model": "constant_coefficient", "xi": 0.05, "u_start": 0.0}
# name: parameters, floor below, floor above (of a strip wall)
WALLS = {
    "strip": ({"mechanism": "vertical_spanning", "height": 3.0, "thickness": 0.2, "hinge_ratio": 0.6,
               "overburden": 5000.0}, 2, 3),
    "parapet": ({"height": 1.2, "thickness": 0.3}, 3, None),
    "gable": ({"height": 1.8, "thickness": 0.23}, 3, None),
}  # fmt: skip


def frame(times, ground, yields):
    """Makes the building: floors with one degree of freedom each, storeys as springs and dampers."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(0, 0.0)
    ops.fix(0, 1)
    for node, mass, stiffness in zip(FLOORS, MASS, STIFFNESS):
        ops.node(node, 0.0)
        ops.mass(node, mass)
        spring, damper = 10 * node, 10 * node + 1  # materials and elements
        if yields:
            strength, curve = stiffness * YIELD_DRIFT, (18.0, 0.925, 0.15)
            ops.uniaxialMaterial("Steel02", spring, strength, stiffness, 0.03, *curve)
        else:
            ops.uniaxialMaterial("Elastic", spring, stiffness)
        ops.uniaxialMaterial("Viscous", damper, 2.0 * DAMPING_RATIO * np.sqrt(stiffness * mass), 1.0)
        for tag in (spring, damper):
            ops.element("zeroLength", tag, node - 1, node, "-mat", tag, "-dir", 1)
    ops.timeSeries("Path", 1, "-time", *times, "-values", *ground)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.timeSeries("Constant", 2)
    for choose, kind in ((ops.constraints, "Plain"), (ops.numberer, "Plain"), (ops.system, "BandGeneral")):
        choose(kind)
    ops.test("NormDispIncr", 1e-12, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


class Wall:
    """A wall between its floors. Inputs are linear over a step, from the motion at its start to its end."""

    def __init__(self, archive, name, parameters, bottom, top):
        self.unit = Unit(archive, name, **LAW, **parameters)
        self.bottom, self.top = bottom, top
        names = ["a_bottom"] + (["a_top", "drift"] if top else [])
        self.inputs, self.felt = [self.unit.reference(name) for name in names], np.zeros(len(names))
        self.unit.slave.exitInitializationMode()

    def step(self, time, accelerations, displacements):
        felt = accelerations[self.bottom : self.bottom + 1]
        if self.top:
            drift = displacements[self.top] - displacements[self.bottom]
            felt = np.array([felt[0], accelerations[self.top], drift])
        slave = self.unit.slave
        slave.setReal(self.inputs, self.felt)
        slave.setRealInputDerivatives(self.inputs, [1] * len(felt), (felt - self.felt) / STEP)
        slave.doStep(time, STEP)
        # reactions go with the accelerations at the end of the step
        slave.setReal(self.inputs, felt)
        self.felt = felt

    def loads(self):
        """Returns the forces on the floors: minus those of the floors on the wall [N]."""
        loads = {self.bottom: -self.unit.get("reaction_bottom")}
        if self.top:
            loads[self.top] = -self.unit.get("reaction_top")
        return loads


def run(archive, times, ground, yields):
    """Returns the times and, for each floor, absolute accelerations [m/s²]; for each wall u/u_ins."""
    frame(times, ground, yields)
    walls = {name: Wall(archive, name, *of) for name, of in WALLS.items()}
    loads = previous = np.zeros(4)
    history, shares, steps = [], [], round((times[-1] + TAIL) / STEP)
    for index in range(steps):
        # reactions at the end of the step, extrapolated: the walls follow the frame
        ops.remove("loadPattern", 2)
        ops.pattern("Plain", 2, 2)
        for node in FLOORS:
            ops.load(node, 2.0 * loads[node] - previous[node])
        if ops.analyze(1, STEP) != 0:
            raise RuntimeError(f"OpenSees did not converge at t = {index * STEP} s")
        time = (index + 1) * STEP
        moved = np.interp(time, times, ground, right=0.0)
        accelerations = np.array([moved] + [moved + ops.nodeAccel(node, 1) for node in FLOORS])
        displacements = [ops.nodeDisp(node, 1) for node in [0, *FLOORS]]
        previous, loads = loads, np.zeros(4)
        for wall in walls.values():
            wall.step(index * STEP, accelerations, displacements)
            for node, force in wall.loads().items():
                loads[node] += force
        history.append(accelerations)
        shares.append([wall.unit.get("u_ratio") for wall in walls.values()])
    return STEP * np.arange(1, steps + 1), np.array(history), np.array(shares)


def main(motion, figure):
    times, ground = np.loadtxt(motion, delimiter=",", skiprows=1).T
    with Archive(FMU) as archive:
        time, floors, walls = run(archive, times, ground, yields=figure != "linear")
    for node in FLOORS:
        print(f"floor {node}: peak acceleration {np.abs(floors[:, node]).max():.5f} m/s2")
    for name, share in zip(WALLS, walls.T):
        print(f"{name}: largest u/u_ins {np.abs(share).max():.4f}")
    if figure == "linear":
        return
    import matplotlib.pyplot as plt

    picture, (above, below) = plt.subplots(2, sharex=True, figsize=(9, 5), layout="constrained")
    above.plot(time, floors[:, 3], "k", lw=0.6, label="roof")
    above.set_ylabel("acceleration [m/s²]")
    below.plot(time, walls, lw=0.9, label=list(WALLS))
    below.set(xlabel="t [s]", ylabel="u/u_ins")
    picture.legend(loc="outside upper center", ncols=4)
    picture.savefig(figure)


if __name__ == "__main__":
    main(*sys.argv[1:3])
