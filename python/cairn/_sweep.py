"""Many runs side by side, one for each choice of parameters."""

import itertools
import json
import os
import threading
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, Optional, Sequence, Union, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._types import FilePath

Parameters = Union[Mapping[str, Sequence[Any]], Sequence[Mapping[str, Any]]]


class Table(Sequence[Mapping[str, Any]]):
    """Rows of named values: parameters and what was measured with them."""

    def __init__(self, rows: Sequence[Mapping[str, Any]]) -> None:
        self._rows = [dict(row) for row in rows]

    @property
    def names(self) -> tuple[str, ...]:
        """Of the columns, in order."""
        return tuple(dict.fromkeys(name for row in self._rows for name in row))

    def column(self, name: str) -> npt.NDArray[Any]:
        """The values of a column as an array. Raises KeyError."""
        return np.array([row[name] for row in self._rows])

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> Mapping[str, Any]: ...

    @overload
    def __getitem__(self, index: slice) -> "Table": ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Mapping[str, Any], "Table"]:
        return Table(self._rows[index]) if isinstance(index, slice) else dict(self._rows[index])

    def __repr__(self) -> str:
        names = self.names
        cells = [names, *(tuple(str(row.get(name, "")) for name in names) for row in self._rows)]
        widths = [max(len(line[i]) for line in cells) for i in range(len(names))]
        return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in cells)

    def _repr_html_(self) -> str:
        def line(cells: Iterator[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in cells) + "</tr>"

        names = self.names
        body = "".join(line((str(row.get(name, "")) for name in names), "td") for row in self._rows)
        return f"<table>{line(iter(names), 'th')}{body}</table>"


def sweep(
    make: Callable[..., Any],
    parameters: Parameters,
    measure: Callable[[Any], Any],
    *,
    workers: Optional[int] = None,
    store: Optional[FilePath] = None,
) -> Table:
    """Makes a world for each choice of parameters and measures it, on all processors.

    - make: called with the parameters by name; returns what `measure` takes, such as a World, a SceneRun or a Scene.
    - parameters: lists of values by name, of which every combination is taken, or a list of dicts.
    - measure: steps what was made and returns a number, a text, a list of them or a dict of named ones. Steps let other
      workers run, so that worlds of one thread each keep all processors busy. It gets what `make` returned to itself:
      each run is equal, bit by bit, to the same run alone.
    - workers: runs at a time; None = one per processor.
    - store: a file to which every row is added when it is there (JSON, one a line). Rows that stand in it already are
      taken from it, so that a sweep goes on where it stopped.

    Returns the rows in the order of the parameters. What `make` or `measure` raise ends the sweep.
    """
    choices = _choices(parameters)
    rows = _Store(Path(store) if store is not None else None)
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        todo = [choice for choice in choices if rows.find(choice) is None]
        futures: list[Future[None]] = [pool.submit(_measure_one, make, measure, choice, rows) for choice in todo]
        try:
            done, _ = wait(futures, return_when=FIRST_EXCEPTION)
            for future in done:
                future.result()
        finally:
            for future in futures:
                future.cancel()
    found = [rows.find(choice) for choice in choices]
    return Table([{**choice, **row} for choice, row in zip(choices, found) if row is not None])


def _choices(parameters: Parameters) -> list[dict[str, Any]]:
    if not isinstance(parameters, Mapping):
        return [dict(choice) for choice in parameters]
    combinations = itertools.product(*parameters.values())
    return [dict(zip(parameters.keys(), values)) for values in combinations]


def _plain(value: Any) -> Any:
    """A value as JSON has it."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    return value


def _measure_one(
    make: Callable[..., Any], measure: Callable[[Any], Any], choice: dict[str, Any], rows: "_Store"
) -> None:
    measured = measure(make(**choice))
    named = measured if isinstance(measured, Mapping) else {"result": measured}
    clash = set(named) & set(choice)
    if clash:
        raise _core.InputError(f"what was measured is called '{clash.pop()}' like a parameter; give it another name")
    rows.add(choice, {name: _plain(value) for name, value in named.items()})


class _Store:
    """The rows that are done, in memory and in a file."""

    def __init__(self, file: Optional[Path]) -> None:
        self._file = file
        self._rows: dict[str, dict[str, Any]] = {}
        self._lock = threading.Lock()
        if file is None or not file.exists():
            return
        text = file.read_text(encoding="utf-8")
        whole = text[:text.rfind("\n") + 1]
        if whole != text:
            # The last row was cut off when the sweep was killed.
            file.write_text(whole, encoding="utf-8")
        for number, line in enumerate(whole.splitlines(), 1):
            try:
                row = json.loads(line)
                self._rows[self._key(row["parameters"])] = row["measured"]
            except (ValueError, KeyError, TypeError) as error:
                raise _core.InputError(f"{file}:{number} is no row of a sweep; name another file") from error

    @staticmethod
    def _key(choice: Mapping[str, Any]) -> str:
        return json.dumps({name: _plain(value) for name, value in choice.items()}, sort_keys=True)

    def find(self, choice: Mapping[str, Any]) -> Optional[dict[str, Any]]:
        return self._rows.get(self._key(choice))

    def add(self, choice: Mapping[str, Any], measured: dict[str, Any]) -> None:
        line = json.dumps({"parameters": {n: _plain(v) for n, v in choice.items()}, "measured": measured})
        with self._lock:
            self._rows[self._key(choice)] = measured
            if self._file is not None:
                with self._file.open("a", encoding="utf-8") as out:
                    out.write(line + "\n")
