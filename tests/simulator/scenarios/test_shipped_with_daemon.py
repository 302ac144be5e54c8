"""Every shipped scenario with the daemon in this process holds."""

import pytest

from tests.simulator.scenarios.shipped import WITH_DAEMON, fly


@pytest.mark.parametrize("name", WITH_DAEMON)
def test_what_flies_with_the_daemon_holds(name):
    assert fly(name) == []


def test_a_throw_and_what_follows_hold_with_the_built_in_flight_model():
    assert fly("take-off-by-throw", "built-in") == []
