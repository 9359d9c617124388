# `make demo` and `make test` need git, python3, g++ and make; they fetch everything else.
# What is done is not done again: the stamps below depend on the sources.

PYTHON ?= python3
JOBS   := $(shell nproc 2>/dev/null || echo 2)

export CMAKE_BUILD_PARALLEL_LEVEL := $(JOBS)
export CTEST_PARALLEL_LEVEL := $(JOBS)
export PIP_DISABLE_PIP_VERSION_CHECK := 1

VENV    := .venv
PY      := $(VENV)/bin/python
PIP     := $(PY) -m pip install --quiet

# Folders count as well: their time changes when a file is deleted.
SOURCES := CMakeLists.txt pyproject.toml README.md \
           $(shell find cmake cpp python -name __pycache__ -prune -o -print)

.PHONY: help demo test test-cpp test-python bench sanitize coverage docs fuzz lint format stubs clean
.DELETE_ON_ERROR:

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14

demo: $(VENV)/package ## solve and show a first example
	@$(VENV)/bin/pyrod demo demo.png

test: test-cpp test-python ## run the C++ and the Python tests

test-cpp: build/tests/configured ## run the C++ tests
	@cmake --build --preset dev
	@ctest --preset dev

test-python: build/test-packages $(VENV)/package $(VENV)/test-tools ## run the Python tests
	@$(PY) -m pytest

bench: build/system-packages $(VENV)/package $(VENV)/test-tools ## run the benchmarks, 20 minutes
	@cmake --preset release
	@cmake --build --preset release --target bench
	@$(PY) benchmarks/call_overhead.py build/release/benchmarks/call
	@$(PY) benchmarks/tendon_robot.py build/release/benchmarks/tendon_shooting
	@$(PY) benchmarks/curves.py
	@$(PY) benchmarks/sweep.py
	@$(PY) benchmarks/gradient.py
	@cd benchmarks && ../$(PY) -m peers.run

sanitize: build/system-packages $(VENV)/test-tools ## run all tests under the sanitizers
	@cmake --workflow --preset asan
	@cmake --workflow --preset tsan

coverage: build/system-packages $(VENV)/package $(VENV)/test-tools ## tell which lines the tests reach
	@cmake --workflow --preset coverage
	@$(VENV)/bin/gcovr --filter cpp/include --gcov-ignore-parse-errors=negative_hits.warn_once_per_file \
	  --print-summary build/coverage
	@$(PY) -m pytest -q --cov --cov-report=term:skip-covered

docs: $(VENV)/package $(VENV)/test-tools ## build the documentation site into build/docs
	@$(PY) -m sphinx -W --keep-going -q -b html docs build/docs
	@echo "Open build/docs/index.html"

fuzz: $(VENV)/package ## look for scene files that break the reader, for five minutes
	@$(PIP) atheris
	@mkdir -p build/fuzz
	@$(PY) tests/fuzz/scene_file.py build/fuzz examples/scenes -max_total_time=300

CXX_FILES = $(shell find cpp tests/cpp benchmarks examples -name '*.[ch]pp')
TIDY_FILES = $(shell find cpp/include -name '*.hpp')
TIDY_FLAGS = -x c++ -std=c++20 -Icpp/include -isystem /usr/include/eigen3 -isystem /usr/include/suitesparse

lint: $(VENV)/dev-tools ## check style, types and layers
	@$(VENV)/bin/ruff check
	@$(VENV)/bin/ruff format --check
	@$(VENV)/bin/clang-format --dry-run -Werror $(CXX_FILES)
	@printf '%s\n' $(TIDY_FILES) | xargs -P $(JOBS) -I{} $(VENV)/bin/clang-tidy --quiet {} -- $(TIDY_FLAGS)
	@$(VENV)/bin/mypy
	@PYTHONPATH=python $(VENV)/bin/lint-imports

format: $(VENV)/dev-tools ## format all sources in place
	@$(VENV)/bin/ruff check --fix
	@$(VENV)/bin/ruff format
	@$(VENV)/bin/clang-format -i $(CXX_FILES)

stubs: $(VENV)/package $(VENV)/dev-tools ## regenerate the type stubs in python/pyrod/_core
	@$(PY) -m pybind11_stubgen --exit-code --output-dir python pyrod._core

clean: ## remove everything these targets made
	rm -rf build dist docs/gallery $(VENV) .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache

# Stamps ------------------------------------------------------------------------------------------

build/system-packages: scripts/system-packages.sh
	@PYTHON=$(PYTHON) scripts/system-packages.sh
	@mkdir -p build && touch $@

build/test-packages: scripts/system-packages.sh build/system-packages
	@PYTHON=$(PYTHON) scripts/system-packages.sh test
	@touch $@

build/tests/configured: CMakePresets.json build/system-packages
	@cmake --preset dev
	@touch $@

$(VENV)/build-tools: build/system-packages
	@echo "Creating $(VENV)"
	@$(PYTHON) -m venv --clear $(VENV)
	@$(PIP) scikit-build-core pybind11
	@touch $@

# The build folder is kept and the build tools are fixed, so that only changed files are compiled.
$(VENV)/package: $(VENV)/build-tools $(SOURCES)
	@echo "Building and installing pyrod into $(VENV)"
	@touch build/package-began
	@$(PIP) --no-build-isolation --check-build-dependencies \
	  --config-settings=build-dir=build/python '.[all]'
	@touch -r build/package-began $@ # what was edited meanwhile is newer

# pyrod is there already: these only add the tools that its extras name.
$(VENV)/test-tools: pyproject.toml $(VENV)/build-tools | $(VENV)/package
	@$(PIP) 'pyrod[test]'
	@touch $@

$(VENV)/dev-tools: pyproject.toml $(VENV)/build-tools | $(VENV)/package
	@$(PIP) 'pyrod[dev]'
	@touch $@
