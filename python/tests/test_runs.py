"""Scenes, whole runs, recordings and sweeps."""

import pickle
import stat
from pathlib import Path
from typing import Any

import cairn
import numpy as np
import pytest


def pyramid(layers: int = 3) -> cairn.Scene:
    boxes = [cairn.SceneBody(cairn.Box([0.2] * 3), "oak", position=[0.21 * i - 0.105 * layer, 0, 0.1 + 0.2 * layer])
             for layer in range(layers) for i in range(layer, layers)]
    floor = cairn.SceneBody(cairn.HalfSpace(), "oak", fixed=True)
    return cairn.Scene("pyramid", 0.5, gravity=[0, 0, -10], materials=[cairn.Material("oak", 800)],
                       default_pair=cairn.PairProperties(restitution=0), bodies=[floor, *boxes],
                       events=[cairn.SceneEvent(0.2, cairn.GiveImpulse(1, [1, 0, 0]))],
                       pairs={("oak", "oak"): cairn.PairProperties(0.1, 0.5, 0.4)},
                       settings={"threads": 1, "shock_propagation": True, "resolution": "arbitrary_order"})


def test_a_scene_built_in_python_is_written_as_json_and_read_again(tmp_path: Path) -> None:
    scene = pyramid()
    cairn.write_scene(scene, tmp_path / "pyramid.json")
    again = cairn.read_scene(tmp_path / "pyramid.json")
    assert again.bodies == scene.bodies and again.events == scene.events and again.pairs == scene.pairs
    assert cairn.parse_scene(cairn.format_scene(scene)) == again
    assert dict(again.settings)["shock_propagation"] is True
    assert pickle.loads(pickle.dumps(scene)) == scene
    with pytest.raises(cairn.InputError, match="here"):
        cairn.parse_scene("{", source="here")


def test_built_in_scenes() -> None:
    scenes = cairn.built_in_scenes()
    assert len(scenes) > 5 and all(cairn.is_built_in_scene(scene.example) for scene in scenes)
    with pytest.raises(cairn.InputError):
        cairn.built_in_scene("no such scene")


def test_a_run_goes_to_its_end(tmp_path: Path) -> None:
    seen: list[float] = []
    result = cairn.run(pyramid(), record=tmp_path / "run.h5", settings={"threads": 2},
                       after_frame=lambda run: seen.append(run.world.time))
    assert len(seen) == 15 and result.world.time == pytest.approx(0.5)
    assert "pyramid" in repr(result) and result.world.settings.parallel.threads == 2
    assert result.statistics.contacts > 0
    cairn.write_scene(pyramid(), tmp_path / "scene.json")
    from_file = cairn.run(tmp_path / "scene.json", duration=0.1, preset="accuracy")
    assert from_file.world.time == pytest.approx(0.1) and from_file.recording is None
    assert cairn.run("tower:2", duration=1 / 30, steps_per_second=300).world.step_count == 10
    resting = cairn.run("tower:3", duration=1)
    assert resting.statistics.asleep == resting.world.bodies.asleep.sum() == 3 and "3 asleep" in repr(resting)
    with pytest.raises(OSError):
        cairn.run("no such scene")
    with pytest.raises(cairn.InputError):
        cairn.run("tower:2", duration=-1)


