"""Includes point one way: a room uses the public headers, itself and the rooms above it (CAIRN_ROOMS in CMakeLists.txt);
public headers use only each other; programs use only the public headers, their own files and the libraries of apps."""

import re
from pathlib import Path

from . import tree

_INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')


def rooms(root: Path) -> list[str]:
    """The rooms, topmost first."""
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"set\(CAIRN_ROOMS\s+([^)]*)\)", text).group(1).split()


def _allowed(root: Path, path: Path, order: list[str]) -> set[str]:
    part = path.relative_to(root).parts
    if part[0] == "apps":
        return {"cairn", *(p.name for p in (root / "apps").iterdir() if p.is_dir())}
    if part[0] != "src" or part[1] not in order:
        return {"cairn"}
    return {"cairn", *order[: order.index(part[1]) + 1]}


def check(root: Path) -> list[str]:
    order = rooms(root)
    problems = [f"src/{p.name}: no room of this name in CAIRN_ROOMS"
                for p in sorted((root / "src").iterdir()) if p.is_dir() and p.name not in order]
    for path in tree.files(root, ("include", "src", "apps", "examples")):
        allowed = _allowed(root, path, order)
        for number, line in enumerate(tree.lines(path), 1):
            match = _INCLUDE.match(line)
            if not match:
                continue
            target = match.group(1)
            # A program's files lie beside it, or are made by its build (.inc).
            own = (path.parent / target).is_file() or target.endswith(".inc")
            if own and "/" not in target and path.relative_to(root).parts[0] in ("apps", "examples"):
                continue
            if target.split("/")[0] not in allowed or "/" not in target or ".." in target:
                problems.append(f'{path.relative_to(root)}:{number}: may not include "{target}"; '
                                f"allowed: {', '.join(sorted(allowed))}")
    return problems
