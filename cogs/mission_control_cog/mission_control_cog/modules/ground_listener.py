"""A port for ground stations on the aircraft's own network."""

from collections.abc import Iterable, Mapping
from typing import Any

from twisted.internet.error import CannotListenError
from twisted.internet.protocol import Factory

from mission_control_cog.config import MISSION_CONTROL, aircraft_name, security_of
from mission_control_cog.grounds import Grounds
from mission_control_cog.modules.mission_control_provider import (
    PLAIN_KEY,
    ROLE_KEY,
    UNPROTECTED,
    MissionControlProvider,
)
from up.base_started_module import BaseStartedModule, StartFailedError
from up.commands.command_link import CommandLink
from up.commands.refusal import Code
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand
from up.log.limits import Limited
from up.needs import needs
from up.protocols.general_message import GeneralMessage, MalformedMessage
from up.system.addresses import stays_here
from up.system.peer_filter import PeerFilter
from up.tls.files import TLSFiles
from up.tls.protocol import TLSServerFactory

LINK = "ground"
_LOG_INTERVAL_S = 10.0
"""A station that reconnects often must not fill the log."""


class GroundListener(BaseStartedModule):
    """Lets ground stations connect to the aircraft: one has control, the others listen.

    Loaded when ``listener: port`` is configured. Telemetry and Commands to the ground go to all.
    """

    CONFIG = MISSION_CONTROL
    mission_control = needs(MissionControlProvider)

    def load(self) -> bool:
        return self.config.listener.port is not None

    def on_init(self) -> None:
        config = self.config
        self._security = security_of(config.listener.security, False, config)
        requires = self._security == "require"
        is_safe = requires or bool(config.listener.tls)
        self._peers = PeerFilter(config.i_accept_plain or is_safe, PLAIN_KEY)
        self._grounds = Grounds(
            self.context.reactor,
            self._peers,
            aircraft_name(config, self.context.instance),
            open_link=self._open_link,
            on_message=self._on_message,
            on_malformed=self._on_malformed,
            on_owner=self._on_owner,
            on_binary=None if self._security == "off" else self._on_binary,
            requires_protection=requires,
            random=self.context.random,
        )
        self._port: Any = None
        self._has_owner = False
        self._limited = Limited(self.context.reactor, _LOG_INTERVAL_S)
        self.mission_control.add_outlet(self._grounds, LINK)

    def plain_links(self) -> Iterable[tuple[str, str]]:
        """Yield the listener, unless it has TLS or requires protection."""
        listener = self.config.listener
        if listener.tls:
            return
        requires = "require" in (listener.security, self.config.secrecy)
        if not requires and not stays_here(listener.address):
            yield "listener.security", "ground stations on this network may send plain Commands"

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        counters = {
            "stations": len(self._grounds),
            "not_holder": self._grounds.dropped,
            "too_many": self._grounds.too_many,
            "refused_peers": self._peers.refused,
        }
        return {"counters": {"ground": counters}}

    def on_start(self) -> bool:
        listener = self.config.listener
        refusal = self._peers.refusal_of(listener.address)
        if refusal:
            raise StartFailedError(f"{refusal} (mission_control.yml: listener.address)")
        try:
            self._port = self.context.reactor.listenTCP(
                listener.port, self._factory(), interface=listener.address
            )
        except CannotListenError as error:
            reason = getattr(error.socketError, "strerror", None) or error.socketError
            raise StartFailedError(
                f"port {error.port} cannot be opened: {reason} (mission_control.yml: listener.port)"
            ) from error
        self.up.advertise_port("ground", self._port.getHost().port)
        return True

    async def on_stop(self) -> None:
        port, self._port = self._port, None
        if port is not None:
            await port.stopListening()
        await self._grounds.close()
        self._limited.stop()

    def _factory(self) -> Factory:
        """Return what accepts the stations; raises TLSError."""
        folder = self.config.listener.tls
        if not folder:
            return self._grounds
        files = TLSFiles(self.context.config_folder / folder)
        return TLSServerFactory(self.context.reactor, files, self._grounds, clients=True)

    def _open_link(self, send: Any) -> CommandLink:
        policy = self.mission_control.tuning_policy
        return self.up.open_link(
            LINK, Role(self.config.role), send, role_key=ROLE_KEY, policy=policy
        )

    def _on_message(self, message: GeneralMessage, link: CommandLink) -> None:
        if self._grounds.requires_protection:
            self.up.command_receiver.refuse(link, message, Code.UNPROTECTED, UNPROTECTED)
        else:
            self.up.command_receiver.receive(message, link)

    def _on_binary(self, line: bytes, send: Any, refusal: str) -> None:
        self.mission_control.protection.receive(line, LINK, send, refusal)

    def _on_malformed(self, fault: MalformedMessage, link: CommandLink) -> None:
        self.up.command_receiver.receive_malformed(fault, link)

    def _on_owner(self, peer: str) -> None:
        if peer:
            text = "the ground station {peer} has control"
            self._limited.log(self.log.info, text, code="control_granted", peer=peer)
        else:
            text = "the ground station with control has disconnected"
            self._limited.log(self.log.warn, text, code="control_lost")
        if self._has_owner != bool(peer):
            self._has_owner = bool(peer)
            self.up.command_executor.execute_command(LinkStateCommand(LINK, bool(peer)))
