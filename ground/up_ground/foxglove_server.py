"""Live telemetry as a Foxglove WebSocket, by Foxglove's own server."""

from __future__ import annotations

import errno
import json
import socket
import time
from collections.abc import Mapping
from typing import Any

import foxglove
from foxglove.websocket import StatusLevel

from up.cli.option_parser import EXIT_FAILED
from up.commands.telemetry_commands import TelemetryCommand
from up.commands.telemetry_schema import READINGS
from up.flight_log.command_schema import schema_of
from up.flight_log.foxglove import LOCATION_FIX_SCHEMA, PLACE_TOPIC, location_fix
from up.flight_log.json_message import number_at
from up.protocols.general_message import GeneralMessage
from up.sanitize_text import sanitize_text
from up_ground.link_status import LinkState
from up_ground.one_shot_task import LinkTask, print_error
from up_ground.settings import Settings
from up_ground.telemetry import NAME, Telemetry
from up_ground.token_store import TokenStore
from up_ground.web.listen_address import ListenAddress, authority

CHECK_S = 1.0
_LINK = "link"


class FoxgloveServer(LinkTask):
    """Publishes each frame under the topics of the flight log; reconnects without end.

    It is a listener that sends no Command. Its server has no capability, so that it refuses what
    clients publish, call or set. It runs in threads of its own; a slow client loses old frames.
    """

    def __init__(
        self, reactor: Any, settings: Settings, tokens: TokenStore, listen: ListenAddress
    ) -> None:
        super().__init__(reactor, settings, tokens)
        self.telemetry = Telemetry()
        self._listen = listen
        self._reported = self._logged = ""
        context = foxglove.Context()
        self._context = context
        schema: Any = schema_of(TelemetryCommand)
        self._frames = foxglove.Channel(NAME, schema=schema, context=context)
        place: Any = LOCATION_FIX_SCHEMA
        self._places = foxglove.Channel(PLACE_TOPIC, schema=place, context=context)
        self._server: Any = None

    def start(self) -> None:
        host = self._listen.host or "0.0.0.0"
        try:
            self._server = foxglove.start_server(
                name=self._settings.aircraft,
                host=host,
                port=self._listen.port,
                capabilities=[],
                context=self._context,
            )
        except RuntimeError as error:
            text = f"cannot open {authority(host, self._listen.port)}"
            why = _why_not_open(host, self._listen.port) or str(error)
            self.fail(f"{text}: {why}", "listen_failed", EXIT_FAILED)
            return
        address = authority(host, self._server.port)
        self.echo(f"Foxglove: ws://{address}", "foxglove_open", address=address)
        if not self._listen.is_loopback:
            self.echo("not encrypted: others on the network read the telemetry", "foxglove_plain")
        self.link.start()
        self._check()

    async def stop(self) -> None:
        await super().stop()
        if self._server is not None:
            self._server.stop()

    def on_message(self, message: GeneralMessage) -> None:
        """Publish a frame; a late one that a newer one follows is dropped."""
        if message.name != NAME or not self.telemetry.update(message, self._reactor.seconds()):
            return
        time_ns = time.time_ns()
        self._frames.log(json.dumps(message.data).encode("ascii"), log_time=time_ns)
        place = _place_of(message.data, time_ns)
        if place is not None:
            self._places.log(json.dumps(place).encode("ascii"), log_time=time_ns)

    def on_link(self) -> None:
        status = self.link.status
        if status.rejection:
            self.fail(status.reason, status.rejection, EXIT_FAILED)
        elif status.state is not LinkState.CONNECTING:
            self._report()

    def _check(self) -> None:
        self._report()
        problem, code = self._problem
        if problem != self._logged and (code or not problem):
            # There may be no client.
            self._logged = problem
            if problem:
                print_error(sanitize_text(problem), code)
            else:
                self.echo("telemetry arrives", "heard")
        self.after(self._reactor, "check", CHECK_S, self._check)

    def _report(self) -> None:
        """Show clients, also new ones, why frames are missing, and that they are back."""
        problem, _ = self._problem
        if problem:
            self._server.publish_status(problem, StatusLevel.Warning, _LINK)
        elif self._reported:
            self._server.remove_status([_LINK])
        self._reported = problem

    @property
    def _problem(self) -> tuple[str, str]:
        """Return why frames are missing, with its code, empty before the first attempt ended."""
        status = self.link.status
        if not status.is_open:
            return f"no link to the aircraft: {status.reason or 'connecting'}", status.code
        if status.key_fault is not None:
            return status.key_fault
        is_silent = self.telemetry.is_silent(self._reactor.seconds())
        return ("the aircraft is silent", "silent") if is_silent else ("", "")


def _why_not_open(host: str, port: int) -> str:
    """Return what to do about an address that cannot be opened; empty: it can be."""
    others = "--listen ADDRESS:PORT selects another"
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as probe:
        try:
            probe.bind((host, port))
        except OSError as error:
            if error.errno == errno.EADDRINUSE:
                return f"another program has this port; end it ({others})"
            return f"{error.strerror} ({others})"
    return ""


def _place_of(data: Mapping[str, Any], time_ns: int) -> dict[str, Any] | None:
    """Return the position of a frame; None: unknown, or stale."""
    latitude, longitude, altitude, accuracy = (
        number_at(data, ("location", key))
        for key in ("latitude", "longitude", "altitude", "accuracy")
    )
    age_ms = number_at(data, ("age_ms", "location"))
    if latitude is None or longitude is None or age_ms is None:
        return None
    if age_ms > READINGS["location"].stale_s * 1000:
        return None
    return location_fix(time_ns - round(age_ms * 1e6), latitude, longitude, altitude, accuracy)
