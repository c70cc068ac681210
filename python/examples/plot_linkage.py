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

settings = cairn.Settings.preset("accuracy", gravity=9.81).replace(sleeping=False, damping=0)
world = cairn.World(settings)
steel = world.add_material("steel", 7800)

# %%
# Bodies are joined where they stand: all in a line along x. Nothing collides in the mechanism, since joined bodies do not
# touch each other.
crank = world.add_body(cairn.Box([CRANK, 0.02, 0.02]), steel, position=[CRANK / 2, 0, 0])
rod = world.add_body(cairn.Box([ROD, 0.02, 0.02]), steel, position=[CRANK + ROD / 2, 0, 0])
block = world.add_body(cairn.Box([0.05, 0.05, 0.05]), steel, position=[CRANK + ROD, 0, 0])
motor = cairn.JointMotor(speed=2 * math.pi, limit=1e4)
axle = world.add_joint("hinge", crank, anchor=[0, 0, 0], axis=[0, 1, 0], motor=motor)
world.add_joint("hinge", rod, crank, anchor=[CRANK, 0, 0], axis=[0, 1, 0])
world.add_joint("hinge", block, rod, anchor=[CRANK + ROD, 0, 0], axis=[0, 1, 0])
world.add_joint("slider", block, anchor=[CRANK + ROD, 0, 0], axis=[1, 0, 0])

angles, places = [], []
while world.time < (0.5 if SHORT else 2):
    world.step()
    angles.append(world.joint(axle).position)
    places.append(float(world.bodies.centre_of_mass[block.index, 0]))

# %%
# With the crank at the angle θ, the block is at r cos θ + √(l² − r² sin² θ).
angle = np.array(angles)
closed = CRANK * np.cos(angle) + np.sqrt(ROD**2 - (CRANK * np.sin(angle)) ** 2)
error = np.abs(np.array(places) - closed)
assert error.max() < 1e-3

fig, (upper, lower) = plt.subplots(2, 1, figsize=(7, 5), sharex=True)
times = (1 + np.arange(len(places))) / settings.steps_per_second
upper.plot(times, closed, "-", color="0.6", linewidth=3, label="closed form")
upper.plot(times, places, "--", color="0.1", label="simulated")
upper.set_ylabel("place of the block [m]")
upper.legend()
lower.semilogy(times, np.maximum(error, 1e-17), color="0.3")
lower.set_xlabel("time [s]")
lower.set_ylabel("difference [m]")
fig.tight_layout()
plt.show()
