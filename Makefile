# Everything by one command each; `make` alone lists them.  ARGS is passed on: make run ARGS="mesh.off --sources 12"
# .ci/set-up makes the environment .venv and says what else it does (PYTHON=..., YES=1: see there).

ARGS ?=
PICTURE = bihdist-comparison.png
PYTHON_HERE = $(if $(filter Windows_NT,$(OS)),.venv/Scripts/python,.venv/bin/python)

.PHONY: help run test nightly check quick bench stress guide wheels
.NOTPARALLEL:

help:
	@echo 'make run     install missing packages, then open the viewer (without a display, draw a picture)'
	@echo 'make test    run the checks and the tests, including the window'
	@echo 'make nightly run the long tests: browsers, wheels, compilers, the guide, the experiments of the paper'
	@echo 'make check   run ruff, mypy, codespell, import rules, docstrings, and build the kernel with each C compiler'
	@echo 'make quick   run the checks, and a minute of tests'
	@echo 'make bench   compare the speed of the solver with potpourri3d'
	@echo 'make guide   run the examples of the guide and build its pages: app/guide/index.html'
	@echo 'make stress  attack the program for hours; resumes where it was interrupted'
	@echo 'make wheels  build the files of a release, for all platforms, in dist'

NO_DISPLAY = $(if $(filter Linux,$(shell uname -s)),$(if $(DISPLAY)$(WAYLAND_DISPLAY),,yes))
NO_WINDOW = $(filter field pairs profile isolines statistics samples regions interpolate correspond evaluate perturb \
    figure movie page info paper batch desktop guide,$(firstword $(ARGS)))
run:
	@.ci/set-up
ifeq ($(if $(NO_WINDOW),,$(NO_DISPLAY)),yes)
	@echo 'There is no display (DISPLAY is not set): drawing the same comparison as a picture, $(PICTURE)'
	@$(PYTHON_HERE) -m app figure $(or $(filter-out view,$(ARGS)),figure) -o $(PICTURE)
else
	@$(PYTHON_HERE) -m app $(ARGS)
endif

define checks
	$(PYTHON_HERE) -m ruff check .
	$(PYTHON_HERE) -m ruff format --check .
	$(PYTHON_HERE) -m mypy
	$(PYTHON_HERE) -m codespell_lib
endef

check:
	@.ci/set-up dev
	$(checks)
	$(PYTHON_HERE) bihdist_core/kernel/build.py --check
	$(PYTHON_HERE) -m pytest tests/packaging/test_import_rules.py tests/packaging/test_docstrings.py

QUICK = $(addprefix tests/packaging/test_,import_rules.py words.py) \
    $(addprefix tests/app/test_,document.py history.py one_line.py) \
    $(addprefix tests/core/test_,distances.py factor.py isolines.py laplacian.py mesh_io.py operators.py \
    elimination_tree.py sources.py surface.py)
quick:
	@.ci/set-up dev
	$(checks)
	$(PYTHON_HERE) -m pytest -n 2 $(QUICK)

# The tests get screens of their own, so that they neither need nor disturb the user's; then all of them run in several
# processes (see tests/conftest.py), where on one screen they would take the pointer from each other.
IN_TURN = $(PYTHON_HERE) -m pytest $(or $(ARGS),-m "$(MARKED)")
AT_ONCE = $(PYTHON_HERE) -m pytest $(or $(ARGS),-m "$(MARKED)" -n auto --maxprocesses 4 --dist loadfile)
define tests
	@if command -v xvfb-run >/dev/null; then \
	    set -- env -u WAYLAND_DISPLAY xvfb-run -a -s '-screen 0 1600x1000x24' $(AT_ONCE); \
	else \
	    set -- $(IN_TURN); \
	fi; \
	echo "$$*"; "$$@"
endef

test: MARKED = not nightly
test:
	@.ci/set-up dev
	$(checks)
	$(tests)

nightly: MARKED = nightly
nightly:
	@.ci/set-up dev guide
	$(tests)

bench:
	@.ci/set-up bench
	$(PYTHON_HERE) -m tests.bench $(if $(BEFORE),--before $(BEFORE)) $(ARGS)

guide:
	@.ci/set-up guide
	$(PYTHON_HERE) -m assets.guide

stress:
	@.ci/set-up dev
	$(PYTHON_HERE) -m tests.stress $(ARGS)

wheels: guide
	@.ci/set-up wheels
	PYTHONPATH=.ci $(PYTHON_HERE) -m wheels $(ARGS)
