"""README.md and docs/hello.md quote the programs in examples word for word, and these are short; the C++ of the tutorial is
nothing but such programs."""

import re
from pathlib import Path

LONGEST = 25
LONGEST_OF_THE_TUTORIAL = 45


def _blocks(root: Path, document: str) -> list[str]:
    text = (root / document).read_text(encoding="utf-8")
    return re.findall(r"^```cpp\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def _missing(root: Path, document: str, programs: list[Path], longest: int) -> list[str]:
    """Programs that the document does not quote, or that are too long for it."""
    problems = []
    blocks = _blocks(root, document)
    for path in programs:
        program = path.read_text(encoding="utf-8")
        name = path.relative_to(root)
        if program.count("\n") > longest:
            problems.append(f"{name}: {program.count(chr(10))} lines, at most {longest}")
        if program not in blocks:
            problems.append(f"{document}: no cpp block is {name} word for word")
    return problems


def check(root: Path) -> list[str]:
    tutorial = sorted((root / "examples" / "hello").glob("*.cpp"))
    problems = _missing(root, "README.md", [root / "examples" / "hello.cpp"], LONGEST)
    problems += _missing(root, "docs/hello.md", tutorial, LONGEST_OF_THE_TUTORIAL)
    programs = [path.read_text(encoding="utf-8") for path in tutorial]
    shown = [block for block in _blocks(root, "docs/hello.md") if block in programs]
    if shown != programs and not problems:
        problems.append("docs/hello.md: the programs of examples/hello do not stand there once each, in their order")
    problems += [f"docs/hello.md: a cpp block that is no program of examples/hello: {block.splitlines()[0]}"
                 for block in _blocks(root, "docs/hello.md") if block not in programs]
    return problems
