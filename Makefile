# make demo: build, run the main mission, show where its results lie.    make test: prove it.
# Everything lies in .venv and build; both are made on demand and can be deleted at any time.
PYTHON ?= $(shell .ci/machine python)
MISSION ?= stretch
DEMO_ARGS ?=
WERROR ?= OFF
ASSERTS ?= OFF

VENV := .venv
BIN := $(VENV)/bin
BUILD := build/make
SOURCES := pyproject.toml CMakeLists.txt $(shell find cpp python/bindings tests/cpp tests/fuzz benchmarks \
  -name '*.?pp' -o -name CMakeLists.txt -o -name '*.cmake*')

# the names of all sources: newer than the build when one came or went
$(shell mkdir -p build && find cpp python envs tests/cpp tests/fuzz benchmarks -type f -not -name '*.pyc' | sort > build/names.new; \
  cmp -s build/names.new build/names || mv build/names.new build/names)

.PHONY: demo test ctest pytest sanitize fuzz proof bench bench-instructions stubs architecture setup clean

demo: setup
	$(BIN)/hurcules run $(MISSION) $(DEMO_ARGS)

# pytest runs the examples too
test: ctest pytest

ctest: setup
	$(BIN)/ctest --test-dir $(BUILD) --output-on-failure --parallel $(shell nproc)

# a file of tests stays in one process: its tests share what is slow to make
pytest: setup
	$(BIN)/python -m pytest --numprocesses $(shell nproc) --dist loadfile

# the C++ tests again: debug build, asserts, address and undefined-behaviour sanitizers, Eigen's allocation guard
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

setup: $(BUILD)/installed-$(WERROR)-$(ASSERTS)

# the virtual environment, with what builds and tests
$(VENV)/ready: pyproject.toml .ci/machine
	@.ci/machine check $(PYTHON)
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade "pip>=25.1"
	$(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["build-system"]["requires"], sep="\n")' \
	  > $(VENV)/build-requirements.txt
	$(BIN)/python -m pip install --quiet -r $(VENV)/build-requirements.txt --group dev
	@touch $@

# one build serves the module, the tests and the benchmarks
$(BUILD)/installed-$(WERROR)-$(ASSERTS): $(VENV)/ready build/names $(SOURCES)
	@echo "compiling Hurcules; from nothing this takes some minutes"
	@$(BIN)/python -m pip install --quiet --no-build-isolation --editable . \
	  --config-settings build-dir=$(BUILD) \
	  --config-settings cmake.define.HURCULES_TESTS=ON \
	  --config-settings cmake.define.HURCULES_BENCHMARKS=ON \
	  --config-settings cmake.define.HURCULES_WERROR=$(WERROR) \
	  --config-settings cmake.define.HURCULES_ASSERTS=$(ASSERTS)
	@touch $@

clean:
	rm -rf $(VENV) build
