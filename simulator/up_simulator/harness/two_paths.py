"""A proxy's network that the aircraft reaches by two interfaces, and a ground by a third: root."""

from __future__ import annotations

import os
import shutil
import subprocess

from up_simulator.harness.participants import ParticipantError

_ID = os.getpid() % 100000
_NET = f"10.{150 + os.getpid() // 250 % 50}.{os.getpid() % 250}"
NAMESPACE = f"up-paths-{os.getpid()}"
BEST, SPARE, GROUND = f"upm{_ID}", f"upn{_ID}", f"upo{_ID}"
PROXY, PROXY_FOR_GROUND = f"{_NET}.129", f"{_NET}.10"
HOSTS = {f"{_NET}.{4 * index + 1}": name for index, name in enumerate((BEST, SPARE, GROUND))}
"""The interfaces by their addresses on this side."""


class PathsUnavailableError(ParticipantError):
    """This machine, or its user, cannot make the network."""

    code = "paths_unavailable"


def check_paths() -> None:
    """Raise PathsUnavailableError where the network cannot be made."""
    missing = [name for name in ("ip", "nft", "sysctl") if shutil.which(name) is None]
    if os.geteuid() != 0 or missing:
        what = f"{' and '.join(missing)} missing" if missing else "only root can make them"
        raise PathsUnavailableError(
            f"two paths to the proxy need network namespaces: {what}"
            " (as root, with the Debian packages iproute2, nftables and procps)"
        )


class TwoPaths:
    """``inside`` is the prefix of a command that runs at the proxy."""

    inside = ("ip", "netns", "exec", NAMESPACE)

    def open(self) -> None:
        """Make the network; raises PathsUnavailableError, and leaves nothing behind then."""
        check_paths()
        try:
            self._make()
        except PathsUnavailableError:
            self.close()
            raise

    def cut(self, name: str = BEST) -> None:
        """Drop every packet of a path; the interface stays up."""
        rules = "".join(
            f"chain {hook} {{ type filter hook {hook} priority 0; {way} {name}x drop; }}; "
            for hook, way in (("input", "iifname"), ("output", "oifname"))
        )
        _run(*self.inside, "nft", f"table inet hole {{ {rules} }}")

    def restore(self) -> None:
        _run(*self.inside, "nft", "delete", "table", "inet", "hole")

    def close(self) -> None:
        parts = [("link", "del", name) for name in HOSTS.values()]
        for command in (*parts, ("netns", "del", NAMESPACE)):
            subprocess.run(("ip", *command), capture_output=True, check=False)

    def _make(self) -> None:
        inside = self.inside
        _run("ip", "netns", "add", NAMESPACE)
        _run(*inside, "ip", "link", "set", "lo", "up")
        _run(*inside, "ip", "addr", "add", f"{PROXY}/32", "dev", "lo")
        for here, name in HOSTS.items():
            far, there = f"{name}x", here[:-1] + str(int(here[-1]) + 1)
            _run("ip", "link", "add", name, "type", "veth", "peer", "name", far)
            _run("ip", "link", "set", far, "netns", NAMESPACE)
            _run("ip", "addr", "add", f"{here}/30", "dev", name)
            _run("ip", "link", "set", name, "up")
            _run(*inside, "ip", "addr", "add", f"{there}/30", "dev", far)
            _run(*inside, "ip", "link", "set", far, "up")
            if name != GROUND:
                route = (PROXY, "via", there, "dev", name, "metric", str(100 + int(here[-1])))
                _run("ip", "route", "add", *route)
                # The answers of the spare path come from an address of the best one.
                _run("sysctl", "-qw", f"net.ipv4.conf.{name}.rp_filter=2")


def _run(*command: str) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise PathsUnavailableError(f"{' '.join(command)}: {done.stderr.strip()}")
