"""The states of an instance, and the transitions that are allowed in each."""

from __future__ import annotations

import enum


class State(enum.Enum):
    """The states of an instance; the value is for people."""

    STARTING = "starting"
    RUNNING = "running"
    STOPPING = "stopping"
    WAITING = "waiting to restart"
    ENDED = "ended"
    DETACHED = "left to the next runner"


class Input(enum.Enum):
    """The inputs of an instance."""

    START = "a request, or the end of the delay before a restart"
    TAKE_OVER = "an earlier runner's process that has not bound its ports yet"
    READY = "the kernel confirms the ports of the process"
    STOP = "a request to stop"
    KILL = "a bug of the runner: the process must not stay unwatched"
    RETRY = "the process ended, or did not start, and is restarted"
    END = "the process ended, or did not start, and is not restarted"
    DETACH = "the runner ends without its instances"


_S, _I = State, Input
_RUN = ("keep", "notify", "reset_watchdog", "watch_phone", "save", "resolve_waiters")
_WAIT = ("schedule_restart", "notify", "save", "resolve_waiters")
_FINISH = ("remove_traces", "notify", "resolve_waiters", "resolve_exit_waiters")
_LEAVE = ("leave",)

TRANSITIONS: dict[tuple[State, Input], tuple[State, tuple[str, ...]]] = {
    (_S.ENDED, _I.START): (_S.STARTING, ("notify", "start_process")),
    (_S.ENDED, _I.TAKE_OVER): (_S.STARTING, ("notify", "reset_start_limit")),
    (_S.ENDED, _I.READY): (_S.RUNNING, _RUN),
    (_S.ENDED, _I.RETRY): (_S.WAITING, _WAIT),
    (_S.ENDED, _I.END): (_S.ENDED, _FINISH),
    (_S.STARTING, _I.READY): (_S.RUNNING, _RUN),
    (_S.STARTING, _I.STOP): (_S.STOPPING, ("notify", "terminate")),
    (_S.STARTING, _I.KILL): (_S.STOPPING, ("notify", "kill")),
    (_S.STARTING, _I.RETRY): (_S.WAITING, _WAIT),
    (_S.STARTING, _I.END): (_S.ENDED, _FINISH),
    (_S.STARTING, _I.DETACH): (_S.DETACHED, _LEAVE),
    (_S.RUNNING, _I.STOP): (_S.STOPPING, ("notify", "terminate")),
    (_S.RUNNING, _I.KILL): (_S.STOPPING, ("notify", "kill")),
    (_S.RUNNING, _I.RETRY): (_S.WAITING, _WAIT),
    (_S.RUNNING, _I.END): (_S.ENDED, _FINISH),
    (_S.RUNNING, _I.DETACH): (_S.DETACHED, _LEAVE),
    (_S.STOPPING, _I.KILL): (_S.STOPPING, ("notify", "kill")),
    (_S.STOPPING, _I.END): (_S.ENDED, _FINISH),
    (_S.STOPPING, _I.DETACH): (_S.DETACHED, _LEAVE),
    (_S.WAITING, _I.START): (_S.STARTING, ("notify", "start_process")),
    (_S.WAITING, _I.END): (_S.ENDED, _FINISH),
    (_S.WAITING, _I.DETACH): (_S.DETACHED, _LEAVE),
}
"""The next state and the outputs, methods of `Instance`. Other inputs change nothing."""
