"""``up log plot``."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

from up.cli.cli_error import CliError
from up.fields import printable
from up.output import echo
from up_flightlog.cli.open_flight import check_topics, flight_of, unknown_field
from up_flightlog.cli.terminal import DecodingProgress
from up_flightlog.export.csv_table import flat
from up_flightlog.export.output import file_exists, write_file
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.plots.canvas import MISSING, has_matplotlib, png_of
from up_flightlog.plots.chart import Background, Curve, Panel
from up_flightlog.plots.overview import DPI, Overview, overview_png
from up_flightlog.plots.theme import DAYLIGHT
from up_flightlog.plots.timeline import draw_timeline, timeline_height_in
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.schema_fields import unit_of
from up_flightlog.read.spans import duration_text
from up_flightlog.report.content import report_content
from up_flightlog.report.formatting import start_text
from up_flightlog.report.report_data import bands_of

WIDTH_IN = 11.0
MAX_FIELDS = 12
_SAMPLE = 200
_COLOURS = ("blue", "orange", "green", "vermilion", "purple", "sky")
_STYLES = ("-", "--", "-.", ":")


def run(values: argparse.Namespace) -> int:
    """Plot a flight."""
    if not has_matplotlib():
        raise CliError(MISSING)
    flight = flight_of(values)
    path = values.output or Path(f"{flight.name}.png")
    if path.suffix.lower() != ".png":
        raise CliError(f"{path}: the name of a picture must end in .png", status=2)
    if not values.force and path.exists():
        raise file_exists(path)
    check_topics(flight, values.field)
    log = FlightLog.read(flight.paths)
    with DecodingProgress("drawing", log):
        png = _fields(log, values.field) if values.field else _overview(log)
    write_file(path, png, may_overwrite=values.force)
    echo(f"{path}  {len(png) / 1000:.0f} kB")
    return 0


def _overview(log: FlightLog) -> bytes:
    content = report_content(log)
    wanted = [each for each in content.pictures if each.name in ("attitude", "altitude")]
    panels = [panel for picture in wanted for panel in picture.panels]
    if not panels and content.track is None:
        raise CliError("the log has neither position nor attitude: name a FIELD")
    aircraft = printable(content.summary.aircraft) or "unnamed aircraft"
    subtitle = f"{start_text(log.start_unix_s)}, {duration_text(log.length_s)}"
    return overview_png(
        Overview(aircraft[:60], subtitle, panels, content.background, content.track)
    )


def _fields(log: FlightLog, named: Sequence[str]) -> bytes:
    if len(named) > MAX_FIELDS:
        raise CliError(
            f"at most {MAX_FIELDS} fields fit into a picture, not {len(named)}", status=2
        )
    panels = list(_panels(log, [_split(log, each) for each in dict.fromkeys(named)]))
    background = Background(log.length_s, list(bands_of(FlightContext(log))))
    height_in = timeline_height_in(panels, background, WIDTH_IN)
    paint = partial(draw_timeline, panels=panels, background=background)
    return png_of(paint, WIDTH_IN, height_in, DPI, DAYLIGHT)


def _panels(log: FlightLog, fields: Sequence[tuple[str, str]]) -> Iterator[Panel]:
    """Yield a panel for every unit, so that comparable values share one."""
    by_unit: dict[str, list[tuple[str, str]]] = {}
    for topic, field in fields:
        unit = unit_of(log.schema(topic), field) or field.rpartition(".")[2]
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
    raise unknown_field(named, known_fields(log))


def known_fields(log: FlightLog) -> list[str]:
    """Return every ``topic.field`` with numbers, according to each topic's first messages."""
    found: dict[str, None] = {}
    for topic in log.topics:
        for number, message in enumerate(log.messages(topic)):
            if number >= _SAMPLE:
                break
            for path, value in flat(message.data):
                if isinstance(value, int | float) and not isinstance(value, bool):
                    found.setdefault(f"{topic}.{path}")
    return list(found)
