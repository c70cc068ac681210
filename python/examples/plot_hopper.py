"""
A hopper against Beverloo's law
===============================

Grains leave a hopper at a rate that does not depend on how many are above the hole, unlike water. Beverloo, Leniger and
van de Velde (1961) measured seeds and found W = C ρ √g (D − k d)^(5/2) for a round hole of diameter D and grains of
diameter d: ρ is the density of the filling, C is 0.55 to 0.65, k is 1.2 to 1.6 for smooth grains.
"""

import math
import os

import cairn
import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt

SHORT = "CAIRN_SHORT" in os.environ
Floats = npt.NDArray[np.float64]
G, GRAIN, DENSITY = 9.81, 0.1, 2500.0
COUNT, WIDTH = (350, 9 * GRAIN) if SHORT else (1500, 12 * GRAIN)
SETTLED, BELOW = 1.2, -1.5

# %%
# The floor of the shaft has a round hole: its parts are the convex pieces between the hole and a square. A lid closes
# it until the grains have settled; an event of the scene takes the lid away.


def floor_with_hole(diameter: float) -> list[cairn.ConvexHull]:
    """32 pieces of a plate around a round hole. diameter: [m]"""
    angles = np.linspace(0, 2 * math.pi, 33)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    # The sides of the polygon touch the circle on average: area of a circle of this diameter.
    inner = ring * diameter / 2 * math.sqrt(math.pi / (16 * math.sin(math.pi / 16)))
    outer = ring * WIDTH / np.abs(ring).max(axis=1, keepdims=True)
    return [
        cairn.ConvexHull([[*corner, z] for corner in (inner[i], inner[i + 1], outer[i], outer[i + 1])
                          for z in (-0.05, 0)])
        for i in range(32)
    ]


def scene(hole: float) -> cairn.Scene:
    """A shaft of grains above a round hole. hole: its diameter [grains]"""
    random = np.random.default_rng(1)
    across = int(WIDTH / (1.15 * GRAIN))
    pitch = WIDTH / across
    cells = np.array([[i % across, i // across % across, i // across**2] for i in range(COUNT)])
    places = (cells + 0.5) * pitch - [WIDTH / 2, WIDTH / 2, -0.1] + random.uniform(-0.05, 0.05, (COUNT, 3)) * GRAIN
    # Sizes differ by a tenth, so that the grains do not stack as in a crystal.
    radii = GRAIN / 2 * random.uniform(0.9, 1.1, COUNT)
    walls = [cairn.HalfSpace(normal, -WIDTH / 2) for normal in ([1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0])]
    lid = cairn.Cylinder(radius=(hole + 1) * GRAIN / 2, length=0.05)
    return cairn.Scene(
        "hopper",
        duration=SETTLED + (1.5 if SHORT else 4),
        gravity=[0, 0, -G],
        materials=[cairn.Material("glass", DENSITY)],
        default_pair=cairn.PairProperties(restitution=0.3, static_friction=0.4, kinetic_friction=0.4),
        bodies=[
            cairn.SceneBody(lid, "glass", position=[0, 0, -0.076], fixed=True),
            *(cairn.SceneBody(shape, "glass", fixed=True) for shape in walls),
            *(cairn.SceneBody(piece, "glass", fixed=True) for piece in floor_with_hole(hole * GRAIN)),
            *(cairn.SceneBody(cairn.Sphere(radius), "glass", position=place) for radius, place in zip(radii, places)),
        ],
        events=[cairn.SceneEvent(SETTLED, cairn.RemoveBody(0))],
        settings={"steps_per_second": 480, "penetration_threshold": 1e-3, "sleeping": False, "damping": 0},
    )


# %%
# What has fallen out is taken away after each simulation step of 1/30 s: in the recording its position is no number
# from then on.
GRAINS = slice(5 + 32, None)


def take_away(run: cairn.SceneRun) -> None:
    height = run.world.bodies.centre_of_mass[:, 2]
    for id in run.ids[GRAINS]:
        if id in run.world and height[id.index] < BELOW:
            run.world.remove_body(id)


def discharge(hole: float) -> tuple[cairn.Recording, Floats]:
    """The recording, and the masses of the grains [kg]."""
    result = cairn.run(scene(hole), record=f"hopper-{hole:g}.h5", after_frame=take_away)
    recording = result.recording
    assert recording is not None
    shapes = [body.shape for body in result.run.scene.bodies[GRAINS]]
    radii = np.array([shape.radius for shape in shapes if isinstance(shape, cairn.Sphere)])
    masses = DENSITY * 4 / 3 * math.pi * radii**3
    return recording, masses


# %%
# The law wants the density of the filling: what is in a slab above the floor, just before the lid goes. The rate is the
# slope between a tenth and a half of what is inside.


def density_of_filling(recording: cairn.Recording, masses: Floats) -> float:
    """[kg/m³]"""
    centre = recording[int(SETTLED * cairn.simulation_steps_per_second) - 1].position[GRAINS]
    # Walls keep the centres of grains away: the slab ends a grain from them.
    half = WIDTH / 2 - GRAIN
    inside = (np.abs(centre[:, :2]) < half).all(axis=1) & (centre[:, 2] > GRAIN) & (centre[:, 2] < 4 * GRAIN)
    return float(masses[inside].sum() / ((2 * half) ** 2 * 3 * GRAIN))


# %%
# The widths of the holes are in grains, the rates W / (ρ √(g d⁵)).
fig, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
holes = np.array([5, 6] if SHORT else [4, 5, 6, 7])
rates = []
for hole, style in zip(holes, (":", "-.", "--", "-")):
    recording, masses = discharge(hole)
    height, times = recording.position[:, GRAINS, 2], recording.time[:]
    out = (np.isnan(height) | (height < -GRAIN)) @ masses
    steady = (out > 0.1 * masses.sum()) & (out < 0.5 * masses.sum())
    density = density_of_filling(recording, masses)
    rates.append(float(np.polyfit(times[steady], out[steady], 1)[0]) / (density * math.sqrt(G * GRAIN**5)))
    left.plot(times - SETTLED, out, style, color="0.2", label=f"D = {hole} d")
left.set_xlabel("time since the lid is gone [s]")
left.set_ylabel("mass that has left [kg]")
left.set_xlim(left=0)
left.legend()
# To the power of 2/5 the rates lie on a line that meets the axis at k, and its slope tells C.
slope, intercept = np.polyfit(holes, np.array(rates) ** 0.4, 1)
assert abs(np.array(rates) / (0.58 * (holes - 1.4) ** 2.5) - 1).max() < 0.3
print(f"density of the filling {density:.0f} kg/m³")
sizes = np.linspace(1.6, 7.4, 50)
right.fill_between(sizes, 0.55**0.4 * (sizes - 1.6), 0.65**0.4 * (sizes - 1.2), color="0.85",
                   label="Beverloo: C = 0.55 to 0.65, k = 1.2 to 1.6")
fitted = f"C = {slope ** 2.5:.2f}, k = {-intercept / slope:.2f}"
right.plot(sizes, slope * sizes + intercept, "-", color="0.4", label=fitted)
right.plot(holes, np.array(rates) ** 0.4, "o", color="0.1", label="simulated")
right.set_xlabel("diameter of the hole D / d")
right.set_ylabel("(W / (ρ √(g d⁵)))^(2/5)")
right.legend(loc="lower right")
fig.tight_layout()
plt.show()

# %%
# The widest hole.
recording
