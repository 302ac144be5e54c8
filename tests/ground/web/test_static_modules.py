"""The page's own files: nothing inline, nothing from elsewhere, every module where it is named."""

from __future__ import annotations

import re
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import pytest

from tests.support.tools import need_tool
from tests.support.waiting import HANG_S

STATIC = Path(__file__).parents[3] / "ground/up_ground/web/static"
MODULES = sorted((STATIC / "js").rglob("*.js"))
STYLES = sorted((STATIC / "css").glob("*.css"))
UNIT_TESTS = sorted((Path(__file__).parent / "static").rglob("*.test.mjs"))
_IMPORT = re.compile(
    r"""^(?:import|export)\b[^;"']*?\bfrom\s*["']([^"']+)["']"""
    r"""|^import\s*["']([^"']+)["']|\bimport\(\s*["']([^"']+)["']""",
    re.MULTILINE,
)
_PART = re.compile(r'\["[a-z-]+", "(\./[^"]+\.js)"\]')
_COMMENT = re.compile(r"/\*.*?\*/|^\s*//[^\n]*", re.DOTALL | re.MULTILINE)
_RAW_HTML = re.compile(
    r"\b(?:innerHTML|outerHTML)\s*\+?=(?!=)|\b(?:insertAdjacentHTML|document\.write|eval)\("
    r"|\bnew Function\b|\bsrcdoc\b|setAttribute\(\s*[\"'](?:style|on\w+)[\"']"
)


class _Page(HTMLParser):
    """Collects the elements that the rules of the page apply to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.files: list[str] = []
        self.places: list[str] = []
        self.faults: list[str] = []
        self._script: dict[str, str | None] | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        if tag == "style" or "style" in found:
            self.faults.append(f"inline style at {self.getpos()}")
        self.faults += [f"{name} at {self.getpos()}" for name in found if name.startswith("on")]
        self._script = found if tag == "script" else None
        if found.get("id"):
            self.ids.append(str(found["id"]))
        link = found.get("src") or (found.get("href") if tag == "link" else None)
        if link:
            self.files.append(link)
        if tag == "a" and (found.get("href") or "").startswith("#"):
            self.places.append(str(found["href"])[1:])
        for name in ("aria-labelledby", "aria-describedby", "for"):
            self.places += (found.get(name) or "").split()

    def handle_data(self, data: str) -> None:
        if self._script is not None and data.strip():
            self.faults.append(f"inline script at {self.getpos()}")


def _named(module: Path) -> list[str]:
    text = _COMMENT.sub("", module.read_text(encoding="utf-8"))
    imports = ["".join(found) for found in _IMPORT.findall(text)]
    return [*imports, *_PART.findall(text)]


@pytest.fixture(params=["index.html", "overlay.html", "log.html"])
def page(request: pytest.FixtureRequest) -> _Page:
    return _Page((STATIC / request.param).read_text(encoding="utf-8"))


def test_the_page_has_no_inline_script_or_style(page: _Page) -> None:
    assert page.faults == []


def test_an_inline_script_and_an_inline_style_would_be_found() -> None:
    bad = '<p style="color: red" onclick="x()"></p><script>x()</script><style>p {}</style>'
    assert len(_Page(bad).faults) == 4


def test_every_id_of_the_page_is_there_once_and_every_reference_leads_somewhere(
    page: _Page,
) -> None:
    assert len(set(page.ids)) == len(page.ids)
    assert set(page.places) <= set(page.ids)


def test_the_files_that_the_page_names_lie_beside_it(page: _Page) -> None:
    files = page.files
    assert files
    assert [name for name in files if not (STATIC / name).is_file()] == []


@pytest.mark.parametrize("module", MODULES, ids=lambda path: str(path.relative_to(STATIC)))
def test_every_import_of_a_module_resolves(module: Path) -> None:
    for name in _named(module):
        assert name.startswith("."), f"{name}: a browser finds modules by their path alone"
        place = (module.parent / name).resolve()
        assert place.is_relative_to(STATIC)
        if "vendor" not in place.relative_to(STATIC).parts:
            assert place.is_file(), f"{name} is not there"


def test_every_module_is_reached_from_the_first_one_of_a_page() -> None:
    reached: set[Path] = set()
    ahead = [STATIC / "js/main.js", STATIC / "js/overlay.js", STATIC / "js/log/main.js"]
    while ahead:
        module = ahead.pop().resolve()
        if module not in reached and module.is_file():
            reached.add(module)
            ahead += [module.parent / name for name in _named(module)]
    assert {module.resolve() for module in MODULES} - reached == set()


@pytest.mark.parametrize("module", MODULES, ids=lambda path: str(path.relative_to(STATIC)))
def test_no_module_writes_raw_html_or_inline_style(module: Path) -> None:
    text = _COMMENT.sub("", module.read_text(encoding="utf-8"))
    assert _RAW_HTML.findall(text) == []


@pytest.mark.parametrize("folder", ["link", "state", "instruments"])
def test_ages_never_come_from_the_wall_clock(folder: str) -> None:
    for module in sorted((STATIC / "js" / folder).glob("*.js")):
        assert not re.search(r"\bDate\b", _COMMENT.sub("", module.read_text(encoding="utf-8")))


@pytest.mark.parametrize("style", STYLES, ids=lambda path: path.name)
def test_no_style_sheet_asks_another_host(style: Path) -> None:
    text = style.read_text(encoding="utf-8")
    assert not re.search(r"@import|https?:|url\(\s*[\"']?//", text)
    assert text.count("{") == text.count("}")


def test_no_style_sheet_selects_by_what_is_inside():
    """With :has() Chromium computes the style of the whole page at each new text."""
    assert STYLES and not [sheet.name for sheet in STYLES if ":has(" in sheet.read_text()]


def test_the_modules_do_what_their_tests_say() -> None:
    node = need_tool("node", "nodejs")
    assert UNIT_TESTS
    done = subprocess.run(
        [node, "--test", *map(str, UNIT_TESTS)],
        capture_output=True,
        text=True,
        timeout=HANG_S,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-6000:] + done.stderr[-2000:]
