"""The connection with the ground station, over any transport (thesis 4.1.5, 4.2.3)."""

from abc import abstractmethod

from up.base_started_module import BaseStartedModule
from up.commands.command import BaseCommand
from up.commands.telemetry_commands import TelemetryCommand
from up.protocols.general_message import encode


class BaseMissionControlProvider(BaseStartedModule):
    """Sends telemetry and Commands to the ground; a subclass implements the transport.

    Telemetry is newest-wins: ``_transmit_newest`` may replace a frame that is still unsent.
    Commands keep their order: ``_transmit_data``.
    """

    unsent = 0

    def on_init(self) -> None:
        self.up.command_executor.register_command(TelemetryCommand, self.transmit_telemetry)

    @property
    def wants_telemetry(self) -> bool:
        """Return whether telemetry would reach a station."""
        return True

    @property
    def has_ground(self) -> bool:
        """Return whether a ground station is connected: the failsafe ``uplink_lost`` asks."""
        return self.wants_telemetry

    def transmit_telemetry(self, command: TelemetryCommand) -> None:
        """Send a frame of telemetry; it replaces an unsent one."""
        self._transmit_newest(encode(command.NAME, command.content, None, command.beacon))

    send_telemetry = transmit_telemetry

    def send_command(self, command: BaseCommand, command_id: str | None = None) -> bool:
        """Send a Command to the ground; return whether it was sent or queued."""
        sent = self._transmit_data(encode(command.NAME, command.data, command_id))
        if not sent:
            self.unsent += 1
        return sent

    @abstractmethod
    def _transmit_data(self, message: bytes) -> bool:
        """Send one encoded message in order; return whether it was accepted."""

    @abstractmethod
    def _transmit_newest(self, message: bytes) -> None:
        """Send one encoded message that replaces its unsent predecessor."""
