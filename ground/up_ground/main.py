"""The program ``up-ground``."""

from __future__ import annotations

import argparse
import io
import json
import os
import sys
from collections.abc import Sequence
from typing import Any

from up.cli.cli_error import UsageError
from up.cli.option_parser import EXIT_FAILED, EXIT_OK, EXIT_USAGE
from up.commands.command import BaseCommand
from up.errors import UserError
from up.fields import show
from up.output import echo
from up.protocols.general_message import encode
from up.system.figures import PACKAGE_MISSING, is_installed
from up_ground.arguments import make_parser, peer_of
from up_ground.catalogue import Catalogue, command_fields, describe, fault_of
from up_ground.control_task import LeaveControl, RequestControl
from up_ground.one_shot_task import OneShotTask, print_error, run
from up_ground.send import Send, parse_fields
from up_ground.settings import Seat
from up_ground.terminal import Terminal
from up_ground.watch import JSONWatch, OnceWatch, PlainWatch, ScreenWatch, Watch, is_terminal


def watch(options: argparse.Namespace) -> int:
    """Show an aircraft in the requested form."""
    peer = peer_of(options, Seat(options.seat))
    more: dict[str, Any] = {"for_s": options.for_s, "count": options.count}
    form: type[Watch] = PlainWatch
    if options.once or options.json:
        form = OnceWatch if options.once else JSONWatch
    elif not options.plain and is_terminal(1) and os.isatty(0):
        terminal = Terminal()
        terminal.enter()
        try:
            return run(lambda reactor: ScreenWatch(reactor, *peer, terminal=terminal, **more))
        finally:
            terminal.leave()
    return run(lambda reactor: form(reactor, *peer, **more))


def send(options: argparse.Namespace) -> int:
    """Check a Command against the catalogue, where it is listed, and send it."""
    catalogue = Catalogue.installed()
    cls = catalogue.get(options.name)
    fields = [] if cls is None else command_fields(cls)["fields"]
    texts = {each["name"] for each in fields if each["type"] == "text"}
    data = parse_fields(options.fields, texts)
    try:
        encode(options.name, data)
    except ValueError as error:
        raise UsageError(f"cannot be sent: {error}", "not_encodable") from None
    if not options.force:
        cls = _known(catalogue, options.name)
        if fault := fault_of(cls, data):
            raise UsageError("\n".join([fault, *describe(cls)]), "invalid_data")
    peer = peer_of(options, Seat.COMMAND)
    return run(
        lambda reactor: Send(
            reactor,
            *peer,
            options.name,
            data,
            needs_beacon=cls is not None and cls.NEEDS_BEACON,
        )
    )


def control(options: argparse.Namespace) -> int:
    """Request control, hand it over or release it."""
    if options.direct:
        raise UsageError("a direct link has no control to request", "direct")
    peer = peer_of(options, Seat.COMMAND)

    def make(reactor: Any) -> OneShotTask:
        if options.action == "request":
            return RequestControl(reactor, *peer, wait_s=options.wait)
        to = options.to if options.action == "give" else None
        return LeaveControl(reactor, *peer, to=to)

    return run(make)


def commands(options: argparse.Namespace) -> int:
    """List the Commands that a ground may send."""
    catalogue = Catalogue.installed()
    chosen = [_known(catalogue, options.name)] if options.name is not None else catalogue.sendable()
    if options.json:
        echo(json.dumps([command_fields(each) for each in chosen], indent=1))
    else:
        echo("\n\n".join("\n".join(describe(each)) for each in chosen))
    for problem in catalogue.problems:
        print_error(problem, "cog_left_out")
    return EXIT_OK


def serve(options: argparse.Namespace) -> int:
    """Serve the ground station as a page for browsers."""
    # Here: it takes a third of the start-up time, which the other verbs need not wait for.
    from up_ground.web.serve import PageOptions, fleet_of, make_sessions

    if options.metrics is not None and not is_installed():
        raise UsageError(f"--metrics {PACKAGE_MISSING[0]}", PACKAGE_MISSING[1])
    page, chosen = PageOptions.of(options, os.environ), fleet_of(options)
    catalogue = Catalogue.installed()
    return run(
        lambda reactor: page.server(
            reactor,
            lambda subscribers: make_sessions(reactor, chosen, os.environ, subscribers, catalogue),
            catalogue=catalogue,
            metrics_port=options.metrics,
        )
    )


def _known(catalogue: Catalogue, name: str) -> type[BaseCommand]:
    """Return a Command by its name; raises UsageError with the similar ones."""
    if cls := catalogue.get(name):
        return cls
    near, shown = catalogue.suggestions(name), show(name)
    lines = [f"unknown Command {shown}; did you mean {' or '.join(near)}?"]
    for each in near:
        if similar := catalogue.get(each):
            lines += describe(similar)
    if not near:
        lines = [f"unknown Command {shown}; known Commands:"]
        lines += [f"    {each.NAME}" for each in catalogue.sendable()]
    lines.append("--force sends a name that this version does not know")
    raise UsageError("\n".join(lines), "unknown_command")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status (docs/ground.md)."""
    if sys.stdout is None or sys.stderr is None:
        # Python's own None for a descriptor that the caller closed (`>&-`).
        if sys.stderr is not None:
            print_error("stdout is closed; redirect it to /dev/null instead", "stdout_closed")
        return EXIT_USAGE
    # A terminal that is not UTF-8 shows other characters as escapes.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    parser = make_parser(os.environ)
    options = parser.parse_args(arguments)
    if getattr(options, "carry_out", None) is None:
        parser.print_help()
        return EXIT_USAGE
    try:
        return _carry_out(options)
    except BrokenPipeError:
        # The reader, such as 'head', has closed the pipe; nothing more can be written.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        for descriptor in (1, 2):
            os.dup2(nowhere, descriptor)
        return EXIT_OK
    except OSError as error:
        print_error(f"{error.filename or 'output'}: {error.strerror or error}", "os_error")
        return EXIT_FAILED


def _carry_out(options: argparse.Namespace) -> int:
    try:
        status: int = options.carry_out(options)
    except UserError as error:
        print_error(str(error), error.code)
        return error.status
    return status


if __name__ == "__main__":
    sys.exit(main())
