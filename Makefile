# lux4, the lighting-design simulator.  `make help` lists the targets.
#
# Sources are found, not listed: every .c and .cpp of the folders below goes into liblux4.a;
# every tests/*/test_*.c, bench_*.c and fuzz_*.c is a program of its own, linked with it and with
# tests/*.c. What needs OpenImageIO is a shared object that is loaded when it is first asked for.
# Nothing is written outside build/.
#
#   WIDTH=1 one ray at a time: the scalar baseline of every speed-up (also: 8, with AVX2)
#   SAN=1   address and undefined-behaviour sanitizers     WERROR=1 warnings are errors
#   DEBUG=1 -O1 -g, for a debugger                         NATIVE=1 for this very processor
#   WITHOUT="daylight mirrors textures tables"  a build that lacks these (core/without.h)
#   V=1     show the commands                              CC=clang CXX=clang++

VERSION := 0.1.0
PREFIX  := /usr/local
LAYERS  := core materials lights sky sim
PKGS    := OpenEXR tinygltf yaml-0.1 expat geographiclib erfa icu-i18n
PLUGIN_PKGS := OpenImageIO
TEST_PKGS   := cmocka
DEBS    := gcc g++ pkg-config libopenexr-dev libtinygltf-dev libyaml-dev libexpat1-dev libgeographiclib-dev liberfa-dev libicu-dev libopenimageio-dev libcmocka-dev
BENCH_DEBS := libembree-dev
WIDTH   := 4

# ---- what to build with ---------------------------------------------------------------------

CC  := gcc
CXX := g++
OPT := $(if $(SAN)$(DEBUG),-O1,-O2)
ifdef NATIVE
  OPT += -march=native
else ifneq (,$(filter x86_64-%,$(shell $(CC) -dumpmachine 2>/dev/null)))
  OPT += -march=x86-64-$(if $(filter 8,$(WIDTH)),v3,v2)
endif
OPT += $(if $(filter 1,$(WIDTH)),-fno-tree-vectorize -fno-tree-slp-vectorize)
SANS := -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
SANS := $(if $(SAN)$(FUZZ),$(SANS)) $(if $(FUZZ),-fsanitize=fuzzer-no-link)

# A quarter of the time to build, where nobody looks at it
DEBUG_INFO := $(if $(SAN)$(DEBUG)$(FUZZ),-g)

# No fused multiply-adds: the same numbers on every machine, whatever the width.
FP   := -ffp-contract=off -fno-math-errno -fno-trapping-math
WARN := -Wall -Wextra -Wshadow -Wundef -Wvla -Wdouble-promotion -Wpointer-arith -Wwrite-strings \
        -Wcast-qual -Wformat=2 -Wno-missing-field-initializers -Wno-psabi $(if $(WERROR),-Werror)
WARN_C := -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wold-style-definition \
          -Wno-bool-operation   # ~(d > 0.0f) is a mask at every width

# Targets that need no library: all others read what pkg-config says of the packages.
ifneq (,$(filter-out help clean deps layers format format-check,$(or $(MAKECMDGOALS),all)))
  include build/pkg.mk
endif

CPPFLAGS := -I. $(foreach w,$(WITHOUT),-DWITHOUT_$(shell echo $w | tr a-z A-Z)) -MMD -MP -DPACKET_WIDTH=$(WIDTH) -DLUX4_VERSION='"$(VERSION)"' \
            -DLUX4_LIBDIR='"$(PREFIX)/lib/lux4"' $(PKG_CFLAGS)
CFLAGS   := -std=gnu17 $(DEBUG_INFO) $(OPT) $(FP) $(SANS) $(WARN) $(WARN_C)
CXXFLAGS := -std=c++17 $(DEBUG_INFO) $(OPT) $(FP) $(SANS) $(WARN)
LDFLAGS  := $(SANS) -Wl,--as-needed
LDLIBS   := $(PKG_LIBS) -lm -ldl -pthread

