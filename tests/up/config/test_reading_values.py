from dataclasses import dataclass

import pytest

from tests.up.config.samples import LINK, PATH, Gains, Link, Remote, problems_of
from up.config import ConfigErrors, ConfigFile, items, key, section
from up.config.nodes import compose
from up.config.schema import schema_of
from up.config.validator import Validator


def parse(text):
    return LINK.parse(text, PATH)


@pytest.mark.parametrize(
    "text", ["", "\n", "# only comments\n", "---\n", "---\n...\n", "~\n", "\ufeff"]
)
def test_an_empty_file_is_its_defaults(text):
    assert parse(text) == Link()
    assert parse(text.encode()) == Link()


def test_values_are_read_into_the_dataclass():
    link = parse(
        "remote_server:\n  url: example.org\n  port: 4000\nrole: pilot\nstop delay (s): 5\n"
        'forward: no\nname: "12:30"\nlimit: 1e3\nspare server: {url: b}\n'
        "gains:\n  yaw: {p: 2}\n  roll:\nlabels: {a: 1}\nhosts: [a.b]\n"
    )
    assert link == Link(
        remote_server=Remote("example.org", 4000),
        role="pilot",
        stop_delay_s=5.0,
        forward=False,
        name="12:30",
        limit=1000.0,
        spare=Remote("b"),
        gains={"yaw": Gains(p=2.0), "roll": Gains()},
        labels={"a": 1},
        hosts=("a.b",),
    )
    assert type(link.stop_delay_s) is float


def test_a_reader_may_want_a_value_behind_every_key():
    problems = []
    root = compose("role:\nlimit:\nremote_server:\n", lambda *one: problems.append(one))
    validator = Validator(lambda *one: problems.append(one), {}, valued=True)
    validator.read(schema_of(Link), root, "part")
    assert problems == [(1, 6, "part.role: must have a value")]


def test_an_empty_key_is_its_default_unless_null_means_something():
    assert parse("role:\nstop delay (s): null\nhosts: ~\nremote_server:\ngains:\n") == Link()
    assert parse("limit: 5\n").limit == 5.0
    assert parse("limit: null\n").limit is None
    assert parse("remote_server:\n  url:\n  port: 1\n").remote_server == Remote(port=1)


@pytest.mark.parametrize("word", ["true", "True", "TRUE", "yes", "on", "Yes", "ON"])
def test_yaml_words_for_true_are_read_where_a_bool_is_asked(word):
    assert parse(f"forward: {word}\n").forward is True


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("rol: pilot\n", "1:1: unknown key \"rol\", did you mean 'role'?"),
        ("\n\nxyzzy: 1\n", '3:1: unknown key "xyzzy"'),
        (
            "remote_server:\n  prt: 1\n",
            "2:3: remote_server: unknown key \"prt\", did you mean 'port'?",
        ),
        (
            "remote_server: {port: 0}\n",
            "1:23: remote_server.port: must be a whole number between 1 and 65535, not 0",
        ),
        (
            "stop delay (s): x\n",
            '1:17: stop delay (s): must be a number between 0 and 3600 s, not "x"',
        ),
        (
            "stop delay (s): [1]\n",
            "1:17: stop delay (s): must be a number between 0 and 3600 s, not a list",
        ),
        ("role: no\n", '1:7: role: must be one of "observer", "operator", "pilot", not "no"'),
        ("role: pilot\nrole: pilot\n", '2:1: the key "role" is repeated, first in line 1'),
        (
            "gains:\n  roll: {}\n  roll: {}\n",
            '3:3: gains: the key "roll" is repeated, first in line 2',
        ),
        ("forward: 1\n", '1:10: forward: must be true or false, not "1"'),
        (
            'forward: "true"\n',
            '1:10: forward: must be true or false, not text: "true" (remove the quotes)',
        ),
        (
            "stop delay (s): '5'\n",
            "1:17: stop delay (s): must be a number between 0 and 3600 s, "
            'not text: "5" (remove the quotes)',
        ),
        ("stop delay (s): .nan\n", "1:17: stop delay (s): must be a finite number, not .nan"),
        ("stop delay (s): -.Inf\n", "1:17: stop delay (s): must be a finite number, not -.Inf"),
        (
            "stop delay (s): 010\n",
            '1:17: stop delay (s): must not begin with 0, which YAML reads as octal: "010"',
        ),
        (
            "stop delay (s): 12:30\n",
            "1:17: stop delay (s): must be a number between 0 and 3600 s, "
            'not "12:30" (YAML counts it in sixties)',
        ),
        (
            "labels: {a: 1.0}\n",
            "1:13: labels.a: must be a whole number between 0 and 9, not 1.0",
        ),
        (
            "labels: {no: 1}\n",
            "1:10: labels.no: as a key must be in quotes, YAML does not read "
            'it as text: write "no"',
        ),
        (
            "hosts: [a, 1.5]\n",
            '1:12: hosts[1]: must be in quotes, YAML does not read it as text: write "1.5"',
        ),
        ("hosts: [a, null]\n", "1:12: hosts[1]: must be text, not null"),
        ("hosts: a\n", '1:8: hosts: must be a list, not "a"'),
        ("hosts: [a, b, c, d, e, f]\n", "1:8: hosts: must have at most 5 items"),
        ("gains: [a]\n", "1:8: gains: must be a map, not a list"),
        (
            "gains: {far too long a name: {}}\n",
            "1:9: gains.far too long a name: as a key must be "
            "text of at most 10 characters, not of 19",
        ),
        ("remote_server: 5\n", '1:16: remote_server: must be a map of keys, not "5"'),
        ("- a\n", "1:1: must be a map of keys, not a list"),
        ("text\n", '1:1: must be a map of keys, not "text"'),
        ("? [a]\n: b\n", "1:3: a key must be one word or text, not a list"),
        (
            "port: 1\n",
            "1:1: the key \"port\" was removed: write 'remote_server: {port: ...}'",
        ),
        (
            "remote_server: {host: a}\n",
            "1:17: remote_server: the key \"host\" was removed: write 'url' instead",
        ),
        (
            "stop delay (in seconds): 1\n",
            '1:1: the key "stop delay (in seconds)" is now called "stop delay (s)"',
        ),
        (
            "thresholds:\n  panic: 50\n  calm down: 60\n",
            "3:14: thresholds.calm down: must be below panic",
        ),
        ("thresholds:\n  panic: 50\n", "2:3: thresholds.calm down: must be below panic"),
        ('name: "a\\ud800"\n', "1:7: name: must be valid Unicode text, not lone surrogates"),
    ],
)
def test_a_mistake_is_named_at_its_place(text, problem):
    assert problems_of(text) == [problem]


