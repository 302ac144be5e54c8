"""A bad link between the aircraft and its proxy, as the mobile network is one."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.link.relay import LinkRelay

USER_TIMEOUT_S = 1.5
"""The daemon's socket option TCP_USER_TIMEOUT."""
_WORDS = {
    "delay": ("delay_ms", 10_000.0),
    "jitter": ("jitter_ms", 10_000.0),
    "loss": ("loss_percent", 90.0),
    "rate": ("rate_bytes_s", 1e9),
}


class UplinkError(ValueError):
    """A link is described wrongly: the message is one sentence for the user."""


def read_link(text: str) -> LinkSettings:
    """Return the settings in a text such as ``delay=80 jitter=20 loss=1 rate=20000``.

    ms, ms, percent, bytes a second; each way has them. Raises ``UplinkError``.
    """
    settings = LinkSettings()
    for word in text.replace(",", " ").split():
        name, equals, value = word.partition("=")
        if not equals or name not in _WORDS:
            raise UplinkError(f"link: {word!r} is not understood ({', '.join(_WORDS)})")
        field, most = _WORDS[name]
        try:
            number = float(value)
        except ValueError:
            number = -1.0
        if not 0.0 <= number <= most:
            raise UplinkError(f"link: {word}: {name} is 0 to {most:g}")
        changed: dict[str, Any] = {field: number}
        settings = replace(settings, **changed)
    return settings


def make_uplink(
    reactor: Any, port: int, proxy: tuple[str, int], settings: LinkSettings, seed: int
) -> LinkRelay:
    """Return a relay on ``port`` of this machine that leads to ``proxy`` over such a link."""
    up, down = LinkModel(settings, seed), LinkModel(settings, seed + 1)
    host, proxy_port = proxy
    return LinkRelay(reactor, port, host, proxy_port, up, down, user_timeout_s=USER_TIMEOUT_S)
