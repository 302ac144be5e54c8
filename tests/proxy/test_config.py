"""proxy.yml."""

from pathlib import Path

from up_proxy.config import PROXY, ProxyConfig


def test_the_template_has_the_defaults():
    assert PROXY.parse(PROXY.template(), Path("proxy.yml")) == ProxyConfig()
