import subprocess
import sys

import pytest

from tests.support.virtual_environment import REPOSITORY

PLAIN = "The server closes the connection after ten seconds and logs the reason.\n"


@pytest.fixture
def tree(tmp_path):
    """Write tracked files and run the meter on them: its status and its lines."""
    subprocess.run(["git", "init", "-q", tmp_path], check=True)

    def measure(*options, **files):
        for name, text in files.items():
            (tmp_path / name.replace("_", ".")).write_text(text)
        subprocess.run(["git", "add", "-A"], cwd=tmp_path, check=True)
        done = subprocess.run(
            [sys.executable, REPOSITORY / "tools" / "plain_english.py", *options],
            cwd=tmp_path,
            capture_output=True,
            text=True,
        )
        return done.returncode, done.stdout.splitlines()

    return measure


def test_a_phrase_above_the_limit_is_listed_with_file_and_line(tree):
    status, lines = tree(
        "--max",
        "1",
        page_md=f"{PLAIN}```\nis told\n```\nThe pilot is told.\n",
        code_py=f'x = 1\n# {PLAIN}y = "is told"\nis_told = "told"\n',
        data_csv="is told\n",
    )
    assert status == 1
    assert lines[0] == "code.py:3: is told"
    assert [line for line in lines if line.startswith("page.md")] == ["page.md:5: is told"]


def test_plain_text_passes(tree):
    status, lines = tree("--max", "1", page_md=PLAIN * 3)
    assert status == 0
    assert len(lines) == 2
