# Two commands: `make reproduce` runs the main job, `make test` runs every test.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin

.PHONY: reproduce test fuzz check format benchmark setup setup-dev clean

reproduce: setup
	$(BIN)/singletrack reproduce

test: setup-dev check
	$(BIN)/python -m pytest -n auto

fuzz: setup-dev
	$(BIN)/python tests/fuzz/run.py --count 6000

check: setup-dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: setup-dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

benchmark: setup-dev
	$(BIN)/python -m pytest benchmarks --benchmark-enable

setup: $(VENV)/ready
setup-dev: $(VENV)/ready-dev

$(VENV)/ready: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable .
	touch $@

$(VENV)/ready-dev: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[dev]'
	touch $@ $(VENV)/ready

clean:
	rm -rf $(VENV) build dist singletrack-output .mypy_cache .ruff_cache .import_linter_cache
