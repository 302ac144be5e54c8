"""The same seed gives the same flight, to the last byte on every line."""

import os
import subprocess
import sys
from pathlib import Path

from tests.simulator.in_process.determinism import digests
from tests.support.firmware import need_toolchain

ROOT = Path(__file__).resolve().parents[3]


def in_another_process(seed, hash_seed):
    environ = {**os.environ, "PYTHONHASHSEED": str(hash_seed), "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "tests.simulator.in_process.determinism", str(seed)]
    done = subprocess.run(
        command, cwd=ROOT, env=environ, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return tuple(done.stdout.split())


def test_the_same_seed_gives_the_same_bytes_in_this_and_another_process(tmp_path):
    need_toolchain()
    first = digests(tmp_path / "first", seed=4)
    assert digests(tmp_path / "second", seed=4) == first
    assert in_another_process(4, hash_seed=77) == first
    other = digests(tmp_path / "other", seed=5)
    assert all(one != another for one, another in zip(first, other, strict=True))
