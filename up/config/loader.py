"""Reads a configuration file as text, whatever its path refers to."""

import os
import stat
from pathlib import Path

from up.config.nodes import Report, place_of

MAX_BYTES = 1024 * 1024


def read_text(path: Path, report: Report) -> str | None:
    """Return the file's text; None if it is missing or a problem was reported.

    Reads only regular files of at most 1 MiB of UTF-8; a pipe or device cannot block it.
    """
    try:
        data = _read_bytes(path, report)
    except FileNotFoundError:
        if path.is_symlink():
            report(1, 1, "is a link to a missing file", "not_a_file")
        return None
    except OSError as error:
        report(1, 1, f"cannot be read: {error.strerror or error}", "cannot_read")
        return None
    return None if data is None else decode(data, report)


def decode(data: bytes, report: Report) -> str | None:
    """Return bytes as text, or None if a problem was reported."""
    if len(data) > MAX_BYTES:
        report(1, 1, "is larger than 1 MiB", "file_too_large")
        return None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        # The error counts from after a byte order mark; its object begins there too.
        before = error.object[: error.start].decode()
        line, column = place_of(before, len(before))
        what = f"is not UTF-8 text: byte 0x{error.object[error.start]:02X}"
        report(line, column, what, "not_utf8")
        return None
    return text


def _read_bytes(path: Path, report: Report) -> bytes | None:
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    try:
        mode = os.fstat(descriptor).st_mode
        if not stat.S_ISREG(mode):
            what = "is a folder, not a file" if stat.S_ISDIR(mode) else "is not a regular file"
            report(1, 1, what, "not_a_file")
            return None
        with open(descriptor, "rb", closefd=False) as file:
            return file.read(MAX_BYTES + 1)
    finally:
        os.close(descriptor)
