"""Cogfile.yml: valid content, and every mistake with its place."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from up.cogs.cogfile import COGFILE, load_cogfile
from up.config import ConfigErrors


def mistakes(root: Path, text: str) -> list[str]:
    (root / COGFILE).write_text(text)
    with pytest.raises(ConfigErrors) as errors:
        load_cogfile(root)
    return [str(problem).removeprefix(f"{root}/") for problem in errors.value.problems]


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
        (
            "a_cog:\n",
            "Cogfile.yml:1:1: a_cog: give one of path, pypi and url; here is none",
        ),
        ("\na_cog: {}\n", "Cogfile.yml:2:1: a_cog: give one of path"),
        ("a_cog: {pypi: a, url: https://a/b}\n", "Cogfile.yml:1:1: a_cog: give one of path"),
        ("a_cog: {path: nowhere}\n", "Cogfile.yml:1:1: a_cog: setup.py is missing in "),
        ("a_cog: {pypy: a}\n", "Cogfile.yml:1:9: unknown key \"pypy\", did you mean 'pypi'"),
        ('a_cog: {path: "a\\0b"}\n', "Cogfile.yml:1:15: path: must be the path of a folder"),
        ("a_cog: {pypi: --index-url}\n", "Cogfile.yml:1:15: pypi: must be the name of"),
        ('a_cog: {pypi: a, version: ">=1"}\n', "Cogfile.yml:1:27: version: must be one"),
        ("a_cog: {url: git://a/b}\n", "Cogfile.yml:1:14: url: must be an https://"),
        ("a_cog: {url: https://a/b, revision: -x}\n", "Cogfile.yml:1:37: revision: must be"),
        ("a_cog: {pypi: a, revision: b}\n", "Cogfile.yml:1:28: revision: goes with url"),
        ("3d cog: {pypi: a}\n", 'Cogfile.yml:1:1: "3d cog" is not the name of a cog'),
        (
            "a-cog: {pypi: a}\na_cog: {pypi: a}\n",
            "Cogfile.yml:2:1: a_cog is repeated",
        ),
        ("a_cog: text\n", "Cogfile.yml:1:8: must be a map"),
        ("- a_cog\n", "Cogfile.yml:1:1: must be a map"),
    ],
)
def test_a_mistake_is_told_with_its_place(tmp_path, text, problem):
    found = mistakes(tmp_path, text)
    assert found[0].startswith(problem), found


def test_all_mistakes_are_told_at_once(tmp_path):
    found = mistakes(tmp_path, "a_cog:\nb_cog: {pypi: a, url: https://a/b}\nc-c-: {pypy: a}\n")
    assert [line.split(":")[1] for line in found] == ["1", "2", "3"]


@given(text=st.text() | st.binary())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
def test_no_content_raises_anything_but_config_errors(tmp_path, text):
    data = text if isinstance(text, bytes) else text.encode("utf-8", "surrogatepass")
    (tmp_path / COGFILE).write_bytes(data)
    try:
        load_cogfile(tmp_path)
    except ConfigErrors as errors:
        assert errors.problems
