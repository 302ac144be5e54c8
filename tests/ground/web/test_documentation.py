"""The documentation at /docs/: its own policy, without the rights of the page."""

import base64
import hashlib
import shutil

import pytest

from tests.ground.web.page import Page, Serve, get
from tests.ground.web.test_site import POLICY
from tests.support.reactor import run_in_reactor
from up_ground.web.static_files import STATIC

SCRIPT = b"document.title = 1"


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """The server with a site of one page, in a copy that is served instead."""
    folder = tmp_path_factory.mktemp("documentation")
    copy = folder / "copy" / "up_ground"
    shutil.copytree(STATIC.parents[1], copy, ignore=shutil.ignore_patterns("docs", "vendor"))
    docs = copy / "web/static/docs"
    (docs / "how-to").mkdir(parents=True)
    text = b"<script>" + SCRIPT + b'</script><script src="a.js"></script><script id="a">{}</script>'
    (docs / "index.html").write_bytes(text)
    (docs / "how-to/module.html").write_bytes(text)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", str(copy.parent))
        with Serve(folder, 1) as server:
            yield server


@pytest.mark.parametrize("path", ["/docs/", "/docs/how-to/module.html", "/docs/nothing.html"])
def test_it_is_in_a_sandbox_with_its_own_scripts_only(server, path):
    status, headers, _ = get(server.port, path)
    assert status == (404 if "nothing" in path else 200)
    policy = dict(part.strip().partition(" ")[::2] for part in
                  headers["Content-Security-Policy"].split(";"))  # fmt: skip
    assert policy["sandbox"] == "allow-scripts"
    wanted = base64.b64encode(hashlib.sha256(SCRIPT).digest()).decode()
    allowed = ["'self'"] if status == 404 else ["'self'", f"'sha256-{wanted}'"]
    assert policy["script-src"].split() == allowed
    assert (policy["frame-ancestors"], policy["form-action"]) == ("'none'", "'none'")
    assert headers["Cross-Origin-Opener-Policy"] == "unsafe-none"


def test_the_page_keeps_its_policy_and_names_the_documentation(server):
    for path in ("/", "/docsx", "/js/main.js"):
        _, headers, _ = get(server.port, path)
        assert headers["Content-Security-Policy"] == POLICY
        assert headers["Access-Control-Allow-Origin"] is None

    async def welcome():
        page = Page(server.port)
        found = await page.hello(watch=None)
        await page.leave()
        return found["has_docs"]

    assert run_in_reactor(welcome) is True


def test_a_sandbox_gets_neither_link_nor_session(server):
    async def open_link():
        page = await Page(server.port, origin="null").open()
        is_open = page.is_open
        await page.leave()
        return is_open

    assert run_in_reactor(open_link) is False
    assert get(server.port, "/session", "POST", Origin="null")[0] == 403
