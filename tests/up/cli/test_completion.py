"""The completion scripts, carried out by bash; fish and zsh where they are installed."""

import re
import shutil
import subprocess

import pytest

from tests.support.tools import need_tool
from up.cli.option_parser import OptionParser
from up.cli.parser import make_parser
from up_simulator.cli import _parser as simulator_parser

COMPLETE = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
"_${1//-/_}"
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    """Return a function that returns the file of a program's script."""
    folder = tmp_path_factory.mktemp("scripts")
    parsers = {"up": make_parser, "up-sim": simulator_parser}

    def write(program, shell, capsys):
        with pytest.raises(SystemExit) as end:
            parsers[program]().parse_args(["--print-completion", shell])
        assert end.value.code == 0
        path = folder / f"{program}.{shell}"
        path.write_text(capsys.readouterr().out)
        return path

    return write


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("up ch", {"check"}),
        ("up keys add --role ", {"observer", "operator", "pilot", "admin"}),
        ("up check --mode b", {"black\\ box"}),
        ("up -f somewhere modules --js", {"--json"}),
        ("up c m", {"module", "m"}),
        ("up log rep", {"report", "replay"}),
        ("up check --config ", {""}),
        ("up-sim prove --controller r", {"raspberry"}),
        ("up-sim pro", {"prove"}),
    ],
)
def test_bash(script, capsys, typed, offered):
    words = typed.split(" ")
    path = script(words[0], "bash", capsys)
    command = [need_tool("bash", "bash"), "-c", COMPLETE, "bash", str(path), *words]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert (set(done.stdout.splitlines()), done.stderr) == (offered, "")


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_the_other_shells_accept_their_scripts(script, capsys, shell):
    path = script("up", shell, capsys)
    text = path.read_text()
    assert re.search(r"-a check\b" if shell == "fish" else r"^complete .* up$", text, re.MULTILINE)
    if shutil.which(shell):
        subprocess.run([shell, "-n", str(path)], check=True)


def test_what_has_no_name_of_its_own_has_no_script():
    for prog in ("make run", "main.py"):
        assert "--print-completion" not in OptionParser(prog=prog)._option_string_actions
