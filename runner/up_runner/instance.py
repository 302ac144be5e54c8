"""One Raspilot process of one aircraft: from the request that starts it to its end."""

from __future__ import annotations

import os
import signal

from twisted.internet.defer import Deferred
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.system.clock import Clock, Timer, cancel
from up_runner.instance_config import ConfigurationRefused
from up_runner.instance_host import InstanceHost
from up_runner.instance_machine import TRANSITIONS, Input, State
from up_runner.instance_state import InstanceState
from up_runner.notify_listener import Notification, NotifyListener
from up_runner.policy import Backoff, Policy
from up_runner.process import Process, describe_status
from up_runner.request import Request
from up_runner.response import BUG, Problem, Response
from up_runner.watchdog import Watchdog

KILL_DELAY_S = 5.0
PORT_CHECK_S = 0.1


class Instance:
    """Starts, watches, restarts and stops one process; `keep`: even if the first start fails.

    Only `_feed` changes the state, as `TRANSITIONS` lists; the other methods decide which input an
    event is, or are the outputs.
    """

    def __init__(
        self,
        request: Request,
        clock: Clock,
        policy: Policy,
        host: InstanceHost,
        *,
        keep: bool = False,
    ) -> None:
        self.name = request.aircraft
        self.request = request
        self.state = State.ENDED
        self.ports: dict[str, int] | None = None
        self.phone: bool | None = None
        self.armed: bool | None = None
        self.last_end: Problem | None = None
        self._clock = clock
        self._policy = policy
        self._host = host
        self._is_kept = keep
        self._log = Logger(namespace=f"runner.{self.name}")
        self._backoff = Backoff(policy.restarts, gives_up=not policy.always_restart)
        self._child: Process | None = None
        self._listener: NotifyListener | None = None
        self._is_ready = False
        self._is_stopping = False
        self._reason: Problem | None = None
        self._timer: Timer | None = None
        self._restart_delay_s = 0.0
        self._unbound: list[str] = []
        self._waiters: list[Deferred[Problem | None]] = []
        self._exit_waiters: list[Deferred[None]] = []
        self._start_limit = Watchdog(clock, policy.start_limit_s, self._on_start_limit)
        self._watchdog = Watchdog(clock, policy.watchdog_s or 0.0, self._on_silence)
        self._exit_delay = Watchdog(clock, policy.exit_delay_s or 0.0, self._on_phone_gone)

    @property
    def pid(self) -> int | None:
        return None if self._child is None else self._child.pid

    def start(self) -> Deferred[Problem | None]:
        """Start; fires with None once it runs with its ports bound, or with the failure."""
        outcome = self.outcome()
        self._feed(Input.START)
        return outcome

    def adopt(self, child: Process, saved: InstanceState) -> None:
        """Adopt the process of an earlier runner; raises OSError."""
        self._listen()
        self._take(child)
        self.ports, self.phone, self._is_kept = saved.ports, saved.phone, saved.keep
        text = "took over process {pid}, which is {state}"
        self._feed(Input.READY if saved.ready else Input.TAKE_OVER)
        self._log.info(text, code="taken_over", pid=child.pid, state=self.state.value)

    def resume(self) -> None:
        """Restart a process that ended while no runner watched it."""
        self._is_kept = True
        self._retry(Problem("ended_unwatched", "ended while no runner was watching"))

    def outcome(self) -> Deferred[Problem | None]:
        """Wait for the start: None once it runs, or its failure."""
        waiter: Deferred[Problem | None] = Deferred()
        self._waiters.append(waiter)
        return waiter

    def when_ended(self) -> Deferred[None]:
        waiter: Deferred[None] = Deferred()
        self._exit_waiters.append(waiter)
        return waiter

    def stop(self, reason: Problem) -> None:
        """Request the end of the process, and kill it after KILL_DELAY_S."""
        if self.state is State.WAITING:
            self._end(reason)  # there is no process
        elif (self.state, Input.STOP) in TRANSITIONS:
            self._log.info(
                "stops: {reason}", code="stopping", cause=reason.code, reason=str(reason)
            )
            self._reason = self.last_end = reason
            self._feed(Input.STOP)

    def kill(self, reason: Problem) -> None:
        """End the process without any delay; a pending restart does not happen."""
        if self.state is State.WAITING:
            self.stop(reason)
        elif (self.state, Input.KILL) in TRANSITIONS:
            self._log.error("{reason}; it is killed", code=reason.code, reason=str(reason))
            self._reason = self.last_end = reason
            self._feed(Input.KILL)

    def detach(self) -> None:
        self._feed(Input.DETACH)

    def response(self, *, spawned: bool, error: Problem | None = None) -> Response:
        if self.state is State.RUNNING:
            return Response(self.name, self.pid, self.ports, spawned and error is None, error)
        return Response(self.name, error=error)

    def waiting_problem(self) -> Problem:
        """Return what a client receives while the instance waits for its restart."""
        return Problem("restarting", f"{self.last_end}; it is being restarted")

    def on_notification(self, pid: int, notification: Notification) -> None:
        if self._child is None or pid != self._child.pid:
            return
        before = (self.ports, self.phone, self.armed)
        if notification.ports is not None:
            self.ports = dict(notification.ports)
        if notification.phone is not None:
            self.phone = notification.phone
        if notification.armed is not None:
            self.armed = notification.armed
        self._is_ready |= notification.ready
        if notification.stopping:
            self._on_stopping(self._child)
        elif self.state is State.STARTING and self._is_ready:
            self._check_ports()
        elif self.state is State.RUNNING:
            if notification.alive or notification.ready:
                self._reset_watchdog()
            if before != (self.ports, self.phone, self.armed):
                self._watch_phone()
                self._save()

    def _feed(self, input_: Input) -> None:
        """Change the state and cause the outputs; every transition cancels the timers."""
        transition = TRANSITIONS.get((self.state, input_))
        if transition is not None:
            self._cancel_timers()
            self.state, outputs = transition
            for output in outputs:
                getattr(self, f"_{output}")()

    def _retry(self, problem: Problem) -> None:
        """Restart after a delay, unless it ended too often."""
        self.last_end = problem
        delay_s = self._backoff.next_delay_s(self._clock.seconds())
        if delay_s is None:
            count = self._backoff.count - 1
            self._end(Problem("gave_up", f"{problem}; gave up after {count} restarts"))
            return
        text = "{error}; restarts in {delay:g} s"
        self._log.error(
            text, code="restarting", cause=problem.code, error=str(problem), delay=delay_s
        )
        self._restart_delay_s = delay_s
        self._feed(Input.RETRY)

    def _end(self, problem: Problem) -> None:
        self.last_end = problem
        text, cause = "ended: {error}", problem.code
        self._log.info(text, code="ended", aircraft=self.name, cause=cause, error=str(problem))
        self._feed(Input.END)

    def _notify(self) -> None:
        self._host.on_change(self.name)

    def _start_process(self) -> None:
        self._reason = None
        Deferred.fromCoroutine(self._spawn()).addErrback(self._on_bug)

    async def _spawn(self) -> None:
        try:
            config, log = await self._host.prepare(self.request)
            if self.state is not State.STARTING:
                os.close(log)
                if self.state is State.STOPPING:
                    self._end(self._reason or BUG)
                return
            self._listen()
            self._take(self._host.spawn(self.name, config, log))
        except ConfigurationRefused as refused:
            self._on_failure(refused.problem)
        except OSError as error:
            self._on_failure(Problem("cannot_spawn", f"Raspilot cannot be started: {error}"))
        else:
            self._save()
            self._log.info("starts as process {pid}", code="spawned", pid=self.pid)
            self._start_limit.reset()

    def _listen(self) -> None:
        if self._listener is None:
            self._listener = self._host.listen(self.name, self.on_notification)

    def _take(self, child: Process) -> None:
        self._child = child
        child.on_end = self._on_end
        self.ports = self.phone = self.armed = None
        self._is_ready = self._is_stopping = False

    def _check_ports(self) -> None:
        """Accept a process's report of bound ports if the kernel confirms it."""
        if self._timer is None and self._child is not None:
            checking = self._host.open_ports(self._child.pid)
            checking.addCallback(self._on_ports, self._child)
            checking.addErrback(self._on_bug)

    def _on_ports(self, found: frozenset[int] | None, child: Process) -> None:
        if self.state is not State.STARTING or child is not self._child:
            return
        self._unbound = self._policy.unbound(self.ports or {}, found)
        if not self._unbound:
            self._feed(Input.READY)
        elif self._timer is None:
            self._timer = self._clock.callLater(PORT_CHECK_S, self._recheck_ports)

    def _recheck_ports(self) -> None:
        self._timer = None
        self._check_ports()

    def _keep(self) -> None:
        """Restart it from now on when it ends."""
        self._is_kept = True
        text = "runs as process {pid}, ports {ports}"
        self._log.info(text, code="running", pid=self.pid, ports=str(self.ports))

    def _reset_start_limit(self) -> None:
        self._start_limit.reset()

    def _reset_watchdog(self) -> None:
        if self._policy.watchdog_s is not None:
            self._watchdog.reset()

    @property
    def _is_needed(self) -> bool:
        return bool(self.phone) or (self._policy.sleeps and self.armed is not False)

    def _watch_phone(self) -> None:
        if self._is_needed:
            self._exit_delay.stop()
        elif self._policy.exit_delay_s is not None and not self._exit_delay.running:
            # From the loss on; an instance that repeats the report gains no time.
            self._exit_delay.reset()

    def _on_start_limit(self) -> None:
        self._drain()
        if self.state is State.STARTING:
            self._kill_for(self._policy.late_start(self._unbound if self._is_ready else ()))

    def _on_silence(self) -> None:
        # The runner itself may have been blocked: first process the waiting notifications.
        self._drain()
        if not self._watchdog.running and self.state is State.RUNNING:
            self._kill_for(self._policy.hung())

    def _on_phone_gone(self) -> None:
        self._drain()
        if not self._is_needed and self.state is State.RUNNING:
            self.stop(self._policy.phone_gone())

    def _on_stopping(self, child: Process) -> None:
        """Limit the time of a process that announced its end."""
        self._is_stopping = True
        if self.state is State.RUNNING and self._timer is None:
            self._cancel_timers()
            self._timer = self._clock.callLater(KILL_DELAY_S, child.kill)

    def _kill_for(self, reason: Problem) -> None:
        self._reason = reason
        self._log.error("{reason}; it is killed", code=reason.code, reason=str(reason))
        self._kill()

    def _kill(self) -> None:
        if self._child is not None:
            self._child.kill()

    def _terminate(self) -> None:
        if self._child is not None:
            self._child.terminate()
            self._timer = self._clock.callLater(KILL_DELAY_S, self._child.kill)

    def _on_end(self, status: int | None) -> None:
        """Choose the next state after the end of the process."""
        self._drain()
        self._cancel_timers()
        self._child = None
        how = describe_status(status)
        exited = Problem("exited", f"Raspilot {how}")
        if self.state is State.STOPPING:
            reason = self._reason or BUG
            self._end(Problem(reason.code, f"{reason} ({how})"))
        elif self.state is State.RUNNING:
            clean = self._is_stopping or status in (0, -signal.SIGTERM)
            if clean and not self._policy.always_restart:
                self._end(exited)
            else:
                self._retry(self._reason or exited)
        elif self._reason is not None:
            self._on_failure(self._reason)
        else:
            reading = self._host.last_log_line(self.name)
            reading.addCallback(self._on_last_log_line, how)
            reading.addErrback(self._on_bug)

    def _on_last_log_line(self, line: str | None, how: str) -> None:
        cause = f"; its log ends: {line}" if line else ""
        self._on_failure(Problem("start_failed", f"Raspilot {how} while starting{cause}"))

    def _on_failure(self, problem: Problem) -> None:
        if self.state is State.STARTING and self._is_kept:
            self._retry(problem)
        else:
            self._end(problem)

    def _schedule_restart(self) -> None:
        self.ports = self.phone = None
        self._timer = self._clock.callLater(self._restart_delay_s, self._feed, Input.START)

    def _leave(self) -> None:
        if self._child is not None:
            self._child.close()
        if self._listener is not None:
            self._listener.close(remove=False)

    def _remove_traces(self) -> None:
        listener, self._listener = self._listener, None
        if listener is not None:
            listener.close(remove=True)
        self._host.discard(self.name)

    def _resolve_waiters(self) -> None:
        problem = self.waiting_problem() if self.state is State.WAITING else self.last_end
        waiters, self._waiters = self._waiters, []
        for waiter in waiters:
            waiter.callback(None if self.state is State.RUNNING else problem)

    def _resolve_exit_waiters(self) -> None:
        waiters, self._exit_waiters = self._exit_waiters, []
        for waiter in waiters:
            waiter.callback(None)

    def _cancel_timers(self) -> None:
        for watchdog in (self._start_limit, self._watchdog, self._exit_delay):
            watchdog.stop()
        timer, self._timer = self._timer, None
        cancel(timer)

    def _drain(self) -> None:
        if self._listener is not None:
            self._listener.drain()

    def _save(self) -> None:
        self._host.save(
            InstanceState(
                self.request,
                None if self._child is None else self._child.identity,
                keep=self._is_kept,
                ready=self.state is State.RUNNING,
                ports=self.ports,
                phone=self.phone,
            )
        )

    def _on_bug(self, failure: Failure) -> None:
        """Kill a process that would be left unwatched."""
        self._log.failure("a bug in the runner", failure, code="runner_bug")
        self._reason = BUG
        if self._child is None:
            self._end(BUG)
        else:
            self._feed(Input.KILL)
