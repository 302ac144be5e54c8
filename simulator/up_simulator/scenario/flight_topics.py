"""Converts a row of a scenario's log to the Commands of a flight log."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from up_simulator.aircraft.truth import NAMES, TOPIC
from up_simulator.scenario.board_topics import BoardTopics
from up_simulator.scenario.log import ROW_S, Value
from up_simulator.scenario.log_row import Data, LogRow, Message
from up_simulator.scenario.place_topics import SeenByGround, TruePlace
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.signals import Kind, signal_of

SIGNALS_TOPIC = "simulator.signals"
SIGNALS_S = 0.1


class FlightTopics:
    """Turns the rows of a scenario's log into messages, in the order of their times."""

    def __init__(self, scenario: Scenario) -> None:
        self._board = BoardTopics(scenario.has_raspilot)
        self._true_place = TruePlace() if scenario.phone is None else None
        self._seen = SeenByGround()
        self._signals_due_s = -math.inf

    def messages(self, values: Mapping[str, Value]) -> Iterator[Message]:
        """Yield topic and data of everything in this row."""
        row = LogRow(values)
        yield TOPIC, _truth(row)
        yield from self._board.messages(row)
        yield from self._seen.messages(row)
        if self._true_place is not None:
            yield from self._true_place.messages(row)
        if row.time_s >= self._signals_due_s - ROW_S / 2:
            self._signals_due_s = row.time_s + SIGNALS_S
            yield SIGNALS_TOPIC, _signals(row)


def _truth(row: LogRow) -> Data:
    values: Data = {name: row.number(f"truth.{field}") for name, field in NAMES.items()}
    values |= {"time_s": row.time_s, "crashed": bool(row.flag("truth.crashed"))}
    return {name: value for name, value in values.items() if value is not None}


def _signals(row: LogRow) -> Data:
    """Return all that is neither the truth nor an event, by its dotted names."""
    tree: Data = {}
    for name, value in row.known():
        source, _, rest = name.partition(".")
        if source != "truth" and rest:
            is_flag = signal_of(name).kind is Kind.FLAG
            _hang(tree, name.split("."), bool(value) if is_flag else value)
    return tree


def _hang(tree: Data, path: list[str], value: Value | bool) -> None:
    """Put a value into nested maps; where a value is in the way the rest stays one key."""
    *above, last = path
    for at, part in enumerate(above):
        below = tree.setdefault(part, {})
        if not isinstance(below, dict):
            tree[".".join([*above[at:], last])] = value
            return
        tree = below
    tree[last] = value