def test_recordings_are_read_as_arrays(tmp_path: Path) -> None:
    recording = cairn.run(pyramid(), record=tmp_path / "run.h5", hashes=True).recording
    assert recording is not None and len(recording) == 16
    position = recording.position
    assert position.shape == (16, 7, 3)
    whole = np.asarray(position)
    assert whole.shape == position.shape
    frames = list(recording)
    assert (whole[3] == frames[3].position).all() and (position[3] == whole[3]).all()
    keys: tuple[Any, ...] = (np.s_[2:9:3], np.s_[-1], np.s_[:, 4], np.s_[1, 2], np.s_[3:5, :, 2], np.s_[[0, 5]],
                             np.s_[..., 2], np.s_[-4:, 1:3])
    for key in keys:
        assert np.array_equal(position[key], whole[key]), key
    assert recording.time[:] == pytest.approx(np.arange(16) / 30)
    assert recording.orientation[0, 0].tolist() == [1, 0, 0, 0]
    assert recording.asleep.shape == (16, 7) and recording.scene == recording.info.scene
    assert recording[-1].kinetic_energy == recording.kinetic_energy[15]
    assert recording.verify() is None
    with pytest.raises(IndexError):
        recording[16]
    assert recording.to_csv(tmp_path / "run.csv").read_text().startswith("frame,time")
    assert recording.to_vtk(tmp_path / "run.pvd").exists()
    with pytest.raises(cairn.IoError):
        cairn.Recording(tmp_path / "none.h5")


def test_forces_are_recorded_at_any_rate(tmp_path: Path) -> None:
    scene = cairn.Scene(
        name="forces", duration=1, gravity=[0, 0, -10], materials=[cairn.Material("oak", 800)],
        bodies=[cairn.SceneBody(cairn.HalfSpace([0, 0, 1], 0), "oak", fixed=True),
                cairn.SceneBody(cairn.Sphere(0.1), "oak", mass=1, position=[0, 0, 0.1]),
                cairn.SceneBody(cairn.Sphere(0.1), "oak", mass=2, position=[2, 0, 1])],
        joints=[cairn.SceneJoint(2, None, cairn.JointDescription("ball", cairn.BodyId(), anchor=[2, 0, 1]))],
        settings={"sleeping": False, "damping": 0.0})
    recording = cairn.run(scene, record=tmp_path / "run.h5", frame_rate=50, contacts=True, joints=True).recording
    assert recording is not None and len(recording) == 51 and recording.info.frame_rate == 50
    last = recording[-1]
    assert last.contact_a.tolist() == [0] and last.contact_b.tolist() == [1]
    steps = cairn.settings_for(scene).steps_per_second
    assert last.contact_impulse[0, 2] * steps == pytest.approx(-10)
    assert recording.joint_force.shape == (51, 1, 3) and recording.joint_force[-1][0, 2] == pytest.approx(20)
    with pytest.raises(cairn.InputError):
        cairn.run(scene, record=tmp_path / "other.h5", frame_rate=1e6)


def test_frames_are_written_one_by_one(tmp_path: Path) -> None:
    run = cairn.SceneRun(pyramid())
    with cairn.RecordingWriter(tmp_path / "run.h5", run.scene, run.world.settings) as writer:
        writer.append(cairn.capture_frame(run))
        writer.append(cairn.capture_frame(run, run.simulation_step()))
    frames = list(cairn.Recording(tmp_path / "run.h5"))
    assert len(frames) == 2 and frames[1].time == pytest.approx(1 / 30)
    assert (frames[1].linear_velocity == cairn.capture_frame(run).linear_velocity).all()


