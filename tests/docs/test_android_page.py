"""docs/android.md agrees with the app: words, settings, rates; its tests and its bench exist."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest

from tests.android.phone_program import PhoneProgram
from tests.docs.flying import lines_of
from tests.docs.test_pages import PAGES, name_of, text_of
from tests.ground.aircraft import UP_GROUND
from tests.support.android import ANDROID, make
from tests.support.tools import need_tool
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import DEADLINE_S, until
from up_simulator.harness.ports import choose_port_sets

TEXT = (REPOSITORY / "docs" / "android.md").read_text(encoding="utf-8")
RES = ANDROID / "raspilot" / "res"
KEY = "{http://schemas.android.com/apk/res/android}"


def strings(folder="values"):
    """Every text resource by its name, unescaped; the items of arrays as name.0 and so on."""
    found = {}
    for file in sorted((RES / folder).glob("*.xml")):
        for each in ElementTree.parse(file).getroot():
            texts = [each] if each.tag == "string" else each.iter("item")
            if each.tag in ("string", "string-array"):
                for number, text in enumerate(texts):
                    name = (
                        each.get("name") if each.tag == "string" else f"{each.get('name')}.{number}"
                    )
                    found[name] = re.sub(r"\\(.)", r"\1", text.text or "")
    return found


STRINGS = strings()


def string(reference):
    """Return the text that @string/name stands for; other texts are themselves."""
    return STRINGS[reference.removeprefix("@string/")] if reference.startswith("@") else reference


def preferences():
    """Each section and setting of the settings screen, in its order: (title, default)."""
    for category in ElementTree.parse(RES / "xml" / "preferences.xml").getroot():
        yield string(category.get(f"{KEY}title")), ""
        for each in category.iterfind(f"*[@{KEY}key]"):
            default = string(each.get(f"{KEY}defaultValue"))
            if each.tag == "CheckBoxPreference":
                default = {"true": "on", "false": "off"}[default]
            elif each.tag == "ListPreference":
                values, names = each.get(f"{KEY}entryValues"), each.get(f"{KEY}entries")
                chosen = [string(value) for value in items(values)].index(default)
                default = string(items(names)[chosen])
            yield string(each.get(f"{KEY}title")), default or "empty"


def items(array):
    name = array.removeprefix("@array/")
    return [text for key, text in STRINGS.items() if key.rsplit(".", 1)[0] == name and "." in key]


def test_what_is_bold_is_written_so_on_the_screen():
    forms = json.loads((RES.parent / "assets" / "commands.json").read_text(encoding="utf-8"))
    known = [re.escape(each["title"].partition("{")[0].rstrip(' "')) for each in forms["commands"]]
    for text in STRINGS.values():
        pattern = re.escape(text.replace("\N{RIGHT SINGLE QUOTATION MARK}", "'"))
        known.append(re.sub(r"%\d\\\$[+.\d]*[sdf]", ".+", pattern))
    wrong = []
    # A table's head and the words that are contrasted with the screen's are not bold.
    for shown in re.findall(r"\*\*([^*]+)\*\*", TEXT):
        plain = shown.rstrip(":")
        if plain not in NOT_ON_THE_SCREEN and not any(re.fullmatch(k, plain) for k in known):
            wrong.append(shown)
    assert not wrong


NOT_ON_THE_SCREEN = {
    "Raspilot", "bold", "No phone has run it yet", "Permissions.", "Battery optimisation", "Firm",
    "Free sky", "Away from iron and current", "Any way round.", "Newest wins.", "Panic Mode",
    "Flight Controller Mode.", "Black Box Mode.", "The line at the top", "Alarms",
    "Link and control", "Instruments", "The core is one jar", "API levels.", "Signed", "Verified",
}  # fmt: skip


def test_every_setting_is_in_the_table_with_its_default_in_the_screens_order():
    table = TEXT.partition("<!-- table: settings -->")[2]
    rows = re.findall(r"^\| \*\*(.+?)\*\* \| (.*?) ?\| ", table, re.MULTILINE)
    assert rows == list(preferences())


def test_every_lack_is_explained():
    lacks = [text for name, text in STRINGS.items() if name.startswith("state_")]
    assert lacks
    for name in ("lack_location_permission", "lack_location", "lack_barometer", "lack_rotation"):
        assert f"**{STRINGS[name]}**" in TEXT, name
    for state in ("absent", "stopped", "waiting", "sending", "silent"):
        assert f"| **{STRINGS[f'state_{state}']}** |" in TEXT, state


def test_every_command_is_listed():
    catalogue = json.loads((ANDROID / "raspilot/assets/commands.json").read_text())
    names = {each["name"] for each in catalogue["commands"]}
    table = TEXT.partition("## The commands screen")[2].partition("\n## ")[0]
    assert set(re.findall(r"`((?:up|android|arduino|black_box)\.[\w.]+)`", table)) == names


def source(name):
    (found,) = ANDROID.glob(f"*/src/**/{name}.java")
    return found.read_text(encoding="utf-8")


def test_rates_and_silence_are_those_of_the_providers():
    table = TEXT.partition("## What is sent")[2].partition("\n* ")[0]
    rows = {
        row[0]: row for row in re.findall(r"^\| (\w+) \| (.*?) \| (.*?) \| (.*?) \|", table, re.M)
    }
    settings = source("AirborneSettings")
    for name in ("location", "altitude", "heading"):
        (period_ms,) = re.findall(rf"int {name}PeriodMs = (\d+);", settings)
        assert f"each {period_ms} ms" in rows[name][2]
    (rate_hz,) = re.findall(r"int orientationHz = (\d+);", settings)
    assert f"{rate_hz} a second" in rows["orientation"][2]
    for name, row in rows.items():
        if name != "what":
            (limit_ms,) = re.findall(r"SILENCE_MS = (\d+)", source(f"{name.title()}Provider"))
            assert row[3].startswith(f"{int(limit_ms) / 1000:g} s"), name


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_java_tests_that_it_names_exist(page):
    for name, method in re.findall(r"`(\w+Test)\.(\w+)`", text_of(page)):
        files = list(ANDROID.glob(f"*/test/**/{name}.java"))
        assert files, name
        assert any(f"void {method}(" in file.read_text() for file in files), f"{name}.{method}"


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_paths_of_the_phone_that_it_names_exist(page):
    for path in re.findall(r"`(android/[\w./-]+)`", text_of(page)):
        assert path.startswith("android/build/") or (REPOSITORY / path).exists(), path


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_the_targets_of_the_phone_that_it_names_exist(page):
    need_tool("make")
    said = make("help")
    for target in re.findall(r"make -C android ([a-z-]+)", text_of(page)):
        assert target == "help" or f"make -C android {target} " in said, target


def test_packages_size_and_levels_are_the_builds():
    makefile, app = ((ANDROID / name).read_text() for name in ("Makefile", "tools/app.mk"))
    (packages,) = re.findall(r"^PACKAGES := (.*)$", app, re.MULTILINE)
    assert f"default-jdk-headless maven {packages}\n" in TEXT
    (limit,) = re.findall(r"^LIMIT \?= (\d+)$", makefile, re.MULTILINE)
    assert f"at most {int(limit):,} bytes" in TEXT
    (target,) = re.findall(r"^TARGET := (\d+)$", makefile, re.MULTILINE)
    assert f"(`targetSdkVersion` {target})" in TEXT


def test_the_cards_rows_are_numbered_and_each_has_a_box():
    table = TEXT.partition("<!-- table: card -->")[2]
    rows = re.findall(r"^\| (\d+) \| .+ \| .+ \| ☐ \|$", table, re.MULTILINE)
    assert [int(row) for row in rows] == list(range(1, len(rows) + 1)) and len(rows) > 15
    for number in re.findall(r"test card ([\d, ]+)", TEXT):
        assert all(int(each) <= len(rows) for each in number.split(",")), number


@pytest.fixture
def bench(tmp_path):
    """The card's bench on its own ports: where the phone finds it, the ground's port."""
    make_folder, write_config, start = lines_of("android.md", "bench")
    ports = choose_port_sets(1)[0]
    for line in (make_folder, write_config.replace("port: 50002", "port: 0")):
        subprocess.run(["bash", "-c", line], cwd=tmp_path, check=True)
    # The page's own ports may be in use here.
    files = {
        "android": f"general port: {ports.general}\norientation port: {ports.orientation}\n",
        "discovery": f"port: {ports.discovery}\n",
        "black_box": f"folder: {tmp_path / 'flights'}\n",
        "arduino": f"port: {tmp_path / 'none'}\n",
    }
    for name, text in files.items():
        (tmp_path / "run" / "card" / f"{name}.yml").write_text(text)
    words = shlex.split(start)
    assert words[:2] == [".venv/bin/python", "main.py"]
    words = [sys.executable, "main.py", *words[2:-1], str(tmp_path / words[-1])]
    log = tmp_path / "log"
    with log.open("wb") as output:
        process = subprocess.Popen(words, cwd=REPOSITORY, stdout=output, stderr=subprocess.STDOUT)
    try:
        found = until(
            lambda: re.search(r"ground listens on port (\d+)", log.read_text()),
            "the ground's port in the log",
        )
        yield f"127.0.0.1:{ports.general}:{ports.orientation}", found[1]
    finally:
        process.terminate()
        process.wait(DEADLINE_S)


def up_ground(words, port):
    """Run a line of the card with the port of this bench; return status and output."""
    words = [port if word == "50002" else word for word in words[1:]]
    done = subprocess.run([UP_GROUND, *words], capture_output=True, text=True, timeout=DEADLINE_S)
    return done.returncode, done.stdout + done.stderr


def test_the_phone_connects_at_the_bench_and_arming_is_refused(bench):
    place, port = bench
    (line,) = re.findall(r"`(\.venv/bin/up-ground [^`]* send [^`]*)`", TEXT)
    words = shlex.split(line)
    with PhoneProgram("--raspberry", place) as phone:
        phone.connected()
        status, said = up_ground(words, port)
        assert status == 0 and "ack" in said, said
    arm = [*words[: words.index("send") + 1], "up.arm"]
    status, said = up_ground(arm, port)
    assert status == 1 and "refused" in said, said
