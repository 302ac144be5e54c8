"""MAVLink ground stations on the protected link of this ground station."""

from __future__ import annotations

from typing import Any

from twisted.internet.error import CannotListenError

from up.cli.option_parser import EXIT_FAILED
from up.errors import UserError
from up.protocols.general_message import GeneralMessage, encode
from up.sanitize_text import sanitize_text
from up_ground.link_status import ControlStatus, LinkState, control_status
from up_ground.one_shot_task import LinkTask, print_error
from up_ground.settings import Settings
from up_ground.telemetry import NAME, Telemetry
from up_ground.token_store import TokenStore
from up_mavlink.endpoint import Endpoint
from up_mavlink.endpoint import Settings as EndpointSettings


class MAVLinkBridge(LinkTask):
    """Serves an endpoint; reconnects to the aircraft without end.

    Control is requested while it is free and heartbeats of a MAVLink ground station arrive, and
    released when they end. Everything else is decided by the aircraft.
    """

    def __init__(
        self,
        reactor: Any,
        settings: Settings,
        tokens: TokenStore,
        served: EndpointSettings,
        *,
        is_watching: bool = False,
    ) -> None:
        super().__init__(reactor, settings, tokens)
        self.telemetry = Telemetry()
        self.endpoint = Endpoint(reactor, served, self)
        self._is_watching = is_watching
        self._reported = ""
        self._is_requesting = False

    @property
    def problem(self) -> str:
        """Return why no Command can be sent now; empty if it can."""
        if self._is_watching:
            return "this bridge only watches (--watch-only)"
        status = self.link.status
        if not status.is_open:
            return f"no link to the aircraft: {status.reason}"
        if status.key_fault is not None:
            return status.key_fault[0]
        if self.telemetry.is_silent(self._reactor.seconds()):
            return "the aircraft is silent"
        control = control_status(status, self._settings.direct)
        if control is ControlStatus.HELD:
            return f"ground {status.holder} has control"
        return "" if control is ControlStatus.OURS else "control is not granted yet"

    def start(self) -> None:
        address = self.endpoint.settings.address
        try:
            self.endpoint.start()
        except CannotListenError as error:
            reason = getattr(error.socketError, "strerror", None) or error.socketError
            self.fail(f"{address} cannot be opened: {reason}", "port_unusable", EXIT_FAILED)
            return
        except UserError as error:
            self.fail(str(error), error.code, EXIT_FAILED)
            return
        number = self.endpoint.number
        text = f"MAVLink: {address.kind}:{address.host}:{number}"
        self.echo(text, "mavlink_open", kind=address.kind, host=address.host, port=number)
        self.link.start()

    async def stop(self) -> None:
        await self.endpoint.stop()
        await super().stop()

    def send(self, message: GeneralMessage) -> None:
        line = encode(message.name, message.data, message.id, message.beacon)
        self.link.send(line)

    def on_message(self, message: GeneralMessage) -> None:
        if message.name != NAME:
            self.endpoint.on_message(message)
        elif self.telemetry.update(message, self._reactor.seconds()):
            self.endpoint.on_frame(message.data, message.beacon)
            self._update_control()

    def on_link(self) -> None:
        status = self.link.status
        if status.rejection:
            self.fail(status.reason, status.rejection, EXIT_FAILED)
        elif status.state is LinkState.WAITING and status.reason != self._reported:
            self._reported = status.reason
            print_error(sanitize_text(status.reason), status.code)
        elif status.is_open:
            self._reported = ""
            self._update_control()

    def _update_control(self) -> None:
        control = control_status(self.link.status, self._settings.direct)
        wants = self.endpoint.has_ground and not self._is_watching
        if wants and control is ControlStatus.FREE and not self._is_requesting:
            self._is_requesting = True
            self.request_control()
        elif self._is_requesting and (not wants or control is not ControlStatus.FREE):
            self._is_requesting = False
            self.cancel_timer("request")
        if not wants and control is ControlStatus.OURS:
            self.link.release_seat()
