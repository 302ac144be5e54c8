"""Hosts on one switch, as network namespaces, between which packets can be dropped: needs root."""

import os

from tests.proxy.namespace import must, run
from tests.support.tools import need_root, need_tool, unavailable

# One subnet per process, so that two test runs on one machine do not meet.
_SUBNET = f"10.{100 + os.getpid() // 250 % 50}.{os.getpid() % 250}"
_RULES = """
table bridge cut {{}}
delete table bridge cut
table bridge cut {{
chain forward {{
type filter hook forward priority 0
{drops}}}
}}
"""


class Hosts:
    """`count` hosts at `addresses`; `prefixes` begin a command that runs on each.

    The caller reaches all of them, whatever is cut: it stands for the clients' networks.
    """

    def __init__(self, count=3):
        tag = f"up{os.getpid()}"
        self._switch = f"{tag}-switch"
        self._link = f"upw{os.getpid() % 100000}"
        self._names = [f"{tag}-host{number}" for number in range(count)]
        self.addresses = [f"{_SUBNET}.{number + 1}" for number in range(count)]
        self.prefixes = [("ip", "netns", "exec", name) for name in self._names]

    def __enter__(self):
        need_root()
        need_tool("ip", "iproute2")
        need_tool("nft", "nftables")
        made = run("ip", "netns", "add", self._switch)
        if made.returncode != 0:
            unavailable(f"no network namespace: {made.stderr.strip()}")
        try:
            self._make()
        except BaseException:
            self._close()
            raise
        return self

    def __exit__(self, *_):
        self._close()

    def _make(self):
        switch = ("ip", "-n", self._switch)
        must(*switch, "link", "add", "name", "bridge", "type", "bridge")
        must(*switch, "link", "set", "bridge", "up")
        for number, (name, address) in enumerate(zip(self._names, self.addresses, strict=True)):
            must("ip", "netns", "add", name)
            must(*switch, "link", "add", "name", f"host{number}", "type", "veth",
                 "peer", "name", "uplink", "netns", name)  # fmt: skip
            must(*switch, "link", "set", f"host{number}", "master", "bridge", "up")
            must("ip", "-n", name, "addr", "add", f"{address}/24", "dev", "uplink")
            must("ip", "-n", name, "link", "set", "uplink", "up")
            must("ip", "-n", name, "link", "set", "lo", "up")
        must(*switch, "link", "add", "name", "clients", "type", "veth",
             "peer", "name", self._link, "netns", str(os.getpid()))  # fmt: skip
        must(*switch, "link", "set", "clients", "master", "bridge", "up")
        must("ip", "addr", "add", f"{_SUBNET}.254/24", "dev", self._link)
        must("ip", "link", "set", self._link, "up")

    def _close(self):
        for name in (*self._names, self._switch):
            run("ip", "netns", "del", name)

    def isolate(self, number):
        """Drop every packet between a host and the other ones."""
        others = [each for each in range(len(self._names)) if each != number]
        self.cut([(number, each) for each in others] + [(each, number) for each in others])

    def cut(self, ways):
        """Drop the packets of some ways, (from, to), and of no other."""
        drops = "".join(f"iifname host{one} oifname host{other} drop\n" for one, other in ways)
        must("ip", "netns", "exec", self._switch, "nft", _RULES.format(drops=drops))

    def heal(self):
        """Let all packets through again."""
        self.cut([])
