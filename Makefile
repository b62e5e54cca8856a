PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
REPORT := out/paper
MANUAL := out/docs

.PHONY: help demo test docs lint benchmark clean

help:
	@echo "make demo       install into $(VENV), reproduce the paper, say where the report is"
	@echo "make test       install into $(VENV), run the whole test suite"
	@echo "make docs       build the manual into $(MANUAL), without a network"
	@echo "make lint       ruff and mypy"
	@echo "make benchmark  time the critical thrust and the maps"
	@echo "make clean      remove $(VENV), $(REPORT), $(MANUAL), builds and caches"
	@echo "Another interpreter than $(PYTHON): make test PYTHON=python3.12"

demo: $(STAMP)
	$(BIN)/beal reproduce -o $(REPORT)
	@echo "The report: $(CURDIR)/$(REPORT)/report.html"

# The workers share the cores already: one thread of linear algebra each.
test: export OPENBLAS_NUM_THREADS = 1
test: export OMP_NUM_THREADS = 1
test: export MKL_NUM_THREADS = 1
test: $(STAMP)
	$(BIN)/python -m pytest -n auto --maxprocesses 8

docs: $(STAMP)
	$(BIN)/python -m sphinx -W --keep-going --quiet -b html docs $(MANUAL)
	@echo "The manual: $(CURDIR)/$(MANUAL)/index.html"

lint: $(STAMP)
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --check --quiet .
	$(BIN)/mypy --no-error-summary

benchmark: $(STAMP)
	$(BIN)/python benchmarks/critical_thrust.py
	$(BIN)/python benchmarks/maps.py

clean:
	rm -rf $(VENV) $(REPORT) $(MANUAL) docs/generated build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +

$(STAMP): pyproject.toml constraints.txt
	@command -v $(PYTHON) >/dev/null || \
	  { echo "There is no $(PYTHON) here. beal needs Python 3.11 or later: make PYTHON=/path/to/python" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "beal needs Python 3.11 or later, found $$($(PYTHON) --version 2>&1): make PYTHON=/path/to/python" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
	  { echo "$(PYTHON) cannot make virtual environments: install its venv module (Debian: python3-venv)" >&2; exit 1; }
	@echo "Installing into $(VENV), once, which takes a minute or more"
	@$(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	@touch $@