@pytest.mark.parametrize(
    "plain",
    [
        "no",
        "yes",
        "On",
        "OFF",
        "true",
        "12:30",
        "1e3",
        "010",
        "0x1F",
        "1_000",
        "1.5",
        ".5",
        "-1",
        ".inf",
        ".NaN",
        "2024-01-31",
        "<<",
        "=",
        "y",
        "0b11",
        "0o7",
        "190:20:30",
        "+12",
    ],
)
def test_what_yaml_would_not_read_as_text_must_be_quoted(plain):
    [problem] = problems_of(f"name: {plain}\n")
    assert problem == (
        f'1:7: name: must be in quotes, YAML does not read it as text: write "{plain}"'
    )
    assert parse(f'name: "{plain}"\n').name == plain
    assert parse(f"name: '{plain}'\n").name == plain


@pytest.mark.parametrize(
    "plain", ["nobody", "10.0.0.1", "a:b", "::1", "v1.0", "/dev/ttyAMA0", "e5", "."]
)
def test_ordinary_words_need_no_quotes(plain):
    assert parse(f"name: {plain}\n").name == plain


def test_all_problems_are_shown_at_once_in_the_order_of_the_file():
    assert [
        p.split(": ")[0]
        for p in problems_of(
            "rol: 1\nremote_server:\n  port: x\n  url: [a]\n"
            "forward: 3\nforward: 4\nhosts: [1, b, 2]\n"
        )
    ] == ["1:1", "3:9", "4:8", "5:10", "6:1", "7:9", "7:15"]


def test_problems_beyond_a_hundred_are_only_mentioned():
    problems = problems_of("".join(f"key{number}: 1\n" for number in range(300)))
    assert len(problems) == 101
    assert problems[-1].endswith("more than 100 problems, the rest is not shown")


def test_half_a_set_is_refused_where_only_a_whole_one_will_do():
    whole = "{p: 1, i: 0}"
    assert ConfigFile("g.yml", Gains).parse(whole, PATH, whole=True) == Gains(1.0, 0.0)
    for text, problem in {
        "{p: 1}": '1:1: the key "i" is missing',
        "{p: 1, i: }": "1:10: i: must have a value",
        "": "1:1: is empty",
        "# nothing\n": "1:1: is empty",
    }.items():
        with pytest.raises(ConfigErrors) as caught:
            ConfigFile("g.yml", Gains).parse(text, PATH, whole=True)
        assert str(caught.value) == f"link.yml:{problem}"


def test_a_wrong_declaration_is_found_when_the_file_is_declared():
    class NoDataclass:
        pass

    with pytest.raises(TypeError, match="is not a dataclass"):
        ConfigFile("x.yml", NoDataclass)


def test_a_default_that_its_own_bounds_refuse_is_found_when_the_file_is_declared():
    @dataclass(frozen=True)
    class Wrong:
        port: int = key(0, "A port.", minimum=1)

    @dataclass(frozen=True)
    class WrongList:
        ports: tuple = items(Gains, "Ports.", default=(1,))

    @dataclass(frozen=True)
    class TwoNames:
        a: int = key(0, "A.", name="x")
        x: int = key(0, "X.")

    @dataclass(frozen=True)
    class Bare:
        a: int = 0

    @dataclass(frozen=True)
    class Section:
        inner: Wrong = section(Wrong)

    for cls, error in (
        (Wrong, ValueError),
        (WrongList, ValueError),
        (TwoNames, TypeError),
        (Bare, TypeError),
        (Section, ValueError),
    ):
        with pytest.raises(error):
            ConfigFile("x.yml", cls)