# C++ is libraries' alone, and knows no packets: one object does for all widths.
SHIM_FLAGS := $(filter-out -DPACKET_WIDTH=% -march=% -fno-tree-%,$(CPPFLAGS) $(CXXFLAGS))

# ---- what there is to build -----------------------------------------------------------------

TOOL  := $(if $(findstring clang,$(CC)),clang-)
KIND  := $(TOOL)$(if $(FUZZ),fuzz,$(if $(SAN),san,$(if $(DEBUG),debug,$(if $(NATIVE),native,release))))$(if $(WITHOUT),-without)
B     := build/$(KIND)-$(WIDTH)
SHIMS := build/$(KIND)-shims
SHIM  := core/image_oiio.cpp
SRC   := $(filter-out sim/main.c $(SHIM),$(wildcard $(LAYERS:%=%/*.c) $(LAYERS:%=%/*.cpp)))
# Of these there is one object for each kernel (sim/path_kernel.h)
KERNELS := 0 1 2 3
KERNEL_SRC := $(filter-out %/path_tracer.c,$(filter sim/path.c sim/path_%.c,$(SRC)))
OBJ   := $(patsubst %,$B/%.o,$(filter-out $(KERNEL_SRC) %.cpp,$(SRC))) \
         $(patsubst %,$(SHIMS)/%.o,$(filter %.cpp,$(SRC))) \
         $(foreach k,$(KERNELS),$(KERNEL_SRC:%.c=$B/%.k$k.o))
AIDS  := $(wildcard tests/*.c)
TESTS := $(patsubst %.c,$B/%,$(wildcard tests/*/test_*.c))
LONG  := $(patsubst %.c,$B/%,$(wildcard tests/*/long_*.c))
BENCH := $(patsubst %.c,$B/%,$(wildcard tests/bench/bench_*.c))
FUZZERS := $(patsubst %.c,$B/%,$(wildcard tests/fuzz/fuzz_*.c))
MODEL  := $(patsubst %.c,$B/%.c.o,$(wildcard data/model/*.c))
OFFICE := $(patsubst %.c,$B/%.c.o,$(wildcard data/office/*.c))
CAR    := $(patsubst %.c,$B/%.c.o,$(wildcard data/car/*.c))
GLASS  := $(patsubst %.c,$B/%.c.o,$(wildcard data/glass/*.c))
COURT  := $(patsubst %.c,$B/%.c.o,$(wildcard data/courtyard/*.c))
LAYER  := $(patsubst %.c,$B/%.c.o,$(wildcard data/materials/bsdf_*.c))
PROG  := $(patsubst sim/main.c,$B/lux4,$(wildcard sim/main.c))
PLUG  := $(patsubst $(SHIM),$B/liblux4_oiio.so,$(wildcard $(SHIM)))
# The library goes into each of the tests: gold does that in half the time, where there is one.
FAST_LD := $(if $(SAN)$(FUZZ),,$(shell command -v ld.gold > /dev/null && echo -fuse-ld=gold))
TEXT  := $(wildcard $(foreach d,$(LAYERS) tests tests/* data/*,$d/*.[ch] $d/*.cpp))

TO        := $(DESTDIR)$(PREFIX)
SHIPPED   := data/office data/car data/glass data/courtyard data/materials
MAKEFLAGS += --no-builtin-rules --no-print-directory
Q         := $(if $V,,@)
.DELETE_ON_ERROR:
.SECONDARY:
.PHONY: all check check-long tests tests-inside demo bench bench-lights bench-brdf bench-texture bench-sky bench-hall bench-effects bench-programs bench-deps deps fuzz fuzzers install layers \
        format format-check clean help FORCE

## all: the library and the program (what plain `make` does)
all: $B/liblux4.a $(PROG) $(PLUG)

$B/liblux4.a: $(OBJ) $B/links
	@echo "AR   $@"; rm -f $@
	$Qar rcs $@ $(filter %.o,$^)

$(PROG): $B/sim/main.c.o
$(TESTS) $(LONG) $(BENCH): $B/%: $B/%.c.o $(AIDS:%=$B/%.o)
$(filter $B/tests/cli/%,$(TESTS)): | $(PROG) $(PLUG) # which they run
$B/tests/bench/bench_sky: | $(PLUG) # which reads a panorama
$(TESTS) $(LONG) $(BENCH): private LDFLAGS += -Wl,--wrap=aligned_alloc
$(TESTS) $(LONG) $(BENCH): private LDLIBS += $(TEST_LIBS)
$(TESTS): private LDFLAGS += $(FAST_LD)
$B/tests/bench/bench_trace: private LDLIBS += -lembree3
$(PROG) $(TESTS) $(LONG) $(BENCH): $B/liblux4.a $B/links
	@echo "LD   $@"
	$Q$(CXX) $(LDFLAGS) $(filter %.o,$^) $(filter %.a,$^) $(LDLIBS) -o $@

$(FUZZERS): private LDFLAGS += -fsanitize=fuzzer
$(FUZZERS): $B/%: $B/%.c.o $B/liblux4.a $B/links
	@echo "LD   $@"
	$Q$(CXX) $(LDFLAGS) $(filter %.o,$^) $(filter %.a,$^) $(LDLIBS) -o $@

# The programs that make the scenes we ship, and the tests of what they make
MAKERS := $B/make_office $B/make_car $B/make_glass $B/make_courtyard
$B/make_office: $(OFFICE)
$B/make_car: $(CAR)
$B/make_glass: $(GLASS)
$B/make_courtyard: $(COURT)
$(MAKERS): $(MODEL) $B/links
	@echo "LD   $@"
	$Q$(CXX) $(SANS) $(filter %.o,$^) -lm -o $@
$B/tests/unit/test_office: $(filter-out %/make_office.c.o,$(OFFICE)) $(MODEL)
$B/tests/unit/test_car_glass: $(filter-out %/make_car.c.o %/make_glass.c.o,$(CAR) $(GLASS)) $(MODEL)
$B/tests/unit/test_courtyard: $(filter-out %/make_courtyard.c.o,$(COURT)) $(MODEL)

# The program that makes glazing.xml and blind.xml, and the test of what it makes
$B/tests/physics/test_layers: $(LAYER)
$B/make_bsdf: $(LAYER) $B/data/materials/make_bsdf.c.o $B/links
	@echo "LD   $@"
	$Q$(CXX) $(SANS) $(filter %.o,$^) -lm -o $@

# The program that makes the tables of reflection in data/materials
$B/make_brdf: data/materials/make_brdf.c $B/flags
	@mkdir -p $(@D); echo "LD   $@"
	$Q$(CC) $(CPPFLAGS) $(CFLAGS) $< -lm -o $@

build/bench/office-%.glb: $B/make_office
	@mkdir -p $(@D); $< --bench $* $@

$(SHIMS)/liblux4_oiio.so: $(SHIM) $(SHIMS)/flags
	@mkdir -p $(@D); echo "SO   $@"
	$Q$(CXX) $(SHIM_FLAGS) $(PLUGIN_CFLAGS) -fPIC -shared $(LDFLAGS) $< $(PLUGIN_LIBS) -o $@
$(PLUG): $(SHIMS)/liblux4_oiio.so
	@mkdir -p $(@D)
	$Qln -f $< $@

# What packets are measured against: plain scalar C, and of some the same with the x87's arithmetic
PLAIN := $(patsubst %.c,$B/%,$(wildcard tests/bench/plain_*.c))
X87_PLAIN := $(filter-out %_texture %_sky,$(PLAIN))
$(PLAIN:$B/tests/bench/plain_%=$B/tests/bench/bench_%): $B/tests/bench/bench_%: $B/tests/bench/plain_%.o
$(X87_PLAIN:$B/tests/bench/plain_%=$B/tests/bench/bench_%): $B/tests/bench/bench_%: $B/tests/bench/plain_%_387.o
$(X87_PLAIN:=_387.o): private X87 := -mfpmath=387 -DPLAIN_387
PLAIN_CC = mkdir -p $(@D); echo "CC   $< $(X87)"; \
	$(CC) $(CPPFLAGS) $(CFLAGS) -fno-tree-vectorize -fno-tree-slp-vectorize $(X87) -c $< -o $@
$(PLAIN:=.o): $B/%.o: %.c $B/flags
	@$(PLAIN_CC)
$(X87_PLAIN:=_387.o): $B/%_387.o: %.c $B/flags
	@$(PLAIN_CC)

$B/%.c.o: %.c $B/flags
	@mkdir -p $(@D); echo "CC   $<"
	$Q$(CC) $(CPPFLAGS) $(CFLAGS) -c $< -o $@

define KERNEL_RULE
$B/%.k$1.o: %.c $B/flags
	@mkdir -p $$(@D); echo "CC   $$< (kernel $1)"
	$$Q$$(CC) $$(CPPFLAGS) -DPATH_KERNEL=$1 $$(CFLAGS) -c $$< -o $$@
endef
$(foreach k,$(KERNELS),$(eval $(call KERNEL_RULE,$k)))

$(SHIMS)/%.cpp.o: %.cpp $(SHIMS)/flags
	@mkdir -p $(@D); echo "CXX  $<"
	$Q$(CXX) $(SHIM_FLAGS) -c $< -o $@

# Other flags, other objects; other sources or libraries, other programs.
$B/flags: TELL = $(CC) $(CPPFLAGS) $(CFLAGS)
$(SHIMS)/flags: TELL = $(CXX) $(SHIM_FLAGS)
$B/links: TELL = $(CXX) $(LDFLAGS) $(LDLIBS) $(SRC) $(AIDS)
$B/flags $(SHIMS)/flags $B/links: FORCE
	@mkdir -p $(@D); echo '$(subst ','\'',$(TELL))' | cmp -s - $@ || echo '$(subst ','\'',$(TELL))' > $@

-include $(OBJ:.o=.d) $(patsubst %,$B/%.d,$(AIDS) sim/main.c) $(addsuffix .c.d,$(TESTS) $(LONG) $(BENCH) $(FUZZERS))
-include $(SHIMS)/liblux4_oiio.d $(patsubst %.o,%.d,$(MODEL) $(OFFICE) $(CAR) $(GLASS) $(COURT) $(LAYER)) $(PLAIN:=.d) $(X87_PLAIN:=_387.d)

# What is missing is installed for check and demo, which set a machine up; else it is named.
build/pkg.mk: Makefile
	@mkdir -p $(@D); { command -v $(CC) && command -v $(CXX) && command -v pkg-config; } > /dev/null \
	  && pkg-config --exists $(PKGS) $(PLUGIN_PKGS) $(TEST_PKGS) \
	  || $(if $(filter check check-long demo,$(MAKECMDGOALS)),$(MAKE) deps,{ echo "lux4 needs packages that are not installed: run 'make deps'"; exit 1; })
	@set -e; say() { printf '%s := %s\n' "$$1" "$$(pkg-config $$2)"; }; { \
	  say PKG_CFLAGS "--cflags $(PKGS)"; say PKG_LIBS "--libs $(PKGS)"; \
	  say PLUGIN_CFLAGS "--cflags $(PLUGIN_PKGS)"; say PLUGIN_LIBS "--libs $(PLUGIN_PKGS)"; \
	  say TEST_LIBS "--libs $(TEST_PKGS)"; } > $@

# ---- what to do with it ---------------------------------------------------------------------

## check: every test at width 4, units at 1, files at 1, 4 and 8 alike, no layer that includes one above it
# Tests of physics and of the program run at 4 alone; those of widths hold its files at 1 and 8 to be the same.
check: layers
	$Q$(MAKE) -j$$(nproc) tests WIDTH=4
	$Q$(MAKE) -j$$(nproc) all tests-inside WIDTH=1
	$Qrm -rf build/release-1/tests/cli build/release-1/tests/physics
	$Qif grep -qw avx2 /proc/cpuinfo 2> /dev/null; then $(MAKE) -j$$(nproc) all WIDTH=8; fi
	$Qtests/run build/release-4 build/release-1

## tests: build the test programs of this width (check builds and runs them)
tests: all $(TESTS)
tests-inside: all $(filter-out $B/tests/cli/% $B/tests/physics/%,$(TESTS))

## check-long: what takes more than minutes: every float of every packet function, and the like
check-long: all $(LONG)
	$Qfor t in $(LONG); do $$t || exit 1; done

## demo: the office, a car, a room of glass and a courtyard by day: tables, and pictures in their folders' out/
demo: all
	$(PROG) grid data/office/office.yaml
	$(PROG) render data/office/office.yaml --accuracy 25%
	for s in car glass; do \
	  $(PROG) grid data/$$s/$$s.yaml && { $(PROG) render data/$$s/$$s.yaml --time 45 || [ $$? = 3 ]; } || exit; done
	for c in "daylight --time 15" "daylight --factor --time 5 -o data/courtyard/out/factor --overwrite" \
	  "render --variant noon --time 20"; do \
	  $(PROG) $$c data/courtyard/courtyard.yaml || [ $$? = 3 ] || exit; done

## bench: rays per second of packets, of one ray at a time and of Embree, appended to build/bench.log
bench: bench-deps build/bench/office-65000.glb build/bench/office-270000.glb
	$Q$(MAKE) bench-programs WIDTH=4
	$Q$(MAKE) bench-programs WIDTH=1
	@{ echo "# $$(git describe --always --dirty 2>/dev/null) $(CC) $(OPT)"; \
	  for b in $(BENCH:$B/%=%); do build/$(KIND)-4/$$b build/$(KIND)-1/$$b; done; } | tee -a build/bench.log

bench-programs: $(BENCH)

## bench-lights: nanoseconds a point of each kind of light, beside plain C; appended to build/bench.log
## bench-brdf: nanoseconds a look-up of a measured BRDF, beside plain C; appended to build/bench.log
## bench-texture: nanoseconds a trilinear look-up, beside plain C; appended to build/bench.log
## bench-sky: nanoseconds a direction of each kind of sky, beside plain C; appended to build/bench.log
bench-lights bench-brdf bench-texture bench-sky: bench-%:
	$Q$(MAKE) build/$(KIND)-4/tests/bench/bench_$* WIDTH=4
	$Q$(MAKE) build/$(KIND)-1/tests/bench/bench_$* WIDTH=1
	@{ echo "# $$(git describe --always --dirty 2>/dev/null) $(CC) $(OPT)"; \
	  build/$(KIND)-4/tests/bench/bench_$* build/$(KIND)-1/tests/bench/bench_$*; } | tee -a build/bench.log

## bench-effects: instructions of a run where effects are off, beside a build that does not have them
OFF := daylight mirrors textures tables
bench-effects:
	$Q$(MAKE) all WIDTH=4
	$Q$(MAKE) all WIDTH=4 WITHOUT="$(OFF)"
	@{ echo "# $$(git describe --always --dirty 2>/dev/null) $(CC) $(OPT)"; \
	  tests/bench/effects build/$(KIND)-4 build/$(KIND)-without-4; } | tee -a build/bench.log

## bench-hall: seconds that 1,000 lamps in a hall cost, beside 10; appended to build/bench.log
bench-hall:
	$Q$(MAKE) build/$(KIND)-4/tests/bench/bench_hall WIDTH=4
	@{ echo "# $$(git describe --always --dirty 2>/dev/null) $(CC) $(OPT)"; \
	  build/$(KIND)-4/tests/bench/bench_hall; } | tee -a build/bench.log

## bench-deps: install what the benchmarks alone are measured against
bench-deps:
	@[ -e /usr/include/embree3/rtcore.h ] || pkg-config --exists embree3 \
	  || $(MAKE) deps DEBS="$(BENCH_DEBS)"

## deps: install the packages this needs (Debian, Ubuntu; elsewhere: name them)
deps:
	@command -v apt-get > /dev/null || { echo "no apt-get here; lux4 needs (Debian's names): $(DEBS)"; exit 1; }
	@sudo=$$([ $$(id -u) = 0 ] || echo sudo); set -x; $$sudo apt-get update && $$sudo env \
	  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $(DEBS)

## fuzz: a minute of random bytes at the readers of studies and tables, built by clang (SECONDS=60; findings: build/fuzz)
fuzz:
	$Q$(MAKE) CC=clang CXX=clang++ FUZZ=1 fuzzers
fuzzers: $(FUZZERS)
	@for f in $(FUZZERS); do mkdir -p build/fuzz/$$(basename $$f); echo "FUZZ $$f"; \
	  $$f -max_total_time=$(or $(SECONDS),60) -timeout=5 -max_len=4000 -verbosity=0 \
	  -print_final_stats=1 -artifact_prefix=build/fuzz/ build/fuzz/$$(basename $$f) || exit 1; done

# The library as others link it: one object, whose names are those of lux4.h alone
$B/public/liblux4.a: $B/liblux4.a
	@mkdir -p $(@D); echo "AR   $@"; rm -f $@
	$Qld -r --whole-archive $< -o $(@D)/lux4.o
	$Qobjcopy --wildcard --keep-global-symbol='lux4_*' $(@D)/lux4.o
	$Qar rcs $@ $(@D)/lux4.o

## install: program, library, header, manual and data below PREFIX (default /usr/local; DESTDIR too)
install: all $B/public/liblux4.a
	install -d $(TO)/bin $(TO)/lib/lux4 $(TO)/lib/pkgconfig $(TO)/include/lux4 $(TO)/share/man/man1 \
	  $(SHIPPED:data/%=$(TO)/share/lux4/%)
	install -m 755 $(PROG) $(TO)/bin
	install -m 755 $(PLUG) $(TO)/lib/lux4
	install -m 644 $B/public/liblux4.a $(TO)/lib
	install -m 644 sim/lux4.h $(TO)/include/lux4
	install -m 644 sim/lux4.1 $(TO)/share/man/man1
	install -m 644 STUDY.md MATERIALS.md $(TO)/share/lux4
	$Qfor d in $(SHIPPED); do for f in $$d/*.yaml $$d/*.glb $$d/*.ies $$d/*.ldt $$d/*.brdf $$d/*.xml $$d/*.exr; do \
	  [ ! -e $$f ] || install -m 644 $$f $(TO)/share/lux4/$${d#data/} || exit 1; done; done
	@printf '%s\n' 'prefix=$(PREFIX)' 'Name: lux4' 'Description: lighting-design simulation' 'Version: $(VERSION)' \
	  'Cflags: -I$${prefix}/include/lux4' 'Requires.private: $(PKGS)' \
	  'Libs: -L$${prefix}/lib -llux4 $(PKG_LIBS) -lstdc++ -lm -ldl -pthread' > $(TO)/lib/pkgconfig/lux4.pc

## layers: core < materials, lights < sky < sim (sky/ may include lights/light.h: the sun is a light)
layers:
	@! grep -nE '#include "(materials|lights|sky|sim)/' $(filter core/%,$(TEXT)) /dev/null
	@! grep -nE '#include "(lights|sky|sim)/'           $(filter materials/%,$(TEXT)) /dev/null
	@! grep -nE '#include "(materials|sky|sim)/'        $(filter lights/%,$(TEXT)) /dev/null
	@! grep -nE '#include "(materials|lights|sim)/'     $(filter sky/%,$(TEXT)) /dev/null | grep -v '"lights/light.h"'

## format, format-check: lay the sources out as .clang-format says; refuse what differs
format: ; $Qclang-format -i $(TEXT)
format-check: ; $Qclang-format --dry-run --Werror $(TEXT)

## clean: remove build/
clean: ; $Qrm -rf build

## help: this list
help:
	@sed -n 's/^## \([a-z, -]*\): /\1\t/p' $(MAKEFILE_LIST) | awk -F'\t' '{ printf "  make %-22s %s\n", $$1, $$2 }'
	@sed -n 's/^#   \([A-Z]*=[1c"].*\)/  \1/p' $(MAKEFILE_LIST)
