"""Machines of the examples, and the program where there is one: HCI_SOLVE names it."""
import os
from pathlib import Path

import pytest

import hci

DATA = Path(os.environ.get("HCI_DATA", Path(__file__).parents[2] / "data"))

try:
    import matplotlib

    matplotlib.use("Agg")
except ImportError:
    pass


@pytest.fixture(scope="session")
def data() -> Path:
    return DATA


@pytest.fixture(scope="session")
def machine_a() -> hci.Machine:
    return hci.Machine.read(DATA / "machine_a")


@pytest.fixture(scope="session")
def machine_c() -> hci.Machine:
    return hci.Machine.read(DATA / "machine_c")


@pytest.fixture(scope="session")
def smooth(machine_a) -> hci.Solution:
    return machine_a.solve(DATA / "scenarios/02/target.csv")


@pytest.fixture(scope="session")
def program() -> str:
    if "HCI_SOLVE" not in os.environ:
        pytest.skip("HCI_SOLVE does not name the program")
    return os.environ["HCI_SOLVE"]
