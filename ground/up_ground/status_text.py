"""Numbers, ages and the aircraft's state as lines of text; unknown is ``--``."""

from __future__ import annotations

from up import telemetry_frame
from up.commands.event_rules import UNKNOWN, fill
from up.commands.telemetry_schema import MODE_REASONS, RULES
from up_ground.link_status import LinkStatus
from up_ground.settings import Seat
from up_ground.telemetry import Telemetry


def number_text(value: float | None, decimals: int = 1, width: int = 0, sign: bool = False) -> str:
    """Return a number right-aligned in ``width``; one that does not fit is shown as stars."""
    if value is None:
        return UNKNOWN.rjust(width)
    text = f"{value:{'+' if sign else ''}.{decimals}f}"
    if float(text) == 0:
        text = text.replace("-", "+" if sign else "")
    return "*" * width if 0 < width < len(text) else text.rjust(width)


def age_text(age_s: float | None) -> str:
    """Return an age in at most six characters: ``0.03 s``, ``12.4 s``, ``3 min``, ``2 h``."""
    if age_s is None:
        return UNKNOWN
    if age_s < 9.995:
        return f"{max(0.0, age_s):.2f} s"
    if age_s < 99.95:
        return f"{age_s:.1f} s"
    if age_s < 3600:
        return f"{age_s / 60:.0f} min"
    return f"{age_s / 3600:.0f} h" if age_s < 360_000 else "days"


def flag_text(value: bool | None, yes: str = "yes", no: str = "no") -> str:
    """Return the word for a flag."""
    return UNKNOWN if value is None else (yes if value else no)


def busy_text(telemetry: Telemetry) -> str:
    """Return the load and telemetry's period while the Raspberry Pi is busy (Panic Mode)."""
    return fill(next(each.text for each in RULES if each.code == "panic"), telemetry)


def acting_mode(telemetry: Telemetry) -> str | None:
    """Return the flight mode that acts: the Raspberry Pi's while it flies; None: unknown."""
    board = telemetry.text("flight_mode", limit=10)
    return telemetry_frame.acting_mode(board, telemetry.text("flight_control", "mode", limit=12))


def home_text(telemetry: Telemetry) -> str:
    """Return distance and bearing of home, and how long the way takes in this wind."""
    distance = number_text(telemetry.number("home", "distance"), 0)
    bearing = number_text(telemetry.number("home", "bearing"), 0)
    time_s = telemetry.number("home", "time_s")
    way = "" if time_s is None else f", {int(time_s) // 60}:{int(time_s) % 60:02}"
    return f"home {distance} m, bearing {bearing} deg{way}"


def wind_text(telemetry: Telemetry) -> str:
    """Return the estimated wind."""
    speed = number_text(telemetry.number("navigation", "wind", "speed"))
    from_deg = number_text(telemetry.number("navigation", "wind", "from"), 0)
    return f"wind {speed} m/s from {from_deg} deg"


def mission_text(telemetry: Telemetry) -> str | None:
    """Return which item of the mission is flown, or is next; None: there is no mission."""
    count, item = telemetry.number("mission", "count"), telemetry.number("mission", "item")
    if not count or item is None:
        return None
    if telemetry.flag("mission", "is_finished"):
        return f"mission finished, {count:.0f} items"
    distance_m = telemetry.number("mission", "distance")
    way = "" if distance_m is None else f", {distance_m:.0f} m"
    return f"mission item {item:.0f} of {count:.0f}{way}"


def data_text(telemetry: Telemetry) -> str:
    """Return what the aircraft's link costs; empty while it is not known."""
    total = telemetry.number("uplink", "mb")
    if not total:
        return ""
    rate = number_text(telemetry.number("uplink", "mb_per_hour"))
    limit = telemetry.number("uplink", "budget_mb_per_hour")
    return f"{rate}{'' if limit is None else f' of {limit:g}'} MB/h, {total:.1f} MB"


def control_text(status: LinkStatus) -> str:
    """Return the owner of control: ours, free, or the number of a ground."""
    if status.seat is None:
        return UNKNOWN
    if status.seat is Seat.COMMAND:
        return "ours"
    if not status.is_holder_known:
        return "not ours"
    return "free" if status.holder is None else f"ground {status.holder}"


def security_text(status: LinkStatus) -> str:
    """Return how the link is protected, with the name and role of this device's key."""
    if not status.is_keyed:
        return (
            "no key" if not status.unprotected else "no key of this aircraft: run 'up-ground pair'"
        )
    if status.key_role:
        secrecy = ", encrypted" if status.is_secret else ""
        return f"end to end{secrecy}: {status.key_name} ({status.key_role})"
    return f"key {status.key_name} {status.key_refusal or 'not accepted yet'}"


def hop_text(status: LinkStatus) -> str:
    """Return how the connection is protected: plain, or TLS and the peer."""
    return "plain" if status.tls_peer is None else f"TLS {status.tls_peer}"


def link_text(status: LinkStatus, now_s: float) -> str:
    """Return the state of the connection, and how it is protected."""
    state: str = status.state.value
    if status.is_open:
        return f"{state}, {hop_text(status)}"
    if not status.failures:
        return state
    return f"down for {age_text(now_s - status.since_s)}, attempt {status.failures + 1}"


def plain_line(status: LinkStatus, telemetry: Telemetry, now_s: float) -> str:
    """Return link, age and flight values; stale values are shown as unknown."""
    link = f"link {link_text(status, now_s)}"
    if not status.is_open and status.reason:
        return f"{link}: {status.reason}"
    online = flag_text(status.is_aircraft_online, "online", "offline")
    age = age_text(telemetry.age_s(now_s))
    parts = [link, security_text(status)]
    parts += [f"control {control_text(status)}", f"aircraft {online}", f"age {age}"]
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
        f"flight mode {acting_mode(telemetry) or UNKNOWN}",
        flag_text(telemetry.flag("armed"), "ARMED", "disarmed"),
    ]
    if telemetry.number("navigation", "latitude") is not None:
        is_old = telemetry.is_stale("navigation", now_s)
        parts.append(UNKNOWN if is_old else f"{home_text(telemetry)} | {wind_text(telemetry)}")
    mission = mission_text(telemetry)
    if mission is not None:
        parts.append(mission)
    fallback = telemetry.text("flight_control", "fallback")
    if fallback is not None:
        selected = telemetry.text("flight_control", "selected") or UNKNOWN
        parts.append(f"replaces {selected}: {MODE_REASONS.get(fallback, fallback)}")
    cause = telemetry.text("failsafe", "cause")
    if cause is not None:
        parts.append(f"failsafe: {MODE_REASONS.get(cause, cause)}")
    competitor = telemetry.text("android", "competitor")
    if competitor is not None:
        parts.append(f"a second phone is refused: {competitor}")
    if vetoes:
        word = "against arming again" if telemetry.flag("armed") else "vetoes"
        parts.append(f"{word}: {'; '.join(vetoes)}"[:200])
    if telemetry.flag("load", "panic"):
        parts.append(busy_text(telemetry))
    if data := data_text(telemetry):
        soon = number_text(telemetry.number("uplink", "mb_in_an_hour"))
        parts.append(f"data {data}, in an hour {soon} MB")
    return " | ".join(parts)


_AXES = ("roll", "pitch", "yaw")


def _fresh(telemetry: Telemetry, now_s: float, *path: str) -> tuple[str, float | None]:
    stale = telemetry.is_stale(path[0], now_s)
    return path[-1], None if stale else telemetry.number(*path)
