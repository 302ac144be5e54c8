"""The airborne phone (thesis 3.3.3, 4.2.3)."""

from collections.abc import Iterable, Mapping
from typing import Any

from android_cog.config import ANDROID
from android_cog.orientation_input import OrientationInput
from android_cog.phone_link import PhoneLink, host_of
from android_cog.phone_route import PhoneRoute
from android_cog.ports import Ports
from android_cog.telemetry_forward import TelemetryForward
from up.base_started_module import BaseStartedModule, StartFailedError
from up.commands.answer_commands import AckCommand, NackCommand
from up.commands.command import BaseCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.panic_command import PanicCommand
from up.commands.refusal import Code, CommandRefusedError
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand, SystemStopCommand
from up.commands.telemetry_commands import TelemetryCommand
from up.log.limits import Limited
from up.mode import Mode
from up.protocols.general_message import GeneralMessage, MalformedMessage, encode
from up.protocols.general_message_link import GeneralMessageLink
from up.protocols.orientation_forward import OrientationFrame
from up.system.addresses import stays_here
from up.system.clock import Timer
from up.system.peer_filter import PeerFilter

LINK = "android"
PRIORITY = 0
COMPETITOR_S = 10.0
"""How long telemetry shows a rejected phone, which retries more often."""
_LOG_INTERVAL_S = 10.0
"""A phone that reconnects often, or two that replace each other, must not fill the log."""


