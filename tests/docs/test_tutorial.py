"""docs/tutorial.md: its cog is created, tested, registered, checked and flown as written."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.flying import copy_of_the_tree, files_of, lines_of
from tests.support.virtual_environment import REPOSITORY

PAGE = "tutorial.md"
TEXT = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return a function that runs a part of the page in a clone, beside which the cog is."""
    tree = copy_of_the_tree(tmp_path_factory.mktemp("tutorial") / "tree")
    cog = tree.parent / "vario_cog"
    paths = [tree, tree / "simulator", cog]
    environ = {
        **os.environ,
        "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
        "PYTHONPATH": os.pathsep.join(map(str, paths)),
        "PYTHONDONTWRITEBYTECODE": "1",
    }

    def run(kind, status=0):
        lines = lines_of(PAGE, kind)
        if kind == "gather":
            # The guide's test installs a created cog; this one is found by the path.
            assert lines[1:] == ["up gather", "up check"]
            lines = ["up register -n vario_cog", "up check"]
        if kind == "fly":
            lines = [f"{line} --board host" for line in lines]
        done = subprocess.run(
            ["bash", "-ec", "\n".join(lines)], cwd=tree, env=environ, capture_output=True, text=True
        )
        assert done.returncode == status, done.stdout + done.stderr
        return done.stdout

    run("create")
    for name, text in files_of(PAGE).items():
        (cog / name).parent.mkdir(exist_ok=True)
        (cog / name).write_text(text)
    run.tree = tree
    return run


def test_the_cog_passes_its_test_is_registered_and_flies(run):
    assert "3 passed" in run("test")
    run("gather")
    assert (run.tree / "config" / "vario.yml").is_file()
    (scenario,) = re.findall(r"<!-- scenario: vario.yml -->\n```yaml\n(.*?)```", TEXT, re.DOTALL)
    (run.tree / "vario.yml").write_text(scenario)
    run("fly")
