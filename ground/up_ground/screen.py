"""The screen of the aircraft: a pure function from known values to a grid of characters."""

from __future__ import annotations

import math
from dataclasses import dataclass

from up.sanitize_text import sanitize_text
from up_ground.link_status import LinkStatus
from up_ground.panels import (
    NAVIGATION_ROWS,
    draw_board,
    draw_channels,
    draw_flight,
    draw_navigation,
    draw_position,
    draw_power,
    has_navigation,
)
from up_ground.screen_buffer import PanelWriter, ScreenBuffer, Style
from up_ground.settings import Seat, Settings
from up_ground.status_text import (
    age_text,
    control_text,
    flag_text,
    hop_text,
    link_text,
    number_text,
    security_text,
)
from up_ground.telemetry import Telemetry

PITCH_RANGE_DEG = 60.0
"""From the upper edge of the picture to the lower one."""
_LETTER_ASPECT = 2.0
"""A character's height divided by its width, about."""


def draw_horizon(
    screen: ScreenBuffer,
    row: int,
    column: int,
    size: tuple[int, int],
    attitude: tuple[float | None, float | None],
    dim: bool,
) -> None:
    """Draw the horizon as the pilot sees it.

    ``size`` is (columns, rows), ``attitude`` (roll, pitch) in degrees: right wing down and nose up
    are positive, so roll to the right raises the earth on the right. Unknown: an empty frame.
    """
    columns, rows = size
    roll_deg, pitch_deg = attitude
    if roll_deg is None or pitch_deg is None:
        for line in range(rows):
            screen.put(row + line, column, "." * columns, Style.DIM)
        screen.put(row + rows // 2, column + columns // 2 - 3, "  --  ", Style.DIM)
        return
    roll = math.radians(math.fmod(roll_deg, 360))
    pitch_rows = max(-90.0, min(90.0, pitch_deg)) * rows / PITCH_RANGE_DEG
    for line in range(rows):
        up = (rows - 1) / 2 - line
        for place in range(columns):
            right = (place - (columns - 1) / 2) / _LETTER_ASPECT
            height = up * math.cos(roll) - right * math.sin(roll) + pitch_rows
            letter, style = _letter(height)
            screen.put(row + line, column + place, letter, Style.DIM if dim else style)
    style = Style.DIM if dim else Style.BOLD
    screen.put(row + rows // 2, column + columns // 2 - 4, "--(", style)
    screen.put(row + rows // 2, column + columns // 2, "+", style)
    screen.put(row + rows // 2, column + columns // 2 + 2, ")--", style)


def _letter(height_rows: float) -> tuple[str, Style]:
    if abs(height_rows) < 0.5:
        return "=", Style.BOLD
    return (" ", Style.SKY) if height_rows > 0 else (":", Style.EARTH)


RIGHT_COLUMN = 41
WIDE = 76
_HORIZON_COLUMNS = 37
_MIN_HORIZON_ROWS = 3
_MAX_HORIZON_ROWS = 15


@dataclass(slots=True)
class State:
    """All that a picture shows; ``notice`` is the newest thing that happened."""

    settings: Settings
    status: LinkStatus
    telemetry: Telemetry
    notice: str = ""
    keys: str = ""


def draw(state: State, now_s: float, size: tuple[int, int]) -> ScreenBuffer:
    """Return the picture for a terminal of ``size`` (columns, rows) at a moment."""
    screen = ScreenBuffer(*size)
    writer = PanelWriter(screen, state.telemetry, now_s)
    _draw_header(screen, state, now_s)
    if screen.columns >= WIDE:
        _draw_wide(writer, screen.rows)
    else:
        _draw_narrow(writer)
    _draw_footer(screen, state)
    return screen


def render(state: State, now_s: float, size: tuple[int, int]) -> str:
    """Return the picture's rows, separated by LF, with their ANSI styles."""
    return draw(state, now_s, size).ansi()


def _draw_header(screen: ScreenBuffer, state: State, now_s: float) -> None:
    status, telemetry, settings = state.status, state.telemetry, state.settings
    screen.fill(0, Style.HEADER)
    # The name and the role of the key need the columns.
    link = hop_text(status) if status.is_open else link_text(status, now_s)
    words = f" {settings.aircraft} at {settings.address}  {link}"
    column = screen.put(0, 0, sanitize_text(words), Style.HEADER)
    if status.is_open and not settings.direct:
        column = screen.put(0, column, f"  control {control_text(status)}", Style.HEADER)
    screen.put(0, column, f"  {security_text(status)}", Style.HEADER)
    online = flag_text(status.is_aircraft_online, "online", "offline")
    is_silent = telemetry.is_silent(now_s)
    presence = Style.BAD if status.is_aircraft_online is False else Style.PLAIN
    style = Style.BAD if is_silent and telemetry.frames else Style.PLAIN
    age = age_text(telemetry.age_s(now_s))
    column = screen.put(1, 1, f"aircraft {online}", presence)
    column = screen.put(1, column + 2, f"{'SILENT ' if is_silent else ''}age {age}", style)
    way = number_text(status.round_trip_ms, 1)
    rate = number_text(telemetry.rate_hz(now_s))
    screen.put(
        1,
        column + 2,
        f"{rate} Hz  proxy {way} ms  lost {telemetry.lost}  dropped {status.dropped}",
        Style.DIM,
    )


def _draw_wide(writer: PanelWriter, rows: int) -> None:
    spare = max(0, rows - 24)
    horizon_rows = max(_MIN_HORIZON_ROWS, min(_MAX_HORIZON_ROWS, 8 + min(spare, rows - 16)))
    below = 8 + horizon_rows
    if has_navigation(writer):
        horizon_rows = max(_MIN_HORIZON_ROWS, horizon_rows - NAVIGATION_ROWS)
    _draw_attitude(writer, 3, 1)
    draw_horizon(
        writer.screen,
        7,
        1,
        (_HORIZON_COLUMNS, horizon_rows),
        _attitude(writer),
        writer.is_old("orientation"),
    )
    draw_navigation(writer, 7 + horizon_rows, 1)
    draw_channels(writer, below, 1, "rx", "RECEIVER us")
    row = draw_flight(writer, 3, RIGHT_COLUMN)
    row = draw_position(writer, row, RIGHT_COLUMN)
    draw_power(writer, row, RIGHT_COLUMN)
    row = draw_channels(writer, below, RIGHT_COLUMN, "servo", "SERVOS us")
    draw_board(writer, row, RIGHT_COLUMN)


def _draw_narrow(writer: PanelWriter) -> None:
    row = draw_flight(writer, 3, 1)
    _draw_attitude(writer, row, 1)
    row = draw_position(writer, row + 4, 1)
    row = draw_navigation(writer, row, 1)
    row = draw_power(writer, row, 1)
    row = draw_channels(writer, row, 1, "servo", "SERVOS us")
    row = draw_channels(writer, row, 1, "rx", "RECEIVER us")
    draw_board(writer, row, 1)


def _attitude(writer: PanelWriter) -> tuple[float | None, float | None]:
    telemetry = writer.telemetry
    return telemetry.number("orientation", "roll"), telemetry.number("orientation", "pitch")


def _draw_attitude(writer: PanelWriter, row: int, column: int) -> None:
    writer.title(row, column, "ATTITUDE", "orientation")
    for line, axis in enumerate(("roll", "pitch", "yaw"), row + 1):
        angle = number_text(writer.telemetry.number("orientation", axis), 1, 7, axis != "yaw")
        rate = number_text(writer.telemetry.number("rates", axis), 1, 7, True)
        writer.value(line, column, f"{axis:6}{angle} deg {rate} deg/s", "orientation")


def _draw_footer(screen: ScreenBuffer, state: State) -> None:
    status = state.status
    row = screen.rows - 1
    screen.put(row, 0, " " * screen.columns)
    if not status.is_open and status.reason:
        screen.put(row, 1, sanitize_text(status.reason), Style.BAD)
        return
    if status.seat is Seat.COMMAND and status.asked_by is not None:
        text = f"ground {status.asked_by} requests control: press g to hand it over"
        screen.put(row, 1, text, Style.WARNING)
        return
    column = screen.put(row, 1, sanitize_text(state.keys), Style.DIM)
    screen.put(row, column + 2, sanitize_text(state.notice), Style.WARNING)
