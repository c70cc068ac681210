"""
A block that rocks
==================

Housner (1963) solved the free rocking of a slender block: a quarter of its period grows with the amplitude, and each
impact takes a fixed part of the energy..
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ

# %%
# A block of half width b and half height h turns about its edges, at the distance R from its centre of mass. At the
# angle α it would fall over.
G = 9.81
B, H = 0.1, 0.4
R, ALPHA = math.hypot(B, H), math.atan(B / H)
RATE = math.sqrt(3 * G / (4 * R))

settings = cairn.Settings.preset("accuracy", steps_per_second=2000, gravity=G).replace(damping=0, sleeping=False)


def rock(tilt: float) -> tuple[list[float], list[float]]:
    """The tilt over time [s], [rad], of a block that is let go tilted about its right edge."""
    world = cairn.World(settings)
    world.gravity = 0, 0, -G
    stone = world.add_material("stone", 2000)
    world.set_default_pair_properties(restitution=0, static_friction=1, kinetic_friction=1)
    world.add_body(cairn.HalfSpace(), stone, fixed=True)
    cosine, sine = math.cos(tilt), math.sin(tilt)
    block = world.add_body(
        cairn.Box([2 * B, 0.2, 2 * H]),
        stone,
        position=[B - cosine * B + sine * H, 0, sine * B + cosine * H],
        orientation=[math.cos(tilt / 2), 0, math.sin(tilt / 2), 0],
    )
    times, tilts = [0.0], [tilt]
    while world.time < (1 if SHORT else 4):
        world.step()
        _, _, y, _ = q = world.pose(block).orientation
        times.append(world.time)
        tilts.append(2 * math.atan2(y, q[0]))
    return times, tilts


# %%
# The first passage through the upright position ends a quarter of a period.
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
amplitudes = [0.2, 0.5, 0.8] if SHORT else [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
quarters = []
for amplitude in amplitudes:
    times, tilts = rock(amplitude * ALPHA)
    quarters.append(next(t for t, tilt in zip(times, tilts) if tilt < 0))
    if amplitude in (0.2, 0.5, 0.8):
        style = {0.2: ":", 0.5: "--", 0.8: "-"}[amplitude]
        left.plot(times, np.array(tilts) / ALPHA, style, label=f"released at {amplitude} α")
left.set_xlabel("time [s]")
left.set_ylabel("tilt / α")
left.legend()

closed = [math.acosh(1 / (1 - amplitude)) / RATE for amplitude in amplitudes]
assert np.allclose(quarters, closed, rtol=0.02)
right.plot(amplitudes, closed, "-", color="0.4", label="Housner 1963")
right.plot(amplitudes, quarters, "o", label="simulated")
right.set_xlabel("amplitude / α")
right.set_ylabel("quarter of the period [s]")
right.legend()
fig.tight_layout()
plt.show()
