import os
import sys
from pathlib import Path
from unittest.mock import patch

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.up.config.samples import LINK, PATH, Link, problems_of
from up.config import ConfigErrors, nodes
from up.config.problems import CODES

SMALL = (
    b"remote_server:\n  url: \"a\\x41\"\n  port: 1 # p\ngains: {yaw: {p: 1.5e1}}\nhosts:\n- 'b'\n"
)


def is_value_or_config_errors(data):
    """The one promise about any bytes: a value, or problems that are one printable line each."""
    try:
        value = LINK.parse(data, PATH)
    except ConfigErrors as errors:
        assert errors.problems
        lines = (
            data.count(b"\n") + data.count(b"\r") + data.count(b"\x85") + data.count(b"\xe2") + 2
        )
        for problem in errors.problems:
            assert str(problem).isprintable()
            assert 1 <= problem.line <= lines
            assert problem.column >= 1
            assert problem.code in CODES
    else:
        assert isinstance(value, Link)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("role: [pilot\n", "2:1 not_yaml"),
        ("role: a: b\n", "1:8 not_yaml"),
        ("role: pilot\n indented: 3\n", "2:10 not_yaml"),
        ("hosts:\n  - a\n - b\n", "3:2 not_yaml"),
        ("role: pilot\nb\nhosts: a\n", "3:1 not_yaml"),
        ("role\nhosts: a\n", "2:6 not_yaml"),
        ("remote_server:\n\turl: a\n", "2:1 not_yaml"),
        ("role: pilot\n---\nrole: pilot\n", "2:1 not_supported"),
        ("role: &a pilot\n", "1:7 not_supported"),
        ("role: *a\n", "1:7 not_supported"),
        ("role: !!python/object/apply:os.system [x]\n", "1:7 not_supported"),
        ("role: !!str pilot\n", "1:7 not_supported"),
        ("role: ! pilot\n", "1:7 not_supported"),
        ('role: "\\UFFFFFFFF"\n', "1:1 not_yaml"),
        (f"%YAML {'1' * 5000}.1\n---\n", "1:1 not_yaml"),
        ("role: a\x07b\n", "1:8 not_yaml"),
        ("role: a\x00\n", "1:8 not_yaml"),
    ],
)
def test_what_is_no_plain_yaml_is_refused_at_its_place(text, problem):
    assert problems_of(text)[0] == problem


def test_a_python_object_is_not_made(tmp_path):
    witness = tmp_path / "witness"
    text = f"role: !!python/object/apply:os.mkdir ['{witness}']\n"
    assert problems_of(text)[0] == "1:7 not_supported"
    assert not witness.exists()


def test_what_else_is_wrong_is_told_beside_a_refused_tag_or_anchor():
    assert len(problems_of("role: &a 5\nname: !x b\nrol: 1\n")) == 4


def test_an_alias_bomb_is_refused_at_its_first_anchor():
    bomb = "a: &a [x]\n" + "".join(
        f"{chr(98 + n)}: &{chr(98 + n)} [{', '.join(['*' + chr(97 + n)] * 9)}]\n" for n in range(9)
    )
    assert "1:4 not_supported" in problems_of(bomb)


@pytest.mark.parametrize("opening", ["[", "{a: ", "- ", "? ", "{[", "[{"])
def test_deep_nesting_is_refused(opening):
    for depth in (25, 300, sys.getrecursionlimit() * 5):
        problems = problems_of("hosts: " + opening * depth)
        assert len(problems) == 1


def test_a_very_large_number_is_refused():
    assert problems_of(f"stop delay (s): {'9' * 100_000}\n") == ["1:17 wrong_type stop delay (s)"]
    assert problems_of(f"stop delay (s): {'9' * 399}\n") == ["1:17 out_of_range stop delay (s)"]
    assert problems_of(f"labels: {{a: {'9' * 399}}}\n") == ["1:13 out_of_range labels.a"]
    assert problems_of("limit: 1e999\n") == ["1:8 not_finite limit"]


@pytest.mark.parametrize(
    ("data", "place"),
    [
        (b"role: \xff\n", "1:7 not_utf8"),
        (b"\xef\xbb\xbfrole: \xff\n", "1:7 not_utf8"),
        ("a: 1\n# ž\nrole: ".encode() + b"\xe9", "3:7 not_utf8"),
        ("role: pilot\n".encode("utf-16"), "1:1 not_utf8"),
        (b"#" * (1024 * 1024 + 1), "1:1 file_too_large"),
    ],
)
def test_bytes_that_are_no_text_are_refused(data, place):
    assert problems_of(data) == [place]


def link_to(target):
    return lambda path: path.symlink_to(target)