def test_h5py_reads_recordings_in_the_same_process(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    recording = cairn.run(pyramid(), record=tmp_path / "run.h5").recording
    assert recording is not None
    with h5py.File(tmp_path / "run.h5") as file:
        assert len(list(file)) > 0
    assert (recording.position[0] == recording.position[0]).all()


def test_runs_are_kept_and_go_on(tmp_path: Path) -> None:
    run = cairn.SceneRun(pyramid())
    run.step(50)
    cairn.write_checkpoint(run, tmp_path / "run.checkpoint")
    others = [cairn.read_checkpoint(tmp_path / "run.checkpoint"), pickle.loads(pickle.dumps(run)),
              cairn.SceneRun.restore(run.save())]
    run.step(50)
    for other in others:
        other.step(50)
        assert other.world.state_hash() == run.world.state_hash()
    steps = run.steps_per_simulation_step
    statistics, hashes = run.hashed_simulation_step()
    assert len(hashes) == steps and hashes[-1] == run.world.state_hash()
    assert statistics.contacts > 0 and len(run.ids) == 7


def test_a_run_can_be_recorded_anew_while_its_recording_is_looked_at(tmp_path: Path) -> None:
    first = cairn.run("tower:2", duration=0.2, record=tmp_path / "run.h5").recording
    assert first is not None
    second = cairn.run("tower:3", duration=0.1, record=tmp_path / "run.h5").recording
    assert second is not None
    assert (len(first), len(second)) == (7, 4)
    assert first.position[:].shape == (7, 3, 3) and second.position[:].shape == (4, 4, 3)


def test_a_replay_is_made_by_the_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recording = cairn.run("tower:2", duration=0.1, record=tmp_path / "run.h5").recording
    assert recording is not None
    monkeypatch.setenv("CAIRN_PROGRAM", "")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(cairn.IoError, match="make install"):
        recording.to_html()
    assert "No replay" in recording._repr_html_()
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\n[ \"$1 $3\" = 'export --html' ] && echo '<p>replay</p>' > \"$4\"\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("CAIRN_PROGRAM", str(program))
    assert "replay" in recording.to_html(tmp_path / "page.html")
    assert (tmp_path / "page.html").exists() and "<iframe" in recording._repr_html_()


def slide(friction: float, speed: float) -> cairn.World:
    world = cairn.World()
    world.gravity = 0, 0, -10
    oak = world.add_material("oak", 800)
    world.set_default_pair_properties(restitution=0, static_friction=friction, kinetic_friction=friction)
    world.add_body(cairn.HalfSpace(), oak, fixed=True)
    world.add_body(cairn.Box([0.2, 0.2, 0.1]), oak, position=[0, 0, 0.05], linear_velocity=[speed, 0, 0])
    return world


def distance(world: cairn.World) -> dict[str, float]:
    world.step(60)
    return {"distance": float(world.bodies.centre_of_mass[1, 0]), "hash": world.state_hash()}


def test_a_sweep_measures_every_choice_as_it_would_be_alone(tmp_path: Path) -> None:
    parameters = {"friction": [0.1, 0.3, 0.6], "speed": [1.0, 2.0]}
    table = cairn.sweep(slide, parameters, distance, workers=3)
    assert len(table) == 6 and table.names == ("friction", "speed", "distance", "hash")
    for row in table:
        assert distance(slide(row["friction"], row["speed"]))["hash"] == row["hash"]
    assert (np.diff(table.column("distance")[::2]) < 0).all()
    assert "friction" in repr(table) and "<table>" in table._repr_html_()
    assert len(table[1:3]) == 2


def test_a_sweep_goes_on_where_it_stopped(tmp_path: Path) -> None:
    file = tmp_path / "sweep.jsonl"
    calls: list[float] = []

    def measure(world: cairn.World) -> float:
        calls.append(1)
        if len(calls) == 3:
            raise RuntimeError("stopped")
        return distance(world)["distance"]

    parameters = [{"friction": friction, "speed": 1.0} for friction in (0.1, 0.2, 0.3, 0.4)]
    with pytest.raises(RuntimeError, match="stopped"):
        cairn.sweep(slide, parameters, measure, workers=1, store=file)
    done = len(file.read_text().splitlines())
    assert 2 <= done <= 3
    with file.open("a") as out:
        out.write('{"parameters": {"fric')
    before = len(calls)
    table = cairn.sweep(slide, parameters, measure, workers=1, store=file)
    assert len(calls) - before == 4 - done
    assert table.column("result").shape == (4,)
    assert len(cairn.sweep(slide, parameters, measure, store=file)) == 4 and len(calls) - before == 4 - done
    file.write_text("no row\n")
    with pytest.raises(cairn.InputError, match="no row of a sweep"):
        cairn.sweep(slide, parameters, measure, store=file)
