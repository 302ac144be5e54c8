"""Opens the log of the flight that a verb names."""

from __future__ import annotations

import argparse
import sys

from black_box_cog.cli.locate import folder_of
from up.cli.cli_error import CliError
from up.fields import printable
from up.flight_log.flight_log import FlightLog
from up.flight_log.flights import Flight, find_flight
from up.flight_log.mcap_format import FlightLogError

_LARGE = 20_000_000


def flight_of(values: argparse.Namespace) -> Flight:
    """Return the flight that FLIGHT names; raises CliError and ConfigErrors."""
    # Only a name that is not a path needs the folder, and so a valid configuration.
    try:
        flight = find_flight(values.flight, lambda: folder_of(values))
    except FlightLogError as error:
        raise CliError(str(error)) from error
    if sys.stderr.isatty() and flight.size > _LARGE:
        sys.stderr.write(f"reading {len(flight.paths)} files, {flight.size / 1e6:.0f} MB ...\n")
    return flight


def read(flight: Flight) -> FlightLog:
    """Return its log; raises CliError with the reader's sentence."""
    try:
        return FlightLog.read(flight.paths)
    except FlightLogError as error:
        raise CliError(printable(str(error))) from error
