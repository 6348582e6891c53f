# make demo: build, run the main mission, show where its results lie.    make test: run all tests.
# Everything lies in .venv and build; both are made on demand and can be deleted at any time.
# Output of pip and the compilers: build/logs.
ifndef PYTHON
PYTHON := $(shell .ci/machine python)
endif
MISSION ?= casualty
DEMO_ARGS ?=
WERROR ?= OFF
ASSERTS ?= OFF
# OFF: each source by itself, for work on a few of them
TOGETHER ?= ON
JOBS ?= $(shell .ci/machine jobs)
export CMAKE_BUILD_PARALLEL_LEVEL = $(JOBS)

VENV := .venv
BIN := $(VENV)/bin
BUILD := build/make
RELEASE := build/release
STEP := .ci/step build/logs
PIP := $(BIN)/python -m pip --disable-pip-version-check --no-input
VARIANT := $(WERROR)-$(ASSERTS)-$(TOGETHER)
SOURCES := pyproject.toml CMakeLists.txt $(shell find cpp python/bindings -name '*.?pp' -o -name CMakeLists.txt -o -name '*.cmake*')
TEST_SOURCES := $(shell find tests/cpp tests/fuzz benchmarks -name '*.?pp' -o -name CMakeLists.txt)

# the names of all sources: newer than the build when one came or went
$(shell mkdir -p build && find cpp python envs tests/cpp tests/fuzz benchmarks -type f -not -name '*.pyc' | sort > build/names.new; \
  cmp -s build/names.new build/names || mv build/names.new build/names)
# a virtual environment whose Python is gone is made anew
$(shell test ! -d $(VENV) || $(BIN)/python -c '' 2>/dev/null || rm -rf $(VENV))

.PHONY: demo test ctest pytest sanitize fuzz proof bench bench-instructions stubs architecture product setup wheel machine clean

# where the tests are built already, the demo uses that build
demo: $(if $(wildcard $(BUILD)/tests-*),setup,product)
	@$(BIN)/python -m hurcules run $(MISSION) $(DEMO_ARGS)

# pytest runs the examples too
test: ctest pytest

ctest: setup
	$(BIN)/ctest --test-dir $(BUILD) --output-on-failure --parallel $(JOBS)

# a file of tests stays in one process: its tests share what is slow to make
pytest: setup
	$(BIN)/python -m pytest --numprocesses $(JOBS) --dist loadfile

# the C++ tests again: debug build, asserts, address and undefined-behaviour sanitizers
sanitize: setup
	PATH="$(CURDIR)/$(BIN):$$PATH" VIRTUAL_ENV="$(CURDIR)/$(VENV)" cmake --workflow --preset dev

# coverage-guided fuzzing of the whole solve; without clang the test fuzz/solver runs seeded inputs alone
SECONDS ?= 60
ifneq ($(shell command -v clang++),)
fuzz: setup
	export PATH="$(CURDIR)/$(BIN):$$PATH" VIRTUAL_ENV="$(CURDIR)/$(VENV)"; cmake --preset fuzz && cmake --build --preset fuzz
	mkdir -p build/fuzz/corpus
	test -n "$$(ls build/fuzz/corpus)" || $(BIN)/python tests/fuzz/seeds.py build/fuzz/corpus
	build/fuzz/tests/fuzz/solver_fuzz build/fuzz/corpus -max_total_time=$(SECONDS) -max_len=400 -timeout=10 \
	  -artifact_prefix=build/fuzz/ -print_final_stats=1
else
fuzz: setup
	@echo "clang++ with libFuzzer is missing (Debian: clang); seeded inputs instead of coverage-guided ones"
	$(BUILD)/tests/fuzz/solver_fuzz -runs=200000
endif

# a million seeded hierarchies at every regularisation
PROBLEMS ?= 1000000
proof: setup
	$(BUILD)/benchmarks/solver_proof --problems $(PROBLEMS)

bench: setup
	$(BUILD)/benchmarks/timing
	$(BUILD)/benchmarks/solver_benchmark

# exact, but slow under valgrind (Debian: valgrind)
bench-instructions: setup
	$(BIN)/python benchmarks/count_instructions.py

# python/hurcules/_core.pyi out of the compiled module
stubs: setup
	$(BIN)/python python/bindings/stubs.py

# docs/architecture.md out of the include and import lines
architecture: setup
	$(BIN)/python benchmarks/figures/architecture.py

product: $(BUILD)/product-$(VARIANT)

# what its prerequisites look for, too: one look, one question
setup: PURPOSE := test
setup: $(BUILD)/tests-$(VARIANT)

# looked at in every call, since machines change between two
machine:
	@.ci/machine check $(PYTHON) $(PURPOSE)

# the virtual environment, with what builds and runs the product
$(VENV)/ready: pyproject.toml .ci/requirements | machine
	@$(STEP)/venv.log "making $(VENV) with $$($(PYTHON) -V)" $(PYTHON) -m venv $(VENV)
	@$(BIN)/python .ci/requirements build run report > build/requirements.txt
	@$(STEP)/packages.log "downloading Python packages" $(PIP) install -r build/requirements.txt
	@touch $@

$(VENV)/ready-test: $(VENV)/ready
	@$(BIN)/python .ci/requirements dev > build/requirements-test.txt
	@$(STEP)/packages-test.log "downloading Python packages for the tests" $(PIP) install -r build/requirements-test.txt
	@touch $@

# one build serves the module and, from its objects on, the tests and the benchmarks
INSTALL = $(PIP) install --verbose --no-build-isolation --editable '.[report]' --config-settings build-dir=$(BUILD) \
  --config-settings cmake.define.HURCULES_PRECOMPILE=$(TOGETHER) \
  --config-settings cmake.define.HURCULES_WERROR=$(WERROR) \
  --config-settings cmake.define.HURCULES_ASSERTS=$(ASSERTS) \
  --config-settings cmake.define.HURCULES_TESTS=$(1) \
  --config-settings cmake.define.HURCULES_BENCHMARKS=$(1)

$(BUILD)/product-$(VARIANT): $(VENV)/ready build/names $(SOURCES) | machine
	@$(STEP)/product.log "compiling Hurcules" $(call INSTALL,OFF)
	@rm -f $(BUILD)/product-* $(BUILD)/tests-*
	@touch $@

$(BUILD)/tests-$(VARIANT): $(VENV)/ready-test build/names $(SOURCES) $(TEST_SOURCES) | machine
	@$(STEP)/tests.log "compiling Hurcules, its tests and benchmarks" $(call INSTALL,ON)
	@rm -f $(BUILD)/product-* $(BUILD)/tests-*
	@touch $@

# a manylinux wheel in dist/, tried in an environment of its own without a compiler
wheel: $(VENV)/ready | machine
	@rm -rf build/wheel
	@$(BIN)/python .ci/requirements release > build/requirements-release.txt
	@$(STEP)/packages-release.log "downloading auditwheel" $(PIP) install -r build/requirements-release.txt
	@$(STEP)/wheel.log "compiling the wheel" $(PIP) wheel --verbose --no-build-isolation --no-deps --wheel-dir build/wheel . \
	  --config-settings build-dir=$(RELEASE)
	@PATH="$(CURDIR)/$(BIN):$$PATH" $(STEP)/auditwheel.log "auditwheel" \
	  $(BIN)/auditwheel repair --exclude 'libmujoco.so.*' --wheel-dir dist build/wheel/hurcules-*.whl
	@.ci/try_wheel $(PYTHON)

clean:
	rm -rf $(VENV) build
