"""The verbs of ``up`` with their options and help."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from up.cli.option_parser import (
    OptionParser,
    add_defaults_option,
    add_json_option,
    whole_number,
)
from up.cli.plugin_verbs import UP_VERBS, add_plugin_verbs, verb_of
from up.cli.verb import add_verb
from up.mode import Mode
from up.version import VERSION

_EPILOG = """\
A first application in four commands:
  up create new -n my_plane      folder with UpFile, configuration, example, test
  cd my_plane
  up create module -n Altimeter  a module in modules/, loaded automatically
  up start                       Ctrl-C stops it

Plug-ins (cogs) are listed in Cogfile.yml; 'up gather' installs and registers them.
Nothing starts, or a module is missing?
  up check     reports every mistake, with file and line
  up modules   lists the loaded modules, and why others are left out
'up VERB --help' explains a verb.
"""
_CREATE_EPILOG = """\
examples:
  up create new -n my_plane
  up create module -n Altimeter
  up create flight-mode -n Eight
  up create module -n Camera -t thread
  up create handler -n OpenBay -i my_plane.bay.open
  up create cog -n Lidar
"""
_GATHER_EPILOG = """\
Installs missing cogs into the environment of this Python, registers every cog of
the Cogfile, and unregisters those that have left it. Missing configuration files
are created; existing ones are never changed.

