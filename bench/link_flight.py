"""A flight of `make run` in a separate network namespace, and what its uplink costs at IP level.

`python -m bench.link_flight SECONDS WATCHED [BUDGET]`, as root inside `unshare --net`; prints one
JSON object: IP packets and bytes in both directions between aircraft and proxy, and the seconds.
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from up_simulator.demo.flight import DemoFlight
from up_simulator.demo.main import ROOT, read_options

SETTLE_S = 12.0
TABLE = "inet link"
LOAD_GUARD = ("load_guard.LoadGuard", "system_state_provider.SystemStateProvider")


class MeteredFlight(DemoFlight):
    """Flies with a data budget; other programs' load does not slow its telemetry."""

    budget = ""

    def _write_config(self) -> None:
        super()._write_config()
        folder = self._folder / "config"
        with (folder / "mission_control.yml").open("a", encoding="utf-8") as file:
            file.write(f"data_budget_mb_per_hour: {self.budget}\n")
        disabled = ", ".join(f"load_guard_cog.modules.{name}" for name in LOAD_GUARD)
        (folder / "disabled_modules.yml").write_text(f"disabled modules: [{disabled}]\n")
        count_port(self._ports.airborne)


def nft(*words: str) -> str:
    return subprocess.run(["nft", "-j", *words], check=True, capture_output=True, text=True).stdout


def count_port(port: int) -> None:
    """Count the packets from and to a TCP port; on the loopback each passes `input` once."""
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    nft(f"add table {TABLE}; add chain {TABLE} c {{ type filter hook input priority 0; }}")
    for way in ("sport", "dport"):
        nft(f"add rule {TABLE} c tcp {way} {port} counter")


def counted() -> tuple[int, int]:
    """Return packets and bytes so far."""
    items = json.loads(nft("list table " + TABLE))["nftables"]
    counters = [
        part["counter"] for item in items if "rule" in item
        for part in item["rule"]["expr"] if "counter" in part
    ]  # fmt: skip
    return sum(each["packets"] for each in counters), sum(each["bytes"] for each in counters)


def main() -> None:
    seconds, is_watched = float(sys.argv[1]), sys.argv[2] == "watched"
    words = ["--any-ports", "--no-watch", *([] if is_watched else ["--no-page"])]
    with tempfile.TemporaryDirectory(prefix="upb-") as name:
        options = read_options([*words, "--folder", name, "--board", "host"])
        flight = MeteredFlight(options, Path(name), ROOT, lambda line: None)
        flight.budget = "".join(sys.argv[3:])
        try:
            flight.start()
            time.sleep(SETTLE_S)
            began_s, (packets, size) = time.monotonic(), counted()
            time.sleep(seconds)
            (more, bytes_), passed_s = counted(), time.monotonic() - began_s
        finally:
            flight.stop()
    print(json.dumps({"packets": more - packets, "bytes": bytes_ - size, "seconds": passed_s}))


if __name__ == "__main__":
    main()
