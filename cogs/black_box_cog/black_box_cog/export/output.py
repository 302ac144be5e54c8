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
        raise _taken(path)
    temporary = path.with_name(f".{path.name[:60]}.{secrets.token_hex(4)}.tmp")
    try:
        try:
            with temporary.open("xb") as file:
                yield file
            _name(temporary, path, may_overwrite)
        finally:
            temporary.unlink(missing_ok=True)
    except FileExistsError as error:
        raise _taken(path) from error
    except OSError as error:
        raise CliError(f"{path} cannot be written: {error.strerror or error}") from error


def make_folder(folder: Path) -> None:
    """Create a missing folder in an existing one: a mistyped path creates no folders.

    Raises CliError.
    """
    if not folder.parent.is_dir():
        raise CliError(f"there is no folder {folder.parent}: nothing is written")
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise CliError(f"{folder} cannot be made: {error.strerror or error}") from error


def write_file(path: Path, data: bytes, *, may_overwrite: bool = False) -> None:
    """Write a file in one call, as ``new_file`` does."""
    with new_file(path, may_overwrite=may_overwrite) as file:
        file.write(data)


def _name(temporary: Path, path: Path, may_overwrite: bool) -> None:
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


def _taken(path: Path) -> CliError:
    return CliError(f"{path} is there already: say --force to overwrite it")
