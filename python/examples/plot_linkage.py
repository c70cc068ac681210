"""
A slider-crank
==============

A motor turns a crank, a rod drives a block along a rail. Joints hold at any time, not after iterations, so the block is
where the closed form says at every step.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
CRANK, ROD = 0.2, 0.5

# %%
# Bodies are joined where they stand: all in a line along x. Nothing collides in the mechanism, since joined bodies do
# not touch each other.
y = [0, 1, 0]
motor = cairn.JointMotor(speed=2 * math.pi, limit=1e4)
scene = cairn.Scene(
    "slider-crank",
    duration=0.5 if SHORT else 2,
    materials=[cairn.Material("steel", 7800)],
    bodies=[
        cairn.SceneBody(cairn.Box([CRANK, 0.02, 0.02]), "steel", "crank", position=[CRANK / 2, 0, 0]),
        cairn.SceneBody(cairn.Box([ROD, 0.02, 0.02]), "steel", "rod", position=[CRANK + ROD / 2, 0, 0]),
        cairn.SceneBody(cairn.Box([0.05, 0.05, 0.05]), "steel", "block", position=[CRANK + ROD, 0, 0]),
    ],
    joints=[
        cairn.SceneJoint(0, None, cairn.JointDescription("hinge", anchor=[0, 0, 0], axis=y, motor=motor)),
        cairn.SceneJoint(1, 0, cairn.JointDescription("hinge", anchor=[CRANK, 0, 0], axis=y)),
        cairn.SceneJoint(2, 1, cairn.JointDescription("hinge", anchor=[CRANK + ROD, 0, 0], axis=y)),
        cairn.SceneJoint(2, None, cairn.JointDescription("slider", anchor=[CRANK + ROD, 0, 0], axis=[1, 0, 0])),
    ],
    preset="accuracy",
    settings={"sleeping": False, "damping": 0},
)
run = cairn.SceneRun(scene)
world = run.world
axle = world.joints()[0]
times, angles, places = [], [], []
while world.time < scene.duration:
    run.step()
    times.append(world.time)
    angles.append(world.joint(axle).position)
    places.append(float(world.bodies.centre_of_mass[2, 0]))

# %%
# With the crank at the angle θ, the block is at r cos θ + √(l² − r² sin² θ).
angle = np.array(angles)
closed = CRANK * np.cos(angle) + np.sqrt(ROD**2 - (CRANK * np.sin(angle)) ** 2)
error = np.abs(np.array(places) - closed)
assert error.max() < 1e-3

fig, (upper, lower) = plt.subplots(2, 1, figsize=(7, 5), sharex=True)
upper.plot(times, closed, "-", color="0.6", linewidth=3, label="closed form")
upper.plot(times, places, "--", color="0.1", label="simulated")
upper.set_ylabel("place of the block [m]")
upper.legend()
lower.semilogy(times, np.maximum(error, 1e-17), color="0.3")
lower.set_xlabel("time [s]")
lower.set_ylabel("difference [m]")
fig.tight_layout()
plt.show()

# %%
# The mechanism in motion.
cairn.run(scene, record="linkage.h5")
