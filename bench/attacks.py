"""Every attack of a hostile relay, on sockets: what it achieves, and what without its rule.

The attacks are those of tests/cogs/mission_control_cog.
"""

import tempfile
from collections.abc import Iterable
from pathlib import Path

from bench.table import Row
from tests.cogs.mission_control_cog.attack_rules import ATTACKS, attempt
from tests.support.reactor import reactor


def rows(quick: bool = False) -> Iterable[Row]:
    for attack in ATTACKS:
        with tempfile.TemporaryDirectory() as folder:
            accepted, tries = attempt(attack, Path(folder, "kept"))
            without, _ = attempt(attack, Path(folder, "removed"), is_rule_kept=False)
        yield Row(
            f"attack: {attack.name}, accepted of {tries}",
            str(accepted),
            f"without: {attack.rule}",
            str(without),
            target="0",
            met=accepted == 0 < without,
        )
    if reactor.threadpool is not None:
        reactor.threadpool.stop()  # its threads would keep this process
