"""The verbs of ``up`` with their options and help."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from up.cli.plugin_verbs import UP_VERBS, add_plugin_verbs, verb_of
from up.cli.verb import add_verb
from up.mode import Mode
from up.version import VERSION

_EPILOG = """\
A first application in four commands:
  up create new -n my_plane     folder with UpFile, configuration, an example module and its test
  cd my_plane
  up create module -n Altimeter  a module in modules/; it is loaded by itself
  up start                       Ctrl-C stops it

Plug-ins (cogs) are listed in Cogfile.yml; 'up gather' installs and registers them.
Nothing starts, or a module is missing?  up check    what is wrong, with file and line
                                         up modules  what would be loaded, and why the rest not
'up VERB --help' explains a verb.
"""


def make_parser(arguments: Sequence[str] | None = None) -> argparse.ArgumentParser:
    """Return the parser of the whole command line.

    Only the plug-in verb that ``arguments`` name is loaded; built-in verbs load no plug-ins.
    """
    parser = argparse.ArgumentParser(
        prog="up",
        description="Creates, checks and starts applications on Up, and manages their cogs.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"Up {VERSION}")
    parser.add_argument(
        "-f",
        "--file",
        metavar="PATH",
        help="the application's folder or UpFile (default: found from the current folder);"
        " for 'create module' and 'create handler' the file to write",
    )
    verbs = parser.add_subparsers(title="verbs", metavar="VERB")
    _add_create(verbs)
    _add_start(verbs)
    _add_gather(verbs)
    _add_register(verbs)
    _add_explore(verbs)
    _add_checks(verbs)
    update = add_verb(verbs, "update", "up.cli.update", "upgrade the framework", aliases=("u",))
    update.add_argument("--dry-run", action="store_true", help="only show the pip command")
    asked = None if arguments is None else verb_of(arguments)
    if asked not in verbs.choices:
        add_plugin_verbs(verbs, UP_VERBS, asked)
    return parser


def _add_create(verbs: Any) -> None:
    create = verbs.add_parser(
        "create",
        aliases=["c"],
        help="write a new application, module, handler or cog",
        epilog="examples:\n  up create new -n my_plane\n  up create module -n Altimeter\n"
        "  up create module -n Camera -t thread\n"
        "  up create handler -n OpenBay -i my_plane.bay.open\n  up create cog -n Lidar",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    create.set_defaults(parser=create)
    kinds = create.add_subparsers(title="what", metavar="WHAT")
    for name, aliases, text in (
        ("new", ("n",), "a runnable application"),
        ("module", ("m",), "a module in ./modules"),
        ("handler", ("h",), "a Command and its handler in ./commands"),
        ("cog", (), "a plug-in with packaging, registrar, manifest, module, test and README"),
    ):
        kind = add_verb(kinds, name, "up.cli.create", text, aliases=aliases)
        kind.set_defaults(kind=name)
        kind.add_argument("-n", "--name", required=True, help="its name, like FuelGauge")
        kind.add_argument("-y", "--yes", action="store_true", help="overwrite without asking")
        if name == "module":
            kind.add_argument(
                "-t",
                "--type",
                choices=("started", "thread"),
                default="started",
                help="thread: for work that blocks (default: started)",
            )
        if name == "handler":
            kind.add_argument(
                "-i", "--identifier", required=True, help="name of the Command, like plane.bay.open"
            )


def _add_start(verbs: Any) -> None:
    start = add_verb(
        verbs, "start", "up.cli.start", "run the application until Ctrl-C", aliases=("s",)
    )
    _take_config(start)
    _take_defaults(start)


def _add_gather(verbs: Any) -> None:
    gather = add_verb(
        verbs,
        "gather",
        "up.cli.gather",
        "install and register the cogs that Cogfile.yml asks for",
        aliases=("g",),
        epilog="Installs what is missing into the environment of this Python, registers every cog\n"
        "of the Cogfile, and unregisters those that have left it. Configuration files are created\n"
        "where there are none and never changed. Nothing to do is fast.\n\n"
        "Cogfile.yml, each cog from exactly one of:\n"
        "  my_cog: {path: ../cogs/my_cog}\n"
        '  my_cog: {pypi: my-cog, version: "1.2.3"}\n'
        "  my_cog: {url: https://example.org/my_cog.git, revision: v1}",
    )
    gather.add_argument(
        "--no-install", action="store_true", help="register only; fail where a cog is missing"
    )


def _add_register(verbs: Any) -> None:
    register = add_verb(
        verbs,
        "register",
        "up.cli.register",
        "register an installed cog that no Cogfile lists",
        aliases=("r",),
        epilog="example: up register -n my_cog",
    )
    register.set_defaults(remove=False)
    unregister = add_verb(verbs, "unregister", "up.cli.register", "take a registered cog out")
    unregister.set_defaults(remove=True)
    for each in (register, unregister):
        each.add_argument("-n", "--name", required=True, help="the cog's Python package")


def _add_explore(verbs: Any) -> None:
    explore = add_verb(
        verbs,
        "explore",
        "up.cli.explore",
        "list the module classes in ./modules",
        aliases=("e",),
        epilog="In a cog's folder, 'up explore -w' writes registered_modules.yml, the list of\n"
        "what the cog brings into an application.",
    )
    explore.add_argument(
        "-t",
        "--type",
        choices=("modules", "recorders", "all"),
        default="all",
        help="recorders are no more: they are Thread Modules now",
    )
    explore.add_argument("-w", "--write", action="store_true", help="write registered_modules.yml")


def _add_checks(verbs: Any) -> None:
    check = add_verb(
        verbs,
        "check",
        "up.cli.check",
        "find every mistake in configuration and modules, without starting",
        epilog="Exit status 0: would start; 2: mistakes, each with its place.",
    )
    _take_defaults(check)
    modules = add_verb(
        verbs,
        "modules",
        "up.cli.modules",
        "what would be loaded, in which order, and why the rest would not",
        epilog='example: up modules --mode "black box"',
    )
    for each in (check, modules):
        _take_config(each)
        each.add_argument(
            "--mode",
            choices=[mode.value for mode in Mode],
            help="as if this mode were configured",
        )
    schemas = add_verb(
        verbs,
        "schemas",
        "up.cli.schemas",
        "write the JSON Schema of every configuration file, for editors",
    )
    schemas.add_argument("folder", type=Path, metavar="DIR", help="where to; made if need be")


def _take_defaults(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--defaults", action="store_true", help="start with the defaults where no file is found"
    )


def _take_config(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder with the YAML files (default: config)"
    )
