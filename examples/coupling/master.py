"""A small co-simulation master on FMPy: units, connections between them, and schemes that advance them
together.

    jacobi          every unit steps with the outputs of the others at the start of the step
    gauss_seidel    the units step one after the other, each with the newest outputs of the others
    iterated        repeats Gauss-Seidel over the same step, from saved states, until inputs and outputs agree

An input is `held` over a step or `linear`. A linear input is interpolated if its value at the end of the step
is known, and otherwise extrapolated by the derivative of the output.

Accelerations and reactions depend on each other without delay. An explicit master that passes them on as they
are amplifies errors by a gain (docs/coupling.md). `loop=True` closes the loop: it makes inputs and outputs
agree at the start of the step, by Newton's method on the directional derivatives of the units.
"""

import shutil
from ctypes import byref

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.logging import addLoggerProxy

# Largest mismatch of an interface variable, over its nominal value, at which inputs and outputs agree.
CLOSED = 1e-8
MOST_SWEEPS = 60


# FMPy passes the messages of all units in the process to one logger, the last it was given. This one lives to
# the end, and finds the receiver by the environment of the unit: its place in the list, counted from 1.
_logs = []


@fmi2CallbackLoggerTYPE
def _logger(environment, name, _status, category, message):
    log = _logs[environment - 1] if environment else None
    if log is not None:
        log(name.decode(), category.decode(), message.decode())


class Archive:
    """An unpacked FMU, from which any number of units can be made."""

    def __init__(self, path):
        self.folder = extract(str(path))
        self.description = read_model_description(self.folder)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder, ignore_errors=True)


class Unit:
    """An FMU instance whose variables have names. Parameters are set before initialisation.

    `log(name, category, message)` receives events, such as the overturning of a wall.
    """

    def __init__(self, archive, name, log=None, **parameters):
        description = archive.description
        self.name = name
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self._items = {
            kind.name: {item.name: int(item.value) for item in kind.items or ()}
            for kind in description.typeDefinitions
        }
        identifier = description.coSimulation.modelIdentifier
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=archive.folder,
            modelIdentifier=identifier,
            instanceName=name,
        )
        self.slave.instantiate(callbacks=self._callbacks(log), loggingOn=log is not None)
        self.slave.setupExperiment(startTime=0.0)
        for key, value in parameters.items():
            self.set(key, value)
        self.slave.enterInitializationMode()

    def _callbacks(self, log):
        _logs.append(log)
        # the unit calls these throughout its life, so they must not be freed
        self._functions = fmi2CallbackFunctions()
        self._functions.logger = _logger
        self._functions.componentEnvironment = len(_logs)
        addLoggerProxy(byref(self._functions))
        return self._functions

    def reference(self, name):
        return self.variables[name].valueReference

    def set(self, name, value):
        variable = self.variables[name]
        if isinstance(value, str):
            value = self._items[variable.declaredType.name][value]
        setter = {"Real": self.slave.setReal, "Boolean": self.slave.setBoolean}.get(
            variable.type, self.slave.setInteger
        )
        setter([variable.valueReference], [value])

    def get(self, name):
        variable = self.variables[name]
        getter = {"Real": self.slave.getReal, "Boolean": self.slave.getBoolean}.get(
            variable.type, self.slave.getInteger
        )
        return getter([variable.valueReference])[0]

    def nominal(self, name):
        return float(self.variables[name].nominal or 1.0)


class Ports:
    """Connections of one unit: indices of the interface that it gives and takes, and value references."""

    def __init__(self, unit, gives, takes):
        self.unit = unit
        self.gives, self.takes = gives, takes
        self.outputs = [unit.reference(name) for name in gives.values()]
        self.inputs = [unit.reference(name) for name in takes.values()]
        self.given, self.taken = list(gives), list(takes)


