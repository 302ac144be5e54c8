#!/usr/bin/env python3
"""Finds phrases that read as translated rather than plain technical English.

Reads documents, comments, docstrings and messages of the tracked files below the given paths
(default: all). It is a meter, not a judge: a listed phrase may be right in its place.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

# One alternative a line; blanks are written as [ ].
PHRASES = re.compile(
    r"""
    \b(?:no|every|some)body\b
    | \bwho(?:so)?ever\b
    | \bwhom\b
    | \banew\b
    | \bfor[ ]ever\b
    | \bof[ ](?:its|their|his)[ ]own\b
    | \b(?:is|are|was|were)[ ](?:said|told|heard|asked|shown)[ ]
        (?:once|twice|so|by|to|in[ ]a[ ]sentence)\b
    | \bwhich[ ]is[ ]said\b
    | \b(?:is|are)[ ]said\b
    | \b(?:is|are|be|was)[ ]told\b
    | \b(?:says|tells|hears)[ ](?:so|it|that|what|who|which|whether)\b
    | \bno[ ](?:longer|more)[ ]than[ ]it\b
    | \bis[ ]no[ ][a-z]+\b
    | \bare[ ]no[ ][a-z]+\b
    | \bis[ ]none\b
    | \bare[ ]none\b
    | \bnone[ ]of[ ](?:a|an|the)[ ][a-z]+\b
    | \bso[ ](?:long|many|often)\b(?![ ]as)
    | \bnot[ ]to[ ]be[ ]had\b
    | \bwhat[ ](?:is|was|came|comes|became|flies|went|lies|stands|follows|had)\b
    | \b[Ww]ho[ ](?:asks|sends|wants|reads|hears|comes|has|is|commands|throws|watches)\b
    | \bas[ ]it[ ]is\b
    | \bby[ ]itself\b
    | \bthe[ ]more\b
    | \bever[ ]more\b
    | \bmeanwhile\b
    | \bbesides\b
    | \bof[ ]now\b
    | \bof[ ]before\b
    | \bat[ ]once\b
    | \bthe[ ]moment[ ](?:it|that|they)\b
    | \bbears?[ ](?:what|with)\b
    | \bgoes?[ ]on\b
    | \bgoing[ ]on\b
    | \bany[ ]?more\b
    | \blet(?:s)?[ ]happen\b
    | \bbut[ ]for\b
    """,
    re.IGNORECASE | re.VERBOSE,
)
WORD = re.compile(r"[A-Za-z][A-Za-z'-]+")
CODE = {".py", ".cpp", ".h", ".c", ".java", ".js", ".mjs", ".ino", ".yml", ".tmpl", ".sh"}
DOCUMENTS = {".md", ".txt", ".html"}
TEXT_IN_CODE = re.compile(
    r'"""(.*?)"""|/\*(.*?)\*/|//([^\n]*)|#([^\n]*)'
    r'|"((?:[^"\\\n]|\\.)*)"|\'((?:[^\'\\\n]|\\.)*)\'',
    re.DOTALL,
)
FENCED = re.compile(r"```.*?```", re.DOTALL)


def kind_of(name: str) -> str | None:
    """Return how a file counts; None for one that is not read."""
    if "/vendor/" in name or "fixtures/" in name:
        return None
    suffix = Path(name).suffix
    return "documents" if suffix in DOCUMENTS else "code text" if suffix in CODE else None


def english_in(text: str, kind: str) -> Iterator[tuple[int, str]]:
    """Yield each English text of a file with its first line's number."""
    if kind == "documents":
        # A fenced block keeps its lines, so that numbers stay right.
        yield 1, FENCED.sub(lambda block: "\n" * block[0].count("\n"), text)
        return
    for found in TEXT_IN_CODE.finditer(text):
        part = next(part for part in found.groups() if part is not None)
        if " " in part:
            yield text.count("\n", 0, found.start()) + 1, part


def main() -> int:
    """Print the rates and, above the limit, each phrase with file and line; return 1 then."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paths", nargs="*")
    parser.add_argument("--max", type=float, help="phrases per 1,000 words; status 1 above it")
    parser.add_argument("--list", action="store_true", help="list the phrases in any case")
    options = parser.parse_args()
    words: Counter[str] = Counter()
    hits: dict[str, list[str]] = {"code text": [], "documents": []}
    listed = subprocess.run(
        ["git", "ls-files", "-z", *options.paths], capture_output=True, text=True, check=True
    )
    for name in listed.stdout.split("\0"):
        kind = kind_of(name)
        if kind is None or not Path(name).is_file():
            continue
        text = Path(name).read_text(encoding="utf-8", errors="replace")
        for first, part in english_in(text, kind):
            words[kind] += len(WORD.findall(part))
            for hit in PHRASES.finditer(part):
                line = first + part.count("\n", 0, hit.start())
                hits[kind].append(f"{name}:{line}: {hit[0]}")
    is_bad = False
    for kind, found in hits.items():
        rate = 1000 * len(found) / max(1, words[kind])
        is_above = options.max is not None and rate > options.max
        is_bad |= is_above
        if is_above or options.list:
            sys.stdout.write("".join(f"{each}\n" for each in found))
        sys.stdout.write(
            f"{kind}: {len(found)} phrases in {words[kind]} words, {rate:.1f} per 1,000\n"
        )
    return int(is_bad)


if __name__ == "__main__":
    sys.exit(main())
