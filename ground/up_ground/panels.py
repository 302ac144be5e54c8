"""The parts of the picture: flight, position, power, channels, board."""

from __future__ import annotations

import textwrap

from up.commands.event_rules import UNKNOWN
from up.commands.telemetry_schema import RULES
from up_ground.screen_buffer import PanelWriter, Style
from up_ground.status_text import (
    acting_mode,
    busy_text,
    flag_text,
    home_text,
    mission_text,
    number_text,
    wind_text,
)

PANEL_COLUMNS = 38
BATTERY_LOW = next(each.below or 0.0 for each in RULES if each.code == "battery_low")
_CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
_BAR_COLUMNS = 19
_MIN_US = 1000.0
_SPAN_US = 1000.0


def draw_flight(writer: PanelWriter, row: int, column: int) -> int:
    """Draw who flies and whether the motor may turn; return the row below."""
    telemetry = writer.telemetry
    writer.title(row, column, "FLIGHT")
    mode = telemetry.text("mode", limit=26) or UNKNOWN
    controller = telemetry.text("flight_controller", limit=9)
    writer.value(row + 1, column, mode + (f" ({controller})" if controller else ""))
    flown = acting_mode(telemetry) or UNKNOWN
    switch = _word(writer, "arduino", "switch")
    replaced = telemetry.text("flight_control", "fallback") is not None
    selected = telemetry.text("flight_control", "selected", limit=12)
    cause = telemetry.text("failsafe", "cause", limit=13)
    more = f" instead of {selected}" if replaced else f"  switch {switch}"
    if cause is not None and not replaced:
        more = f" by {cause}"
    style = Style.BAD if replaced or cause is not None else Style.PLAIN
    end = writer.value(row + 2, column, f"flight mode {flown}{more}", style=style)
    if telemetry.flag("arduino", "failsafe"):
        writer.value(row + 2, end + 1, "FAILSAFE", style=Style.BAD)
    armed = telemetry.flag("armed")
    style = Style.PLAIN if armed is None else (Style.BAD if armed else Style.GOOD)
    end = writer.value(row + 3, column, flag_text(armed, "ARMED", "disarmed"), style=style)
    writer.value(row + 3, end + 1, mission_text(telemetry) or "")
    vetoes = telemetry.texts("vetoes")
    # In the air a veto is information, not an alarm: it names the condition for arming again.
    text = "against arming again: " if armed else "vetoes "
    text += UNKNOWN if vetoes is None else "; ".join(vetoes) or "none"
    alarm = Style.WARNING if vetoes and not armed else Style.PLAIN
    lines = textwrap.wrap(text, PANEL_COLUMNS, max_lines=2, placeholder=" ...") or [""]
    for line, part in enumerate(lines, row + 4):
        writer.value(line, column, part, style=alarm)
    return row + 6


def draw_position(writer: PanelWriter, row: int, column: int) -> int:
    """Draw where the aircraft is; return the row below."""
    number = writer.telemetry.number
    writer.title(row, column, "LOCATION", "location")
    latitude = number_text(number("location", "latitude"), 6, 11)
    longitude = number_text(number("location", "longitude"), 6, 11)
    satellites = number("location", "satellites")
    more = "" if satellites is None else f" {satellites:.0f} sat"
    writer.value(row + 1, column, f"{latitude} {longitude} deg{more}", "location")
    writer.value(row + 2, column, home_text(writer.telemetry), "location")
    end = writer.value(
        row + 3, column, f"altitude {number_text(number('altitude'), 1, 8)} m", "altitude"
    )
    writer.screen.put(row + 3, end + 1, writer.age("altitude"), Style.DIM)
    actual = number_text(number("heading", "actual"), 0)
    end = writer.value(row + 4, column, f"heading {actual} deg", "heading")
    writer.screen.put(row + 4, end + 1, writer.age("heading"), Style.DIM)
    return row + 5


NAVIGATION_ROWS = 4


def draw_navigation(writer: PanelWriter, row: int, column: int) -> int:
    """Draw the aircraft's own estimate, if it has one; return the row below."""
    if not has_navigation(writer):
        return row
    number = writer.telemetry.number
    writer.title(row, column, "NAVIGATION", "navigation")
    height = number_text(number("navigation", "height"))
    climb = number_text(number("navigation", "climb"), 1, sign=True)
    ground = number_text(number("navigation", "speed"))
    air = number_text(number("navigation", "airspeed"))
    sd_m = number("navigation", "sd", "position")
    spread = number_text(None if sd_m is None else 2 * sd_m, 0)
    for line, text in enumerate(
        (
            f"{height} m above home, climb {climb} m/s",
            f"ground {ground} m/s, air {air} m/s",
            f"{wind_text(writer.telemetry)}, +-{spread} m",
        ),
        row + 1,
    ):
        writer.value(line, column, text, "navigation")
    return row + NAVIGATION_ROWS


