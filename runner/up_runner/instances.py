"""All instances of a runner: one per aircraft, limited in number, found again after a restart."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from twisted.internet.defer import Deferred, DeferredList
from twisted.logger import Logger

from up.system.clock import Clock
from up.system.figures import Figure
from up.system.token_bucket import TokenBucket
from up_runner.config import KeyQuota, RunnerConfig
from up_runner.instance import Instance
from up_runner.instance_host import InstanceHost
from up_runner.instance_machine import State
from up_runner.instance_state import InstanceState
from up_runner.log_maintenance import LogMaintenance
from up_runner.policy import policy_of
from up_runner.process import Identity, Process, ProcessGone, identity_of
from up_runner.request import Request
from up_runner.response import Problem, Response, failed

FAILURE_CACHE_S = 1.0
_MAX_CACHED = 100
STOPPING = Problem("stopping", "the runner is stopping")


class Instances:
    """Starts and finds instances, within the limits of the configuration."""

    def __init__(
        self, host: InstanceHost, config: RunnerConfig, on_change: Callable[[], None]
    ) -> None:
        self._host = host
        self._policy = policy_of(config)
        self._limit = config.instances
        self._starts = KeyStarts(host.reactor, config.key_quota)
        self._on_change = on_change
        self.on_end: Callable[[Instance], object] = lambda instance: None
        """Called with each instance that has ended for good."""
        self._instances: dict[str, Instance] = {}
        self._maintenance = LogMaintenance(
            host, config.kept_instances, lambda: list(self._instances)
        )
        self.is_closed = False
        self._failures: dict[str, tuple[float, Request, Problem]] = {}
        self._log = Logger(namespace="runner")
        host.on_change = self._on_instance_change

    def __len__(self) -> int:
        return len(self._instances)

    def summary(self) -> str:
        shown = [
            f"{each.name} {each.state.value}" + (f" ({each.pid})" if each.pid else "")
            for each in self._instances.values()
        ]
        text = f"{len(shown)} of {self._limit} instances"
        return text + (": " if shown else "") + ", ".join(shown)

    def states(self) -> dict[str, State]:
        return {name: each.state for name, each in self._instances.items()}

    def figures(self) -> Iterator[Figure]:
        states = self.states()
        for state in State:
            text = "Instances by state."
            count = sum(each is state for each in states.values())
            yield Figure("up_runner_instances", text, count, {"state": state.name.lower()})
        for name, each in states.items():
            text = "1 while the instance of an aircraft runs."
            yield Figure("up_runner_running", text, each is State.RUNNING, {"aircraft": name})

    def open(self) -> None:
        """Adopt the instances of an earlier runner, and start maintaining the logs."""
        running = dict(self._host.running())
        for name in sorted({*self._host.run_folder.names(), *running}):
            self._recover(name, self._host.load(name), running.get(name))
        self._maintenance.start()
        self._maintenance.prune()

    async def spawn(self, request: Request, *, keep: bool = False) -> Response:
        """Start the aircraft's instance unless it runs, and return its state.

        With `keep` it is restarted even if its first start fails.
        """
        name = request.aircraft
        while (instance := self._instances.get(name)) is not None:
            if instance.state is State.STOPPING:
                await instance.when_ended()
            elif instance.state is State.WAITING:
                return instance.response(spawned=False, error=instance.waiting_problem())
            else:
                return await self._join(instance, request)
        if self.is_closed:
            return Response(name, error=STOPPING)
        if len(self._instances) >= self._limit:
            text = f"all {self._limit} instances of this host are in use"
            return failed(name, "instance_limit", text)
        if (error := self._recent_failure(request)) is not None:
            return Response(name, error=error)
        if request.key:
            running = sum(each.request.key == request.key for each in self._instances.values())
            if (error := self._starts.count(request.key, running)) is not None:
                return Response(name, error=error)
        instance = Instance(request, self._host.reactor, self._policy, self._host, keep=keep)
        self._instances[name] = instance
        error = await instance.start()
        if error is not None:
            self._cache_failure(request, error)
        return instance.response(spawned=True, error=error)

    def status(self, name: str) -> Response:
        """Return the state of the aircraft's instance without starting it."""
        instance = self._instances.get(name)
        if instance is None:
            return Response(name)
        if instance.state is State.RUNNING:
            return instance.response(spawned=False)
        state = instance.state
        problem = Problem(state.name.lower(), f"Raspilot is {state.value}")
        return instance.response(spawned=False, error=problem)

    @property
    def free(self) -> int:
        return 0 if self.is_closed else max(0, self._limit - len(self._instances))

    def get(self, name: str) -> Instance | None:
        return self._instances.get(name)

    def stop_all(self) -> Deferred[Any]:
        """Stop every instance and accept no new one; fires when all have ended."""
        self.is_closed = True
        ends = []
        for instance in list(self._instances.values()):
            ends.append(instance.when_ended())
            instance.stop(STOPPING)
        return DeferredList(ends)

    def close(self) -> None:
        """Leave the running instances to the next runner."""
        self.is_closed = True
        self._maintenance.stop()
        for instance in self._instances.values():
            instance.detach()
        self._instances.clear()

    async def _join(self, instance: Instance, request: Request) -> Response:
        """Handle a request for an instance that another request started."""
        if instance.state is State.STARTING and (error := await instance.outcome()):
            return instance.response(spawned=False, error=error)
        error = None
        if request.wants_configuration and not request.same_configuration(instance.request):
            text = f"{instance.name} runs with another configuration, which was not changed"
            error = Problem("other_configuration", text)
        return instance.response(spawned=False, error=error)

    def _recent_failure(self, request: Request) -> Problem | None:
        """Return why the same request failed within FAILURE_CACHE_S; it is then not tried again.

        Otherwise a phone that repeats its request would keep the machine busy with failing starts.
        """
        at_s, failed, error = self._failures.get(request.aircraft, (0.0, None, None))
        is_recent = self._host.reactor.seconds() - at_s < FAILURE_CACHE_S
        return error if is_recent and failed == request else None

    def _cache_failure(self, request: Request, error: Problem) -> None:
        if len(self._failures) >= _MAX_CACHED:
            self._failures.clear()
        self._failures[request.aircraft] = (self._host.reactor.seconds(), request, error)

    def _on_instance_change(self, name: str) -> None:
        instance = self._instances.get(name)
        if instance is not None and instance.state is State.ENDED:
            del self._instances[name]
            self.on_end(instance)
            if not self.is_closed:
                self._maintenance.prune()
        self._on_change()

    def _recover(self, name: str, saved: InstanceState | None, pid: int | None) -> None:
        """Adopt, restart or remove an instance of an earlier runner."""
        child = None
        if saved is not None and saved.identity is not None:
            child = self._adopt(saved.identity)
        if child is None and pid is not None:
            # Started, but that runner ended before it could save the state.
            child = self._adopt(pid)
            request = saved.request if saved else Request(name)
            saved = InstanceState(request, keep=bool(saved and saved.keep))
        if saved is None or (child is None and not saved.keep):
            self._host.discard(name)
            return
        instance = Instance(saved.request, self._host.reactor, self._policy, self._host)
        self._instances[name] = instance
        if child is None:
            instance.resume()
            return
        try:
            instance.adopt(child, saved)
        except OSError as error:
            text = "cannot receive notifications of {name}: {error}"
            self._log.error(text, code="not_adopted", name=name, error=str(error))
            del self._instances[name]
            child.close()

    def _adopt(self, who: Identity | int) -> Process | None:
        try:
            identity = identity_of(who) if isinstance(who, int) else who
            return Process.adopt(self._host.reactor, identity)
        except ProcessGone:
            return None


class KeyStarts:
    """The quota of each key; starts before a restart of the runner are forgotten."""

    def __init__(self, clock: Clock, quota: KeyQuota) -> None:
        self._clock = clock
        self._quota = quota
        self._buckets: dict[str, TokenBucket] = {}

    def count(self, key: str, running: int) -> Problem | None:
        """Count a start by a key with so many instances, or return why it is refused."""
        if running >= self._quota.instances:
            text = f"all {self._quota.instances} instances of this key are in use"
            return Problem("key_instances", text)
        limit = self._quota.starts_per_minute
        bucket = self._buckets.get(key)
        if bucket is None:
            bucket = self._buckets[key] = TokenBucket(self._clock, limit / 60, limit)
        if not bucket.take():
            return Problem("key_starts", f"this key has started {limit} instances within a minute")
        return None
