"""The linear floor made with another exporter (pythonfmu), from its equation alone.

Each step is a matrix exponential.
"""

import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real
from scipy.linalg import expm


class PartnerFloor(Fmi2Slave):
    description = "M x'' + c x' + k x = -M a_g - reaction_1 - impulse_1/step, inputs held"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.mass, self.stiffness, self.damping_ratio = 2.0e4, 2.0e7, 0.05
        self.displacement_start = self.velocity_start = 0.0
        self.a_g = self.reaction_1 = self.impulse_1 = 0.0
        self.displacement = self.velocity = self.acceleration = self.acceleration_absolute = 0.0
        self.last_step = 0.0
        self.propagators = {}
        for name in ("mass", "stiffness", "damping_ratio", "displacement_start", "velocity_start"):
            self.register_variable(
                Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed)
            )
        for name in ("a_g", "reaction_1", "impulse_1"):
            self.register_variable(Real(name, causality=Fmi2Causality.input))
        for name in ("displacement", "velocity"):
            self.register_variable(Real(name, causality=Fmi2Causality.output))
        for name in ("acceleration", "acceleration_absolute"):
            absolute = name == "acceleration_absolute"
            getter = lambda absolute=absolute: self.present(absolute)
            self.register_variable(Real(name, causality=Fmi2Causality.output, getter=getter))

    def exit_initialization_mode(self):
        self.displacement, self.velocity = self.displacement_start, self.velocity_start

    def damping(self):
        return 2 * self.damping_ratio * np.sqrt(self.stiffness * self.mass)

    def push(self, step):
        mean = self.impulse_1 / step if step > 0 else 0.0
        return -(self.reaction_1 + mean) / self.mass

    def present(self, absolute):
        force = self.stiffness * self.displacement + self.damping() * self.velocity
        return float(self.push(self.last_step) - force / self.mass - (0.0 if absolute else self.a_g))

    def do_step(self, current_time, step_size):
        if step_size not in self.propagators:
            # the state is x, v and a constant
            matrix = np.zeros((3, 3))
            matrix[0, 1] = matrix[1, 2] = 1.0
            matrix[1, :2] = -self.stiffness / self.mass, -self.damping() / self.mass
            self.propagators[step_size] = expm(matrix * step_size)
        load = self.push(step_size) - self.a_g
        x, v, _ = self.propagators[step_size] @ (self.displacement, self.velocity, load)
        self.displacement, self.velocity, self.last_step = float(x), float(v), step_size
        return True
