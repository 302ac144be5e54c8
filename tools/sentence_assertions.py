"""Count the assertions of the tests that compare sentences.

Tests assert codes and values, so that a message can be reworded without breaking one. A sentence
is a text of three words or more in a comparison, a pattern or an equality of a test.
"""

from __future__ import annotations

import argparse
import ast
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

WORD = re.compile(r"(?<![\w./-])[A-Za-z][a-z']+(?![\w/=-])")
PATTERN_CALLS = {"startswith", "endswith", "match", "search", "fullmatch"}
FOREIGN = {
    ".java": re.compile(r'assert\w*\((?:[^";]*[(,])?\s*"([^"\n]+)"'),
    ".mjs": re.compile(r"assert\.\w+\([^;]*?['\"`/]([^'\"`/\n]+)['\"`/]"),
    ".cpp": re.compile(r'CHECK\w*\([^;]*?"([^"\n]+)"'),
}


def is_sentence(text: str) -> bool:
    return any(
        len(WORD.findall(part)) >= 3 and re.search(r"[a-z]+ [a-z]+ [a-z]+", part) is not None
        for part in text.splitlines()
    )


def _has_sentence(node: ast.AST) -> bool:
    return any(
        isinstance(part, ast.Constant) and isinstance(part.value, str) and is_sentence(part.value)
        for part in ast.walk(node)
    )


def _compares(node: ast.AST) -> bool:
    return isinstance(node, ast.Compare) or (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr in PATTERN_CALLS
    )


def in_python(text: str) -> Iterator[int]:
    """Yield the line of each assertion on a sentence in Python source."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Assert):
            if any(_compares(part) and _has_sentence(part) for part in ast.walk(node.test)):
                yield node.lineno
        elif isinstance(node, ast.Call):
            for keyword in node.keywords:
                if keyword.arg == "match" and _has_sentence(keyword.value):
                    yield node.lineno


def in_file(path: Path) -> Iterator[int]:
    """Yield the line of each assertion on a sentence in a test's file."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        yield from in_python(text)
        return
    for found in FOREIGN[path.suffix].finditer(text):
        if is_sentence(found.group(1)):
            yield text.count("\n", 0, found.start()) + 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="*", default=["tests", "android", "arduino/host"])
    parser.add_argument("--max", type=int, help="more are an error")
    parser.add_argument("--list", action="store_true", help="print each place")
    options = parser.parse_args()
    names = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--", *options.paths],
        capture_output=True, text=True, check=True,
    ).stdout.split("\0")  # fmt: skip
    count = 0
    for name in filter(None, names):
        path = Path(name)
        is_test = "test" in path.name.lower()
        if path.suffix not in {".py", *FOREIGN} or not is_test or not path.is_file():
            continue
        for line in in_file(path):
            count += 1
            if options.list:
                print(f"{name}:{line}")
    print(f"{count} assertions compare sentences")
    return int(options.max is not None and count > options.max)


if __name__ == "__main__":
    raise SystemExit(main())
