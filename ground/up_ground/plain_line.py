"""The aircraft in one line of plain text."""

from __future__ import annotations

from up_ground.link_status import LinkStatus
from up_ground.telemetry import Telemetry
from up_ground.wording import (
    UNKNOWN,
    age_text,
    busy_text,
    flag_text,
    link_text,
    number_text,
    seat_text,
)


def plain_line(status: LinkStatus, telemetry: Telemetry, now_s: float) -> str:
    """Return link, age and flight values; stale values are shown as unknown."""
    link = f"link {link_text(status, now_s)}"
    if not status.is_open and status.reason:
        return f"{link}: {status.reason}"
    online = flag_text(status.is_aircraft_online, "online", "offline")
    age = age_text(telemetry.age_s(now_s))
    parts = [link, f"seat {seat_text(status)}", f"aircraft {online}", f"age {age}"]
    if telemetry.is_silent(now_s):
        return " | ".join([*parts, "silent"])
    orientation = [_fresh(telemetry, now_s, "orientation", name) for name in _AXES]
    roll, pitch, yaw = (number_text(each, sign=name != "yaw") for name, each in orientation)
    altitude = number_text(_fresh(telemetry, now_s, "altitude")[1])
    heading = number_text(_fresh(telemetry, now_s, "heading", "actual")[1], 0)
    vetoes = telemetry.texts("vetoes") or []
    parts += [
        f"roll {roll} pitch {pitch} yaw {yaw}",
        f"altitude {altitude} m",
        f"heading {heading}",
        f"flight mode {telemetry.text('flight_mode') or UNKNOWN}",
        flag_text(telemetry.flag("armed"), "ARMED", "disarmed"),
    ]
    competitor = telemetry.text("android", "competitor")
    if competitor is not None:
        parts.append(f"a second phone is refused: {competitor}")
    if vetoes:
        word = "against arming again" if telemetry.flag("armed") else "vetoes"
        parts.append(f"{word}: {'; '.join(vetoes)}"[:200])
    if telemetry.flag("load", "panic"):
        parts.append(busy_text(telemetry))
    return " | ".join(parts)


_AXES = ("roll", "pitch", "yaw")


def _fresh(telemetry: Telemetry, now_s: float, *path: str) -> tuple[str, float | None]:
    stale = telemetry.is_stale(path[0], now_s)
    return path[-1], None if stale else telemetry.number(*path)
