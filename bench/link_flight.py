"""A flight of `make run` in a separate network namespace, and what its uplink costs at IP level.

`python -m bench.link_flight SECONDS WATCHED SECURITY [BUDGET]`, as root inside `unshare --net`;
prints one JSON object: IP packets and bytes in both directions between aircraft and proxy, packets
with a frame of telemetry, and the seconds. A protected aircraft sends frames to an open session
alone.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import yaml

from up.tls.authority import Authority
from up_simulator.demo.flight import DemoFlight
from up_simulator.demo.main import ROOT, read_options

SETTLE_S = 12.0
TABLE = "inet link"
AIRCRAFT = "default"
FRAME_BYTES = {"protected": 100, "plain": 60}
"""A packet from the aircraft with a frame is larger, a heartbeat is smaller."""
LOAD_GUARD = ("load_guard.LoadGuard", "system_state_provider.SystemStateProvider")


class MeteredFlight(DemoFlight):
    """Flies with a data budget; other programs' load does not slow its telemetry.

    ``is_protected``: TLS on both hops in addition to the demo's keys.
    """

    budget: float | None = None
    is_protected = False

    def _write_config(self) -> None:
        super()._write_config()
        folder, ports = self._folder / "config", self._ports
        path = folder / "mission_control.yml"
        config = yaml.safe_load(path.read_text(encoding="utf-8"))
        config["data_budget_mb_per_hour"] = self.budget
        if self.is_protected:
            own = certificates(self._folder / "certificates")
            config["remote_server"] |= {"tls": str(own / AIRCRAFT)}
            tls = {"folder": str(own / "relay")}
            tls |= {"airborne port": ports.airborne, "ground port": ports.ground}
            (folder / "proxy.yml").write_text(yaml.safe_dump({"metrics": False, "tls": tls}))
            os.environ["UP_GROUND_TLS"] = str(own / "ground")
        path.write_text(yaml.safe_dump(config), encoding="utf-8")
        disabled = ", ".join(f"load_guard_cog.modules.{name}" for name in LOAD_GUARD)
        (folder / "disabled_modules.yml").write_text(f"disabled modules: [{disabled}]\n")
        count_port(ports.airborne, FRAME_BYTES["protected" if self.is_protected else "plain"])


def certificates(folder: Path) -> Path:
    authority = Authority(folder)
    authority.create("bench")
    authority.issue("relay", ["127.0.0.1"], 2)
    for name in (AIRCRAFT, "ground"):
        authority.issue(name, [], 2)
    return folder


def nft(*words: str) -> str:
    return subprocess.run(["nft", "-j", *words], check=True, capture_output=True, text=True).stdout


def count_port(port: int, frame_bytes: int) -> None:
    """Count the packets from and to a TCP port; on the loopback each passes `input` once."""
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    nft(f"add table {TABLE}; add chain {TABLE} c {{ type filter hook input priority 0; }}")
    for rule in (f"sport {port}", f"dport {port}", f"dport {port} meta length > {frame_bytes}"):
        nft(f"add rule {TABLE} c tcp {rule} counter")


def counted() -> tuple[int, int, int]:
    """Return packets, bytes, and packets with a frame so far."""
    items = json.loads(nft("list table " + TABLE))["nftables"]
    up, down, frames = (
        part["counter"] for item in items if "rule" in item
        for part in item["rule"]["expr"] if "counter" in part
    )  # fmt: skip
    return up["packets"] + down["packets"], up["bytes"] + down["bytes"], frames["packets"]


def main() -> None:
    seconds, is_watched = float(sys.argv[1]), sys.argv[2] == "watched"
    words = ["--any-ports", "--no-watch", *([] if is_watched else ["--no-page"])]
    if sys.argv[3] == "plain":
        words.append("--plain")
    with tempfile.TemporaryDirectory(prefix="upb-") as name:
        options = read_options([*words, "--folder", name, "--board", "host"])
        flight = MeteredFlight(options, Path(name), ROOT, lambda line: None)
        flight.is_protected = sys.argv[3] == "protected"
        flight.budget = float(sys.argv[4]) if sys.argv[4:] else None
        try:
            flight.start()
            time.sleep(SETTLE_S)
            began_s, before = time.monotonic(), counted()
            time.sleep(seconds)
            after, passed_s = counted(), time.monotonic() - began_s
        finally:
            flight.stop()
    packets, size, frames = (b - a for a, b in zip(before, after, strict=True))
    found = {"packets": packets, "bytes": size, "frames": frames, "seconds": passed_s}
    print(json.dumps(found))


if __name__ == "__main__":
    main()
