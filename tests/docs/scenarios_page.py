"""Writes the tables of docs/scenarios.md: ``python -m tests.docs.scenarios_page``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from tests.docs.configuration_page import BEGIN, END, _bounds, _default
from up.config.schema import Entry, ListOf, Schema
from up_simulator.scenario.file import SCHEMA
from up_simulator.scenario.signals import SIGNALS, Kind

PAGE = Path(__file__).parents[2] / "docs" / "scenarios.md"
GROUPS = {
    "time_s": "time",
    "truth": "truth: the exact state of the aircraft, unknown aboard",
    "stick": "stick: pulses of the pilot's sticks",
    "servo": "servo: pulses measured at the outputs",
    "board": "board: reports of the Arduino (its status every 200 ms, its attitude every 20 ms)",
    "demand": "demand: demands in the active mode",
    "error": "error: truth minus demand",
    "estimate_error": "estimate_error: estimate of the Arduino minus truth",
    "raspilot": "raspilot: the daemon",
    "phone": "phone: the phone aboard",
    "distance": "distance: of the true position from places in telemetry",
    "ground": "ground: telemetry at the ground station, by its names",
    "goggles": "goggles: what the pilot sees on them",
    "metrics": "metrics: the daemon's page for Prometheus",
    "mavlink": "mavlink: what a ground station that speaks MAVLink gets",
}


def tables() -> str:
    """Return the generated part of the page."""
    return "\n".join([*_key_tables(), *_signal_tables()])


def _key_tables() -> Iterator[str]:
    yield "## Keys\n"
    yield "| key | default | unit, range | |"
    yield "|---|---|---|---|"
    lists: list[tuple[str, Schema]] = []
    yield from _rows(SCHEMA.entries, "", lists)
    yield ""
    for name, schema in lists:
        yield f"### An item of `{name}`\n"
        if schema.comment:
            yield f"{' '.join(schema.comment.split())}\n"
        yield "| key | default | unit, range | |"
        yield "|---|---|---|---|"
        yield from _rows(schema.entries, "", [])
        yield ""


def _rows(entries: Iterable[Entry], above: str, lists: list[tuple[str, Schema]]) -> Iterator[str]:
    for entry in entries:
        comment = " ".join(entry.comment.split()).replace("|", "\\|")
        name = f"`{above}{entry.name}`"
        if isinstance(entry.spec, Schema):
            absent = "" if entry.default is not None else "absent"
            yield f"| {name} | {absent} | | {comment} |"
            yield from _rows(entry.spec.entries, f"{above}{entry.name}.", lists)
            continue
        if isinstance(entry.spec, ListOf) and isinstance(entry.spec.item, Schema):
            lists.append((above + entry.name, entry.spec.item))
        default = "required" if entry.name == "at_s" else _default(entry)
        yield f"| {name} | {default} | {_bounds(entry)} | {comment} |"


def _signal_tables() -> Iterator[str]:
    yield "## Signals\n"
    yield "`ground.counters.<part>.<name>` are the counters of the modules,"
    yield "`metrics.up_telemetry.<field>` and `metrics.up_counters.<part>.<name>` the metrics.\n"
    for source, title in GROUPS.items():
        yield f"### {title}\n"
        yield "| signal | unit | |"
        yield "|---|---|---|"
        for signal in SIGNALS.values():
            if signal.source == source:
                unit = signal.unit if signal.kind is Kind.NUMBER else signal.kind.value
                yield f"| `{signal.name}` | {unit} | {signal.about} |"
        yield ""


def main() -> None:
    """Write the page's tables again."""
    head, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    _, _, tail = rest.partition(END)
    PAGE.write_text(f"{head}{BEGIN}\n{tables()}\n{END}{tail}", encoding="utf-8")


if __name__ == "__main__":
    main()
