"""Both builds of the firmware, once for all tests."""

import pytest

from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up_rig.build import build_host_library


@pytest.fixture(scope="session")
def library():
    """Return the build for this computer."""
    need_tool("g++")
    return build_host_library()


@pytest.fixture(scope="session")
def elf():
    """Return the build for the chip."""
    return build_firmware()
