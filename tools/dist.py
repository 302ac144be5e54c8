"""Builds the sdist and the wheel of every distribution: ``python tools/dist.py [--output DIR]``.

Each is built from a copy of the files that git tracks, with the built parts of a release; the same
sources give the same bytes, with the times of SOURCE_DATE_EPOCH or of the last commit.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import io
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MAIN = "."
"""The distribution of the top-level setup.py; the others are named by their folder."""
MAIN_FILES = (
    *("setup.py", "pyproject.toml", "README.md", "CHANGELOG.md", "main.py", "config", "arduino"),
    *("up", "raspilot", "runner", "proxy", "cluster", "ground", "simulator", "mavlink"),
)
BUILT = (
    "ground/up_ground/web/static/docs",
    "ground/up_ground/web/static/vendor",
    "arduino/build/release/raspilot.elf",
    "arduino/build/raspilot.hex",
)
CONSTRAINTS, SUMS = "constraints.txt", "SHA256SUMS"
_BUILD = "import setuptools.build_meta as backend, sys; backend.build_wheel(sys.argv[1])"


def folders() -> list[str]:
    """Return the folders of all distributions."""
    setups = _git("ls-files", "setup.py", "flightlog/setup.py", "cogs/*/setup.py").split()
    return [str(Path(each).parent) for each in setups]


def build(folder: str, output: Path, epoch_s: int) -> list[Path]:
    """Build one distribution; return its wheel and its sdist. Ends the program if it fails."""
    with tempfile.TemporaryDirectory(prefix="up-dist-") as scratch:
        stage = Path(scratch, "stage")
        _copy(folder, stage, epoch_s)
        files = sorted(each for each in stage.rglob("*") if each.is_file())
        done = subprocess.run(
            [sys.executable, "-c", _BUILD, scratch],
            cwd=stage,
            env={**os.environ, "SOURCE_DATE_EPOCH": str(epoch_s)},
            umask=0o022,
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode:
            sys.exit(f"make dist: {folder}: {(done.stderr or done.stdout).strip()}")
        (wheel,) = Path(scratch).glob("*.whl")
        sdist = output / f"{'-'.join(wheel.name.split('-')[:2])}.tar.gz"
        sdist.write_bytes(_tar(stage, files, _metadata(wheel), sdist.name[:-7], epoch_s))
        return [Path(shutil.copy(wheel, output)), sdist]


def _copy(folder: str, stage: Path, epoch_s: int) -> None:
    """Copy the files of a distribution with equal modes and times."""
    wanted = MAIN_FILES if folder == MAIN else (folder,)
    names = _git("ls-files", "-z", "--", *wanted).split("\0")[:-1]
    if folder == MAIN:
        built = [ROOT / each for each in BUILT]
        found = (file for each in built for file in (each, *each.rglob("*")) if file.is_file())
        names += sorted(str(each.relative_to(ROOT)) for each in found)
    pairs = [(ROOT / each, stage / Path(each).relative_to(folder)) for each in names]
    for source, target in [*pairs, (ROOT / "LICENSE", stage / "LICENSE")]:
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        target.chmod(0o755 if os.access(source, os.X_OK) else 0o644)
        os.utime(target, (epoch_s, epoch_s))


def _metadata(wheel: Path) -> bytes:
    """Return the core metadata, which is the PKG-INFO of the sdist, too."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (each for each in archive.namelist() if each.endswith(".dist-info/METADATA"))
        return archive.read(name)


def _tar(stage: Path, files: Sequence[Path], metadata: bytes, root: str, epoch_s: int) -> bytes:
    packed = io.BytesIO()
    with (
        gzip.GzipFile(fileobj=packed, mode="wb", filename="", mtime=epoch_s) as compressed,
        tarfile.open(fileobj=compressed, mode="w", format=tarfile.PAX_FORMAT) as archive,
    ):
        contents = {str(each.relative_to(stage)): each.read_bytes() for each in files}
        for name, content in sorted({**contents, "PKG-INFO": metadata}.items()):
            entry = tarfile.TarInfo(f"{root}/{name}")
            path = stage / name
            entry.mode = path.stat().st_mode & 0o777 if path.is_file() else 0o644
            entry.size, entry.mtime = len(content), epoch_s
            archive.addfile(entry, io.BytesIO(content))
    return packed.getvalue()


def _git(*arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"make dist: a release is built in a git clone: {done.stderr.strip()}")
    return done.stdout


def main(arguments: Sequence[str] | None = None) -> None:
    """Build everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=ROOT / "dist", metavar="DIR")
    parser.add_argument("folders", nargs="*", metavar="FOLDER", help="only these distributions")
    options = parser.parse_args(arguments)
    output = options.output
    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    epoch_s = int(os.environ.get("SOURCE_DATE_EPOCH") or _git("log", "-1", "--format=%ct"))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        wanted = options.folders or folders()
        builds = [pool.submit(build, each, output, epoch_s) for each in wanted]
        made = sorted(file for each in builds for file in each.result())
    made.append(Path(shutil.copy(ROOT / CONSTRAINTS, output)))
    sums = [f"{hashlib.sha256(each.read_bytes()).hexdigest()}  {each.name}\n" for each in made]
    (output / SUMS).write_text("".join(sums))
    sys.stdout.write(f"{len(made)} files in {output}\n")


if __name__ == "__main__":
    main()
