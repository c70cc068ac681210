# The daily commands. Everything they need is installed when it is missing (Debian packages of tools/packages.txt).
#   make run       build the release and run the main scene; where there is a display, show it in the browser
#   make test      build the release and run all tests
#   make golden    list the state hashes of the golden runs that changed; make golden UPDATE=1 keeps the new ones
#   make sanitize  run the tests under the address, undefined-behaviour and thread sanitizers
#   make coverage  measure which lines of detection and response the tests run
#   make fuzz SECONDS=60   fuzz the readers, the narrow phase and the world, each target for so long
#   make soak SIMULATED=3600 WALL=3600   pour a mixed pile for so many seconds: nothing may leak, slow down or creep
#   make thesis    repeat every benchmark of the thesis: report/index.html
#   make bench SUITE=peers   measure a suite (kernels, scenes, scaling, peers) and add it to bench/results
#   make results   measure the scenes and rewrite the table in README.md
#   make format | tidy | install PREFIX=DIR | clean

SCENE ?= stacks5
JOBS ?= 2
PREFIX ?= /usr/local
SUITE ?= peers
SECONDS ?= 60
SIMULATED ?= 3600
WALL ?= 3600
SOURCES = $$(find include src apps bench tests examples -name '*.h' -o -name '*.cpp')

# A compiler cache is used where there is one.
export CMAKE_CXX_COMPILER_LAUNCHER ?= $(shell command -v ccache)

.PHONY: run test golden sanitize coverage fuzz soak thesis bench validate results format tidy install clean

run:
	@tools/install_packages build
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target cairn_cli
	build/release/cairn run $(SCENE) --record build/$(subst :,-,$(SCENE)).h5
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then build/release/cairn view $(SCENE); fi

test:
	@tools/install_packages build test
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release
	@ctest --preset release -j$(JOBS)

golden:
	@tools/install_packages build test
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target golden
	@build/release/tests/golden/golden tests/golden/hashes.json $(if $(UPDATE),--update)

sanitize:
	@tools/install_packages build test develop
	@tools/sanitize asan-ubsan
	@tools/sanitize tsan

coverage:
	@tools/install_packages build test develop
	@tools/coverage

fuzz:
	@tools/install_packages build develop
	@tools/fuzz $(SECONDS)

soak:
	@tools/install_packages build
	@tools/soak $(SIMULATED) $(WALL)

thesis:
	@tools/install_packages build
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target cairn_cli
	build/release/cairn bench thesis --out report

bench:
	@tools/install_packages build bench
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target cairn_cli
	tools/record_results $(SUITE)

validate:
	@tools/install_packages build
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target cairn_cli
	build/release/cairn validate --out validation

results:
	@tools/install_packages build
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target cairn_cli
	tools/readme_results

format:
	@tools/install_packages test
	clang-format -i $(SOURCES)

tidy:
	@tools/install_packages build develop
	@cmake --preset release --log-level=WARNING
	run-clang-tidy -quiet -p build/release -j $(JOBS) "$(CURDIR)/(src|apps)/"
	cppcheck --quiet --project=build/release/compile_commands.json --file-filter='src/*' \
	    --enable=warning,performance,portability --inline-suppr --suppress='*:/usr/*' --error-exitcode=1 -j $(JOBS)

install:
	@tools/install_packages build
	@cmake --preset release --log-level=WARNING
	@cmake --build --preset release --target cairn cairn_cli
	cmake --install build/release --prefix $(PREFIX)

clean:
	rm -rf build
