"""Repeats calls of a Linux library on the Windows library under wine, and runs wall.exe."""

import struct
import subprocess
from pathlib import Path
from urllib.parse import quote

from fmpy.fmi2 import FMU2Slave

from unit import Unit


def digits(value):
    """Returns the bits of a real number as hexadecimal digits."""
    return struct.pack(">d", value).hex()


def real(digits):
    return struct.unpack(">d", bytes.fromhex(digits))[0]


class FMU2Recorder(FMU2Slave):
    """Keeps the calls for the driver; after each step it also gets the outputs in `watched`.

    FMPy reads the version of FMI from the name of the class.
    """

    def __init__(self, **arguments):
        super().__init__(**arguments)
        self.calls, self.watched = [], []

    def keep(self, call, *arguments):
        words = (argument if isinstance(argument, str) else f"{argument:x}" for argument in arguments)
        self.calls.append(" ".join([call, *words]))

    def setupExperiment(self, tolerance=None, startTime=0.0, stopTime=None):
        assert stopTime is None
        self.keep("setup", int(tolerance is not None), digits(tolerance or 0.0), digits(startTime))
        super().setupExperiment(tolerance, startTime)

    def enterInitializationMode(self):
        self.keep("enter")
        super().enterInitializationMode()

    def exitInitializationMode(self):
        self.keep("exit")
        super().exitInitializationMode()

    def setReal(self, vr, value):
        self.keep("real", *vr, *map(digits, value))
        super().setReal(vr, value)

    def setInteger(self, vr, value):
        self.keep("integer", *vr, *value)
        super().setInteger(vr, value)

    def setBoolean(self, vr, value):
        self.keep("boolean", *vr, *map(int, value))
        super().setBoolean(vr, value)

    def setRealInputDerivatives(self, vr, order, value):
        for reference, rate in zip(vr, value, strict=True):
            self.keep("rate", reference, digits(rate))
        super().setRealInputDerivatives(vr, order, value)

    def getReal(self, vr):
        values = super().getReal(vr)
        # the driver compares one value a line
        for reference, value in zip(vr, values, strict=True):
            self.keep("get", reference, digits(value))
        return values

    def getBoolean(self, vr):
        values = super().getBoolean(vr)
        for reference, value in zip(vr, values, strict=True):
            self.keep("truth", reference, int(value))
        return values

    def doStep(self, currentCommunicationPoint, communicationStepSize):
        self.keep("step", digits(currentCommunicationPoint), digits(communicationStepSize))
        super().doStep(currentCommunicationPoint, communicationStepSize)
        for reference in self.watched:
            self.getReal([reference])


class RecordingUnit(Unit):
    KIND = FMU2Recorder

    def __init__(self, unpacked):
        super().__init__(unpacked)
        self.unpacked = unpacked
        outputs = [v for v in self.description.modelVariables if v.causality == "output" and v.type == "Real"]
        self.slave.watched = [variable.valueReference for variable in outputs]

    def repeat(self, wine):
        """Repeats all calls on Windows. Returns how many values were compared, and those that differ."""
        names = {variable.valueReference: name for name, variable in self.variables.items()}
        printed = wine.drive(self.unpacked, self.slave.calls)
        *different, count = [line.split() for line in printed.splitlines()]
        return int(count[0]), [(names[int(r)], real(linux), real(found)) for r, linux, found in different]


def windows_path(path):
    """Returns a path as Windows writes it."""
    return "Z:" + str(path).replace("/", "\\")


class Wine:
    """Runs programs for Windows: the driver of libraries and `wall.exe`."""

    def __init__(self, program, driver, wall):
        self.program, self.driver, self.wall = program, driver, wall

    def drive(self, unpacked, calls):
        """Makes calls of the Windows library of an unpacked FMU, and returns what the driver prints."""
        folder = Path(unpacked.folder)
        library = folder / f"binaries/win64/{unpacked.description.coSimulation.modelIdentifier}.dll"
        resources = "file:///Z:" + quote(str(folder / "resources"))
        arguments = [windows_path(library), unpacked.description.guid, resources]
        return self.run(self.driver, *arguments, input="\n".join(calls))

    def run(self, program, *arguments, input=""):
        """Runs a program to its end and returns what it prints."""
        command = [self.program, program, *arguments]
        done = subprocess.run(command, input=input, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout
