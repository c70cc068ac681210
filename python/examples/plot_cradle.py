"""
Newton's cradle and its energy
==============================

Five steel balls hang side by side. With impacts passed on one after the other, the ball that strikes is answered by the
one at the other end, and the energy that is put in stays.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ

settings = cairn.Settings.preset("accuracy", gravity=9.81).replace(
    impacts="sequential", exact_flight=True, damping=0, sleeping=False
)
world = cairn.World(settings)
world.gravity = 0, 0, -9.81
steel = world.add_material("steel", 7800)
world.set_default_pair_properties(restitution=1, static_friction=0, kinetic_friction=0)

# %%
# Each ball hangs on a rod without mass; the first one is raised by 40 degrees.
RADIUS, LENGTH = 0.02, 0.3
balls = []
for i in range(5):
    tilt = math.radians(40) if i == 0 else 0
    top = np.array([2 * RADIUS * i, 0, 0])
    centre = top - LENGTH * np.array([math.sin(tilt), 0, math.cos(tilt)])
    ball = world.add_body(cairn.Sphere(RADIUS), steel, position=centre)
    world.add_joint("distance", ball, anchor=centre, anchor_b=top)
    balls.append(ball.index)

times, places, energies = [], [], []
while world.time < (1.5 if SHORT else 4):
    world.step(4)
    times.append(world.time)
    places.append(world.bodies.centre_of_mass[balls, 0].copy())
    energies.append(world.kinetic_energy() + world.potential_energy())

# %%
# The energy is that of the beginning to a part in a thousand of what the first ball had.
lifted = world.mass(cairn.BodyId(balls[0], 0)) * 9.81 * LENGTH * (1 - math.cos(math.radians(40)))
change = (np.array(energies) - energies[0]) / lifted
assert abs(change).max() < 1e-3

fig, (upper, lower) = plt.subplots(2, 1, figsize=(7, 5), sharex=True)
for i, style in ((0, "-"), (2, ":"), (4, "--")):
    upper.plot(times, np.array(places)[:, i] - 2 * RADIUS * i, style, label=f"ball {i + 1}")
upper.set_ylabel("displacement [m]")
upper.legend(loc="upper right")
lower.plot(times, 1e6 * change, "-", color="0.3")
lower.set_xlabel("time [s]")
lower.set_ylabel("change of energy\n[10⁻⁶ of that put in]")
fig.tight_layout()
plt.show()
