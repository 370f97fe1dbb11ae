# footfit. `make demo` and `make test` need Python 3.11 or newer and make; nothing else.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.ready
BENCHMARKS := alignment poses stance bent_lasts flare heels curvature measures trueness tapes fit custom_lasts grading population coverage learning speed growth

.PHONY: demo test check format lint types contracts tests bench torture coverage mutants clean help

help:            ## this list
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*##/\t/'

$(VENV)/.user: pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet --editable .
	@touch $@

$(STAMP): $(VENV)/.user
	$(BIN)/python -m pip install --quiet --editable '.[test]'
	@touch $@

demo: $(VENV)/.user  ## set up, ingest the sample lasts, match a sample foot, draw it
	$(BIN)/footfit demo demo --force

test: $(STAMP)   ## set up and run every test
	$(BIN)/python -m pytest -n 2 -q

check: format lint types contracts test  ## what CI runs

format: $(STAMP) ## is the code formatted?
	$(BIN)/ruff format --check .

lint: $(STAMP)   ## ruff
	$(BIN)/ruff check .

types: $(STAMP)  ## mypy --strict
	$(BIN)/mypy

contracts: $(STAMP)  ## the layers of docs/architecture.md
	$(BIN)/lint-imports

bench: $(STAMP)  ## the benchmarks' tables (make bench WRITE=--write puts them into docs/)
	$(BIN)/python -m pip install --quiet --editable '.[bench]'
	@set -e; for b in $(BENCHMARKS); do $(BIN)/python -m benchmarks.$$b $(WRITE); done

torture: $(STAMP)  ## the long trials of docs/reliability.md (make torture SCALE=0.1 SEED=2)
	$(BIN)/python -m tests.torture --seed $(or $(SEED),1) --scale $(or $(SCALE),1)
	$(BIN)/python -m tools.fuzz --count 20000 --seed $(or $(SEED),1)

$(VENV)/.quality: $(STAMP)
	$(BIN)/python -m pip install --quiet --editable '.[quality]'
	@touch $@

coverage: $(VENV)/.quality  ## branch coverage of footfit/ by all tests; fails under 95 %
	$(BIN)/python -m coverage erase
	$(BIN)/python -m coverage run -m pytest -n 2 -q
	$(BIN)/python -m coverage combine --quiet
	$(BIN)/python -m coverage report

mutants: $(VENV)/.quality  ## does a test notice? (make mutants SEED=1 COUNT=200 PATHS=footfit/geometry)
	$(BIN)/python -m tools.mutants --seed $(or $(SEED),1) --count $(or $(COUNT),200) $(PATHS)

clean:           ## remove what make made
	rm -rf $(VENV) .mutants .coverage .coverage.* demo dist build .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
