# The targets of the project. `make` alone lists them.

JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
DATA ?= $(wildcard ../shared/data) data
# Fonts, or folders of them, whose glyphs `make corpus` runs.
FONTS ?= $(wildcard /usr/share/fonts/truetype)
# ON compiles sources some at a time: sooner from scratch, later after each change.
UNITY ?= ON
SECONDS ?= 60
COUNT ?= 200
FROM ?= $(shell date +%s)000000
RELEASE := build/release
ASAN := build/asan
TSAN := build/tsan
COVERAGE := build/coverage
SERIAL := build/serial
CHECK := build/check
# An environment of Python with the package, its tests' and its documentation's packages.
VENV := build/python/venv
# The core as WebAssembly, the package for JavaScript and the studio.
WASM := build/wasm
PORT ?= 8000
# Debian 12 has two versions of Boost, one of which can be installed; CGAL and GDAL ask for the older.
BENCH_BOOST := build/boost-1.81
SOURCES = $(shell git ls-files '*.h' '*.cpp')

.PHONY: help setup build demo check test papers bench bench-scale bench-spark bench-flo-mat bench-images bench-small fuzz edits fuzz-coverage certain silhouettes corpus offsets tsan serial portable python python-leaks spark wheels web frames docs format lint clean install
.DEFAULT_GOAL := help

help:     ## list the targets
	@sed -n 's/^\([a-z-]*\): [^#]*## /make \1 /p' $(MAKEFILE_LIST) | \
	  awk '{ printf "  %-19s", $$1 " " $$2; $$1 = $$2 = ""; print }'

setup:    ## install the Debian packages that are missing
	@tools/setup.sh build test

build: setup    ## build the library and the command line
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY)
	@cmake --build $(RELEASE) -j $(JOBS) --target medial medial_io medial_cli

demo: build     ## draw the medial axes of maps, a plan, a maze and drawings: out/demo
	@tools/demo.py $(RELEASE)/cli/medial out/demo

check: setup    ## after a change: compile what changed, run the quick tests
	@cmake --preset check > /dev/null
	@cmake --build $(CHECK) -j $(JOBS) --target core_tests io_tests medial_cli
	@ctest --preset check --parallel $(JOBS)

test: setup     ## run all tests, in release and with the address and undefined-behaviour sanitizers
	@tools/python.sh environment $(VENV) || echo "python: its tests are skipped"
	@tools/setup.sh web || true
	@UNITY=$(UNITY) JOBS=$(JOBS) tools/wasm.sh build $(WASM) || [ $$? -eq 77 ]
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY) $$(tools/python.sh options $(VENV))
	@cmake --build $(RELEASE) -j $(JOBS)
	@cmake --preset asan -DMEDIAL_UNITY=$(UNITY)
	@cmake --build $(ASAN) -j $(JOBS)
	@tools/test.sh $(JOBS) $(CURDIR)/$(ASAN) $(CURDIR)/$(RELEASE)

python: setup   ## build the Python package, install it into an environment, run the gallery: out/docs
	@tools/python.sh environment $(VENV)
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY) $$(tools/python.sh options $(VENV))
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_python
	@tools/python.sh install $(VENV) $(RELEASE)
	@tools/docs.sh gallery $(VENV)

python-leaks: python    ## a million calls of the Python package, which may not take more memory
	@tools/python.sh leaks $(VENV) $(RELEASE)

spark: python   ## test the Python package on Spark, Sedona, Dask and DuckDB (PyPI, Maven, Java 17)
	@tools/python.sh spark build/python/engines $(RELEASE)

bench-spark: python     ## GSHHG and footprints by Spark, from Parquet to GeoParquet (20 minutes on two cores)
	@tools/python.sh bench-spark build/python/engines $(RELEASE)

wheels: setup   ## build the wheels of the Python package, checked by auditwheel: out/wheels
	@tools/wheels.sh out/wheels $(JOBS)

