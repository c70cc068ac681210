"""docs/thesis-map.md: each row names a function of the sources and a test that exist; every algorithm of the thesis and
every equation the sources cite has a row."""

import re
from pathlib import Path

from . import tree

_ROW = re.compile(r"^\|(?!\s*-)([^|]*)\|([^|]*)\|([^|]*)\|([^|]*)\|\s*$", re.MULTILINE)
_QUOTED = re.compile(r"`([^`]+)`")
_EQUATION = re.compile(r"\b([2-3]\.\d{1,2}\.\d{1,2})(?:[a-z](?![\w]))?(?![.\d])")
_TEST = re.compile(r"^\s*(?:TYPED_)?TEST(?:_[FP])?\(\s*(\w+)\s*,\s*(\w+)\s*\)", re.MULTILINE)
ALGORITHMS = range(1, 13)


def rows(root: Path) -> list[tuple[str, str, str, str]]:
    text = (root / "docs" / "thesis-map.md").read_text(encoding="utf-8")
    return [tuple(c.strip() for c in row) for row in _ROW.findall(text) if row[0].strip() != "Thesis"]


def _tests(root: Path) -> set[str]:
    return {f"{suite}.{name}" for path in tree.files(root, ("tests",), (".cpp", ".h"))
            for suite, name in _TEST.findall(path.read_text(encoding="utf-8"))}


def _row_problems(root: Path, row, tests: set[str]) -> list[str]:
    thesis, _, functions, checks = row
    problems = []
    places = _QUOTED.findall(functions)
    if not places:
        problems.append("names no function")
    for place in places:
        file, _, name = place.partition(":")
        path = root / "src" / file
        if not path.is_file():
            problems.append(f"src/{file} does not exist")
        elif not re.search(rf"\b{re.escape(name or ' ')}\b", tree.without_comments(path.read_text(encoding="utf-8"))):
            problems.append(f"src/{file} has no {name or 'name after the colon'}")
    named = _QUOTED.findall(checks)
    if not named:
        problems.append("names no test")
    problems += [f"no test {name}" for name in named if name not in tests]
    return [f"docs/thesis-map.md: {thesis}: {p}" for p in problems]


def check(root: Path) -> list[str]:
    tests, table = _tests(root), rows(root)
    problems = [p for row in table for p in _row_problems(root, row, tests)]
    mapped = " ".join(row[0] for row in table)
    problems += [f"docs/thesis-map.md: no row for Algorithm {n}" for n in ALGORITHMS
                 if not re.search(rf"\bAlgorithm {n}\b", mapped)]
    known = {e for row in table for e in _EQUATION.findall(row[0])}
    for path in tree.files(root, ("include", "src")):
        for equation in sorted(set(_EQUATION.findall(path.read_text(encoding="utf-8"))) - known):
            problems.append(f"docs/thesis-map.md: no row for equation {equation}, cited in {path.relative_to(root)}")
    return problems
