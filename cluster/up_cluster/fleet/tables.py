"""The answers of `up-fleet` as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any


def list_table(answer: dict[str, Any]) -> list[str]:
    """Return the members, and what no member of them holds."""
    rows = [("ID", "KIND", "HOST", "STATE", "AIRCRAFT", "FREE", "LABELS")]
    for each in answer["members"]:
        state = "draining" if each["is_draining"] else "ready"
        free, labels = str(each.get("free", "")), ",".join(each.get("labels", ()))
        count = str(len(each["aircraft"]))
        rows.append((each["id"], each["kind"], each["host"], state, count, free, labels))
    lines = _columns(rows)
    for each in answer["lost"]:
        lines.append(f"{each['aircraft']}: {each['kind']} of {each['id']}, which does not answer")
    lines += [f"{name}: wanted, no runner has it" for name in answer["orphans"]]
    return [*lines, *(f"{name}: asleep until its next request" for name in answer["asleep"])]


def aircraft_table(answer: dict[str, Any]) -> list[str]:
    """Return where one aircraft is."""
    rows = [("KIND", "MEMBER", "HOST", "STATE", "PORTS")]
    for each in answer["places"]:
        ports = " ".join(f"{name}:{port}" for name, port in (each.get("ports") or {}).items())
        rows.append((each["kind"], each["id"], each["host"], each["state"], ports))
    return _columns(rows)


def usage_table(answer: dict[str, Any]) -> list[str]:
    """Return what members and the aircraft at each use, and the tenant's sums and quotas."""
    rows = [("MEMBER", "AIRCRAFT", "STATE", "CPU s", "MB", "RX MB", "GROUNDS")]
    for each in answer["members"]:
        rows.append((each["id"], "", each["kind"], *_usage(each), ""))
        for craft in (*each["aircraft"], *each.get("guests", ())):
            grounds = str(craft.get("grounds", ""))
            rows.append(("", craft["aircraft"], craft["state"], *_usage(craft), grounds))
    tenant = answer["tenant"]
    sums = [("TENANT", "KIND", "USED", "QUOTA")]
    for kind, count in tenant["usage"].items():
        limit, is_bytes = tenant["quota"].get(kind), kind == "hour_bytes"
        used, most = (
            "" if each is None else f"{each / 1e6:.1f}" if is_bytes else f"{each:.0f}"
            for each in (count, limit)
        )
        sums.append((tenant["name"], "mb_per_hour" if is_bytes else kind, used, most))
    return [*_columns(rows), "", *_columns(sums)]


def _usage(row: dict[str, Any]) -> tuple[str, str, str]:
    cpu_s, rss, received = (row.get(name) for name in ("cpu_s", "rss_bytes", "rx_bytes"))
    return (
        "" if cpu_s is None else f"{cpu_s:.1f}",
        "" if rss is None else f"{rss / 1e6:.0f}",
        "" if received is None else f"{received / 1e6:.2f}",
    )


def _columns(rows: Iterable[Sequence[str]]) -> list[str]:
    table = [list(row) for row in rows]
    widths = [max(len(row[column]) for row in table) for column in range(len(table[0]))]
    return [
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip()
        for row in table
    ]