class System:
    """Units and their connections, such as ("floor.acceleration_absolute", "wall.a_bottom").

    Gauss-Seidel steps the units in the given order. `sources` are motions from outside: {"floor.a_g":
    function of time}. The interface is a vector with one number for each connection; `values` has the present
    inputs.
    """

    def __init__(self, units, connections, sources=None):
        self.units = {unit.name: unit for unit in units}
        self.connections = list(connections)
        self.sources = {tuple(name.split(".", 1)): motion for name, motion in (sources or {}).items()}
        ends = [[end.split(".", 1) for end in connection] for connection in self.connections]
        self.ports = [
            Ports(
                unit,
                {index: name for index, ((owner, name), _) in enumerate(ends) if owner == unit.name},
                {index: name for index, (_, (owner, name)) in enumerate(ends) if owner == unit.name},
            )
            for unit in units
        ]
        self.scale = np.array([self.units[owner].nominal(name) for (owner, name), _ in ends])
        # whether the source of a connection steps before its target
        order = list(self.units)
        self.forward = np.array(
            [order.index(source) < order.index(target) for (source, _), (target, _) in ends]
        )
        self.time = 0.0
        self.values = np.zeros(len(ends))
        # statistics of the last step
        self.sweeps, self.mismatch = 0, 0.0

    def initialize(self, loop=True):
        """Leaves initialisation with inputs that agree with the outputs, or are 0 if `loop` is off."""
        self._drive(0.0, 0.0)
        if loop:
            self.close_loop()
        for ports in self.ports:
            ports.unit.slave.exitInitializationMode()

    def get(self, name):
        owner, variable = name.split(".", 1)
        return self.units[owner].get(variable)

    # --- the interface

    def outputs(self):
        """Returns the present outputs of the units."""
        found = np.empty(len(self.connections))
        for ports in self.ports:
            if ports.given:
                found[ports.given] = ports.unit.slave.getReal(ports.outputs)
        return found

    def output_rates(self):
        found = np.empty(len(self.connections))
        for ports in self.ports:
            if ports.given:
                found[ports.given] = ports.unit.slave.getRealOutputDerivatives(
                    ports.outputs, [1] * len(ports.given)
                )
        return found

    def feedthrough(self):
        """Returns the derivatives of outputs (rows) by inputs (columns) within the units, without delay."""
        matrix = np.zeros((len(self.connections),) * 2)
        for ports in self.ports:
            if ports.given:
                for column, reference in zip(ports.taken, ports.inputs):
                    matrix[ports.given, column] = ports.unit.slave.getDirectionalDerivative(
                        ports.outputs, [reference], [1.0]
                    )
        return matrix

    def close_loop(self):
        """Sets inputs that agree with the present outputs.

        The outputs are linear in the inputs, so one step of Newton's method suffices. A wall that comes to
        rest or leaves it needs a few.
        """
        self._set(self.outputs())
        for _ in range(MOST_SWEEPS):
            found = self.outputs()
            mismatch = found - self.values
            if np.all(np.abs(mismatch) <= 1e-12 * (self.scale + np.abs(found))):
                return
            rest = np.eye(len(found)) - self.feedthrough()
            self._set(self.values + np.linalg.solve(rest, mismatch))
        raise RuntimeError(f"t = {self.time} s: the loop of accelerations and reactions does not close")

    def closed_rates(self):
        """Returns output derivatives that agree with the input derivatives.

        Call it just after `close_loop`, when the units take the input derivatives to be 0.
        """
        return np.linalg.solve(np.eye(len(self.values)) - self.feedthrough(), self.output_rates())

    def _set(self, values):
        self.values = values
        for ports in self.ports:
            self._feed(ports, values, None)

    @staticmethod
    def _feed(ports, values, rates):
        if not ports.taken:
            return
        ports.unit.slave.setReal(ports.inputs, values[ports.taken])
        if rates is not None:
            ports.unit.slave.setRealInputDerivatives(ports.inputs, [1] * len(ports.taken), rates[ports.taken])

    def _drive(self, step, linear):
        """Sets the motions from outside. They are known ahead, so a linear one ends at the next sample."""
        for (owner, name), motion in self.sources.items():
            unit, now = self.units[owner], motion(self.time)
            unit.set(name, now)
            if linear:
                rate = (motion(self.time + step) - now) / step
                unit.slave.setRealInputDerivatives([unit.reference(name)], [1], [rate])

    def _advance(self, ports, step):
        ports.unit.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=step)

    # --- the schemes

    def jacobi(self, step, linear=False, loop=False):
        """Steps all units with the values at the start of the step."""
        if loop:
            self.close_loop()
            values = self.values
            rates = self.closed_rates() if linear else None
        else:
            values = self.outputs()
            rates = self.output_rates() if linear else None
        self._drive(step, linear)
        for ports in self.ports:
            self._feed(ports, values, rates)
        for ports in self.ports:
            self._advance(ports, step)
        self._finish(step, values, rates)

    def gauss_seidel(self, step, linear=False):
        """Steps the units in order; later ones use the outputs of earlier ones at the end of the step."""
        values = self.outputs()
        rates = self.output_rates() if linear else np.zeros(len(values))
        self._drive(step, linear)
        end = self._sweep(step, values, values + rates * step, linear)
        self._finish(step, *((values, (end - values) / step) if linear else (end, None)))

    def iterated(self, step, linear=True, newton=True):
        """Repeats Gauss-Seidel sweeps from saved states until inputs and outputs agree to `CLOSED`.

        Linear inputs go straight from the agreed end of one step to that of the next: order 2. Held inputs
        have the value at the end: order 1. Plain sweeps converge only for a loop gain below 1. `newton`
        corrects them by the directional derivatives, with Broyden's update for the effect of the step itself.
        """
        start = self.values
        guess = self.outputs() + (self.output_rates() * step if linear else 0.0)
        saved = [ports.unit.slave.getFMUstate() for ports in self.ports]
        try:
            self._iterate(step, start, guess, saved, linear, newton)
        finally:
            for ports, state in zip(self.ports, saved):
                ports.unit.slave.freeFMUstate(state)

    def _iterate(self, step, start, guess, saved, linear, newton):
        jacobian = last = None
        for self.sweeps in range(1, MOST_SWEEPS + 1):
            if self.sweeps > 1:
                for ports, state in zip(self.ports, saved):
                    ports.unit.slave.setFMUstate(state)
            self._drive(step, linear)
            taken = self._sweep(step, start, guess.copy(), linear)
            # later units already have the newest outputs: only the inputs of earlier units can be wrong
            shown = self.outputs()
            mismatch = np.where(self.forward, 0.0, (shown - guess) / self.scale)
            self.mismatch = float(np.abs(mismatch).max())
            if self.mismatch <= CLOSED:
                self._finish(step, *((start, (taken - start) / step) if linear else (taken, None)))
                return
            if not newton:
                guess = shown
                continue
            if jacobian is None:
                jacobian = self._sweep_jacobian()
            else:
                change, moved = last
                jacobian += np.outer(mismatch - moved - jacobian @ change, change) / (change @ change)
            change = np.where(self.forward, 0.0, np.linalg.solve(jacobian, -mismatch))
            last = change, mismatch
            guess = guess + change * self.scale
        raise RuntimeError(
            f"t = {self.time} s: {MOST_SWEEPS} sweeps leave a mismatch of {self.mismatch:.1e}; "
            "take smaller steps"
        )

    def _sweep_jacobian(self):
        """Returns the derivative of the mismatch by the guess, both over the scales.

        It is (I - F)⁻¹ B - I. F contains the connections that use newest outputs, B those that use guesses.
        """
        matrix = self.feedthrough() * self.scale / self.scale[:, None]
        one = np.eye(len(matrix))
        newest, guessed = matrix * self.forward, matrix * ~self.forward
        return np.linalg.solve(one - newest, guessed) - one

    def _sweep(self, step, start, end, linear):
        """Steps every unit in order and updates `end`, the interface at the end of the step, on the way."""
        for ports in self.ports:
            if linear:
                self._feed(ports, start, (end - start) / step)
            else:
                self._feed(ports, end, None)
            self._advance(ports, step)
            later = [index for index in ports.given if self.forward[index]]
            if later:
                found = np.empty(len(end))
                found[ports.given] = ports.unit.slave.getReal(ports.outputs)
                end[later] = found[later]
        return end

    def _finish(self, step, values, rates):
        self.values = values if rates is None else values + rates * step
        self.time += step


SCHEMES = {
    "Jacobi, held": lambda system, step: system.jacobi(step),
    "Jacobi, linear": lambda system, step: system.jacobi(step, linear=True),
    "Jacobi, loop closed, held": lambda system, step: system.jacobi(step, loop=True),
    "Jacobi, loop closed, linear": lambda system, step: system.jacobi(step, linear=True, loop=True),
    "Gauss-Seidel, held": lambda system, step: system.gauss_seidel(step),
    "Gauss-Seidel, linear": lambda system, step: system.gauss_seidel(step, linear=True),
    "iterated, held": lambda system, step: system.iterated(step, linear=False),
    "iterated, linear": lambda system, step: system.iterated(step),
}
