"""A program with an invalid configuration reports all errors together."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.application import write_application
from tests.support.program_output import AS_JSON, fields_of

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
    """Return the exit status, and code, file and line of each problem that the program prints."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", RUN, str(root)],
        cwd=ROOT,
        env={"PATH": "/usr/bin:/bin", **AS_JSON, **environ},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert "Traceback" not in done.stderr
    problems = fields_of(done.stderr)
    assert len(problems) == len(done.stderr.splitlines())
    return done.returncode, sorted(
        (each["code"], Path(each.get("file", "")).name, each.get("line", 0)) for each in problems
    )


@pytest.mark.parametrize("module", [MODULE, LOADING], ids=["at the start", "while loading"])
def test_every_mistake_of_every_stage_is_said_at_once(tmp_path, module):
    files = {
        "modules/gauge.py": module,
        "modules/broken.py": "x = = 1\n",
        "config/config.yml": CONFIG if module is LOADING else "",
        "config/disabled_modules.yml": DISABLED,
        "config/gauge.yml": GAUGE,
        "external_modules.yml": COGS,
    }
    write_application(tmp_path, files)
    wanted = [
        ("unknown_key", "disabled_modules.yml", 1),
        ("out_of_range", "gauge.yml", 1),
        ("cog_import_failed", "", 0),
        ("syntax_error", "broken.py", 1),
    ]
    if module is LOADING:
        wanted += [("unknown_key", "config.yml", 1), ("unknown_choice", "config.yml", 2)]
    assert run(tmp_path) == (2, sorted(wanted))


def test_where_nothing_can_be_looked_at_the_one_sentence_stands_alone(tmp_path):
    write_application(tmp_path, {"modules/gauge.py": MODULE, "config/gauge.yml": GAUGE})
    assert run(tmp_path, UP_MODE="glider") == (2, [("mode_invalid", "", 0)])


def test_a_missing_need_is_said_with_the_mistakes(tmp_path):
    needing = (
        "from up.needs import needs\n"
        "class _Absent(BaseModule): pass\n"
        "class Needing(BaseModule):\n    absent = needs(_Absent)\n"
    )
    files = {"modules/gauge.py": MODULE + needing, "config/gauge.yml": GAUGE}
    write_application(tmp_path, files)
    wanted = [("need_missing", "", 0), ("out_of_range", "gauge.yml", 1)]
    assert run(tmp_path) == (2, wanted)
