"""Completion scripts of a program for bash, zsh and fish, from its argument parser.

Completing a word starts no program.
"""

from __future__ import annotations

import argparse
import re
import shlex
from collections.abc import Iterator
from dataclasses import field

from up.quick_dataclass import dataclass

SHELLS = ("bash", "zsh", "fish")


@dataclass(frozen=True, slots=True)
class Option:
    """One option: its spellings, its help, whether a value follows, and all possible values."""

    names: tuple[str, ...]
    about: str
    has_value: bool
    choices: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Verb:
    """A program or verb with its options and the verbs below it; aliases are verbs, too."""

    about: str = ""
    options: tuple[Option, ...] = ()
    verbs: dict[str, Verb] = field(default_factory=dict)


def verb_of(parser: argparse.ArgumentParser, about: str = "") -> Verb:
    """Return what a parser accepts."""
    options, verbs = [], {}
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            texts = {each.dest.split(" ")[0]: each.help for each in action._choices_actions}
            for name, below in action.choices.items():
                verbs[name] = verb_of(below, texts.get(name) or below.description or "")
        elif action.option_strings and action.help != argparse.SUPPRESS:
            options.append(
                Option(
                    tuple(action.option_strings),
                    action.help or "",
                    action.nargs != 0,
                    tuple(map(str, action.choices or ())),
                )
            )
    return Verb(about, tuple(options), verbs)


def script(shell: str, program: str, root: Verb) -> str:
    """Return the completion script; ``shell`` is one of SHELLS."""
    if shell == "fish":
        return "".join(f"{line}\n" for line in _fish(program, root))
    head = "autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && bashcompinit\n"
    return (head if shell == "zsh" else "") + _bash(program, root)


def _walk(path: tuple[str, ...], verb: Verb) -> Iterator[tuple[tuple[str, ...], Verb]]:
    yield path, verb
    for name, below in verb.verbs.items():
        yield from _walk((*path, name), below)


_BASH = """\
{function}() {{
    local word="${{COMP_WORDS[COMP_CWORD]}}" last="${{COMP_WORDS[COMP_CWORD-1]}}"
    local at="{program}" words="" index IFS=$'\\n'
    for ((index = 1; index < COMP_CWORD; index++)); do
        case "$at ${{COMP_WORDS[index]}}" in
            {paths}) at="$at ${{COMP_WORDS[index]}}" ;;
        esac
    done
    case "$at:$last" in
{values}
        *) case "$at" in
{lists}
        esac ;;
    esac
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F {function} {program}
"""
"""Without words, for example after an option with a path, bash completes file names."""


def _bash(program: str, root: Verb) -> str:
    values, lists = [], []
    verbs = list(_walk((program,), root))
    for path, verb in verbs:
        at = " ".join(path)
        for each in verb.options:
            if each.has_value:
                pattern = "|".join(shlex.quote(f"{at}:{name}") for name in each.names)
                values.append(f"        {pattern}) words={_words(each.choices)} ;;")
        names = [name for each in verb.options for name in each.names if name.startswith("--")]
        lists.append(f"            '{at}') words={_words((*verb.verbs, *names))} ;;")
    paths = "|".join(f"'{' '.join(path)}'" for path, _ in verbs[1:]) or "''"
    return _BASH.format(
        function=f"_{program.replace('-', '_')}",
        program=program,
        paths=paths,
        values="\n".join(values),
        lists="\n".join(lists),
    )


def _words(words: tuple[str, ...]) -> str:
    """Return words, one a line; the backslash before a blank reaches the command line."""
    return "$'" + "\\n".join(each.replace(" ", "\\\\\\\\ ") for each in words) + "'"


def _fish(program: str, root: Verb) -> Iterator[str]:
    yield f"complete -c {program} -e"
    for path, verb in _walk((), root):
        seen = [f"__fish_seen_subcommand_from {name}" for name in path]
        if verb.verbs:
            others = " ".join(verb.verbs)
            condition = "; and ".join([*seen, f"not __fish_seen_subcommand_from {others}"])
            for name, below in verb.verbs.items():
                text = shlex.quote(_about(below.about))
                yield f"complete -c {program} -f -n '{condition}' -a {name} -d {text}"
        condition = f" -n '{'; and '.join(seen)}'" if seen else ""
        for each in verb.options:
            names = " ".join(
                f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}"
                for name in each.names
            )
            kind = " -x" if each.choices else " -r" if each.has_value else ""
            if each.choices:
                choices = " ".join(choice.replace(" ", "\\ ") for choice in each.choices)
                kind += f" -a {shlex.quote(choices)}"
            text = shlex.quote(_about(each.about))
            yield f"complete -c {program}{condition} {names}{kind} -d {text}"


def _about(text: str) -> str:
    """Return help on one line, without placeholders of argparse."""
    return re.sub(r"%\((\w+)\)\w", r"\1", " ".join(text.split())).replace("%%", "%")
