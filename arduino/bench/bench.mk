# The bench rig: its C part, and the firmware's figures measured on it.
RIG := build/librig.so
RIG_SOURCES := $(wildcard bench/up_rig/shim/*.c)

.PHONY: rig
rig: $(RIG)

$(RIG): $(RIG_SOURCES) $(wildcard bench/up_rig/shim/*.h)
	$(call need,gcc,gcc)
	@[ -f /usr/include/simavr/sim_avr.h ] || { echo 'Building the bench rig needs simavr:' \
		'apt-get install libsimavr-dev libelf-dev' >&2; exit 1; }
	@mkdir -p $(@D)
	gcc -std=gnu11 -O2 -Wall -Wextra -fPIC -shared $(RIG_SOURCES) -lsimavr -o $@.new
	@mv $@.new $@

# Latency, jitter, loop, interrupts, memory and size of the binary, against docs/performance.md.
.PHONY: figures
figures: rig
	@$(MAKE) -s -C .. .venv/.run-ready
	@cd .. && .venv/bin/python -m bench firmware $(if $(QUICK),--quick)

# Each safety rule is taken out of a copy, and its test must fail: RULES="words of rule or test".
.PHONY: mutations
mutations: rig
	@$(MAKE) -s -C .. .venv/.dev-ready
	@cd .. && .venv/bin/python -m tests.arduino.mutate $(RULES)
