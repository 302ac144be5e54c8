"""The module of the endpoints."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from mission_control_cog.modules.mission_control_provider import MissionControlProvider
from twisted.internet.error import CannotListenError

from mavlink_cog.config import MAVLINK, EndpointConfig
from up.base_started_module import BaseStartedModule, StartFailedError
from up.commands.command_link import CommandLink
from up.commands.roles import Role
from up.commands.telemetry_commands import TelemetryCommand
from up.errors import UserError
from up.needs import needs
from up.protocols.general_message import GeneralMessage, decode
from up_mavlink.address import read_address

if TYPE_CHECKING:
    from up_mavlink.endpoint import Endpoint

LINK = "mavlink"


class AirbornePort:
    """The Command link of one endpoint: ``up.commands`` checks role, policy, beacon, bounds."""

    problem = ""

    def __init__(self, module: MAVLink, role: Role, role_key: str) -> None:
        self._module = module
        policy = module.mission_control.tuning_policy
        self.link: CommandLink = module.up.open_link(
            LINK, role, self._on_answer, role_key=role_key, policy=policy
        )
        self.endpoint: Endpoint | None = None

    def send(self, message: GeneralMessage) -> None:
        self._module.up.command_receiver.receive(message, self.link)

    def _on_answer(self, line: bytes) -> None:
        if self.endpoint is not None:
            # After the call that sent the Command.
            message = decode(line)
            self._module.context.reactor.callLater(0, self.endpoint.on_message, message)


class MAVLink(BaseStartedModule):
    """Serves the endpoints of mavlink.yml.

    To the rest of the program they are another link to the ground: mission control passes
    everything for the ground to them, and a ground station counts as connected while its
    heartbeats arrive on an endpoint whose role permits Commands.
    """

    CONFIG = MAVLINK
    SHED_ORDER = None
    requires_protection = False

    mission_control = needs(MissionControlProvider)

    def load(self) -> bool:
        return bool(self.config.endpoints)

    def on_init(self) -> None:
        self._endpoints: list[tuple[Endpoint, Role]] = []
        self.mission_control.add_outlet(self, LINK)
        self.up.command_executor.register_command(TelemetryCommand, self.on_telemetry)

    def plain_links(self) -> Iterable[tuple[str, str]]:
        """Yield the endpoints that other machines reach without signatures."""
        for number, each in enumerate(self.config.endpoints):
            if not each.is_safe:
                text = "anybody who reaches this MAVLink endpoint sees the telemetry"
                yield f"endpoints.{number}.signing", text

    @property
    def wants_telemetry(self) -> bool:
        return any(each.sessions for each, _ in self._endpoints)

    def __len__(self) -> int:
        return sum(each.has_ground and role is not Role.OBSERVER for each, role in self._endpoints)

    def send(self, line: bytes) -> bool:
        """Take a message for the ground: part of a plan, gains."""
        if not self._endpoints:
            return False
        # The message itself comes first; after it, its form for the stations with keys.
        message = decode(line.partition(b"\n")[0])
        for endpoint, _ in self._endpoints:
            self.context.reactor.callLater(0, endpoint.on_message, message)
        return self.wants_telemetry

    def send_newest(self, line: bytes) -> bool:
        """Ignore a frame of telemetry: it arrives on the bus."""
        return False

    def on_telemetry(self, command: TelemetryCommand) -> None:
        for endpoint, _ in self._endpoints:
            endpoint.on_frame(command.content, command.beacon)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        content = {str(each.settings.address): each.content for each, _ in self._endpoints}
        return {"counters": {"mavlink": content}}

    def on_start(self) -> bool:
        for number, config in enumerate(self.config.endpoints):
            try:
                self._start(number, config)
            except CannotListenError as error:
                reason = getattr(error.socketError, "strerror", None) or error.socketError
                text = f"{config.url} cannot be opened: {reason} (mavlink.yml: endpoints)"
                raise StartFailedError(text) from error
            except UserError as error:
                raise StartFailedError(f"{error} (mavlink.yml: endpoints)") from error
        return True

    async def on_stop(self) -> None:
        while self._endpoints:
            await self._endpoints.pop()[0].stop()

    def _start(self, number: int, config: EndpointConfig) -> None:
        # Imported here: without an endpoint nothing of it is needed.
        from up_mavlink.endpoint import Endpoint, Settings
        from up_mavlink.personas import BY_NAME
        from up_mavlink.signing import read_key

        key = None
        if config.signing == "require":
            key = read_key(self.context.config_folder / config.key_file)
        settings = Settings(
            read_address(config.url), BY_NAME[config.persona], self.config.system_id, key,
            self.config.ground_id,
        )  # fmt: skip
        port = AirbornePort(self, config.granted, f"mavlink.yml: endpoints.{number}.role")
        port.endpoint = endpoint = Endpoint(self.context.reactor, settings, port)
        endpoint.start()
        self._endpoints.append((endpoint, config.granted))
        self.up.advertise_port(f"mavlink {number}", endpoint.number)
