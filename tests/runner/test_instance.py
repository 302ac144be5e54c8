"""One instance's life in virtual time, where minutes pass."""

import os
import signal
from dataclasses import replace
from pathlib import Path

import pytest
from twisted.internet.defer import Deferred, fail, succeed
from twisted.internet.task import Clock

from up_runner.backoff import RestartPolicy
from up_runner.house import Policy
from up_runner.instance import Instance, State
from up_runner.instance_config import ConfigurationRefused
from up_runner.notification import Notification
from up_runner.process import Identity
from up_runner.record import Record
from up_runner.request import Request

BLACK_BOX = Policy(10.0, 2.0, 60.0, 5.0, RestartPolicy(0.25, 10.0, 5, 60.0), False)
AIRBORNE = Policy(10.0, 2.0, None, 5.0, RestartPolicy(0.25, 10.0, None, 60.0), True)
PORTS = {"general": 50001, "orientation": 50000}


class RecordedChild:
    """A process that the test controls completely."""

    def __init__(self, pid):
        self.pid = pid
        self.identity = Identity(pid, 1, "boot")
        self.signals = []
        self.watched = True
        self.on_end = None

    def terminate(self):
        self.signals.append("TERM")

    def kill(self):
        self.signals.append("KILL")

    def close(self):
        self.watched = False


class RecordingHouse:
    """The machine around an instance, under the test's control."""

    def __init__(self):
        self.clock = Clock()
        self.children = []
        self.records = []
        self.states = []
        self.ports = frozenset(PORTS.values())
        self.failing = None
        self.unheard = []
        self.hearing = None
        self.ear = None
        self.preparing = None
        self.instance = None

    def prepare(self, request):
        if self.preparing is not None:
            return self.preparing
        if self.failing is not None:
            return fail(self.failing)
        return succeed((Path("config"), os.open(os.devnull, os.O_WRONLY)))

    def listen(self, name, on_notification):
        self.hearing, self.ear = on_notification, "open"
        return self

    def drain(self):
        waiting, self.unheard = self.unheard, []
        for said in waiting:
            self.hearing(*said)

    def close(self, *, remove):
        self.ear = "removed" if remove else "left"

    def spawn(self, name, config, log):
        os.close(log)
        self.children.append(RecordedChild(1000 + len(self.children)))
        return self.children[-1]

    def open_ports(self, pid):
        return succeed(self.ports)

    def last_words(self, name):
        return succeed("the last words")

    def save(self, record):
        self.records.append(record)

    def forget(self, name):
        self.records.append(None)

    def on_change(self, name):
        if self.instance is not None:
            self.states.append(self.instance.state)

    @property
    def child(self):
        return self.children[-1]

    def make(self, policy=BLACK_BOX, **options):
        self.instance = Instance(Request("glider-1"), self.clock, policy, self, **options)
        return self.instance

    def say(self, **words):
        self.hearing(self.child.pid, Notification(**words))

    def run(self, policy=BLACK_BOX, **options):
        """Bring an instance to run and return it."""
        instance = self.make(policy, **options)
        self.begun = instance.start()
        self.say(ports=PORTS, ready=True)
        assert instance.state is State.RUNNING and self.result(self.begun) is None
        return instance

    def live(self, seconds, step_s=1.0):
        """Let time pass while the process gives signs of life."""
        for _ in range(round(seconds / step_s)):
            self.say(alive=True)
            self.clock.advance(step_s)

    def result(self, deferred):
        found = []
        deferred.addCallback(found.append)
        assert found, "there is no result yet"
        return found[0]


@pytest.fixture
def house():
    made = RecordingHouse()
    yield made
    if made.instance is not None and made.instance.state is not State.ENDED:
        made.instance.detach()
    assert made.clock.getDelayedCalls() == []


def test_it_runs_when_it_is_ready_and_its_ports_are_bound(house):
    instance = house.make()
    outcome = instance.start()
    assert instance.state is State.STARTING and not outcome.called
    house.say(ready=True, ports=PORTS)
    assert house.result(outcome) is None
    answer = instance.answer(spawned=True)
    assert (answer.pid, answer.ports, answer.spawned) == (1000, PORTS, True)
    assert house.records[-1] == Record(
        Request("glider-1"), house.child.identity, keep=True, ready=True, ports=PORTS
    )


def test_ready_without_the_ports_is_not_yet_ready(house):
    house.ports = frozenset([50001])
    instance = house.make()
    outcome = instance.start()
    house.say(ready=True, ports=PORTS)
    house.clock.advance(1)
    assert not outcome.called
    house.ports = frozenset(PORTS.values())
    house.clock.advance(0.1)
    assert instance.state is State.RUNNING and house.result(outcome) is None


