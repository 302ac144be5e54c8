import pty
import sys

import pytest

from up.cogs.pip import run_pip


@pytest.mark.timeout(60)
def test_a_terminal_shows_its_newest_line_until_it_ends(monkeypatch, capfd):
    own, other = pty.openpty()
    with open(other, "w") as terminal, open(own, "rb", buffering=0) as screen:  # noqa: PTH123
        monkeypatch.setattr(sys, "stderr", terminal)
        run_pip([sys.executable, "-c", r"print('building\x1b[2J a cog')"])
        shown = b""
        while shown.count(b"\x1b[K") < 2:
            shown += screen.read(1000)
    assert shown == b"\r\x1b[K  pip: building\\x1b[2J a cog\r\x1b[K"
    assert capfd.readouterr().out == ""
