#!/usr/bin/python3
"""The wheel runs in a fresh environment with numpy alone, beside h5py with an HDF5 of its own.
Usage: test_wheel.py FOLDER    (everything is made there)"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DEBIAN = Path("/usr/lib/python3/dist-packages")

ALONE = """
import cairn
result = cairn.run("tower:3", duration=0.2, record="run.h5", hashes=True)
assert result.recording.verify() is None
maps = open("/proc/self/maps").read()
assert "cairn_physics.libs/libhdf5" in maps, "HDF5 is not the wheel's own"
for other in ("/usr/lib/x86_64-linux-gnu/libhdf5", "libcurl", "libssl", "libqhull_r.so"):
    assert other not in maps, other + " is loaded"
"""

# Either may be loaded first; each reads with its own HDF5, and a mistake of one is not the other's.
BESIDE = """
import {first}, {second}, cairn, h5py, numpy
result = cairn.run("tower:3", duration=0.2, record="run.h5")
with h5py.File("run.h5") as file:
    assert numpy.array_equal(file["frames/position"][3], result.recording.position[3])
for broken in (lambda: h5py.File("none.h5"), lambda: cairn.Recording("none.h5")):
    try:
        broken()
    except OSError:
        continue
    raise AssertionError("nothing was refused")
with h5py.File("other.h5", "w") as file:
    file["x"] = numpy.arange(10)
assert len(result.recording) == 7
maps = open("/proc/self/maps").read()
assert "cairn_physics.libs/libhdf5" in maps and "/usr/lib/x86_64-linux-gnu/libhdf5" in maps
"""


def main() -> None:
    folder = Path(sys.argv[1]).resolve()
    subprocess.run([ROOT / "tools" / "make_wheel", folder], check=True)
    environment = folder / "venv"
    subprocess.run(["/usr/bin/python3", "-m", "venv", "--clear", environment], check=True)
    python = environment / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps",
                    "--disable-pip-version-check", next(folder.glob("*.whl"))], check=True)
    packages = next((environment / "lib").glob("python3*")) / "site-packages"

    def check(program: str) -> None:
        subprocess.run([python, "-c", program], cwd=folder, check=True, env={"PATH": "/usr/bin:/bin"})

    (packages / "numpy").symlink_to(DEBIAN / "numpy")
    check(ALONE)
    (packages / "h5py").symlink_to(DEBIAN / "h5py")
    check(BESIDE.format(first="h5py", second="cairn"))
    check(BESIDE.format(first="cairn", second="h5py"))
    print("the wheel runs with numpy alone, and beside h5py")


if __name__ == "__main__":
    main()
