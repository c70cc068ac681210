"""
Hello, ball
===========

A ball falls from one metre. After each bounce it rises to the square of the coefficient of restitution times the height
that it fell from; the time between two bounces shrinks by the coefficient itself.
"""

import os

import cairn
import matplotlib.pyplot as plt
import numpy as np

SHORT = "CAIRN_SHORT" in os.environ
RADIUS, HEIGHT, G = 0.05, 1.0, 9.81

# %%
# The preset for accuracy, with bodies that follow the parabola exactly and no damping of gravity, so that what is left
# is the law of the impact.


def scene(restitution: float) -> cairn.Scene:
    """A ball above the ground."""
    return cairn.Scene(
        "bounce",
        duration=1 if SHORT else 3,
        gravity=[0, 0, -G],
        materials=[cairn.Material("rubber", 1100)],
        default_pair=cairn.PairProperties(restitution=restitution),
        bodies=[
            cairn.SceneBody(cairn.HalfSpace(), "rubber", fixed=True),
            cairn.SceneBody(cairn.Sphere(RADIUS), "rubber", position=[0, 0, RADIUS + HEIGHT]),
        ],
        preset="accuracy",
        settings={"exact_flight": True, "restitution_speed": "touching", "damping": 0,
                  "sleeping": False},
    )


def heights(restitution: float) -> tuple[list[float], list[float]]:
    """Of the lowest point over time [s], [m]."""
    run = cairn.SceneRun(scene(restitution))
    times, z = [], []
    while run.world.time < run.scene.duration:
        run.step(4)
        times.append(run.world.time)
        z.append(float(run.world.bodies.centre_of_mass[1, 2]) - RADIUS)
    return times, z


# %%
# The dashed lines are the heights that the closed form predicts.
fig, axes = plt.subplots(figsize=(7, 4))
for restitution, style in ((0.9, "-"), (0.7, "-.")):
    times, z = heights(restitution)
    axes.plot(times, z, style, label=f"coefficient of restitution {restitution}")
    peaks = np.array([HEIGHT * restitution ** (2 * n) for n in range(1, 4)])
    # Sampled every 4 steps of 1/960 s, a peak is missed by less than 0.1 mm.
    fall = np.sqrt(2 * HEIGHT / G)
    ends = fall * (1 + 2 * np.cumsum([restitution**n for n in range(1, 4)]))
    for n, peak in enumerate(peaks):
        if ends[n] < times[-1]:
            between = [h for t, h in zip(times, z) if ends[n] - 2 * fall * restitution ** (n + 1) < t < ends[n]]
            assert abs(max(between) - peak) < 1e-3
        label = "closed form" if style == "-." and n == 0 else None
        axes.axhline(peak, color="0.6", linewidth=0.8, linestyle="--", zorder=0, label=label)
axes.set_xlabel("time [s]")
axes.set_ylabel("height above the ground [m]")
axes.legend()
fig.tight_layout()
plt.show()

# %%
# The run with 0.9 again, recorded. At the end of a cell, what it came to shows itself with its replay.
cairn.run(scene(0.9), record="bounce.h5")
