"""Environments, an index, and cogs from outside the tree."""

import shutil
from pathlib import Path

import pytest

from tests.support.package_index import PackageIndex
from tests.support.virtual_environment import REPOSITORY, VirtualEnvironment

TREE = REPOSITORY / "tests/fixtures/cogs/tree"


@pytest.fixture
def environment(tmp_path):
    return VirtualEnvironment(tmp_path / "environment")


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """An environment for tests in which nothing is installed."""
    return VirtualEnvironment(tmp_path_factory.mktemp("bare") / "environment")


@pytest.fixture
def index(tmp_path):
    with PackageIndex(tmp_path / "index") as index:
        yield index


@pytest.fixture
def application(tmp_path):
    """Return a folder with an UpFile."""
    folder = tmp_path / "plane"
    folder.mkdir()
    (folder / "UpFile").write_text("package: plane\n")
    return folder


@pytest.fixture
def tree(tmp_path):
    """Return a copy of two cogs that lie side by side."""
    return Path(shutil.copytree(TREE, tmp_path / "tree"))


@pytest.fixture(scope="session")
def outside(tmp_path_factory):
    """Return a cog outside the tree, generated, and its wheel and sdist in ``dist``."""
    folder = tmp_path_factory.mktemp("outside")
    environment = VirtualEnvironment(folder / "builder")
    environment.up("create", "cog", "-n", "Lidar", cwd=folder)
    cog = folder / "lidar_cog"
    build = (
        "from setuptools import build_meta\n"
        "build_meta.build_sdist('dist')\nbuild_meta.build_wheel('dist')\n"
    )
    environment.run("-c", build, cwd=cog)
    return cog
