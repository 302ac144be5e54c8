"""Checks that imports between the packages point in one direction, and what Up may name.

The contracts are generated: what a cog may import apart from Up is what its ``setup.py`` lists, and
the directions between the programs are the table below.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# The permitted imports of each package; only a cog that lists another cog may import it.
ARROWS: dict[str, set[str]] = {
    "up": set(),
    "raspilot": {"up"},
    "up_cluster": {"up"},
    "up_runner": {"up", "up_cluster"},
    "up_flightlog": {"up"},
    "up_mavlink": {"up"},
    "up_ground": {"up", "up_flightlog", "up_mavlink"},
    "up_proxy": {"up", "up_cluster"},
    # It runs daemon, ground station and the compiled firmware in its own process.
    # Raspilot and its cogs are loaded like any application, never imported.
    "up_simulator": {"up", "up_ground", "up_flightlog", "up_mavlink", "up_rig"},
    "up_rig": set(),
}
# The parts of Up for a program on another machine: the proxy uses no modules and no bus.
PROXY_MAY_USE = {
    "cli", "config", "errors", "fields", "log", "output", "protocols", "quick_dataclass", "system",
    "tls", "version",
}  # fmt: skip

# The layers of Up, from the highest to the lowest: a part imports only from the lines below it.
LAYERS = (
    "telemetry_frame",
    "doctor",
    "bundle",
    "cli | (flight_log) | testing | public",
    "program",
    "registrar",
    "cogs",
    "up_loader",
    "loading",
    "builtin_modules | life_cycle",
    "up",
    "telemetry_controller | mode_monitor | flight_controller | flight_modes",
    "providers",
    "base_thread_module | base_periodic_module",
    "base_started_module",
    "base_module",
    "needs | vetoes | mission",
    "commands | key_ring",
    "cleanup | protocols | context",
    "tls",
    "config | mode",
    "log",
    "system",
    "output",
    "fields | version | errors | earth",
    "quick_dataclass",
)
# Up names no cog and no device: it knows roles. These texts of its files are exceptions.
NAMES_ALLOWED = (
    # Deprecated.
    ("mode.py", "WITH_ARDUINO"),
    # Words of config.yml and of the wire (docs/protocols.md).
    ("config/application.py", '"arduino"'),
    ("commands/board_status.py", '"arduino.status"'),
    ("commands/pid_tunings_commands.py", '"arduino.pids.'),
    ("commands/system_commands.py", "arduino_connected"),
    # Generated: names of telemetry, and texts for users, who have an Arduino and a phone.
    ("commands/board_schema.py", "the Arduino"),
    *(
        ("commands/telemetry_schema.py", word)
        for word in ("arduino", "Arduino", "android", "phone")
    ),
    # A frame of telemetry as it was sent.
    *(("protocols/packed_dictionary.py", word) for word in ("arduino", "android")),
    # Fields of telemetry as they are in each frame.
    ("protocols/attitude_frame.py", '"arduino"'),
)


def names_in_up(root: Path = ROOT) -> Iterator[str]:
    """Yield ``file:line: name`` for each cog or device that Up names."""
    in_tree = [path.name.replace("_", "[_-]") for path in ROOT.glob("cogs/*_cog")]
    names = re.compile("|".join([*in_tree, "arduino", "android", "phone"]), re.IGNORECASE)
    for path in sorted((root / "up").rglob("*.py")):
        file = path.relative_to(root / "up").as_posix()
        allowed = [text for name, text in NAMES_ALLOWED if name == file]
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for text in allowed:
                line = line.replace(text, "")
            for found in names.finditer(line):
                yield f"up/{file}:{number}: {found.group()}"


def cogs() -> dict[str, set[str]]:
    """Return the permitted imports of every in-tree cog, read from its ``setup.py``."""
    found: dict[str, set[str]] = {}
    for setup in sorted(ROOT.glob("cogs/*_cog/setup.py")):
        required = _install_requires(setup)
        others = {
            name.removeprefix("raspilot-").replace("-", "_")
            for name in required
            if name.startswith("raspilot-")
        }
        # Packages of this distribution that one cog shares with the ground station.
        shared = {f"up_{setup.parent.name.removesuffix('_cog')}"} & set(ARROWS)
        found[setup.parent.name] = {"up"} | others | shared
    return found


def _install_requires(setup: Path) -> list[str]:
    for node in ast.walk(ast.parse(setup.read_text(encoding="utf-8"))):
        if isinstance(node, ast.keyword) and node.arg == "install_requires":
            listed: list[str] = ast.literal_eval(node.value)
            return listed
    return []


def contracts() -> str:
    """Return the configuration of import-linter."""
    arrows = {**ARROWS, **cogs()}
    lines = ["[importlinter]", "root_packages ="]
    lines += [f"    {name}" for name in arrows]
    lines += ["exclude_type_checking_imports = True"]
    lines += _layers()
    for name, allowed in arrows.items():
        forbidden = sorted(set(arrows) - allowed - {name})
        if name in ("up_proxy", "up_cluster"):
            forbidden += _parts_of_up_the_proxy_may_not_use()
        lines += _contract(name, forbidden)
    return "\n".join(lines) + "\n"


def _parts_of_up_the_proxy_may_not_use() -> Iterator[str]:
    for path in sorted((ROOT / "up").iterdir()):
        is_package = (path / "__init__.py").is_file()
        if (is_package or path.suffix == ".py") and path.stem not in {*PROXY_MAY_USE, "__init__"}:
            yield f"up.{path.stem}"


def _layers() -> Iterator[str]:
    yield "[importlinter:contract:layers]"
    yield "name = each part of up imports only from the layers below it"
    yield "type = layers"
    yield "layers ="
    for layer in LAYERS:
        yield "    " + re.sub(r"(?=\b[a-z])", "up.", layer)


def _contract(name: str, forbidden: list[str]) -> list[str]:
    return [
        f"[importlinter:contract:{name}]",
        f"name = {name} imports only what it may",
        "type = forbidden",
        f"source_modules = {name}",
        "forbidden_modules =",
        *(f"    {each}" for each in forbidden),
    ]


def main() -> int:
    named = list(names_in_up())
    if named:
        print("Up names a cog or a device; use its role:", *named, sep="\n  ")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "contracts.ini")
        path.write_text(contracts(), encoding="utf-8")
        program = Path(sys.executable).with_name("lint-imports")
        status = subprocess.run(
            [str(program), "--config", str(path), "--no-cache"], cwd=ROOT, check=False
        ).returncode
    return status or int(bool(named))


if __name__ == "__main__":
    sys.exit(main())
