# The app on this computer: its own classes in the real framework of Android 4.1 and 10, by
# Robolectric; its screens drawn by the real graphics library.
ROBO := $(RASPILOT)/robolectric
ROBO_TESTS := $(call java,$(ROBO))
ROBO_JAR := $(BUILD)/app-tests.jar
ROBO_SET := $(BUILD)/robolectric
PICTURES ?= $(BUILD)/pictures
DOCS_PICTURES ?= ../docs/pictures

# All jars of the two groups; two archives have their classes one level deeper.
ROBO_FILES := $(addprefix $(JARS)/,$(shell $(PYTHON) tools/fetch.py --list $(JARS) robolectric))
ROBO_LIBS := $(filter %.jar,$(ROBO_FILES))
ROBO_AARS := $(filter %.aar,$(ROBO_FILES))
ROBO_AAR_JARS := $(ROBO_AARS:$(JARS)/%.aar=$(ROBO_SET)/%.jar)

join := $(empty) $(empty)
ROBO_PATH = $(subst $(join),:,$(strip $(BACKPORTED) $(ROBO_LIBS) \
	$(ROBO_AAR_JARS))):$(JUNIT):$(FRAMEWORK):$(NEWEST)

$(ROBO_SET)/%.jar: $(JARS)/.robolectric
	@mkdir -p $(@D)
	@$(PYTHON) -c 'import sys, zipfile; open(sys.argv[2], "wb").write(zipfile.ZipFile(sys.argv[1]).read("classes.jar"))' \
		$(JARS)/$*.aar $@

# The shadows name classes of the newest framework that they know.
NEWEST := $(JARS)/android-all-instrumented-13-robolectric-9030017-i4.jar

# Where the framework finds the app's manifest and its compiled resources.
$(ROBO_SET)/com/android/tools/test_config.properties: tools/robolectric.mk
	@mkdir -p $(@D)
	@printf '%s\n' 'android_merged_manifest=$(abspath $(MANIFEST))' \
		'android_merged_resources=$(abspath $(RASPILOT)/res)' \
		'android_merged_assets=$(abspath $(RASPILOT)/assets)' \
		'android_custom_package=org.raspilot.app' \
		'android_resource_apk=$(abspath $(RESOURCES))' > $@

$(ROBO_JAR): $(ROBO_TESTS) $(BACKPORTED) $(ROBO_AAR_JARS) $(BUILD)/ROBO_TESTS.list \
		$(JARS)/.junit $(JARS)/.robolectric $(JARS)/.platforms $(JARS)/.framework
	@echo 'compile $@'
	@out=$$(mktemp -d $@.XXXXXX) && trap 'rm -rf "$$out"' EXIT && \
		javac -J-XX:TieredStopAtLevel=1 -J-XX:+UseSerialGC --release 8 -Werror -proc:none -encoding UTF-8 -g \
		-Xlint:all,-options,-classfile,-cast,-deprecation \
		-cp '$(ROBO_PATH)' -d "$$out" $(ROBO_TESTS) && \
		$(PYTHON) tools/pack.py $@ "$$out"

# $(call robolectric,classes,options)
robolectric = $(JVM) -ea -Xmx1500m -Drobolectric.offline=true -Drobolectric.dependency.dir=$(abspath $(JARS)) \
	-Drobolectric.logging.enabled=false -Dvectors=$(VECTORS) $(2) \
	-cp $(ROBO_JAR):$(ROBO_SET):$(ROBO_PATH) org.junit.runner.JUnitCore $(1)
robo_ready := $(ROBO_JAR) $(RESOURCES) $(ROBO_SET)/com/android/tools/test_config.properties \
	$(JARS)/.platforms

ifneq ($(filter test-app,$(MAKECMDGOALS)),)
ROBO_CHOSEN := $(subst /,.,$(patsubst $(ROBO)/%.java,%,$(call chosen,$(ROBO_TESTS))))
endif

.PHONY: test-app app-tests pictures
app-tests: $(robo_ready)

test-app: $(robo_ready)
	@$(call robolectric,$(ROBO_CHOSEN),-Dpictures=$(abspath $(PICTURES)) $(ROBO_OPTIONS))

pictures: $(robo_ready)
	@$(call robolectric,org.raspilot.app.PicturesTest,-Dpictures=$(abspath $(PICTURES)) $(ROBO_OPTIONS))
	@cp $(PICTURES)/android-*.png $(DOCS_PICTURES)/
