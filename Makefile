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

# The page in the browser: programs traced from the equations, sources checked and built (needs npm), result shipped.
.PHONY: page page-check page-programs
# Types of the page's sources.
page-check:
	cd web && npm ci --no-audit --no-fund --loglevel=error && npm run check

page-programs: setup-dev
	$(BIN)/python -m singletrack.webpage.generate web/src/generated

page: page-programs
	cd web && npm ci --no-audit --no-fund --loglevel=error && npm run build
	cp web/dist/index.html src/singletrack/webpage/static/page.html
	$(BIN)/python -m singletrack.webpage.sources web > src/singletrack/webpage/static/page.sha256
