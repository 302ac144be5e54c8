"""A network of one's own, where packets vanish and addresses are public: needs root."""

import os
import subprocess
from contextlib import contextmanager

from tests.proxy.test_metrics import value
from tests.support.tools import need_root, need_tool, unavailable

NAMESPACE = f"up-proxy-{os.getpid()}"
# One subnet per process, so that two test runs on one machine do not meet.
_SUBNET = f"10.{200 + os.getpid() // 250 % 50}.{os.getpid() % 250}"
HERE, THERE = f"{_SUBNET}.1", f"{_SUBNET}.2"


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def must(*command):
    done = run(*command)
    assert done.returncode == 0, f"{command}: {done.stderr}"
    return done.stdout


@contextmanager
def network():
    """A namespace behind a veth pair; yields the prefix of a command that runs inside."""
    need_root()
    need_tool("ip", "iproute2")
    need_tool("nft", "nftables")
    link, peer = f"upx{os.getpid() % 100000}", f"upy{os.getpid() % 100000}"
    try:
        made = run("ip", "netns", "add", NAMESPACE)
        if made.returncode != 0:
            unavailable(f"no network namespace: {made.stderr.strip()}")
        must("ip", "link", "add", link, "type", "veth", "peer", "name", peer)
        must("ip", "link", "set", peer, "netns", NAMESPACE)
        must("ip", "addr", "add", f"{HERE}/24", "dev", link)
        must("ip", "link", "set", link, "up")
        inside = ("ip", "netns", "exec", NAMESPACE)
        must(*inside, "ip", "addr", "add", f"{THERE}/24", "dev", peer)
        must(*inside, "ip", "link", "set", peer, "up")
        must(*inside, "ip", "link", "set", "lo", "up")
        yield inside
    finally:
        run("ip", "link", "del", link)
        run("ip", "netns", "del", NAMESPACE)


def blackhole(inside):
    """Swallow every packet between the namespace and the world."""
    must(*inside, "nft", "add", "table", "inet", "hole")
    for hook, way in (("input", "iifname"), ("output", "oifname")):
        chain = f"{{ type filter hook {hook} priority 0; policy accept; }}"
        must(*inside, "nft", "add", "chain", "inet", "hole", hook, chain)
        must(*inside, "nft", "add", "rule", "inet", "hole", hook, way, "!=", "lo", "drop")


def light(inside):
    """Let packets through again."""
    must(*inside, "nft", "delete", "table", "inet", "hole")


def python(inside, program):
    """Run a small program inside and return its output."""
    return must(*inside, "python3", "-c", program)


def figure(inside, proxy, name):
    """Return one figure of the metrics page of a proxy inside."""
    url = f"http://127.0.0.1:{proxy.metrics_port}/metrics"
    program = f"import urllib.request as r; print(r.urlopen('{url}').read().decode())"
    return value(python(inside, program), name)
