"""Writes configuration files atomically."""

import contextlib
import errno
import json
import os
import re
import secrets
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from up.config.file import ConfigFile

_TEMPORARY = re.compile(r"\..+\.(?:([0-9]{1,9})-)?[0-9a-f]{8}\.tmp")
_NO_HARD_LINKS = (errno.EPERM, errno.EOPNOTSUPP, errno.ENOSYS, errno.EMLINK)


def write_template(file: ConfigFile[Any], folder: Path) -> bool:
    """Write the file's template into `folder` unless the name exists; return whether it wrote.

    Creates the folder. Raises OSError.
    """
    return create_text(Path(folder) / file.filename, file.template())


def create_text(path: Path, text: str) -> bool:
    """Write a text atomically unless the name exists; return whether it wrote.

    Creates the folder. Raises OSError.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    if os.path.lexists(path):
        return False
    return _create(path, text.encode())


def write_schemas(files: Iterable[ConfigFile[Any]], folder: Path) -> list[Path]:
    """Write `<name>.schema.json` for every file and return the paths; raises OSError."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for file in files:
        path = folder / f"{Path(file.filename).stem}.schema.json"
        text = json.dumps(file.json_schema(), indent=2, ensure_ascii=False, allow_nan=False)
        write_atomically(path, text.encode() + b"\n")
        written.append(path)
    return written


def write_atomically(path: Path, data: bytes, mode: int = 0o666) -> None:
    """Replace the file's contents so that a power cut leaves either the old or the new ones.

    ``mode`` has the permissions of the file, less the umask. Raises OSError; the old contents then
    remain and no other file is left behind.
    """
    temporary = _write_temporary(path, data, mode)
    try:
        temporary.replace(path)
    except OSError:
        _remove(temporary)
        raise
    _sync_folder(path.parent)


def remove_unfinished(folder: Path) -> None:
    """Remove temporary files of killed programs; those of running programs stay."""
    for path in Path(folder).glob(".*.tmp"):
        found = _TEMPORARY.fullmatch(path.name)
        if found is not None and not Path("/proc", found[1] or "none").exists():
            _remove(path)


def _create(path: Path, data: bytes) -> bool:
    temporary = _write_temporary(path, data)
    try:
        # Unlike rename, link refuses an existing name, even a dangling symbolic link.
        os.link(temporary, path)
    except FileExistsError:
        return False
    except OSError as error:
        if error.errno not in _NO_HARD_LINKS:
            raise
        return _create_exclusively(path, data)
    finally:
        _remove(temporary)
    _sync_folder(path.parent)
    return True


def _create_exclusively(path: Path, data: bytes) -> bool:
    """Write under the final name, for file systems without hard links."""
    try:
        with path.open("xb") as file:
            _write_and_sync(file.fileno(), data)
    except FileExistsError:
        return False
    return True


def _write_temporary(path: Path, data: bytes, mode: int = 0o666) -> Path:
    temporary = path.with_name(f".{path.name}.{os.getpid()}-{secrets.token_hex(4)}.tmp")
    try:
        with open(temporary, "xb", opener=lambda name, flags: os.open(name, flags, mode)) as file:
            _write_and_sync(file.fileno(), data)
    except OSError:
        _remove(temporary)
        raise
    return temporary


def _write_and_sync(descriptor: int, data: bytes) -> None:
    view = memoryview(data)
    while view:
        view = view[os.write(descriptor, view) :]
    os.fsync(descriptor)


def _sync_folder(folder: Path) -> None:
    # Some file systems cannot sync a folder; the file itself is safe by then.
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()
