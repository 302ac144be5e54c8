"""What tuning tests fly with: the firmware built for this computer, in the default airframe."""

import importlib.util

import pytest

from tests.support.tools import need_tool, unavailable
from tools.tuning.experiments import Bench
from up_simulator.aircraft import load_airframe


@pytest.fixture(scope="session")
def bench():
    need_tool("g++")
    need_tool("make")
    if importlib.util.find_spec("jsbsim") is None:
        unavailable("JSBSim is not installed (pip install -e .[sim])")
    return Bench(load_airframe("glider"), "host")
