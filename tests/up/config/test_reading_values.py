from dataclasses import dataclass

import pytest

from tests.up.config.samples import LINK, PATH, Gains, Link, Remote, places, problems_of
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
    [(line, column, _what, *rest)] = problems
    assert (line, column, *rest) == (1, 6, "value_missing", "part.role", "")


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
        ("rol: pilot\n", "1:1 unknown_key rol"),
        ("\n\nxyzzy: 1\n", "3:1 unknown_key xyzzy"),
        ("remote_server:\n  prt: 1\n", "2:3 unknown_key remote_server.prt"),
        ("remote_server: {port: 0}\n", "1:23 out_of_range remote_server.port"),
        ("stop delay (s): x\n", "1:17 wrong_type stop delay (s)"),
        ("stop delay (s): [1]\n", "1:17 wrong_type stop delay (s)"),
        ("role: no\n", "1:7 unknown_choice role"),
        ("role: pilot\nrole: pilot\n", "2:1 key_repeated role"),
        ("gains:\n  roll: {}\n  roll: {}\n", "3:3 key_repeated gains.roll"),
        ("forward: 1\n", "1:10 wrong_type forward"),
        ('forward: "true"\n', "1:10 wrong_type forward"),
        ("stop delay (s): '5'\n", "1:17 wrong_type stop delay (s)"),
        ("stop delay (s): .nan\n", "1:17 not_finite stop delay (s)"),
        ("stop delay (s): -.Inf\n", "1:17 not_finite stop delay (s)"),
        ("stop delay (s): 010\n", "1:17 bad_format stop delay (s)"),
        ("stop delay (s): 12:30\n", "1:17 bad_format stop delay (s)"),
        ("labels: {a: 1.0}\n", "1:13 wrong_type labels.a"),
        ("labels: {no: 1}\n", "1:10 needs_quotes labels.no"),
        ("hosts: [a, 1.5]\n", "1:12 needs_quotes hosts[1]"),
        ("hosts: [a, null]\n", "1:12 wrong_type hosts[1]"),
        ("hosts: a\n", "1:8 wrong_type hosts"),
        ("hosts: [a, b, c, d, e, f]\n", "1:8 too_long hosts"),
        ("gains: [a]\n", "1:8 wrong_type gains"),
        ("gains: {far too long a name: {}}\n", "1:9 too_long gains.far too long a name"),
        ("remote_server: 5\n", "1:16 wrong_type remote_server"),
        ("- a\n", "1:1 wrong_type"),
        ("text\n", "1:1 wrong_type"),
        ("? [a]\n: b\n", "1:3 wrong_type"),
        ("port: 1\n", "1:1 key_removed port"),
        ("remote_server: {host: a}\n", "1:17 key_removed remote_server.host"),
        ("stop delay (in seconds): 1\n", "1:1 key_renamed stop delay (in seconds)"),
        ("thresholds:\n  panic: 50\n  calm down: 60\n", "3:14 inconsistent thresholds.calm down"),
        ("thresholds:\n  panic: 50\n", "2:3 inconsistent thresholds.calm down"),
        ('name: "a\\ud800"\n', "1:7 bad_format name"),
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
    assert problems_of(f"name: {plain}\n") == ["1:7 needs_quotes name"]
    assert parse(f'name: "{plain}"\n').name == plain
    assert parse(f"name: '{plain}'\n").name == plain


@pytest.mark.parametrize(
    "plain", ["nobody", "10.0.0.1", "a:b", "::1", "v1.0", "/dev/ttyAMA0", "e5", "."]
)
def test_ordinary_words_need_no_quotes(plain):
    assert parse(f"name: {plain}\n").name == plain


def test_all_problems_are_shown_at_once_in_the_order_of_the_file():
    text = (
        "rol: 1\nremote_server:\n  port: x\n  url: [a]\nforward: 3\nforward: 4\nhosts: [1, b, 2]\n"
    )
    found = [problem.split()[0] for problem in problems_of(text)]
    assert found == ["1:1", "3:9", "4:8", "5:10", "6:1", "7:9", "7:15"]


def test_the_sentence_names_place_key_value_and_the_probable_intention():
    with pytest.raises(ConfigErrors) as caught:
        parse("remote_server: {prt: 1}\nstop delay (s): '5'\n")
    assert str(caught.value).splitlines() == [
        "link.yml:1:17: remote_server: unknown key \"prt\", did you mean 'port'?",
        'link.yml:2:17: stop delay (s): must be a number between 0 and 3600 s, not text: "5"'
        " (remove the quotes)",
    ]


def test_problems_beyond_a_hundred_are_only_mentioned():
    problems = problems_of("".join(f"key{number}: 1\n" for number in range(300)))
    assert len(problems) == 101
    assert problems[-1].endswith(" more_problems")


def test_half_a_set_is_refused_where_only_a_whole_one_will_do():
    whole = "{p: 1, i: 0}"
    assert ConfigFile("g.yml", Gains).parse(whole, PATH, whole=True) == Gains(1.0, 0.0)
    for text, problem in {
        "{p: 1}": "1:1 key_missing i",
        "{p: 1, i: }": "1:10 value_missing i",
        "": "1:1 file_empty",
        "# nothing\n": "1:1 file_empty",
    }.items():
        with pytest.raises(ConfigErrors) as caught:
            ConfigFile("g.yml", Gains).parse(text, PATH, whole=True)
        assert [places(each) for each in caught.value.problems] == [problem]


def test_a_wrong_declaration_is_found_when_the_file_is_declared():
    class NoDataclass:
        pass

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

    for cls, error in (
        (Wrong, ValueError),
        (WrongList, ValueError),
        (TwoNames, TypeError),
        (Bare, TypeError),
        (NoDataclass, TypeError),
    ):
        with pytest.raises(error):
            ConfigFile("x.yml", cls)
        with pytest.raises(error):
            section(cls)
