"""A ground station that speaks MAVLink, at the daemon's TCP port.

The numbers of the modes are those of ArduPlane's documentation, the messages pymavlink's.
"""

from __future__ import annotations

from typing import Any

from twisted.internet.protocol import ClientFactory, Protocol, connectionDone
from twisted.internet.task import LoopingCall
from twisted.python.failure import Failure

from up.errors import UserError
from up_mavlink.dialect import load_dialect
from up_simulator.harness.participants import ParticipantError
from up_simulator.in_process.config_folder import MAVLINK_PORT
from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.reactor import SimulatedReactor

PERIOD_S = 1.0
SYSTEM_ID, COMPONENT_ID = 255, 190
"""Of a ground station, as QGroundControl uses them."""
AIRCRAFT, AUTOPILOT = 1, 1
MODES = {
    "MANUAL": 0, "CIRCLE": 1, "ACRO": 4, "FBWA": 5, "CRUISE": 7, "AUTO": 10, "RTL": 11,
    "LOITER": 12, "TAKEOFF": 13, "GUIDED": 15,
}  # fmt: skip
_NAMES = {number: name for name, number in MODES.items()}


class MavlinkGround:
    """Reads everything, and sends a heartbeat every second unless ``is_silent``; it reconnects.

    ``mode`` is the aircraft's, by ArduPlane's name, otherwise its number; ``ack`` the result of the
    newest command, empty before it. ``errors`` counts malformed packets. Raises ParticipantError
    without pymavlink.
    """

    def __init__(self, reactor: SimulatedReactor, port: int = MAVLINK_PORT) -> None:
        try:
            self._m = load_dialect()
        except UserError as error:
            raise ParticipantError(str(error)) from error
        self.is_silent = False
        self.mode = self.ack = ""
        self.altitude_m: float | None = None
        self.newest_s: float | None = None
        self.errors = 0
        self._reactor = reactor
        self._port = port
        self._connection: _Connection | None = None
        self._sender = self._m.MAVLink(self, SYSTEM_ID, COMPONENT_ID)
        self._loop = LoopingCall(self._on_period)

    def start(self) -> None:
        host: Any = self._reactor.host()
        self._host = self._loop.clock = host
        self._loop.start(PERIOD_S)

    def stop(self) -> None:
        if self._loop.running:
            self._loop.stop()
        if self._connection is not None:
            self._connection.transport.abortConnection()

    def command(self, order: str) -> None:
        """Select a mode by its name; ``silent`` ends the heartbeats, ``back`` resumes them."""
        if order in MODES:
            self.ack = ""
            m = self._m
            mode = (m.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, MODES[order], 0, 0, 0, 0, 0)
            self._sender.command_long_send(AIRCRAFT, AUTOPILOT, m.MAV_CMD_DO_SET_MODE, 0, *mode)
        else:
            self.is_silent = order == "silent"

    def write(self, packet: bytes) -> None:
        if self._connection is not None:
            self._connection.transport.write(bytes(packet))

    def parser(self) -> Any:
        """Return a parser that continues after noise."""
        parser = self._m.MAVLink(None)
        parser.robust_parsing = True
        return parser

    def on_connection(self, connection: _Connection | None) -> None:
        self._connection = connection

    def on_message(self, message: Any) -> None:
        kind = message.get_type()
        if kind == "BAD_DATA":
            self.errors += 1
        elif kind == "HEARTBEAT":
            self.newest_s = self._reactor.seconds()
            self.mode = _NAMES.get(message.custom_mode, str(message.custom_mode))
        elif kind == "GLOBAL_POSITION_INT":
            self.altitude_m = message.alt / 1000
        elif kind == "COMMAND_ACK" and message.command == self._m.MAV_CMD_DO_SET_MODE:
            result = self._m.enums["MAV_RESULT"][message.result].name
            self.ack = result.removeprefix("MAV_RESULT_")

    def _on_period(self) -> None:
        if self._connection is None:
            factory: Any = ClientFactory()
            factory.noisy = False
            factory.buildProtocol = lambda _address: _Connection(self)
            self._host.connectTCP(ADDRESS, self._port, factory, PERIOD_S)
        elif not self.is_silent:
            m = self._m
            self._sender.heartbeat_send(m.MAV_TYPE_GCS, m.MAV_AUTOPILOT_INVALID, 0, 0, 0)


class _Connection(Protocol):
    transport: Any

    def __init__(self, ground: MavlinkGround) -> None:
        self._ground = ground
        self._parser = ground.parser()

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self._ground.on_connection(self)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        for message in self._parser.parse_buffer(data) or ():
            self._ground.on_message(message)

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        self._ground.on_connection(None)
