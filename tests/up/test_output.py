"""Problems are printed once each, as text or as JSON lines."""

import json
from pathlib import Path

from up.config import ConfigErrors, ConfigProblem
from up.errors import UserError
from up.output import print_problems


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