web: setup      ## build the package for JavaScript and the studio, and serve it: make web PORT=8000
	@tools/setup.sh web
	@UNITY=$(UNITY) JOBS=$(JOBS) tools/wasm.sh build $(WASM)
	@echo "the studio: http://127.0.0.1:$(PORT)/"
	@tools/wasm.sh serve $(WASM) $(PORT)

frames: setup   ## count the studio's frames while a vertex among 1e4 to 1e6 is dragged, in Chromium
	@tools/setup.sh web
	@UNITY=$(UNITY) JOBS=$(JOBS) tools/wasm.sh build $(WASM)
	@tools/wasm.sh frames $(WASM)

docs: python    ## the documentation as a static site: out/docs
	@tools/docs.sh site $(VENV)

papers: build   ## the figures and tables of the papers, drawn and measured again: out/papers, tables also in papers/
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_papers
	@$(RELEASE)/papers/medial_papers --output out/papers
	@cd out/papers && for page in */*.md; do cp $$page $(CURDIR)/papers/$$page; done
	@cd papers && for picture in */img/*; do cp $(CURDIR)/out/papers/$$(dirname $$(dirname $$picture))/$$(basename $$picture) $$picture; done

bench: setup    ## compare with Boost.Polygon and CGAL; a model of many cores
	@tools/setup.sh bench
	@tools/unpack.sh libboost1.81-dev $(BENCH_BOOST)
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY) -DMEDIAL_BENCH=ON -DMEDIAL_BENCH_BOOST=$(CURDIR)/$(BENCH_BOOST)/usr/include
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_bench --target medial_bench_threads
	@$(RELEASE)/bench/medial_bench
	@$(RELEASE)/bench/medial_bench_threads

bench-scale: setup      ## time and memory against size, and tiles: make bench-scale TILES="FILE..." [MOST=10000000] [TO=csv]
	@tools/setup.sh bench
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY) -DMEDIAL_BENCH=ON
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_cli --target medial_bench_scale
	@python3 bench/scale.py $(RELEASE)/cli/medial $(RELEASE)/bench/medial_bench_scale \
		--most $(or $(MOST),10000000) --output "$(TO)" --tiles $(TILES)

bench-flo-mat: build    ## compare with flo-mat (npm): see bench/flo_mat/README.md
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_papers
	@cd bench/flo_mat && npm install --no-audit --no-fund || true
	@node bench/flo_mat/compare.mjs $(RELEASE)/cli/medial

bench-images: setup    ## compare brushfire with scikit-image and OpenCV (PyPI)
	@tools/setup.sh bench
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY) -DMEDIAL_BENCH=ON
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_cli --target medial_bench_images
	@python3 -m venv $(RELEASE)/python
	@$(RELEASE)/python/bin/pip install --quiet scikit-image opencv-contrib-python-headless pillow
	@$(RELEASE)/python/bin/python bench/images/compare.py $(RELEASE)/bench/medial_bench_images out/images
	@$(RELEASE)/python/bin/python bench/images/pages.py $(RELEASE)/cli/medial out/images

bench-small: setup      ## footprints, glyphs, and points beside delaunator (npm)
	@tools/setup.sh bench
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY) -DMEDIAL_BENCH=ON
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_cli --target medial_bench_small
	@$(RELEASE)/bench/medial_bench_small /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
	@mkdir -p $(RELEASE)/points && cp bench/points.mjs $(RELEASE)/points/
	@cd $(RELEASE)/points && npm install --no-audit --no-fund --silent delaunator && node points.mjs ../cli/medial

fuzz: setup     ## test random polygons, edits and mutated files, new ones each time: make fuzz SECONDS=60 [FROM=seed]
	@cmake --preset release
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_fuzz
	@$(RELEASE)/tests/medial_fuzz --from $(FROM) --seconds $(SECONDS)

silhouettes: setup  ## verify the axes of new silhouettes and of images below DATA by every method: make silhouettes COUNT=200 [FROM=seed] [METHOD=NAME]
	@cmake --preset release
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_silhouettes
	@mkdir -p out
	@$(RELEASE)/tests/medial_silhouettes --from $(FROM) --count $(COUNT) $(if $(METHOD),--method $(METHOD)) \
	  --table out/silhouettes$(addprefix -,$(METHOD)).md $(wildcard $(DATA)/packaged/C_images/opencv_[01]*.png)

edits: setup    ## 100,000 random edits of each of 20 shapes, compared with computing: make edits EDITS=1000
	@cmake --preset release
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_edits
	@$(RELEASE)/tests/medial_edits $(EDITS)

fuzz-coverage: setup  ## test shapes, edits and files guided by coverage (clang 14, libFuzzer): make fuzz-coverage SECONDS=60 (each of three)
	@tools/setup.sh fuzz
	@tools/fuzz_coverage.sh $(COVERAGE) $(JOBS) $(SECONDS)

certain: setup  ## test shapes on which rounding decides, against brute force: make certain SECONDS=60 (each class)
	@cmake --preset release >/dev/null
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_nasty
	@$(RELEASE)/tests/medial_nasty --from $(FROM) --count 100000 --seconds $(SECONDS) --oracle 10 --threads $(JOBS); shapes=$$?; \
	  $(RELEASE)/tests/medial_nasty --from $(FROM) --count 100000 --seconds $(SECONDS) --planar edges --threads $(JOBS) && exit $$shapes

corpus: setup   ## verify the axes of every file below DATA and every glyph below FONTS: tables
	@cmake --preset release
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_corpus medial_glyphs medial_roundtrips
	@$(RELEASE)/tests/medial_corpus $(DATA); corpus=$$?; \
	  $(RELEASE)/tests/medial_roundtrips $(DATA) $(FONTS); back=$$?; \
	  $(RELEASE)/tests/medial_glyphs $(DATA) $(FONTS) && exit $$((corpus + back))

offsets: setup  ## check eight offsets of every polygon below DATA: a table
	@cmake --preset release >/dev/null
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_offsets
	@$(RELEASE)/tests/medial_offsets --fine $(DATA)

tsan: setup     ## test the engine with the thread sanitizer
	@tools/tsan.sh $(TSAN) $(JOBS)

serial: setup   ## build the core without threads and without oneTBB, compare the results with those of oneTBB
	@cmake --preset release -DMEDIAL_UNITY=$(UNITY)
	@cmake --build $(RELEASE) -j $(JOBS) --target medial_hashes
	@$(RELEASE)/tests/medial_hashes > $(RELEASE)/hashes.txt
	@for option in THREADS TBB; do \
	  cmake --preset release -B $(SERIAL) -DMEDIAL_UNITY=$(UNITY) -DMEDIAL_IO=OFF -DMEDIAL_THREADS=ON -DMEDIAL_TBB=ON -DMEDIAL_$$option=OFF && \
	  cmake --build $(SERIAL) -j $(JOBS) --target medial_hashes && \
	  $(SERIAL)/tests/medial_hashes | diff $(RELEASE)/hashes.txt - && echo "the same results with MEDIAL_$$option=OFF" || exit 1; \
	done

portable: setup ## read the core's sources with libc++ 13, clang 14 and for 32 bits, where installed
	@tools/check_portable.sh $(JOBS)

format: setup   ## format the sources
	@clang-format -i $(SOURCES)

lint: setup     ## check layers, sizes and words, run clang-tidy
	@tools/setup.sh lint
	@tools/check_layers.py
	@tools/check_sizes.py
	@tools/check_words.py
	@mkdir -p build && tools/lint.sh build/lint $(JOBS)

install: build  ## install below PREFIX (/usr/local)
	@cmake --install $(RELEASE) --prefix $(PREFIX)

clean:    ## remove everything that was built
	@rm -rf build out
