import socket

import pytest
from discovery_cog.modules.discovery_service import DiscoveryService
from metrics_cog import config
from metrics_cog.config import METRICS
from metrics_cog.modules.metrics import Metrics
from twisted.internet.threads import deferToThread
from twisted.logger import capturedLogs

from tests.support.reactor import reactor
from tests.support.scrape import scrape
from tests.support.system import build_up
from up.config import ConfigErrors
from up.life_cycle import LifeCycle


async def test_a_scrape_has_the_numbers_of_telemetry_and_only_on_loopback(tmp_path):
    files = {"metrics.yml": "port: 0\n", "discovery.yml": "port: 0\n"}
    up = build_up([Metrics, DiscoveryService], reactor, tmp_path, config=files)
    life = LifeCycle(up)
    await life.start()
    up.get_module(DiscoveryService)._answerer.counters["answered"] = 7
    read = await deferToThread(scrape, up.ports["metrics"])
    assert read["up_counters", "answered", "discovery"] == 7
    assert read["up_telemetry", "system.period_ms"] == 100
    module = up.get_module(Metrics)
    assert module._port.getHost().host == "127.0.0.1"
    await life.stop()
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.1", up.ports["metrics"]))


async def test_a_port_in_use_does_not_forbid_to_fly(tmp_path):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        up = build_up([Metrics], reactor, tmp_path, config={"metrics.yml": f"port: {port}\n"})
        life = LifeCycle(up)
        with capturedLogs() as events:
            await life.start()
        assert "port_unusable" in [each.get("code") for each in events]
        assert up.vetoes.all == []
        await life.stop()


def test_without_a_port_it_is_not_loaded(tmp_path):
    up = build_up([Metrics], reactor, tmp_path)
    assert up.get_module(Metrics) is None


def test_a_port_without_the_package_stops_the_start(tmp_path, monkeypatch):
    monkeypatch.setattr(config, "is_installed", lambda: False)
    (tmp_path / "metrics.yml").write_text("port: 9304\n")
    with pytest.raises(ConfigErrors) as refused:
        METRICS.load(tmp_path)
    assert [each.code for each in refused.value.problems] == ["package_missing"]