Cogfile.yml, each cog from exactly one source:
  my_cog: {path: ../cogs/my_cog}
  my_cog: {pypi: my-cog, version: "1.2.3"}
  my_cog: {url: https://example.org/my_cog.git, revision: v1}
"""
_KEYS_EPILOG = """\
examples:
  up keys add --role pilot --name tablet   then, on the device: up-ground pair
  up keys revoke tablet                    ends its sessions at once
"""
_BUNDLE_EPILOG = """\
example, in a clone:
  make dist
  up bundle /media/stick --platform linux_aarch64 --python 3.13
There: sudo python3 install.py, in the folder that it wrote.
"""
_EXPLORE_EPILOG = """\
In a cog's folder, 'up explore -w' writes registered_modules.yml, the list of the
modules that the cog adds to an application.
"""


_CERTIFICATES_EPILOG = """\
example: a relay, an aircraft and a ground station
  up certificates init
  up certificates device relay --host relay.example.org
  up certificates device glider-1      the name of the aircraft
  up certificates device laptop
Each makes a folder to copy to the device; docs/security.md continues from there.
"""


def make_parser(arguments: Sequence[str] | None = None) -> OptionParser:
    """Return the parser of the whole command line.

    Only the plug-in verb that ``arguments`` name is loaded; built-in verbs load no plug-ins.
    """
    parser = OptionParser(
        prog="up",
        description="Creates, checks and starts applications on Up, and manages their cogs.",
        epilog=_EPILOG,
    )
    parser.add_argument("--version", action="version", version=f"Up {VERSION}")
    parser.add_argument(
        "-f",
        "--file",
        metavar="PATH",
        help="the application's folder or UpFile, or the name of an installed application"
        " (default: found from the current folder); for 'create module' and 'create handler'"
        " the file to write",
    )
    verbs = parser.add_subparsers(title="verbs", metavar="VERB")
    _add_create(verbs)
    start = _add(verbs, "start", "run the application until Ctrl-C", "s")
    gather = _add(verbs, "gather", "install and register the cogs of Cogfile.yml", "g")
    gather.epilog = _GATHER_EPILOG
    gather.add_argument(
        "--no-install", action="store_true", help="register only; fail if a cog is missing"
    )
    register = _add(verbs, "register", "register an installed cog that no Cogfile lists", "r")
    register.epilog = "example: up register -n my_cog"
    register.set_defaults(remove=False)
    unregister = add_verb(verbs, "unregister", "up.cli.verbs:register", "remove a registered cog")
    unregister.set_defaults(remove=True)
    for each in (register, unregister):
        each.add_argument("-n", "--name", required=True, help="the cog's Python package")
    _add_explore(verbs)
    check = _add(verbs, "check", "find every mistake in configuration and modules without starting")
    check.epilog = "exit status: 0 it would start; 2 mistakes, each with its place"
    modules = _add(verbs, "modules", "list the modules in order, and why others are left out")
    modules.epilog = 'example: up modules --mode "black box"'
    add_json_option(modules)
    text = "examine this machine: serial ports, clock, power, disk, priority, packages"
    doctor = add_verb(verbs, "doctor", "up.doctor.verb", text)
    doctor.epilog = "exit status: 0 nothing forbids a flight, warnings included; 1 an error"
    add_json_option(doctor)
    schemas = _add(verbs, "schemas", "write the JSON Schema of each configuration file for editors")
    schemas.add_argument("folder", type=Path, metavar="DIR", help="created if missing")
    _add_certificates(verbs)
    _add_bundle(verbs)
    update = add_verb(verbs, "update", "up.cli.update", "upgrade the framework", aliases=("u",))
    update.add_argument("--dry-run", action="store_true", help="only show the pip command")
    for each in (start, check):
        add_defaults_option(each)
    for each in (start, check, modules):
        add_config_option(each)
    for each in (check, modules):
        modes = [mode.value for mode in Mode]
        each.add_argument("--mode", choices=modes, help="as if this mode were configured")
    _add_keys(verbs)
    asked = None if arguments is None else verb_of(arguments)
    if asked not in verbs.choices:
        add_plugin_verbs(verbs, UP_VERBS, asked)
    return parser


def add_config_option(parser: argparse.ArgumentParser) -> None:
    """Add ``--config``."""
    parser.add_argument(
        "--config", type=Path, metavar="DIR", help="folder with the YAML files (default: config)"
    )


def _add(verbs: Any, name: str, text: str, *aliases: str) -> argparse.ArgumentParser:
    return add_verb(verbs, name, f"up.cli.verbs:{name}", text, aliases=aliases)


def _add_create(verbs: Any) -> None:
    create = verbs.add_parser(
        "create",
        aliases=["c"],
        help="write a new application, module, flight mode, handler or cog",
        epilog=_CREATE_EPILOG,
    )
    create.set_defaults(parser=create)
    kinds = create.add_subparsers(title="what", metavar="WHAT")
    for name, aliases, text in (
        ("new", ("n",), "a runnable application"),
        ("module", ("m",), "a module in ./modules"),
        ("flight-mode", ("f",), "a flight mode in ./flight_modes"),
        ("handler", ("h",), "a Command and its handler in ./commands"),
        ("cog", (), "a plug-in with packaging, registrar, manifest, module, test and README"),
    ):
        kind = add_verb(kinds, name, "up.cli.create", text, aliases=aliases)
        kind.set_defaults(kind=name)
        kind.add_argument("-n", "--name", required=True, help="its name, like FuelGauge")
        kind.add_argument("-y", "--yes", action="store_true", help="overwrite without a prompt")
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


def _add_bundle(verbs: Any) -> None:
    text = "write all that an installation without a network needs, to a USB stick for example"
    bundle = add_verb(verbs, "bundle", "up.bundle.verb", text, epilog=_BUNDLE_EPILOG)
    bundle.add_argument("folder", type=Path, metavar="DIR", help="the bundle is a folder in it")
    bundle.add_argument(
        "--dist", type=Path, default=Path("dist"), metavar="DIR", help="(default: dist)"
    )
    bundle.add_argument(
        "--platform",
        action="append",
        choices=("linux_x86_64", "linux_aarch64"),
        help="of the packages, again for each (default: this machine's)",
    )
    bundle.add_argument(
        "--python",
        action="append",
        choices=("3.11", "3.12", "3.13", "3.14"),
        help="there, again for each (default: this one's)",
    )


def _add_certificates(verbs: Any) -> None:
    group = verbs.add_parser(
        "certificates",
        help="make and revoke the certificates of TLS links",
        epilog=_CERTIFICATES_EPILOG,
    )
    group.set_defaults(parser=group)
    actions = group.add_subparsers(title="action", metavar="ACTION")
    for name, function, text in (
        ("init", "init", "make a private CA"),
        ("device", "device", "make the key and certificate of a relay, aircraft, ground or runner"),
        ("list", "show", "list the certificates that were issued"),
        ("revoke", "revoke", "revoke every certificate of a device"),
        ("renew", "renew", "make new certificates for devices, or for all that expire soon"),
    ):
        action = add_verb(actions, name, f"up.cli.certificates:{function}", text)
        action.add_argument(
            "--folder",
            type=Path,
            metavar="DIR",
            default=Path("certificates"),
            help="folder of the CA (default: certificates)",
        )
        if name == "init":
            action.add_argument("--name", default="Up", help="name of the CA (default: Up)")
        if name in ("device", "revoke"):
            action.add_argument("name", metavar="NAME", help="name of the device")
        if name == "device":
            text = "name or address of a server, again for each; none: the device is a client"
            action.add_argument("--host", action="append", metavar="HOST", help=text)
        if name == "renew":
            action.add_argument("names", metavar="NAME", nargs="*", help="name of a device")
        if name in ("device", "renew"):
            text = "validity (default: %(default)s)"
            action.add_argument(
                "--days", type=whole_number(1, 3650), default=825, metavar="N", help=text
            )
        if name == "list":
            add_json_option(action)


def _add_keys(verbs: Any) -> None:
    keys = verbs.add_parser(
        "keys",
        help="pair and revoke the devices that may send protected Commands",
        epilog=_KEYS_EPILOG,
    )
    keys.set_defaults(parser=keys)
    actions = keys.add_subparsers(title="actions", metavar="ACTION")

    def action(name: str, text: str, function: str = "") -> argparse.ArgumentParser:
        parser = add_verb(actions, name, f"up.cli.keys:{function or name}", text)
        add_config_option(parser)
        return parser

    add = action("add", "make a key, and print what pairs the device")
    roles = ("observer", "operator", "pilot", "admin")
    add.add_argument("--role", choices=roles, required=True)
    add.add_argument("--name", required=True, help="of the device, for logs and screens")
    add.add_argument("--not-after", default="", metavar="DAY", help="last day, YYYY-MM-DD (UTC)")
    show = action("show", "print again what pairs a device")
    show.add_argument("name", help="name or id of the key")
    for each in (add, show):
        each.add_argument("--aircraft", metavar="NAME", help="(default: as configured)")
        each.add_argument("--png", type=Path, metavar="FILE", help="write the QR code there too")
    revoke = action("revoke", "refuse a device from now on; a running program notices it")
    revoke.add_argument("name", help="name or id of the key")
    add_json_option(action("list", "list the keys without their secrets", "list_"))


def _add_explore(verbs: Any) -> None:
    explore = add_verb(
        verbs,
        "explore",
        "up.cli.explore",
        "list the module classes in ./modules",
        aliases=("e",),
        epilog=_EXPLORE_EPILOG,
    )
    explore.add_argument(
        "-t",
        "--type",
        choices=("modules", "recorders", "all"),
        default="all",
        help="recorders were replaced by Thread Modules",
    )
    explore.add_argument("-w", "--write", action="store_true", help="write registered_modules.yml")
    add_json_option(explore)
