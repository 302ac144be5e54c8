# The second fuzzer: the whole firmware flies with arbitrary input on the line. After fuzz.mk.
#   make -C arduino fuzz-flying SECONDS=60   search; an input that breaks a rule stays in build/fuzz
#   make -C arduino fuzz-flying-keep         keep the fewest inputs that reach all code reached
#   make -C arduino fuzz-corpus              run each kept input of both fuzzers once
FLYING_CORPUS := host/fuzz/flying_corpus
FLYING_OBJECTS := $(patsubst %.cpp,$(FUZZ_BUILD)/%.o,\
	$(filter-out host/fuzz/%,$(FUZZ_SOURCES)) host/fuzz/flying_fuzz.cpp)

.PHONY: fuzz-flying fuzz-flying-keep fuzz-corpus

fuzz-flying: $(FUZZ_BUILD)/flying_fuzz
	@mkdir -p $(FUZZ_BUILD)/flying
	$< -max_total_time=$(SECONDS) -max_len=600 -dict=host/fuzz/steps.dict \
		-artifact_prefix=$(FUZZ_BUILD)/ -print_final_stats=1 $(FUZZ_BUILD)/flying $(FLYING_CORPUS)

fuzz-flying-keep: $(FUZZ_BUILD)/flying_fuzz
	@rm -rf $(FUZZ_BUILD)/kept && mkdir -p $(FUZZ_BUILD)/kept $(FUZZ_BUILD)/flying $(FLYING_CORPUS)
	$< -set_cover_merge=1 -use_counters=0 $(FUZZ_BUILD)/kept $(FLYING_CORPUS) $(FUZZ_BUILD)/flying
	rm -f $(FLYING_CORPUS)/* && cp $(FUZZ_BUILD)/kept/* $(FLYING_CORPUS)/

fuzz-corpus: $(FUZZ_BUILD)/fuzz_link $(FUZZ_BUILD)/flying_fuzz
	$(FUZZ_BUILD)/fuzz_link $(sort $(wildcard host/fuzz/corpus/*))
	$(FUZZ_BUILD)/flying_fuzz $(sort $(wildcard $(FLYING_CORPUS)/*))

$(FUZZ_BUILD)/flying_fuzz: $(FLYING_OBJECTS)
	$(FUZZ_CXX) $(FUZZ_FLAGS) -o $@.new $(FLYING_OBJECTS)
	@mv $@.new $@

-include $(FUZZ_BUILD)/host/fuzz/flying_fuzz.d
