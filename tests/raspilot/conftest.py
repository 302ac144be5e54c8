import pytest

from tests.raspilot.flight_controller_rig import Rig


@pytest.fixture
def rig(tmp_path):
    made = Rig(tmp_path)
    made.state()
    made.sticks()
    return made
