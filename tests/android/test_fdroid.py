"""F-Droid's recipe builds this version, with the packages of the build."""

from __future__ import annotations

import shutil
import sys

import yaml

from tests.support.android import ANDROID, ROOT, make
from tests.support.tools import need_tool
from up.version import VERSION

sys.path.insert(0, str(ANDROID / "tools"))
import verify

RECIPE = ANDROID / "fdroid" / f"{verify.PACKAGE}.yml"


def test_the_recipe_is_that_of_this_version():
    recipe = yaml.safe_load(RECIPE.read_text(encoding="utf-8"))
    build = recipe["Builds"][-1]
    code = verify.version_code(VERSION)
    assert (build["versionName"], build["versionCode"]) == (VERSION, code)
    assert (recipe["CurrentVersion"], recipe["CurrentVersionCode"]) == (VERSION, code)
    assert build["commit"] == f"v{VERSION}"


def test_the_recipes_packages_and_command_are_those_of_the_build():
    build = yaml.safe_load(RECIPE.read_text(encoding="utf-8"))["Builds"][-1]
    app = (ANDROID / "tools" / "app.mk").read_text(encoding="utf-8")
    packages = app.partition("PACKAGES := ")[2].partition("\n")[0]
    assert f"default-jdk-headless maven {packages} " in build["sudo"][-1]
    program, target = build["build"].split()
    need_tool(program)
    made = make("-n", target, folder=ROOT / build["subdir"]).splitlines()[-1]
    assert made == "cd {} && sha256sum {}".format(*build["output"].split("/"))


def test_make_version_writes_the_recipe(tmp_path):
    need_tool("make")
    for name in ("Makefile", "up/version.py", "android/tools/verify.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, tmp_path / name)
    setup = tmp_path / "flightlog" / "setup.py"
    setup.parent.mkdir()
    setup.write_text("")
    copy = tmp_path / RECIPE.relative_to(ROOT)
    copy.parent.mkdir()
    shutil.copy2(RECIPE, copy)
    make("version", "VERSION=1.2.3", "PYTHON=" + sys.executable, folder=tmp_path)
    text = RECIPE.read_text(encoding="utf-8").replace(VERSION, "1.2.3")
    assert copy.read_text(encoding="utf-8") == text.replace(
        f"Code: {verify.version_code(VERSION)}\n", "Code: 10203\n"
    )
