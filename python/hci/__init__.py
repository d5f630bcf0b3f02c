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
from .fit import Fit, Parameter
from .machine import Machine, diagnose_again
from .prediction import Prediction
from .recording import Recording, Run
from .simulation import Follow, Simulation
from .solution import Emitted, Samples, Solution
from .waveform import Waveform
from .written import Batch, Fleet, Sweep, Tuned, batch, fleet, tune

__version__: str = _text(_lib.hci_python_version())

__all__ = [
    "ArgumentError", "Batch", "Check", "Diagnosis", "Emitted", "Finding", "Fit", "Fleet", "Follow", "HciError", "InputError",
    "Machine", "NextPoint", "NumericError", "OutOfMemoryError", "OutputError", "Parameter", "Prediction", "Recording", "Run",
    "Samples", "Simulation", "Slip", "Solution", "StoppedError", "Sweep", "Tuned", "Waveform", "batch", "diagnose_again", "fleet",
    "tune",
]
