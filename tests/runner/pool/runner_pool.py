"""Runners of one pool as real processes, and a history of what their instances did."""

import contextlib
import itertools
import os
import signal
from contextlib import ExitStack

from tests.runner.runners import RunnerProcess, wait_until
from tests.support.scrape import probe, scrape
from up.system.deadline_watch import PERIOD_S

GAP_S = 1.0
TENANTS = itertools.count(1)
LEASE_S = 4
"""Short for the tests; a renewal every 0.8 s."""


class RunnerPool:
    """`count` runners, each with its own NATS server first in its list, or with that one alone."""

    def __init__(self, servers, folder, count=3, *, alone=(), files=None, pool=(), **config):
        self.servers = servers
        self.history = folder / "history"
        self._stack = ExitStack()
        self.runners = []
        self.tenant = f"tenant{next(TENANTS)}"
        urls = servers.urls.split(",")
        for number in range(count):
            ordered = [*urls[number:], *urls[:number]]
            section = {
                "servers": ",".join(ordered[:1] if number in alone else ordered),
                "address": f"127.0.0.{number + 1}",
                "labels": [f"host{number}", "any"],
                "lease": LEASE_S,
                "tenant": self.tenant,
                "replicas": len(urls),
                **dict(pool),
            }
            more = {"metrics port": 0, **config}
            runner = RunnerProcess(folder / str(number), pool=section, **more)
            behaviour = {"keeps deadline": True, "history": str(self.history)}
            for name, content in (files or {"behaviour.yml": behaviour}).items():
                runner.write(f"blackbox/{name}", content)
            self.runners.append(runner)
            self._stack.callback(runner.clean)

    def __enter__(self):
        try:
            self.repair()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for runner in self.runners:
            if runner.process is not None:
                runner.process.send_signal(signal.SIGCONT)
        self.close()

    def close(self):
        self._stack.close()

    def repair(self):
        """Start the runners that do not run, and wait until all know the places of all."""
        ended = [each for each in self.runners if each.process is None]
        for runner in ended:
            runner.start()
        for runner in ended:
            runner.logs("pool_ready")
        others = len(self.runners) - 1
        for runner in self.runners:
            wait_until(
                lambda r=runner: self.figure(r, "runners") == others, "the runners know each other"
            )
        wait_until(self._is_consistent, "every runner knows the free places of the others")

    def _is_consistent(self):
        """Return whether all are ready, and the others' last heartbeats show that, too."""
        if any(self.health(each) != (200, "ready") for each in self.runners):
            return False
        return len({self.figure(each, "free") for each in self.runners}) == 1

    def host_of(self, answer):
        """Return the runner that an answer names."""
        return self.runners[int(answer["host"].rpartition(".")[2]) - 1]

    @staticmethod
    def figure(runner, name):
        return scrape(runner.logs("metrics_open")["port"])[(f"up_runner_pool_{name}",)]

    @staticmethod
    def health(runner):
        """Return status and code of its readiness."""
        return probe(runner.logs("metrics_open")["port"], "ready")

    def label_of(self, runner):
        """Return a label that only this runner has."""
        return f"host{self.runners.index(runner)}"

    def others(self, runner):
        return [each for each in self.runners if each is not runner]

    def kill_host(self, runner):
        """End a runner and all its instances, as the end of their machine would."""
        runner.process.send_signal(signal.SIGSTOP)
        for pid in runner.instances():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        runner.kill()

    def running_at(self, runner, aircraft):
        """Wait until an aircraft's instance runs, as this runner answers; return the answer."""

        def find():
            answer = runner.status(aircraft)
            return answer if answer["running"] else None

        return wait_until(find, f"{aircraft} runs")


def lives(path, aircraft):
    """Return begin, end and process of each uninterrupted life of an aircraft's instances.

    A process that was suspended may do something for 0.1 s when it continues: until its watch ends
    it. Such a life counts only if it is longer than twice that.
    """
    found = {}
    for line in path.read_text().splitlines():
        name, pid, at_s = line.split()
        if name != aircraft:
            continue
        spans = found.setdefault(pid, [])
        if not spans or float(at_s) - spans[-1][1] > GAP_S:
            spans.append([float(at_s), float(at_s)])
        spans[-1][1] = float(at_s)
    return sorted(
        (begin_s, end_s, pid)
        for pid, spans in found.items()
        for number, (begin_s, end_s) in enumerate(spans)
        if number == 0 or end_s - begin_s > 2 * PERIOD_S
    )


def doubles(spans):
    """Return the neighbours, by their begins, of which one began before the other had ended."""
    found, last = [], None
    for span in spans:
        if last is not None and span[0] <= last[1] and span[2] != last[2]:
            found.append((last[2], span[2]))
        last = span if last is None or span[1] > last[1] else last
    return found
