"""Currents that make a permanent-magnet motor produce the torque you want.

    >>> import hci
    >>> machine = hci.Machine.read("data/machine_a")
    >>> solution = machine.solve("data/scenarios/02/target.csv")
    >>> solution.reached
    True

docs/python.md is the guide. Everything is computed by the C library that `hci-solve` is made of.
"""
from ._binding import lib as _lib
from ._call import text as _text
from .check import Check, Slip
from .diagnosis import Diagnosis, Finding, NextPoint
from .errors import ArgumentError, HciError, InputError, NumericError, OutOfMemoryError, OutputError, StoppedError
from .machine import Machine
from .prediction import Prediction
from .recording import Recording, Run
from .simulation import Simulation
from .solution import Emitted, Samples, Solution
from .waveform import Waveform

__version__: str = _text(_lib.hci_python_version())

__all__ = [
    "ArgumentError", "Check", "Diagnosis", "Emitted", "Finding", "HciError", "InputError", "Machine", "NextPoint",
    "NumericError", "OutOfMemoryError", "OutputError", "Prediction", "Recording", "Run", "Samples", "Simulation", "Slip",
    "Solution", "StoppedError", "Waveform",
]
