import pytest

from up_ground.web.static_files import MAX_FILE_BYTES, StaticFiles


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "secret.txt").write_text("secret")
    static = tmp_path / "static"
    (static / "js").mkdir(parents=True)
    (static / "index.html").write_text("<html>")
    (static / "overlay.html").write_text("<html>")
    (static / "js" / "main.js").write_text("one")
    (static / ".hidden.js").write_text("hidden")
    (static / "program.py").write_text("no file of a page")
    (static / "out.txt").symlink_to(tmp_path / "secret.txt")
    (static / "up").symlink_to(tmp_path)
    (static / "inner.js").symlink_to(static / "js" / "main.js")
    return static


@pytest.mark.parametrize("path", [b"/", b"/overlay", b"/index.html", b"/js/main.js", b"/inner.js"])
def test_what_is_there(folder, path):
    assert StaticFiles(folder).get(path) is not None


@pytest.mark.parametrize(
    "path",
    [
        b"",
        b"*",
        b"index.html",
        b"/js",
        b"/js/",
        b"/out.txt",
        b"/up/secret.txt",
        b"/../secret.txt",
        b"/%2e%2e/secret.txt",
        b"/js/..%2f..%2fsecret.txt",
        b"/.hidden.js",
        b"/program.py",
        b"/js/main.js/",
        b"/js/main.js%00.txt",
        b"/\xff.js",
        b"/" + b"a/" * 50 + b"x.js",
        b"/" + b"a" * 5000 + b".js",
        b"http://127.0.0.1/index.html",
    ],
)
def test_what_is_not(folder, path):
    assert StaticFiles(folder).get(path) is None


def test_a_changed_file_has_another_tag(folder):
    files = StaticFiles(folder)
    before = files.get(b"/js/main.js")
    assert files.get(b"/js/main.js") == before
    (folder / "js" / "main.js").write_text("another")
    after = files.get(b"/js/main.js")
    assert after.content == b"another"
    assert after.etag != before.etag


def test_a_file_that_is_no_page_is_not_read(folder):
    with (folder / "huge.js").open("wb") as file:
        file.truncate(MAX_FILE_BYTES + 1)
    assert StaticFiles(folder).get(b"/huge.js") is None


def test_no_folder_at_all(tmp_path):
    assert StaticFiles(tmp_path / "absent").get(b"/") is None
