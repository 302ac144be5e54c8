import pytest

from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up_rig.build import build_host_library


@pytest.fixture(scope="session")
def library():
    need_tool("g++")
    return build_host_library()


@pytest.fixture(scope="session")
def elf():
    return build_firmware()
