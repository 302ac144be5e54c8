"""Verbs that other distributions bring: found by their entry points, harmless when broken."""

import subprocess
import sys

import pytest

from up.cli.parser import make_parser
from up.cli.plugin_verbs import verb_of

GOOD = """
from up.cli.verb import add_verb


def add(verbs):
    greet = add_verb(verbs, "greet", "greeting_verbs.greet", "hello")
    greet.add_argument("name")
"""
GREET = """
def run(values):
    print(f"hello {values.name}")
    return 3
"""
BROKEN = {
    "no such module": ("nowhere.to_be:add", "No module named 'nowhere'", ""),
    "no such function": ("greeting_verbs.other:add", "AttributeError: ", "x = 1\n"),
    "a mistake in its code": ("greeting_verbs.other:add", "SyntaxError: ", "def add(:\n"),
    "an exception": ("greeting_verbs.other:add", "ZeroDivisionError: ", "1 / 0\n"),
    "an exit": ("greeting_verbs.other:add", "SystemExit: 5", "raise SystemExit(5)\n"),
    "no function": ("greeting_verbs.other:add", "TypeError: ", "add = 5\n"),
    "nothing added": ("greeting_verbs.other:add", "it adds nothing", "def add(verbs): pass\n"),
    "another verb": (
        "greeting_verbs.other:add",
        "it adds 'check', 'wave'",
        "def add(verbs):\n    verbs.add_parser('wave')\n    verbs.add_parser('check')\n",
    ),
}


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Return a function that puts a distribution with entry points on the path."""
    site = tmp_path / "site"
    package = site / "greeting_verbs"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "parser.py").write_text(GOOD)
    (package / "greet.py").write_text(GREET)
    monkeypatch.syspath_prepend(str(site))

    def install(entries, name="greeting", other="", group="up.verbs"):
        (package / "other.py").write_text(other)
        information = site / f"{name}-1.0.dist-info"
        information.mkdir()
        (information / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1\n")
        lines = [f"{verb} = {target}" for verb, target in entries.items()]
        (information / "entry_points.txt").write_text("\n".join([f"[{group}]", *lines, ""]))
        return site

    yield install
    for module in [name for name in sys.modules if name.startswith("greeting_verbs")]:
        del sys.modules[module]


def test_a_verb_of_another_distribution(up, install):
    install({"greet": "greeting_verbs.parser:add"})
    assert "greet" in up("--help").out
    outcome = up("greet", "Jay")
    assert (outcome.status, outcome.out) == (3, "hello Jay\n")
    assert up("-f", "anywhere", "greet", "Jay").status == 3
    assert "usage: up greet" in up("greet", "--help").out


@pytest.mark.parametrize("what", BROKEN)
def test_a_broken_one_is_one_sentence_and_harms_no_other(up, install, what):
    target, why, code = BROKEN[what]
    install({"greet": "greeting_verbs.parser:add", "wave": target}, other=code)
    outcome = up("wave", "--speed", "5", "x", "-h", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (1, "verb_broken")
    assert outcome.problem["verb"] == "wave" and why in outcome.problem["reason"]
    shown = up("--help")
    assert shown.status == 0 and "greet" in shown.out and why in " ".join(shown.out.split())
    assert up("greet", "Jay").out == "hello Jay\n"


def test_what_a_terminal_would_carry_out_is_escaped(up, install):
    install({"wave": "greeting_verbs.other:add"}, other="raise ValueError('\\x1b[2J100%s')\n")
    assert "ValueError: \\x1b[2J100%s" in up("wave").err
    assert "ValueError: \\x1b[2J100%s" in up("--help").out


def test_what_the_verbs_module_lacks_is_named(up, install):
    site = install({"greet": "greeting_verbs.parser:add"})
    (site / "greeting_verbs" / "greet.py").write_text("import a_library_that_is_missing\n")
    outcome = up("greet", "Jay", as_json=True)
    assert outcome.problem == {"code": "import_missing", "module": "a_library_that_is_missing"}


def test_two_that_bring_the_same_verb_are_both_named(up, install):
    install({"greet": "greeting_verbs.parser:add"})
    install({"greet": "greeting_verbs.parser:add"}, name="salute")
    outcome = up("greet", "Jay")
    assert outcome.status == 1
    assert "greeting" in outcome.err and "salute" in outcome.err


def test_our_own_verbs_cannot_be_replaced(up, install):
    install({"check": "greeting_verbs.parser:add", "greet": "greeting_verbs.parser:add"})
    assert up("greet", "Jay").status == 3
    assert "--defaults" in up("check", "--help").out


def test_our_own_verbs_load_no_plugin(up, install):
    install({"wave": "greeting_verbs.other:add"})
    up("check")
    assert "greeting_verbs" not in sys.modules
    up("--help")
    assert "greeting_verbs" in sys.modules


def test_a_verb_loads_no_other_plugin(up, install):
    install({"greet": "greeting_verbs.parser:add", "wave": "greeting_verbs.other:add"})
    assert up("greet", "Jay").status == 3
    assert "greeting_verbs.other" not in sys.modules


def test_an_unknown_verb_gets_a_suggestion(up, install):
    install({"greet": "greeting_verbs.parser:add"})
    outcome = up("gret")
    assert outcome.status == 2 and "'greet'?" in outcome.err


@pytest.mark.parametrize(
    ("arguments", "verb"),
    [
        ("log list", "log"),
        ("-f plane log list", "log"),
        ("--file=plane log", "log"),
        ("--file plane check --mode x", "check"),
        ("--help", None),
        ("-h log", "log"),
        ("", None),
        ("-f", None),
    ],
)
def test_which_word_is_the_verb(arguments, verb):
    assert verb_of(arguments.split()) == verb


def test_our_own_verbs_do_not_even_look_for_plugins():
    code = (
        "import sys; sys.modules.pop('importlib.metadata', None);"
        "from up.cli.parser import make_parser; make_parser({});"
        "raise SystemExit('importlib.metadata' in sys.modules)"
    )
    for arguments, looks in (["check"], 0), (["log"], 1), ([], 1):
        done = subprocess.run([sys.executable, "-c", code.format(arguments)], timeout=60)
        assert done.returncode == looks


def test_the_parser_knows_every_plugin_when_nothing_was_typed(install):
    install({"greet": "greeting_verbs.parser:add"})
    assert make_parser().parse_args(["greet", "Jay"]).name == "Jay"
