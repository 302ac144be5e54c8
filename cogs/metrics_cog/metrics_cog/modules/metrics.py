"""Telemetry and counters of the daemon for Prometheus."""

from collections.abc import Iterator
from typing import Any

from twisted.internet.error import CannotListenError

from metrics_cog.config import METRICS
from up.base_started_module import BaseStartedModule
from up.system.figures import Figure, numbers, text_of


class Metrics(BaseStartedModule):
    """Collects telemetry when its page is read. Loaded when ``port`` is configured."""

    CONFIG = METRICS
    SHED_ORDER = 5

    def load(self) -> bool:
        return self.config.port is not None

    def on_init(self) -> None:
        self._port: Any = None

    def on_start(self) -> bool:
        # Imported here: Twisted's web server costs start time and memory.
        from up.system.metrics_page import serve_metrics

        try:
            self._port = serve_metrics(self.context.reactor, self.config.port, self._page)
        except CannotListenError as error:
            # An aircraft without this page may fly.
            self.log.error(
                "port {port} cannot be opened: {reason} (metrics.yml: port); no metrics",
                port=error.port,
                reason=getattr(error.socketError, "strerror", None) or error.socketError,
                code="port_unusable",
            )
            return True
        self.up.advertise_port("metrics", self._port.getHost().port)
        return True

    async def on_stop(self) -> None:
        port, self._port = self._port, None
        if port is not None:
            await port.stopListening()

    def _page(self) -> str:
        return text_of(self._figures())

    def _figures(self) -> Iterator[Figure]:
        content = self.up.telemetry_controller.collect()
        counters = content.pop("counters", {})
        for part, value in numbers(content):
            help_ = "A number or flag of telemetry, by its field (docs/protocols.md 6)."
            yield Figure("up_telemetry", help_, value, {"field": part})
        for name, value in numbers(counters):
            part, _, rest = name.partition(".")
            help_ = "Counters of telemetry, most of them since the start, by part and name."
            labels = {"part": part, "name": rest}
            yield Figure("up_counters", help_, value, labels, "unknown")
