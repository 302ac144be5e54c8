"""Telemetry as text on the pilot's goggles."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

from twisted.internet.task import LoopingCall

from msp_cog.codec import REQUEST, MspDecoder
from msp_cog.displayport import (
    CLEAR,
    DRAW,
    HEARTBEAT,
    RELEASE,
    SET_OSD_CANVAS,
    answer,
    answers,
    operation,
)
from msp_cog.osd_config import OSD
from msp_cog.osd_screen import OsdScreen
from msp_cog.osd_texts import OsdTexts
from up.base_started_module import BaseStartedModule
from up.commands.telemetry_commands import TelemetryCommand
from up.log.limits import Once
from up.protocols.serial_line import SerialLike, SerialLine
from up.protocols.serial_port import open_serial
from up.telemetry_frame import Frame

MAX_WARNINGS = 4
TICK_S = 0.1
TICKS_OF_ROW = 5
"""A row is sent again after this many ticks, one after the other: lost bytes are repaired."""


class GogglesOsd(BaseStartedModule):
    """Draws the elements of osd.yml by MSP DisplayPort; what arrives has no effect on the flight.

    Each tick sends a heartbeat and the characters that changed, within ``bytes_per_s``. Requests
    of the goggles are answered from the rest; no request is a Command.
    """

    CONFIG = OSD

    open_port: Callable[[str, int], int | SerialLike] = staticmethod(open_serial)

    def load(self) -> bool:
        return bool(self.config.port)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        canvas, line = self._canvas, self._line
        counters = {**self.counters, **asdict(self._decoder.counters), **asdict(line.counters)}
        return {
            "osd": {"is_open": line.is_open, "goggles": canvas and "{}x{}".format(*canvas)},
            "counters": {"osd": counters},
        }

    def on_init(self) -> None:
        self.counters: Counter[str] = Counter()
        self._decoder = MspDecoder((REQUEST,))
        self._texts = OsdTexts()
        self._canvas: tuple[int, int] | None = None
        self._ticks = self._left = 0
        self._said = Once(MAX_WARNINGS)
        config, reactor = self.config, self.context.reactor
        self._seconds = reactor.seconds
        self._screen = OsdScreen(*config.size)
        self._places = config.places
        self._line = SerialLine(
            reactor,
            lambda: self.open_port(config.port, config.baud_rate),
            on_bytes=self._on_bytes,
            on_opened=self._on_opened,
            on_lost=lambda why: self.log.warn("lost the goggles: {why}", why=why, code="port_lost"),
            on_open_failed=lambda why: self.log.warn(
                "{why}; trying again", why=why, code="port_unavailable"
            ),
        )
        self._loop = LoopingCall(self._tick)
        self._loop.clock = reactor
        self.up.command_executor.register_command(TelemetryCommand, self._on_telemetry)

    def on_start(self) -> bool:
        self._line.start()
        self._loop.start(TICK_S)
        return True

    async def on_stop(self) -> None:
        if self._loop.running:
            self._loop.stop()
        # Values that stay on the screen would look live.
        await self._line.end(operation(CLEAR) + operation(DRAW) + operation(RELEASE))

    def _on_telemetry(self, command: TelemetryCommand) -> None:
        self._texts.update(Frame(command.content), self._seconds())

    def _on_opened(self) -> None:
        self._decoder.reset()
        self._line.write(operation(CLEAR))
        self._screen.clear()

    def _tick(self) -> None:
        if not self._line.is_open:
            return
        self._ticks += 1
        self._left = int(self.config.bytes_per_s * TICK_S)
        now_s = self._seconds()
        self._screen.put_all(self._places, lambda name: self._texts.text(name, now_s))
        if self._ticks % TICKS_OF_ROW == 0:
            self._screen.forget(self._ticks // TICKS_OF_ROW % self._screen.grid[1])
        begin, end = operation(HEARTBEAT), operation(DRAW)
        changes = self._screen.changes(self._left - len(begin) - len(end))
        self._send(begin + changes + (end if changes else b""))

    def _send(self, frames: bytes) -> None:
        self._left -= len(frames)
        self._line.write(frames)

    def _on_bytes(self, data: bytes) -> None:
        for number, payload in self._decoder.feed(data):
            if number == SET_OSD_CANVAS:
                self._on_canvas(payload)
            known = answers(self._screen.grid, is_armed=self._texts.is_armed)
            frame = answer(number, known)
            if number not in known:
                self.counters["other"] += 1
            if len(frame) > self._left:
                self.counters["unanswered"] += 1
            else:
                self._send(frame)

    def _on_canvas(self, payload: bytes) -> None:
        """Compare the grid that the goggles announce, at their start, with that of osd.yml."""
        if len(payload) != 2:
            self.counters["invalid"] += 1
            return
        self._screen.forget()
        columns, rows = payload
        if (columns, rows) != self._screen.grid and self._said.first((columns, rows)):
            self.log.warn(
                "the goggles have {columns}x{rows} characters, osd.yml has grid: {grid}",
                columns=columns,
                rows=rows,
                grid=self.config.grid,
                code="grid_differs",
            )
        self._canvas = columns, rows
