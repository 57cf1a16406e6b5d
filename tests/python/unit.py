"""Wraps FMPy's FMU2Slave and FMU3Slave, so that variables have names instead of value references."""

import contextlib
import itertools
import shutil
import weakref
from ctypes import byref

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave
from fmpy.logging import addLoggerProxy


# The unit logs with printf formats, which FMPy's proxy turns into plain text. The proxy knows one logger in a
# process, the last it was given. It gets this one, which lives to the end and tells units by environment.
_units = weakref.WeakValueDictionary()
_environments = itertools.count(1)


@fmi2CallbackLoggerTYPE
def _logger(environment, _name, status, category, message):
    if environment in _units:
        _units[environment].messages.append((status, category.decode(), message.decode()))


# what FMI 3.0 calls the types of FMI 2.0
TYPES = {"Float64": "Real", "Int32": "Integer"}


class Unpacked:
    """An FMU of either version; its description has the types of FMI 2.0."""

    def __init__(self, path):
        self.path = path
        self.folder = extract(str(path))
        self.description = read_model_description(self.folder)
        for variable in self.description.modelVariables:
            variable.type = TYPES.get(variable.type, variable.type)


class Slave3(FMU3Slave):
    """An FMI 3.0 instance with the methods of FMU2Slave; enumerations are its only integers.

    FMI 3.0 has no input derivatives: the instance asks for the inputs at the end of a step.
    """

    experiment = {}

    def instantiate(self, callbacks=None, loggingOn=False, **options):
        self.slopes = {}

        def log(_environment, status, category, message):
            _units[callbacks.componentEnvironment].messages.append(
                (status, category.decode(), message.decode())
            )

        super().instantiate(
            loggingOn=loggingOn, logMessage=log, intermediateUpdate=self.intermediate_update, **options
        )

    def intermediate_update(self, _environment, time, asked, *_):
        if asked:
            for reference, (value, rate) in self.slopes.items():
                self.setFloat64([reference], [value + rate * (time - self.point)])

    def setupExperiment(self, **experiment):
        self.experiment = experiment

    def enterInitializationMode(self):
        super().enterInitializationMode(**self.experiment)

    def getReal(self, references):
        return self.getFloat64(references)

    def setReal(self, references, values):
        for reference in references:
            self.slopes.pop(reference, None)
        self.setFloat64(references, values)

    def getInteger(self, references):
        return self.getInt64(references)

    def setInteger(self, references, values):
        self.setInt64(references, values)

    def setRealInputDerivatives(self, references, orders, rates):
        assert set(orders) <= {1}
        for reference, rate in zip(references, rates, strict=True):
            self.slopes[reference] = (self.getFloat64([reference])[0], rate)

    def getRealOutputDerivatives(self, references, orders):
        return self.getOutputDerivatives(references, orders)

    def doStep(self, currentCommunicationPoint, communicationStepSize):
        self.point = currentCommunicationPoint
        try:
            return super().doStep(currentCommunicationPoint, communicationStepSize)
        finally:
            self.slopes = {}


class Unit:
    """An FMU instance. `messages` collects (status, category, text) of its log."""

    KIND = FMU2Slave

    def __init__(self, unpacked, name="wall", logging=False, **options):
        self.description = unpacked.description
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.items = {
            kind.name: {item.name: int(item.value) for item in kind.items}
            for kind in self.description.typeDefinitions
            if kind.items
        }
        self.messages = []
        self.time = 0.0
        self.slave = self.make(unpacked, name, logging, **options)

    def make(self, unpacked, name, logging, **options):
        """Returns an instance by FMPy."""
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = _logger
        self.callbacks.componentEnvironment = next(_environments)
        _units[self.callbacks.componentEnvironment] = self
        addLoggerProxy(byref(self.callbacks))
        kind = Slave3 if self.description.fmiVersion == "3.0" else self.KIND
        slave = kind(
            guid=self.description.guid,
            unzipDirectory=unpacked.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        slave.instantiate(callbacks=self.callbacks, loggingOn=logging, **options)
        return slave

    @staticmethod
    @contextlib.contextmanager
    def unpack(path):
        unpacked = Unpacked(path)
        try:
            yield unpacked
        finally:
            shutil.rmtree(unpacked.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.slave.freeInstance()

    def reference(self, name):
        return self.variables[name].valueReference

    def set(self, **values):
        for name, value in values.items():
            variable = self.variables[name]
            reference = [variable.valueReference]
            if isinstance(value, str):
                value = self.items[variable.declaredType.name][value]
            if variable.type == "Real":
                self.slave.setReal(reference, [value])
            elif variable.type == "Boolean":
                self.slave.setBoolean(reference, [value])
            else:
                self.slave.setInteger(reference, [value])
        return self

    def rates(self, **values):
        """Sets first derivatives of inputs for the next step."""
        references = [self.reference(name) for name in values]
        self.slave.setRealInputDerivatives(references, [1] * len(values), list(values.values()))

    def get(self, *names):
        values, variables = [], (self.variables[name] for name in names)
        for kind, group in itertools.groupby(variables, lambda variable: variable.type):
            # one call for all that follow each other
            references = [variable.valueReference for variable in group]
            if kind == "Real":
                values += self.slave.getReal(references)
            elif kind == "Boolean":
                values += map(bool, self.slave.getBoolean(references))
            else:
                values += self.slave.getInteger(references)
        return values[0] if len(values) == 1 else values

    def start(self, time=0.0, importer_tolerance=None, stop=None, **values):
        """Sets values, then goes through initialisation."""
        self.slave.setupExperiment(tolerance=importer_tolerance, startTime=time, stopTime=stop)
        self.set(**values)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        self.time = time
        return self

    def step(self, duration):
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=duration)
        self.time += duration
        return self
