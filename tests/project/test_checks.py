"""Each check of the source tree finds what it is there to find, and accepts what is right."""

import shutil
import tempfile
import unittest
from pathlib import Path

from checks import (dependencies, doc_blocks, formatting, includes, links, listings, openmp, sources, thesis_map, version)


class Tree(unittest.TestCase):
    """A small source tree in which each test puts its files."""

    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        for folder in ("include/cairn", "src/math", "src/world", "tools", "docs", "tests/world", "examples"):
            (self.root / folder).mkdir(parents=True)
        self.put("CMakeLists.txt", "project(cairn VERSION 1.2.3 LANGUAGES CXX)\nset(CAIRN_ROOMS math parallel\n  world)\n")

    def put(self, path: str, text: str) -> None:
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def finds(self, check, *fragments: str) -> None:
        """The check reports one problem for each fragment and no others."""
        problems = check.check(self.root)
        self.assertEqual(len(problems), len(fragments), problems)
        for fragment, problem in zip(fragments, problems):
            self.assertIn(fragment, problem)


class Includes(Tree):
    def test_a_room_uses_itself_those_above_and_the_public_headers(self):
        self.put("src/world/a.cpp", '#include "math/m.h"\n#include "world/w.h"\n#include "cairn/world.h"\n#include <map>\n')
        self.finds(includes)

    def test_a_room_may_not_use_one_below(self):
        self.put("src/math/a.h", '#include "world/w.h"\n')
        self.finds(includes, 'src/math/a.h:1: may not include "world/w.h"')

    def test_paths_without_a_room_or_with_dots_are_refused(self):
        self.put("src/math/a.h", '#include "b.h"\n#include "cairn/../../src/world/w.h"\n')
        self.put("src/math/b.h", "")
        self.finds(includes, '"b.h"', "w.h")

    def test_public_headers_and_programs_may_not_use_rooms(self):
        self.put("include/cairn/a.h", '#include "math/m.h"\n')
        self.put("apps/cairn/main.cpp", '#include "own.h"\n#include "cairn/a.h"\n#include "math/m.h"\n'
                                      '#include "view/v.h"\n#include "made.inc"\n')
        self.put("apps/cairn/own.h", "")
        self.put("apps/view/v.h", "")
        self.finds(includes, "apps/cairn/main.cpp:3", "include/cairn/a.h:1")

    def test_an_unlisted_room_is_found(self):
        self.put("src/attic/a.h", "")
        self.finds(includes, "src/attic")


class OpenMp(Tree):
    def test_is_allowed_in_its_room_and_in_comments(self):
        self.put("src/parallel/a.cpp", "#include <omp.h>\n#pragma omp parallel\n")
        self.put("src/world/a.cpp", '// #pragma omp parallel\nconst char* s = "omp_get_thread_num()";\n')
        self.finds(openmp)

    def test_is_found_elsewhere(self):
        self.put("src/world/a.cpp", "\n#pragma omp parallel for\n#include <omp.h>\nint n = omp_get_thread_num();\n")
        self.finds(openmp, "a.cpp:2", "a.cpp:3", "a.cpp:4")


class Sources(Tree):
    def setUp(self):
        super().setUp()
        self.put("Makefile", "")
        self.put(".ci/run", "")

    def test_long_files_are_found(self):
        self.put("src/world/a.cpp", "\n" * sources.LONGEST)
        self.put("src/world/b.cpp", "\n" * (sources.LONGEST + 1))
        self.finds(sources, "src/world/b.cpp: 451 lines")

    def test_unfinished_work_and_places_are_found(self):
        self.put("src/world/a.cpp", "// " + "TO" + "DO later\n")
        self.put("docs/a.md", "see /" + "home/me/file\n")
        self.finds(sources, "src/world/a.cpp:1", "docs/a.md:1")

    def test_relative_paths_are_fine(self):
        self.put("docs/a.md", "src/" + "work/a.h and https://example.org/" + "home/page\n")
        self.finds(sources)


class DocBlocks(Tree):
    def header(self, text: str) -> None:
        self.put("include/cairn/a.h", text)

    def test_undocumented_symbols_are_found(self):
        self.header("namespace cairn {\nint f();\nstruct S {\n    int member;\n};\nenum class E { one };\n"
                    "inline constexpr int c = 1;\nusing T = int;\n}\n")
        self.finds(doc_blocks, "int f()", "int member", "struct S", "enum class E", "constexpr int c", "using T")

    def test_blocks_above_and_comments_beside_count(self):
        self.header("namespace cairn {\n/// One.\nint f(int a,\n      int b);\n/// Two.\nstruct S {\n"
                    "    int x = 0;  ///< [m]\n    int y{};    ///< [m]\n};\n/// Three.\nenum class E { one, two };\n}\n")
        self.finds(doc_blocks)

    def test_a_block_covers_a_run_of_members_up_to_a_blank_line(self):
        self.header("namespace cairn {\n/// C.\nclass C {\n  public:\n    /// Both.\n    int a() const { return 1; }\n"
                    "    int b() const;\n\n    int c() const;\n};\n}\n")
        self.finds(doc_blocks, "int c() const")

    def test_private_members_and_bodies_are_not_public(self):
        self.header("namespace cairn {\n/// C.\nclass C {\n    int hidden();\n  public:\n    ~C();\n    C(const C&) = delete;\n"
                    "    C(C&&) noexcept;\n  private:\n    struct Impl;\n    int x_;\n};\n"
                    "/// F.\ninline int f() {\n    int local = 1;\n    return local;\n}\n}\n")
        self.finds(doc_blocks)

    def test_inline_functions_without_a_block_are_found(self):
        self.header('#include <map>\nnamespace cairn {\n/// F.\ninline int f() { return 1; }\n\ninline int g() { return 2; }\n}\n')
        self.finds(doc_blocks, "a.h:6: no doc block: inline int g()")


