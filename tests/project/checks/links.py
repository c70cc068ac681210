"""Links in the documents lead to files and headings that exist."""

import re
from pathlib import Path

from . import tree

_LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)|<img[^>]*\ssrc=\"([^\"]+)\"")
_FENCE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)


def anchors(path: Path) -> set[str]:
    """The anchors of a document's headings, as GitHub makes them."""
    text = _FENCE.sub("", path.read_text(encoding="utf-8"))
    titles = re.findall(r"^#+\s+(.*?)\s*$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", t.lower()).replace(" ", "-") for t in titles}


def check(root: Path) -> list[str]:
    problems = []
    for path in tree.documents(root):
        text = _FENCE.sub("", path.read_text(encoding="utf-8"))
        for target in (a or b for a, b in _LINK.findall(text)):
            if re.match(r"https?://\w", target):
                continue
            file, _, anchor = target.partition("#")
            goal = (path.parent / file) if file else path
            if not goal.exists():
                problems.append(f"{path.relative_to(root)}: link to {target}: no such file")
            elif anchor and goal.suffix == ".md" and anchor not in anchors(goal):
                problems.append(f"{path.relative_to(root)}: link to {target}: no such heading")
    return problems
