"""Every public symbol of include/cairn has a doc block: a /// block above it or a /// comment on its lines. In a class the
block also covers the members that follow it line by line, up to the next blank line. Destructors, copies, moves, friends
and forward declarations speak for themselves."""

import re
from dataclasses import dataclass
from pathlib import Path

from . import tree

_TYPE = re.compile(r"^(?:template\s*<.*?>\s*)?(struct|class|enum|union)\b")
_ACCESS = re.compile(r"^(public|private|protected)$")
_SILENT = re.compile(r"~\w+\s*\(|=\s*(?:delete|default)\b|^friend\b|\boperator=\s*\(|^(?:struct|class)\s+\w+$"
                     r"|^(\w+)\((?:const\s+\1\s*&|\1\s*&&)|^static_assert\b|^using [\w:]+::\w+$")


@dataclass
class Scope:
    kind: str  # namespace, type, enum or opaque
    public: bool
    line: int
    head: str
    last_documented: int = -1  # line on which the last documented member ended


@dataclass
class Declaration:
    first: int
    last: int
    head: str
    scope: Scope


def declarations(text: str) -> list[Declaration]:
    """Declarations at namespace scope and public ones of classes, in the order of their ends."""
    code = re.sub(r"^[ \t]*#.*$", "", tree.without_comments(text), flags=re.MULTILINE)
    found: list[Declaration] = []
    stack = [Scope("namespace", True, 0, "")]
    statement, first, line, parentheses = "", 0, 1, 0

    def finish(last: int, head: str, scope: Scope, start: int) -> None:
        visible = all(s.public and s.kind in ("namespace", "type") for s in stack)
        if head.strip() and visible:
            found.append(Declaration(start, last, head.strip(), scope))

    for index, char in enumerate(code):
        if char == "\n":
            line += 1
        inside = stack[-1]
        if inside.kind == "opaque" or parentheses > 0 and char in "{};":
            if char == "{":
                stack.append(Scope("opaque", False, first, ""))
            elif char == "}":
                stack.pop()
                if stack[-1].kind != "opaque" and parentheses == 0 and not re.match(r"\s*[;,{]", code[index + 1:]):
                    finish(line, statement, stack[-1], first)
                    statement = ""
            continue
        parentheses += (char == "(") - (char == ")")
        if not statement.strip():
            first = line
        if char == "{":
            head = statement.strip()
            match = _TYPE.match(head)
            if re.match(r"^(inline\s+)?namespace\b", head):
                stack.append(Scope("namespace", True, first, ""))
                statement = ""
            elif match and "(" not in head.split("{")[0]:
                kind = "enum" if match.group(1) == "enum" else "type"
                public = match.group(1) in ("struct", "union")
                stack.append(Scope(kind, public, first, head))
                statement = ""
            else:
                stack.append(Scope("opaque", False, first, ""))
        elif char == "}":
            closed = stack.pop()
            statement = ""
            if closed.head:
                finish(line, closed.head + " {", stack[-1], closed.line)
        elif char == ";":
            finish(line, statement, inside, first)
            statement = ""
        elif char == ":" and _ACCESS.match(statement.strip()):
            inside.public = statement.strip() == "public"
            statement = ""
        elif inside.kind != "enum":
            statement += char
    return found


def _documented(declaration: Declaration, source: list[str]) -> bool:
    above = source[declaration.first - 2].strip() if declaration.first >= 2 else ""
    if above.startswith("///") or any("///" in s for s in (source[declaration.first - 1], source[declaration.last - 1])):
        return True
    return declaration.scope.kind == "type" and declaration.scope.last_documented == declaration.first - 1


def check(root: Path) -> list[str]:
    problems = []
    for path in tree.files(root, ("include",), (".h",)):
        source = tree.lines(path)
        for declaration in declarations("\n".join(source) + "\n"):
            silent = _SILENT.search(declaration.head)
            if silent or _documented(declaration, source):
                declaration.scope.last_documented = declaration.last
            else:
                head = re.sub(r"\s+", " ", declaration.head)[:70]
                problems.append(f"{path.relative_to(root)}:{declaration.first}: no doc block: {head}")
    return problems
