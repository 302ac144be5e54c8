"""The pages on wiring and airframe agree with the firmware, the board and themselves."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from itertools import pairwise

import pytest

from tests.docs.flying import files_of, lines_of
from tests.support.firmware import ARDUINO, CORE, need_toolchain
from tests.support.virtual_environment import REPOSITORY
from up.flight_controller.profile_wire import AIRFRAME

PAGE = (REPOSITORY / "docs" / "wiring.md").read_text(encoding="utf-8")
PINS = REPOSITORY / "arduino" / "raspilot" / "src" / "chip" / "pins.h"


def rows_after(mark):
    """The cells of the table that follows `mark`, without its two head lines."""
    table = re.search(r"((?:^\|.*\n)+)", PAGE[PAGE.index(mark) :], re.MULTILINE)[1]
    cells = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in table.splitlines()]
    return cells[2:]


def numbers_of(text):
    return [float(number) for number in re.findall(r"\d+(?:\.\d+)?", text)]


def pins_of(source):
    """What pins.h gives each function, by the name that the page has for it."""
    found = {}
    for what, pin in re.findall(r"constexpr uint8_t PIN_(\w+) = (\d+);", source):
        kind, _, name = what.partition("_")
        label = {"RX": "RX ", "SERVO": "servo ", "BATTERY": "battery"}.get(kind, f"{kind} ")
        label += name.lower()
        found[label.strip()] = f"D{pin}" if int(pin) < 14 else f"A{int(pin) - 14}"
    return found


def test_the_pins_are_those_of_the_firmware():
    source = PINS.read_text(encoding="utf-8")
    branches = re.search(r"#ifdef RASPILOT_PROTOTYPE_BOARD(.*?)#else(.*?)#endif(.*)", source, re.S)
    prototype, default, both = (pins_of(branch) for branch in branches.groups())
    rows = rows_after("<!-- table: pins -->")
    assert {what: pin for what, pin, _ in rows} == default | both
    assert {what: pin for what, _, pin in rows} == prototype | both


@pytest.mark.parametrize("column", [1, 2])
def test_no_pin_is_used_twice(column):
    pins = [row[column] for row in rows_after("<!-- table: pins -->")]
    assert len(set(pins)) == len(pins) == 12
    assert not {"D0", "D1", "A4", "A5"} & set(pins)


def test_the_picture_shows_the_default_pins():
    picture = ElementTree.parse(REPOSITORY / "docs" / "pictures" / "wiring.svg")
    texts = [(float(each.get("y")), each.text) for each in picture.iter(f"{SVG}text")]
    for what, pin, _ in rows_after("<!-- table: pins -->"):
        name = {"LED": "LED on the board", "battery": "flight battery"}.get(what, what)
        (height,) = [y for y, text in texts if text == name]
        assert pin in [text for y, text in texts if y == height], what


def test_the_dividers_figures_follow_from_the_resistors():
    for battery, *cells in rows_after("<!-- table: divider -->"):
        full_v, r1, r2, pin_v, scale_v, step_mv = (numbers_of(cell)[0] for cell in cells)
        ratio = r2 / (r1 + r2)
        assert full_v == pytest.approx(4.2 * numbers_of(battery)[0])
        assert pin_v == pytest.approx(full_v * ratio, abs=0.005)
        assert pin_v <= 0.96
        assert scale_v == pytest.approx(1.1 / ratio, abs=0.005)
        assert step_mv == pytest.approx(1100 / ratio / 1024, abs=0.05)


def test_what_it_draws_adds_up():
    *parts, total = rows_after("### What it draws")
    for column in (1, 2):
        milliamperes = sum(numbers_of(row[column])[0] for row in parts)
        assert numbers_of(total[column])[0] == pytest.approx(milliamperes / 1000, abs=0.005)


def test_how_long_it_lasts_follows_from_the_battery():
    *parts, _total = rows_after("### What it draws")
    usable_wh = 1.3 * 7.4 * 0.8
    drawn_w = 5 * sum(numbers_of(row[1])[0] for row in parts) / 1000
    rows = rows_after("### How long it lasts")
    assert numbers_of(rows[0][1])[0] == pytest.approx(drawn_w, abs=0.01)
    assert numbers_of(rows[1][1])[0] == pytest.approx(drawn_w - 2.5, abs=0.01)
    for _set_up, at_5_v, from_battery, lasts in rows:
        battery_w = numbers_of(at_5_v)[0] / 0.85
        assert numbers_of(from_battery)[0] == pytest.approx(battery_w, abs=0.06)
        hours_and_minutes = numbers_of(lasts)
        minutes = hours_and_minutes[-1] + 60 * sum(hours_and_minutes[:-1])
        assert minutes == pytest.approx(60 * usable_wh / battery_w, abs=1.0)


def test_the_weights_add_up():
    rows = {row[0].strip("*"): row for row in rows_after("## Weight")}
    total = numbers_of(rows.pop("together")[1])[0]
    _lighter = rows.pop("without Raspberry Pi and phone (BEC A only, half the casing)")
    assert total == sum(numbers_of(row[1])[0] for row in rows.values())
    assert all("estimate" in row[2] for row in rows.values() if "thesis" not in row[2])


def test_every_number_of_the_thesis_board_is_there_once():
    rows = rows_after("## The thesis's board")
    numbers = [int(number) for row in rows for number in numbers_of(row[0])]
    assert numbers == list(range(1, 26))


SVG = "{http://www.w3.org/2000/svg}"
PICTURES = sorted((REPOSITORY / "docs" / "pictures").glob("*.svg"))
# Of the font size: the mean advance of DejaVu Sans, which is wide, and of its bold.
ADVANCE = {"normal": 0.56, "bold": 0.64}


@pytest.mark.parametrize("path", PICTURES, ids=lambda path: path.name)
def test_pictures_keep_their_words_inside(path):
    root = ElementTree.parse(path).getroot()
    assert root.tag == f"{SVG}svg"
    assert root.findtext(f"{SVG}title")
    left, top, width, height = map(float, root.get("viewBox").split())
    for text in root.iter(f"{SVG}text"):
        first, last = ends_of(text)
        assert left <= first and last <= left + width, text.text
        size = float(text.get("font-size"))
        assert top + size <= float(text.get("y")) <= top + height - size / 4, text.text


@pytest.mark.parametrize("path", PICTURES, ids=lambda path: path.name)
def test_words_of_one_line_of_a_picture_do_not_overlap(path):
    lines = {}
    for text in ElementTree.parse(path).iter(f"{SVG}text"):
        lines.setdefault(text.get("y"), []).append((*ends_of(text), text.text))
    for words in lines.values():
        for (_, end, text), (begin, _, next_text) in pairwise(sorted(words)):
            assert end <= begin, f"{text!r} runs into {next_text!r}"


def ends_of(text):
    """Where a text begins and ends, by the mean width of its letters."""
    width = (
        len(text.text) * float(text.get("font-size")) * ADVANCE[text.get("font-weight", "normal")]
    )
    x = float(text.get("x"))
    before = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.get("text-anchor", "start")]
    return x - before * width, x + (1 - before) * width


def test_every_picture_is_on_a_page():
    pages = [page.read_text(encoding="utf-8") for page in REPOSITORY.glob("docs/**/*.md")]
    pages.append((REPOSITORY / "README.md").read_text(encoding="utf-8"))
    for path in PICTURES:
        assert any(f"pictures/{path.name})" in page for page in pages), path.name


def test_the_fuses_are_those_that_make_sets():
    page = (REPOSITORY / "docs" / "airframe.md").read_text(encoding="utf-8")
    makefile = (REPOSITORY / "arduino" / "Makefile").read_text(encoding="utf-8")
    columns = list(
        zip(*re.findall(r"^\| \w+ \| (0x..) \| (0x..) \|", page, re.MULTILINE), strict=True)
    )
    order = r"lfuse:w:(0x..):m -U hfuse:w:(0x..):m -U efuse:w:(0x..):m"
    assert re.findall(order, makefile) == columns
    assert re.findall(order, page) == columns[:1]


def test_the_bootloader_that_the_page_builds_fits_and_the_shipped_one_does_not(tmp_path):
    need_toolchain()
    for line in lines_of("airframe.md", "optiboot"):
        here = line.replace(".venv/bin/python", sys.executable)
        done = subprocess.run(["bash", "-c", here], cwd=REPOSITORY, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    sizes = [boot_bytes(ARDUINO / "build" / "optiboot.hex", tmp_path)]
    sizes.append(boot_bytes(CORE.parents[1] / SHIPPED_OPTIBOOT, tmp_path))
    page = (REPOSITORY / "docs" / "airframe.md").read_text(encoding="utf-8")
    assert sizes[0] <= 512 < sizes[1]
    assert f", {sizes[0]} bytes:" in page and f"to {sizes[1]} bytes" in page


SHIPPED_OPTIBOOT = "bootloaders/optiboot/optiboot_atmega328.hex"


def boot_bytes(path, folder):
    """The bytes of a bootloader's code, without the version at the end of the flash."""
    binary = folder / "boot.bin"
    section = [*("-j", ".sec1"), *("-I", "ihex"), *("-O", "binary")]
    subprocess.run(["avr-objcopy", *section, path, binary], check=True)
    return binary.stat().st_size


def test_the_airframe_of_the_page_is_one_that_is_understood():
    text = files_of("airframe.md")["airframe.yml"]
    airframe = AIRFRAME.parse(text, REPOSITORY / "docs" / "airframe.md")
    assert airframe.rudder.trim_us == -20
    assert airframe.mix == "V-tail"
