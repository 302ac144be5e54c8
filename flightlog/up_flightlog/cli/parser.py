"""`up log` and the verbs below it, with their options and help."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, cast

from up.cli.option_parser import OptionParser, add_json_option, bounded_number
from up.cli.plugin_verbs import add_plugin_verbs
from up.cli.verb import add_verb

PLACE = "flights_place"
"""The parsed value in which ``up log`` stores a ``Place`` for the verbs of others; it knows the
application's black_box.yml."""

Place = Callable[[argparse.Namespace], Path]
"""Returns the folder that the parsed options select."""
LOG_VERBS = "up.log_verbs"
"""The group of entry points for verbs that other distributions add below `up log`."""
_EPILOG = """\
FLIGHT is the number of a flight (see 'up log list'), 'last', a file of a flight, or a folder with
the parts of one.

examples:
  up log list
  up log info last
  up log report last -o my_flight
  up log export 12 --format gpx
"""
_CSV = """\
csv: with --topic T, one row for every message of that topic (several topics: a folder with a file
for each). Without it, or with --rate, one table with the newest values of all topics at a steady
rate and their ages ('<topic>.age_s').
gpx, kml: the track, with home and the marks that the user set in flight.

examples:
  up log export last --format gpx
  up log export 12 --format csv --topic up.orientation.update -o attitude.csv
  up log export 12 --format csv --rate 20
"""
_PLOT = """\
Without a FIELD: the track, attitude against its set-point, altitude and speed. A FIELD is a topic
and one of its values; 'up log info FLIGHT' lists the topics.

examples:
  up log plot last
  up log plot 12 up.orientation.update.roll up.setpoint.set.roll -o roll.png
"""


class MixedParser(OptionParser):
    """A parser that, with ``is_mixed``, accepts positional arguments before and after options.

    argparse accepts no positional arguments after an option: it has ``parse_intermixed_args`` for
    that, but does not use it for the parsers below a verb.
    """

    is_mixed = False

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse; parse_intermixed_args calls this again, and then the base class parses."""
        if not self.is_mixed:
            return super().parse_known_args(args, namespace)
        self.is_mixed = False
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self.is_mixed = True


def add(verbs: Any) -> None:
    """Add `up log` with its verbs, and those of other distributions."""
    log = verbs.add_parser(
        "log",
        help="read recorded flights: list, info, export, plot, report",
        description="Read the flights that the black box recorded.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    log.set_defaults(parser=log, **{PLACE: _place})
    below = log.add_subparsers(title="verbs", metavar="VERB", parser_class=MixedParser)
    _add_list(below)
    _add_info(below)
    _add_export(below)
    _add_plot(below)
    _add_report(below)
    add_plugin_verbs(below, LOG_VERBS)


def add_folder_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that select the folder of flights."""
    parser.add_argument(
        "--folder",
        type=Path,
        metavar="DIR",
        help="folder of the flights (default: from black_box.yml)",
    )
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder with black_box.yml (default: config)"
    )


def add_flight_argument(parser: argparse.ArgumentParser) -> None:
    """Add the argument FLIGHT and the options that select the folder of flights."""
    parser.add_argument(
        "flight", metavar="FLIGHT", help="its number, 'last', a file, or a folder of parts"
    )
    add_folder_options(parser)


def _add_list(verbs: Any) -> None:
    listing = add_verb(verbs, "list", "up_flightlog.cli.list_verb", "list the recorded flights")
    add_folder_options(listing)
    add_json_option(listing)


def _add_info(verbs: Any) -> None:
    info = add_verb(
        verbs, "info", "up_flightlog.cli.info_verb", "summarise a flight and its faults"
    )
    add_flight_argument(info)
    add_json_option(info)


def _add_export(verbs: Any) -> None:
    export = add_verb(
        verbs,
        "export",
        "up_flightlog.cli.export_verb",
        "write a flight as a table (csv) or its track (gpx, kml)",
        epilog=_CSV,
    )
    add_flight_argument(export)
    export.add_argument("--format", required=True, choices=("csv", "gpx", "kml"))
    export.add_argument(
        "--topic", action="append", default=[], metavar="T", help="csv: only this topic; repeatable"
    )
    export.add_argument(
        "--rate",
        type=bounded_number(0.01, 1000, "Hz"),
        metavar="HZ",
        help="csv: rows per second of one table (default: 10)",
    )
    _add_output_options(export, "FILE", "output file (default: name of the flight; -: stdout)")


def _add_plot(verbs: Any) -> None:
    module, text = "up_flightlog.cli.plot_verb", "plot a flight"
    plot = cast(MixedParser, add_verb(verbs, "plot", module, text, epilog=_PLOT))
    plot.is_mixed = True
    add_flight_argument(plot)
    plot.add_argument("field", nargs="*", metavar="FIELD", help="like up.orientation.update.roll")
    _add_output_options(plot, "PNG", "the picture (default: named after the flight)")


def _add_report(verbs: Any) -> None:
    report = add_verb(
        verbs,
        "report",
        "up_flightlog.cli.report_verb",
        "write a report of a flight as a page with pictures",
    )
    add_flight_argument(report)
    where = "output folder, created if missing (default: beside the flight)"
    _add_output_options(report, "FOLDER", where)


def _add_output_options(parser: argparse.ArgumentParser, what: str, text: str) -> None:
    parser.add_argument("-o", "--output", type=Path, metavar=what, help=text)
    parser.add_argument("--force", action="store_true", help="overwrite existing files")


def _place(values: argparse.Namespace) -> Path:
    # Imported on use, which keeps help fast.
    from up_flightlog.cli.open_flight import flights_folder

    return flights_folder(values)
