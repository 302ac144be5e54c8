"""Verbs that other distributions add to the command line.

A distribution announces one as an entry point: ``log = my_cog.cli:add`` in the group ``up.verbs``
adds ``up log``. ``add(verbs)`` adds only the verb of that name to the return value of argparse's
``add_subparsers`` (``up.cli.verb.add_verb`` does it in one call). It must import nothing slow,
because every display of the help calls it. A verb may have its own group for verbs below it.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from up.cli.cli_error import CliError
from up.fields import printable
from up.quick_dataclass import dataclass

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

UP_VERBS = "up.verbs"
_MAX_REASON = 200


@dataclass(frozen=True, slots=True)
class _Plugin:
    """Entry points with the same name; more than one is an error."""

    name: str
    entries: tuple[EntryPoint, ...]

    @property
    def distributions(self) -> str:
        return " and ".join(_distribution(entry) for entry in self.entries)


def add_plugin_verbs(verbs: Any, group: str, asked: str | None = None) -> None:
    """Add the verbs of a group of entry points; never raises, whatever the plug-ins do.

    ``asked`` is the verb that the user typed, if known; only that one is loaded. A plug-in that
    cannot be loaded becomes a verb that reports the reason. A plug-in cannot replace an existing
    verb.
    """
    plugins = [plugin for plugin in _announced(group) if plugin.name not in verbs.choices]
    if asked is not None and any(plugin.name == asked for plugin in plugins):
        plugins = [plugin for plugin in plugins if plugin.name == asked]
    for plugin in plugins:
        try:
            _add(verbs, plugin)
        except _BrokenError as error:
            _add_broken(verbs, plugin, str(error))


def verb_of(arguments: Collection[str]) -> str | None:
    """Return the verb among the arguments of ``up``, or None."""
    parser = argparse.ArgumentParser(add_help=False, exit_on_error=False)
    parser.add_argument("-f", "--file")
    parser.add_argument("words", nargs=argparse.REMAINDER)
    try:
        words = parser.parse_known_args(list(arguments))[0].words
    except argparse.ArgumentError:
        return None
    return next((word for word in words if not word.startswith("-")), None)


class _BrokenError(Exception):
    """A plug-in cannot be used; the text is the reason."""


def _announced(group: str) -> list[_Plugin]:
    # Imported only when needed: it takes a third as long as everything else.
    from importlib.metadata import entry_points

    # The same distribution may be found twice: its files, and a copy of them on the path.
    found: dict[str, dict[tuple[str, str], EntryPoint]] = {}
    for entry in entry_points(group=group):
        found.setdefault(entry.name, {}).setdefault((_distribution(entry), entry.value), entry)
    return [_Plugin(name, tuple(found[name].values())) for name in sorted(found)]


def _add(verbs: Any, plugin: _Plugin) -> None:
    if len(plugin.entries) > 1:
        raise _BrokenError("two distributions bring it, and only one may")
    try:
        add: Callable[[Any], object] = plugin.entries[0].load()
        # Tried on a separate parser first: a partly added verb cannot be removed.
        trial = argparse.ArgumentParser().add_subparsers()
        add(trial)
        added = set(trial.choices)
        if plugin.name not in added or added & set(verbs.choices):
            raise _BrokenError(f"it adds {_listed(added)} instead of '{plugin.name}' alone")
        add(verbs)
    except _BrokenError:
        raise
    except (Exception, SystemExit) as error:
        # A plug-in may raise anything; 'up' must keep working.
        raise _BrokenError(_reason(error)) from error


def _add_broken(verbs: Any, plugin: _Plugin, why: str) -> None:
    sentence = (
        f"the verb '{printable(plugin.name)}' of {printable(plugin.distributions)} cannot be used:"
        f" {printable(why)}"
    )

    def carry_out(values: argparse.Namespace) -> int:
        raise CliError(sentence, code="verb_broken", verb=plugin.name, reason=why)

    parser = verbs.add_parser(
        plugin.name,
        # argparse treats % as the start of a placeholder.
        help=f"cannot be used: {printable(why)}".replace("%", "%%"),
        add_help=False,
        prefix_chars="\0",
    )
    parser.add_argument("rest", nargs="*")
    parser.set_defaults(carry_out=carry_out)


def _distribution(entry: EntryPoint) -> str:
    return entry.dist.name if entry.dist is not None else entry.module


def _reason(error: BaseException) -> str:
    text = " ".join(str(error).split()) or type(error).__name__
    if not isinstance(error, ImportError):
        text = f"{type(error).__name__}: {text}"
    return text if len(text) <= _MAX_REASON else f"{text[:_MAX_REASON]}..."


def _listed(names: Collection[str]) -> str:
    return ", ".join(f"'{name}'" for name in sorted(names)) or "nothing"
