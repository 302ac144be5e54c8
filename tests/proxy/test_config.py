"""proxy.yml."""

from pathlib import Path

from up_proxy.config import PROXY, ProxyConfig


def test_the_template_has_the_defaults():
    assert PROXY.parse(PROXY.template(), Path("proxy.yml")) == ProxyConfig()


def test_the_defaults():
    config = PROXY.load(Path("/nowhere"))
    assert (config.airborne_port, config.ground_port, config.metrics_port) == (3003, 3004, 9303)
    assert config.i_accept_plain is False
    assert config.limits.connections == 2000
