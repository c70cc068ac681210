"""The program of docs/python.md and the examples run."""

import ast
import re
import runpy
from pathlib import Path

import cairn
import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    assert len(blocks) > 4
    program = tmp_path / "page.py"
    program.write_text("\n".join(blocks), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(program))
    assert "wall: 1 s of 13 bodies" in capsys.readouterr().out


def test_the_first_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(ROOT / "python" / "examples" / "hello.py"))
    assert "at a height of 0.10 m" in capsys.readouterr().out


EXAMPLES = sorted((ROOT / "python" / "examples").glob("plot_*.py"))
SUBJECTS = {"arch", "bounce", "cradle", "dominoes", "force_chains", "friction", "hopper", "linkage", "repose",
            "rocking", "rollback", "tower"}


def run_as_a_notebook(file: Path) -> object:
    """Runs a program and returns what its last line is, as a notebook shows it."""
    program = ast.parse(file.read_text(encoding="utf-8"))
    last = program.body.pop()
    assert isinstance(last, ast.Expr), "the last line is what the notebook shows: a recording, or a run with one"
    names: dict[str, object] = {}
    exec(compile(program, file, "exec"), names)
    shown: object = eval(compile(ast.Expression(last.value), file, "eval"), names)
    return shown


def test_the_examples_are_these() -> None:
    assert {example.stem[len("plot_"):] for example in EXAMPLES} == SUBJECTS


@pytest.mark.parametrize("example", EXAMPLES, ids=[example.stem for example in EXAMPLES])
def test_an_example_ends_in_a_figure_and_a_replay(
    example: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("CAIRN_SHORT", "1")
    # Each compares what it measures with what is known.
    shown = run_as_a_notebook(example)
    recording = shown.recording if isinstance(shown, cairn.Result) else shown
    assert isinstance(recording, cairn.Recording) and len(recording) > 10
    for number in pyplot.get_fignums():
        for axes in pyplot.figure(number).axes:
            shared = axes.get_shared_x_axes().get_siblings(axes)
            assert axes.get_ylabel() and any(sibling.get_xlabel() for sibling in shared)
            drawn = len(axes.lines) + len(axes.collections)
            assert drawn < 2 or axes.get_legend() or axes.get_title(), "say what is what"
    assert pyplot.get_fignums()
    pyplot.close("all")
