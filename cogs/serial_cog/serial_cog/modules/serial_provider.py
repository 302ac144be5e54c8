"""The serial line as a module: frames in both directions (thesis 3.1.2, 3.2.2)."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any, Protocol

from serial_cog.config import ARDUINO, SerialConfig, odd_speed
from serial_cog.handlers import FrameHandler, FrameType, HandlerTable, type_byte
from serial_cog.port_opener import Lister, PortOpener, list_ports
from up.base_started_module import BaseStartedModule
from up.commands.command_executor import owner_of
from up.mode import WITH_BOARD
from up.protocols.frame import UNFINISHED_TIMEOUT_S, Frame
from up.protocols.framing import FrameDecoder, FrameEncoder, make_framing
from up.protocols.serial_line import SerialLine
from up.protocols.serial_port import open_serial
from up.system.clock import Timer, cancel

TRY_ANOTHER_AFTER_S = 5.0


class SerialListener(Protocol):
    """The callbacks of a user of the line, apart from frames."""

    def on_line_opened(self) -> None:
        """The port was opened or reopened."""

    def on_line_lost(self) -> None:
        """The port is gone."""

    def on_line_heard(self) -> None:
        """Frames arrive: the first one is about to be handled."""

    def on_line_silent(self) -> None:
        """Frames stopped."""


class SerialProvider(BaseStartedModule):
    """Finds, opens and keeps the serial port; hands frames to handlers and sends frames.

    An absent Arduino is not a failure. ``connected`` means that frames arrived within
    ``silence_s``. A handler that raises is logged with its name and counted; the others still run.
    """

    CONFIG = ARDUINO
    MODES = WITH_BOARD
    FLIGHT_CONTROLLERS = frozenset({"arduino", "raspberry"})
    DATA_SOURCE = True

    lister: Lister = staticmethod(list_ports)
    open_port: Callable[[str, int], int] = staticmethod(open_serial)

    def on_init(self) -> None:
        self.counters: Counter[str] = Counter()
        self._table = HandlerTable()
        self._handlers = self._table.by_type
        self._listeners: list[SerialListener] = []
        self._line: SerialLine | None = None
        self._retired: Counter[str] = Counter()
        self._named: set[tuple[str, int]] = set()
        self._is_receiving = False
        self._last_rx_s = 0.0
        self._bytes_s = 0.0
        self._newest_frame: Frame | None = None
        self._expiry: Timer | None = None
        self._silence: Timer | None = None

    @property
    def framing(self) -> str:
        config: SerialConfig = self.config
        return config.framing

    @property
    def port(self) -> str:
        """Return the current or last open port; empty before the first."""
        return self._opener.path if self._line is not None else ""

    @property
    def baud_rate(self) -> int:
        config: SerialConfig = self.config
        return config.baud_rate

    @property
    def connected(self) -> bool:
        """Return whether frames arrived within the last ``silence_s`` seconds."""
        return self._is_receiving

    @property
    def is_source_open(self) -> bool:
        return self._line is not None and self._line.is_open

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        counts: Counter[str] = Counter(self.counters)
        counts.update(self._retired)
        if self._line is not None:
            for part in (self._decoder.counters, self._line.counters):
                counts.update({name: getattr(part, name) for name in part.__slots__})
        return {"counters": {"serial": dict(counts)}}

    def add_handler(
        self,
        type_: FrameType,
        handler: FrameHandler,
        payload_size: int = 0,
        *,
        least: int | None = None,
    ) -> None:
        """Call ``handler(payload)`` with the frames of a type; raises ValueError.

        A frame of another payload size than ``payload_size``, or of a type without a handler, is
        dropped and counted. With ``least`` any size from it on is taken in checked framing, for
        messages to which other versions of the firmware append fields.
        """
        if self._table.add(type_, handler, payload_size, least) and self._line is not None:
            self._renew_decoder()

    def remove_handler(self, type_: FrameType, handler: FrameHandler | None = None) -> None:
        """Remove one handler of a type, or all of them; raises KeyError for an unknown one."""
        if self._table.remove(type_, handler) and self._line is not None:
            self._renew_decoder()

    def add_listener(self, listener: SerialListener) -> None:
        """Notify ``listener`` when the port opens and closes, and when frames begin and end."""
        self._listeners.append(listener)

    def send_command(
        self, type_: FrameType, data: bytes = b"", newest_only: bool = False
    ) -> int | None:
        """Send a frame in one write; return its sequence, or None if it was not sent.

        The sequence is 0 in thesis framing. With ``newest_only`` it replaces a waiting frame of the
        same type. Raises ValueError for more than 96 bytes of data.
        """
        line = self._line
        if line is None or not line.is_open:
            return None
        number = type_ if isinstance(type_, int) else type_byte(type_)
        encoder = self._encoder
        frame = encoder.encode(number, data)
        if newest_only:
            line.write_newest(number, frame)
        elif not line.write(frame):
            return None
        return encoder.last_sequence

    def on_start(self) -> bool:
        config: SerialConfig = self.config
        self._encoder: FrameEncoder
        self._decoder: FrameDecoder
        self._encoder, self._decoder = make_framing(
            config.framing, self._table.sizes, self._table.least
        )
        self._is_numbered = config.framing == "checked"
        self._seconds = self.context.reactor.seconds
        self._opener = PortOpener(config.port, config.baud_rate, self.lister, self.open_port)
        warning = odd_speed(config)
        if warning:
            self.log.warn("{reason}", reason=warning, code="speed_unusual")
        self._line = SerialLine(
            self.context.reactor,
            self._opener,
            on_bytes=self._on_bytes,
            on_opened=self._on_opened,
            on_lost=self._on_lost,
            on_open_failed=self._on_open_failed,
        )
        self._line.start()
        return True

    def on_stop(self) -> None:
        cancel(self._expiry, self._silence)
        self._expiry = self._silence = None
        if self._line is not None:
            self._line.stop()
        self._is_receiving = False

    def _renew_decoder(self) -> None:
        """Set the decoder's known types; its counters are kept."""
        self._retired.update(asdict(self._decoder.counters))
        _, self._decoder = make_framing(self.framing, self._table.sizes, self._table.least)

    def _on_opened(self) -> None:
        assert self._line is not None
        self.log.info(
            "opened {path} at {baud_rate} baud, {framing}",
            path=self._opener.path,
            baud_rate=self.baud_rate,
            framing=self.framing,
            code="port_opened",
        )
        self._decoder.reset()
        self._newest_frame = None
        if self._encoder.opening:
            self._line.write(self._encoder.opening)
        self._last_rx_s = self._seconds()
        self._watch_silence()
        for listener in self._listeners:
            listener.on_line_opened()

    def _on_lost(self, why: str) -> None:
        self.log.warn(
            "lost {path}: {reason}; waiting for {wanted}",
            path=self._opener.path,
            reason=why,
            wanted=self._opener.wanted,
            code="port_lost",
        )
        self._on_silence()
        for listener in self._listeners:
            listener.on_line_lost()

    def _on_open_failed(self, why: str) -> None:
        self.log.warn("{reason}; trying again", reason=why, code="port_unavailable")

    def _on_bytes(self, data: bytes) -> None:
        """Hand the frames in ``data`` to their handlers; all input goes through here."""
        now_s = self._bytes_s = self._seconds()
        frames = self._decoder.feed(data, now_s)
        if self._expiry is None:
            self._expiry = self.context.reactor.callLater(UNFINISHED_TIMEOUT_S, self._expire)
        if frames:
            self._handle(frames, now_s)

    def _handle(self, frames: list[Frame], now_s: float) -> None:
        self._last_rx_s = now_s
        if not self._is_receiving:
            self._is_receiving = True
            for listener in self._listeners:
                listener.on_line_heard()
        handlers = self._handlers
        newest = self._newest_frame
        for frame in frames:
            # The sequence is part of the frame; in thesis framing equal frames are not duplicates.
            if frame == newest and self._is_numbered:
                self.counters["duplicates"] += 1
                continue
            newest = frame
            for handler in handlers.get(frame[0], ()):
                try:
                    handler(frame[1])
                except Exception:  # noqa: BLE001 - a fault in one handler must not affect others
                    self._handler_failed(handler, frame[0])
        self._newest_frame = newest

    def _handler_failed(self, handler: FrameHandler, type_: int) -> None:
        self.counters["failed_handlers"] += 1
        name = owner_of(handler)
        if (name, type_) in self._named:
            return
        self._named.add((name, type_))
        self.log.failure(
            "{name} failed while handling {type!r} (logged once, then counted)",
            name=name,
            type=chr(type_),
            code="handler_failed",
        )

    def _expire(self) -> None:
        """Drop an unfinished frame 100 ms after its newest byte."""
        now_s = self._seconds()
        left_s = self._bytes_s + UNFINISHED_TIMEOUT_S - now_s
        if left_s > 0:
            self._expiry = self.context.reactor.callLater(left_s, self._expire)
            return
        self._expiry = None
        frames = self._decoder.expire(now_s)
        if frames:
            self._handle(frames, now_s)

    def _watch_silence(self) -> None:
        if self._silence is None:
            limit_s = self.config.silence_s
            self._silence = self.context.reactor.callLater(limit_s, self._check_silence)

    def _check_silence(self) -> None:
        self._silence = None
        if not self.is_source_open:
            return
        limit_s: float = self.config.silence_s
        silent_s = self._seconds() - self._last_rx_s
        if self._is_receiving and silent_s >= limit_s:
            self.log.warn(
                "no frame for {limit_s:g} s on {path}",
                limit_s=limit_s,
                path=self._opener.path,
                code="line_silent",
            )
            self._on_silence()
        if silent_s >= TRY_ANOTHER_AFTER_S and self._opener.has_another():
            self.log.warn(
                "nothing is understood on {path}: trying another port",
                path=self._opener.path,
                code="port_skipped",
            )
            self._opener.pass_over()
            assert self._line is not None
            self._line.reopen()
            return
        wait_s = limit_s - silent_s if self._is_receiving else limit_s
        self._silence = self.context.reactor.callLater(wait_s, self._check_silence)

    def _on_silence(self) -> None:
        if self._is_receiving:
            self._is_receiving = False
            for listener in self._listeners:
                listener.on_line_silent()
