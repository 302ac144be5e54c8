"""A program with an invalid configuration reports all errors together."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.application import write_application

ROOT = Path(__file__).parents[2]
RUN = (
    "import sys, pathlib; from up.program import run_application;"
    "sys.exit(run_application(pathlib.Path(sys.argv[1])))"
)
MODULE = (
    "from dataclasses import dataclass\n"
    "from up.base_module import BaseModule\n"
    "from up.config import ConfigFile, key\n"
    "@dataclass(frozen=True, slots=True)\n"
    "class GaugeConfig:\n"
    '    """The gauge."""\n'
    '    interval_s: float = key(1.0, "Time.", minimum=0, maximum=9)\n'
    "class GaugeModule(BaseModule):\n"
    '    CONFIG = ConfigFile("gauge.yml", GaugeConfig)\n'
)
LOADING = MODULE + "    def load(self): return self.config.interval_s > 0\n"
CONFIG = "log levl: info\nmode: sideways\n"
GAUGE = "interval_s: 10\n"
DISABLED = "disabled module: []\n"
COGS = "lost_cog:\n  modules:\n    - {class_name: A, prefix: lost_cog.modules.a}\n"


def run(root, **environ):
    """Return the exit status and the lines that the program prints."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", RUN, str(root)],
        cwd=ROOT,
        env={"PATH": "/usr/bin:/bin", **environ},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert "Traceback" not in done.stderr
    return done.returncode, done.stderr.splitlines()


@pytest.mark.parametrize(
    ("module", "config", "disabled"),
    [(MODULE, "", ""), (LOADING, CONFIG, ""), (LOADING, CONFIG, DISABLED)],
)
def test_every_mistake_of_every_stage_is_said_at_once(tmp_path, module, config, disabled):
    files = {
        "modules/gauge.py": module,
        "modules/broken.py": "x = = 1\n",
        "config/config.yml": config,
        "config/disabled_modules.yml": disabled,
        "config/gauge.yml": GAUGE,
        "external_modules.yml": COGS,
    }
    write_application(tmp_path, files)
    status, lines = run(tmp_path)
    wanted = [
        "gauge.yml:1:13: interval_s: must be a number between 0 and 9",
        "the registered cog lost_cog cannot be imported",
        "modules/broken.py:1: syntax",
    ]
    if config:
        wanted += ["config.yml:1:1: unknown key", "config.yml:2:7: mode: must be one of"]
    if disabled:
        wanted += ["disabled_modules.yml:1:1: unknown key"]
    assert status == 2
    assert len(lines) == len(wanted), lines
    for words in wanted:
        assert sum(words in line for line in lines) == 1, (words, lines)


def test_where_nothing_can_be_looked_at_the_one_sentence_stands_alone(tmp_path):
    write_application(tmp_path, {"modules/gauge.py": MODULE, "config/gauge.yml": GAUGE})
    status, lines = run(tmp_path, UP_MODE="glider")
    assert (status, len(lines)) == (2, 1)
    assert "UP_MODE='glider'" in lines[0]


def test_a_missing_need_is_said_with_the_mistakes(tmp_path):
    needing = (
        "from up.needs import needs\n"
        "class _Absent(BaseModule): pass\n"
        "class Needing(BaseModule):\n    absent = needs(_Absent)\n"
    )
    files = {"modules/gauge.py": MODULE + needing, "config/gauge.yml": GAUGE}
    write_application(tmp_path, files)
    status, lines = run(tmp_path)
    assert status == 2
    assert len(lines) == 2
    assert any("Needing needs _Absent" in line for line in lines)