def test_a_port_that_a_phone_needs_must_be_announced(house):
    instance = house.make(replace(BLACK_BOX, needed_ports=("general",)))
    outcome = instance.start()
    house.say(ready=True, ports={"orientation": 50000})
    house.clock.advance(1)
    assert instance.state is State.STARTING
    house.clock.advance(9)
    house.child.on_end(-signal.SIGKILL)
    assert house.result(outcome) == (
        "Raspilot said that it is ready but has not bound its port general within 10 s"
    )


def test_where_the_kernel_does_not_tell_its_word_is_taken(house):
    house.ports = None
    instance = house.make()
    instance.start()
    house.say(ready=True, ports=PORTS)
    assert instance.state is State.RUNNING


def test_signs_of_life_are_no_readiness(house):
    instance = house.make()
    outcome = instance.start()
    for _ in range(9):
        house.say(alive=True, ports=PORTS, status="soon")
        house.clock.advance(1)
    assert instance.state is State.STARTING
    house.clock.advance(1.5)
    assert house.child.signals == ["KILL"]
    house.child.on_end(-signal.SIGKILL)
    assert house.result(outcome) == "Raspilot did not say that it is ready within 10 s"
    assert instance.state is State.ENDED and house.records[-1] is None


def test_a_readiness_that_waits_in_the_socket_counts(house):
    instance = house.make()
    instance.start()
    house.unheard.append((1000, Notification(ready=True, ports=PORTS)))
    house.clock.advance(10)
    assert instance.state is State.RUNNING and house.child.signals == []


def test_another_process_is_not_heard(house):
    instance = house.make()
    instance.start()
    house.hearing(999, Notification(ready=True, ports={"general": 1}))
    assert instance.state is State.STARTING and instance.ports is None and instance.unheard == 1


@pytest.mark.parametrize("error", [ConfigurationRefused("no profile"), OSError("disk full")])
def test_what_cannot_be_prepared_is_told(house, error):
    house.failing = error
    instance = house.make()
    assert str(error) in house.result(instance.start())
    assert instance.state is State.ENDED and house.children == []


def test_the_exit_delay_of_minutes_runs_only_while_the_phone_is_gone(house):
    instance = house.run()
    house.live(59)
    house.say(phone=True)
    house.live(7200)
    assert instance.state is State.RUNNING
    house.say(phone=False)
    for _ in range(58):
        # Repeated, it gains no time.
        house.say(alive=True, phone=False)
        house.clock.advance(1)
    assert instance.state is State.RUNNING
    house.live(3)
    assert instance.state is State.STOPPING and house.child.signals == ["TERM"]
    house.child.on_end(0)
    assert instance.state is State.ENDED
    assert instance.last_end == "its phone was gone for 60 s (ended with exit status 0)"


def test_a_phone_that_came_back_in_the_last_moment_counts(house):
    instance = house.run()
    house.live(59)
    house.unheard.append((1000, Notification(phone=True, alive=True)))
    house.clock.advance(1)
    house.live(300)
    assert instance.state is State.RUNNING and house.child.signals == []


def test_a_phone_gone_for_a_day_never_stops_one_that_may_be_flying(house):
    instance = house.run(AIRBORNE)
    house.say(phone=True)
    house.say(phone=False)
    house.live(86_400, step_s=1.5)
    assert instance.state is State.RUNNING and house.child.signals == []


def test_one_that_does_not_obey_is_killed_after_five_seconds(house):
    instance = house.run()
    instance.stop("a reason")
    instance.stop("another")
    house.clock.advance(4.9)
    assert house.child.signals == ["TERM"]
    house.clock.advance(0.2)
    assert house.child.signals == ["TERM", "KILL"]
    house.child.on_end(-signal.SIGKILL)
    assert instance.last_end == "a reason (was ended by SIGKILL)"


def test_silence_is_a_hang(house):
    instance = house.run()
    house.live(30)
    house.clock.advance(2)
    assert house.child.signals == ["KILL"]
    house.child.on_end(-signal.SIGKILL)
    assert instance.state is State.WAITING
    assert instance.last_end == "Raspilot hung: no sign of life for 2 s"
    house.clock.advance(0.25)
    assert instance.state is State.STARTING and len(house.children) == 2


def test_a_sign_of_life_that_waits_in_the_socket_counts(house):
    instance = house.run()
    house.clock.advance(1.9)
    house.unheard.append((1000, Notification(alive=True)))
    house.clock.advance(0.2)
    assert house.child.signals == [] and instance.state is State.RUNNING


