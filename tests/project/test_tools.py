"""tools/install_packages, tools/readme_results, tools/record_results and
tools/compare_results, run with stand-ins for the programs they call."""

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


def results(path: Path, time: float, **origin) -> Path:
    entries = [{"name": "tower:3/cairn", "values": {"average_ms": time, "lost": 0}, "step_ms": [time, time]}]
    path.write_text(json.dumps({"suite": "peers", "version": "0.1.0", "date": "2026-01-02", **origin,
                                "entries": entries + origin.get("more", [])}))
    return path


class CompareResults(Sandbox):
    def compare(self, a: Path, b: Path, *options: str) -> subprocess.CompletedProcess:
        return self.run_tool(TOOLS / "compare_results", a, b, *options)

    def test_gives_the_ratio_and_what_differs_besides(self):
        done = self.compare(results(self.folder / "a.json", 4.0, compiler="gcc"),
                            results(self.folder / "b.json", 1.0, compiler="clang"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"tower:3/cairn +average_ms +4 +1 +0\.250")
        self.assertRegex(done.stdout, r"geometric mean of 1 +average_ms +0\.250")
        self.assertIn('compiler: "gcc" | "clang"', done.stdout)
        self.assertNotIn("lost", done.stdout)

    def test_shows_other_values_when_asked_to(self):
        done = self.compare(results(self.folder / "a.json", 4.0), results(self.folder / "b.json", 1.0), "--values", "all")
        self.assertRegex(done.stdout, r"tower:3/cairn +lost +0 +0 +-")

    def test_names_what_only_one_of_them_has(self):
        more = [{"name": "wall:3/cairn", "values": {}}]
        done = self.compare(results(self.folder / "a.json", 4.0, more=more), results(self.folder / "b.json", 1.0))
        self.assertIn("only in A: wall:3/cairn", done.stdout)

    def test_refuses_what_is_no_result(self):
        good = results(self.folder / "a.json", 1.0)
        for text in ("", "[]", '{"entries": [1]}'):
            (self.folder / "b.json").write_text(text)
            done = self.compare(good, self.folder / "b.json")
            self.assertEqual(done.returncode, 1, text)
            self.assertIn("b.json", done.stderr)
        self.assertIn("nowhere.json", self.compare(good, self.folder / "nowhere.json").stderr)


class RecordResults(Sandbox):
    def record(self, cairn: str) -> subprocess.CompletedProcess:
        self.program("cairn", cairn)
        self.program("git", 'case "$*" in *status*) ;; *) echo abcdef;; esac')
        return self.run_tool(TOOLS / "record_results", "--binary", self.folder / "bin" / "cairn", "--results",
                             self.folder / "results", "peers", "--repeat", "1")

    def test_adds_commit_and_command_and_leaves_single_steps_out(self):
        made = results(self.folder / "made.json", 2.0)
        done = self.record(f'echo "$*" >{self.log}; cp {made} "${{@: -1}}"')
        self.assertEqual(done.returncode, 0, done.stderr)
        entry = json.loads((self.folder / "results" / "2026-01-02-peers-abcdef.json").read_text())
        self.assertEqual((entry["commit"], entry["command"]), ("abcdef", "cairn bench peers --repeat 1"))
        self.assertEqual(entry["entries"], [{"name": "tower:3/cairn", "values": {"average_ms": 2.0, "lost": 0}}])
        self.assertTrue(self.calls().startswith("bench peers --repeat 1 --save "))

    def test_records_nothing_of_a_run_that_failed(self):
        done = self.record("exit 2")
        self.assertEqual(done.returncode, 1)
        self.assertFalse((self.folder / "results").exists())


if __name__ == "__main__":
    unittest.main()
