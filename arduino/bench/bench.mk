# The bench rig: its C part, and the firmware's figures measured on it.
.PHONY: rig
rig:
	@cd bench && python3 -c "from up_rig.library import build_library; print(build_library())"

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
