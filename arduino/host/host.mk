# The portable part of the firmware on the PC: its tests, with doctest (Debian doctest-dev) and the
# sanitizers. Included by arduino/Makefile; works alone too: make -C arduino -f host/host.mk host-test
#   PARTS="store core"   compile only these folders of raspilot/src (all: core protocol ...)
#   TESTS="store"        compile only host/test_store*.cpp
#   RUN="-tc=*profile*"  options for the test program
HOST_BUILD ?= build/host
# Clang compiles them in less time; both must.
HOST_CXX ?= $(shell command -v clang++ || echo g++)
PARTS ?= core protocol protocol/commands pilot control store
TESTS ?=
RUN ?=
WERROR ?= -Werror

HOST_FLAGS := -std=gnu++11 -O1 -g -Wall -Wextra -Wconversion -Wshadow $(WERROR) \
	-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
HOST_DEFINES := -DVECTORS='"$(abspath ../tests/vectors)"'

PORTABLE := $(sort $(foreach part,$(PARTS),$(wildcard raspilot/src/$(part)/*.cpp)))
HOST_SOURCES := host/main.cpp host/wire_vectors.cpp $(sort $(wildcard host/fake_*.cpp)) \
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

# The list of objects decides too: another choice of parts links again.
$(HOST_BUILD)/objects: FORCE
	@mkdir -p $(@D)
	@echo '$(HOST_OBJECTS)' | cmp -s - $@ || echo '$(HOST_OBJECTS)' > $@

$(HOST_BUILD)/tests: $(HOST_OBJECTS) $(HOST_BUILD)/objects
	$(HOST_CXX) $(HOST_FLAGS) -o $@.new $(HOST_OBJECTS)
	@mv $@.new $@

$(HOST_BUILD)/%.o: %.cpp host/host.mk
	@mkdir -p $(@D)
	@[ -f /usr/include/doctest/doctest.h ] || \
		{ echo 'The host tests need doctest: apt-get install doctest-dev' >&2; exit 1; }
	$(HOST_CXX) $(HOST_FLAGS) $(FASTER) $(HOST_DEFINES) -Iraspilot/src -Ihost -MMD -MP -c -o $@ $<

# Most of the time goes into optimizing and instrumenting the headers of doctest and json.
$(HOST_BUILD)/host/%.o: FASTER := -O0 -g1 -DDOCTEST_CONFIG_SUPER_FAST_ASSERTS
$(HOST_BUILD)/host/main.o $(HOST_BUILD)/host/wire_vectors.o: FASTER := -O0 -g1 -fno-sanitize=all

# The same sources with a board around them, for a program that loads them (host/library/host_board.h):
# where the AVR compiler is missing, the simulator flies these.
HOST_LIBRARY := build/libraspilot.so
LIBRARY_BUILD := build/host-library
LIBRARY_CXX ?= $(shell command -v g++ || command -v clang++)
LIBRARY_FLAGS := -std=gnu++11 -O2 -g -Wall -Wextra -fPIC -fvisibility=hidden -DF_CPU=16000000L \
	-DRASPILOT_BAUD=$(or $(BAUD),115200)L -Ihost/library -Iraspilot/src -MMD -MP
# The parts of src/chip that are not listed below: host/library replaces or includes them.
LIBRARY_SOURCES := $(sort $(wildcard host/library/*.cpp)) \
	$(sort $(foreach part,core protocol protocol/commands pilot control store,$(wildcard raspilot/src/$(part)/*.cpp))) \
	raspilot/src/chip/mpu6050.cpp raspilot/src/chip/servos.cpp
LIBRARY_OBJECTS := $(LIBRARY_SOURCES:%.cpp=$(LIBRARY_BUILD)/%.o) $(LIBRARY_BUILD)/raspilot/raspilot.ino.o

.PHONY: host-library
host-library: $(HOST_LIBRARY)

$(HOST_LIBRARY): $(LIBRARY_OBJECTS) $(LIBRARY_BUILD)/choice
	@echo 'link $@'
	@$(LIBRARY_CXX) -shared -o $@.new $(LIBRARY_OBJECTS) && mv $@.new $@

$(LIBRARY_BUILD)/choice: FORCE
	@[ -n '$(LIBRARY_CXX)' ] || { echo 'Building the firmware for this computer needs a C++ compiler:' \
		'apt-get install g++' >&2; exit 1; }
	@mkdir -p $(@D)
	@echo '$(LIBRARY_CXX) $(LIBRARY_FLAGS) $(LIBRARY_OBJECTS)' | cmp -s - $@ || \
		echo '$(LIBRARY_CXX) $(LIBRARY_FLAGS) $(LIBRARY_OBJECTS)' > $@

$(LIBRARY_BUILD)/%.o: %.cpp $(LIBRARY_BUILD)/choice
	@mkdir -p $(@D)
	@echo 'compile $< for this computer'
	@$(LIBRARY_CXX) $(LIBRARY_FLAGS) -c -o $@ $<

$(LIBRARY_BUILD)/raspilot/raspilot.ino.o: raspilot/raspilot.ino $(LIBRARY_BUILD)/choice
	@mkdir -p $(@D)
	@$(LIBRARY_CXX) $(LIBRARY_FLAGS) -x c++ -c -o $@ $<

.PHONY: FORCE
FORCE:

-include $(HOST_OBJECTS:.o=.d) $(LIBRARY_OBJECTS:.o=.d)
