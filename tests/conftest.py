"""What holds for every test."""

import gc
import inspect
import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.support.showcase import Showcase

# No example fails because the machine was busy: neither by its time nor by that of drawing it.
settings.register_profile("tests", deadline=None, suppress_health_check=[HealthCheck.too_slow])
# Where nothing may be skipped, every run tries the same examples, and no more than these.
settings.register_profile("ci", settings.get_profile("tests"), derandomize=True, max_examples=50)
# For a search by hand: pytest --hypothesis-profile=search FILE.
settings.register_profile("search", settings.get_profile("tests"), max_examples=2000)
settings.load_profile("ci" if os.environ.get("UP_REQUIRE_TOOLS") == "1" else "tests")

# A worker takes a whole file. What runs in real time comes first and is not nice; then those that
# take minutes: none is left for the end.
REAL_TIME_FILES = ("test_browser.py", "test_guide.py", "test_shipped_real.py")
LONG_FILES = (
    *REAL_TIME_FILES, "test_app.py", "test_build.py", "test_ending.py", "test_shipped.py",
    "test_shipped_with_daemon.py", "test_flight_mode.py", "test_flight_mode_files.py",
)  # fmt: skip
NICE = 5

# A shell starts a background program with Ctrl-C ignored, and its children inherit that: then
# Ctrl-C would end none of the tests' own programs.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


# The tests make little garbage in cycles, and ten thousand of them are much to look through.
gc.set_threshold(50_000, 20, 100)


def pytest_collection_finish(session):
    gc.freeze()


def pytest_collection_modifyitems(items):
    order = [REAL_TIME_FILES, LONG_FILES]
    items.sort(key=lambda item: [item.path.name not in files for files in order])


def pytest_runtest_setup(item):
    # Not the other way round: Chromium sets the priority of its pages to 0.
    if item.path.name not in REAL_TIME_FILES:
        os.setpriority(os.PRIO_PROCESS, 0, max(NICE, os.getpriority(os.PRIO_PROCESS, 0)))


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    """Run a test that is a coroutine on the real reactor."""
    if not inspect.iscoroutinefunction(pyfuncitem.obj):
        return None
    # Not at import: some tests install a reactor of their own.
    from tests.support.reactor import run_in_reactor

    names = inspect.signature(pyfuncitem.obj).parameters
    given = {name: pyfuncitem.funcargs[name] for name in names}
    run_in_reactor(lambda: pyfuncitem.obj(**given), timeout_s=90)
    return True


@pytest.fixture(scope="session", autouse=True)
def hangup():
    """Let programs of tests end when their terminal closes, even if ``nohup`` started the tests.

    A function is not kept as handler after exec: children get the default, the tests continue. Not
    at import: xdist's controller keeps ignoring the signal.
    """
    before = signal.getsignal(signal.SIGHUP)
    if before is signal.SIG_IGN:
        signal.signal(signal.SIGHUP, lambda *_: None)
    yield
    signal.signal(signal.SIGHUP, before)


@pytest.fixture(scope="session", autouse=True)
def thread_pool():
    """Stop the reactor's threads: a crashed reactor keeps them, and they keep the process."""
    yield
    pool = getattr(sys.modules.get("twisted.internet.reactor"), "threadpool", None)
    if pool is not None:
        pool.stop()


@pytest.fixture(scope="session", autouse=True)
def state_home():
    """Let the programs that tests start keep their flights in a folder that goes with the tests."""
    before = {name: os.environ.pop(name, None) for name in ("XDG_STATE_HOME", "STATE_DIRECTORY")}
    with tempfile.TemporaryDirectory(prefix="up-state-", ignore_cleanup_errors=True) as folder:
        os.environ["XDG_STATE_HOME"] = folder
        yield Path(folder)
    for name, text in before.items():
        os.environ.pop(name, None)
        if text is not None:
            os.environ[name] = text


@pytest.fixture
def short_path():
    """A folder with a path short enough for sockets in it."""
    folder = Path(tempfile.mkdtemp(prefix="upr-"))
    yield folder
    shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture(autouse=True)
def no_showcase_is_left():
    """End every `make run` that a test has left in the air; a fixture's of the module flies on."""
    before = len(Showcase.started)
    yield
    Showcase.end_all(before)
