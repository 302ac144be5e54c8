"""up bundle: what it refuses; tests/dist/bundle_trial.py writes and installs a real one."""

import hashlib
import zipfile

import pytest

from up.bundle.verb import platform_tags
from up.cli.main import main


@pytest.fixture
def dist(tmp_path):
    """What make dist wrote, without the documentation."""
    folder = tmp_path / "dist"
    folder.mkdir()
    with zipfile.ZipFile(folder / "raspilot-1.0-py3-none-any.whl", "w") as wheel:
        wheel.writestr("up/__init__.py", "")
    (folder / "constraints.txt").write_text("")
    files = sorted(folder.iterdir())
    lines = [f"{hashlib.sha256(each.read_bytes()).hexdigest()}  {each.name}\n" for each in files]
    (folder / "SHA256SUMS").write_text("".join(lines))
    return folder


@pytest.fixture
def bundle(dist, tmp_path, capsys, monkeypatch):
    """Return a function that runs the verb; it returns status and error."""
    monkeypatch.setenv("UP_LOG_FORMAT", "json")

    def run(*more):
        status = main(["bundle", str(tmp_path / "stick"), "--dist", str(dist), *more])
        return status, capsys.readouterr().err

    return run


def test_wheels_of_every_older_glibc_are_accepted():
    tags = platform_tags("linux_aarch64")
    assert tags[0] == "manylinux_2_36_aarch64" and tags[-1] == "linux_aarch64"
    assert {"manylinux_2_17_aarch64", "manylinux2014_aarch64"} <= set(tags)


def test_wheels_that_were_changed_are_refused(bundle, dist, tmp_path):
    (dist / "constraints.txt").write_text("evil==1.0\n")
    status, error = bundle()
    assert status == 2 and '"file_damaged"' in error
    assert not (tmp_path / "stick").exists()


def test_a_folder_without_the_main_distribution_is_refused(bundle, dist):
    (dist / "SHA256SUMS").write_text("")
    (dist / "raspilot-1.0-py3-none-any.whl").unlink()
    status, error = bundle()
    assert status == 2 and '"dist_incomplete"' in error


def test_a_bundle_is_never_overwritten(bundle, tmp_path):
    (tmp_path / "stick" / "raspilot-1.0").mkdir(parents=True)
    status, error = bundle()
    assert status == 2 and '"bundle_exists"' in error


def test_an_unknown_platform_is_refused(bundle):
    with pytest.raises(SystemExit) as end:
        bundle("--platform", "linux_armv7l")
    assert end.value.code == 2
