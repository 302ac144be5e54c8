"""A command line verb whose module is imported on use."""

import argparse
import importlib
from collections.abc import Callable
from typing import Any

from up.cli.cli_error import CliError


def add_verb(
    verbs: Any,
    name: str,
    module: str,
    text: str,
    *,
    aliases: tuple[str, ...] = (),
    epilog: str = "",
) -> argparse.ArgumentParser:
    """Add a verb to the return value of ``add_subparsers``; return its parser, for its options.

    ``module`` names a module, whose ``run(values) -> exit status`` carries the verb out, or another
    function as ``module:function``. It is imported only then, which keeps ``up --help`` fast.
    ``text`` is one line of help.
    """
    parser: argparse.ArgumentParser = verbs.add_parser(
        name,
        aliases=list(aliases),
        help=text,
        description=f"{text[0].upper()}{text[1:]}.",
        epilog=epilog,
    )
    parser.set_defaults(carry_out=_from(module, name), parser=parser)
    return parser


def _from(module: str, verb: str) -> Callable[[argparse.Namespace], int]:
    name, _, function = module.partition(":")

    def carry_out(values: argparse.Namespace) -> int:
        try:
            run = getattr(importlib.import_module(name), function or "run")
        except ModuleNotFoundError as error:
            raise CliError(
                f"'{verb}' needs {error.name}, which is not installed",
                code="import_missing",
                module=error.name,
            ) from error
        status: int = run(values)
        return status

    return carry_out
