"""A page of as many figures by prometheus-client alone: ``python -m bench.metrics_peer PORT N``."""

import sys
from collections.abc import Iterator
from wsgiref.simple_server import WSGIRequestHandler, make_server

from prometheus_client import CollectorRegistry, make_wsgi_app
from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector


class Figures(Collector):
    """One family, whose values do not change."""

    def __init__(self, count: int) -> None:
        self._names = [f"part.name_{number}" for number in range(count)]

    def collect(self) -> Iterator[GaugeMetricFamily]:
        family = GaugeMetricFamily("up_telemetry", "A number.", labels=("field",))
        for number, name in enumerate(self._names):
            family.add_metric((name,), number * 1.5)
        yield family


class Silent(WSGIRequestHandler):
    """Logs no request, as the daemon does."""

    def log_message(self, format: str, *args: object) -> None:
        """Do nothing."""


def main() -> None:
    """Serve one request after the other until killed."""
    port, count = map(int, sys.argv[1:])
    registry = CollectorRegistry()
    registry.register(Figures(count))
    make_server("127.0.0.1", port, make_wsgi_app(registry), handler_class=Silent).serve_forever()


if __name__ == "__main__":
    main()
