"""The machine around an instance of the runner, under the test's control and in virtual time."""

import os
from pathlib import Path

from twisted.internet.defer import fail, succeed
from twisted.internet.task import Clock

from up_runner.config import Restarts
from up_runner.instance import Instance
from up_runner.instance_machine import State
from up_runner.notify_listener import Notification
from up_runner.policy import Policy
from up_runner.process import Identity
from up_runner.request import Request
from up_runner.response import Problem

BLACK_BOX = Policy(10.0, 2.0, 60.0, Restarts(), False)
AIRBORNE = Policy(10.0, 2.0, None, Restarts(), True)
STOPPING = Problem("stopping", "the runner is stopping")
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


class RecordingHost:
    """The machine around an instance, under the test's control."""

    def __init__(self):
        self.clock = Clock()
        self.children = []
        self.records = []
        self.states = []
        self.ports = frozenset(PORTS.values())
        self.failing = None
        self.waiting = []
        self.notify = None
        self.listener = None
        self.preparing = None
        self.instance = None

    def prepare(self, request):
        if self.preparing is not None:
            return self.preparing
        if self.failing is not None:
            return fail(self.failing)
        return succeed((Path("config"), os.open(os.devnull, os.O_WRONLY)))

    def listen(self, name, on_notification):
        self.notify, self.listener = on_notification, "open"
        return self

    def drain(self):
        waiting, self.waiting = self.waiting, []
        for said in waiting:
            self.notify(*said)

    def close(self, *, remove):
        self.listener = "removed" if remove else "left"

    def spawn(self, name, config, log):
        os.close(log)
        self.children.append(RecordedChild(1000 + len(self.children)))
        return self.children[-1]

    def open_ports(self, pid):
        return succeed(self.ports)

    def last_log_line(self, name):
        return succeed("segfault")

    def save(self, record):
        self.records.append(record)

    def discard(self, name):
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
        self.notify(self.child.pid, Notification(**words))

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
        deferred.addCallback(lambda result: found.append(result) or result)
        assert found, "there is no result yet"
        return found[0]
