"""The satellite receivers aboard as sources of the location."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from twisted.internet.defer import maybeDeferred

from gps_cog.config import GPS, ReceiverConfig
from gps_cog.gpsd import GpsdDecoder
from gps_cog.receiver import Receiver
from gps_cog.serial_source import OpenPort, SerialSource
from up.base_started_module import BaseStartedModule
from up.commands.location_command import LocationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.mode import WITH_BOARD
from up.protocols.serial_port import open_serial

if TYPE_CHECKING:
    from gps_cog.gpsd_source import GpsdSource


class GpsProvider(BaseStartedModule):
    """Publishes the fixes of every receiver of gps.yml, with the receiver's name as source.

    An absent receiver is not a failure: its port, or gpsd, is tried again. The provider of the
    location chooses between the receivers and the phone by their priorities.
    """

    CONFIG = GPS
    MODES = WITH_BOARD

    open_port: OpenPort = staticmethod(open_serial)

    def on_init(self) -> None:
        self._receivers: dict[str, Receiver] = {}
        self._sources: list[SerialSource | GpsdSource] = []

    def load(self) -> bool:
        return bool(self.config.receivers)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        receivers = self._receivers.items()
        return {
            "gps": {name: receiver.telemetry for name, receiver in receivers},
            "counters": {f"gps_{name}": receiver.counters for name, receiver in receivers},
        }

    def on_start(self) -> bool:
        for name, config in self.config.receivers.items():
            self._sources.append(self._source(name, config))
        for source in self._sources:
            source.start()
        return True

    async def on_stop(self) -> None:
        sources, self._sources = self._sources, []
        for done in [maybeDeferred(source.stop) for source in sources]:
            await done

    def _source(self, name: str, config: ReceiverConfig) -> SerialSource | GpsdSource:
        origin = Origin(name, Role.SENSOR, config.priority)
        publish = partial(self._publish, origin)
        reactor = self.context.reactor
        decoder: Any
        if config.source == "gpsd":
            decoder = GpsdDecoder(config.gpsd_device)
        elif config.source == "nmea":
            # Imported here: their libraries cost memory.
            from gps_cog.nmea import NmeaDecoder

            decoder = NmeaDecoder()
        else:
            from gps_cog.ubx import UbxDecoder

            decoder = UbxDecoder(config.rate_hz, config.baud_rate)
        receiver = Receiver(config, decoder, reactor.seconds, publish)
        self._receivers[name] = receiver
        if config.source == "gpsd":
            from gps_cog.gpsd_source import GpsdSource

            return GpsdSource(reactor, config.gpsd_port, receiver, decoder.watch, self.log)
        return SerialSource(reactor, config, receiver, decoder, self._open, self.log)

    def _open(self, path: str, baud_rate: int) -> Any:
        return self.open_port(path, baud_rate)

    def _publish(self, origin: Origin, command: LocationCommand) -> None:
        self.up.command_executor.execute_command(command, origin)
