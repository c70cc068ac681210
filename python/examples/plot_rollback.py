"""
Roll back and replay, bit for bit
=================================

A world can be kept in memory in every step, taken back and run again. What comes then is what came before, bit by bit,
until something is changed.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ

run = cairn.SceneRun(cairn.built_in_scene("stacks5"))
world = run.world
ball = int(np.argmax(np.abs(world.bodies.linear_velocity).max(axis=1)))
world.step(120)

# %%
# The state is kept before the ball has gone through the last wall.
state = cairn.RollbackState()
world.keep(state)
steps = 120 if SHORT else 480


def go_on() -> tuple[list[float], list[int]]:
    """The place of the ball along x [m] and the hash of the state after each step."""
    places, hashes = [], []
    for _ in range(steps):
        world.step()
        places.append(float(world.bodies.centre_of_mass[ball, 0]))
        hashes.append(world.state_hash())
    return places, hashes


first, first_hashes = go_on()
world.load(state)
again, again_hashes = go_on()
assert first_hashes == again_hashes

# %%
# A millionth of a newton second makes another history: chaos, but the same chaos each time.
world.load(state)
id = next(id for id in world.bodies if id.index == ball)
world.apply_impulse(id, [1e-6, 0, 0])
other, other_hashes = go_on()
assert other_hashes[-1] != first_hashes[-1]

fig, axes = plt.subplots(figsize=(7, 4))
times = np.arange(steps) / world.settings.steps_per_second
difference = np.abs(np.array(other) - np.array(first))
axes.semilogy(times, np.maximum(difference, 1e-16), "-", label="with an impulse of 10⁻⁶ N s more")
axes.semilogy(times, np.maximum(np.abs(np.array(again) - np.array(first)), 1e-16), "--", label="the same again (0)")
axes.set_xlabel("time since the state [s]")
axes.set_ylabel("difference of the ball's place [m]")
axes.legend()
fig.tight_layout()
plt.show()

# %%
# What was played twice.
cairn.run("stacks5", duration=1 if SHORT else 2.5, record="rollback.h5")
