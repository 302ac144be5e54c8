"""Checks that a class for a newer Android is reached only behind the check of the version.

``guards.py MANIFEST JAR...`` reads the classes of the jars through ``javap``. The rule: a class
of a package whose last part is ``apiNN`` may be named

* by classes of packages ``apiMM`` with MM >= NN, anywhere;
* by any other class only in an instruction to which every way through its method passes a
  comparison of ``Build.VERSION.SDK_INT`` with a constant that shows it to be NN or more. The
  field must be compared where it is read (no copy in a variable, no method around it), and the
  constant must be one that the compiler writes down; ``&&``, early returns and ``switch`` are
  followed. A method that was called, and a class within a class, is not behind its caller's check.

It may not be extended or implemented, nor be the type of a field, parameter or result, nor be
caught or annotate anything, nor stand in the manifest. Its name in a string (``Class.forName``)
counts; one put together at run time is not seen. And ``newer-NN.jar``, which was compiled against
the framework of NN, may hold classes of packages ``apiNN`` only.
"""

from __future__ import annotations

import re
import struct
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

NEWER = re.compile(r"[\w/.]*[/.]api(\d+)[/.]\w[\w$]*")
MENTIONED = re.compile(rb"[/.]api\d+[/.]")
CLASS = re.compile(r"^(?:\w+ )*(?:class|interface|enum) ([\w.$]+)")
INSTRUCTION = re.compile(r"^\s+(\d+): (\w+)\s*(.*)$")
CASE = re.compile(r"^\s+(-?\d+|default): (\d+)$")
HANDLER = re.compile(r"^\s+(\d+)\s+(\d+)\s+(\d+)\s+(?:Class (\S+)|any)")
NEWER_JAR = re.compile(r"newer-(\d+)\.jar")
SDK_INT = re.compile(r"// Field android/os/Build\$VERSION\.SDK_INT:I")
PUSHED = re.compile(r"^(?:iconst_(m1|\d)|[bs]ipush|ldc)$")
# The bytes after the tag of every kind of constant except text (the Java Virtual Machine
# Specification, table 4.4-A).
CONSTANT_BYTES = dict.fromkeys((7, 8, 16, 19, 20), 2) | {15: 3, 5: 8, 6: 8}
CONSTANT_BYTES |= dict.fromkeys((3, 4, 9, 10, 11, 12, 17, 18), 4)
ENDS = {"return", "ireturn", "lreturn", "freturn", "dreturn", "areturn", "athrow"}
# What the branch taken, and the way past it, show of "SDK_INT (op) constant".
MIRRORED = {"lt": "gt", "gt": "lt", "le": "ge", "ge": "le", "eq": "eq", "ne": "ne"}
CONTRARY = {"lt": "ge", "ge": "lt", "gt": "le", "le": "gt", "eq": "ne", "ne": "eq"}


@dataclass(slots=True)
class Instruction:
    """One instruction of a method; ``next`` is where the one after it begins, -1 at the end."""

    at: int
    name: str
    operands: str
    next: int = -1
    cases: list[tuple[str, int]] = field(default_factory=list)


@dataclass(slots=True)
class Method:
    """A method: its declaration, its instructions, its exception table (from, to, handler)."""

    declared: str
    code: dict[int, Instruction] = field(default_factory=dict)
    handlers: list[tuple[int, int, int]] = field(default_factory=list)
    caught: list[str] = field(default_factory=list)

    def targets(self) -> set[int]:
        """Return every jump target in the code."""
        found = {handler for _, _, handler in self.handlers}
        for each in self.code.values():
            found.update(target for _, target in each.cases)
            if each.name.startswith(("if", "goto")):
                found.add(int(each.operands))
        return found


@dataclass(slots=True)
class Listing:
    """A class in the form of ``javap -c -p``; fields are methods without code here."""

    name: str
    declared: str
    methods: list[Method] = field(default_factory=list)


def level(name: str) -> int:
    """Return the Android level of a class by its package; 0 if it requires none."""
    found = NEWER.fullmatch(name)
    return int(found[1]) if found else 0


