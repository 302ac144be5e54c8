"""What `make` does about the page's map and charts: npm fetches them; without it nothing breaks."""

import base64
import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import tarfile
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

from tests.support.tools import need_tool
from tests.support.waiting import HANG_S

ROOT = Path(__file__).parents[2]
PACKAGES = {
    "leaflet": {
        "package.json": '{"name": "leaflet", "version": "1.9.4"}',
        "dist/leaflet-src.esm.js": "export const map = 1;\n",
        "dist/leaflet-src.js": "what no module needs",
        "dist/leaflet.css": ".leaflet {}\n",
        "dist/images/layers.png": "png",
        "LICENSE": "two clauses",
    },
    "uplot": {
        "package.json": '{"name": "uplot", "version": "1.6.32"}',
        "dist/uPlot.esm.js": "export default 1;\n",
        "dist/uPlot.min.css": ".uplot {}\n",
        "LICENSE": "MIT",
    },
}
SERVED = {
    "leaflet/LICENSE",
    "leaflet/images/layers.png",
    "leaflet/leaflet-src.esm.js",
    "leaflet/leaflet.css",
    "uplot/LICENSE",
    "uplot/uPlot.esm.js",
    "uplot/uPlot.min.css",
}


class _Silent(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def tarball(files):
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w:gz") as tar:
        for name, text in files.items():
            entry = tarfile.TarInfo(f"package/{name}")
            entry.size = len(text)
            tar.addfile(entry, io.BytesIO(text.encode()))
    return packed.getvalue()


class Checkout:
    """The files of a checkout that the script needs, and a registry on the loopback interface."""

    def __init__(self, folder):
        self.folder = folder / "checkout"
        self.registry = folder / "registry"
        self.registry.mkdir()
        self.home = folder / "home"
        self.home.mkdir()
        (self.folder / "tools").mkdir(parents=True)
        (self.folder / "ground").mkdir()
        shutil.copy(ROOT / "tools" / "web_assets", self.folder / "tools")
        for name in ("package.json", "package-lock.json", ".npmrc"):
            shutil.copy(ROOT / "ground" / name, self.folder / "ground")
        handler = partial(_Silent, directory=str(self.registry))
        self.server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self.url = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        for name, files in PACKAGES.items():
            self.offer(name, tarball(files))

    @property
    def vendor(self):
        return self.folder / "ground" / "up_ground" / "web" / "static" / "vendor"

    @property
    def lock(self):
        return self.folder / "ground" / "package-lock.json"

    def offer(self, name, packed):
        """Serve a package and write its expected value into the lock file."""
        lock = json.loads(self.lock.read_text())
        entry = lock["packages"][f"node_modules/{name}"]
        entry["integrity"] = "sha512-" + base64.b64encode(hashlib.sha512(packed).digest()).decode()
        self.lock.write_text(json.dumps(lock))
        self.put(name, entry["version"], packed)

    def put(self, name, version, packed):
        (self.registry / f"{name}.tgz").write_bytes(packed)
        dist = {"tarball": f"{self.url}/{name}.tgz"}
        about = {"name": name, "version": version, "dist": dist}
        told = {"name": name, "dist-tags": {"latest": version}, "versions": {version: about}}
        (self.registry / name).write_text(json.dumps(told))

    def run(self, **environ):
        """Return the output of both streams; it always succeeds."""
        kept = {key: value for key, value in os.environ.items() if not key.startswith("npm_")}
        own = {"HOME": str(self.home), "npm_config_registry": self.url, "no_proxy": "127.0.0.1"}
        done = subprocess.run(
            [self.folder / "tools" / "web_assets"],
            env={**kept, **own, **environ},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=HANG_S,
            check=False,
        )
        assert done.returncode == 0, done.stdout
        return done.stdout

    def served(self):
        files = (each for each in self.vendor.rglob("*") if each.is_file())
        return {str(each.relative_to(self.vendor)) for each in files} - {".stamp"}

    def left_over(self):
        return [each.name for each in self.vendor.parent.iterdir() if each != self.vendor]


@pytest.fixture
def checkout(tmp_path):
    made = Checkout(tmp_path)
    yield made
    made.server.shutdown()
    made.server.server_close()


def test_what_the_page_needs_is_copied_and_nothing_else(checkout):
    need_tool("npm")
    assert checkout.run().count("\n") == 1
    assert checkout.served() == SERVED
    assert (checkout.vendor / "leaflet" / "leaflet.css").read_text() == ".leaflet {}\n"
    assert checkout.left_over() == []


def test_the_second_time_it_does_nothing(checkout):
    need_tool("npm")
    checkout.run()
    for each in checkout.registry.iterdir():
        each.unlink()
    before = (checkout.vendor / "uplot" / "uPlot.esm.js").stat().st_mtime_ns
    assert checkout.run() == ""
    assert (checkout.vendor / "uplot" / "uPlot.esm.js").stat().st_mtime_ns == before


def test_another_lock_file_brings_what_it_names_and_takes_the_old_away(checkout):
    need_tool("npm")
    checkout.run()
    (checkout.vendor / "leaflet" / "of-before.js").write_text("old")
    checkout.offer("leaflet", tarball({**PACKAGES["leaflet"], "LICENSE": "another"}))
    checkout.run()
    assert checkout.served() == SERVED
    assert (checkout.vendor / "leaflet" / "LICENSE").read_text() == "another"
    assert checkout.left_over() == []


def test_without_npm_it_is_one_sentence_with_what_to_install(checkout, tmp_path):
    programs = tmp_path / "bin"
    programs.mkdir()
    for name in ("cat", "cksum", "dirname"):
        (programs / name).symlink_to(need_tool(name))
    said = checkout.run(PATH=str(programs))
    assert said.count("\n") == 1 and "package npm" in said
    assert not checkout.vendor.exists()


def test_without_a_network_it_is_one_sentence_and_what_was_there_stays(checkout):
    need_tool("npm")
    checkout.run()
    checkout.server.shutdown()
    checkout.server.server_close()
    checkout.lock.write_text(checkout.lock.read_text() + "\n")
    shutil.rmtree(checkout.home / ".npm")
    said = checkout.run().splitlines()
    assert len(said) == 2 and "ECONNREFUSED" in said[1]
    assert checkout.served() == SERVED
    assert checkout.left_over() == []


def test_a_package_that_is_not_the_one_locked_is_refused(checkout):
    need_tool("npm")
    other = tarball({**PACKAGES["leaflet"], "dist/leaflet-src.esm.js": "export const evil = 1;\n"})
    checkout.put("leaflet", "1.9.4", other)
    assert "EINTEGRITY" in checkout.run()
    assert not checkout.vendor.exists()


def test_the_lock_file_pins_versions_and_contents_and_names_no_host():
    text = (ROOT / "ground" / "package-lock.json").read_text()
    locked = json.loads(text)["packages"]
    assert locked["node_modules/leaflet"]["version"] == "1.9.4"
    assert locked["node_modules/uplot"]["version"] == "1.6.32"
    assert not re.search(r"https?:", text)
    assert "resolved" not in text
    assert all("integrity" in entry for name, entry in locked.items() if name)
