"""Every command line that a page shows is one that its program understands."""

from __future__ import annotations

import re
import shlex

import pytest

from tests.docs.test_pages import PAGES, name_of, text_of
from tests.support.virtual_environment import REPOSITORY
from up.cli.parser import make_parser
from up_ground.arguments import make_parser as make_ground_parser
from up_simulator.cli import main as up_sim

_SPAN = re.compile(r"`((?:up|up-ground|up-sim|make) [^`\n]+)`")
_LINE = re.compile(r"^(?: {4}|\$ )?((?:up|up-ground|up-sim|make) [a-z-].*)$", re.MULTILINE)
_BLOCK = re.compile(r"^```\n(.*?)^```", re.DOTALL | re.MULTILINE)
PARSERS = {"up": make_parser, "up-ground": lambda: make_ground_parser({})}


def words_of(line):
    """Return the words of the first command in a line, without its parts for readers."""
    line = re.split(r" \| | && |   +|…|\.\.\.| \[", line)[0]
    return [{"N": "1", "SECONDS": "1"}.get(word, word) for word in shlex.split(line, comments=True)]


def command_lines(text):
    outside = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    indented = "\n".join(line for line in outside.splitlines() if line.startswith("    "))
    found = _SPAN.findall(outside) + _LINE.findall(indented)
    for block in _BLOCK.findall(text):
        found += _LINE.findall(block)
    return [words for words in map(words_of, found) if len(words) > 1]


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_up_parses_the_commands_of_the_page(page, capsys):
    for program, *arguments in command_lines(text_of(page)):
        if program in ("make", "up-sim"):
            continue
        parser = PARSERS[program]()
        # A mention of a verb alone is not a whole command: its help must know it.
        verb_alone = len(arguments) == 1 or (arguments[:1] == ["create"] and len(arguments) == 2)
        if verb_alone:
            arguments = [*arguments, "--help"]
        try:
            parser.parse_args(arguments)
        except SystemExit as end:
            shown = capsys.readouterr()
            assert end.code == 0, f"{program} {shlex.join(arguments)}: {shown.err}"


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_up_sim_has_the_verbs_and_options_of_the_page(page, capsys):
    for program, verb, *arguments in command_lines(text_of(page)):
        if program != "up-sim":
            continue
        with pytest.raises(SystemExit):
            assert up_sim([verb, "--help"]) == 0, capsys.readouterr().err
        told = set(re.findall(r"--[a-z-]+", capsys.readouterr().out))
        asked = {word.partition("=")[0] for word in arguments if word.startswith("--")}
        assert asked <= told, f"{asked - told} of up-sim {verb}"


def targets_of(folder):
    """Return the targets of a folder's Makefile and its included parts."""
    paths = [folder / "Makefile", *folder.glob("*/*.mk")]
    text = "\n".join(path.read_text(encoding="utf-8") for path in paths)
    return set(" ".join(re.findall(r"^([a-z][a-z -]*):", text, re.MULTILINE)).split())


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_make_has_the_targets_of_the_page(page):
    for program, *words in command_lines(text_of(page)):
        if program != "make":
            continue
        folder = REPOSITORY
        if words[0] == "-C":
            folder, words = REPOSITORY / words[1], words[2:]
        asked = {word for word in words if "=" not in word}
        assert asked <= targets_of(folder), f"{asked} in {folder.name}"


def test_command_lines_are_found():
    assert command_lines("`up modules`, `up create -n X`") == [
        ["up", "modules"],
        ["up", "create", "-n", "X"],
    ]
    assert command_lines("    up check --config DIR     the same\n") == [
        ["up", "check", "--config", "DIR"]
    ]
    assert command_lines("```\nup gather  # all\n```\n") == [["up", "gather"]]
