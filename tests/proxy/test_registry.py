"""The sweep of many aircraft, in steps between the events of the poller."""

from types import SimpleNamespace

from twisted.internet.testing import MemoryReactorClock
from twisted.logger import capturedLogs

from up_proxy.config import LimitsConfig
from up_proxy.loop_tick import TICK_S
from up_proxy.poller import Poller
from up_proxy.registry import MAX_STEPS, STEP_AIRCRAFT, AircraftRegistry


class Session:
    """An aircraft that counts its sweeps."""

    air_bytes = ground_bytes = dropped_lines = rejected_lines = 0

    def __init__(self, name, *_):
        self.name = name
        self.swept = 0
        self.is_gone = False
        self.is_broken = False
        self.grounds = SimpleNamespace(keep_paused_alive=lambda now_s: None)

    def sweep(self):
        self.swept += 1
        if self.is_broken:
            raise ZeroDivisionError

    def is_deserted(self, now_s):
        return self.is_gone

    def close(self):
        pass


def swept(count):
    """Return registry, sessions, and what moves the clock by a share of the time of a sweep."""
    clock = MemoryReactorClock()
    poller = Poller(clock, clock.seconds)
    poller.busy_poll_s = 0.0
    registry = AircraftRegistry(clock, poller, LimitsConfig(aircraft=count), Session)
    sessions = [registry.session(f"a{number}") for number in range(count)]

    def wait(share=1.0):
        clock.advance(TICK_S * share)
        clock.advance(0)

    return registry, sessions, wait


def swept_times(sessions, times):
    return sum(each.swept == times for each in sessions)


def test_a_few_aircraft_at_a_time_and_each_once():
    count = 3 * STEP_AIRCRAFT
    registry, sessions, wait = swept(count)
    sessions[-1].is_gone = True
    registry.sweep()
    for step, share in enumerate((0.0, 0.34, 0.34), start=1):
        wait(share)
        assert swept_times(sessions, 1) == step * STEP_AIRCRAFT
    assert registry.aircraft() == sessions[:-1]
    registry.sweep()
    for _ in range(3):
        wait(0.34)
    assert swept_times(sessions, 2) == count - 1 and sessions[-1].swept == 1


def test_none_begins_before_the_end_of_the_last():
    registry, sessions, wait = swept(2 * STEP_AIRCRAFT)
    for _ in range(2):
        registry.sweep()
        wait(0.0)
        assert swept_times(sessions, 1) == STEP_AIRCRAFT
    wait()
    assert swept_times(sessions, 1) == 2 * STEP_AIRCRAFT


def test_a_bug_in_one_costs_the_rest_of_its_step_alone():
    registry, sessions, wait = swept(3 * STEP_AIRCRAFT)
    sessions[1].is_broken = True
    with capturedLogs() as logs:
        registry.sweep()
        for _ in range(3):
            wait(0.34)
    assert swept_times(sessions, 1) == 2 * STEP_AIRCRAFT + 1
    assert [each["code"] for each in logs] == ["proxy_bug"]
    registry.sweep()
    wait(0.0)
    assert swept_times(sessions, 2) == STEP_AIRCRAFT


def test_thousands_take_no_more_steps():
    registry, sessions, wait = swept(100 * MAX_STEPS)
    registry.sweep()
    wait(0.0)
    assert swept_times(sessions, 1) == 100


def test_the_end_stops_a_sweep():
    registry, sessions, wait = swept(2 * STEP_AIRCRAFT)
    registry.sweep()
    registry.stop()
    wait()
    assert swept_times(sessions, 0) == 2 * STEP_AIRCRAFT
