"""The answers of `up-fleet` as text."""

from __future__ import annotations

from typing import Any

from up.output import table


def list_table(answer: dict[str, Any]) -> list[str]:
    """Return the members, and what no member of them holds."""
    head = ("ID", "KIND", "HOST", "STATE", "AIRCRAFT", "FREE", "LABELS")
    rows: list[tuple[str, ...]] = []
    for each in answer["members"]:
        state = "draining" if each["is_draining"] else "ready"
        free, labels = str(each.get("free", "")), ",".join(each.get("labels", ()))
        count = str(sum(craft["state"] != "offline" for craft in each["aircraft"]))
        rows.append((each["id"], each["kind"], each["host"], state, count, free, labels))
    return [*table(head, rows).splitlines(), *_missing(answer)]


def _missing(answer: dict[str, Any]) -> list[str]:
    """Return the entries that no member of the answer has."""
    lines = [] if answer["members"] else ["no member of this tenant has answered"]
    for each in answer["lost"]:
        lines.append(f"{each['aircraft']}: {each['kind']} of {each['id']}, which does not answer")
    lines += [f"{name}: wanted, no runner has it" for name in answer["orphans"]]
    return [*lines, *(f"{name}: asleep until its next request" for name in answer["asleep"])]


def aircraft_table(answer: dict[str, Any]) -> list[str]:
    """Return where one aircraft is."""
    rows: list[tuple[str, ...]] = []
    for each in answer["places"]:
        ports = " ".join(f"{name}:{port}" for name, port in (each.get("ports") or {}).items())
        rows.append((each["kind"], each["id"], each["host"], each["state"], ports))
    return table(("KIND", "MEMBER", "HOST", "STATE", "PORTS"), rows).splitlines()


def usage_table(answer: dict[str, Any]) -> list[str]:
    """Return what members and the aircraft at each use, and the tenant's sums and quotas."""
    rows: list[tuple[str, ...]] = []
    for each in answer["members"]:
        state = f"{each['kind']}, draining" if each["is_draining"] else each["kind"]
        rows.append((each["id"], "", state, *_usage(each), ""))
        for craft in (*each["aircraft"], *each.get("guests", ())):
            grounds = str(craft.get("grounds", ""))
            rows.append(("", craft["aircraft"], craft["state"], *_usage(craft), grounds))
    tenant = answer["tenant"]
    sums: list[tuple[str, ...]] = []
    for kind, count in tenant["usage"].items():
        limit, is_bytes = tenant["quota"].get(kind), kind == "hour_bytes"
        used, most = (
            "" if each is None else f"{each / 1e6:.1f}" if is_bytes else f"{each:.0f}"
            for each in (count, limit)
        )
        sums.append((tenant["name"], "mb_per_hour" if is_bytes else kind, used, most))
    head = ("MEMBER", "AIRCRAFT", "STATE", "CPU s", "MB", "RX MB", "GROUNDS")
    of_tenant = table(("TENANT", "KIND", "USED", "QUOTA"), sums)
    lines = [*table(head, rows).splitlines(), *_missing(answer)]
    return [*lines, "", *of_tenant.splitlines()]


def _usage(row: dict[str, Any]) -> tuple[str, str, str]:
    cpu_s, rss, received = (row.get(name) for name in ("cpu_s", "rss_bytes", "rx_bytes"))
    return (
        "" if cpu_s is None else f"{cpu_s:.1f}",
        "" if rss is None else f"{rss / 1e6:.0f}",
        "" if received is None else f"{received / 1e6:.2f}",
    )
