"""What 'up create' writes passes the project's own checks, and its own tests."""

import os
import pty
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.program_output import AS_JSON, fields_of
from tests.support.virtual_environment import REPOSITORY
from up.cli.cli_error import CliError
from up.cli.names import Name

LONGEST = "Abcdefghijklmnopqrstuvwx"
STYLE = (("ruff", "check", "."), ("ruff", "format", "--check", "."))


@pytest.fixture(scope="module")
def mypy_cache(tmp_path_factory):
    """One for all, so that mypy reads the framework and its dependencies once."""
    return tmp_path_factory.mktemp("mypy")


@pytest.fixture
def passes(own_process, mypy_cache):
    def passes(folder: Path, checks=(*STYLE, ("mypy", "--strict", "."), ("pytest", "-q"))) -> None:
        for check in checks:
            done = own_process(
                *check, cwd=folder, paths=str(folder), MYPY_CACHE_DIR=str(mypy_cache)
            )
            assert done.returncode == 0, f"{check}: {done.stdout}{done.stderr}"

    return passes


def test_an_application_with_parts_passes_every_check(own_process, passes, tmp_path):
    name = LONGEST
    snake = Name.of(name).snake
    root = tmp_path / snake
    create = ("up.cli", "create")
    for cwd, arguments in (
        (tmp_path, ("new", "-n", name)),
        (root, ("module", "-n", name)),
        (root, ("m", "-n", "Camera", "-t", "thread")),
        (root, ("flight-mode", "-n", name)),
        (root, ("h", "-n", name, "-i", "some.plane.that_opens.its_bomb_bay.at_last")),
    ):
        done = own_process(*create, *arguments, cwd=cwd)
        assert done.returncode == 0, done.stderr
    passes(root)
    tests = sorted(path.name for path in (root / "tests").glob("test_*.py"))
    assert len(tests) == 6, "each part has its test"
    done = own_process("up.cli", "check", cwd=root)
    assert done.returncode == 0, done.stderr
    modules = own_process("up.cli", "modules", cwd=root).stdout
    assert snake.upper()[:16] in modules
    assert "HeartbeatModule" in modules and "CameraModule" in modules
    assert "some.plane.that_opens.its_bomb_bay.at_last" in modules


@pytest.mark.parametrize("name", ["lidar", LONGEST])
def test_a_cog_passes_every_check(own_process, passes, tmp_path, name):
    snake = Name.of(name).snake
    done = own_process("up.cli", "create", "cog", "-n", name, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    root = tmp_path / f"{snake}_cog"
    done = own_process("up.cli", "create", "module", "-n", "Second", cwd=root)
    assert "up explore -w" in done.stdout
    if name == LONGEST:
        passes(root)
    else:
        # The length of a name changes only where lines break.
        passes(root, STYLE)
    for wanted in ("setup.py", "README.md", "registrar.py", "registered_modules.yml", "config.py"):
        assert list(root.rglob(wanted)), wanted


def test_the_generated_rules_are_the_projects_own(up, tmp_path):
    up("create", "new", "-n", "plane")
    up("create", "cog", "-n", "lidar")
    own = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["tool"]
    for folder in ("plane", "lidar_cog"):
        written = tomllib.loads((tmp_path / folder / "pyproject.toml").read_text())["tool"]
        assert written["ruff"]["lint"]["select"] == own["ruff"]["lint"]["select"]
        assert written["ruff"]["line-length"] == own["ruff"]["line-length"]
        assert written["mypy"]["strict"] is own["mypy"]["strict"] is True


def test_the_configuration_is_made_of_the_templates(up, tmp_path):
    from up.config.application import APPLICATION

    up("create", "new", "-n", "plane")
    assert (tmp_path / "plane/config/config.yml").read_text() == APPLICATION.template()
    assert (tmp_path / "plane/config/disabled_modules.yml").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ("create", "new", "-n", "../evil"),
        ("create", "new", "-n", "up"),
        ("create", "new", "-n", "json"),
        ("create", "new", "-n", ""),
        ("create", "cog", "-n", "3d"),
        ("create", "module", "-n", "class"),
        ("create", "module", "-n", "x" * 100),
        ("create", "module", "-n", "Here"),
        ("create", "handler", "-n", "X", "-i", "no dots"),
        ("-f", "x.py", "create", "handler", "-n", "X", "-i", "up.altitude.change"),
    ],
)
def test_what_cannot_be_created_is_one_sentence(up, tmp_path, arguments):
    outcome = up(*arguments, as_json=True)
    code = outcome.problem["code"]
    assert (outcome.status, code) in ((2, "name_invalid"), (2, "name_taken"), (1, "no_application"))
    assert list(tmp_path.iterdir()) == []


