"""A proxy's network that the aircraft reaches by two interfaces, and a ground by a third: root."""

import os
from contextlib import contextmanager

from tests.proxy.namespace import must, run
from tests.support.tools import need_root, need_tool, unavailable

_ID = os.getpid() % 100000
_NET = f"10.{150 + os.getpid() // 250 % 50}.{os.getpid() % 250}"
NAMESPACE = f"up-paths-{os.getpid()}"
BEST, SPARE, GROUND = f"upm{_ID}", f"upn{_ID}", f"upo{_ID}"
PROXY, PROXY_FOR_GROUND = f"{_NET}.129", f"{_NET}.10"
HOSTS = {f"{_NET}.{4 * index + 1}": name for index, name in enumerate((BEST, SPARE, GROUND))}
"""The interfaces by their addresses on this side."""


@contextmanager
def two_paths():
    """Make the namespace; yield the prefix of a command that runs inside."""
    need_root()
    need_tool("ip", "iproute2")
    need_tool("nft", "nftables")
    inside = ("ip", "netns", "exec", NAMESPACE)
    try:
        made = run("ip", "netns", "add", NAMESPACE)
        if made.returncode != 0:
            unavailable(f"no network namespace: {made.stderr.strip()}")
        must(*inside, "ip", "link", "set", "lo", "up")
        must(*inside, "ip", "addr", "add", f"{PROXY}/32", "dev", "lo")
        for here, name in HOSTS.items():
            far, there = f"{name}x", here[:-1] + str(int(here[-1]) + 1)
            must("ip", "link", "add", name, "type", "veth", "peer", "name", far)
            must("ip", "link", "set", far, "netns", NAMESPACE)
            must("ip", "addr", "add", f"{here}/30", "dev", name)
            must("ip", "link", "set", name, "up")
            must(*inside, "ip", "addr", "add", f"{there}/30", "dev", far)
            must(*inside, "ip", "link", "set", far, "up")
            if name != GROUND:
                metric = str(100 + int(here[-1]))
                route = ("ip", "route", "add", PROXY, "via", there, "dev", name, "metric", metric)
                must(*route)
                # The answers of the spare path come from an address of the best one.
                must("sysctl", "-qw", f"net.ipv4.conf.{name}.rp_filter=2")
        yield inside
    finally:
        for name in HOSTS.values():
            run("ip", "link", "del", name)
        run("ip", "netns", "del", NAMESPACE)


def swallow(inside, name):
    """Drop every packet of a path; the interface stays up."""
    must(*inside, "nft", "add", "table", "inet", "hole")
    for hook, way in (("input", "iifname"), ("output", "oifname")):
        chain = f"{{ type filter hook {hook} priority 0; policy accept; }}"
        must(*inside, "nft", "add", "chain", "inet", "hole", hook, chain)
        must(*inside, "nft", "add", "rule", "inet", "hole", hook, way, f"{name}x", "drop")
