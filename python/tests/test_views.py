"""Arrays of all bodies: without a copy, read-only, following the world, never dangling."""

import gc

import cairn
import numpy as np
import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule
from tools import ground, tower

NAMES = ("kind", "generation", "centre_of_mass", "principal_axes_xyzw", "linear_velocity", "angular_velocity", "mass",
         "asleep")


def test_arrays_say_what_the_calls_for_one_body_say() -> None:
    world = tower(5)
    lowest = list(world.bodies)[1]
    world.remove_body(lowest)
    world.step(20)
    bodies = world.bodies
    assert bodies.slots == 6 and len(bodies) == 5 and bodies.kind[1] == cairn.BodyKind.hole
    positions, orientations = bodies.poses()
    for id in bodies:
        i = id.index
        assert tuple(bodies.id[i]) == (id.index, id.generation) and bodies.generation[i] == id.generation
        assert (bodies.centre_of_mass[i] == world.centre_of_mass(id)).all()
        assert (bodies.principal_axes_xyzw[i][[3, 0, 1, 2]] == world.principal_axes(id)).all()
        assert (bodies.linear_velocity[i] == world.linear_velocity(id)).all()
        assert (bodies.angular_velocity[i] == world.angular_velocity(id)).all()
        assert bodies.asleep[i] == world.is_asleep(id)
        assert (positions[i] == world.pose(id).position).all()
        assert (orientations[i] == world.pose(id).orientation).all()
        if not world.is_fixed(id):
            assert bodies.mass[i] == world.mass(id)


def test_arrays_follow_the_step_without_a_copy_and_cannot_be_written() -> None:
    world = tower(3)
    velocity = world.bodies.linear_velocity
    assert np.shares_memory(velocity, world.bodies.linear_velocity)
    world.set_linear_velocity(cairn.BodyId(3, 0), [0, 0, 1])
    assert velocity[3, 2] == 1
    world.step()
    assert (velocity == world.bodies.linear_velocity).all()
    for name in NAMES:
        array = getattr(world.bodies, name)
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.flags.writeable = True
    with pytest.raises(AttributeError):
        world.bodies.linear_velocity = velocity  # type: ignore[misc]


def test_an_array_is_given_again_until_the_layout_changes() -> None:
    world = tower(3)
    velocity = world.bodies.linear_velocity
    world.step()
    assert world.bodies is world.bodies and world.bodies.linear_velocity is velocity
    # Its holder cannot write its numbers, but may look at them in another way: the others do not.
    velocity.shape = (12,)
    assert world.bodies.linear_velocity.shape == (4, 3)
    kind = world.bodies.asleep
    setattr(kind, "dtype", np.dtype(np.int8))
    assert world.bodies.asleep.dtype == np.dtype(bool)
    before = world.bodies.mass
    world.remove_body(cairn.BodyId(3, 0))
    assert world.bodies.mass is not before


def test_an_array_outlives_its_world() -> None:
    world = tower(3)
    position = world.bodies.centre_of_mass
    before = position.copy()
    del world
    others = [tower(3) for _ in range(20)]
    for other in others:
        other.step(3)
    gc.collect()
    assert (position == before).all()


def test_many_bodies_are_written_at_once() -> None:
    world = tower(3)
    ids = list(world.bodies)[1:]
    world.set_linear_velocities(ids, [[0, 0, 1]] * 3)
    assert (world.bodies.linear_velocity[1:] == [0, 0, 1]).all()
    world.set_linear_velocities(world.bodies.id[1:], np.zeros((3, 3)))
    assert not world.bodies.linear_velocity.any()
    world.set_poses(ids, world.bodies.poses()[0][1:] + [1, 0, 0], [[1, 0, 0, 0]] * 3)
    assert world.pose(ids[2]).position == pytest.approx([1, 0, 0.5])
    world.apply_impulses(ids, np.ones((3, 3)))
    with pytest.raises(cairn.InputError):
        world.apply_forces(ids, np.ones((2, 3)))
    with pytest.raises(TypeError):
        world.apply_forces(ids, np.ones((3, 2)))
    with pytest.raises(TypeError):
        world.apply_forces(np.arange(3), np.ones((3, 3)))  # type: ignore[arg-type]
    before = world.state_hash()
    with pytest.raises(cairn.InputError):
        world.set_angular_velocities(ids, np.diag([np.inf, 1.0, 1.0]))
    assert world.state_hash() == before
    world.wake(ids)
    world.wake(ids[0])
    world.set_constant_forces(ids, np.zeros((3, 3)))
    world.set_constant_torques(ids, np.zeros((3, 3)))
    world.apply_torques(ids, np.zeros((3, 3)))
    world.apply_angular_impulses(ids, np.zeros((3, 3)))


class OldArrays(RuleBasedStateMachine):
    """Keeps arrays while everything happens to their world: each goes on showing it, or what was there last."""

    def __init__(self) -> None:
        super().__init__()
        self.world, self.oak = ground()
        self.kept: list[np.ndarray] = []  # type: ignore[type-arg]
        self.moment = cairn.RollbackState()
        self.world.keep(self.moment)
        self.saved = self.world.save()

    @rule(count=st.integers(1, 40), height=st.floats(0.2, 5))
    def add(self, count: int, height: float) -> None:
        for i in range(count):
            self.world.add_body(cairn.Sphere(0.1), self.oak, position=[0.3 * i, 0, height])

    @rule(pick=st.integers(0, 10**6))
    def remove(self, pick: int) -> None:
        ids = list(self.world.bodies)[1:]
        if ids:
            self.world.remove_body(ids[pick % len(ids)])

    @rule(name=st.sampled_from(NAMES))
    def keep_array(self, name: str) -> None:
        self.kept.append(getattr(self.world.bodies, name))

    @rule()
    def step(self) -> None:
        self.world.step()

    @rule()
    def save(self) -> None:
        self.world.keep(self.moment)
        self.saved = self.world.save()

    @rule(whole=st.booleans())
    def load(self, whole: bool) -> None:
        before = self.world.layout_version
        self.world.load(self.saved if whole else self.moment)
        assert not whole or self.world.layout_version != before

    @rule()
    def replace_world(self) -> None:
        self.world = cairn.World.restore(self.saved)
        gc.collect()

    @invariant()
    def old_arrays_hold_numbers_of_bodies(self) -> None:
        for array in self.kept:
            # Of 8 bits, and of states that nobody wrote: whatever is read here must be there (address sanitizer).
            array.tobytes()
            if array.dtype == np.float64:
                assert np.isfinite(array).all()
        velocity = self.world.bodies.linear_velocity
        for id in self.world.bodies:
            assert (velocity[id.index] == self.world.linear_velocity(id)).all()


TestOldArrays = OldArrays.TestCase
TestOldArrays.settings = settings(max_examples=20, stateful_step_count=25, deadline=None, derandomize=True,
                                  suppress_health_check=list(HealthCheck))
