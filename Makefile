# Up and Raspilot. `make help` lists what there is.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
PY := $(BIN)/python
PACKAGES := up raspilot runner/up_runner proxy/up_proxy cluster/up_cluster ground/up_ground flightlog/up_flightlog mavlink/up_mavlink \
	simulator/up_simulator arduino/bench/up_rig
COGS := $(wildcard cogs/*_cog)
# mypy does not see what is installed editable through an import hook.
empty :=
MYPY_ROOTS := $(subst $(empty) $(empty),:,$(strip . mavlink android/tools $(COGS)))
SETUPS := setup.py pyproject.toml flightlog/setup.py $(addsuffix /setup.py,$(COGS)) raspilot/Cogfile.yml \
	$(wildcard $(addsuffix /*/registered_modules.yml,$(COGS)))
VERSION := $(shell sed -n 's/^VERSION = "\(.*\)"/\1/p' up/version.py)
VERSIONED := flightlog/setup.py $(addsuffix /setup.py,$(COGS))
TEST ?=
# More than CI has cores: many tests wait for real time.
WORKERS ?= 5
BENCH ?=
SCENARIO ?=
CONTROLLER ?=
RADIO ?=
ARGS ?=
ARCH ?=
REVISION ?= 1
# What the ground station's page has from npm. Without npm there is no stamp, and no harm.
VENDOR := ground/up_ground/web/static/vendor
WEB := $(VENDOR)/.stamp

.PHONY: help run scenarios test test-browser compile-tests check check-python check-phone bench pictures docs format schema schemas dist test-dist test-bundle deb test-deb test-arm lock version clean

help:
	@echo 'make run      set up everything and fly the virtual aircraft; Ctrl-C stops it'
	@echo '              (CONTROLLER=raspberry, RADIO=keyboard or js0, ARGS=--help for more)'
	@echo 'make scenarios  fly every scenario that is shipped and count (SCENARIO=receiver-lost for some)'
	@echo 'make test     set up everything and run every test (TEST=tests/up for some)'
	@echo 'make test-browser  only the tests of the page in a headless Chromium'
	@echo 'make check    lint, types, import contracts, language; of the phone where a JDK and Debian'"'"'s tools are'
	@echo 'make bench    the performance table (BENCH="bus --quick" for some)'
	@echo 'make pictures  the documentation'"'"'s pictures of the page, from a flight'
	@echo 'make docs     the documentation as a site, into build/site; the ground station serves it, too'
	@echo 'make format   put the code into the project'"'"'s form'
	@echo 'make schema   the tables of status, telemetry, events and Commands, from schema/'
	@echo 'make schemas  JSON Schema of every configuration file and Command, into build/schemas'
	@echo 'make dist     sdist and wheel of every distribution, into dist/'
	@echo 'make test-dist  installs these into a new environment outside the tree and tries the programs'
	@echo 'make test-bundle  a USB stick of these: installed without a network, rolled back, removed'
	@echo 'make deb      Debian packages of daemon, proxy, runner and ground station, into dist/ (ARCH="amd64 arm64", REVISION=2)'
	@echo 'make test-deb  installs, kills, upgrades and removes these under systemd in a container; as root'
	@echo 'make test-arm chosen tests on arm64 and armhf under emulation (ARCH=armhf for one); as root'
	@echo 'make lock     constraints.txt: exact versions and hashes for servers'
	@echo 'make version  give every distribution the version of up/version.py'
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

# Else each worker of the tests would compile them; "make test" reports what cannot be collected. The
# page's files come beside the installation, not after it.
compile-tests: $(VENV)/.dev-ready $(WEB)
	-@$(PY) -m pytest --collect-only -q >/dev/null

check-phone:
	@android/tools/where_ready check

check-python: $(VENV)/.dev-ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	MYPYPATH=$(MYPY_ROOTS) $(BIN)/mypy main.py $(wildcard tools/*.py) tools/tuning android/tools/*.py \
		$(PACKAGES) $(foreach cog,$(COGS),$(cog)/$(notdir $(cog)))
	$(PY) tools/import_contracts.py
	$(PY) tools/plain_english.py --max 1
	$(PY) tools/sentence_assertions.py --max 40
	$(PY) tools/schema.py --check
	@test -z "$$(grep -L 'version="$(VERSION)"' $(VERSIONED))" || \
		{ echo 'A setup.py has another version than up/version.py: make version' >&2; exit 1; }

# The peers besides; HAProxy, socat and gcc (Debian) are measured where they are installed.
$(VENV)/.bench-ready: $(SETUPS) | $(PY)
	@tools/install $(PY) bench,dev,sim,ground,log,mavlink
	@touch $@ $(VENV)/.run-ready $(VENV)/.dev-ready

bench: $(VENV)/.bench-ready $(WEB)
	$(PY) -m bench $(BENCH)

pictures: $(VENV)/.run-ready $(WEB)
	@tools/pictures $(PY)

$(VENV)/.docs-ready: $(SETUPS) | $(VENV)/.run-ready
	@tools/install $(PY) docs
	@touch $@

docs: $(VENV)/.docs-ready
	@$(PY) tools/docs_site.py

format: $(VENV)/.dev-ready
	$(BIN)/ruff check --fix . ; $(BIN)/ruff format .

# The tables of status, telemetry, events and Commands in every language, from schema/.
schema: $(VENV)/.dev-ready
	$(PY) tools/schema.py

schemas: $(VENV)/.run-ready
	$(BIN)/up schemas build/schemas
	$(PY) tools/schema.py --json build/schemas/commands

# Needs npm and the AVR compiler: a release without the page's libraries or the firmware is refused.
dist: docs $(WEB)
	@$(MAKE) -s -C arduino release
	$(PY) tools/dist.py

test-dist: $(VENV)/.dev-ready dist
	$(PY) -m pytest tests/dist/trial.py

# Builds a second version of it; needs root, for a namespace without a network.
test-bundle: $(VENV)/.dev-ready dist
	$(PY) -m pytest tests/dist/bundle_trial.py

deb: $(VENV)/.dev-ready dist
	$(PY) -m tools.deb --revision $(REVISION) $(if $(ARCH),--arch $(ARCH))

test-deb: deb
	UP_REQUIRE_TOOLS=1 $(PY) -m pytest -s tests/dist/deb_trial.py

# Not part of CI: under emulation each architecture takes minutes.
test-arm: $(VENV)/.dev-ready
	$(PY) -m tools.arm_tests $(ARCH)

# constraints.txt: exact versions and hashes for servers and images.
lock: dist
	@tools/lock

# A cog's setup.py has it as a literal: an sdist of the cog has no up/ beside it.
version:
	@sed -i -E 's/^(    version=)".*"/\1"$(VERSION)"/' $(VERSIONED)
	@code=$$($(PYTHON) android/tools/verify.py code $(VERSION)) && sed -i -E \
		-e 's/^( *- versionName|CurrentVersion): .*/\1: $(VERSION)/' -e 's/^( *commit): .*/\1: v$(VERSION)/' \
		-e "s/^( *versionCode|CurrentVersionCode): .*/\1: $$code/" android/fdroid/org.raspilot.yml

clean:
	rm -rf build dist run arduino/build* android/build $(VENV) .pytest_cache .mypy_cache \
		.ruff_cache .hypothesis *.egg-info ground/node_modules $(VENDOR) $(VENDOR).new.* \
		ground/up_ground/web/static/docs
