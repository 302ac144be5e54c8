"""The sweep of many aircraft, in steps between the events of the poller."""

import itertools
from types import SimpleNamespace

from twisted.internet.testing import MemoryReactorClock
from twisted.logger import capturedLogs

from up_proxy.config import LimitsConfig
from up_proxy.poller import Poller
from up_proxy.registry import MAX_STEPS, MIN_STEP, AircraftRegistry


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
    """Return registry, sessions, and what does the next steps until none is left."""
    clock = MemoryReactorClock()
    poller = Poller(clock, clock.seconds)
    poller.busy_poll_s = 0.0
    registry = AircraftRegistry(clock, poller, LimitsConfig(aircraft=count), Session)
    sessions = [registry.session(f"a{number}") for number in range(count)]

    def finish():
        while clock.getDelayedCalls():
            clock.advance(0)

    return registry, sessions, finish


def counts(sessions):
    return [(each, len(list(row))) for each, row in itertools.groupby(s.swept for s in sessions)]


def test_a_few_aircraft_at_a_time_and_each_once():
    registry, sessions, finish = swept(3 * MIN_STEP + 1)
    sessions[-1].is_gone = True
    registry.sweep()
    assert counts(sessions) == [(1, MIN_STEP), (0, 2 * MIN_STEP + 1)]
    registry.sweep()  # the next one is due before the end of this one
    assert counts(sessions) == [(1, MIN_STEP), (0, 2 * MIN_STEP + 1)]
    finish()
    assert counts(sessions) == [(1, 3 * MIN_STEP + 1)]
    assert registry.aircraft() == sessions[:-1]
    registry.sweep()
    finish()
    assert counts(sessions) == [(2, 3 * MIN_STEP), (1, 1)]


def test_a_bug_in_one_costs_the_rest_of_its_step_alone():
    registry, sessions, finish = swept(3 * MIN_STEP)
    sessions[MIN_STEP].is_broken = True
    with capturedLogs() as logs:
        registry.sweep()
        finish()
    assert counts(sessions) == [(1, MIN_STEP + 1), (0, MIN_STEP - 1), (1, MIN_STEP)]
    assert [each["code"] for each in logs] == ["proxy_bug"]


def test_thousands_take_no_more_steps():
    registry, sessions, _ = swept(100 * MAX_STEPS)
    registry.sweep()
    assert counts(sessions) == [(1, 100), (0, 100 * (MAX_STEPS - 1))]
