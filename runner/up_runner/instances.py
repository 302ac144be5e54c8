"""All instances of a runner: one per aircraft, limited in number, found again after a restart."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred, DeferredList
from twisted.logger import Logger

from up_runner.answer import Answer
from up_runner.host import Host
from up_runner.house import Policy
from up_runner.instance import Instance, State
from up_runner.process import Identity, Process, ProcessGone, identity_of
from up_runner.record import Record
from up_runner.request import Request
from up_runner.upkeep import Upkeep

SAME_AGAIN_S = 1.0
_REMEMBERED = 100


class Instances:
    """Starts and finds instances; runs at most `limit`, keeps the files of `kept` ended ones."""

    def __init__(
        self,
        host: Host,
        policy: Policy,
        *,
        limit: int,
        kept: int,
        on_change: Callable[[], None] = lambda: None,
    ) -> None:
        self._host = host
        self._policy = policy
        self._limit = limit
        self._on_change = on_change
        self._instances: dict[str, Instance] = {}
        self._upkeep = Upkeep(host, kept, lambda: list(self._instances))
        self._closed = False
        self._failures: dict[str, tuple[float, Request, str]] = {}
        self._log = Logger(namespace="runner")
        host.on_change = self._on_instance_change

    def __len__(self) -> int:
        return len(self._instances)

    def summary(self) -> str:
        """Return one line about all instances."""
        shown = [
            f"{each.name} {each.state.value}" + (f" ({each.pid})" if each.pid else "")
            for each in self._instances.values()
        ]
        text = f"{len(shown)} of {self._limit} instances"
        return text + (": " if shown else "") + ", ".join(shown)

    def open(self) -> None:
        """Adopt the instances of an earlier runner, and start maintaining the logs."""
        running = dict(self._host.running())
        for name in sorted({*self._host.run_folder.names(), *running}):
            self._find(name, self._host.load(name), running.get(name))
        self._upkeep.start()
        self._upkeep.prune()

    async def spawn(self, request: Request, *, keep: bool = False) -> Answer:
        """Start the aircraft's instance unless it runs, and return its state.

        With `keep` it is restarted even if its first start fails.
        """
        name = request.aircraft
        while (instance := self._instances.get(name)) is not None:
            if instance.state is State.STOPPING:
                await instance.when_ended()
            elif instance.state is State.WAITING:
                return instance.answer(spawned=False, error=instance.waiting_text())
            else:
                return await self._join(instance, request)
        if self._closed:
            return Answer(name, error="the runner is stopping")
        if len(self._instances) >= self._limit:
            return Answer(name, error=f"all {self._limit} instances of this host are in use")
        if (error := self._failed_just_now(request)) is not None:
            return Answer(name, error=error)
        instance = Instance(request, self._host.reactor, self._policy, self._host, keep=keep)
        self._instances[name] = instance
        error = await instance.start()
        if error is not None:
            self._remember_failure(request, error)
        return instance.answer(spawned=True, error=error)

    def status(self, name: str) -> Answer:
        """Return the state of the aircraft's instance without starting it."""
        instance = self._instances.get(name)
        if instance is None:
            return Answer(name)
        if instance.state is State.RUNNING:
            return instance.answer(spawned=False)
        return instance.answer(spawned=False, error=f"Raspilot is {instance.state.value}")

    def stop_all(self) -> Deferred[Any]:
        """Stop every instance and accept no new one; fires when all have ended."""
        self._closed = True
        ends = []
        for instance in list(self._instances.values()):
            ends.append(instance.when_ended())
            instance.stop("the runner stops")
        return DeferredList(ends)

    def close(self) -> None:
        """Leave the running instances to the next runner."""
        self._closed = True
        self._upkeep.stop()
        for instance in self._instances.values():
            instance.detach()
        self._instances.clear()

    async def _join(self, instance: Instance, request: Request) -> Answer:
        """Answer a request for an instance that another request started."""
        if instance.state is State.STARTING and (error := await instance.outcome()):
            return instance.answer(spawned=False, error=error)
        error = None
        if request.wants_configuration and not request.same_configuration(instance.request):
            error = f"{instance.name} runs with another configuration, which was not changed"
        return instance.answer(spawned=False, error=error)

    def _failed_just_now(self, request: Request) -> str | None:
        """Return why the same request failed a moment ago; it is then not tried again.

        Otherwise a phone that repeats itself would keep the machine busy with failing starts.
        """
        at_s, failed, error = self._failures.get(request.aircraft, (0.0, None, ""))
        is_recent = self._host.reactor.seconds() - at_s < SAME_AGAIN_S
        return error if is_recent and failed == request else None

    def _remember_failure(self, request: Request, error: str) -> None:
        if len(self._failures) >= _REMEMBERED:
            self._failures.clear()
        self._failures[request.aircraft] = (self._host.reactor.seconds(), request, error)

    def _on_instance_change(self, name: str) -> None:
        instance = self._instances.get(name)
        if instance is not None and instance.state is State.ENDED:
            del self._instances[name]
            if not self._closed:
                self._upkeep.prune()
        self._on_change()

    def _find(self, name: str, kept: Record | None, pid: int | None) -> None:
        """Adopt, restart or remove an instance of an earlier runner."""
        child = None
        if kept is not None and kept.identity is not None:
            child = self._held(kept.identity)
        if child is None and pid is not None:
            # Started, but that runner ended before it could write the record.
            child = self._held_by_number(pid)
            kept = Record(kept.request if kept else Request(name), keep=bool(kept and kept.keep))
        if kept is None or (child is None and not kept.keep):
            self._host.forget(name)
            return
        instance = Instance(kept.request, self._host.reactor, self._policy, self._host)
        self._instances[name] = instance
        if child is None:
            instance.resume()
            return
        try:
            instance.adopt(child, kept)
        except OSError as error:
            self._log.error("{name} cannot be heard: {error}", name=name, error=error)
            del self._instances[name]
            child.close()

    def _held(self, identity: Identity) -> Process | None:
        try:
            return Process.adopt(self._host.reactor, identity)
        except ProcessGone:
            return None

    def _held_by_number(self, pid: int) -> Process | None:
        try:
            return self._held(identity_of(pid))
        except ProcessGone:
            return None
