"""Requests of the ground that were refused."""

from __future__ import annotations

import re
from collections.abc import Iterator

from up.flight_log.facts import Facts
from up.flight_log.wrong import Judge, Wrong

_ANSWERED = "up.command.answered"
_MOST_KINDS = 100
_REFUSED = re.compile(r"\S+ refused (up\.arm|up\.disarm|up\.flight_mode\.set): (.+)")

_Kind = tuple[str, str, str]


def refused(facts: Facts) -> Iterator[Wrong]:
    """Refused Commands, one entry per kind with its count.

    A log of an older recorder has no answers: there the program's log supplies arming and modes.
    """
    first_s: dict[_Kind, float] = {}
    counts: dict[_Kind, int] = {}
    untold, untold_s = 0, 0.0
    for each in facts.log.messages(_ANSWERED):
        left_out = each.data.get("untold")
        if type(left_out) is int and left_out > 0:
            untold, untold_s = untold + left_out, untold_s or each.time_s
        if each.data.get("outcome") != "nack":
            continue
        name, link, reason = (str(each.data.get(key) or "") for key in ("name", "link", "reason"))
        kind = (name or "a message", link, reason.removeprefix(f"{name}: "))
        if kind in counts:
            counts[kind] += 1
        elif len(counts) < _MOST_KINDS:
            counts[kind], first_s[kind] = 1, each.time_s
    for kind, count in counts.items():
        name, link, reason = kind
        often = f", {count} times" if count > 1 else ""
        yield Wrong(first_s[kind], "info", f"{name} of {link} was refused: {reason}{often}")
    if untold:
        yield Wrong(untold_s, "info", f"{untold} answers to Commands came too fast to be logged")
    if _ANSWERED not in facts.log.topics:
        for line in facts.log_lines:
            match = _REFUSED.match(line.text)
            if match is not None:
                yield Wrong(line.time_s, "info", f"{match[1]} was refused: {match[2]}")


COMMAND_JUDGMENTS: tuple[Judge, ...] = (refused,)