def test_without_a_watchdog_silence_is_golden(house):
    instance = house.run(replace(AIRBORNE, watchdog_s=None))
    house.clock.advance(86_400)
    assert instance.state is State.RUNNING and house.child.signals == []


def test_restarts_back_off_and_give_up(house):
    instance = house.run()
    for delay_s in (0.25, 0.5, 1.0, 2.0, 4.0):
        house.child.on_end(1)
        assert instance.state is State.WAITING
        assert house.records[-1] == Record(Request("glider-1"), None, keep=True)
        count = len(house.children)
        house.clock.advance(delay_s - 0.01)
        assert len(house.children) == count
        house.clock.advance(0.02)
        assert len(house.children) == count + 1
        house.say(ready=True, ports=PORTS)
    house.child.on_end(1)
    assert instance.state is State.ENDED
    assert instance.last_end == "Raspilot ended with exit status 1; given up after 5 restarts"


def test_one_that_may_be_flying_is_never_given_up(house):
    instance = house.run(AIRBORNE)
    for _ in range(200):
        house.child.on_end(-signal.SIGSEGV)
        assert instance.state is State.WAITING
        house.clock.advance(10)
        house.say(ready=True, ports=PORTS)
    assert instance.state is State.RUNNING and len(house.children) == 201


def test_a_restart_that_fails_is_tried_again(house):
    instance = house.run()
    house.child.on_end(1)
    house.clock.advance(0.25)
    asked = instance.outcome()
    house.child.on_end(2)
    assert "the last words; it is being started again" in house.result(asked)
    house.clock.advance(0.5)
    house.say(ready=True, ports=PORTS)
    assert instance.state is State.RUNNING


def test_a_first_start_that_fails_is_not_tried_again(house):
    instance = house.make()
    outcome = instance.start()
    house.child.on_end(2)
    assert instance.state is State.ENDED
    assert house.result(outcome) == (
        "Raspilot ended with exit status 2 while starting; its log says: the last words"
    )


def test_unless_it_shall_be_kept(house):
    instance = house.make(AIRBORNE, keep=True)
    instance.start()
    house.child.on_end(2)
    assert instance.state is State.WAITING and house.records[-1].keep


def test_one_that_says_that_it_ends_has_time_to_and_is_not_started_again(house):
    instance = house.run()
    house.say(stopping=True)
    house.clock.advance(4)
    assert house.child.signals == []
    house.clock.advance(2)
    assert house.child.signals == ["KILL"]
    house.child.on_end(-signal.SIGKILL)
    assert instance.state is State.ENDED


def test_stopped_while_it_waits_it_does_not_come_back(house):
    instance = house.run()
    house.child.on_end(1)
    ended = instance.when_ended()
    instance.stop("the runner stops")
    assert ended.called and instance.state is State.ENDED
    house.clock.advance(100)
    assert len(house.children) == 1


def test_stopped_while_it_is_prepared_no_process_is_started(house):
    house.preparing = Deferred()
    instance = house.make()
    outcome, ended = instance.start(), instance.when_ended()
    instance.stop("the runner stops")
    assert not ended.called
    house.preparing.callback((Path("config"), os.open(os.devnull, os.O_WRONLY)))
    assert ended.called and house.children == []
    assert house.result(outcome) == "the runner stops"


def test_detached_it_touches_nothing(house):
    instance = house.run()
    before = list(house.records)
    instance.detach()
    assert house.child.signals == [] and not house.child.watched
    assert house.ear == "left" and house.records == before


def test_adopted_it_gets_one_period_to_give_a_sign(house):
    instance = house.make()
    record = Record(instance.request, keep=True, ready=True, ports=PORTS, phone=True)
    house.children.append(RecordedChild(77))
    instance.adopt(house.child, record)
    assert instance.state is State.RUNNING and instance.answer(spawned=False).pid == 77
    house.live(300)
    assert instance.state is State.RUNNING
    house.clock.advance(2)
    assert house.child.signals == ["KILL"]


def test_adopted_without_word_of_the_phone_the_delay_begins(house):
    instance = house.make()
    house.children.append(RecordedChild(77))
    instance.adopt(house.child, Record(instance.request, keep=True, ready=True, ports=PORTS))
    house.live(61)
    assert instance.state is State.STOPPING


def test_a_bug_leaves_no_process_unwatched(house):
    instance = house.make()
    outcome = instance.start()
    looking = Deferred()
    house.open_ports = lambda pid: looking
    house.say(ready=True, ports=PORTS)
    looking.errback(ZeroDivisionError("a bug"))
    assert house.child.signals == ["KILL"] and instance.state is State.STOPPING
    house.child.on_end(-signal.SIGKILL)
    assert "the runner failed" in house.result(outcome)
