"""A ground station in this process, with the link of the real one."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Mapping
from pathlib import Path
from random import Random
from typing import Any

from twisted.internet.defer import Deferred

from up.flight_log.json_message import number_at
from up.protocols.general_message import GeneralMessage, encode
from up.system.backoff import Backoff
from up_ground.ground_link import GroundLink
from up_ground.settings import Seat, Settings
from up_ground.telemetry import Telemetry
from up_ground.token_store import TokenStore
from up_simulator.in_process.config_folder import GROUND_PORT
from up_simulator.in_process.host import SimulatedHost
from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.reactor import SimulatedReactor

MAX_ANSWERS = 256
MAX_OTHER_MESSAGES = 64


class InProcessGround:
    """Connects to the daemon's listener, takes control, keeps the newest telemetry, commands.

    Each Command echoes the newest beacon. A Command without a link is lost and never answered.
    ``others`` keeps the newest message of each name, such as the aircraft's gains or a nack.
    A frame's age is exact: the daemon has the monotonic clock of this machine or process.
    """

    def __init__(
        self,
        reactor: SimulatedReactor,
        port: int = GROUND_PORT,
        *,
        host: str = ADDRESS,
        seed: int = 1,
    ) -> None:
        self.others: OrderedDict[str, Mapping[str, Any]] = OrderedDict()
        self.newest_s: float | None = None
        self._reactor = reactor
        self._seed = seed
        self._settings = Settings(host, port, seat=Seat.COMMAND)
        self._tokens = _TokenInMemory(self._settings)
        self._received = Telemetry()
        self._answers: OrderedDict[str, str] = OrderedDict()
        self._newest_age_s: float | None = None
        self._max_age_s: float | None = None
        self._sent = 0
        self._host: SimulatedHost | None = None
        self._link: GroundLink | None = None

    @property
    def telemetry(self) -> Mapping[str, Any]:
        return self._received.data

    @property
    def frames(self) -> int:
        return self._received.frames

    def take_latency_s(self) -> float | None:
        """Return the maximum age of the data since the last call, otherwise the newest frame's."""
        max_s, self._max_age_s = self._max_age_s, None
        found_s = self._newest_age_s if max_s is None else max_s
        return None if found_s == math.inf else found_s

    @property
    def beacon(self) -> int | None:
        return self._received.beacon

    @property
    def is_connected(self) -> bool:
        return self._link is not None and self._link.status.is_open

    @property
    def is_in_control(self) -> bool:
        """Return whether it has control at the proxy; a listener grants none."""
        return self._link is not None and self._link.status.seat is Seat.COMMAND

    def start(self) -> None:
        if self._link is None:
            self._host = self._reactor.host()
            backoff = Backoff(Random(self._seed).random)
            link = GroundLink(self._host, self._settings, self, self._tokens, backoff)
            self._link = link
            link.start()

    def stop(self) -> None:
        link, self._link = self._link, None
        if link is not None:
            Deferred.fromCoroutine(link.stop()).addErrback(lambda _: None)

    def send(self, name: str, **data: Any) -> str:
        self._sent += 1
        command_id = f"ground-{self._sent}"
        if self._link is not None:
            self._link.send(encode(name, data, command_id, self._received.beacon))
        return command_id

    def answer(self, command_id: str) -> str | None:
        """Return None without an answer, an empty text for an ack, a nack's reason."""
        return self._answers.get(command_id)

    def on_message(self, message: GeneralMessage) -> None:
        now_s = self._reactor.seconds()
        if self._received.update(message, now_s):
            self.newest_s = now_s
            made_ms = number_at(message.data, ("system", "clock_ms"))
            age_s = None if made_ms is None else max(0.0, now_s - made_ms / 1000)
            # The age is unknown: it may have any value.
            self._newest_age_s = math.inf if age_s is None else age_s
            self._max_age_s = max(self._newest_age_s, self._max_age_s or 0.0)
        elif message.name in ("up.ack", "up.nack"):
            refused = message.name == "up.nack"
            reason = str(message.data.get("reason") or "refused") if refused else ""
            self._answers[str(message.data.get("id"))] = reason
            if len(self._answers) > MAX_ANSWERS:
                self._answers.popitem(last=False)
        self.others[message.name] = message.data
        self.others.move_to_end(message.name)
        if len(self.others) > MAX_OTHER_MESSAGES:
            self.others.popitem(last=False)

    def on_link(self) -> None:
        """Ignore a change of the link: its status is polled."""


class _TokenInMemory(TokenStore):
    """Keeps the seat's token where no other program looks."""

    def __init__(self, settings: Settings) -> None:
        super().__init__(Path(), settings)
        self._token: str | None = None

    def hold(self) -> bool:
        return True

    def load(self) -> str | None:
        return self._token

    def save(self, token: str) -> None:
        self._token = token

    def forget(self) -> None:
        self._token = None

    def close(self) -> None:
        """Keep it for the next connection."""
