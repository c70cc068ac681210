"""Recordings as arrays that are read when they are looked at."""

import base64
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Iterator, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._types import FilePath


class Series:
    """One quantity over all frames of a recording: an array of shape (frames, ...) that reads the frames that an index
    names, and no others."""

    def __init__(self, recording: "Recording", name: str, shape: tuple[int, ...], dtype: npt.DTypeLike) -> None:
        self._recording = recording
        self._name = name
        self.shape = shape
        self.dtype: np.dtype[Any] = np.dtype(dtype)

    def __len__(self) -> int:
        return self.shape[0]

    def _read(self, frame: int) -> Any:
        return getattr(self._recording[frame], self._name)

    def __getitem__(self, key: Any) -> Any:
        """As of an array; its first index, an integer, a slice or a sequence of either kind, says which frames."""
        first, rest = (key[0], key[1:]) if isinstance(key, tuple) and key else (key, ())
        if isinstance(first, (int, np.integer)):
            value = self._read(int(first))
            return value[rest] if rest else value
        if first is Ellipsis or first is None:
            return np.asarray(self)[key]
        frames = np.arange(len(self))[first]
        read = np.array([self._read(int(i)) for i in frames.ravel()], dtype=self.dtype)
        read = read.reshape(frames.shape + self.shape[1:])
        return read[(slice(None),) * frames.ndim + tuple(rest)] if rest else read

    def __iter__(self) -> Iterator[Any]:
        return (self._read(i) for i in range(len(self)))

    def __array__(self, dtype: Optional[npt.DTypeLike] = None) -> npt.NDArray[Any]:
        read: npt.NDArray[Any] = self[:]
        return read if dtype is None else read.astype(dtype)

    def __repr__(self) -> str:
        return f"<cairn.Series '{self._name}', shape {self.shape}>"


class Recording:
    """A recording on disk. Indexing gives frames, the attributes give quantities over all frames.

    time [s], kinetic_energy, potential_energy [J]: shape (frames,);
    position [m, W], linear_velocity [m/s, W], angular_velocity [rad/s, W]: shape (frames, bodies, 3);
    orientation, B to W as (w, x, y, z): shape (frames, bodies, 4); asleep: shape (frames, bodies).
    A removed body's position is NaN.
    joint_point [m, W], joint_force [N, W], joint_torque [N m, W]: shape (frames, joints, 3), without joints if they were
    not recorded. Frames differ in the number of their contacts: recording[i].contact_impulse and the like.

    Raises IoError if the file is missing, truncated or not a recording.
    """

    def __init__(self, file: FilePath) -> None:
        # The program that makes replays may be started from another folder.
        self.file = Path(file).absolute()
        self._reader = _core.RecordingReader(file)
        frames, bodies = self._reader.info.frames, self._reader.info.bodies
        self.time = Series(self, "time", (frames,), np.float64)
        self.kinetic_energy = Series(self, "kinetic_energy", (frames,), np.float64)
        self.potential_energy = Series(self, "potential_energy", (frames,), np.float64)
        self.position = Series(self, "position", (frames, bodies, 3), np.float64)
        self.orientation = Series(self, "orientation", (frames, bodies, 4), np.float64)
        self.linear_velocity = Series(self, "linear_velocity", (frames, bodies, 3), np.float64)
        self.angular_velocity = Series(self, "angular_velocity", (frames, bodies, 3), np.float64)
        self.asleep = Series(self, "asleep", (frames, bodies), np.uint8)
        joints = len(self.scene.joints) if self._reader.info.joints else 0
        self.joint_point = Series(self, "joint_point", (frames, joints, 3), np.float64)
        self.joint_force = Series(self, "joint_force", (frames, joints, 3), np.float64)
        self.joint_torque = Series(self, "joint_torque", (frames, joints, 3), np.float64)

    @property
    def info(self) -> _core.RecordingInfo:
        """What stands in it apart from its frames."""
        return self._reader.info

    @property
    def scene(self) -> _core.Scene:
        """As it was run."""
        return self._reader.info.scene

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, frame: int) -> _core.Frame:
        """A frame: 0 is the initial state, -1 the last one. Raises IndexError."""
        index = frame + len(self) if frame < 0 else frame
        if not 0 <= index < len(self):
            raise IndexError(f"frame {frame} of a recording with {len(self)} frames")
        return self._reader.frame(index)

    def __iter__(self) -> Iterator[_core.Frame]:
        return (self[i] for i in range(len(self)))

    def verify(self, threads: int = 1) -> Optional[_core.RecordingDifference]:
        """Simulates again and compares bit by bit. Returns the first difference, or None. Raises InputError."""
        return _core.verify_recording(self._reader, threads)

    def to_csv(self, file: FilePath) -> Path:
        """One row per frame and body. Raises IoError."""
        _core.export_csv(self._reader, file)
        return Path(file)

    def to_vtk(self, file: FilePath) -> Path:
        """A ParaView time series: a .pvd file beside a folder, and one of the forces if they were recorded. Raises
        IoError."""
        _core.export_vtk(self._reader, file)
        return Path(file)

    def to_html(self, file: Optional[FilePath] = None) -> str:
        """A page that plays the recording without a network, as text, and as a file if one is named. The program
        `cairn` makes it. Raises IoError without the program."""
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "replay.html"
            command = [_program(), "export", str(self.file), "--html", str(page)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0 or not page.is_file():
                raise _core.IoError(f"'{' '.join(command)}' failed: {done.stderr.strip() or done.stdout.strip()}")
            text = page.read_text(encoding="utf-8")
        if file is not None:
            Path(file).write_text(text, encoding="utf-8")
        return text

    def _repr_html_(self) -> str:
        try:
            page = self.to_html()
        except _core.IoError as error:
            return f"<p>{self!r}</p><p>No replay: {error}</p>"
        source = base64.b64encode(page.encode()).decode()
        return (f'<iframe src="data:text/html;base64,{source}" style="width:100%;height:480px;border:0" '
                f'title="Replay of {self.file.name}"></iframe>')

    def __repr__(self) -> str:
        return f"<cairn.Recording '{self.file}': {len(self)} frames of {self.info.bodies} bodies>"


def _program() -> str:
    """The command-line program: that of the variable CAIRN_PROGRAM, or the one on the PATH. Raises IoError."""
    program = os.environ.get("CAIRN_PROGRAM") or shutil.which("cairn")
    if program is None:
        raise _core.IoError("pages are made by the program 'cairn', which is not on the PATH; install it "
                            "('make install') or name it in the variable CAIRN_PROGRAM")
    return program
