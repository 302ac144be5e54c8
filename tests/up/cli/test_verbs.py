"""The command line as a whole: help, aliases, errors, exit statuses."""

import io
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.waiting import HANG_S
from up.version import VERSION


def test_without_a_verb_help_is_shown(up):
    outcome = up()
    assert outcome.status == 2
    for verb in ("create (c)", "start (s)", "gather (g)", "register (r)", "explore (e)", "check"):
        assert verb in outcome.out
    assert up("create").status == 2


def test_the_version(up):
    assert up("--version").out == f"Up {VERSION}\n"


def test_the_installed_command():
    done = subprocess.run(
        [Path(sys.executable).parent / "up", "--version"],
        capture_output=True,
        text=True,
        check=True,
        timeout=HANG_S,
    )
    assert done.stdout == f"Up {VERSION}\n"


@pytest.mark.parametrize(
    "verb", ["create", "start", "gather", "register", "explore", "check", "modules", "schemas"]
)
def test_every_verb_explains_itself(up, verb):
    outcome = up(verb, "--help")
    assert outcome.status == 0 and f"usage: up {verb}" in outcome.out


@pytest.mark.parametrize(
    "verb", ["start", "s", "gather", "g", "check", "modules", "register -n x", "r -n x"]
)
def test_outside_an_application(up, verb):
    outcome = up(*verb.split(), as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (1, "no_application")


def test_a_file_that_leads_nowhere(up):
    outcome = up("-f", "nowhere", "check", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (2, "file_missing")


def test_several_applications_are_named(up, tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "UpFile").write_text("")
    outcome = up("check", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (1, "several_applications")
    assert outcome.problem["applications"] == "a, b"
    assert up("-f", "a", "check", "--defaults").status == 0
    assert up("-f", "a/UpFile", "check", "--defaults").status == 0


def test_a_broken_upfile_has_its_place(up, tmp_path):
    (tmp_path / "UpFile").write_text("packag: plane\n")
    outcome = up("check", as_json=True)
    assert (outcome.status, outcome.problem["code"]) == (2, "unknown_key")
    assert outcome.problem["file"] == str(tmp_path / "UpFile")


@pytest.mark.parametrize(
    ("origin", "words"),
    [
        ("", ["--upgrade", "raspilot"]),
        (
            '{"url": "https://example.org/up.git",'
            ' "vcs_info": {"vcs": "git", "commit_id": "1", "requested_revision": "v2"}}',
            ["--upgrade", "raspilot @ git+https://example.org/up.git@v2"],
        ),
        (
            '{"url": "file:///home/pi/up", "dir_info": {"editable": true}}',
            ["--no-build-isolation", "--editable", "/home/pi/up"],
        ),
        (
            '{"url": "file:///home/pi/up", "dir_info": {}}',
            ["--no-build-isolation", "--upgrade", "/home/pi/up"],
        ),
    ],
)
def test_update_follows_the_installation(up, monkeypatch, origin, words):
    import shlex

    from up.cli import update

    class Installed:
        def read_text(self, name):
            assert name == "direct_url.json"
            return origin or None

    monkeypatch.setattr(update.importlib.metadata, "distribution", lambda name: Installed())
    command = up("update", "--dry-run").out.splitlines()[-1]
    assert shlex.split(command)[4:] == ["install", *words]


def test_the_prompt_of_a_closed_stdin_does_not_hang(up, tmp_path, monkeypatch):
    up("create", "new", "-n", "plane")
    monkeypatch.setattr(sys, "stdin", io.StringIO(""))
    assert up("create", "new", "-n", "plane").status == 1
