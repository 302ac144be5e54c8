# Fuzzing of the serial line, with clang's libFuzzer. Included by arduino/Makefile.
#   make -C arduino fuzz SECONDS=60   search; what breaks a rule is kept in build/fuzz
#   make -C arduino fuzz-corpus       run each kept input once
#   make -C arduino fuzz-keep         keep of what the search found what reaches new code
FUZZ_BUILD ?= build/fuzz
FUZZ_CXX ?= clang++
FUZZ_CORPUS := host/fuzz/corpus
SECONDS ?= 60

FUZZ_FLAGS := -std=gnu++11 -O2 -g -Wall -Wextra -Werror -fsanitize=fuzzer,address,undefined \
	-fno-sanitize-recover=all
FUZZ_SOURCES := $(sort $(foreach part,core protocol protocol/commands pilot control store,\
	$(wildcard raspilot/src/$(part)/*.cpp))) host/fake_board.cpp host/fuzz/link_fuzz.cpp
FUZZ_OBJECTS := $(FUZZ_SOURCES:%.cpp=$(FUZZ_BUILD)/%.o)

.PHONY: fuzz fuzz-corpus fuzz-keep

fuzz: $(FUZZ_BUILD)/link_fuzz
	@mkdir -p $(FUZZ_BUILD)/found
	$< -max_total_time=$(SECONDS) -max_len=600 -dict=host/fuzz/steps.dict \
		-artifact_prefix=$(FUZZ_BUILD)/ -print_final_stats=1 $(FUZZ_BUILD)/found $(FUZZ_CORPUS)

fuzz-corpus: $(FUZZ_BUILD)/link_fuzz
	$< $(sort $(wildcard $(FUZZ_CORPUS)/*))

# Branches alone count, not how often: so the corpus stays small.
fuzz-keep: $(FUZZ_BUILD)/link_fuzz
	@rm -rf $(FUZZ_BUILD)/kept && mkdir -p $(FUZZ_BUILD)/kept $(FUZZ_BUILD)/found
	$< -set_cover_merge=1 -use_counters=0 $(FUZZ_BUILD)/kept $(FUZZ_CORPUS) $(FUZZ_BUILD)/found
	rm -f $(FUZZ_CORPUS)/* && cp $(FUZZ_BUILD)/kept/* $(FUZZ_CORPUS)/

$(FUZZ_BUILD)/link_fuzz: $(FUZZ_OBJECTS)
	@$(FUZZ_CXX) $(FUZZ_FLAGS) -o $@ $(FUZZ_OBJECTS)

$(FUZZ_BUILD)/%.o: %.cpp host/fuzz/fuzz.mk
	@command -v $(FUZZ_CXX) >/dev/null || \
		{ echo 'Fuzzing the firmware needs clang: apt-get install clang' >&2; exit 1; }
	@mkdir -p $(@D)
	@$(FUZZ_CXX) $(FUZZ_FLAGS) -Iraspilot/src -Ihost -MMD -MP -c -o $@ $<

-include $(FUZZ_OBJECTS:.o=.d)
