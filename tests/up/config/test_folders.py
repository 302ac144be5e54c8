import pytest

from tests.up.config.samples import LINK, Link
from up.config import ConfigErrors, load_all, unknown_files
from up.config.application import APPLICATION, ApplicationConfig
from up.config.disabled_modules import DISABLED_MODULES

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
    shown = str(caught.value).splitlines()
    assert [line.removeprefix(f"{tmp_path}/").split(": ")[0] for line in shown] == [
        "link.yml:1:7",
        "link.yml:2:1",
        "config.yml:1:7",
        "disabled_modules.yml:1:1",
    ]


def test_files_that_nobody_reads_are_listed(tmp_path):
    for name in ("link.yml", "lnik.yml", "x.yaml", "notes.txt", "pids.yml.good"):
        (tmp_path / name).write_text("")
    assert [path.name for path in unknown_files(tmp_path, FILES)] == ["lnik.yml", "x.yaml"]
    assert unknown_files(tmp_path / "nowhere", FILES) == []