class Listings(Tree):
    def setUp(self):
        super().setUp()
        self.put("examples/hello.cpp", "int main() {}\n")
        self.put("README.md", "```cpp\nint main() {}\n```\n")
        self.put("docs/hello.md", "```cpp\n// One.\n```\n\n```cpp\n// Two.\n```\n")
        self.put("examples/hello/1_a.cpp", "// One.\n")
        self.put("examples/hello/2_b.cpp", "// Two.\n")

    def test_programs_are_quoted_word_for_word(self):
        self.finds(listings)
        self.put("README.md", "```cpp\nint main() { }\n```\n")
        self.put("examples/hello/2_b.cpp", "// Two!\n")
        self.finds(listings, "README.md: no cpp block is examples/hello.cpp", "docs/hello.md: no cpp block is examples/hello/2_b",
                   "is no program of examples/hello: // Two.")

    def test_the_tutorial_has_them_in_their_order(self):
        self.put("docs/hello.md", "```cpp\n// Two.\n```\n\n```cpp\n// One.\n```\n")
        self.finds(listings, "in their order")

    def test_they_must_be_short(self):
        hello = "//\n" * (listings.LONGEST + 1)
        step = "//\n" * (listings.LONGEST_OF_THE_TUTORIAL + 1)
        self.put("examples/hello.cpp", hello)
        self.put("README.md", f"```cpp\n{hello}```\n")
        self.put("examples/hello/1_a.cpp", step)
        self.put("docs/hello.md", f"```cpp\n{step}```\n\n```cpp\n// Two.\n```\n")
        self.finds(listings, "26 lines", "46 lines")


class Links(Tree):
    def test_dead_files_and_headings_are_found(self):
        self.put("README.md", "[a](docs/a.md) [b](docs/b.md) [c](docs/a.md#the-one) [d](docs/a.md#the-other)\n"
                              "![e](docs/e.svg) [f](#top) [g](https://example.org)\n# Top\n")
        self.put("docs/a.md", "## The one\n[back](../README.md#top)\n")
        self.finds(links, "docs/b.md", "#the-other", "docs/e.svg")


class Dependencies(Tree):
    def test_both_lists_must_agree(self):
        self.put("tools/packages.txt", "# c\nbuild libone-dev\nbuild tool tool\n")
        self.put("docs/dependencies.md", "| Package | Why |\n|---|---|\n| `libone-dev` | needed |\n| `libold-dev` | gone |\n"
                                         "| `tool` | |\n")
        self.finds(dependencies, "no line for tool", "does not list libold-dev")

    def test_so_must_the_packages_of_the_page(self):
        self.put("tools/packages.txt", "")
        self.put("web/package.json", '{"dependencies": {"one": "1"}, "devDependencies": {"@a/two": "2"}}')
        self.put("docs/dependencies.md", "- `one`: needed\n- `@a/three`: gone\n")
        self.finds(dependencies, "npm package @a/two", "does not list @a/three")


class ThesisMap(Tree):
    def setUp(self):
        super().setUp()
        self.put("src/world/a.cpp", "/// (3.4.9a)\nvoid solve() {}\n// mentioned()\n")
        self.put("tests/world/a.cpp", "TEST(Solve, Holds) {}\n")
        self.algorithms = ", ".join(f"Algorithm {n}" for n in thesis_map.ALGORITHMS)

    def table(self, *rows: str) -> None:
        self.put("docs/thesis-map.md", "\n".join(["| Thesis | What | Functions | Tests |", "|---|---|---|---|", *rows, ""]))

    def test_a_true_map_passes(self):
        self.table(f"| {self.algorithms}, (3.4.9) | all | `world/a.cpp:solve` | `Solve.Holds` |")
        self.finds(thesis_map)

    def test_names_that_do_not_exist_are_found(self):
        self.table(f"| {self.algorithms}, 3.4.9 | all | `world/a.cpp:mentioned`, `world/b.cpp:solve` | `Solve.Fails` |")
        self.finds(thesis_map, "has no mentioned", "world/b.cpp does not exist", "no test Solve.Fails")

    def test_empty_cells_are_found(self):
        self.table(f"| {self.algorithms}, 3.4.9 | all | | |")
        self.finds(thesis_map, "names no function", "names no test")

    def test_missing_algorithms_and_equations_are_found(self):
        self.table(f"| {self.algorithms.replace('Algorithm 7, ', '')} | all | `world/a.cpp:solve` | `Solve.Holds` |")
        self.finds(thesis_map, "Algorithm 7", "equation 3.4.9, cited in src/world/a.cpp")


class Version(Tree):
    def test_both_places_must_agree(self):
        self.put("include/cairn/version.h", 'version = "1.2.3";\n')
        self.finds(version)
        self.put("include/cairn/version.h", 'version = "1.2.4";\n')
        self.finds(version, "1.2.4")


@unittest.skipUnless(shutil.which("clang-format"), "clang-format is not installed")
class Formatting(Tree):
    def test_unformatted_code_is_found(self):
        self.put(".clang-format", "BasedOnStyle: Google\n")
        self.put("src/world/a.cpp", "int  x;\n")
        self.put("src/world/b.cpp", "int x;\n")
        self.finds(formatting, "a.cpp:1")


if __name__ == "__main__":
    unittest.main()
