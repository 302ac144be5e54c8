"""The site of the documentation: each page has a place, a line of navigation, and links."""

import re

import pytest

from tests.docs.test_pages import PAGES, name_of
from tests.support.virtual_environment import REPOSITORY
from tools.docs_site import SiteError, Stage, list_of_versions, pages
from up.public import __all__ as public

MKDOCS = (REPOSITORY / "mkdocs.yml").read_text(encoding="utf-8")
_LINK = re.compile(r"\]\(([^)\s#]+)")


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    folder = tmp_path_factory.mktemp("docs")
    Stage(folder).write()
    return folder


def test_each_page_is_in_the_navigation_once():
    listed = re.findall(r"^ +- (?:[\w ]+: )?(\S+\.md)$", MKDOCS.partition("\nnav:\n")[2], re.M)
    assert sorted(listed) == sorted(pages().values())
    assert {name_of(each) for each in PAGES} <= set(pages())


def test_no_two_pages_have_one_place_where_a_file_system_ignores_the_case():
    places = [each.casefold() for each in pages().values()]
    assert len(set(places)) == len(places)


def test_links_lead_to_a_page_a_picture_or_the_page_of_a_file(stage):
    wrong = []
    for path in stage.rglob("*.md"):
        text = re.sub(r"^(`{3,}).*?^\1$", "", path.read_text(), flags=re.DOTALL | re.MULTILINE)
        links = [each for each in _LINK.findall(text) if ":" not in each]
        wrong += [(path.name, each) for each in links if not (path.parent / each).is_file()]
    assert wrong == []
    index = (stage / "index.md").read_text()
    assert "(project/contributing.md)" in index and "(files/LICENSE.md)" in index


def test_comments_for_tests_are_left_out_and_each_public_name_is_in_the_reference(stage):
    assert "<!--" not in (stage / "guide.md").read_text()
    reference = (stage / "api.md").read_text()
    assert all(f"\n::: up.public.{name}\n" in reference for name in public)


def test_a_link_to_nothing_is_refused(tmp_path):
    with pytest.raises(SiteError, match=r"guide\.md.*nothing\.md"):
        Stage(tmp_path).link("nothing.md", "docs/guide.md")


def test_the_newest_version_is_the_first_of_the_list(tmp_path):
    for name in ("0.9.0", "0.10.0", "assets"):
        (tmp_path / name).mkdir()
    for name in ("0.9.0", "0.10.0"):
        (tmp_path / name / "index.html").touch()
    listed = re.findall(r'href="(\S+)/index', list_of_versions(tmp_path))
    assert listed == ["0.10.0", "0.9.0"]
