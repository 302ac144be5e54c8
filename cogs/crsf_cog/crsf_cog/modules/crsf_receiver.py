"""The CRSF receiver at the Raspberry Pi."""

from collections.abc import Callable, Mapping
from typing import Any

from crsf_cog.config import CRSF
from crsf_cog.frames import CHANNELS, LINK_STATISTICS, CrsfDecoder, LinkStatistics, channels_us
from crsf_cog.mode_channel import ModeChannel
from crsf_cog.transmitter import telemetry_frames
from up.base_started_module import BaseStartedModule
from up.commands.flight_state_command import FlightModeCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.telemetry_commands import TelemetryCommand
from up.mode import WITH_BOARD
from up.protocols.general_message import GeneralMessage, decode
from up.protocols.serial_line import SerialLike, SerialLine
from up.protocols.serial_port import open_serial
from up.telemetry_frame import Frame

LINK = "crsf"
ORIGIN = Origin(LINK, Role.SENSOR, -10)
"""Below the Arduino's inputs."""
MAX_STATISTICS_AGE_S = 1.0


class CrsfReceiver(BaseStartedModule):
    """Publishes what the receiver of crsf.yml receives, and sends telemetry to the transmitter.

    The channels are valid while the receiver reports a link quality above 0: in failsafe it
    may continue to send channels. The mode channel sends ``up.flight_mode.set`` with the rights of
    an operator. An absent receiver is not a failure: its port is tried again.
    """

    CONFIG = CRSF
    MODES = WITH_BOARD

    open_port: Callable[[str, int], int | SerialLike] = staticmethod(open_serial)

    def load(self) -> bool:
        return bool(self.config.port)

    def on_init(self) -> None:
        self._decoder = CrsfDecoder()
        self._counters = self._decoder.counters
        self._channels: list[int] = []
        self._channels_s = 0.0
        self._statistics: LinkStatistics | None = None
        self._statistics_s = 0.0
        self._selections = 0
        config, reactor = self.config, self.context.reactor
        self._seconds = reactor.seconds
        self._mode_channel = ModeChannel(config.modes)
        self.link = self.up.open_link(LINK, Role.OPERATOR, self._on_answer)
        self._line = SerialLine(
            reactor,
            lambda: self.open_port(config.port, config.baud_rate),
            on_bytes=self._on_bytes,
            on_opened=self._decoder.reset,
            on_lost=self._on_lost,
            on_open_failed=self._on_open_failed,
        )
        if config.telemetry:
            self.up.command_executor.register_command(TelemetryCommand, self._on_telemetry)

    def on_start(self) -> bool:
        self._line.start()
        return True

    def on_stop(self) -> None:
        self._line.stop()

    @property
    def is_linked(self) -> bool:
        """Return whether the receiver reports that it receives the transmitter."""
        if self._seconds() - self._statistics_s > MAX_STATISTICS_AGE_S:
            return False
        return self._statistics is not None and self._statistics.link_quality > 0

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        age_ms = round((self._seconds() - self._channels_s) * 1000) if self._channels else None
        content = {"linked": self.is_linked, "age_ms": age_ms, "channels": self._channels}
        if self._statistics is not None:
            content |= self._statistics._asdict()
        return {"crsf": content, "counters": {"crsf": dict(self._counters)}}

    def _on_bytes(self, data: bytes) -> None:
        channels = None
        for type_, payload in self._decoder.feed(data):
            if type_ == CHANNELS:
                channels = payload
                self._counters["channels"] += 1
            elif type_ == LINK_STATISTICS:
                self._statistics = LinkStatistics.of(payload)
                self._statistics_s = self._seconds()
                self._counters["statistics"] += 1
            else:
                self._counters["other"] += 1
        if channels is not None:
            self._on_channels(channels_us(channels))

    def _on_channels(self, channels: list[int]) -> None:
        self._channels, self._channels_s = channels, self._seconds()
        config, is_linked = self.config, self.is_linked
        if config.sticks:
            a, e, t, r = (channels[config.sticks.index(each)] for each in "AETR")
            valid = ALL_VALID if is_linked else 0
            command = RXCommand(a, e, t, r, channels[4], channels[5], valid)
            self.up.command_executor.execute_command(command, ORIGIN)
        if config.mode_channel is not None:
            pulse_us = channels[config.mode_channel - 1] if is_linked else None
            if mode := self._mode_channel.update(pulse_us, self._channels_s):
                self._select(mode)

    def _select(self, mode: str) -> None:
        self._selections += 1
        command = FlightModeCommand(mode)
        message = GeneralMessage(command.NAME, command.data, f"crsf {self._selections}")
        self.up.command_receiver.receive(message, self.link)

    def _on_answer(self, line: bytes) -> None:
        answer = decode(line).data
        code = answer.get("detail") or answer.get("code")
        self._counters[f"refused_{code}" if code else "selected"] += 1

    def _on_telemetry(self, command: TelemetryCommand) -> None:
        frames = telemetry_frames(Frame(command.content))
        if frames and self._line.is_open:
            self._line.write_newest("telemetry", frames)

    def _on_lost(self, why: str) -> None:
        self.log.warn("lost the receiver: {reason}", reason=why, code="port_lost")

    def _on_open_failed(self, why: str) -> None:
        self.log.warn("{reason}; trying again", reason=why, code="port_unavailable")
