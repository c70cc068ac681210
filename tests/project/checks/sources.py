"""Source files are short, finished and name no place of the machine they were written on."""

import re
from pathlib import Path

from . import tree

LONGEST = 450
_UNFINISHED = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X)\b|#if [0]|\bDISABLED" r"_")
_PLACES = re.compile(r"(?<![\w.])/(?:work|root|home)/")


def check(root: Path) -> list[str]:
    problems = []
    scripts = sorted(p for p in [*(root / "tools").iterdir(), root / "Makefile", root / ".ci" / "run"] if p.is_file())
    texts = tree.files(root, suffixes=(*tree.CPP, ".py", ".txt")) + tree.documents(root) + scripts
    for path in texts:
        text = tree.lines(path)
        name = path.relative_to(root)
        if path.suffix in (*tree.CPP, ".py") and len(text) > LONGEST:
            problems.append(f"{name}: {len(text)} lines, at most {LONGEST}")
        for number, line in enumerate(text, 1):
            if _UNFINISHED.search(line):
                problems.append(f"{name}:{number}: a mark of unfinished work")
            if _PLACES.search(line):
                problems.append(f"{name}:{number}: a path of one machine")
    return problems
