"""Both builds of the firmware, once for all tests."""

import pytest

from tests.simulator.firmware.pair import build_host_library
from tests.support.firmware import build_firmware


@pytest.fixture(scope="session")
def library():
    """Return the build for this computer."""
    return build_host_library()


@pytest.fixture(scope="session")
def elf():
    """Return the build for the chip."""
    return build_firmware()
