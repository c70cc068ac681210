# The daily commands. Everything they need is installed when it is missing (Debian packages of tools/packages.txt).
#   make run       build the release of the program and run the main scene; with a display, show it in the browser
#   make check     after an edit: the tests of the engine's rooms and of the API, and the golden runs on one thread
#   make test      build everything and run all tests
#   make cairn-view | cairn-bench | cairn-bench-thesis | cairn-validate | programs   build what stands beside the program
#   make python    build the Python package, install it into build/venv and run a scene with it
#   make wheel     pack the Python package so that numpy is all it needs: build/wheel
#   make site      build the site of the documents, with examples and references: build/site/html
#   make golden    list which golden runs changed; make golden UPDATE=1 renews tests/golden/hashes.json
#   make sanitize  run the tests under the address, undefined-behaviour and thread sanitizers
#   make ranks     prove that ranks give the bits of one: all numbers, cuts, mpirun, kill -9, thread sanitizer
#   make coverage  measure which lines of detection and response the tests run
#   make fuzz SECONDS=60   fuzz the readers, the narrow phase, questions and the world, each target for so long
#   make soak SIMULATED=3600 WALL=3600   pour a mixed pile for so many seconds: nothing may leak, slow down or creep
#   make thesis    repeat every benchmark of the thesis: report/index.html
#   make validate  measure the physics against closed forms and experiments: validation/index.html
#   make bench SUITE=peers   measure a suite (kernels, scenes, scaling, peers, rays) and add it to bench/results
#   make results   measure the scenes and rewrite the table in README.md
#   make format | tidy | install PREFIX=DIR | clean

SCENE ?= stacks5
JOBS ?= 2
PREFIX ?= /usr/local
SUITE ?= peers
SECONDS ?= 60
SIMULATED ?= 3600
WALL ?= 3600
SOURCES = $$(find include src apps bench tests examples python -name '*.h' -o -name '*.cpp')
# Where nothing was built yet, whole folders are compiled at once: the least work. `make check`, which is for who changes
# sources, compiles fewer at once from then on.
FIRST = $(if $(wildcard build/release/CMakeCache.txt),,-DCAIRN_SOURCES_AT_ONCE=0)
CONFIGURE = cmake --preset release --log-level=WARNING $(FIRST)
BUILD = cmake --build --preset release --target

# A compiler cache is used where there is one.
export CMAKE_CXX_COMPILER_LAUNCHER ?= $(shell command -v ccache)
export CCACHE_SLOPPINESS ?= pch_defines,time_macros

COMPANIONS = cairn-view cairn-bench cairn-bench-thesis cairn-validate

.PHONY: run check test python wheel site golden sanitize ranks coverage fuzz soak thesis bench validate results format tidy install clean \
    programs $(COMPANIONS)

run:
	@tools/install_packages build
	@$(CONFIGURE)
	@$(BUILD) cairn_cli
	build/release/cairn run $(SCENE) --record build/$(subst :,-,$(SCENE)).h5
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then $(MAKE) cairn-view && build/release/cairn view $(SCENE); fi

$(COMPANIONS) programs:
	@tools/install_packages build companions
	@$(CONFIGURE)
	@$(BUILD) cairn_cli $@

check:
	@tools/install_packages build check
	@$(CONFIGURE) -DCAIRN_SOURCES_AT_ONCE=8
	@$(BUILD) check_programs
	@ctest --preset release -j$(JOBS) --no-tests=error --label-regex check

test:
	@tools/install_packages build companions check test python
	@$(CONFIGURE) -DCAIRN_REQUIRE_ALL=ON
	@cmake --build --preset release
	@ctest --preset release -j$(JOBS) --no-tests=error

python:
	@tools/install_packages build python
	@/usr/bin/python3 -m venv --system-site-packages build/venv
	@build/venv/bin/python -m pip install --quiet --no-build-isolation --no-index --no-deps --disable-pip-version-check \
	    ./python
	build/venv/bin/python -c 'import cairn; print(cairn.run("stacks5"))'

wheel:
	@tools/install_packages build python
	tools/make_wheel

site:
	@tools/install_packages build companions python site
	@$(CONFIGURE)
	@$(BUILD) cairn_python cairn_cli cairn-view
	@PYTHONPATH=$(CURDIR)/build/release/python CAIRN_PROGRAM=$(CURDIR)/build/release/cairn tools/make_site

golden:
	@tools/install_packages build check
	@$(CONFIGURE)
	@$(BUILD) golden
	@build/release/tests/golden/golden tests/golden/hashes.json $(if $(UPDATE),--update)

sanitize:
	@tools/install_packages build check develop python
	@tools/sanitize asan-ubsan
	@tools/sanitize tsan

ranks:
	@tools/install_packages build test ranks develop
	@$(CONFIGURE)
	@$(BUILD) cairn_cli test_determinism
	@tools/ranks

coverage:
	@tools/install_packages build check develop
	@tools/coverage

fuzz:
	@tools/install_packages build develop
	@tools/fuzz $(SECONDS)

soak:
	@tools/install_packages build check
	@tools/soak $(SIMULATED) $(WALL)

thesis: cairn-view cairn-bench-thesis
	build/release/cairn bench thesis --out report

bench:
	@tools/install_packages bench
	@$(MAKE) cairn-bench
	tools/record_results $(SUITE)

validate: cairn-validate
	build/release/cairn validate --out validation

results:
	@tools/install_packages build bench
	@$(CONFIGURE)
	@$(BUILD) cairn_cli
	tools/readme_results

format:
	@tools/install_packages test
	clang-format -i $(SOURCES)

# Every source is compiled alone here, so that each is looked at, and none lives on what its neighbours include.
tidy:
	@tools/install_packages build companions develop
	@cmake --preset release --log-level=WARNING -B build/tidy -DCAIRN_UNITY=OFF -DCAIRN_BUILD_TESTS=OFF
	@cmake --build build/tidy
	run-clang-tidy -quiet -p build/tidy -j $(JOBS) "$(CURDIR)/(src|apps)/"
	cppcheck --quiet --project=build/tidy/compile_commands.json --file-filter='src/*' \
	    --enable=warning,performance,portability --inline-suppr --suppress='*:/usr/*' --error-exitcode=1 -j $(JOBS)

install: programs
	@$(BUILD) cairn
	cmake --install build/release --prefix $(PREFIX)

clean:
	rm -rf build
