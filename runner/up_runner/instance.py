"""One Raspilot process of one aircraft: from the request that starts it to its end."""

from __future__ import annotations

import enum
import os
import signal

from twisted.internet.defer import Deferred
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.system.clock import Clock, Timer
from up_runner.answer import Answer
from up_runner.backoff import Backoff
from up_runner.deadline import Deadline
from up_runner.house import Child, Ear, House, Policy
from up_runner.instance_config import ConfigurationRefused
from up_runner.notification import Notification
from up_runner.process import describe_status
from up_runner.record import Record
from up_runner.request import Request

PORT_LOOK_S = 0.1


class State(enum.Enum):
    """The life cycle state of an instance."""

    STARTING = "starting"
    RUNNING = "running"
    STOPPING = "stopping"
    WAITING = "waiting to start again"
    ENDED = "ended"


class Instance:
    """Starts, watches, restarts and stops one process; `keep`: even if the first start fails."""

    def __init__(
        self, request: Request, clock: Clock, policy: Policy, house: House, *, keep: bool = False
    ) -> None:
        self.name = request.aircraft
        self.request = request
        self.state = State.ENDED
        self.ports: dict[str, int] | None = None
        self.phone: bool | None = None
        self.last_end: str | None = None
        self.unheard = 0
        """Notifications from another process than the instance's."""
        self._clock = clock
        self._policy = policy
        self._house = house
        self._keep = keep
        self._log = Logger(namespace=f"runner.{self.name}")
        self._backoff = Backoff(policy.restarts)
        self._child: Child | None = None
        self._ear: Ear | None = None
        self._said_ready = False
        self._said_stopping = False
        self._was_ready = False
        self._detached = False
        self._why: str | None = None
        self._timer: Timer | None = None
        self._missing: list[str] = []
        self._waiting: list[Deferred[str | None]] = []
        self._mourners: list[Deferred[None]] = []
        self._start_limit = Deadline(clock, policy.start_limit_s, self._on_start_limit)
        self._watchdog = Deadline(clock, policy.watchdog_s or 0.0, self._on_silence)
        self._exit_delay = Deadline(clock, policy.exit_delay_s or 0.0, self._on_phone_gone)

    @property
    def pid(self) -> int | None:
        """Return the process number, None without a process."""
        return None if self._child is None else self._child.pid

    def start(self) -> Deferred[str | None]:
        """Start; fires with None once it runs with its ports bound, or with the failure."""
        outcome = self.outcome()
        self._begin()
        return outcome

    def adopt(self, child: Child, record: Record) -> None:
        """Adopt the process of an earlier runner; raises OSError."""
        self._listen()
        self._take(child)
        self.ports, self.phone = record.ports, record.phone
        self._was_ready = record.keep
        if record.ready:
            self._log.info("took over process {pid}, which runs", pid=child.pid)
            self._on_running()
        else:
            self._log.info("took over process {pid}, which was starting", pid=child.pid)
            self._set(State.STARTING)
            self._start_limit.touch()

    def resume(self) -> None:
        """Restart a process that ended while no runner watched it."""
        self._was_ready = True
        self._go_on("ended while no runner was there to see it")

    def outcome(self) -> Deferred[str | None]:
        """Wait for the start: None once it runs, or one sentence if it fails."""
        waiting: Deferred[str | None] = Deferred()
        self._waiting.append(waiting)
        return waiting

    def when_ended(self) -> Deferred[None]:
        """Fire when it has ended permanently."""
        ended: Deferred[None] = Deferred()
        self._mourners.append(ended)
        return ended

    def stop(self, why: str) -> None:
        """Request the end of the process, and kill it after `kill_delay_s`."""
        if self.state in (State.STOPPING, State.ENDED):
            return
        self._log.info("stops: {why}", why=why)
        self._why = why
        waited, child = self.state is State.WAITING, self._child
        self._set(State.STOPPING)
        self._rest()
        if child is not None:
            child.terminate()
            self._timer = self._clock.callLater(self._policy.kill_delay_s, child.kill)
        elif waited:
            self._end(why)

    def detach(self) -> None:
        """Leave the process to the next runner."""
        self._detached = True
        self._rest()
        if self._child is not None:
            self._child.close()
        if self._ear is not None:
            self._ear.close(remove=False)

    def answer(self, *, spawned: bool, error: str | None = None) -> Answer:
        """Return the current state."""
        if self.state is State.RUNNING:
            return Answer(self.name, self.pid, self.ports, spawned and error is None, error)
        return Answer(self.name, error=error)

    def on_notification(self, pid: int, said: Notification) -> None:
        """Handle a notification of process `pid`."""
        if self._child is None or pid != self._child.pid:
            self.unheard += 1
            return
        before = (self.ports, self.phone)
        if said.ports is not None:
            self.ports = dict(said.ports)
        if said.phone is not None:
            self.phone = said.phone
        self._said_ready |= said.ready
        if said.stopping:
            self._on_stopping()
        elif self.state is State.STARTING and self._said_ready:
            self._confirm()
        elif self.state is State.RUNNING:
            if said.alive or said.ready:
                self._touch_watchdog()
            if before != (self.ports, self.phone):
                self._watch_phone()
                self._save()

    def _begin(self) -> None:
        self._set(State.STARTING)
        self._why = None
        Deferred.fromCoroutine(self._spawn()).addErrback(self._on_bug)

    async def _spawn(self) -> None:
        try:
            config, log = await self._house.prepare(self.request)
            if self.state is not State.STARTING or self._detached:
                os.close(log)
                self._on_stopped_early()
                return
            self._listen()
            self._take(self._house.spawn(self.name, config, log))
        except ConfigurationRefused as refused:
            self._on_failure(str(refused))
        except OSError as error:
            self._on_failure(f"Raspilot cannot be started: {error}")
        else:
            self._save()
            self._log.info("starts as process {pid}", pid=self.pid)
            self._start_limit.touch()

    def _on_stopped_early(self) -> None:
        """The stop arrived before anything was started."""
        if not self._detached:
            self._end(self._why or "stopped")

    def _listen(self) -> None:
        if self._ear is None:
            self._ear = self._house.listen(self.name, self.on_notification)

    def _take(self, child: Child) -> None:
        self._child = child
        child.on_end = self._on_end
        self.ports = self.phone = None
        self._said_ready = self._said_stopping = False

    def _confirm(self) -> None:
        """Accept a process's report of bound ports if the kernel confirms it."""
        if self._timer is None and self._child is not None:
            looking = self._house.open_ports(self._child.pid)
            looking.addCallback(self._on_ports, self._child)
            looking.addErrback(self._on_bug)

    def _on_ports(self, found: frozenset[int] | None, child: Child) -> None:
        if self.state is not State.STARTING or child is not self._child:
            return
        ports = self.ports or {}
        missing = [name for name in self._policy.needed_ports if name not in ports]
        if found is not None:
            missing += [f"{name} {port}" for name, port in ports.items() if port not in found]
        self._missing = missing
        if not missing:
            self._on_running()
        elif self._timer is None:
            self._timer = self._clock.callLater(PORT_LOOK_S, self._look_again)

    def _look_again(self) -> None:
        self._timer = None
        self._confirm()

    def _on_running(self) -> None:
        self._rest()
        self._was_ready = True
        self._set(State.RUNNING)
        self._touch_watchdog()
        self._watch_phone()
        self._save()
        self._log.info("runs as process {pid}, ports {ports}", pid=self.pid, ports=self.ports)
        self._tell(None)

    def _touch_watchdog(self) -> None:
        if self._policy.watchdog_s is not None:
            self._watchdog.touch()

    def _watch_phone(self) -> None:
        if self.phone:
            self._exit_delay.stop()
        elif self._policy.exit_delay_s is not None and not self._exit_delay.running:
            # From the loss on; an instance that repeats the report gains no time.
            self._exit_delay.touch()

    def _on_start_limit(self) -> None:
        self._drain()
        if self.state is not State.STARTING:
            return
        missing = "did not say that it is ready"
        if self._said_ready and self._missing:
            missing = f"said that it is ready but has not bound its port {self._missing[0]}"
        self._kill(f"Raspilot {missing} within {self._policy.start_limit_s:g} s")

    def _on_silence(self) -> None:
        # The runner itself may have been blocked: first process the socket's waiting notifications.
        self._drain()
        if not self._watchdog.running and self.state is State.RUNNING:
            self._kill(f"Raspilot hung: no sign of life for {self._policy.watchdog_s:g} s")

    def _on_phone_gone(self) -> None:
        self._drain()
        if not self.phone and self.state is State.RUNNING:
            self.stop(f"its phone was gone for {self._policy.exit_delay_s:g} s")

    def _on_stopping(self) -> None:
        """Limit the time of a process that announced its end."""
        self._said_stopping = True
        if self.state is State.RUNNING and self._timer is None and self._child is not None:
            self._rest()
            self._timer = self._clock.callLater(self._policy.kill_delay_s, self._child.kill)

    def _kill(self, why: str) -> None:
        self._why = why
        self._log.error("{why}; it is killed", why=why)
        if self._child is not None:
            self._child.kill()

    def _on_end(self, status: int | None) -> None:
        self._drain()
        self._rest()
        state, self._child = self.state, None
        how = describe_status(status)
        if state is State.STOPPING:
            self._end(f"{self._why} ({how})")
        elif state is State.RUNNING:
            clean = self._said_stopping or status in (0, -signal.SIGTERM)
            if clean and not self._policy.always_restart:
                self._end(f"Raspilot {how}")
            else:
                self._go_on(self._why or f"Raspilot {how}")
        elif self._why is not None:
            self._on_failure(self._why)
        else:
            explaining = self._house.last_words(self.name)
            explaining.addCallback(self._explain, how)
            explaining.addErrback(self._on_bug)

    def _explain(self, line: str | None, how: str) -> None:
        said = f"; its log says: {line}" if line else ""
        self._on_failure(f"Raspilot {how} while starting{said}")

    def _on_failure(self, error: str) -> None:
        """A start failed."""
        self._rest()
        if self.state is State.STARTING and (self._was_ready or self._keep):
            self._go_on(error)
        else:
            self._end(error)

    def _go_on(self, error: str) -> None:
        """Restart after a delay, unless it ended too often."""
        self.last_end = error
        delay_s = self._backoff.next_delay_s(self._clock.seconds())
        if delay_s is None:
            self._end(f"{error}; given up after {self._backoff.count - 1} restarts")
            return
        self._log.error("{error}; starts again in {delay:g} s", error=error, delay=delay_s)
        self.ports = self.phone = None
        self._set(State.WAITING)
        self._timer = self._clock.callLater(delay_s, self._restart)
        self._save()
        self._tell(self.waiting_text())

    def waiting_text(self) -> str:
        """Return the sentence for a client while the instance waits for its restart."""
        return f"{self.last_end}; it is being started again"

    def _restart(self) -> None:
        self._timer = None
        self._begin()

    def _end(self, error: str) -> None:
        self._rest()
        self.last_end = error
        self._log.info("ended: {error}", error=error)
        if self._ear is not None:
            self._ear.close(remove=True)
            self._ear = None
        self._house.forget(self.name)
        self._set(State.ENDED)
        self._tell(error)
        mourners, self._mourners = self._mourners, []
        for mourner in mourners:
            mourner.callback(None)

    def _tell(self, error: str | None) -> None:
        waiting, self._waiting = self._waiting, []
        for each in waiting:
            each.callback(error)

    def _rest(self) -> None:
        """Cancel all timers."""
        for deadline in (self._start_limit, self._watchdog, self._exit_delay):
            deadline.stop()
        timer, self._timer = self._timer, None
        if timer is not None and timer.active():
            timer.cancel()

    def _drain(self) -> None:
        if self._ear is not None:
            self._ear.drain()

    def _save(self) -> None:
        identity = None if self._child is None else self._child.identity
        self._house.save(
            Record(
                self.request,
                identity,
                keep=self._was_ready or self._keep,
                ready=self.state is State.RUNNING,
                ports=self.ports,
                phone=self.phone,
            )
        )

    def _set(self, state: State) -> None:
        self.state = state
        self._house.on_change(self.name)

    def _on_bug(self, failure: Failure) -> None:
        """Kill a process that would be left unwatched."""
        self._log.failure("a bug in the runner", failure)
        if self._child is None:
            self._end("the runner failed, see its log")
        else:
            self._rest()
            self._why = "the runner failed, see its log"
            self._set(State.STOPPING)
            self._child.kill()
