"""Manual pages of a program, from its argument parser."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator

from up.version import VERSION


def man_page(
    parser: argparse.ArgumentParser, name: str, section: int, about: str, epoch_s: int
) -> str:
    """Return the page in the language of man(7), with a subsection for each verb."""
    day = time.strftime("%Y-%m-%d", time.gmtime(epoch_s))
    lines = [
        f'.TH "{name.upper()}" {section} "{day}" "Up {VERSION}"',
        ".SH NAME",
        _text(f"{name} - {about}"),
        ".SH SYNOPSIS",
        *_literal(parser.format_usage().removeprefix("usage: ")),
        ".SH DESCRIPTION",
        *_body(parser),
    ]
    verbs = list(_verbs(parser))
    if verbs:
        lines.append(".SH VERBS")
    for each in verbs:
        lines += [f".SS {_text(each.prog)}", *_literal(each.format_usage().removeprefix("usage: "))]
        lines += _body(each)
    return "".join(f"{line}\n" for line in lines)


def _verbs(parser: argparse.ArgumentParser) -> Iterator[argparse.ArgumentParser]:
    """Yield the parser of each verb at every level, without its aliases."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for each in dict.fromkeys(action.choices.values()):
                yield each
                yield from _verbs(each)


def _body(parser: argparse.ArgumentParser) -> Iterator[str]:
    yield from _literal(parser.description or "")
    formatter = parser._get_formatter()
    for action in parser._actions:
        if action.help == argparse.SUPPRESS or isinstance(action, argparse._SubParsersAction):
            continue
        yield ".TP"
        yield f".B {_text(formatter._format_action_invocation(action))}"
        if action.help:
            yield _text(formatter._expand_help(action))
    if parser.epilog:
        yield ".P"
        yield from _literal(parser.epilog)


def _literal(text: str) -> Iterator[str]:
    """Yield lines that keep their breaks, as the parser's help does."""
    yield ".nf"
    yield from (_text(line) for line in text.strip("\n").splitlines())
    yield ".fi"


def _text(line: str) -> str:
    r"""Return a line of text: a shell can read ``-``, and ``.`` and ``'`` begin no request."""
    escaped = line.replace("\\", "\\e").replace("-", "\\-")
    return f"\\&{escaped}" if escaped.startswith((".", "'")) else escaped
