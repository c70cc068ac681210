"""
A tower of 40 boxes
===================

Boxes upon boxes are hard for solvers by impulses, since every contact has to bear all that is above it. The tower stands
also when nobody may sleep; what its lowest contacts bear is the weight above them.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
HEIGHT = 10 if SHORT else 40
G = 9.81

settings = cairn.Settings.preset("performance", gravity=G).replace(sleeping=False, damping=0)
world = cairn.World(settings)
world.gravity = 0, 0, -G
oak = world.add_material("oak", 800)
world.set_default_pair_properties(restitution=0, static_friction=0.5, kinetic_friction=0.5)
world.add_body(cairn.HalfSpace(), oak, fixed=True)
for i in range(HEIGHT):
    world.add_body(cairn.Box([0.2, 0.2, 0.2]), oak, position=[0, 0, 0.1 + 0.2 * i])

# %%
# How far the top has moved sideways, over ten seconds.
times, drift = [], []
while world.time < (1 if SHORT else 10):
    world.step(8)
    times.append(world.time)
    drift.append(float(np.hypot(*world.bodies.centre_of_mass[HEIGHT, :2])))
assert max(drift) < 5e-3

# %%
# The impulses of a step, divided by its length, are forces: one row of the structured array for each point of contact.
contacts = world.contacts()
lower_body = contacts["a"]["index"]
force = np.bincount(lower_body, -contacts["impulse"][:, 2], minlength=HEIGHT) * settings.steps_per_second
weight = 800 * 0.2**3 * G * np.arange(HEIGHT, 0, -1)
assert np.allclose(force, weight, rtol=0.05)

fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
left.plot(times, 1e3 * np.array(drift), color="0.2")
left.set_xlabel("time [s]")
left.set_ylabel("displacement of the top box [mm]")
right.plot(weight / 1e3, np.arange(HEIGHT), "-", color="0.5", label="weight above")
right.plot(force / 1e3, np.arange(HEIGHT), "x", label="force of the contacts")
right.set_xlabel("force [kN]")
right.set_ylabel("contact, from below")
right.legend()
fig.tight_layout()
plt.show()
