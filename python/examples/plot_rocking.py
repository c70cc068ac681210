"""
Rocking blocks on a shake table
===============================

Housner (1963) asked why slender things outlived earthquakes that threw sturdier ones over. A block that rocks has no
period of its own: a quarter of it grows with the amplitude. And of two blocks of the same proportions the larger one
stands more: to throw it over, the ground must push longer, not only harder.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

SHORT = "CAIRN_SHORT" in os.environ
Floats = npt.NDArray[np.float64]
G = 9.81

# A block of half width b and half height h turns about its edges, at the distance R from its centre of mass. At the
# angle α it would fall over.
SLENDERNESS = 0.15
ALPHA = math.atan(SLENDERNESS)
FRICTION = cairn.PairProperties(restitution=0, static_friction=1, kinetic_friction=1)


def rate(h: float) -> float:
    """p of a block, with which it falls over exponentially [1/s]."""
    return math.sqrt(3 * G / (4 * math.hypot(SLENDERNESS * h, h)))


def tilts(orientations: Floats) -> Floats:
    """About y, of quaternions (w, x, y, z) [rad]."""
    angles: Floats = 2.0 * np.arctan2(orientations[..., 2], orientations[..., 0])
    return angles


def scene(blocks: list[cairn.SceneBody], ground: cairn.SceneBody, duration: float) -> cairn.Scene:
    return cairn.Scene(
        "rocking",
        duration=duration,
        gravity=[0, 0, -G],
        materials=[cairn.Material("stone", 2000)],
        default_pair=FRICTION,
        bodies=[ground, *blocks],
        preset="accuracy",
        settings={"steps_per_second": 1920, "damping": 0, "sleeping": False},
    )


def block(h: float, y: float = 0, tilt: float = 0) -> cairn.SceneBody:
    """Of half height h [m], at y [m], tilted about its right edge [rad]."""
    b, cosine, sine = SLENDERNESS * h, math.cos(tilt), math.sin(tilt)
    return cairn.SceneBody(
        cairn.Box([2 * b, 0.5 * h, 2 * h]),
        "stone",
        position=[b - cosine * b + sine * h, y, sine * b + cosine * h],
        orientation=[math.cos(tilt / 2), 0, math.sin(tilt / 2), 0],
    )


# %%
# Let go tilted, a block rocks. The first passage through the upright position ends a quarter of a period.
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
amplitudes = [0.2, 0.5, 0.8] if SHORT else [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
still = cairn.SceneBody(cairn.HalfSpace(), "stone", fixed=True)
quarters = []
for amplitude in amplitudes:
    run = cairn.SceneRun(scene([block(0.4, tilt=amplitude * ALPHA)], still, 1 if SHORT else 4))
    times, tilt = [], []
    while run.world.time < run.scene.duration:
        run.step()
        times.append(run.world.time)
        tilt.append(float(tilts(run.world.bodies.poses()[1][1])))
    quarters.append(next(t for t, angle in zip(times, tilt) if angle < 0))
    if amplitude in (0.2, 0.5, 0.8):
        style = {0.2: ":", 0.5: "--", 0.8: "-"}[amplitude]
        left.plot(times, np.array(tilt) / ALPHA, style, color="0.2", label=f"released at {amplitude} α")
left.set_xlabel("time [s]")
left.set_ylabel("tilt / α")
left.legend()
closed = [math.acosh(1 / (1 - amplitude)) / rate(0.4) for amplitude in amplitudes]
assert np.allclose(quarters, closed, rtol=0.02)
right.plot(amplitudes, closed, "-", color="0.4", label="Housner 1963")
right.plot(amplitudes, quarters, "o", color="0.1", label="simulated")
right.set_xlabel("amplitude / α")
right.set_ylabel("quarter of the period [s]")
right.legend()
fig.tight_layout()
plt.show()

# %%
# Now the ground is a table that is pushed by a constant acceleration for a while, and goes on at constant speed. Of a
# slender block Housner found that the least acceleration a which throws it over by a pulse of the length t obeys
# e^(p t) = x / (x − 1), where x = a / (g α).


def table(pulse: float, acceleration: float) -> cairn.SceneBody:
    """pulse: its length [s], acceleration: along x [m/s²]"""
    reach, speed = 100.0, acceleration * pulse
    ways = [[x, 0, 0] for x in (0, speed * pulse / 2, speed * (reach - pulse / 2))]
    motion = cairn.TableMotion([0, pulse, reach], ways, velocities=[[v, 0, 0] for v in (0, speed, speed)])
    return cairn.SceneBody(cairn.Box([3, 3, 0.1]), "stone", position=[0, 0, -0.05], fixed=True, motion=motion)


def falls(h: float, pulse: float, acceleration: float) -> bool:
    run = cairn.SceneRun(scene([block(h)], table(pulse, acceleration), 10))
    tilt = 0.0
    # A block that has turned by twice α, or rocked back by a third of it, has decided itself.
    while run.world.time < run.scene.duration and -2 * ALPHA < tilt < ALPHA / 3:
        run.step(8)
        tilt = float(tilts(run.world.bodies.poses()[1][1]))
    return tilt <= -2 * ALPHA


# %%
# Left, three blocks of the same proportions on the same table: the pulse throws two of them over. Right, the least
# acceleration that throws a block over, found by halving, for each length of the pulse.
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
pulse, acceleration = 0.3, 1.5 * G * ALPHA
three = [block(h, y) for h, y in ((0.2, -0.6), (0.4, 0), (0.8, 0.7))]
result = cairn.run(scene(three, table(pulse, acceleration), 3), record="rocking.h5")
recording = result.recording
assert recording is not None
for i, height, style in ((1, 0.4, ":"), (2, 0.8, "--"), (3, 1.6, "-")):
    over_time = np.minimum(np.abs(tilts(recording.orientation[:, i])) / ALPHA, 3)
    left.plot(recording.time[:], over_time, style, color="0.2", label=f"height {height} m")
left.set_xlabel("time [s]")
left.set_ylabel("tilt / α")
left.legend()

heights, pulses = ([0.4], [0.3]) if SHORT else ([0.2, 0.4, 0.8], [0.1, 0.2, 0.3, 0.45, 0.6])
time = np.linspace(0.08, 0.65)
for h, style, marker in zip(heights, (":", "--", "-"), "o^s"):
    right.plot(time, 1 / (1 - np.exp(-rate(h) * time)), style, color="0.5", label=f"Housner, height {2 * h:.1f} m")
    least = []
    for pulse in pulses:
        expected = 1 / (1 - math.exp(-rate(h) * pulse))
        lower, upper = 0.8 * expected, 1.25 * expected
        while upper - lower > 0.01 * expected:
            middle = (lower + upper) / 2
            lower, upper = (lower, middle) if falls(h, pulse, middle * G * ALPHA) else (middle, upper)
        least.append(upper)
        assert abs(upper / expected - 1) < 0.05
    right.plot(pulses, least, marker, color="0.1", label=f"simulated, height {2 * h:.1f} m")
right.set_xlabel("length of the pulse [s]")
right.set_ylabel("least acceleration that throws over / (g α)")
right.legend(fontsize=8)
fig.tight_layout()
plt.show()

# %%
# The same three.
recording