def has_navigation(writer: PanelWriter) -> bool:
    """Return whether the aircraft estimates where it is."""
    return writer.telemetry.number("navigation", "latitude") is not None


def draw_power(writer: PanelWriter, row: int, column: int) -> int:
    """Draw batteries, phone and load; return the row below."""
    telemetry = writer.telemetry
    level = telemetry.number("android", "batteryLevel")
    style = Style.BAD if level is not None and level < BATTERY_LOW else Style.PLAIN
    connected = flag_text(telemetry.flag("android", "connected"), "connected", "absent")
    is_contested = telemetry.text("android", "competitor") is not None
    phone = "2nd phone refused" if is_contested else f"phone {connected}"
    phone_style = Style.WARNING if is_contested else Style.PLAIN
    voltage_v = telemetry.number("arduino", "flight_battery_v")
    if voltage_v is None:
        text = f"battery {number_text(level, 0)} %"
        end = writer.value(row, column, text, "battery", style)
    else:
        is_low = telemetry.flag("arduino", "flight_battery_low")
        is_low = is_low or telemetry.flag("arduino", "flight_battery_critical")
        text = f"flight battery {voltage_v:.1f} V"
        end = writer.value(row, column, text, "flight", Style.BAD if is_low else Style.PLAIN)
        if not is_contested and level is not None and connected == "connected":
            phone, phone_style = f"phone {number_text(level, 0)} %", style
    writer.value(row, end + 1, phone, style=phone_style)
    cpu = number_text(telemetry.number("load", "cpu"), 0)
    ram = number_text(telemetry.number("load", "ram"), 0)
    data = telemetry.number("uplink", "mb_per_hour") or None
    rate = "" if data is None else f" {number_text(data)} MB/h"
    writer.value(row + 1, column, f"load {cpu} % memory {ram} %{rate}")
    if telemetry.flag("load", "panic"):
        writer.value(row + 1, column, busy_text(telemetry))
    return row + 2


def draw_channels(writer: PanelWriter, row: int, column: int, reading: str, title: str) -> int:
    """Draw one bar for each channel that the aircraft reports; return the row below."""
    writer.title(row, column, title, reading)
    shown = [name for name in _CHANNELS if writer.telemetry.number(reading, name) is not None]
    for line, name in enumerate(shown or _CHANNELS[:4], row + 1):
        pulse_us = writer.telemetry.number(reading, name)
        text = f"{name:9}{number_text(pulse_us, 0, 5)} {bar(pulse_us)}"
        writer.value(line, column, text, reading)
    return row + 1 + len(shown or _CHANNELS[:4])


def bar(pulse_us: float | None, columns: int = _BAR_COLUMNS) -> str:
    """Return the deflection from 1500 us as a bar; `<` and `>` mark values beyond its ends."""
    cells = [" "] * columns
    middle = columns // 2
    if pulse_us is not None:
        place = (pulse_us - _MIN_US) / _SPAN_US * (columns - 1)
        end = max(0, min(columns - 1, round(place)))
        for cell in range(min(middle, end), max(middle, end) + 1):
            cells[cell] = "#"
        if not 0 <= place <= columns - 1:
            cells[end] = "<" if place < 0 else ">"
    if cells[middle] == " ":
        cells[middle] = "|"
    return f"[{''.join(cells)}]"


def draw_board(writer: PanelWriter, row: int, column: int) -> int:
    """Draw the Arduino and its line; return the row below."""
    telemetry = writer.telemetry
    connected = flag_text(telemetry.flag("arduino", "connected"), "connected", "absent")
    errors = number_text(telemetry.number("arduino", "frame_errors"), 0)
    style = Style.BAD if telemetry.flag("arduino", "connected") is False else Style.PLAIN
    framing = _word(writer, "arduino", "framing")
    text = f"Arduino {connected}, {framing}, errors {errors}"
    writer.value(row, column, text, style=style)
    loop = number_text(telemetry.number("arduino", "loop_us"), 0)
    late = number_text(telemetry.number("arduino", "late_us"), 0)
    end = writer.value(row + 1, column, f"loop {loop} us, late {late} us")
    if telemetry.flag("arduino", "imu_valid") is False:
        writer.value(row + 1, end + 1, "NO IMU", style=Style.BAD)
    elif telemetry.flag("arduino", "restored"):
        writer.value(row + 1, end + 1, "was reset", style=Style.WARNING)
    elif telemetry.flag("arduino", "bias_stored"):
        writer.value(row + 1, end + 1, "old bias", style=Style.WARNING)
    return row + 2


def _word(writer: PanelWriter, *path: str) -> str:
    text = writer.telemetry.text(*path, limit=10)
    if text is not None:
        return text
    number = writer.telemetry.number(*path)
    return UNKNOWN if number is None else f"{number:g}"
