# Two commands: `make reproduce` runs the main job, `make test` runs every test.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
TOOLS ?= .tools

.PHONY: reproduce test coverage fuzz check format benchmark setup setup-dev setup-docs lock audit kill mutants clean

reproduce: setup
	$(BIN)/singletrack reproduce

test: setup-dev check
	$(BIN)/python -m pytest -n auto

# Lines and branches against a floor (pyproject.toml); tracing is slow, so that `make test` does without.
coverage: setup-dev
	$(BIN)/python -m pytest -n auto --cov --cov-report=term

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

# The site: built into docs/_build/html, executed again only where something has changed; warnings are errors. In one
# process, since some scripts of the gallery compute with JAX, whose threads do not survive a fork.
.PHONY: docs
docs: setup-docs
	$(BIN)/python -m sphinx -W --keep-going --quiet -b html docs docs/_build/html
	@echo "docs/_build/html/index.html"

setup: $(VENV)/ready
setup-docs: $(VENV)/ready-docs
setup-dev: $(VENV)/ready-dev

# Every package is one of those whose hashes are listed, and no other is looked for (an extra of a listed one would be); ours is built by tools among them, and not by others.
INSTALL = $(BIN)/python -m pip install --quiet --disable-pip-version-check

$(VENV)/ready: pyproject.toml requirements/run.txt
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) --require-hashes --no-deps --requirement requirements/run.txt
	$(INSTALL) --no-deps --no-build-isolation --editable .
	touch $@

$(VENV)/ready-dev: pyproject.toml requirements/dev.txt
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) --require-hashes --no-deps --requirement requirements/dev.txt
	$(INSTALL) --no-deps --no-build-isolation --editable .
	touch $@ $(VENV)/ready

$(VENV)/ready-docs: pyproject.toml requirements/docs.txt
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) --require-hashes --no-deps --requirement requirements/docs.txt
	$(INSTALL) --no-deps --no-build-isolation --editable .
	touch $@ $(VENV)/ready

$(TOOLS)/ready: requirements/tools.txt
	$(PYTHON) -m venv $(TOOLS)
	$(TOOLS)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps --requirement requirements/tools.txt
	touch $@

# After a change of dependencies: pin the version in constraints.txt, then write the lists of hashes anew, for every
# Python from 3.11 on and every system.
LOCK = $(TOOLS)/bin/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-annotate --no-header \
	--no-config --constraint constraints.txt

lock: $(TOOLS)/ready
	$(LOCK) pyproject.toml requirements/build.in --output-file requirements/run.txt
	$(LOCK) pyproject.toml requirements/build.in --extra dev --output-file requirements/dev.txt
	$(LOCK) pyproject.toml requirements/build.in --extra docs --output-file requirements/docs.txt
	$(LOCK) requirements/tools.in --output-file requirements/tools.txt

audit: $(TOOLS)/ready
	$(TOOLS)/bin/python requirements/audit.py $(TOOLS)/bin/pip-audit $(LISTS)

# One hundred kills at random instants, and every call to the system failing in turn.
kill: setup-dev
	SINGLETRACK_KILLS=100 SINGLETRACK_EXHAUSTIVE=1 $(BIN)/python -m pytest tests/sweep/test_kills.py \
		tests/sweep/test_durable.py tests/sweep/test_damage.py

# Mutation testing of the packages in MUTANTS: a seeded sample of each (SAMPLE=0: every mutant, which takes hours).
MUTANTS ?= body posture linear multibody analysis
SAMPLE ?= 150
SEED ?= 20261124
mutants: setup-dev $(TOOLS)/ready
	$(TOOLS)/bin/python tests/mutation/run.py --python $(abspath $(BIN))/python --sample $(SAMPLE) --seed $(SEED) $(MUTANTS)

clean:
	rm -rf $(VENV) $(TOOLS) build dist singletrack-output .mypy_cache .ruff_cache .import_linter_cache docs/_build docs/auto_gallery docs/*/generated

# Programs of single designs, traced from the closed form and shipped (data/programs).
.PHONY: programs
programs: setup-dev
	$(BIN)/python -m singletrack.closed_form.generate

# The page in the browser: programs traced from the equations, sources checked and built (needs npm), result shipped.
.PHONY: page page-check page-programs page-speed
# Types of the page's sources.
page-check:
	cd web && npm ci --no-audit --no-fund --loglevel=error && npm run check

# A redraw within a frame, measured with nothing beside it.
page-speed: setup-dev
	$(BIN)/python -m pytest -n 0 -rs -s benchmarks/bench_page.py

page-programs: setup-dev
	$(BIN)/python -m singletrack.webpage.generate web/src/generated

page: page-programs
	cd web && npm ci --no-audit --no-fund --loglevel=error && npm run build
	cp web/dist/index.html src/singletrack/webpage/static/page.html
	$(BIN)/python -m singletrack.webpage.sources web > src/singletrack/webpage/static/page.sha256
