"""One instance's life in virtual time, where minutes pass."""

import os
import signal
from dataclasses import replace
from pathlib import Path

import pytest
from twisted.internet.defer import Deferred
from twisted.logger import capturedLogs

from tests.runner.recording_host import (
    AIRBORNE,
    BLACK_BOX,
    PORTS,
    STOPPING,
    RecordedChild,
    RecordingHost,
)
from up_runner.instance import Instance
from up_runner.instance_config import ConfigurationRefused
from up_runner.instance_machine import TRANSITIONS, State
from up_runner.instance_state import InstanceState
from up_runner.notify_listener import Notification
from up_runner.request import Request
from up_runner.response import Problem


@pytest.fixture
def host():
    made = RecordingHost()
    yield made
    if made.instance is not None and made.instance.state is not State.ENDED:
        made.instance.detach()
    assert made.clock.getDelayedCalls() == []


def test_it_runs_when_it_is_ready_and_its_ports_are_bound(host):
    instance = host.make()
    outcome = instance.start()
    assert instance.state is State.STARTING and not outcome.called
    host.say(ready=True, ports=PORTS)
    assert host.result(outcome) is None
    response = instance.response(spawned=True)
    assert (response.pid, response.ports, response.spawned) == (1000, PORTS, True)
    assert host.records[-1] == InstanceState(
        Request("glider-1"), host.child.identity, keep=True, ready=True, ports=PORTS
    )


def test_ready_without_the_ports_is_not_yet_ready(host):
    host.ports = frozenset([50001])
    instance = host.make()
    outcome = instance.start()
    host.say(ready=True, ports=PORTS)
    host.clock.advance(1)
    assert not outcome.called
    host.ports = frozenset(PORTS.values())
    host.clock.advance(0.1)
    assert instance.state is State.RUNNING and host.result(outcome) is None


def test_a_port_that_a_phone_needs_must_be_announced(host):
    instance = host.make(replace(BLACK_BOX, needed_ports=("general",)))
    outcome = instance.start()
    host.say(ready=True, ports={"orientation": 50000})
    host.clock.advance(1)
    assert instance.state is State.STARTING
    host.clock.advance(9)
    host.child.on_end(-signal.SIGKILL)
    assert host.result(outcome).code == "port_not_bound"
    assert "general" in host.result(outcome).text


def test_without_the_kernels_answer_its_report_is_accepted(host):
    host.ports = None
    instance = host.make()
    instance.start()
    host.say(ready=True, ports=PORTS)
    assert instance.state is State.RUNNING


def test_signs_of_life_do_not_make_it_ready(host):
    instance = host.make()
    outcome = instance.start()
    for _ in range(9):
        host.say(alive=True, ports=PORTS)
        host.clock.advance(1)
    assert instance.state is State.STARTING
    host.clock.advance(1.5)
    assert host.child.signals == ["KILL"]
    host.child.on_end(-signal.SIGKILL)
    assert host.result(outcome).code == "not_ready"
    assert instance.state is State.ENDED and host.records[-1] is None


def test_a_readiness_that_waits_in_the_socket_counts(host):
    instance = host.make()
    instance.start()
    host.waiting.append((1000, Notification(ready=True, ports=PORTS)))
    host.clock.advance(10)
    assert instance.state is State.RUNNING and host.child.signals == []


def test_notifications_of_another_process_are_ignored(host):
    instance = host.make()
    instance.start()
    host.notify(999, Notification(ready=True, ports={"general": 1}))
    assert instance.state is State.STARTING and instance.ports is None


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (ConfigurationRefused("unknown_profile", "no profile"), "unknown_profile"),
        (OSError("disk full"), "cannot_spawn"),
    ],
)
def test_a_failed_preparation_is_the_outcome(host, error, code):
    host.failing = error
    instance = host.make()
    assert host.result(instance.start()).code == code
    assert instance.state is State.ENDED and host.children == []


