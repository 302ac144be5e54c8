"""Every attack of a hostile relay achieves nothing, and something once its rule is removed."""

from pathlib import Path

import pytest

from tests.cogs.mission_control_cog.attack_rules import ATTACKS, attempt

PAGE = Path(__file__).parents[3] / "docs" / "security.md"
MUTATED = "mutated bodies"


def table():
    """Return the rows of the page's table by attack: tries, accepted, rule, accepted without it."""
    _, _, text = PAGE.read_text(encoding="utf-8").partition("| attack | tries |")
    rows = text.partition("\n\n")[0].splitlines()[2:]
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    return {name: values for name, *values in cells}


@pytest.mark.parametrize("attack", ATTACKS, ids=lambda each: each.name)
def test_an_attack_succeeds_only_without_its_rule(tmp_path, attack):
    achieved, tries = attempt(attack, tmp_path / "kept")
    without, _ = attempt(attack, tmp_path / "removed", is_rule_kept=False)
    assert (achieved, without > 0) == (0, True)
    assert table()[attack.name] == [str(tries), "0", attack.rule, str(without)]


def test_the_page_has_each_attack_once():
    names = [name for name in table() if not name.startswith(MUTATED)]
    assert names == [attack.name for attack in ATTACKS]
