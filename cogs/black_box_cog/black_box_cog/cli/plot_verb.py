"""``up log plot``."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

from black_box_cog.cli.open_flight import flight_of, read
from black_box_cog.cli.suggestions import no_such_field
from black_box_cog.cli.terminal import tell
from black_box_cog.export.csv_cells import flat
from black_box_cog.export.output import write_file
from black_box_cog.pictures.canvas import MISSING, PictureError, has_matplotlib, png_of
from black_box_cog.pictures.chart import Curve, Panel, Stage
from black_box_cog.pictures.overview_picture import WIDTH_IN as OVERVIEW_IN
from black_box_cog.pictures.overview_picture import draw_overview, overview_height_in
from black_box_cog.pictures.theme import DAYLIGHT
from black_box_cog.pictures.timeline import draw_timeline, timeline_height_in
from black_box_cog.report.content import report_content
from black_box_cog.report.formatting import start_text
from black_box_cog.report.report_data import bands_of
from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.flight_context import FlightContext
from up.flight_log.flight_log import FlightLog
from up.flight_log.mcap_format import FlightLogError
from up.flight_log.spans import duration_text

WIDTH_IN, DPI = 11.0, 130
MAX_FIELDS = 12
_LOOKED_AT = 200
_COLOURS = ("blue", "orange", "green", "vermilion", "purple", "sky")
_STYLES = ("-", "--", "-.", ":")


def run(values: argparse.Namespace) -> int:
    """Plot a flight."""
    if not has_matplotlib():
        raise CliError(MISSING)
    flight = flight_of(values)
    log = read(flight)
    path = values.output or Path(f"{flight.name}.png")
    if path.suffix.lower() != ".png":
        raise CliError(f"{path}: a picture's name ends in .png", status=2)
    if not values.force and path.exists():
        raise CliError(f"{path} is there already: say --force to overwrite it")
    try:
        png = _fields(log, values.field) if values.field else _overview(log, flight.name)
    except (FlightLogError, PictureError) as error:
        raise CliError(printable(str(error))) from error
    write_file(path, png, may_overwrite=values.force)
    tell(f"{path}  {len(png) / 1000:.0f} kB")
    return 0


def _overview(log: FlightLog, name: str) -> bytes:
    content = report_content(log, name)
    wanted = [each for each in content.pictures if each.name in ("attitude", "altitude")]
    panels = [panel for picture in wanted for panel in picture.panels]
    if not panels and content.track is None:
        raise CliError("the log tells neither position nor attitude: name a FIELD")
    aircraft = printable(content.summary.aircraft) or "an aircraft without a name"
    paint = partial(
        draw_overview,
        title=aircraft[:60],
        subtitle=f"{start_text(log.start_unix_s)}, {duration_text(log.length_s)}",
        panels=panels,
        stage=content.stage,
        track=content.track,
    )
    return png_of(paint, OVERVIEW_IN, overview_height_in(panels, content.stage), DPI, DAYLIGHT)


def _fields(log: FlightLog, named: Sequence[str]) -> bytes:
    if len(named) > MAX_FIELDS:
        raise CliError(f"a picture has {MAX_FIELDS} fields at most, not {len(named)}", status=2)
    panels = list(_panels(log, [_split(log, each) for each in dict.fromkeys(named)]))
    stage = Stage(log.length_s, list(bands_of(FlightContext(log))))
    height_in = timeline_height_in(panels, stage, WIDTH_IN)
    paint = partial(draw_timeline, panels=panels, stage=stage)
    return png_of(paint, WIDTH_IN, height_in, DPI, DAYLIGHT)


def _panels(log: FlightLog, fields: Sequence[tuple[str, str]]) -> Iterator[Panel]:
    """Yield a panel for every unit, so that comparable values share one."""
    by_unit: dict[str, list[tuple[str, str]]] = {}
    for topic, field in fields:
        unit = _unit(log, topic, field) or field.rpartition(".")[2]
        by_unit.setdefault(unit, []).append((topic, field))
    for unit, members in by_unit.items():
        curves = []
        for number, (topic, field) in enumerate(members):
            times_s, numbers = log.series(topic, field)
            colour = _COLOURS[number % len(_COLOURS)]
            style = _STYLES[number // len(_COLOURS) % len(_STYLES)]
            curves.append(Curve(printable(f"{topic}.{field}"), times_s, numbers, colour, style))
        yield Panel("", printable(unit), curves, share=1.4)


def _split(log: FlightLog, named: str) -> tuple[str, str]:
    """Return topic and field of a name; raises CliError that lists the known ones."""
    parts = named.split(".")
    for at in range(len(parts) - 1, 0, -1):
        topic, field = ".".join(parts[:at]), ".".join(parts[at:])
        if topic in log.topics and log.series(topic, field)[1]:
            return topic, field
    raise no_such_field(named, known_fields(log))


def known_fields(log: FlightLog) -> list[str]:
    """Return every ``topic.field`` with numbers, according to each topic's first messages."""
    found: dict[str, None] = {}
    for topic in log.topics:
        for number, message in enumerate(log.messages(topic)):
            if number >= _LOOKED_AT:
                break
            for path, value in flat(message.data):
                if isinstance(value, int | float) and not isinstance(value, bool):
                    found.setdefault(f"{topic}.{path}")
    return list(found)


def _unit(log: FlightLog, topic: str, field: str) -> str:
    schema = log.schema(topic) or {}
    properties = schema.get("properties")
    about = properties.get(field) if isinstance(properties, dict) else None
    unit = about.get("x-unit") if isinstance(about, dict) else None
    return unit if isinstance(unit, str) else ""
