"""The connection with the ground, through the proxy (thesis 4.2.3)."""

import os
from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from mission_control_cog.audit_log import AuditLog
from mission_control_cog.config import MISSION_CONTROL, aircraft_name, security_of
from mission_control_cog.data_budget import DataBudget
from mission_control_cog.protection import Protection
from mission_control_cog.thinning import Thinning, events_of
from mission_control_cog.tuning_policy import TuningPolicy
from mission_control_cog.uplink import Uplink
from up.commands.answer_commands import CommandAnsweredCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.origin import Origin
from up.commands.refusal import Code
from up.commands.roles import Role
from up.commands.system_commands import LinkStateCommand
from up.commands.telemetry_commands import TelemetryCommand
from up.config.keys_file import KEYS
from up.key_ring import KeyRing
from up.protocols.general_message import GeneralMessage, MalformedMessage, encode
from up.providers.base_mission_control_provider import BaseMissionControlProvider
from up.system.addresses import is_private, stays_here
from up.system.backoff import Backoff
from up.tls.files import TLSFiles

LINK = "mission_control"
ROLE_KEY = "mission_control.yml: role"
PLAIN_KEY = "mission_control.yml: i_accept_plain"
SECURITY_KEY = "mission_control.yml: remote_server.security"
UNPROTECTED = "this link requires protected messages: pair this device ('up keys add')"


UNWATCHED_PERIOD_S = 10.0
"""Period of telemetry while the proxy counts no ground."""


