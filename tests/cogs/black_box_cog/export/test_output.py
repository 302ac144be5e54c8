"""Files are whole or none, and nothing is overwritten that was not given up."""

import os

import pytest
from black_box_cog.export.output import new_file, write_file

from up.cli.cli_error import CliError


def test_a_new_file(tmp_path):
    write_file(tmp_path / "a.gpx", b"x")
    assert (tmp_path / "a.gpx").read_bytes() == b"x"
    assert len(list(tmp_path.iterdir())) == 1


def test_what_is_there_stays(tmp_path):
    path = tmp_path / "a.gpx"
    path.write_bytes(b"old")
    with pytest.raises(CliError, match=r"a\.gpx is there already: say --force to overwrite it"):
        write_file(path, b"new")
    assert path.read_bytes() == b"old"
    write_file(path, b"new", may_overwrite=True)
    assert path.read_bytes() == b"new"


def test_a_link_that_leads_nowhere_is_a_file_too(tmp_path):
    (tmp_path / "a").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(CliError, match="there already"):
        write_file(tmp_path / "a", b"new")
    assert not (tmp_path / "elsewhere").exists()


@pytest.mark.parametrize("has_links", [True, False])
def test_what_appears_meanwhile_stays(tmp_path, monkeypatch, has_links):
    if not has_links:

        def link(*_):
            raise PermissionError(1, "Operation not permitted")

        monkeypatch.setattr(os, "link", link)
    path = tmp_path / "a"
    with pytest.raises(CliError, match="there already"), new_file(path) as file:
        file.write(b"new")
        path.write_bytes(b"older")
    assert path.read_bytes() == b"older" and len(list(tmp_path.iterdir())) == 1
    write_file(tmp_path / "b", b"x")
    assert (tmp_path / "b").read_bytes() == b"x"


@pytest.mark.parametrize("may_overwrite", [True, False])
def test_half_a_file_is_none(tmp_path, may_overwrite):
    path = tmp_path / "a"
    with pytest.raises(ZeroDivisionError), new_file(path, may_overwrite=may_overwrite) as file:
        file.write(b"half")
        1 / 0  # noqa: B018
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(CliError, match=r"nowhere/a cannot be written: No such file or directory"):
        write_file(tmp_path / "nowhere" / "a", b"x")
