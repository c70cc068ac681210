"""The program of docs/python.md and the examples run."""

import re
import runpy
from pathlib import Path

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


@pytest.mark.parametrize("example", EXAMPLES, ids=[example.stem for example in EXAMPLES])
def test_examples_run_shortened(example: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    monkeypatch.setenv("CAIRN_SHORT", "1")
    # Each compares what it measures with what is known.
    runpy.run_path(str(example))
    for number in pyplot.get_fignums():
        for axes in pyplot.figure(number).axes:
            shared = axes.get_shared_x_axes().get_siblings(axes)
            assert axes.get_ylabel() and any(sibling.get_xlabel() for sibling in shared)
    assert pyplot.get_fignums()
    pyplot.close("all")
