import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import up

PAGE = Path(__file__).parents[2] / "docs" / "api.md"
ROWS = re.findall(r"^\| (`.*?`) \| `(.*?)` \|", PAGE.read_text(), re.MULTILINE)
NAMES = {name: path for names, path in ROWS for name in re.findall(r"`(\w+)`", names)}


def test_the_page_lists_every_public_name():
    assert sorted(NAMES) == sorted(up.__all__)


@pytest.mark.parametrize("name", up.__all__)
def test_a_public_name_is_the_object_at_its_path(name):
    path = NAMES[name]
    try:
        wanted = getattr(import_module(path), name)
    except ModuleNotFoundError:
        module, _, attribute = path.rpartition(".")
        wanted = getattr(import_module(module), attribute)
    assert getattr(up, name) is wanted and not isinstance(wanted, type(up))


def test_the_package_itself_imports_nothing():
    code = "import sys, up; raise SystemExit(any(each.startswith('up.') for each in sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], check=False, timeout=60).returncode == 0
