import subprocess
import sys

PROGRAM = """
import sys
from up.system.postponed_import import postpone
postpone("http.cookiejar")
import twisted.internet.reactor
assert "http.client" not in sys.modules
import inspect; inspect.getmodule(postpone); inspect.stack()
import http.cookiejar
from twisted.python.compat import cookielib
assert "http.client" not in sys.modules
postponed = sys.modules["http.cookiejar"]
USE
assert sys.modules["http.cookiejar"] is not postponed
assert http.cookiejar is sys.modules["http.cookiejar"]
from http.cookiejar import CookieJar
assert CookieJar is http.cookiejar.CookieJar is cookielib.CookieJar
"""
USES = (
    "http.cookiejar.CookieJar()",
    "cookielib.CookieJar()",
    "from http.cookiejar import CookieJar",
    "import twisted.web.client; import urllib.request; urllib.request.HTTPCookieProcessor()",
)


def test_the_first_use_imports_the_module():
    for use in USES:
        subprocess.run([sys.executable, "-c", PROGRAM.replace("USE", use)], check=True, timeout=60)
