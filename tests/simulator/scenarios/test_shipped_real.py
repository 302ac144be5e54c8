"""Every shipped scenario with real programs holds, flown as a user flies it."""

import pytest

from tests.simulator.scenarios.shipped import REAL, WITH_BETAFLIGHT, fly_real
from tests.support.firmware import build_firmware


@pytest.mark.slow
@pytest.mark.parametrize("name", [each for each in REAL if each not in WITH_BETAFLIGHT])
def test_what_real_programs_fly_holds(name, tmp_path):
    build_firmware()
    fly_real(name, tmp_path)
