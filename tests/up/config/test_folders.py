import pytest

from tests.up.config.samples import LINK, Link, Remote, places
from up.config import ConfigErrors, load_all, unknown_files
from up.config.application import APPLICATION, DISABLED_MODULES, ApplicationConfig
from up.config.file import MapFile

FILES = [LINK, APPLICATION, DISABLED_MODULES]


def test_all_files_are_loaded(tmp_path):
    (tmp_path / "link.yml").write_text("role: pilot\n")
    values = load_all(tmp_path, FILES)
    assert values[LINK] == Link(role="pilot")
    assert values[APPLICATION] == ApplicationConfig()
    assert len(values) == 3


def test_the_problems_of_all_files_are_shown_at_once(tmp_path):
    (tmp_path / "link.yml").write_text("role: boss\nrol: 1\n")
    (tmp_path / "config.yml").write_text("mode: 5\n")
    (tmp_path / "disabled_modules.yml").mkdir()
    with pytest.raises(ConfigErrors) as caught:
        load_all(tmp_path, FILES)
    assert [(each.path.name, places(each)) for each in caught.value.problems] == [
        ("link.yml", "1:7 unknown_choice role"),
        ("link.yml", "2:1 unknown_key rol"),
        ("config.yml", "1:7 unknown_choice mode"),
        ("disabled_modules.yml", "1:1 not_a_file"),
    ]


def test_files_that_nobody_reads_are_listed(tmp_path):
    for name in ("link.yml", "lnik.yml", "x.yaml", "notes.txt", "pids.yml.good"):
        (tmp_path / name).write_text("")
    assert [path.name for path in unknown_files(tmp_path, FILES)] == ["lnik.yml", "x.yaml"]
    assert unknown_files(tmp_path / "nowhere", FILES) == []


def test_a_file_that_is_one_free_map_has_its_problems_told_alike(tmp_path):
    cogs = MapFile("Cogs.yml", Remote)
    assert cogs.load(tmp_path) == {}
    (tmp_path / "Cogs.yml").write_text("a:\n  url: x\nb:\n")
    assert cogs.load(tmp_path) == {"a": Remote("x"), "b": Remote()}
    (tmp_path / "Cogs.yml").write_text("a: {prt: 1}\nb: 2\n" + "c: {x: 1, y: 2}\n" * 200)
    with pytest.raises(ConfigErrors) as caught:
        cogs.load(tmp_path)
    first, second, *_, last = caught.value.problems
    assert places(first) == "1:5 unknown_key a.prt"
    assert (places(second), second.value) == ("2:4 wrong_type b", "2")
    assert last.code == "more_problems"
