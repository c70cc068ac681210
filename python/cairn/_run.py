"""Whole runs: a scene from its beginning to its end, recorded if asked."""

import math
import time
from dataclasses import dataclass, field
from os import fspath
from pathlib import Path
from typing import Callable, Mapping, Optional, Union

from . import _core
from ._recording import Recording
from ._types import FilePath

SceneLike = Union[_core.Scene, FilePath]


@dataclass(frozen=True)
class Result:
    """What a run came to.

    - run: the scene in its world, as it is at the end.
    - statistics: of all time steps together.
    - seconds: wall time of the steps [s].
    - recording: what was recorded, or None.
    """

    run: _core.SceneRun = field(repr=False)
    statistics: _core.Statistics = field(repr=False)
    seconds: float
    recording: Optional[Recording] = None

    @property
    def world(self) -> _core.World:
        """The world at the end."""
        return self.run.world

    def __repr__(self) -> str:
        scene, world = self.run.scene, self.world
        text = (f"{scene.name}: {world.time:.6g} s of {world.body_count} bodies in {self.seconds:.3g} s, "
                f"{self.statistics.asleep} asleep, largest overlap {1e3 * self.statistics.largest_overlap:.3g} mm")
        return text + (f", recorded in {self.recording.file.name}" if self.recording else "")

    def _repr_html_(self) -> str:
        return f"<p>{self!r}</p>" + (self.recording._repr_html_() if self.recording else "")


def scene_of(scene: SceneLike) -> _core.Scene:
    """A scene as it is, the built-in one with a name, or that of a file. Raises InputError, IoError."""
    if isinstance(scene, _core.Scene):
        return scene
    name = fspath(scene)
    if isinstance(scene, str) and _core.is_built_in_scene(name):
        return _core.built_in_scene(name)
    return _core.read_scene(name)


def run(
    scene: SceneLike,
    *,
    duration: Optional[float] = None,
    record: Optional[FilePath] = None,
    preset: Union[_core.Preset, str, None] = None,
    steps_per_second: Optional[float] = None,
    settings: Optional[Mapping[str, object]] = None,
    hashes: bool = False,
    frame_rate: Optional[float] = None,
    contacts: bool = False,
    joints: bool = False,
    after_frame: Optional[Callable[[_core.SceneRun], None]] = None,
) -> Result:
    """Runs a scene to its end.

    - scene: a Scene, the name of a built-in one ("stacks5", "tower:20") or a scene file.
    - duration: in place of the scene's [s], > 0.
    - record: file for a recording.
    - preset, steps_per_second [1/s], settings: override the scene's, as "threads" or "iterations".
    - hashes: whether every time step's state hash is recorded, so that verify_recording() compares each.
    - frame_rate: frames of the recording per simulated second, at most one per time step; None = 30, if there are so many.
    - contacts, joints: whether contacts with impulses and forces of joints are recorded.
    - after_frame: called with the run after each frame, recorded or not.

    Raises InputError, IoError.
    """
    start = scene_of(scene)
    overrides = _core.SettingOverrides(preset=preset, steps_per_second=steps_per_second, fields=dict(settings or {}))
    chosen = _core.settings_for(start, overrides)
    scene_run = _core.SceneRun(start, chosen)
    if duration is not None:
        scene_run.set_duration(duration)
    # A duration such as 0.1 s is not exactly three simulation steps.
    simulation_steps = max(math.ceil(scene_run.scene.duration * _core.simulation_steps_per_second - 1e-6), 1)
    if frame_rate is None:
        frame_rate = min(_core.simulation_steps_per_second, chosen.steps_per_second)
    options = _core.RecordingOptions(
        hashes_per_frame=round(chosen.steps_per_second / frame_rate) if hashes else 0,
        frame_rate=frame_rate,
        contacts=contacts,
        joints=joints,
    )
    writer: Optional[_core.RecordingWriter] = None
    if record is not None:
        # A recording of that name which is still looked at, as where a cell of a notebook runs again, stays readable.
        Path(record).unlink(missing_ok=True)
        writer = _core.RecordingWriter(record, scene_run.scene, chosen, options)
        writer.append(_core.capture_frame(scene_run, what=options))
    end = (simulation_steps - 1e-6) / _core.simulation_steps_per_second
    total, seconds = _simulate(scene_run, end, writer, options, after_frame)
    if writer is not None:
        writer.close()
    return Result(scene_run, total, seconds, Recording(record) if record is not None else None)


def _simulate(
    scene_run: _core.SceneRun,
    end: float,
    writer: Optional[_core.RecordingWriter],
    options: _core.RecordingOptions,
    after_frame: Optional[Callable[[_core.SceneRun], None]],
) -> tuple[_core.Statistics, float]:
    total = _core.Statistics()
    since_frame = _core.Statistics()
    hashes: list[int] = []
    seconds = 0.0
    while scene_run.world.time < end:
        begin = time.perf_counter()
        scene_run.step()
        seconds += time.perf_counter() - begin
        now = scene_run.world.statistics
        total, since_frame = total + now, since_frame + now
        if options.hashes_per_frame:
            hashes.append(scene_run.world.state_hash())
        if not _core.is_frame_due(scene_run, options.frame_rate):
            continue
        if writer is not None:
            frame = _core.capture_frame(scene_run, since_frame, options)
            writer.append(frame.replace(step_hashes=hashes) if hashes else frame)
        since_frame, hashes = _core.Statistics(), []
        if after_frame is not None:
            after_frame(scene_run)
    return total, seconds
