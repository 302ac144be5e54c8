"""Links of pages have targets, and pages name only existing things."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs import configuration_page
from tests.support.virtual_environment import REPOSITORY
from up.config import ConfigErrors

PAGES = sorted(
    [
        *REPOSITORY.glob("*.md"),
        *(REPOSITORY / "docs").rglob("*.md"),
        *(REPOSITORY / "cogs").glob("*/README.md"),
    ]
)
FILES = {file.filename: file for file in configuration_page.configuration_files()}
MAX_PICTURE_BYTES = 200_000
_FENCE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
_LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
_TEST = re.compile(r"`(tests/[\w/]+\.py)::(\w+)`")
_SPOT = re.compile(
    r"`((?:up|raspilot|cogs|proxy|runner|ground|simulator)/[\w/]+\.py)`(?: \|)? `([\w.]+)`"
)
_PATH = re.compile(
    r"`((?:up|raspilot|cogs|proxy|runner|ground|simulator|tests|docs|config|tools)/[\w./-]*)`"
)


def name_of(page):
    return str(page.relative_to(REPOSITORY))


def text_of(page):
    return page.read_text(encoding="utf-8")


def anchors(page):
    """The anchors that GitHub gives to a page's headings."""
    found = set()
    for heading in re.findall(r"^#+ (.+)$", _FENCE.sub("", text_of(page)), re.MULTILINE):
        plain = re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        found.add("".join(c for c in plain if c.isalnum() or c in " -_").replace(" ", "-"))
    return found


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_lead_somewhere(page):
    wrong = []
    for link in _LINK.findall(_FENCE.sub("", text_of(page))):
        if link.startswith(("http://", "https://")):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists() or (anchor and anchor not in anchors(target)):
            wrong.append(link)
    assert not wrong


def test_pictures_are_small():
    pictures = list((REPOSITORY / "docs" / "pictures").iterdir())
    too_large = [each.name for each in pictures if each.stat().st_size > MAX_PICTURE_BYTES]
    assert not too_large and len(pictures) > 5


def test_every_picture_is_on_a_page():
    shown = {
        (page.parent / link).resolve() for page in PAGES for link in _LINK.findall(text_of(page))
    }
    assert set((REPOSITORY / "docs" / "pictures").iterdir()) <= shown


def test_every_page_is_in_the_index():
    index = text_of(REPOSITORY / "docs" / "README.md")
    linked = {(REPOSITORY / "docs" / link).resolve() for link in _LINK.findall(index)}
    left_out = {page for page in PAGES if page.parent != REPOSITORY} - linked
    assert {name_of(page) for page in left_out} == {"docs/README.md"}


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_tests_that_it_names_exist(page):
    for path, function in _TEST.findall(text_of(page)):
        file = REPOSITORY / path
        assert file.is_file(), path
        assert f"def {function}(" in text_of(file), f"{path}::{function}"


def definitions(path):
    """Return the functions, classes and methods of a source file, methods with their class."""
    found = set()
    for node in ast.parse(text_of(path)).body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            found.add(node.name)
        if isinstance(node, ast.ClassDef):
            found |= {
                f"{node.name}.{inner.name}"
                for inner in node.body
                if isinstance(inner, ast.FunctionDef | ast.AsyncFunctionDef)
            }
    return found


def test_the_browser_tests_that_are_named_exist():
    rows = text_of(REPOSITORY / "docs" / "failure-modes.md").splitlines()
    named = 0
    for row in rows:
        for path, titles in re.findall(r"`(tests/browser/[\w.]+)`: ((?:\*[^*]+\*(?:, )?)+)", row):
            for title in re.findall(r"\*([^*]+)\*", titles):
                assert f'test("{title}"' in text_of(REPOSITORY / path), title
                named += 1
    assert named > 10


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_functions_that_it_names_stand_in_the_files_that_it_names(page):
    for path, function in _SPOT.findall(text_of(page)):
        assert function in definitions(REPOSITORY / path), f"{path} {function}"


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_paths_that_it_names_exist(page):
    made_by_readers = {
        "raspilot/modules/bank_module.py",
        "raspilot/commands/remark_command.py",
        "raspilot/flight_modes/eight.py",
        "config/lidar.yml",
        "config/vario.yml",
    }
    made_when_used = {"config/config.yml", "config/disabled_modules.yml", "config/providers.yml"}
    for path in _PATH.findall(text_of(page)):
        if path not in made_by_readers | made_when_used and "proxy/up-" not in path:
            assert (REPOSITORY / path).exists(), path


def test_the_configuration_page_lists_the_codes_of_every_error():
    assert configuration_page.documented_error_codes() == configuration_page.error_codes()


def test_the_configuration_page_lists_what_the_files_declare():
    _head, _, rest = text_of(configuration_page.PAGE).partition(configuration_page.BEGIN)
    shown = rest.partition(configuration_page.END)[0].strip()
    assert shown == configuration_page.tables().strip(), (
        "run: python -m tests.docs.configuration_page"
    )


def named_keys(text):
    """Yield (file, key) for ``file.yml: key``, ``key`` of ``file.yml`` and the cogs' tables."""
    yield from re.findall(r"`([a-z_]+\.yml): ([a-z_][^`:]*)`", text)
    for key, file in re.findall(
        r"`([a-z_][^`:]*)(?:: [^`]*)?` (?:of|in|in its) `([a-z_]+\.yml)`", text
    ):
        yield file, key
    for file, table in re.findall(r"^`config/([a-z_]+\.yml)`\n\n((?:\|.*\n)+)", text, re.MULTILINE):
        for row in table.splitlines()[2:]:
            for key in re.findall(r"`([^`]+)`", row.split("|")[1]):
                yield file, key


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_keys_that_it_names_exist(page):
    for file, key in named_keys(text_of(page)):
        if file in FILES:
            known = set(configuration_page.keys_of(FILES[file].schema))
            assert key in known, f"{file}: {key}"


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_its_configuration_files_are_read(page):
    blocks = re.findall(r"```yaml\n# \S*?([a-z_]+\.yml)\n(.*?)```", text_of(page), re.DOTALL)
    for name, text in blocks:
        try:
            FILES[name].parse(text, Path(name))
        except ConfigErrors as errors:
            pytest.fail(f"{name}: {errors}")


def test_keys_are_found_where_pages_name_them():
    text = text_of(REPOSITORY / "cogs" / "android_cog" / "README.md")
    assert ("android.yml", "low battery (percent)") in set(named_keys(text))
    assert ("a.yml", "x") in set(named_keys("`a.yml: x`")) & set(named_keys("`x` of `a.yml`"))


def test_the_generator_changes_nothing_in_an_up_to_date_configuration_page(tmp_path):
    before = text_of(configuration_page.PAGE)
    done = subprocess.run(
        [sys.executable, "-c", _GENERATE, str(tmp_path / "page.md")],
        cwd=REPOSITORY,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "page.md").read_text(encoding="utf-8") == before


_GENERATE = """
import sys, pathlib, shutil
from tests.docs import configuration_page
shutil.copy(configuration_page.PAGE, sys.argv[1])
configuration_page.PAGE = pathlib.Path(sys.argv[1])
configuration_page.main()
"""
