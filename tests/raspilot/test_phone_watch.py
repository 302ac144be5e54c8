"""What an instance reports to its runner, on a real socket."""

import socket

import pytest
from twisted.internet.task import Clock

from raspilot.modules.phone_watch import REPEAT_S, PhoneWatch
from tests.raspilot.flight_controller_rig import BOARD
from tests.support.system import build_up
from up.commands.flight_state_command import FlightStateCommand


@pytest.fixture
def runner(tmp_path, monkeypatch):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as heard:
        heard.bind(str(tmp_path / "notify"))
        heard.setblocking(False)
        monkeypatch.setenv("NOTIFY_SOCKET", str(tmp_path / "notify"))
        yield heard


def reported(clock, runner):
    """Return the next report, by its words."""
    words = []
    with pytest.raises(BlockingIOError):
        while True:
            runner.recv(4096)
    clock.advance(REPEAT_S)
    with pytest.raises(BlockingIOError):
        while True:
            words.append(runner.recv(4096).decode())
    return dict(word.split("=") for word in words if word.startswith("X_UP_"))


def test_an_aircraft_that_is_or_may_be_in_flight_counts_as_armed(tmp_path, runner):
    clock = Clock()
    up = build_up((PhoneWatch,), clock, tmp_path, instance="glider-1")
    up.get_module(PhoneWatch).on_start()
    # Without a board nothing can be armed.
    assert reported(clock, runner) == {"X_UP_PHONE": "0", "X_UP_ARMED": "0"}
    for armed, in_flight, word in (
        (True, True, "1"),
        (False, True, "1"),
        (False, None, "1"),
        (False, False, "0"),
        (True, False, "1"),
    ):
        state = FlightStateCommand("FBW", armed, False, False, in_flight)
        up.command_executor.execute_command(state, BOARD)
        assert reported(clock, runner)["X_UP_ARMED"] == word