def test_it_sleeps_after_hours_without_its_phone_and_never_while_it_may_be_armed(host):
    hours_s = 4 * 3600.0
    policy = replace(BLACK_BOX, exit_delay_s=hours_s, watchdog_s=None, sleeps=True)
    instance = host.run(policy)
    # It has not reported whether it is armed.
    host.clock.advance(2 * hours_s)
    host.say(armed=True)
    host.clock.advance(2 * hours_s)
    host.say(armed=False, phone=True)
    host.clock.advance(2 * hours_s)
    host.say(phone=False)
    host.clock.advance(hours_s - 1)
    host.say(armed=True)
    host.clock.advance(2)
    assert instance.state is State.RUNNING
    host.say(armed=False)
    host.clock.advance(hours_s - 1)
    # The report is still in the socket when the time is over.
    host.waiting.append((host.child.pid, Notification(armed=True)))
    host.clock.advance(2)
    assert instance.state is State.RUNNING
    host.say(armed=False)
    host.clock.advance(hours_s)
    assert (instance.state, host.child.signals) == (State.STOPPING, ["TERM"])
    host.child.on_end(0)
    assert instance.last_end.code == "asleep"


def test_the_exit_delay_of_minutes_runs_only_while_the_phone_is_gone(host):
    instance = host.run()
    host.live(59)
    host.say(phone=True)
    host.live(7200)
    assert instance.state is State.RUNNING
    host.say(phone=False)
    for _ in range(58):
        # Repeated, it gains no time.
        host.say(alive=True, phone=False)
        host.clock.advance(1)
    assert instance.state is State.RUNNING
    host.live(3)
    assert instance.state is State.STOPPING and host.child.signals == ["TERM"]
    host.child.on_end(0)
    assert instance.state is State.ENDED
    assert instance.last_end.code == "phone_gone"


def test_a_waiting_report_of_the_phone_counts(host):
    instance = host.run()
    host.live(59)
    host.waiting.append((1000, Notification(phone=True, alive=True)))
    host.clock.advance(1)
    host.live(300)
    assert instance.state is State.RUNNING and host.child.signals == []


def test_a_lost_phone_never_stops_an_instance_that_may_be_flying(host):
    instance = host.run(AIRBORNE)
    host.say(phone=True)
    host.say(phone=False)
    host.live(86_400, step_s=1.5)
    assert instance.state is State.RUNNING and host.child.signals == []


def test_a_process_that_ignores_sigterm_is_killed_after_five_seconds(host):
    instance = host.run()
    instance.stop(Problem("first", ""))
    instance.stop(Problem("second", ""))
    host.clock.advance(4.9)
    assert host.child.signals == ["TERM"]
    host.clock.advance(0.2)
    assert host.child.signals == ["TERM", "KILL"]
    host.child.on_end(-signal.SIGKILL)
    assert instance.last_end.code == "first"


def test_a_silent_process_hangs_and_is_restarted(host):
    instance = host.run()
    host.live(30)
    host.clock.advance(2)
    assert host.child.signals == ["KILL"]
    host.child.on_end(-signal.SIGKILL)
    assert instance.state is State.WAITING
    assert instance.last_end.code == "hung"
    host.clock.advance(0.25)
    assert instance.state is State.STARTING and len(host.children) == 2


def test_a_sign_of_life_that_waits_in_the_socket_counts(host):
    instance = host.run()
    host.clock.advance(1.9)
    host.waiting.append((1000, Notification(alive=True)))
    host.clock.advance(0.2)
    assert host.child.signals == [] and instance.state is State.RUNNING


def test_without_a_watchdog_silence_is_allowed(host):
    instance = host.run(replace(AIRBORNE, watchdog_s=None))
    host.clock.advance(86_400)
    assert instance.state is State.RUNNING and host.child.signals == []


def test_restarts_back_off_and_give_up(host):
    instance = host.run()
    for delay_s in (0.25, 0.5, 1.0, 2.0, 4.0):
        host.child.on_end(1)
        assert instance.state is State.WAITING
        assert host.records[-1] == InstanceState(Request("glider-1"), None, keep=True)
        count = len(host.children)
        host.clock.advance(delay_s - 0.01)
        assert len(host.children) == count
        host.clock.advance(0.02)
        assert len(host.children) == count + 1
        host.say(ready=True, ports=PORTS)
    host.child.on_end(1)
    assert instance.state is State.ENDED
    assert instance.last_end.code == "gave_up"


