"""
A tower of 40 boxes
===================

Boxes upon boxes are hard for solvers by impulses, since every contact has to bear all that is above it. The tower
stands also when nobody may sleep; what its lowest contacts bear is the weight above them.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
HEIGHT = 10 if SHORT else 40
G, EDGE, DENSITY = 9.81, 0.2, 800.0

scene = cairn.Scene(
    "tower",
    duration=1 if SHORT else 10,
    gravity=[0, 0, -G],
    materials=[cairn.Material("oak", DENSITY)],
    default_pair=cairn.PairProperties(restitution=0, static_friction=0.5, kinetic_friction=0.5),
    bodies=[
        cairn.SceneBody(cairn.HalfSpace(), "oak", fixed=True),
        *(cairn.SceneBody(cairn.Box([EDGE] * 3), "oak", position=[0, 0, EDGE * (i + 0.5)]) for i in range(HEIGHT)),
    ],
    settings={"sleeping": False, "damping": 0},
)
result = cairn.run(scene, record="tower.h5")
recording = result.recording
assert recording is not None

# %%
# How far the top has moved sideways, over ten seconds: the recording gives arrays of all its frames.
drift = np.hypot(recording.position[:, HEIGHT, 0], recording.position[:, HEIGHT, 1])
assert drift.max() < 5e-3

# %%
# The impulses of a step, divided by its length, are forces: one row of the structured array for each point of contact.
contacts = result.world.contacts()
lower_body = contacts["a"]["index"]
steps_per_second = result.world.settings.steps_per_second
force = np.bincount(lower_body, -contacts["impulse"][:, 2], minlength=HEIGHT) * steps_per_second
weight = DENSITY * EDGE**3 * G * np.arange(HEIGHT, 0, -1)
assert np.allclose(force, weight, rtol=0.05)

fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
left.plot(recording.time[:], 1e3 * drift, color="0.2")
left.set_xlabel("time [s]")
left.set_ylabel("displacement of the top box [mm]")
right.plot(weight / 1e3, np.arange(HEIGHT), "-", color="0.5", label="weight above")
right.plot(force / 1e3, np.arange(HEIGHT), "x", label="force of the contacts")
right.set_xlabel("force [kN]")
right.set_ylabel("contact, from below")
right.legend()
fig.tight_layout()
plt.show()

# %%
# The recording shows itself: nothing moves, which is the point.
recording
