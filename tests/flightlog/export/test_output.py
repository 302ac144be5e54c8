"""Files are whole or none, and nothing is overwritten that was not given up."""

import os

import pytest

from up.cli.cli_error import CliError
from up_flightlog.export.output import new_file, write_file


def test_a_new_file(tmp_path):
    write_file(tmp_path / "a.gpx", b"x")
    assert (tmp_path / "a.gpx").read_bytes() == b"x"
    assert len(list(tmp_path.iterdir())) == 1


def test_an_existing_file_is_kept(tmp_path):
    path = tmp_path / "a.gpx"
    path.write_bytes(b"old")
    with pytest.raises(CliError, match="--force"):
        write_file(path, b"new")
    assert path.read_bytes() == b"old"
    write_file(path, b"new", may_overwrite=True)
    assert path.read_bytes() == b"new"


def test_a_dangling_link_is_an_existing_file(tmp_path):
    (tmp_path / "a").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(CliError, match="--force"):
        write_file(tmp_path / "a", b"new")
    assert not (tmp_path / "elsewhere").exists()


@pytest.mark.parametrize("has_links", [True, False])
def test_a_file_that_appears_meanwhile_is_kept(tmp_path, monkeypatch, has_links):
    if not has_links:

        def link(*_):
            raise PermissionError(1, "Operation not permitted")

        monkeypatch.setattr(os, "link", link)
    path = tmp_path / "a"
    with pytest.raises(CliError, match="--force"), new_file(path) as file:
        file.write(b"new")
        path.write_bytes(b"older")
    assert path.read_bytes() == b"older" and len(list(tmp_path.iterdir())) == 1
    write_file(tmp_path / "b", b"x")
    assert (tmp_path / "b").read_bytes() == b"x"


@pytest.mark.parametrize("may_overwrite", [True, False])
def test_an_error_leaves_no_file(tmp_path, may_overwrite):
    path = tmp_path / "a"
    with pytest.raises(ZeroDivisionError), new_file(path, may_overwrite=may_overwrite) as file:
        file.write(b"half")
        1 / 0  # noqa: B018
    assert not list(tmp_path.iterdir())


def test_a_missing_folder(tmp_path):
    with pytest.raises(CliError, match="nowhere/a"):
        write_file(tmp_path / "nowhere" / "a", b"x")
