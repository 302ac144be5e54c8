"""Cogfile.yml: valid content, and every mistake with its place."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.up.config.samples import places
from up.cogs.cogfile import COGFILE, load_cogfile
from up.config import ConfigErrors


def mistakes(root: Path, text: str) -> list[str]:
    (root / COGFILE).write_text(text)
    with pytest.raises(ConfigErrors) as errors:
        load_cogfile(root)
    assert all(problem.path == root / COGFILE for problem in errors.value.problems)
    return [places(problem) for problem in errors.value.problems]


def test_no_file_and_an_empty_one_ask_for_nothing(tmp_path):
    assert load_cogfile(tmp_path) == []
    (tmp_path / COGFILE).write_text("# nothing yet\n")
    assert load_cogfile(tmp_path) == []


def test_the_three_sources_and_both_spellings_of_a_name(tmp_path):
    (tmp_path / "here").mkdir()
    (tmp_path / "here/setup.py").write_text("")
    (tmp_path / "application").mkdir()
    (tmp_path / "application" / COGFILE).write_text(
        "android-cog: {path: ../here}\n"
        'lidar_cog: {pypi: raspilot-lidar-cog, version: "1.2"}\n'
        "camera_cog: {url: https://example.org/camera.git, revision: v1.0}\n"
    )
    android, lidar, camera = load_cogfile(tmp_path / "application")
    assert (android.cog, android.folder) == ("android_cog", tmp_path / "here")
    assert (lidar.cog, lidar.spec.pypi, lidar.spec.version) == (
        "lidar_cog",
        "raspilot-lidar-cog",
        "1.2",
    )
    assert (camera.spec.url, camera.spec.revision) == ("https://example.org/camera.git", "v1.0")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("a_cog:\n", "1:1 source_unclear a_cog"),
        ("\na_cog: {}\n", "2:1 source_unclear a_cog"),
        ("a_cog: {pypi: a, url: https://a/b}\n", "1:1 source_unclear a_cog"),
        ("a_cog: {path: nowhere}\n", "1:1 source_missing a_cog"),
        ("a_cog: {pypy: a}\n", "1:9 unknown_key a_cog.pypy"),
        ('a_cog: {path: "a\\0b"}\n', "1:15 bad_format a_cog.path"),
        ("a_cog: {pypi: --index-url}\n", "1:15 bad_format a_cog.pypi"),
        ('a_cog: {pypi: a, version: ">=1"}\n', "1:27 bad_format a_cog.version"),
        ("a_cog: {url: git://a/b}\n", "1:14 bad_format a_cog.url"),
        ("a_cog: {url: https://a/b, revision: -x}\n", "1:37 bad_format a_cog.revision"),
        ("a_cog: {pypi: a, revision: b}\n", "1:28 inconsistent a_cog.revision"),
        ("3d cog: {pypi: a}\n", "1:1 bad_format 3d cog"),
        ("a-cog: {pypi: a}\na_cog: {pypi: a}\n", "2:1 key_repeated a_cog"),
        ("a_cog: text\n", "1:8 wrong_type a_cog"),
        ("- a_cog\n", "1:1 wrong_type"),
    ],
)
def test_a_mistake_is_told_with_its_place(tmp_path, text, problem):
    found = mistakes(tmp_path, text)
    assert found[0] == problem


def test_all_mistakes_are_told_at_once(tmp_path):
    found = mistakes(tmp_path, "a_cog:\nb_cog: {pypi: a, url: https://a/b}\nc-c-: {pypy: a}\n")
    assert [each.split()[0] for each in found] == ["1:1", "2:1", "3:8"]


@given(text=st.text() | st.binary())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
def test_no_content_raises_anything_but_config_errors(tmp_path, text):
    data = text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass")
    (tmp_path / COGFILE).write_bytes(data)
    try:
        load_cogfile(tmp_path)
    except ConfigErrors as errors:
        assert errors.problems
