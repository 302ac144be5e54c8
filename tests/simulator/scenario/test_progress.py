import io
import re

from up_simulator.scenario.progress import ProgressLine


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_one_line_shows_time_and_speed_and_is_cleared():
    terminal, now_s = Terminal(), [100.0]
    line = ProgressLine(terminal, True, lambda: now_s[0])
    line.begin("roll-step", 10.0)
    line.show(0.5)
    now_s[0] = 102.0
    line.show(8.0)
    line.show(8.1)
    line.end()
    shown = terminal.getvalue()
    assert "\n" not in shown
    newest = shown.split("\r\x1b[K")[-2]
    assert newest.startswith("roll-step: ")
    assert re.findall(r"[0-9.]+", newest) == ["8.0", "10", "4.0"]
    # At most one update in 0.2 s.
    assert "8.1" not in shown
    assert shown.endswith("\r\x1b[K")


def test_without_a_terminal_it_is_silent():
    file = io.StringIO()
    line = ProgressLine(file, True)
    line.begin("a", 1.0)
    line.show(0.5)
    line.end()
    assert file.getvalue() == ""
