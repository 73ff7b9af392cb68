"""What pyproject.toml cannot say: the solver's kernel is compiled, by what there is, or by zig from PyPI."""

import os
import runpy
from pathlib import Path

from setuptools import setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py

KERNEL = "bihdist_core/kernel"
build = runpy.run_path(f"{KERNEL}/build.py")

# Where PyPI has zig; elsewhere, and if CC is set, the solver does without.
ZIG = "ziglang; sys_platform in 'linux darwin win32' and platform_machine in 'x86_64 AMD64 aarch64 arm64 ARM64'"


class BuildWithKernel(build_py):
    """Compiles beside the sources for an editable installation, else where the wheel is put together."""

    def run(self):
        super().run()
        build["main"](["--output", KERNEL if self.editable_mode else f"{self.build_lib}/{KERNEL}"])


class WheelWithKernel(bdist_wheel):
    """A wheel with a library in it is for one kind of machine, and for every Python."""

    def run(self):
        self.run_command("build")
        if list(Path(self.get_finalized_command("build").build_lib, KERNEL).glob("libbihdist*")):
            self.distribution.has_ext_modules = lambda: True
            self.root_is_pure = False
        super().run()

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


def needs_zig() -> bool:
    """Whether there is no compiler yet, and none is named."""
    try:
        build["compiler"]()
    except build["NotCompiled"]:
        return not os.environ.get("CC")
    return False


setup(
    cmdclass={"build_py": BuildWithKernel, "bdist_wheel": WheelWithKernel},
    setup_requires=[ZIG] if needs_zig() else [],
)
