# The portable part of the firmware on the PC: its tests, with doctest (Debian doctest-dev) and the
# sanitizers. Included by arduino/Makefile; works alone too: make -C arduino -f host/host.mk host-test
#   PARTS="store core"   compile only these folders of raspilot/src (all: core protocol ...)
#   TESTS="store"        compile only host/test_store*.cpp
#   RUN="-tc=*profile*"  options for the test program
HOST_BUILD ?= build/host
HOST_CXX ?= g++
PARTS ?= core protocol protocol/commands pilot control store
TESTS ?=
RUN ?=

HOST_FLAGS := -std=gnu++11 -O1 -g -Wall -Wextra -Wconversion -Wshadow -Werror \
	-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
HOST_DEFINES := -DVECTORS='"$(abspath ../tests/vectors)"'

PORTABLE := $(sort $(foreach part,$(PARTS),$(wildcard raspilot/src/$(part)/*.cpp)))
HOST_SOURCES := host/main.cpp $(sort $(wildcard host/fake_*.cpp)) \
	$(sort $(if $(TESTS),$(foreach test,$(TESTS),$(wildcard host/test_$(test)*.cpp)),$(wildcard host/test_*.cpp)))
# The fuzzer's rules, for the test that replays its scripts.
HOST_SOURCES += $(if $(filter host/test_protocol_fuzz.cpp,$(HOST_SOURCES)),host/fuzz/link_script.cpp)
HOST_OBJECTS := $(patsubst %.cpp,$(HOST_BUILD)/%.o,$(PORTABLE) $(HOST_SOURCES))

.PHONY: host host-test host-clean

host: $(HOST_BUILD)/tests

host-test: $(HOST_BUILD)/tests
	$(HOST_BUILD)/tests $(RUN)

host-clean:
	rm -rf $(HOST_BUILD)

# The list of objects decides too: another choice of parts links anew.
$(HOST_BUILD)/objects: FORCE
	@mkdir -p $(@D)
	@echo '$(HOST_OBJECTS)' | cmp -s - $@ || echo '$(HOST_OBJECTS)' > $@

$(HOST_BUILD)/tests: $(HOST_OBJECTS) $(HOST_BUILD)/objects
	$(HOST_CXX) $(HOST_FLAGS) -o $@ $(HOST_OBJECTS)

$(HOST_BUILD)/%.o: %.cpp host/host.mk
	@mkdir -p $(@D)
	@[ -f /usr/include/doctest/doctest.h ] || \
		{ echo 'The host tests need doctest: apt-get install doctest-dev' >&2; exit 1; }
	$(HOST_CXX) $(HOST_FLAGS) $(HOST_DEFINES) -Iraspilot/src -Ihost -MMD -MP -c -o $@ $<

.PHONY: FORCE
FORCE:

-include $(HOST_OBJECTS:.o=.d)
