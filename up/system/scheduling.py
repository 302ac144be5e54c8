"""Real-time priority, where the system permits it."""

import os

from twisted.logger import Logger

log = Logger()


def use_realtime_priority(priority: int) -> bool:
    """Run this process under SCHED_FIFO with a priority of 1 to 99; 0 changes nothing.

    Returns whether the system permitted it; logs a refusal with the remedy.
    """
    if priority == 0:
        return False
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except PermissionError:
        log.warn(
            "real-time priority {priority} is not permitted: run as root, or let systemd do it"
            " (CPUSchedulingPolicy=fifo) or 'ulimit -r'; continuing without it",
            priority=priority,
            code="realtime_denied",
        )
        return False
    except OSError as error:
        log.warn(
            "cannot set real-time priority: {error}; continuing without it",
            error=error,
            code="realtime_failed",
        )
        return False
    log.info("real-time priority {priority} (SCHED_FIFO)", priority=priority, code="realtime_set")
    return True