class AndroidProvider(BaseStartedModule):
    """Two sockets for the phone: General Messages, and orientation.

    The phone's messages go through the Command Receiver with the role of a sensor. The phone gets
    telemetry, Panic Mode, and the Commands that are routed to it. In Black Box Mode, where the
    phone is behind a cellular network, both sockets are TCP only.
    """

    CONFIG = ANDROID
    DATA_SOURCE = True

    def plain_links(self) -> Iterable[tuple[str, str]]:
        """Yield the phone's ports: its sensors have no key."""
        if stays_here(self.config.address):
            return
        if self.config.i_accept_plain:
            yield "i_accept_plain", "any address may send sensor data unprotected, as a phone"
        else:
            yield "address", "phones on this network send sensor data unprotected"

    def on_init(self) -> None:
        clock = self.context.reactor
        config = self.config
        self._peers = PeerFilter(config.i_accept_plain, "android.yml: i_accept_plain")
        self._phone = PhoneLink(
            clock,
            self._peers,
            on_message=self._on_message,
            on_malformed=self._on_malformed,
            on_connected=self._on_connected,
            on_lost=self._on_lost,
            on_rejected=self._on_rejected,
        )
        self._orientation = OrientationInput(
            clock,
            self._permits_orientation,
            on_frame=self._on_orientation,
            on_connected=self._on_orientation_connected,
            on_lost=self._on_orientation_lost,
        )
        self._route = PhoneRoute(self._phone)
        self._forward = TelemetryForward(
            clock, config.forward_interval_ms / 1000, self._send_telemetry
        )
        self._stop_timer: Timer | None = None
        self._ports = Ports(clock, config.address)
        self._origin = Origin(LINK, Role.SENSOR, PRIORITY)
        self._stream_link = self.up.open_link(
            LINK, Role.SENSOR, self._phone.send_by_stream, priority=PRIORITY
        )
        self._datagram_link = self.up.open_link(
            LINK, Role.SENSOR, self._phone.datagrams.send, priority=PRIORITY
        )
        self._competitor = ""
        self._competitor_s = 0.0
        self._orientation_rejected = 0
        self._sender: GeneralMessageLink | None = None
        self._panic: PanicCommand | None = None
        self._is_connected = False
        self._telemetry_faults = 0
        self._limited = Limited(clock, _LOG_INTERVAL_S)
        self._subscribe()

    def _subscribe(self) -> None:
        self.up.command_receiver.register_route(LINK, self._route.carry)
        executor = self.up.command_executor
        executor.register_command(TelemetryCommand, self._on_telemetry)
        executor.register_command(PanicCommand, self._on_panic)
        executor.register_command(AckCommand, self._on_ack)
        executor.register_command(NackCommand, self._on_nack)

    @property
    def connected(self) -> bool:
        """Return whether the phone is connected on its General Message link."""
        return self._is_connected

    @property
    def wants_telemetry(self) -> bool:
        return self._is_connected

    @property
    def is_source_open(self) -> bool:
        return self._ports.are_open

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return whether the phone is connected, a rejected other phone, and the counters."""
        counters = {
            **self._orientation.counters,
            "orientation_rejected": self._orientation_rejected,
            "refused_peers": self._peers.refused,
            "rejected": self._phone.rejected,
            "foreign": self._phone.datagrams.foreign,
            "too_many": self._phone.bucket.refused,
            "replaced": self._phone.replaced,
            "too_long": self._phone.dropped_too_long,
            "unasked_answers": self._route.unasked_answers,
            "telemetry_faults": self._telemetry_faults,
        }
        age_s = self.context.reactor.seconds() - self._competitor_s
        competitor = self._competitor if age_s <= COMPETITOR_S else ""
        android = {"connected": self.connected, "competitor": competitor or None}
        return {"android": android, "counters": {"android": counters}}

    def send_command(self, command: BaseCommand, command_id: str | None = None) -> bool:
        """Send a Command to the phone; return whether it was sent or queued."""
        return self._phone.send(encode(command.NAME, command.data, command_id))

    async def on_start(self) -> None:
        config = self.config
        refusal = self._peers.refusal_of(config.address)
        if refusal:
            raise StartFailedError(f"{refusal} (android.yml: address)")
        is_black_box = self.context.mode is Mode.BLACK_BOX
        if config.stop_if_orientation_is_lost and not is_black_box:
            self.log.warn(
                "'stop if orientation connection is lost' holds in Black Box Mode only: ignored",
                code="setting_ignored",
            )
        datagrams = (None, None) if is_black_box else (self._phone, self._orientation)
        try:
            general = self._ports.open(
                config.general_port,
                "android.yml: general port",
                self._phone.factory,
                datagrams[0] and datagrams[0].datagrams,
            )
            orientation = self._ports.open(
                config.orientation_port,
                "android.yml: orientation port",
                self._orientation.factory,
                datagrams[1] and datagrams[1].datagrams,
            )
        except StartFailedError:
            await self._ports.close()
            raise
        self.up.advertise_port("general", general)
        self.up.advertise_port("orientation", orientation)

    async def on_stop(self) -> None:
        self._cancel_stop()
        self._forward.discard()
        await self._ports.close()
        self._orientation.close()
        await self._phone.close()
        self._limited.stop()

    def _on_message(self, link: GeneralMessageLink, message: GeneralMessage) -> None:
        self._sender = link
        self.up.command_receiver.receive(message, self._command_link_of(link))
        self._sender = None

    def _on_malformed(self, link: GeneralMessageLink, fault: MalformedMessage) -> None:
        self.up.command_receiver.receive_malformed(fault, self._command_link_of(link))

    def _command_link_of(self, link: GeneralMessageLink) -> Any:
        return self._datagram_link if link is self._phone.datagrams else self._stream_link

    def _permits_orientation(self, host: str) -> bool:
        """Return whether a host may send orientation: the phone's, or any without a phone."""
        if not self._peers.permits(host):
            return False
        is_phone = self._phone.host in ("", host)
        self._orientation_rejected += not is_phone
        return is_phone

    def _on_rejected(self, peer: str) -> None:
        self._competitor, self._competitor_s = host_of(peer), self.context.reactor.seconds()
        owner = self._phone.current
        self._limited.log(
            self.log.warn,
            "the phone {peer} is rejected: {owner} is connected",
            code="phone_rejected",
            peer=peer,
            owner="another" if owner is None else owner.peer,
        )

    def _on_connected(self, link: GeneralMessageLink) -> None:
        self._orientation.recheck()
        self._limited.log(self.log.info, "the phone is connected from {peer}",
            code="phone_connected", peer=link.peer)  # fmt: skip
        self._forward.discard()
        if self._panic is not None:
            link.send(encode(self._panic.NAME, self._panic.data))
        self._publish_state()

    def _on_lost(self, link: GeneralMessageLink, why: str) -> None:
        self._limited.log(
            self.log.warn, "the phone's link is lost: {why}", code="phone_lost", why=why
        )
        self._route.on_lost(link)
        self._publish_state()

    def _publish_state(self) -> None:
        is_connected = self._phone.current is not None
        if is_connected != self._is_connected:
            self._is_connected = is_connected
            self.up.command_executor.execute_command(LinkStateCommand(LINK, is_connected))

    def _on_orientation(self, frame: OrientationFrame) -> None:
        self.up.command_executor.execute_command(OrientationCommand(*frame), self._origin)

    def _on_orientation_connected(self) -> None:
        self._limited.log(self.log.info, "the phone sends orientation", code="orientation_received")
        self._cancel_stop()

    def _on_orientation_lost(self) -> None:
        self._limited.log(self.log.warn, "the phone's orientation is lost", code="orientation_lost")
        if (
            self.started
            and self.config.stop_if_orientation_is_lost
            and self.context.mode is Mode.BLACK_BOX
        ):
            self._stop_timer = self._stop_timer or self.context.reactor.callLater(
                self.config.stop_delay_s, self._stop_program
            )

    def _cancel_stop(self) -> None:
        if self._stop_timer is not None:
            self._stop_timer.cancel()
            self._stop_timer = None

    def _stop_program(self) -> None:
        self._stop_timer = None
        self.log.error(
            "no orientation from the phone for {stop_delay_s:g} s: stopping"
            " (android.yml: stop if orientation connection is lost)",
            code="orientation_stop",
            stop_delay_s=self.config.stop_delay_s,
        )
        self.up.command_executor.execute_command(SystemStopCommand())

    def _on_telemetry(self, command: TelemetryCommand) -> None:
        if self._is_connected:
            self._forward.offer(command)

    def _send_telemetry(self, command: TelemetryCommand) -> None:
        try:
            message = encode(command.NAME, command.content, None, command.beacon)
        except ValueError as error:
            self._telemetry_faults += 1
            if self._telemetry_faults == 1:
                self.log.error(
                    "telemetry cannot be sent to the phone: {error}; logged once",
                    code="telemetry_not_sent",
                    error=error,
                )
        else:
            self._phone.send_newest(message)

    def _on_panic(self, command: PanicCommand) -> None:
        self._panic = command if command.panic else None
        self._forward.min_interval_s = command.delay_ms / 1000 if command.panic else 0.0
        self._phone.send(encode(command.NAME, command.data))

    def _on_ack(self, command: AckCommand) -> None:
        self._on_answer(command.command_id, None)

    def _on_nack(self, command: NackCommand) -> None:
        try:
            code = Code(command.code)
        except ValueError:
            code = Code.REFUSED
        self._on_answer(
            command.command_id, CommandRefusedError(command.reason, code, detail=command.detail)
        )

    def _on_answer(self, command_id: str, refusal: CommandRefusedError | None) -> None:
        """Handle an answer from the phone's own link; answers from other links are ignored."""
        if self._sender is not None and self.up.command_executor.origin.link == LINK:
            self._route.on_answer(self._sender, command_id, refusal)
