"""`up log` and the verbs below it, with their options and help."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

from up.cli.plugin_verbs import add_plugin_verbs
from up.cli.verb import add_verb
from up.flight_log.flight_options import PLACE, take_folder

LOG_VERBS = "up.log_verbs"
"""The group of entry points for verbs that other distributions add below `up log`."""
_EPILOG = """\
FLIGHT is the number of a flight ('up log list' tells it), 'last', a file of a flight, or a folder
that holds the parts of one.

examples:
  up log list
  up log info last
  up log report last -o my_flight
  up log export 12 --format gpx
"""
_CSV = """\
csv: --topic T is every message of that topic, one row each (several topics: a folder with a file
for each). Without it, or with --rate, one table with the newest values of all topics at a steady
rate; '<topic>.age_s' says how old they are.
gpx, kml: the track, with the home and the marks that the user set in flight.

examples:
  up log export last --format gpx
  up log export 12 --format csv --topic up.orientation.update -o attitude.csv
  up log export 12 --format csv --rate 20
"""
_PLOT = """\
Without a FIELD: the track, attitude against what was asked, altitude and speed. A FIELD is a topic
and one of its values; 'up log info FLIGHT' lists the topics.

examples:
  up log plot last
  up log plot 12 up.orientation.update.roll up.setpoint.set.roll -o roll.png
"""


class MixedParser(argparse.ArgumentParser):
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
        help="look at recorded flights: list, info, export, plot, report",
        description="Look at the flights that the black box recorded.",
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


def take_flight(parser: argparse.ArgumentParser) -> None:
    """Add the argument FLIGHT and the options that select the folder of flights."""
    parser.add_argument(
        "flight", metavar="FLIGHT", help="its number, 'last', a file, or a folder of parts"
    )
    take_folder(parser)


def _add_list(verbs: Any) -> None:
    listing = add_verb(verbs, "list", "black_box_cog.cli.list_verb", "list the recorded flights")
    take_folder(listing)
    listing.add_argument("--json", action="store_true", help="for programs: one JSON document")


def _add_info(verbs: Any) -> None:
    info = add_verb(
        verbs, "info", "black_box_cog.cli.info_verb", "tell what a flight was and what went wrong"
    )
    take_flight(info)


def _add_export(verbs: Any) -> None:
    export = add_verb(
        verbs,
        "export",
        "black_box_cog.cli.export_verb",
        "write a flight as a table (csv) or its track (gpx, kml)",
        epilog=_CSV,
    )
    take_flight(export)
    export.add_argument("--format", required=True, choices=("csv", "gpx", "kml"))
    export.add_argument(
        "--topic", action="append", default=[], metavar="T", help="csv: this topic alone; repeats"
    )
    export.add_argument(
        "--rate", type=_rate, metavar="HZ", help="csv: rows a second of the one table (default: 10)"
    )
    _take_output(export, "FILE", "where to (default: named after the flight; - is stdout)")


def _add_plot(verbs: Any) -> None:
    module, text = "black_box_cog.cli.plot_verb", "draw a flight as a picture"
    plot = cast(MixedParser, add_verb(verbs, "plot", module, text, epilog=_PLOT))
    plot.is_mixed = True
    take_flight(plot)
    plot.add_argument("field", nargs="*", metavar="FIELD", help="like up.orientation.update.roll")
    _take_output(plot, "PNG", "the picture (default: named after the flight)")


def _add_report(verbs: Any) -> None:
    report = add_verb(
        verbs,
        "report",
        "black_box_cog.cli.report_verb",
        "write a page that explains a flight, with its pictures",
    )
    take_flight(report)
    where = "where to; made if need be (default: named after the flight, beside it)"
    _take_output(report, "FOLDER", where)


def _take_output(parser: argparse.ArgumentParser, what: str, text: str) -> None:
    parser.add_argument("-o", "--output", type=Path, metavar=what, help=text)
    parser.add_argument("--force", action="store_true", help="overwrite what is there")


def _place(values: argparse.Namespace) -> Path:
    # Imported on use, which keeps help fast.
    from black_box_cog.cli.locate import folder_of

    return folder_of(values)


def _rate(text: str) -> float:
    try:
        rate_hz = float(text)
    except ValueError:
        rate_hz = 0.0
    if not 0.01 <= rate_hz <= 1000:
        raise argparse.ArgumentTypeError(f"{text!r} is no rate between 0.01 and 1000 Hz")
    return rate_hz