def named(text: str) -> Iterator[tuple[int, str]]:
    """Yield level and name of every class for a newer Android that ``text`` names."""
    for found in NEWER.finditer(text):
        yield int(found[1]), found[0].lstrip("L").replace("/", ".")


def listings(text: str) -> Iterator[Listing]:
    """Read the output of ``javap -c -p``."""
    listing = method = None
    last: Instruction | None = None
    for line in text.splitlines():
        if found := CLASS.match(line):
            listing, method, last = Listing(found[1], line), None, None
        elif line == "}" and listing is not None:
            yield listing
            listing = None
        elif listing is None:
            continue
        elif re.match(r"^  \S.*;$", line) and not line.startswith("   "):
            method, last = Method(line.strip()), None
            listing.methods.append(method)
        elif method is None:
            continue
        elif last is not None and last.name.endswith("switch") and (found := CASE.match(line)):
            last.cases.append((found[1], int(found[2])))
        elif found := INSTRUCTION.match(line):
            at = int(found[1])
            if last is not None:
                last.next = at
            last = method.code[at] = Instruction(at, found[2], found[3])
        elif found := HANDLER.match(line):
            method.handlers.append((int(found[1]), int(found[2]), int(found[3])))
            method.caught.append(found[4] or "")


def constant(instruction: Instruction) -> int | None:
    """Return the whole number that an instruction pushes; None for any other instruction."""
    found = PUSHED.match(instruction.name)
    if not found:
        return None
    if found[1]:
        return -1 if found[1] == "m1" else int(found[1])
    number = re.search(r"(?:^|// int )(-?\d+)$", instruction.operands)
    return int(number[1]) if number else None


def shown(operator: str, number: int, known: int) -> int:
    """Return the minimum SDK_INT after ``SDK_INT operator number`` held, ``known`` before."""
    least = {"ge": number, "eq": number, "gt": number + 1}.get(operator, known)
    return max(known, least)


def compared(method: Method, at: int, before: list[Instruction]) -> tuple[str, int] | None:
    """Return the position of SDK_INT in the comparison at ``at``, after ``before``.

    ``("", n)`` for SDK_INT first and n second, ``("mirrored", n)`` the other way round. A jump
    target between reading and comparing, as in ``?:``, may compare another value.
    """
    if len(before) < 2 or {before[-1].at, at} & method.targets():
        return None
    first, second = before[-2:]
    if SDK_INT.search(first.operands) and (number := constant(second)) is not None:
        return "", number
    if SDK_INT.search(second.operands) and (number := constant(first)) is not None:
        return "mirrored", number
    return None


def edges(method: Method, at: int, known: int) -> Iterator[tuple[int, int]]:
    """Yield the successors of the instruction at ``at``, and the minimum SDK_INT known there."""
    code = method.code
    here = code[at]
    before = [code[each] for each in sorted(code) if each < at][-2:]
    if here.name.endswith("switch"):
        reads = bool(before) and SDK_INT.search(before[-1].operands) is not None
        reads = reads and at not in method.targets()
        for label, target in here.cases:
            yield target, shown("eq", int(label), known) if reads and label != "default" else known
    elif here.name.startswith("goto"):
        yield int(here.operands), known
    elif here.name.startswith("if"):
        target = int(here.operands)
        found = compared(method, at, before) if here.name.startswith("if_icmp") else None
        if found is None:
            yield target, known
            yield here.next, known
        else:
            operator = here.name.removeprefix("if_icmp")
            operator = MIRRORED[operator] if found[0] else operator
            yield target, shown(operator, found[1], known)
            yield here.next, shown(CONTRARY[operator], found[1], known)
    elif here.name not in ENDS and here.next >= 0:
        yield here.next, known
    for start, end, handler in method.handlers:
        if start <= at < end:
            yield handler, known


def least_known(method: Method, entered: int) -> dict[int, int]:
    """Return the minimum SDK_INT that is certain at every reachable instruction."""
    known: dict[int, int] = {}
    waiting = [(min(method.code), entered)] if method.code else []
    while waiting:
        at, value = waiting.pop()
        if at in known and known[at] <= value:
            continue
        known[at] = min(value, known.get(at, value))
        waiting.extend(edges(method, at, known[at]))
    return known


