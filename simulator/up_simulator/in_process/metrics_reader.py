"""Reads the daemon's page of metrics as Prometheus does."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from twisted.internet.protocol import ClientFactory, Protocol, connectionDone
from twisted.internet.task import LoopingCall
from twisted.python.failure import Failure

from up_simulator.in_process.config_folder import METRICS_PORT
from up_simulator.in_process.network import ADDRESS
from up_simulator.in_process.reactor import SimulatedReactor

PERIOD_S = 1.0
REQUEST = b"GET /metrics HTTP/1.0\r\nHost: localhost\r\n\r\n"
_HEAD = re.compile(rb"HTTP/1\.[01] 200 .*?\r\ncontent-length: (\d+)\r\n", re.IGNORECASE | re.DOTALL)


class MetricsReader:
    """``values`` are those of the newest whole page, by name and label values, joined by dots.

    Without a page they stay, and ``newest_s`` shows their age.
    """

    def __init__(self, reactor: SimulatedReactor, port: int = METRICS_PORT) -> None:
        self.values: Mapping[str, float] = {}
        self.newest_s: float | None = None
        self._reactor = reactor
        self._port = port
        self._loop = LoopingCall(self._read)

    def start(self) -> None:
        host: Any = self._reactor.host()
        self._host = self._loop.clock = host
        self._loop.start(PERIOD_S)

    def stop(self) -> None:
        if self._loop.running:
            self._loop.stop()

    def on_page(self, data: bytes) -> None:
        """Take an answer; one that is cut, or no page, is dropped."""
        # Imported here: only flights with metrics need the package, and the daemon needs it too.
        from prometheus_client.parser import text_string_to_metric_families

        head, _, body = data.partition(b"\r\n\r\n")
        found = _HEAD.match(head + b"\r\n")
        if not found or int(found[1]) != len(body):
            return
        self.newest_s = self._reactor.seconds()
        self.values = {
            ".".join((sample.name, *sample.labels.values())): sample.value
            for family in text_string_to_metric_families(body.decode("utf-8"))
            for sample in family.samples
        }

    def _read(self) -> None:
        factory: Any = ClientFactory()
        factory.noisy = False
        factory.buildProtocol = lambda _address: _Request(self)
        self._host.connectTCP(ADDRESS, self._port, factory, PERIOD_S)


class _Request(Protocol):
    """One request; the daemon closes after its answer."""

    transport: Any

    def __init__(self, reader: MetricsReader) -> None:
        self._reader = reader
        self._data = b""

    def connectionMade(self) -> None:  # noqa: N802 - Twisted's name
        self.transport.write(REQUEST)

    def dataReceived(self, data: bytes) -> None:  # noqa: N802 - Twisted's name
        self._data += data

    def connectionLost(self, reason: Failure = connectionDone) -> None:  # noqa: N802
        self._reader.on_page(self._data)
