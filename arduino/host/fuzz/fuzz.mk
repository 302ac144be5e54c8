# Fuzzing of the serial line by libFuzzer (Debian clang). Included by arduino/Makefile; alone:
#   make -C arduino -f host/fuzz/fuzz.mk fuzz SECONDS=60
# The host tests replay host/fuzz/corpus. `fuzz-keep` adds new findings to it.
FUZZ_BUILD ?= build/fuzz
FUZZ_CXX ?= clang++
SECONDS ?= 60
FUZZ_LENGTH ?= 600

FUZZ_FLAGS := -std=gnu++11 -O1 -g -Wall -Wextra -fsanitize=fuzzer,address,undefined \
	-fno-sanitize-recover=all
FUZZ_PARTS := core protocol protocol/commands pilot control store
FUZZ_SOURCES := $(sort $(foreach part,$(FUZZ_PARTS),$(wildcard raspilot/src/$(part)/*.cpp))) \
	host/fake_board.cpp host/fuzz/link_script.cpp host/fuzz/fuzz_link.cpp
FUZZ_OBJECTS := $(FUZZ_SOURCES:%.cpp=$(FUZZ_BUILD)/%.o)

.PHONY: fuzz fuzz-keep

fuzz: $(FUZZ_BUILD)/fuzz_link
	@mkdir -p $(FUZZ_BUILD)/found
	cd $(FUZZ_BUILD) && ./fuzz_link -max_total_time=$(SECONDS) -max_len=$(FUZZ_LENGTH) \
		-print_final_stats=1 found $(abspath host/fuzz/corpus)

fuzz-keep: $(FUZZ_BUILD)/fuzz_link
	cd $(FUZZ_BUILD) && ./fuzz_link -merge=1 -max_len=200 $(abspath host/fuzz/corpus) found

$(FUZZ_BUILD)/fuzz_link: $(FUZZ_OBJECTS)
	$(FUZZ_CXX) $(FUZZ_FLAGS) -o $@.new $(FUZZ_OBJECTS)
	@mv $@.new $@

$(FUZZ_BUILD)/%.o: %.cpp host/fuzz/fuzz.mk
	@mkdir -p $(@D)
	@command -v $(FUZZ_CXX) >/dev/null || \
		{ echo 'Fuzzing needs clang: apt-get install clang' >&2; exit 1; }
	@[ -d "$$($(FUZZ_CXX) -print-runtime-dir)" ] || \
		{ echo "Fuzzing needs clang's runtime: apt-get install libclang-rt-dev" >&2; exit 1; }
	$(FUZZ_CXX) $(FUZZ_FLAGS) -Iraspilot/src -Ihost -MMD -MP -c -o $@ $<

-include $(FUZZ_OBJECTS:.o=.d)
