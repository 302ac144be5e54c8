"""The program ``up-ground``."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from up.cli.cli_error import CliError
from up.fields import printable
from up.protocols.general_message import encode
from up_ground.arguments import parse_arguments, settings_of
from up_ground.catalogue import Catalogue, describe, fault_of
from up_ground.control_task import LeaveControl, RequestControl
from up_ground.field_values import FieldError, parse_fields
from up_ground.one_shot_task import (
    EXIT_DONE,
    EXIT_INTERRUPTED,
    EXIT_USAGE,
    OneShotTask,
    echo,
    print_error,
    run,
)
from up_ground.send import Send
from up_ground.settings import Seat
from up_ground.terminal import Terminal
from up_ground.token_store import TokenStore, state_folder
from up_ground.watch import JSONWatch, OnceWatch, PlainWatch, ScreenWatch, Watch, is_terminal
from up_ground.web.serve import PageOptions, ServeError, fleet_of, make_sessions


def watch(options: argparse.Namespace) -> int:
    """Show an aircraft in the requested form."""
    settings = settings_of(options, Seat(options.seat))
    tokens = TokenStore(state_folder(os.environ), settings)
    more: dict[str, Any] = {"for_s": options.for_s, "count": options.count}
    form: type[Watch] = PlainWatch
    if options.once or options.json:
        form = OnceWatch if options.once else JSONWatch
    elif not options.plain and is_terminal(1) and os.isatty(0):
        terminal = Terminal()
        terminal.enter()
        try:
            return run(
                lambda reactor: ScreenWatch(reactor, settings, tokens, terminal=terminal, **more)
            )
        finally:
            terminal.leave()
    return run(lambda reactor: form(reactor, settings, tokens, **more))


def send(options: argparse.Namespace) -> int:
    """Check a Command against the catalogue, where it is listed, and send it."""
    catalogue = Catalogue.installed()
    cls = catalogue.get(options.name)
    try:
        data = parse_fields(options.fields)
        encode(options.name, data)
    except ValueError as error:
        is_field = isinstance(error, FieldError)
        text = printable(str(error) if is_field else f"cannot be sent: {error}")
        return _usage([text], "invalid_field" if is_field else "not_encodable")
    if not options.force:
        if cls is None:
            return _usage(_unknown(catalogue, options.name), "unknown_command")
        if fault := fault_of(cls, data):
            return _usage([printable(fault), *describe(cls)], "invalid_data")
    settings = settings_of(options, Seat.COMMAND)
    tokens = TokenStore(state_folder(os.environ), settings)
    return run(
        lambda reactor: Send(
            reactor,
            settings,
            tokens,
            options.name,
            data,
            needs_beacon=cls is not None and cls.NEEDS_BEACON,
        )
    )


def control(options: argparse.Namespace) -> int:
    """Request control, hand it over or release it."""
    if options.direct:
        return _usage(["a direct link has no control to request"], "direct")
    settings = settings_of(options, Seat.COMMAND)
    tokens = TokenStore(state_folder(os.environ), settings)

    def make(reactor: Any) -> OneShotTask:
        if options.action == "request":
            return RequestControl(reactor, settings, tokens, wait_s=options.wait)
        to = options.to if options.action == "give" else None
        return LeaveControl(reactor, settings, tokens, to=to)

    return run(make)


def commands(options: argparse.Namespace) -> int:
    """List the Commands that a ground may send."""
    catalogue = Catalogue.installed()
    chosen = catalogue.sendable()
    if options.name is not None:
        cls = catalogue.get(options.name)
        if cls is None:
            return _usage(_unknown(catalogue, options.name), "unknown_command")
        chosen = [cls]
    for place, cls in enumerate(chosen):
        if place:
            echo("")
        for line in describe(cls):
            echo(line)
    for problem in catalogue.problems:
        print_error(printable(problem), "cog_left_out")
    return EXIT_DONE


def serve(options: argparse.Namespace) -> int:
    """Serve the ground station as a page for browsers."""
    try:
        page, chosen = PageOptions.of(options, os.environ), fleet_of(options)
    except ServeError as error:
        return _usage([printable(str(error))], error.code)
    catalogue = Catalogue.installed()
    return run(
        lambda reactor: page.server(
            reactor,
            lambda subscribers: make_sessions(reactor, chosen, os.environ, subscribers, catalogue),
            catalogue=catalogue,
        )
    )


def replay(options: argparse.Namespace) -> int:
    """Play a flight in the page."""
    from up_ground.replay.replay import run as play

    try:
        return play(options)
    except CliError as error:
        print_error(str(error), getattr(error, "code", "") or "replay")
        return error.status


def _unknown(catalogue: Catalogue, name: str) -> list[str]:
    lines = [f"unknown Command {printable(name)}"]
    similar = catalogue.suggestions(name)
    if similar:
        lines[0] += f"; did you mean {' or '.join(similar)}?"
        for each in similar:
            cls = catalogue.get(each)
            lines += [] if cls is None else describe(cls)
    else:
        lines[0] += "; known Commands:"
        lines += [f"    {cls.NAME}" for cls in catalogue.sendable()]
    return [*lines, "--force sends a name that this version does not know"]


def _usage(lines: Iterable[str], code: str) -> int:
    first, *rest = lines
    print_error(first, code)
    for line in rest:
        sys.stderr.write(f"{line}\n")
    return EXIT_USAGE


def _refuse_closed() -> int:
    if sys.stderr is not None:
        print_error("stdout is closed; redirect it to /dev/null instead", "stdout_closed")
    return EXIT_USAGE


_VERBS: dict[str, Callable[[argparse.Namespace], int]] = {
    "watch": watch,
    "send": send,
    "control": control,
    "seat": control,
    "commands": commands,
    "serve": serve,
    "replay": replay,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status (docs/ground.md)."""
    if sys.stdout is None or sys.stderr is None:
        # Python's own None for a descriptor that the caller closed (`>&-`).
        return _refuse_closed()
    # A terminal that is not UTF-8 shows other characters as escapes.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    parser, options = parse_arguments(arguments, os.environ)
    carry_out = _VERBS.get(options.verb)
    if carry_out is None:
        parser.print_help()
        return EXIT_USAGE
    try:
        return carry_out(options)
    except BrokenPipeError:
        # The reader, such as 'head', has closed the pipe; nothing more can be written.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return EXIT_DONE
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
