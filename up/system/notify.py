"""Notifications to systemd: ready, stopping, status, watchdog."""

import os
import socket
from collections.abc import Callable, Mapping

from up.system.clock import Clock, Timer, cancel


class Notifier:
    """Sends sd_notify datagrams; does nothing without a supervisor.

    Source: sd_notify(3). `address` is the value of NOTIFY_SOCKET: a path, or a name in the abstract
    namespace when it begins with `@`; None or empty without a supervisor.
    """

    def __init__(self, address: str | None) -> None:
        self._address: str | bytes | None = address or None
        if address and address.startswith("@"):
            self._address = b"\0" + os.fsencode(address[1:])

    @classmethod
    def from_environment(cls, environ: Mapping[str, str] = os.environ) -> "Notifier":
        return cls(environ.get("NOTIFY_SOCKET"))

    def ready(self, status: str = "") -> bool:
        return self._send("READY=1", status)

    def stopping(self, status: str = "") -> bool:
        return self._send("STOPPING=1", status)

    def status(self, text: str) -> bool:
        """Set the status line of `systemctl status`; return whether the datagram was sent."""
        return self._send("", text)

    def variable(self, name: str, value: str) -> bool:
        """Send a custom value, such as bound ports; systemd ignores names with X_."""
        return self._send(f"{name}={value}".replace("\n", " "), "")

    def watchdog(self) -> bool:
        """Send a watchdog ping; return whether the datagram was sent."""
        return self._send("WATCHDOG=1", "")

    def _send(self, state: str, status: str) -> bool:
        if self._address is None:
            return False
        words = [state] if state else []
        if status:
            words.append("STATUS=" + status.replace("\n", " "))
        try:
            with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) as line:
                line.setblocking(False)
                line.sendto("\n".join(words).encode("utf-8", "replace"), self._address)
        except OSError:
            # A supervisor that is gone or busy must never harm the program that it supervises.
            return False
        return True


def watchdog_period_s(environ: Mapping[str, str] = os.environ) -> float | None:
    """Return the watchdog's period in seconds, None if this process has no watchdog."""
    usec = environ.get("WATCHDOG_USEC", "")
    pid = environ.get("WATCHDOG_PID", "")
    if not (usec.isascii() and usec.isdigit()) or int(usec) == 0:
        return None
    if pid and pid != str(os.getpid()):
        return None
    return int(usec) / 1e6


class WatchdogPinger:
    """Pings the supervisor at half the watchdog period, only while `healthy()`.

    Without WATCHDOG_USEC in the environment `start` does nothing.
    """

    def __init__(
        self,
        clock: Clock,
        healthy: Callable[[], bool],
        notifier: Notifier | None = None,
        environ: Mapping[str, str] = os.environ,
    ) -> None:
        self._clock = clock
        self._healthy = healthy
        self._notifier = notifier or Notifier.from_environment(environ)
        period_s = watchdog_period_s(environ)
        self.interval_s = None if period_s is None else period_s / 2
        self._call: Timer | None = None

    def start(self) -> None:
        if self.interval_s is not None and self._call is None:
            self._ping()

    def stop(self) -> None:
        call, self._call = self._call, None
        cancel(call)

    def _ping(self) -> None:
        assert self.interval_s is not None
        self._call = self._clock.callLater(self.interval_s, self._ping)
        if self._healthy():
            self._notifier.watchdog()
