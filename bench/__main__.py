"""Measures all or the named subjects and prints one table: ``python -m bench [NAME ...]``."""

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from subprocess import SubprocessError

from bench.table import LeftOutError, Row, format_table

SUBJECTS = {
    "attacks": "attacks of a hostile relay, with the rule that stops each and without it",
    "bus": "publishing to 1, 10 and 100 subscribers",
    "codecs": "the serial line, orientation and CRSF from bytes",
    "envelope": "protected messages beside plain ones, and mutated ones",
    "cascade": "the control loop's arithmetic",
    "latency": "sensor to actuator through the running daemon",
    "link": "data of the uplink at IP level, and CPU of packed telemetry",
    "mavlink": "CPU of a MAVLink client at 100 messages a second, and the delay of an answer",
    "goggles": "the goggles' OSD: CPU of a drawn frame, bytes of a flight",
    "metrics": "a scrape of the daemon beside prometheus-client's own page",
    "foxglove": "live telemetry in Foxglove beside the same messages by a plain WebSocket",
    "msp": "a Betaflight board by MSP: its answers, and its switch until its output",
    "startup": "start to ports bound, and memory",
    "load": "CPU of the daemon in flight and idle",
    "recorder": "what recording the flight costs",
    "flight_log": "writing and reading flight logs beside the official package",
    "relay": "the proxy beside HAProxy and socat",
    "cluster": "proxies on NATS: the hop between nodes, the loss of a leader or of a host",
    "cluster_faults": "proxies on NATS: partitions, kills, restarts, a storm, searches; 25 min",
    "tls": "the proxy's TLS beside HAProxy's: round trip, memory, handshakes, reconnect",
    "uplinks": "failover between two network interfaces, with TLS and keys",
    "firmware": "the compiled firmware in the AVR simulator",
    "navigation": "loiter, legs, return, lost position and a stopped motor with a phone's GPS",
    "attitude": "the firmware's attitude beside the truth, with the gyro errors of each seed",
    "simulator": "the virtual aircraft against the clock",
    "demo": "CPU of every process of make run",
    "page": "from telemetry to the pixel of the ground station's page",
}
FAILED = "failed"


def measure(names: Iterable[str], quick: bool, notify: Callable[[str], object]) -> list[Row]:
    """Return the rows of the subjects with these names; a failed one is a row, too."""
    rows: list[Row] = []
    for name in names:
        notify(f"{name}: {SUBJECTS[name]} ...")
        subject = import_module(f"bench.{name}")
        try:
            for row in subject.rows(quick):
                notify(f"    {row.what}: {row.ours} {row.ratio}".rstrip())
                rows.append(row)
        except LeftOutError as error:
            notify(f"    left out: {error}")
            rows.append(Row(name, left_out=str(error)))
        except (RuntimeError, OSError, SubprocessError) as error:
            notify(f"    {error}")
            rows.append(Row(name, FAILED, peer=str(error).splitlines()[0][:80], met=False))
    return rows


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; the exit status is 1 if a measurement failed, not if one was left out."""
    parser = argparse.ArgumentParser(
        prog="python -m bench",
        description="Measures this project beside its peers. Progress goes to stderr.",
        epilog="; ".join(f"{name}: {text}" for name, text in SUBJECTS.items()),
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(SUBJECTS))
    parser.add_argument(
        "--quick", action="store_true", help="a look in about a minute, with coarse figures"
    )
    parser.add_argument("--markdown", action="store_true", help="the table for docs/performance.md")
    values = parser.parse_args(arguments)
    unknown = [name for name in values.names if name not in SUBJECTS]
    if unknown:
        parser.error(f"unknown subject {unknown[0]!r}; subjects: {', '.join(SUBJECTS)}")
    names = values.names or list(SUBJECTS)
    rows = measure(names, values.quick, lambda text: print(text, file=sys.stderr, flush=True))
    print(format_table(rows, values.markdown))
    return int(any(row.ours == FAILED for row in rows))


if __name__ == "__main__":
    sys.exit(main())
