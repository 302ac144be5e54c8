"""Problems are printed once each, as text or as JSON lines."""

import io
import json
import sys
from pathlib import Path

from up.config import ConfigErrors, ConfigProblem
from up.errors import UserError
from up.output import echo, print_problems


def test_a_group_is_printed_as_its_single_problems(monkeypatch, capsys):
    wrong = ConfigProblem(Path("a.yml"), 3, 1, "x: wrong", "out_of_range", "x", "7")
    group = UserError.group([UserError("first", "one", cog="a_cog"), ConfigErrors([wrong, wrong])])
    monkeypatch.setenv("UP_LOG_FORMAT", "json")
    print_problems(group.problems)
    assert [json.loads(line)["fields"] for line in capsys.readouterr().err.splitlines()] == [
        {"code": "one", "cog": "a_cog"},
        {"code": "out_of_range", "file": "a.yml", "line": 3, "column": 1, "key": "x", "value": "7"},
    ]
    monkeypatch.setenv("UP_LOG_FORMAT", "")
    print_problems([wrong], "warning")
    assert capsys.readouterr().err == "warning: a.yml:3:1: x: wrong\n"


class WritesKept(io.StringIO):
    def __init__(self) -> None:
        super().__init__()
        self.writes: list[str] = []

    def write(self, text: str) -> int:
        self.writes += [text] if text else []
        return super().write(text)


def test_a_line_and_its_end_are_one_write(monkeypatch):
    """The thread that watches the event loop writes to the same stream, also between two writes."""
    for name in ("stdout", "stderr"):
        monkeypatch.setattr(sys, name, WritesKept())
    echo("first")
    print_problems([UserError("second", "two"), UserError("third", "three")])
    assert sys.stdout.writes == ["first\n"]
    assert sys.stderr.writes == ["second\n", "third\n"]