def load_problem(tmp_path):
    with pytest.raises(ConfigErrors) as caught:
        LINK.load(tmp_path)
    [problem] = caught.value.problems
    assert problem.path == tmp_path / "link.yml"
    return problem.code


def test_a_missing_file_is_its_defaults(tmp_path):
    assert LINK.load(tmp_path) == Link()
    assert LINK.load(tmp_path / "no folder") == Link()


@pytest.mark.parametrize(
    "make", [Path.mkdir, os.mkfifo, *map(link_to, ("gone", "link.yml", "/dev/zero"))]
)
def test_what_is_not_a_regular_file_is_refused_without_waiting(tmp_path, make):
    make(tmp_path / "link.yml")
    assert load_problem(tmp_path) in ("not_a_file", "cannot_read")


def test_a_link_to_a_file_is_followed(tmp_path):
    (tmp_path / "real").write_text("role: pilot\n")
    (tmp_path / "link.yml").symlink_to(tmp_path / "real")
    assert LINK.load(tmp_path).role == "pilot"


def test_a_file_in_the_place_of_the_folder_is_refused(tmp_path):
    (tmp_path / "folder").write_text("")
    with pytest.raises(ConfigErrors) as caught:
        LINK.load(tmp_path / "folder")
    assert caught.value.code == "cannot_read"


def test_an_unreadable_file_is_refused(tmp_path):
    (tmp_path / "link.yml").write_text("role: pilot\n")
    (tmp_path / "link.yml").chmod(0)
    user = os.geteuid()
    if user == 0:
        os.seteuid(65534)  # root reads everything
    try:
        assert load_problem(tmp_path) == "cannot_read"
    finally:
        os.seteuid(user)


def test_every_byte_of_a_small_file_changed_or_lost_gives_a_value_or_problems():
    is_value_or_config_errors(SMALL)
    for position in range(len(SMALL)):
        for byte in {*range(0, 256, 5), *b"\t\n !\"#%&'*,-:>?@[]`{|}~"}:
            data = SMALL[:position] + bytes([byte]) + SMALL[position + 1 :]
            is_value_or_config_errors(data)
        is_value_or_config_errors(SMALL[:position])
        is_value_or_config_errors(SMALL[:position] + SMALL[position + 1 :])


YAML_BITS = st.sampled_from(
    ["role", ": ", "\n", "  ", "- ", "[", "]", "{", "}", ", ", "'", '"', "#", "&a", "*a", "!!x ",
     "!", "? ", "|\n", ">-\n", "%YAML 1.1", "---\n", "...\n", "<<", "~", "\t", "\\", "\\x", "\\U",
     "remote_server", "port", "gains", "hosts", "1", "0x", ".nan", "1e9", "\ufeff", "\x85",
     "\u2028", "\r", "@", "`", "\ud7ff", "🛩"]
)  # fmt: skip


@given(st.lists(YAML_BITS, max_size=40).map("".join))
def test_any_heap_of_yaml_gives_a_value_or_problems(text):
    is_value_or_config_errors(text.encode())


@settings(deadline=None)
@given(st.text(st.characters(exclude_categories=()), max_size=100))
def test_any_text_even_with_surrogates_gives_a_value_or_problems(text):
    try:
        assert isinstance(LINK.parse(text, PATH), Link)
    except ConfigErrors as errors:
        assert all(str(problem).isprintable() for problem in errors.problems)


PIECES = (
    "key: ", "- ", "  ", "\n", "\n  ", "# c", "'q'", '"d"', "{a: b}", "[1, 2]", "a", "1.5", ":",
    "|\n", "> \n", "---\n", "...\n", "'a\n b'", "a\n b", "{a: b,\n c: d}", "- - a\n", "a:\n- b\n",
    "|-\n  x\n", "{", "}", "[", "]", ",", "é", '"\\n"', "? ", "%", "@", "!", "&a ", "*a", "\t",
    "\r\n", "\u2028", "\x1f", "|#", "{i: }",
)  # fmt: skip


def nodes_and_problems(text):
    found = []
    return nodes.compose(text, lambda *problem: found.append(problem)), found


@pytest.mark.skipif(nodes._LIBYAML is None, reason="this PyYAML is without libyaml")
@given(st.lists(st.sampled_from(PIECES), max_size=9).map("".join))
@example("? a\n")
@example("[b?]")
@example("---\n  ")
@example("|#\n a")
def test_a_file_means_the_same_with_libyaml_and_without(text):
    quick = nodes_and_problems(text)
    with patch.object(nodes, "_LIBYAML", None):
        assert quick == nodes_and_problems(text)