@given(given=st.text(max_size=40))
def test_any_name_is_an_identifier_or_refused(given):
    try:
        name = Name.of(given)
    except CliError:
        return
    assert name.snake.isidentifier() and name.camel.isidentifier()
    assert len(name.snake) <= 24 and name.snake == name.snake.lower()


@pytest.mark.parametrize(
    ("given", "snake", "camel"),
    [
        ("HelloWorld", "hello_world", "HelloWorld"),
        ("hello_world", "hello_world", "HelloWorld"),
        ("hello-world", "hello_world", "HelloWorld"),
        ("GPSReceiver", "gps_receiver", "GpsReceiver"),
        ("Lidar2", "lidar2", "Lidar2"),
        ("HelloModule", "hello", "Hello"),
    ],
)
def test_names_as_the_prototype_made_them(given, snake, camel):
    name = Name.of(given, ending="module")
    assert (name.snake, name.camel) == (snake, camel)


def test_nothing_is_overwritten_where_nobody_can_be_asked(up, own_process, tmp_path):
    up("create", "new", "-n", "plane")
    main = tmp_path / "plane/main.py"
    main.write_text("mine\n")
    command = ("up.cli", "create", "new", "-n", "plane")
    done = own_process(*command, cwd=tmp_path, **AS_JSON)
    assert done.returncode == 1
    assert fields_of(done.stderr) == [{"code": "exists", "path": str(tmp_path / "plane")}]
    assert main.read_text() == "mine\n"
    config = tmp_path / "plane/config/config.yml"
    config.write_text("log level: debug\n")
    assert up("create", "new", "-n", "plane", "--yes").status == 0
    assert main.read_text() != "mine\n"
    assert config.read_text() == "log level: debug\n", "configuration is never overwritten"
    up("create", "cog", "-n", "lidar")
    assert up("create", "cog", "-n", "lidar").status == 1


@pytest.mark.parametrize(
    ("answer", "status", "overwritten"),
    [("y", 0, True), ("n", 0, False), ("c", 0, False), ("what\nyes", 0, True), ("\x04", 0, False)],
)
def test_a_person_at_a_terminal_is_asked(up, tmp_path, answer, status, overwritten):
    up("create", "new", "-n", "plane")
    module = tmp_path / "plane/modules/heartbeat_module.py"
    module.write_text("mine\n")
    own, theirs = pty.openpty()
    try:
        process = subprocess.Popen(
            [sys.executable, "-m", "up.cli", "create", "m", "-n", "Heartbeat"],
            cwd=tmp_path / "plane",
            env={**os.environ, "PYTHONPATH": str(REPOSITORY)},
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
        )
        os.write(own, f"{answer}\n".encode() if answer != "\x04" else b"\x04")
        process.wait(120)
        assert b"Traceback" not in os.read(own, 65536)
    finally:
        os.close(own)
        os.close(theirs)
    assert process.returncode == status
    assert (module.read_text() != "mine\n") is overwritten


def test_a_module_goes_where_file_says(up, tmp_path):
    assert up("-f", "other/gauge.py", "create", "module", "-n", "Gauge").status == 0
    assert "class GaugeModule" in (tmp_path / "other/gauge.py").read_text()
