"""tools/install_packages and tools/readme_results, run with stand-ins for the programs they call."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"


class Sandbox(unittest.TestCase):
    """A folder with programs of our own that come first on the PATH."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.log = self.folder / "log"
        (self.folder / "bin").mkdir()

    def program(self, name: str, body: str) -> None:
        path = self.folder / "bin" / name
        path.write_text(f"#!/bin/bash\n{body}\n")
        path.chmod(0o755)

    def run_tool(self, *command: str, path: str | None = None) -> subprocess.CompletedProcess:
        environment = {**os.environ, "PATH": path or f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        return subprocess.run([str(c) for c in command], env=environment, capture_output=True, text=True, check=False)

    def calls(self) -> str:
        return self.log.read_text() if self.log.exists() else ""


class InstallPackages(Sandbox):
    def setUp(self):
        super().setUp()
        shutil.copy(TOOLS / "install_packages", self.folder)
        self.list("build libone-dev\nbuild tool-package sometool\ntest libtwo-dev")
        self.installed()
        self.user(0)
        self.program("apt-get", f'echo "apt-get $*" >>{self.log}')
        # Only what the script itself needs, so that neither sudo nor sometool of the machine is found.
        for name in ("awk", "bash", "cat", "dirname", "echo", "env", "grep", "sed", "sort", "xargs"):
            (self.folder / "bin" / name).symlink_to(shutil.which(name))

    def list(self, text: str) -> None:
        (self.folder / "packages.txt").write_text(f"# a comment\n{text}\n")

    def installed(self, *packages: str) -> None:
        lines = "".join(f"installed {p}\\n" for p in packages)
        self.program("dpkg-query", f"printf '{lines}config-files removed-dev\\n'")

    def user(self, number: int) -> None:
        self.program("id", f"echo {number}")

    def install(self, *groups: str) -> subprocess.CompletedProcess:
        return self.run_tool(self.folder / "install_packages", *groups, path=str(self.folder / "bin"))

    def test_installs_only_what_is_missing_of_the_named_groups(self):
        self.installed("libone-dev")
        self.assertEqual(self.install("build").returncode, 0)
        self.assertIn("install -y -qq --no-install-recommends tool-package\n", self.calls())

    def test_installs_several_groups_at_once(self):
        self.assertEqual(self.install("build", "test").returncode, 0)
        self.assertIn("libone-dev tool-package libtwo-dev\n", self.calls())

    def test_does_nothing_when_all_is_there(self):
        self.installed("libone-dev", "tool-package")
        done = self.install("build")
        self.assertEqual((done.returncode, done.stdout, self.calls()), (0, "", ""))

    def test_a_command_on_the_path_stands_in_for_its_package(self):
        self.installed("libone-dev")
        self.program("sometool", "exit 0")
        self.assertEqual((self.install("build").returncode, self.calls()), (0, ""))

    def test_a_removed_package_with_its_settings_left_counts_as_missing(self):
        self.list("build removed-dev")
        self.install("build")
        self.assertIn(" removed-dev\n", self.calls())

    def test_root_needs_no_sudo(self):
        self.program("sudo", f'echo "sudo" >>{self.log}; "$@"')
        self.assertEqual(self.install("build").returncode, 0)
        self.assertNotIn("sudo", self.calls())

    def test_a_user_installs_with_sudo(self):
        self.user(1000)
        self.program("sudo", f'echo "sudo" >>{self.log}; "$@"')
        self.assertEqual(self.install("test").returncode, 0)
        self.assertEqual(self.calls().splitlines()[0], "sudo")
        self.assertIn(" libtwo-dev\n", self.calls())

    def test_a_user_without_sudo_is_told_what_to_run(self):
        self.user(1000)
        done = self.install("test")
        self.assertEqual(done.returncode, 1)
        self.assertIn("apt-get install libtwo-dev", done.stderr)

    def test_another_system_is_told_what_is_wanted_and_goes_on(self):
        (self.folder / "bin" / "dpkg-query").unlink()
        done = self.install("build")
        self.assertEqual((done.returncode, self.calls()), (0, ""))
        self.assertIn("libone-dev tool-package", done.stderr)

    def test_an_unknown_group_is_wrong_use(self):
        done = self.install("biuld")
        self.assertEqual(done.returncode, 2)
        self.assertIn("biuld", done.stderr)

    def test_a_failed_installation_fails(self):
        self.program("apt-get", "exit 100")
        self.assertNotEqual(self.install("test").returncode, 0)


REPORT = {"scene": "well324", "bodies": 330, "seconds": 6.0, "real_time": True, "lost": 0,
          "ms_per_simulation_step": {"average": 1.234, "median": 1.2, "p99": 3.456, "worst": 4.0},
          "overlap_mm": {"largest": 9.0, "mean": 0.2, "last": 1.7}}


class ReadmeResults(Sandbox):
    def setUp(self):
        super().setUp()
        self.readme = self.folder / "README.md"
        self.readme.write_text("above\n<!-- results:begin -->\nold\n<!-- results:end -->\nbelow\n")

    def measure(self, report: str) -> subprocess.CompletedProcess:
        self.program("cairn", f"echo \"$*\" >>{self.log}\n{report}")
        return self.run_tool(TOOLS / "readme_results", "--binary", self.folder / "bin" / "cairn",
                             "--readme", self.readme, "--threads", "3", "well324")

    def test_replaces_what_stands_between_the_marks(self):
        done = self.measure(f"echo '{json.dumps(REPORT)}'")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = self.readme.read_text()
        self.assertTrue(text.startswith("above\n<!-- results:begin -->\n| scene |"))
        self.assertTrue(text.endswith("\n<!-- results:end -->\nbelow\n"))
        self.assertNotIn("old", text)
        self.assertIn("| `well324` | 330 | 6 s | 1.23 ms | 1.20 ms | 3.46 ms | 4.00 ms | yes | 1.70 mm | 0 |\n", text)
        self.assertIn("3 threads", text)
        self.assertEqual(self.calls(), "run well324 --threads 3 --json --quiet\n")

    def test_leaves_the_readme_alone_when_a_run_fails(self):
        before = self.readme.read_text()
        self.assertNotEqual(self.measure("exit 1").returncode, 0)
        self.assertEqual(self.readme.read_text(), before)

    def test_refuses_a_readme_without_the_marks(self):
        self.readme.write_text("no marks\n")
        done = self.measure("exit 0")
        self.assertIn("results:begin", done.stderr)
        self.assertEqual((done.returncode, self.calls()), (1, ""))


if __name__ == "__main__":
    unittest.main()
