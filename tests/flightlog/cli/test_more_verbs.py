"""Verbs below ``up log`` from other distributions."""

import sys

import pytest

CODE = {
    "good": """
from up.cli.verb import add_verb


def add(verbs):
    again = add_verb(verbs, "again", "again_verbs.run", "replay")
    again.add_argument("--speed", type=float)
""",
    "broken": "raise RuntimeError('not today')\n",
}


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Return a function that puts a distribution with the verb ``again`` on the path."""

    def install(code):
        site = tmp_path / "site"
        (site / "again_verbs").mkdir(parents=True)
        (site / "again_verbs" / "__init__.py").write_text("")
        (site / "again_verbs" / "parser.py").write_text(code)
        run = "def run(values):\n    print(values.speed)\n    return 4\n"
        (site / "again_verbs" / "run.py").write_text(run)
        information = site / "again-1.0.dist-info"
        information.mkdir()
        (information / "METADATA").write_text("Metadata-Version: 2.1\nName: again\nVersion: 1\n")
        entry = "[up.log_verbs]\nagain = again_verbs.parser:add\n"
        (information / "entry_points.txt").write_text(entry)
        monkeypatch.syspath_prepend(str(site))

    yield install
    for name in [name for name in sys.modules if name.startswith("again_verbs")]:
        del sys.modules[name]


def test_a_verb_of_another_distribution(log, install):
    install(CODE["good"])
    assert "again  " in log("--help").out
    outcome = log("again", "--speed", "2")
    assert (outcome.status, outcome.out) == (4, "2.0\n")


def test_a_broken_verb_does_not_affect_others(log, install, flights):
    install(CODE["broken"])
    assert log("list").status == 0
    outcome = log("again", "--speed", "2")
    assert outcome.status == 1
    assert "'again'" in outcome.err and "RuntimeError: not today" in outcome.err
    assert "RuntimeError: not today" in log("--help").out