def test_an_instance_that_may_be_flying_is_restarted_without_limit(host):
    instance = host.run(AIRBORNE)
    for _ in range(200):
        host.child.on_end(-signal.SIGSEGV)
        assert instance.state is State.WAITING
        host.clock.advance(10)
        host.say(ready=True, ports=PORTS)
    assert instance.state is State.RUNNING and len(host.children) == 201


def test_a_restart_that_fails_is_tried_again(host):
    instance = host.run()
    host.child.on_end(1)
    host.clock.advance(0.25)
    asked = instance.outcome()
    host.child.on_end(2)
    assert host.result(asked).code == "restarting"
    assert "segfault" in host.result(asked).text
    host.clock.advance(0.5)
    host.say(ready=True, ports=PORTS)
    assert instance.state is State.RUNNING


def test_a_first_start_that_fails_is_not_tried_again(host):
    instance = host.make()
    outcome = instance.start()
    host.child.on_end(2)
    assert instance.state is State.ENDED
    assert host.result(outcome).code == "start_failed"
    assert "segfault" in host.result(outcome).text


def test_a_first_start_that_fails_is_retried_with_keep(host):
    instance = host.make(AIRBORNE, keep=True)
    instance.start()
    host.child.on_end(2)
    assert instance.state is State.WAITING and host.records[-1].keep


def test_a_process_that_reports_stopping_has_time_and_is_not_restarted(host):
    instance = host.run()
    host.say(stopping=True)
    host.clock.advance(4)
    assert host.child.signals == []
    host.clock.advance(2)
    assert host.child.signals == ["KILL"]
    host.child.on_end(-signal.SIGKILL)
    assert instance.state is State.ENDED


def test_stopped_while_it_waits_it_does_not_come_back(host):
    instance = host.run()
    host.child.on_end(1)
    ended = instance.when_ended()
    with capturedLogs() as logs:
        instance.stop(STOPPING)
    assert [(each["code"], each["cause"]) for each in logs] == [("ended", STOPPING.code)]
    assert ended.called and instance.state is State.ENDED
    assert instance.last_end == STOPPING
    host.clock.advance(100)
    assert len(host.children) == 1


def test_stopped_while_it_is_prepared_no_process_is_started(host):
    host.preparing = Deferred()
    instance = host.make()
    outcome, ended = instance.start(), instance.when_ended()
    instance.stop(STOPPING)
    assert not ended.called
    host.preparing.callback((Path("config"), os.open(os.devnull, os.O_WRONLY)))
    assert ended.called and host.children == []
    assert host.result(outcome) == STOPPING


def test_detached_it_changes_nothing(host):
    instance = host.run()
    before = list(host.records)
    instance.detach()
    assert host.child.signals == [] and not host.child.watched
    assert host.listener == "left" and host.records == before


def test_adopted_it_has_one_watchdog_period(host):
    instance = host.make()
    saved = InstanceState(instance.request, keep=True, ready=True, ports=PORTS, phone=True)
    host.children.append(RecordedChild(77))
    instance.adopt(host.child, saved)
    assert instance.state is State.RUNNING and instance.response(spawned=False).pid == 77
    host.live(300)
    assert instance.state is State.RUNNING
    host.clock.advance(2)
    assert host.child.signals == ["KILL"]


def test_adopted_without_a_report_of_the_phone_the_delay_begins(host):
    instance = host.make()
    host.children.append(RecordedChild(77))
    instance.adopt(host.child, InstanceState(instance.request, keep=True, ready=True, ports=PORTS))
    host.live(61)
    assert instance.state is State.STOPPING


def test_a_bug_leaves_no_process_unwatched(host):
    instance = host.make()
    outcome = instance.start()
    looking = Deferred()
    host.open_ports = lambda pid: looking
    host.say(ready=True, ports=PORTS)
    looking.errback(ZeroDivisionError("a bug"))
    assert host.child.signals == ["KILL"] and instance.state is State.STOPPING
    host.child.on_end(-signal.SIGKILL)
    assert host.result(outcome).code == "runner_bug"


def test_every_output_of_the_table_exists():
    outputs = {output for _, listed in TRANSITIONS.values() for output in listed}
    assert all(callable(getattr(Instance, f"_{output}")) for output in outputs)
    assert {state for state, _ in TRANSITIONS} == set(State) - {State.DETACHED}
