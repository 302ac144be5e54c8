"""Writes files atomically, and never overwrites one without permission."""

from __future__ import annotations

import contextlib
import os
import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from up.cli.cli_error import CliError


@contextlib.contextmanager
def new_file(path: Path, *, may_overwrite: bool = False) -> Iterator[BinaryIO]:
    """Yield a file to write to; an error leaves no new file, and an older one unchanged.

    Raises CliError if the file exists, or for a failed write.
    """
    if not may_overwrite and os.path.lexists(path):
        raise file_exists(path)
    temporary = path.with_name(f".{path.name[:60]}.{secrets.token_hex(4)}.tmp")
    try:
        try:
            with temporary.open("xb") as file:
                yield file
            _rename(temporary, path, may_overwrite)
        finally:
            temporary.unlink(missing_ok=True)
    except FileExistsError as error:
        raise file_exists(path) from error
    except OSError as error:
        raise CliError(f"cannot write {path}: {error.strerror or error}") from error


def make_folder(folder: Path) -> None:
    """Create a missing folder in an existing one: a mistyped path creates no folders.

    Raises CliError.
    """
    if not folder.parent.is_dir():
        raise CliError(f"no folder {folder.parent}: nothing is written")
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise CliError(f"cannot create {folder}: {error.strerror or error}") from error


def write_file(path: Path, data: bytes, *, may_overwrite: bool = False) -> None:
    """Write a file in one call, as ``new_file`` does."""
    with new_file(path, may_overwrite=may_overwrite) as file:
        file.write(data)


def _rename(temporary: Path, path: Path, may_overwrite: bool) -> None:
    if not may_overwrite:
        try:
            # Unlike rename, link refuses a name that was created in the meantime.
            os.link(temporary, path)
            return
        except FileExistsError:
            raise
        except OSError:
            # A memory card's file system has no links.
            if os.path.lexists(path):
                raise FileExistsError(path) from None
    temporary.replace(path)


def file_exists(path: Path) -> CliError:
    """Return the error for a file that would be overwritten."""
    return CliError(f"{path} exists: overwrite it with --force")
