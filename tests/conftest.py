"""What holds for every test."""

import shutil
import signal
import tempfile
from pathlib import Path

import pytest

# A shell that starts something in the background lets it ignore Ctrl-C, and every program that it
# starts as well: then none of the tests' own programs would end by it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture
def short_path():
    """A folder with a path short enough for sockets in it."""
    folder = Path(tempfile.mkdtemp(prefix="upr-"))
    yield folder
    shutil.rmtree(folder, ignore_errors=True)
