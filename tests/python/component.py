"""Hosts the WebAssembly component of an FMU with wasmtime, behind the methods of FMPy."""

import re
from pathlib import Path
from types import SimpleNamespace

from fmpy.fmi1 import FMICallException
from wasmtime import Engine, Store, WasiConfig
from wasmtime.component import Component, Linker

from exchange import Exchange
from unit import Unit

PACKAGE = "fmi:fmi3/{}@3.0.0"
# where a component finds the resources of its FMU: it sees no other folder
RESOURCES = "/resources"
STATUS = {"warning": 1, "discard": 2, "error": 3, "fatal": 4}


class Loaded:
    """A compiled component."""

    def __init__(self, unpacked):
        name = unpacked.description.coSimulation.modelIdentifier
        self.folder = Path(unpacked.folder)
        self.engine = Engine()
        self.component = Component.from_file(
            self.engine, str(self.folder / f"binaries/wasm32-wasip2/{name}.wasm")
        )

    @classmethod
    def of(cls, unpacked):
        """The component of an unpacked FMU, compiled once."""
        if not hasattr(unpacked, "component"):
            unpacked.component = cls(unpacked)
        return unpacked.component

    def names(self):
        """What the component imports and exports."""
        kind = self.component.type
        return list(kind.imports(self.engine)), list(kind.exports(self.engine))


class Host:
    """One component with memory of its own; `log` takes the store and what is logged."""

    def __init__(self, loaded, log):
        self.store = Store(loaded.engine)
        wasi = WasiConfig()
        if (loaded.folder / "resources").is_dir():
            wasi.preopen_dir(str(loaded.folder / "resources"), RESOURCES)
        self.store.set_wasi(wasi)
        linker = Linker(loaded.engine)
        linker.add_wasip2()
        with linker.root() as root, root.add_instance(PACKAGE.format("callbacks")) as callbacks:
            callbacks.add_func("log-message", log)
        self.instance = linker.instantiate(self.store, loaded.component)

    def function(self, interface, name):
        """A function of an interface; its type is asked for once."""
        folder = self.instance.get_export_index(self.store, PACKAGE.format(interface))
        index = self.instance.get_export_index(self.store, name, folder)
        function = self.instance.get_func(self.store, index)
        kind = function.type(self.store)
        kind = SimpleNamespace(params=kind.params, result=kind.result)
        function.type = lambda _store: kind
        return function


class Slave:
    """An instance with the methods of FMPy's FMU2Slave and FMU2Model that `Unit` and `Exchange` use."""

    experiment = (None, 0.0, None)

    def __init__(self, host, interface, *arguments):
        self.host, self.interface, self.functions = host, interface, {}
        make = host.function(interface, f"[static]{interface}-instance.instantiate-{interface}")
        self.handle = make(host.store, *arguments)
        if self.handle is None:
            raise FMICallException(function="instantiate", status=STATUS["error"])

    def function(self, name):
        if name not in self.functions:
            method = f"[method]{self.interface}-instance.{name}"
            self.functions[name] = self.host.function(self.interface, method)
        return self.functions[name]

    def call(self, name, *arguments):
        """Calls a method; a status other than ok is an exception, as in FMPy."""
        answer = self.function(name)(self.host.store, self.handle, *arguments)
        if isinstance(answer, str) and answer != "ok":
            raise FMICallException(function=name, status=STATUS[answer])
        return answer

    def __getattr__(self, name):
        """`enterEventMode` of FMPy is `enter-event-mode` here."""
        if name.startswith("__"):
            raise AttributeError(name)
        kebab = re.sub("[A-Z]", lambda letter: "-" + letter[0].lower(), name)
        return lambda *arguments: self.call(kebab, *arguments)

    def freeInstance(self):
        self.handle.drop(self.host.store)

    def setupExperiment(self, tolerance, startTime, stopTime):
        self.experiment = (tolerance, startTime, stopTime)

    def enterInitializationMode(self):
        self.call("enter-initialization-mode", *self.experiment)

    def getReal(self, references):
        return self.call("get-float64", list(references))

    def setReal(self, references, values):
        self.call("set-float64", list(references), [float(value) for value in values])

    def getBoolean(self, references):
        return self.call("get-boolean", list(references))

    def setBoolean(self, references, values):
        self.call("set-boolean", list(references), [bool(value) for value in values])

    def getInteger(self, references):
        return self.call("get-int64", list(references))

    def setInteger(self, references, values):
        self.call("set-int64", list(references), list(values))

    def setRealInputDerivatives(self, references, orders, rates):
        requests = list(zip(references, orders, strict=True))
        self.call("set-input-derivatives", requests, [float(rate) for rate in rates])

    def fields(self, names, method, *arguments):
        """The fields of a record that a method returns, in the order of FMPy."""
        record = vars(self.call(method, *arguments))
        assert set(names) == set(record)
        return tuple(record[name] for name in names)

    def doStep(self, currentCommunicationPoint, communicationStepSize):
        names = ("event-handling-needed", "terminate-simulation", "early-return", "last-successful-time")
        times = float(currentCommunicationPoint), float(communicationStepSize)
        return self.fields(names, "do-step", *times, False)

    def updateDiscreteStates(self):
        names = (
            "new-discrete-states-needed", "terminate-simulation", "nominals-of-continuous-states-changed",
            "values-of-continuous-states-changed", "next-event-time-defined", "next-event-time",
        )  # fmt: skip
        return self.fields(names, "update-discrete-states")

    newDiscreteStates = updateDiscreteStates

    def completedIntegratorStep(self):
        return self.fields(("enter-event-mode", "terminate-simulation"), "completed-integrator-step", True)

    def getAdjointDerivative(self, unknowns, knowns, seed, _count):
        return self.call("get-adjoint-derivative", unknowns, knowns, seed)

    def setContinuousStates(self, states, _count):
        self.call("set-continuous-states", list(states))

    def getContinuousStates(self, values, count):
        values[:count] = self.call("get-continuous-states")

    def getDerivatives(self, values, count):
        values[:count] = self.call("get-continuous-state-derivatives")

    def getEventIndicators(self, values, count):
        values[:count] = self.call("get-event-indicators")

    def getNominalsOfContinuousStates(self, values, count):
        values[:count] = self.call("get-nominals-of-continuous-states")


class Hosted:
    """Makes the instance of a `Unit` or `Exchange` in a component instead of a library."""

    INTERFACE = "co-simulation"

    def make(
        self, unpacked, name, logging,
        eventModeUsed=False, earlyReturnAllowed=False, requiredIntermediateVariables=(),
    ):  # fmt: skip
        host = Host(Loaded.of(unpacked), lambda _store, _name, *message: self.messages.append(message))
        arguments = [name, unpacked.description.guid, RESOURCES, False, logging]
        if self.INTERFACE == "co-simulation":
            arguments += [eventModeUsed, earlyReturnAllowed, list(requiredIntermediateVariables)]
        return Slave(host, self.INTERFACE, *arguments)


class HostedUnit(Hosted, Unit):
    """An instance for Co-Simulation in a component."""


class HostedExchange(Hosted, Exchange):
    """An instance for Model Exchange in a component."""

    INTERFACE = "model-exchange"
