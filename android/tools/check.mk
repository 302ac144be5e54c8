# Static checks: calls newer than their guard, and SpotBugs.
PUBLIC_23 := $(JARS)/gummy-bears-api-23-0.12.0.signature
PUBLIC_26 := $(JARS)/gummy-bears-api-26-0.12.0.signature
# There is no signature of API 29: a list has what it adds to API 26.
PUBLIC_29 := $(PUBLIC_26)
SNIFFER := $(JARS)/animal-sniffer-1.24.jar:$(JARS)/asm-9.7.jar
SNIFF := $(JVM) -cp $(BUILD)/signatures.jar:$(SNIFFER) Signatures
OURS := org.raspilot
comma := ,

$(BUILD)/signatures.jar: tools/Signatures.java $(JARS)/.sniffer
	$(call compile,$@,tools/Signatures.java,$(SNIFFER))

$(BUILD)/api-$(LEAST).signature: $(JARS)/.stubs $(BOOT) $(BUILD)/signatures.jar
	@$(SNIFF) build $@ $(STUBS) $(BOOT)

# Everything keeps to the java.* of API 16; android.* too, but for the classes of newer levels,
# which keep to what is public in theirs, ciphers' parameters included. Those are reached behind
# the check of the version only. Names in resources are checked against the same level.
$(BUILD)/.guarded: $(BACKPORTED) $(MANIFEST) $(BUILD)/api-$(LEAST).signature \
		tools/guards.py tools/resources.py $(RES) $(filter-out %-29,$(LEVELS:%=$(JARS)/.level-%)) \
		$(wildcard tools/newer-*.list)
	@echo 'check that no call is newer than its guard'
	@$(SNIFF) check $(BUILD)/api-$(LEAST).signature $(OURS) - $(filter-out $(JAVA7)/newer-%,$(BACKPORTED)) \
		$(if $(LEVELS),-- $(BUILD)/api-$(LEAST).signature $(OURS)$(comma)android$(comma)javax.crypto.spec - $(filter $(JAVA7)/newer-%,$(BACKPORTED))) \
		$(foreach each,$(LEVELS),-- $(PUBLIC_$(each)) $(OURS) \
		$(or $(wildcard tools/newer-$(each).list),-) $(JAVA7)/newer-$(each).jar)
	@$(PYTHON) tools/guards.py $(MANIFEST) $(BACKPORTED)
	@$(PYTHON) tools/resources.py $(RASPILOT)/res $(STUBS)
	@touch $@

SPOTBUGS_PATH = $(subst $(empty) $(empty),:,$(patsubst %,$(JARS)/%,$(shell \
	$(PYTHON) tools/fetch.py --list $(JARS) spotbugs)))
SPOTBUGS_KNOWN = $(STUBS):$(FRAMEWORK)
SPOTTED := $(CORE_JAR) $(APP_JAR) $(NEWER_JARS)

# It reads the classes of the JDK that it runs on.
SPOTBUGS_KNOWS := 22
JDK_MAJOR = $(shell javac -version 2>&1 | sed -n 's/^javac \(1\.\)\{0,1\}\([0-9]*\).*/\2/p')

check: $(BUILD)/.guarded
	@if [ "$(JDK_MAJOR)" -le $(SPOTBUGS_KNOWS) ]; then \
		$(MAKE) --no-print-directory $(BUILD)/.spotted; \
	else \
		echo 'SpotBugs knows no JDK $(JDK_MAJOR) ($(SPOTBUGS_KNOWS) at most): not looked for bugs' >&2; \
		[ -z "$${UP_REQUIRE_TOOLS-}" ]; \
	fi

$(BUILD)/.spotted: $(SPOTTED) tools/spotbugs.xml $(JARS)/.spotbugs
	@echo 'look for bugs'
	@$(JVM) -Dslf4j.internal.verbosity=ERROR -cp '$(SPOTBUGS_PATH)' \
		edu.umd.cs.findbugs.FindBugs2 -effort:max -medium -longBugCodes -exitcode \
		-exclude tools/spotbugs.xml -auxclasspath '$(SPOTBUGS_KNOWN)' $(SPOTTED)
	@echo 'SpotBugs finds nothing'
	@touch $@
