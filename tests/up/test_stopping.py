"""Opened resources are closed: after failed starts, and in time even if something hangs."""

import threading

import pytest
from twisted.internet.defer import CancelledError, Deferred

from tests.up.commands.samples import Log
from tests.up.test_life_cycle import System
from up.base_started_module import BaseStartedModule, StartFailedError
from up.base_thread_module import BaseThreadModule
from up.life_cycle import STOP_LIMIT_S
from up.program import FORCED_AFTER_S

STEP_S = 0.001


class Opening(BaseStartedModule):
    """Opens a port, then fails by the setting ``fail``."""

    is_open = False

    def on_start(self):
        self.is_open = True
        return self.fail()

    def on_stop(self):
        self.is_open = False

    def fail(self):
        return True


def fail_by(exception):
    def fail(self):
        raise exception

    return fail


async def _hang():
    while True:
        try:
            await Deferred()
        except CancelledError:
            continue


@pytest.mark.parametrize(
    "fail",
    [
        lambda self: False,
        fail_by(RuntimeError("boom")),
        fail_by(SystemExit(1)),
        fail_by(StartFailedError("the port is taken")),
        lambda self: "rubbish",
        lambda self: Deferred(),
        lambda self: _hang(),
    ],
)
@pytest.mark.parametrize("required", [False, True])
def test_a_failed_start_leaves_nothing_open(tmp_path, fail, required):
    cls = type("Failing", (Opening,), {"fail": fail, "REQUIRED": required})
    system = System(tmp_path, cls)
    module = system.up.get_module(cls)
    done = system.start()
    system.clock.pump([0.01] * 1200)
    assert done
    assert not module.is_open
    assert system.running == []
    assert not system.clock.getDelayedCalls()


@pytest.mark.parametrize("stop", [fail_by(RuntimeError("half open")), fail_by(SystemExit(1))])
def test_a_fault_of_the_stop_after_a_failed_start_is_only_a_detail(tmp_path, stop):
    cls = type("Failing", (Opening,), {"fail": lambda self: False, "on_stop": stop})
    system = System(tmp_path, cls)
    with Log() as log:
        assert system.start() == [None]
    levels = [event["log_level"].name for event in log.events if "log_failure" in event]
    assert levels == ["debug"]
    assert system.reason(cls)


def test_a_stop_that_hangs_after_a_failed_start_does_not_end_the_boot(tmp_path):
    class Later(Opening):
        LOAD_ORDER = 1

    stop = {"on_stop": lambda self: Deferred()}
    cls = type("Failing", (Opening,), {"fail": lambda self: False, **stop})
    system = System(tmp_path, cls, Later)
    done = system.start()
    system.clock.pump([0.01] * 200)
    assert done == [None]
    assert system.running == ["Later"]


def time_of_stop(system):
    """Return the seconds until the stop was done."""
    began_s = system.clock.seconds()
    done = system.stop()
    while not done:
        assert system.clock.seconds() - began_s < 60
        system.clock.advance(STEP_S)
    return system.clock.seconds() - began_s


@pytest.mark.parametrize("count", [1, 2, 8, 40])
def test_however_many_hang_the_stop_is_done_before_it_is_forced(tmp_path, count):
    calls = []

    class Fine(BaseStartedModule):
        LOAD_ORDER = -1

        def on_stop(self):
            calls.append("stops")

    hanging = [
        type(f"Hanging{number}", (BaseStartedModule,), {"on_stop": lambda self: _hang()})
        for number in range(count)
    ]
    system = System(tmp_path, Fine, *hanging)
    system.start()
    with Log() as log:
        assert time_of_stop(system) <= 1.8 + STEP_S
    assert STOP_LIMIT_S == 1.8
    assert FORCED_AFTER_S == 2.0
    assert len(log.of("stop_timeout")) == count
    assert calls == ["stops"]
    assert not system.clock.getDelayedCalls()


@pytest.mark.parametrize("hanging", [0, 1, 8])
def test_a_thread_that_does_not_end_is_left_behind_and_its_module_closed(tmp_path, hanging):
    release, calls = threading.Event(), []

    class Blocked(BaseThreadModule):
        def _loop(self):
            release.wait(60)

        def on_stop(self):
            calls.append("closed")

    others = [
        type(
            f"Hanging{number}",
            (BaseStartedModule,),
            {"LOAD_ORDER": 1, "on_stop": lambda self: _hang()},
        )
        for number in range(hanging)
    ]
    system = System(tmp_path, Blocked, *others)
    system.start()
    try:
        with Log() as log:
            assert time_of_stop(system) <= 1.8 + STEP_S
        assert log.of("thread_left_behind")
        assert calls == ["closed"]
    finally:
        release.set()
