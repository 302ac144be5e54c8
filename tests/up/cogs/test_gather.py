"""``up gather`` in a real virtual environment, with real cogs, from every source."""

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.program_output import AS_JSON, fields_of
from tests.support.tools import need_tool
from up.loading.external_modules import EXTERNAL_MODULES


def cogfile(application: Path, text: str) -> None:
    (application / "Cogfile.yml").write_text(text)


def registered(application: Path) -> dict[str, str]:
    return {cog: entry.source for cog, entry in EXTERNAL_MODULES.load(application).items()}


def gather(environment, application: Path, *arguments: str, **more) -> list[dict]:
    """Return the fields of each line that ``up gather`` prints."""
    environ = {**AS_JSON, **more.pop("environ", {})}
    done = environment.up("gather", *arguments, cwd=application, environ=environ, **more)
    assert "Traceback" not in done.stderr
    return fields_of(done.stdout + done.stderr)


def codes(found: list[dict]) -> list[tuple]:
    return [(each["code"], each.get("cog", each.get("count"))) for each in found]


BOTH = "alpha-cog: {path: ../tree/alpha_cog}\nbeta_cog: {path: ../tree/beta_cog}\n"


def test_the_life_of_a_cogfile(environment, application, tree):
    cogfile(application, BOTH)
    # The outer folder alpha_cog, here in the current folder, must not hide the package in it.
    words = ("-P", "-m", "up.cli", "-f", str(application), "gather")
    first = fields_of(environment.run(*words, cwd=tree, environ=AS_JSON).stdout)
    assert codes(first) == [
        ("installing", "alpha_cog"),
        ("installing", "beta_cog"),
        ("installed", 2),
        ("cog_registered", "alpha_cog"),
        ("created", "alpha_cog"),
        ("cog_registered", "beta_cog"),
        ("created", "beta_cog"),
        ("gathered", 2),
    ]
    assert first[0]["origin"] == f"{tree}/alpha_cog"
    assert first[4]["path"] == f"{application}/config/alpha.yml"
    assert registered(application) == {"alpha_cog": "cogfile", "beta_cog": "cogfile"}

    again = gather(environment, application)
    assert [each.get("changed") for each in again] == [False, False, None]

    # Packaging that is newer than the installation may bring other entry points.
    (tree / "alpha_cog" / "setup.py").touch()
    updated = gather(environment, application)
    assert codes(updated)[:2] == [("installing", "alpha_cog"), ("installed", 1)]

    modules = environment.up("modules", cwd=application).stdout
    assert modules.index("AlphaModule") < modules.index("BetaModule")
    environment.up("check", cwd=application)

    cogfile(application, BOTH.splitlines()[0])
    left = codes(gather(environment, application))
    assert left[:2] == [("cog_removed", "beta_cog"), ("cog_unregistered", "beta_cog")]
    assert registered(application) == {"alpha_cog": "cogfile"}
    assert (application / "config/beta.yml").exists()


def test_names_of_the_tree_never_come_from_the_index(environment, application, tree, index):
    """The index offers a newer alpha; beta needs alpha, which no Cogfile lists."""
    stranger = tree.parent / "stranger"
    (stranger / "stranger_in_alpha").mkdir(parents=True)
    (stranger / "stranger_in_alpha/__init__.py").write_text("")
    setup = (
        "from setuptools import setup\n"
        "setup(name='raspilot-alpha-cog', version='99', packages=['stranger_in_alpha'])\n"
    )
    (stranger / "setup.py").write_text(setup)
    build = "from setuptools import build_meta\nbuild_meta.build_wheel('dist')\n"
    environment.run("-c", build, cwd=stranger)
    index.add(next(stranger.glob("dist/*.whl")))

    cogfile(application, BOTH.splitlines()[1])
    environment.up("gather", cwd=application, environ=index.environ)
    place = "import alpha_cog, sys; sys.stdout.write(alpha_cog.__file__)"
    assert environment.run("-c", place, cwd=application).stdout
    found = environment.run("-c", "import stranger_in_alpha", cwd=application, status=None)
    assert found.returncode != 0
    assert [path for path in index.asked if "alpha" in path] == []


def test_from_the_index_with_a_version(environment, application, outside, index):
    for wheel in (outside / "dist").glob("*.whl"):
        index.add(wheel)
    cogfile(application, 'lidar-cog: {pypi: raspilot-lidar-cog, version: "0.1.0"}\n')
    found = gather(environment, application, environ=index.environ)
    assert "raspilot-lidar-cog 0.1.0" in found[0]["origin"]
    assert registered(application) == {"lidar_cog": "cogfile"}
    assert (application / "config/lidar.yml").exists()
    asked = len(index.asked)
    assert gather(environment, application, environ=index.environ)[0]["changed"] is False
    assert len(index.asked) == asked, "with nothing to do it asks no index"

    newer = Path(shutil.copytree(outside, application.parent / "newer"))
    setup = (newer / "setup.py").read_text()
    (newer / "setup.py").write_text(setup.replace('version="0.1.0"', 'version="0.2.0"'))
    build = "from setuptools import build_meta\nbuild_meta.build_wheel('dist')\n"
    environment.run("-c", build, cwd=newer)
    index.add(next((newer / "dist").glob("*0.2.0*.whl")))
    cogfile(application, 'lidar-cog: {pypi: raspilot-lidar-cog, version: "0.2"}\n')
    environment.up("gather", cwd=application, environ=index.environ)
    tell = "import importlib.metadata as m; print(m.version('raspilot-lidar-cog'))"
    assert environment.run("-c", tell, cwd=application).stdout == "0.2.0\n"