def _have_same_events(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    return events_of(one) == events_of(other)


class Outlet(Protocol):
    """Another link to the ground, beside the proxy."""

    requires_protection: bool
    """Whether it sends protected lines only."""

    def __len__(self) -> int:
        """Return how many ground stations are connected."""

    def send(self, message: bytes) -> bool:
        """Send an encoded message in order; False without a station."""

    def send_newest(self, message: bytes) -> bool:
        """Send an encoded message that replaces an unsent one."""


class MissionControlProvider(BaseMissionControlProvider):
    """Keeps a link to the proxy of ``remote_server``; without one it only serves its outlets."""

    CONFIG = MISSION_CONTROL
    WRITTEN_FILES = (KEYS,)

    def on_init(self) -> None:
        super().on_init()
        self._uplink: Uplink | None = None
        self._outlets: list[Outlet] = []
        self._audited = {LINK}
        self._telemetry_faults = 0
        self._thinning = Thinning()
        self._sent_s = 0.0
        self._events: list[Any] = []
        self._requires_protection = False
        self._audit: AuditLog | None = None
        config = self.config
        self._role = Role(config.role)
        now_s = self.context.reactor.seconds()
        self._budget = DataBudget(config.data_budget_mb_per_hour, now_s)
        self.tuning_policy = TuningPolicy(config.tune_in_flight)
        self.up.command_executor.register_command(
            FlightStateCommand, self.tuning_policy.on_flight_state
        )
        self._link = self.up.open_link(
            LINK, self._role, self._send, role_key=ROLE_KEY, policy=self.tuning_policy
        )
        server, name = config.remote_server, aircraft_name(config, self.context.instance)
        self.protection = Protection(
            self.up, name, self.tuning_policy, secrecy=config.secrecy == "require"
        )
        self._keys = KeyRing(
            self.context.reactor, self.context.config_folder, self.protection.on_keys, name
        )
        if server.url:
            self._uplink = Uplink(
                self.context.reactor,
                server.url,
                server.port,
                name if config.hello else None,
                on_message=self._on_message,
                on_malformed=self._on_malformed,
                on_binary=None if server.security == "off" else self._on_binary,
                on_ready=self._on_ready,
                on_lost=self._on_lost,
                backoff=Backoff(self.context.random.random),
                tls=TLSFiles(self.context.config_folder / server.tls) if server.tls else None,
                interfaces=server.interfaces,
                return_after_s=server.return_after_s,
            )

    def add_outlet(self, outlet: Outlet, link: str) -> None:
        """Send all data for the ground to ``outlet`` too; the Commands of its link are audited."""
        self._outlets.append(outlet)
        self._audited.add(link)

    @property
    def connected(self) -> bool:
        return self._uplink is not None and self._uplink.is_ready

    @property
    def wants_telemetry(self) -> bool:
        return self.connected or any(map(len, self._outlets))

    @property
    def has_ground(self) -> bool:
        # A proxy that does not count its grounds may have one.
        is_behind_proxy = self.connected and self._uplink is not None and self._uplink.grounds != 0
        return is_behind_proxy or any(map(len, self._outlets))

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the counters of the link, and the role of a ground on it."""
        uplink = self._uplink
        counters = {
            "connects": 0 if uplink is None else uplink.connects,
            "too_many": 0 if uplink is None else uplink.bucket.refused,
            "unsent": self.unsent,
            "telemetry_faults": self._telemetry_faults,
            "protected": dict(self.protection.counters),
        }
        # An unprotected link to a proxy may grant less than the configured role.
        role = self._link.origin.role if self.connected else self._role
        ground = {"role": role.value, "tune_in_flight": self.config.tune_in_flight}
        return {
            "counters": {"mission_control": counters},
            "ground": ground,
            "uplink": self._uplink_content(),
        }

    def _uplink_content(self) -> Mapping[str, Any]:
        budget = self._budget
        rate = budget.mb_per_hour
        return {
            "grounds": None if self._uplink is None else self._uplink.grounds,
            "path": None if self._uplink is None else self._uplink.path,
            "mb_per_hour": round(rate, 2),
            "mb": round(budget.mb, 3),
            "mb_in_an_hour": round(budget.mb + rate, 1),
            "budget_mb_per_hour": self.config.data_budget_mb_per_hour,
            "left_out": budget.left_out,
        }

    def plain_links(self) -> Iterable[tuple[str, str]]:
        """Yield the link to the proxy, unless it has TLS or surely requires protection."""
        server, accepts = self.config.remote_server, self.config.i_accept_plain
        requires = "require" in (server.security, self.config.secrecy)
        if not server.url or stays_here(server.url) or server.tls or requires:
            return
        if server.security != "auto" or accepts:
            yield "remote_server.security", "the link to the proxy takes plain Commands"
        else:
            text = "the link to the proxy takes plain Commands while its address is private"
            yield "remote_server.security", text

    def transmit_telemetry(self, command: TelemetryCommand) -> None:
        """Send a frame of telemetry; one that cannot be encoded is logged once and counted."""
        try:
            if any(len(outlet) for outlet in self._outlets):
                frame = encode(command.NAME, command.content, None, command.beacon)
                for outlet in self._outlets:
                    lines = self._frame_lines(frame, outlet.requires_protection)
                    if lines:
                        outlet.send_newest(lines)
            if self._uplink is not None:
                self._transmit_up(self._uplink, command)
        except ValueError as error:
            self._telemetry_faults += 1
            if self._telemetry_faults == 1:
                self.log.error(
                    "cannot send telemetry: {error}; logged once",
                    code="telemetry_unsendable",
                    error=str(error),
                )

    def on_start(self) -> bool:
        self._keys.start()
        self._open_audit()
        if self._uplink is None:
            self.log.info(
                "no proxy is configured (mission_control.yml: remote_server)", code="no_proxy"
            )
        else:
            self._uplink.start()
        return True

    async def on_stop(self) -> None:
        self._keys.stop()
        if self._uplink is not None:
            await self._uplink.stop()
        self.protection.stop()
        if self._audit is not None:
            self._audit.close()

    def _send(self, message: bytes) -> bool:
        return self._uplink is not None and self._uplink.send(message)

    def _transmit_data(self, message: bytes) -> bool:
        lines = self._message_lines(message, self._requires_protection)
        taken = bool(lines) and self._send(lines)
        for outlet in self._outlets:
            lines = self._message_lines(message, outlet.requires_protection)
            taken = (bool(lines) and outlet.send(lines)) or taken
        return taken

    def _transmit_up(self, uplink: Uplink, command: TelemetryCommand) -> None:
        """Send a frame to the proxy, as far as grounds watch, can read, and the budget permits."""
        now_s, budget = self.context.reactor.seconds(), self._budget
        budget.count(uplink.take_ip_bytes(), now_s)
        if uplink.grounds == 0 and now_s - self._sent_s < UNWATCHED_PERIOD_S:
            budget.left_out += 1
            return
        required = self._requires_protection
        if required and not self.protection.sessions:
            return
        content, beacon = command.content, command.beacon
        events = events_of(content)
        if not budget.permits(now_s, is_urgent=events != self._events):
            return
        self._sent_s, self._events = now_s, events
        if uplink.may_pack:
            # Attitude frames in between, or whole frames that repeat most of their values.
            whole_s = budget.hold_s if uplink.may_shorten else 0.0
            content = self._thinning.apply(content, now_s, 0.0 if whole_s else budget.hold_s)
            frame = encode(command.NAME, content, None, beacon, is_compact=True)
            lines = partial(self.protection.frame_lines, is_required=required)
            uplink.send_packed(frame, lines, whole_s, _have_same_events if whole_s else None)
        else:
            self._transmit_newest(encode(command.NAME, content, None, beacon))

    def _transmit_newest(self, message: bytes) -> None:
        if self._uplink is not None:
            lines = self._frame_lines(message, self._requires_protection)
            if lines:
                self._uplink.send_newest(lines)

    def _message_lines(self, message: bytes, is_required: bool) -> bytes:
        return self.protection.message_lines(message[:-1], is_required=is_required)

    def _frame_lines(self, message: bytes, is_required: bool) -> bytes:
        return self.protection.frame_lines(message[:-1], is_required=is_required)

    def _on_message(self, message: GeneralMessage) -> None:
        if self._requires_protection:
            self.up.command_receiver.refuse(self._link, message, Code.UNPROTECTED, UNPROTECTED)
        else:
            self.up.command_receiver.receive(message, self._link)

    def _on_binary(self, line: bytes) -> None:
        self.protection.receive(line, LINK, self._send)

    def _open_audit(self) -> None:
        state = os.environ.get("STATE_DIRECTORY", "").partition(":")[0]
        path = self.config.audit_log or (state and f"{state}/audit.jsonl")
        if path:
            self._audit = AuditLog(self.context.reactor, Path(path), self._audited)
            self.up.command_executor.register_command(
                CommandAnsweredCommand, self._audit.on_answered
            )

    def _on_malformed(self, fault: MalformedMessage) -> None:
        self.up.command_receiver.receive_malformed(fault, self._link)

    def _on_ready(self, host: str) -> None:
        self._grant_role(host)
        self.up.command_executor.execute_command(LinkStateCommand(LINK, True))

    def _on_lost(self) -> None:
        self.up.command_executor.execute_command(LinkStateCommand(LINK, False))

    def _grant_role(self, host: str) -> None:
        """Grant the configured role, or less if nothing protects a pilot's Commands.

        The address is checked at every connection, not when the configuration is read: the name may
        resolve to another address later, and refusing to start would also stop telemetry.
        """
        role, key = self._role, ROLE_KEY
        config = self.config
        is_plain = self._uplink is None or not self._uplink.is_protected
        is_public = not is_private(host)
        security = security_of(config.remote_server.security, is_public, config)
        self._requires_protection = security == "require"
        is_exposed = is_plain and is_public and not config.i_accept_plain
        if self._requires_protection:
            role, key = Role.OBSERVER, SECURITY_KEY
            if self._keys.is_empty:
                self.log.error(
                    "{host}: this link requires protected messages, and no device is paired:"
                    " nothing is sent; run 'up keys add' ({key})",
                    code="keys_missing",
                    host=host,
                    key=SECURITY_KEY,
                )
        elif role is Role.PILOT and is_exposed:
            role, key = Role.OPERATOR, PLAIN_KEY
            self.log.error(
                "{host} is a public address and the link is plain: the ground is an operator, not a"
                " pilot, and cannot arm or tune; {key}: true grants every host that reaches the"
                " proxy the pilot's role",
                code="role_reduced",
                host=host,
                key=PLAIN_KEY,
            )
        self._link.origin = Origin(LINK, role)
        self._link.role_key = key
