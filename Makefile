# Up and Raspilot. `make help` lists what there is.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
PACKAGES := up raspilot runner/up_runner proxy/up_proxy ground/up_ground flightlog/up_flightlog mavlink/up_mavlink \
	simulator/up_simulator arduino/bench/up_rig
COGS := $(wildcard cogs/*_cog)
# mypy does not see what is installed editable through an import hook.
empty :=
MYPY_ROOTS := $(subst $(empty) $(empty),:,$(strip . mavlink $(COGS)))
SETUPS := setup.py pyproject.toml flightlog/setup.py $(addsuffix /setup.py,$(COGS)) raspilot/Cogfile.yml \
	$(wildcard $(addsuffix /*/registered_modules.yml,$(COGS)))
TEST ?=
# More than CI has cores: many tests wait for real time.
WORKERS ?= 4
BENCH ?=
SCENARIO ?=
CONTROLLER ?=
RADIO ?=
ARGS ?=
# What the ground station's page has from npm. Without npm there is no stamp, and no harm.
VENDOR := ground/up_ground/web/static/vendor
WEB := $(VENDOR)/.stamp

.PHONY: help run scenarios test test-browser check check-python check-phone bench pictures format schema schemas clean

help:
	@echo 'make run      set up everything and fly the virtual aircraft; Ctrl-C stops it'
	@echo '              (CONTROLLER=raspberry, RADIO=keyboard or js0, ARGS=--help for more)'
	@echo 'make scenarios  fly every scenario that is shipped and count (SCENARIO=receiver-lost for some)'
	@echo 'make test     set up everything and run every test (TEST=tests/up for some)'
	@echo 'make test-browser  only the tests of the page in a headless Chromium'
	@echo 'make check    lint, types, import contracts, language; of the phone where a JDK and Debian'"'"'s tools are'
	@echo 'make bench    the performance table (BENCH="bus --quick" for some)'
	@echo 'make pictures  the documentation'"'"'s pictures of the page, from a flight'
	@echo 'make format   put the code into the project'"'"'s form'
	@echo 'make schema   the tables of status, telemetry, events and Commands, from schema/'
	@echo 'make schemas  JSON Schema of every configuration file and Command, into build/schemas'
	@echo 'make -C arduino help  the firmware: build, upload, figures'
	@echo 'make -C android help  the phone: the app, the Up Library, its tests'
	@echo 'make clean    remove what the others made'

$(PY):
	@tools/make_venv $(PYTHON) $(VENV)

# What a user needs: the program, the simulator, the cogs of the Cogfile.
$(VENV)/.run-ready: $(SETUPS) | $(PY)
	@tools/install $(PY) sim,ground,log,keys,mavlink
	@touch $@

# What a developer needs besides.
$(VENV)/.dev-ready: $(SETUPS) | $(PY)
	@tools/install $(PY) dev,sim,ground,log,mavlink
	@touch $@ $(VENV)/.run-ready

$(WEB): ground/package-lock.json tools/web_assets
	@tools/web_assets
	@if [ -e $@ ]; then touch $@; fi

run: $(VENV)/.run-ready $(WEB)
	@tools/toolchain
	@$(PY) -m up_simulator.demo $(if $(CONTROLLER),--controller $(CONTROLLER)) \
		$(if $(RADIO),--radio $(RADIO)) $(ARGS)

scenarios: $(VENV)/.run-ready
	@$(PY) -m up_simulator $(if $(SCENARIO),fly $(SCENARIO),all)

# The tests start many programs. Where PYTHONDONTWRITEBYTECODE is set, each would compile its own.
test: $(VENV)/.dev-ready $(WEB)
	@$(PY) -m compileall -q main.py $(PACKAGES) $(COGS)
	$(PY) -m pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder $(TEST)

# Part of make test.
test-browser: $(VENV)/.dev-ready $(WEB)
	$(PY) -m pytest tests/test_browser.py

check: check-python check-phone

check-phone: | $(VENV)/.dev-ready
	@android/tools/where_ready check

check-python: $(VENV)/.dev-ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy main.py tools/import_contracts.py tools/command_tables.py \
		tools/plain_english.py tools/schema.py tools/schema_definition.py tools/schema_languages.py \
		tools/sentence_assertions.py tools/tuning $(PACKAGES)
	@for cog in $(COGS); do echo "mypy $$cog"; \
		MYPYPATH=$(MYPY_ROOTS) $(BIN)/mypy $$cog/$$(basename $$cog) || exit 1; done
	MYPYPATH=android/tools $(BIN)/mypy android/tools/*.py
	$(PY) tools/import_contracts.py
	$(PY) tools/plain_english.py --max 1
	$(PY) tools/sentence_assertions.py --max 40
	$(PY) tools/schema.py --check

# The peers besides; HAProxy, socat and gcc (Debian) are measured where they are installed.
$(VENV)/.bench-ready: $(SETUPS) | $(PY)
	@tools/install $(PY) bench,dev,sim,ground,log,mavlink
	@touch $@ $(VENV)/.run-ready $(VENV)/.dev-ready

bench: $(VENV)/.bench-ready $(WEB)
	$(PY) -m bench $(BENCH)

pictures: $(VENV)/.run-ready $(WEB)
	@tools/pictures $(PY)

format: $(VENV)/.dev-ready
	$(BIN)/ruff check --fix . ; $(BIN)/ruff format .

# The tables of status, telemetry, events and Commands in every language, from schema/.
schema: $(VENV)/.dev-ready
	$(PY) tools/schema.py

schemas: $(VENV)/.run-ready
	$(BIN)/up schemas build/schemas
	$(PY) tools/schema.py --json build/schemas/commands

clean:
	rm -rf build dist run arduino/build* android/build $(VENV) .pytest_cache .mypy_cache \
		.ruff_cache .hypothesis *.egg-info ground/node_modules $(VENDOR) $(VENDOR).new.*
