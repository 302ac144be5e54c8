# The Raspilot app: its code compiled for each Android level, its resources, the signed APK.
PACKAGES := aapt android-framework-res zipalign apksigner dexdump p7zip libzopfli1 android-libnativeloader
LIBRARY ?= library
RASPILOT ?= raspilot
MANIFEST := $(RASPILOT)/AndroidManifest.xml

# The levels with their own classes. All are compiled against one framework; Animal Sniffer holds
# each class to what is public in its own level.
LEVELS := $(sort $(patsubst src-%,%,$(notdir $(wildcard $(LIBRARY)/src-* $(RASPILOT)/src-*))))
FRAMEWORK := $(JARS)/android-all-10-robolectric-5803371.jar
FRAMEWORK_16 := $(JARS)/android-all-4.1.2_r1-robolectric-0.jar
STUBS := $(JARS)/android-4.1.1.4.jar
BOOT := $(BUILD)/boot-$(LEAST).jar

RESOURCES := $(BUILD)/resources.apk
R_JAVA := $(BUILD)/gen/R.java
NEWER_JARS := $(LEVELS:%=$(BUILD)/newer-%.jar)
APP_JAR := $(BUILD)/app.jar
DEX := $(BUILD)/classes.dex

APP := $(call java,$(LIBRARY)/src $(RASPILOT)/src)
newer = $(call java,$(LIBRARY)/src-$(1) $(RASPILOT)/src-$(1))
RES := $(sort $(shell find $(RASPILOT)/res $(RASPILOT)/assets -type f 2>/dev/null))

ifneq ($(shell printf '%s' '$(LIMIT)' | tr -d 0-9),)
$(error LIMIT=$(LIMIT) must be a number of bytes)
endif

$(BUILD)/debian-tools: tools/app.mk
	@$(jdk)
	@$(call need,keytool,default-jdk-headless)
	@$(foreach tool,aapt zipalign apksigner dexdump,$(call need,$(tool),$(PACKAGES));)
	@[ -f $(FRAMEWORK_RES) ] || { echo 'Building for Android needs $(FRAMEWORK_RES):' \
		'apt-get install $(PACKAGES)' >&2; exit 1; }
	@mkdir -p $(@D)
	@touch $@

# The public stubs have android.* only: the rest of what API 16 offers is taken from its framework.
$(BOOT): tools/boot.py tools/pack.py $(JARS)/.stubs
	@$(PYTHON) tools/boot.py $(FRAMEWORK_16) $@

# The manifest's package is that of R; the application's name is shorter. Our PNGs are small
# already: aapt's own packing makes them larger. Nine-patches it would have to.
$(RESOURCES) $(R_JAVA) &: $(RES) $(MANIFEST) $(BUILD)/RES.list ../up/version.py tools/aapt \
		| $(BUILD)/debian-tools
	@echo 'compile the resources'
	@mkdir -p $(BUILD)/gen
	@tools/aapt package -f --no-crunch -M $(MANIFEST) -S $(RASPILOT)/res \
		$(if $(wildcard $(RASPILOT)/assets),-A $(RASPILOT)/assets) -I $(FRAMEWORK_RES) \
		-F $(RESOURCES) -J $(BUILD)/gen --rename-manifest-package $(PACKAGE) \
		--min-sdk-version $(LEAST) --target-sdk-version $(TARGET) --replace-version \
		--version-name $(VERSION) --version-code $(shell $(PYTHON) tools/verify.py code $(VERSION))
	@touch $(RESOURCES) $(R_JAVA)

# Classes for a newer Android know a newer framework, and the core. How its own annotations are
# written is not linted.
define level
NEWER_$(1) := $$(call newer,$(1))
$(BUILD)/newer-$(1).jar: $$(NEWER_$(1)) $(CORE_JAR) $(BUILD)/NEWER_$(1).list $(JARS)/.framework
	$$(call compile,$$@,$$(NEWER_$(1)),$(CORE_JAR):$(FRAMEWORK),-Xlint:-classfile)
endef
$(foreach each,$(LEVELS),$(eval $(call level,$(each))))

empty :=
APP_PATH := $(subst $(empty) $(empty),:,$(strip $(CORE_JAR) $(NEWER_JARS) $(STUBS) $(BOOT)))
APP_CODE := $(APP) $(R_JAVA)
$(APP_JAR): $(APP_CODE) $(CORE_JAR) $(NEWER_JARS) $(BOOT) $(BUILD)/APP_CODE.list $(JARS)/.stubs
	$(call compile,$@,$(APP_CODE),$(APP_PATH))

# The sources are Java 8; API 16 knows Java 7. ProGuard turns lambdas into classes and does nothing
# else; Animal Sniffer, the guards and Robolectric read its result.
JAVA7 := $(BUILD)/java7
COMPILED := $(CORE_JAR) $(APP_JAR) $(NEWER_JARS)
BACKPORTED := $(COMPILED:$(BUILD)/%=$(JAVA7)/%)
$(JAVA7)/.done: $(COMPILED) $(BOOT) $(JARS)/.proguard $(JARS)/.framework
	@echo 'translate to Java 7'
	@rm -rf $(JAVA7) && mkdir -p $(JAVA7)
	@$(JVM) -jar $(JARS)/proguard-base-6.2.2.jar \
		$(foreach each,$(COMPILED),-injars $(each) -outjars $(JAVA7)/$(notdir $(each))) \
		-libraryjars $(BOOT) -libraryjars $(FRAMEWORK) -target 1.7 -dontshrink -dontoptimize -dontobfuscate \
		-dontpreverify -keepattributes '*' -dontwarn '**' -dontnote '**' \
		> $@.log || { grep -v "^Note" $@.log | head -9 >&2; exit 1; }
	@touch $@
$(BACKPORTED): $(JAVA7)/.done ;

# Before anything is packed: no call may be newer than its guard.
$(DEX): $(BACKPORTED) $(BUILD)/.guarded $(JARS)/.dx
	@echo 'translate to dex'
	@$(JVM) -cp $(JARS)/dalvik-dx-16.0.1.jar com.android.dx.command.Main --dex \
		--min-sdk-version=$(LEAST) --no-locals --output=$@ $(BACKPORTED)

$(BUILD)/unsigned.apk: $(RESOURCES) $(DEX) tools/assemble.py | $(BUILD)/debian-tools
	@$(PYTHON) tools/assemble.py $(RESOURCES) $(DEX) $@.loose
	@rm -f $@ && zipalign -p 4 $@.loose $@ && rm $@.loose

# Its sum is the one to compare with another computer's.
unsigned: $(BUILD)/unsigned.apk
	@cd $(BUILD) && sha256sum unsigned.apk

# Another key also triggers signing.
SIGNER := $(ANDROID_KEYSTORE) $(ANDROID_KEY_ALIAS)
$(APK): $(BUILD)/unsigned.apk $(BUILD)/SIGNER.list tools/sign
	@tools/sign $< $@ $(BUILD)/debug.keystore '$(TYPED_IN)'

apk: $(APK) unsigned
	@zipalign -c -p 4 $(APK) || { echo '$(APK) is not aligned' >&2; exit 1; }
	@said=$$(apksigner -JXX:TieredStopAtLevel=1 verify --verbose --min-sdk-version $(LEAST) -Werr $(APK)) && \
		echo "$$said" | grep -E '^(Verifies|Verified using v[123] )' || \
		{ echo "$$said" >&2; exit 1; }
	@$(PYTHON) tools/verify.py $(APK) $(MANIFEST) $(VERSION) $(LIMIT)
	@echo 'install it: adb install -r $(abspath $(APK))'