def faults(listing: Listing) -> Iterator[str]:
    """Yield one sentence for every place in a class that breaks the rule."""
    own = level(listing.name)
    for needed, name in named(listing.declared):
        if needed > own:
            yield f"{listing.name} extends or implements {name}, which needs Android API {needed}"
    for method in listing.methods:
        for needed, name in named(method.declared):
            if needed > own:
                yield f"{listing.name} declares {name}, which needs API {needed}: {method.declared}"
        for needed, name in named(" ".join(method.caught)):
            if needed > own:
                # The whole method fails verification on a system without the class.
                yield f"{listing.name}: {method.declared} catches {name}, which needs API {needed}"
        known = least_known(method, own)
        for at, instruction in method.code.items():
            sure = known.get(at)
            for needed, name in named(instruction.operands):
                if sure is not None and needed > sure:
                    yield (
                        f"{listing.name}: {method.declared} reaches {name} without "
                        f"Build.VERSION.SDK_INT >= {needed} before it"
                    )


def texts(code: bytes) -> Iterator[str]:
    """Yield every text among the constants of a class file."""
    (count,) = struct.unpack_from(">H", code, 8)
    at, index = 10, 1
    while index < count:
        tag = code[at]
        if tag == 1:
            (length,) = struct.unpack_from(">H", code, at + 1)
            yield code[at + 3 : at + 3 + length].decode("utf-8", "replace")
            at += 3 + length
        else:
            at += 1 + CONSTANT_BYTES[tag]
        # A long and a double take two places of the table.
        index += 2 if tag in (5, 6) else 1


def unseen(listing: Listing, code: bytes) -> Iterator[str]:
    """Yield one sentence for every newer class that is named outside of instructions.

    Mostly that is an annotation, which javap does not list.
    """
    seen = {name for _, name in named(listing.declared)}
    for method in listing.methods:
        lines = [method.declared, *method.caught, *(each.operands for each in method.code.values())]
        seen.update(name for line in lines for _, name in named(line))
    # A nested class requires its enclosing classes.
    seen |= {name[:at] for name in seen for at, each in enumerate(name) if each == "$"}
    for text in texts(code):
        for needed, name in named(text):
            if needed > level(listing.name) and name not in seen:
                yield f"{listing.name} names {name}, as an annotation does: it needs API {needed}"


def inside(jar: Path) -> dict[str, bytes]:
    """Return the class files in ``jar`` by the names of their classes."""
    with zipfile.ZipFile(jar) as opened:
        names = [each for each in opened.namelist() if each.endswith(".class")]
        return {n.removesuffix(".class").replace("/", "."): opened.read(n) for n in names}


def listed(jar: Path, classes: list[str]) -> str:
    """Return the output of ``javap`` for the classes in ``jar``."""
    if not classes:
        return ""
    command = ["javap", "-J-XX:TieredStopAtLevel=1", "-c", "-p", "-cp", str(jar), *classes]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def faults_of_jar(jar: Path) -> Iterator[str]:
    """Yield one sentence for every place in a jar that breaks the rule."""
    classes = inside(jar)
    if compiled := NEWER_JAR.fullmatch(jar.name):
        for name in classes:
            if level(name) != int(compiled[1]):
                yield (
                    f"{name} is compiled for API {compiled[1]}: "
                    f"its package must end in .api{compiled[1]}"
                )
    telling = [name for name, code in classes.items() if MENTIONED.search(code)]
    for listing in listings(listed(jar, telling)):
        yield from faults(listing)
        yield from unseen(listing, classes[listing.name])


def main(arguments: list[str]) -> int:
    """Check the manifest and the jars that ``arguments`` name; return the exit status."""
    manifest, *jars = arguments
    found = [
        f"{manifest} names {name}: a component must be there on every Android"
        for _, name in named(Path(manifest).read_text(encoding="utf-8"))
    ]
    for jar in jars:
        found.extend(faults_of_jar(Path(jar)))
    for each in dict.fromkeys(found):
        print(each, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
