"""A receiver on a serial port, at whatever speed it was left."""

from collections.abc import Callable
from typing import Any, Protocol

from twisted.logger import Logger

from gps_cog.config import SPEEDS, ReceiverConfig
from gps_cog.receiver import Receiver
from up.protocols.serial_line import SerialLike, SerialLine
from up.system.clock import Timer, cancel

SILENCE_S = 2.5
"""Without a valid message for this time another speed is tried."""
SET_UP_S = 0.3
"""How long the set-up takes at the lowest speed."""

OpenPort = Callable[[str, int], int | SerialLike]


class SerialDecoder(Protocol):
    """A format that is read from a serial port."""

    understood: int
    """How many messages were valid."""
    set_up: bytes
    """What the receiver is sent when the port opens; it sets the configured speed, too."""


class SerialSource:
    """Keeps the port open, sends the set-up, finds the receiver's speed.

    While nothing is understood the port is opened at one speed after the other. A receiver that is
    set up gets the set-up at each of them, which changes it to the configured one, and is expected
    there after each.
    """

    def __init__(
        self,
        reactor: Any,
        config: ReceiverConfig,
        receiver: Receiver,
        decoder: SerialDecoder,
        open_port: OpenPort,
        log: Logger,
    ) -> None:
        self._reactor = reactor
        self._path = config.port
        self._receiver = receiver
        self._decoder = decoder
        self._log = log
        self._speeds = [config.baud_rate, *(each for each in SPEEDS if each != config.baud_rate)]
        self._attempt = 0
        self._understood = 0
        self._is_reopening = False
        self._timer: Timer | None = None
        self._line = SerialLine(
            reactor,
            lambda: open_port(self._path, self.baud_rate),
            on_bytes=receiver.on_bytes,
            on_opened=self._on_opened,
            on_lost=self._on_lost,
            on_open_failed=self._on_open_failed,
        )

    @property
    def baud_rate(self) -> int:
        if not self._decoder.set_up:
            return self._speeds[self._attempt % len(self._speeds)]
        if self._is_at_configured:
            return self._speeds[0]
        return self._speeds[1 + self._attempt // 2 % (len(self._speeds) - 1)]

    @property
    def _is_at_configured(self) -> bool:
        return self._attempt % 2 == 0

    def start(self) -> None:
        self._line.start()

    def stop(self) -> None:
        cancel(self._timer)
        self._line.stop()

    def _on_opened(self) -> None:
        self._receiver.decoder.reset()
        if self._decoder.set_up:
            self._line.write(self._decoder.set_up)
        is_passing = bool(self._decoder.set_up) and not self._is_at_configured
        self._watch(SET_UP_S if is_passing else SILENCE_S)

    def _on_lost(self, why: str) -> None:
        cancel(self._timer)
        if not self._is_reopening:
            self._log.warn("lost {path}: {reason}", path=self._path, reason=why, code="port_lost")

    def _on_open_failed(self, why: str) -> None:
        self._log.warn("{reason}; trying again", reason=why, code="port_unavailable")

    def _watch(self, wait_s: float) -> None:
        self._understood = self._decoder.understood
        cancel(self._timer)
        self._timer = self._reactor.callLater(wait_s, self._check)

    def _check(self) -> None:
        """Stay with a receiver that is understood; otherwise try the next speed."""
        if self._decoder.understood > self._understood:
            self._watch(SILENCE_S)
            return
        if self._attempt == 0:
            text = "nothing is understood on {path} at {baud_rate} baud: trying other speeds"
            self._log.warn(text, path=self._path, baud_rate=self.baud_rate, code="receiver_silent")
        self._attempt += 1
        self._is_reopening = True
        self._line.reopen()
        self._is_reopening = False
