"""What the checks share: finding files, and C++ text without its comments and strings."""

import re
from pathlib import Path

CODE_FOLDERS = ("include", "src", "apps", "bench", "tests", "examples", "python")
CPP = (".h", ".cpp")


def files(root: Path, folders=CODE_FOLDERS, suffixes=CPP) -> list[Path]:
    """Files below the folders with one of the suffixes, in a fixed order."""
    found = []
    for folder in folders:
        found += [p for p in (root / folder).rglob("*") if p.is_file() and p.suffix in suffixes]
    return sorted(found)


def documents(root: Path) -> list[Path]:
    """The Markdown files that are shipped."""
    return sorted(root.glob("*.md")) + sorted((root / "docs").rglob("*.md"))


def lines(path: Path) -> list[str]:
    return path.read_text(encoding="utf-8").splitlines()


_TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.DOTALL)


def without_comments(text: str) -> str:
    """The code with comments removed and strings emptied; line numbers stay as they are."""

    def blank(match: re.Match) -> str:
        token = match.group(0)
        rest = "\n" * token.count("\n")
        return '""' + rest if token[0] in '"R' else rest

    return _TOKEN.sub(blank, text)
