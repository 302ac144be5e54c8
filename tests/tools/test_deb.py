"""The Debian packages without building them: what each contains and removes; the manual pages."""

import argparse
import re
import subprocess
from pathlib import Path

import pytest

from tools.deb_services import SERVICES, unit_of
from tools.man_page import man_page
from up.cli.parser import make_parser

ROOT = Path(__file__).parents[2]
UNITS = {each.stem: unit_of(each.read_text("utf-8")) for each in ROOT.glob("*/*.service")}


def test_every_unit_has_a_package_with_its_own_paths():
    assert {each.name for each in SERVICES} == set(UNITS)
    for unit in UNITS.values():
        assert "/opt/" not in unit and "\nExecStart=/usr/lib/raspilot/bin/" in unit


def test_every_template_is_in_one_package_where_its_unit_reads_it():
    config = ROOT / "config"
    packed = [path for each in SERVICES for path in each.config_files(config).values()]
    templates = {*config.glob("*.yml"), *config.glob("blackbox/*.yml")}
    # The gains: the daemon writes them, and a file of a package would not be its own.
    assert sorted(path for path in packed if path.suffix == ".yml") == sorted(
        templates - {config / "pids.yml"}
    )
    for each in SERVICES:
        reads = f"--config {each.folder}" if each.files else f"=-{each.folder}.env"
        assert reads in UNITS[each.name]
        assert all(name.startswith(each.folder) for name in each.config_files(config))


@pytest.mark.parametrize("service", SERVICES, ids=lambda each: each.name)
def test_the_scripts_are_shell_and_remove_the_units_folders_but_no_flights(service):
    scripts = service.scripts(UNITS[service.name])
    for text in scripts.values():
        subprocess.run(["sh", "-n"], input=text, text=True, check=True)
        assert f"{service.name}.service" in text
        assert not re.search(r"\b[A-Z]{4,}\b", text)
    removed = scripts["postrm"].partition("rm -rf ")[2].splitlines()[0].split()
    assert f"/etc/{service.name}" in removed and "/var/lib/raspilot" not in removed
    if service.name == "up-proxy":
        assert {"/var/log/up-proxy", "/var/log/private/up-proxy"} < set(removed)


def test_a_manual_page_has_every_verb_and_option():
    page = man_page(make_parser(), "up", 1, "framework", 0)
    assert page.startswith('.TH "UP" 1 "1970-01-01" ')
    verbs = {".SS up log report", ".SS up create flight\\-mode", ".B \\-\\-dry\\-run"}
    assert verbs <= set(page.splitlines())
    # An alias is the same verb.
    assert page.count(".SS up create") == 6 and ".SS up c " not in page


def test_text_of_a_manual_page_is_never_a_request():
    parser = argparse.ArgumentParser(prog="a", epilog=".so /etc/passwd\n'br\n\\fB")
    page = man_page(parser, "a", 1, "b", 0)
    assert not [line for line in page.splitlines() if line.startswith((".so", "'"))]