def test_a_version_that_is_not_there_is_pips_last_lines_and_a_sentence(
    environment, application, outside, index
):
    for sdist in (outside / "dist").glob("*.tar.gz"):
        index.add(sdist)
    cogfile(application, 'lidar-cog: {pypi: raspilot-lidar-cog, version: "7.0"}\n')
    *_, last, error = gather(environment, application, environ=index.environ, status=1)
    assert last["code"] == "pip_output" and "raspilot-lidar-cog==7.0" in last["line"]
    assert (error["code"], error["status"]) == ("pip_failed", 1)
    assert registered(application) == {}
    cogfile(application, "lidar-cog: {pypi: raspilot-lidar-cog}\n")
    environment.up("gather", cwd=application, environ=index.environ)
    assert registered(application) == {"lidar_cog": "cogfile"}, "an sdist serves as well"


def test_from_a_git_repository_with_a_revision(environment, application, outside, tmp_path):
    git = need_tool("git")
    repository = tmp_path / "repository"
    environment.up("create", "cog", "-n", "Camera", cwd=tmp_path)
    (tmp_path / "camera_cog").rename(repository)
    run = [git, "-c", "user.name=x", "-c", "user.email=x@example.org", "-C", str(repository)]
    for arguments in (["init", "-q"], ["add", "."], ["commit", "-qm", "First"], ["tag", "v1"]):
        subprocess.run([*run, *arguments], check=True)
    (repository / "camera_cog/registrar.py").write_text("raise RuntimeError('not this one')\n")
    for arguments in (["commit", "-qam", "Second"], ["tag", "v2"]):
        subprocess.run([*run, *arguments], check=True)

    url = repository.as_uri()
    cogfile(application, f"camera_cog: {{url: {url}, revision: v1}}\n")
    environment.up("gather", cwd=application)
    assert registered(application) == {"camera_cog": "cogfile"}
    assert gather(environment, application)[0]["changed"] is False

    cogfile(application, f"camera_cog: {{url: {url}}}\n")
    assert gather(environment, application)[0]["changed"] is False
    cogfile(application, f"camera_cog: {{url: {url}, revision: v2}}\n")
    codes_ = [each["code"] for each in gather(environment, application, status=1)]
    assert codes_[-2:] == ["import_failed", "registration_failed"]


def test_mistakes_are_told_before_anything_is_installed(bare, application, tree):
    cogfile(application, BOTH + "gamma_cog: {path: ../tree/gamma_cog}\n")
    (problem,) = gather(bare, application, status=2)
    assert (problem["code"], problem["line"], problem["key"]) == ("source_missing", 3, "gamma_cog")
    assert list(bare.packages.glob("*cog*")) == []


def test_without_installing(bare, application, tree):
    cogfile(application, BOTH)
    (problem,) = gather(bare, application, "--no-install", status=1)
    assert problem == {"code": "not_installed", "cogs": ["alpha_cog", "beta_cog"]}


def test_a_failing_registrant_does_not_keep_the_others_out(environment, application, tree):
    (tree / "alpha_cog/alpha_cog/registrar.py").write_text("import nothing_there\n")
    cogfile(application, BOTH)
    found = gather(environment, application, status=1)
    assert {"code": "import_failed", "name": "alpha_cog.registrar"} in found
    assert registered(application) == {"beta_cog": "cogfile"}


@pytest.mark.parametrize("managed", [True, False])
def test_an_environment_that_pip_may_not_change(bare, application, tree, managed):
    cogfile(application, BOTH)
    code = (
        "import os, sys, sysconfig, pathlib\n"
        "from up.cogs import pip\n"
        "from up.cli.main import main\n"
        f"if {managed}:\n"
        "    sys.base_prefix = sys.prefix\n"
        "    place = pathlib.Path(sys.prefix, 'stdlib'); place.mkdir()\n"
        "    (place / 'EXTERNALLY-MANAGED').write_text('')\n"
        "    real = sysconfig.get_path\n"
        "    sysconfig.get_path = lambda n: str(place) if n == 'stdlib' else real(n)\n"
        "else:\n"
        "    os.access = lambda *a: False\n"
        "sys.exit(main(['gather']))\n"
    )
    done = bare.run("-c", code, cwd=application, environ=AS_JSON, status=1)
    (problem,) = fields_of(done.stderr)
    assert problem["code"] == ("environment_managed" if managed else "environment_readonly")
    assert list(bare.packages.glob("*cog*")) == []


def test_a_framework_that_is_not_installed_is_never_fetched(bare, application, tree):
    """Only its sources are on the path: pip would look for it on the index."""
    cogfile(application, BOTH)
    code = (
        "import sys, importlib.metadata as m\n"
        "real = m.distribution\n"
        "def distribution(name):\n"
        "    if name == 'raspilot': raise m.PackageNotFoundError(name)\n"
        "    return real(name)\n"
        "m.distribution = distribution\n"
        "from up.cli.main import main\n"
        "sys.exit(main(['gather']))\n"
    )
    done = bare.run("-c", code, cwd=application, environ=AS_JSON, status=1)
    assert [each["code"] for each in fields_of(done.stderr)] == ["framework_missing"]
