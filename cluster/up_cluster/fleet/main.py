"""The program `up-fleet`."""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Awaitable, Callable, Sequence
from pathlib import Path
from typing import Any

from up.cli.option_parser import (
    EXIT_FAILED,
    EXIT_OK,
    EXIT_USAGE,
    OptionParser,
    add_json_option,
    bounded_number,
)
from up.config import no_configuration
from up.errors import UserError
from up.log import start_logging
from up.output import echo, print_problems
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE
from up.system.clock import use_monotonic_time
from up.tls.errors import TLSError
from up.version import VERSION
from up_cluster.config import FLEET, ClusterError
from up_cluster.fleet.fleet import Fleet, FleetError
from up_cluster.fleet.tables import aircraft_table, list_table, usage_table

DESCRIPTION = """\
Lists and controls the proxies and runners of a cluster.

A member is one up-proxy (a relay node) or one up-runner (of a pool). fleet.yml
has the keys of 'cluster:' in proxy.yml except 'replicas', not below 'cluster:';
tenant and credentials decide what is seen."""
EPILOG = """\
examples:
  up-fleet list                    every member, with what it holds
  up-fleet where glider-1          its relay node and the host of its instance
  up-fleet usage                   by members and aircraft, and the tenant's quotas
  up-fleet drain 3f9a0c27b1d4      before maintenance: its aircraft go elsewhere
  up-fleet kick glider-1           disconnects it and frees its name and control
  up-fleet kick glider-1 --instance  stops its instance; it does not start again

exit status: 0 done; 1 refused, unknown or without answer; 2 wrong use"""
Verb = Callable[[Fleet, argparse.Namespace], Awaitable[Any]]


def make_parser() -> OptionParser:
    """Return the parser of the command line."""
    parser = OptionParser(prog="up-fleet", description=DESCRIPTION, epilog=EPILOG)
    text = "folder of fleet.yml (default: config)"
    parser.add_argument("--config", type=Path, default=Path("config"), metavar="DIR", help=text)
    parser.add_argument("--version", action="version", version=f"{parser.prog} {VERSION}")
    verbs = parser.add_subparsers(dest="verb", metavar="VERB", required=True)

    def add(name: str, text: str, run: Verb, show: Callable[[Any], list[str]]) -> OptionParser:
        verb: OptionParser = verbs.add_parser(name, help=text, description=f"{text}.")
        add_json_option(verb)
        text = "time for the members' answers, in seconds (default: %(default)g)"
        verb.add_argument(
            "--wait", type=bounded_number(0.1, 600, "s"), default=1.0, metavar="S", help=text
        )
        verb.set_defaults(run=run, show=show, parser=verb)
        return verb

    add("list", "list the members and their aircraft", lambda f, o: f.overview(o.wait), list_table)
    text = "show where an aircraft is"
    where = add("where", text, lambda f, o: f.where(o.aircraft, o.wait), aircraft_table)
    where.add_argument("aircraft", type=_aircraft, metavar="AIRCRAFT")
    usage = "show CPU time, memory, data of members and aircraft, and the tenant's quotas"
    add("usage", usage, lambda f, o: f.usage(o.wait), usage_table)
    text = "let the aircraft of a member go elsewhere, and wait"
    drain = add("drain", text, lambda f, o: f.drain(o.member, o.wait), _show_drain)
    drain.add_argument("member", type=_member, metavar="MEMBER", help="its id in 'up-fleet list'")
    drain.set_defaults(wait=60.0)
    text = "disconnect an aircraft, or stop its instance"
    kick = add("kick", text, lambda f, o: f.kick(o.aircraft, o.kind), _show_kick)
    kick.add_argument("aircraft", type=_aircraft, metavar="AIRCRAFT")
    kick.add_argument(
        "--instance", dest="kind", action="store_const", const="instance", default="aircraft",
        help="stop its instance in the pool",
    )  # fmt: skip
    return parser


def _show_drain(answer: dict[str, Any]) -> list[str]:
    return [f"{answer['id']} is drained; aircraft that have left it: {len(answer['left'])}"]


def _show_kick(answer: dict[str, Any]) -> list[str]:
    return [f"{answer['aircraft']}: {answer['done']}"]


def _aircraft(text: str) -> str:
    if not AIRCRAFT_NAME.fullmatch(text):
        raise argparse.ArgumentTypeError(f"an aircraft's name must be {AIRCRAFT_NAME_RULE}")
    return text


def _member(text: str) -> str:
    if not re.fullmatch(r"[0-9a-f]{12}", text):
        text = "a member's id has 12 hexadecimal digits, as 'up-fleet list' shows"
        raise argparse.ArgumentTypeError(text)
    return text


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status."""
    options = make_parser().parse_args(arguments)
    try:
        if (nothing := no_configuration(options.config, [FLEET], "set '--config DIR'")) is not None:
            raise nothing
        config = FLEET.load(options.config)
        if not config.servers:
            text = f"{options.config / FLEET.filename}: servers: names no NATS server"
            raise UserError(text, "no_servers")
    except UserError as error:
        print_problems(error.problems)
        return EXIT_USAGE
    start_logging("error")
    from twisted.internet import reactor

    use_monotonic_time(reactor)
    try:
        fleet = Fleet(reactor, config, options.config)
        answer = fleet.run(lambda: options.run(fleet, options))
    except (ClusterError, TLSError) as error:
        print_problems([UserError(f"{error} (fleet.yml)", error.code)])
        return EXIT_USAGE
    except FleetError as error:
        print_problems([error])
        return EXIT_FAILED
    if options.json:
        echo(json.dumps(answer, indent=1))
    else:
        for line in options.show(answer):
            echo(line)
    return EXIT_OK


if __name__ == "__main__":
    sys.exit(main())
