"""One rule finds the application, from its inside, from above and from beside."""

import sys

import pytest

from tests.support.application import write_application
from up.config import ConfigErrors
from up.loading.application import Application, NoApplicationError


def test_it_is_found_from_every_place_that_belongs_to_it(tmp_path):
    root = write_application(tmp_path / "plane", {"modules/deep/er/x.txt": ""}, "plane").root
    for start in (root, root / "modules", root / "modules/deep/er", tmp_path):
        assert Application.find(start).root == root
    (tmp_path / "empty").mkdir()
    with pytest.raises(NoApplicationError) as error:
        Application.find(tmp_path / "empty")
    assert error.value.code == "no_application"


def test_the_nearest_one_wins(tmp_path):
    outer = write_application(tmp_path, {}, "outer")
    inner = write_application(tmp_path / "inner", {}, "inner")
    assert Application.find(inner.root) == inner
    assert Application.find(outer.root) == outer


def test_several_below_are_named(tmp_path):
    for name in ("a", "b"):
        write_application(tmp_path / name, {}, name)
    with pytest.raises(NoApplicationError) as error:
        Application.find(tmp_path)
    assert error.value.code == "several_applications"


def test_an_empty_upfile_means_the_folders_name(tmp_path):
    folder = tmp_path / "my-plane"
    folder.mkdir()
    (folder / "UpFile").write_text("")
    application = Application.at(folder)
    assert application.package == "my_plane"
    assert application.config_folder == folder / "config"
    (folder / "UpFile").write_text("config: ../elsewhere\n")
    assert Application.at(folder).config_folder == tmp_path / "elsewhere"


def test_a_mistake_in_an_upfile_has_its_place(tmp_path):
    (tmp_path / "UpFile").write_text("package: [plane]\n")
    with pytest.raises(ConfigErrors) as error:
        Application.find(tmp_path)
    assert error.value.problems[0].fields["line"] == 1
    assert error.value.code == "wrong_type"


def test_its_package_is_the_one_of_its_folder_whatever_was_imported_before(tmp_path):
    first = write_application(tmp_path / "one", {"modules/a.py": "WHERE = 1\n"}, "twice_there")
    second = write_application(tmp_path / "two", {"modules/a.py": "WHERE = 2\n"}, "twice_there")
    try:
        for application, where in ((first, 1), (second, 2), (first, 1)):
            application.make_importable()
            application.make_importable()
            from importlib import import_module

            assert where == import_module("twice_there.modules.a").WHERE
    finally:
        for name in [name for name in sys.modules if name.split(".")[0] == "twice_there"]:
            del sys.modules[name]
