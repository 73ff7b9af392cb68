"""The build backend of both distributions: setuptools, with the kernel compiled for the machine that is named.

    pip wheel . --config-settings=--build-option=--plat-name=macosx_11_0_arm64

Without a platform it is compiled for this machine, by the compiler that `build.py` finds or by zig from PyPI; where
neither works the wheel is for every machine, and the solver runs in NumPy.  With one it is compiled by zig, or not at
all for `any`.  This file is used while a wheel is built, and by nothing afterwards.
"""

import os
import runpy
import shutil
from pathlib import Path
from typing import Any

from setuptools import Distribution, build_meta
from setuptools.build_meta import *  # noqa: F403
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py
from setuptools.command.egg_info import egg_info
from setuptools.errors import PlatformError

KERNEL = Path(__file__).resolve().parent
build = runpy.run_path(str(KERNEL / "build.py"))

ZIG = "ziglang; sys_platform in 'linux darwin win32' and platform_machine in 'x86_64 AMD64 aarch64 arm64 ARM64'"
"""Where PyPI has zig; elsewhere, and if CC is set, the solver does without."""

TARGETS = {
    "manylinux_2_17_x86_64": "x86_64-linux-gnu.2.17",
    "manylinux_2_17_aarch64": "aarch64-linux-gnu.2.17",
    "macosx_10_13_x86_64": "x86_64-macos.10.13",
    "macosx_11_0_arm64": "aarch64-macos.11.0",
    "win_amd64": "x86_64-windows-gnu",
}
"""The platforms of wheels by their names in zig."""

ANY = "any"
"""The platform of a wheel without a compiled kernel."""

Settings = dict[str, Any] | None


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """Return the packages to install for a build: zig where another machine is named, or where there is no compiler."""
    needs_zig = "plat-name" in str(config_settings) or _lacks_compiler()
    return [*build_meta.get_requires_for_build_wheel(config_settings), *([ZIG] if needs_zig else [])]


def get_requires_for_build_editable(config_settings: Settings = None) -> list[str]:
    """List the packages needed to install a checkout in place."""
    return [*build_meta.get_requires_for_build_editable(config_settings), *([ZIG] if _lacks_compiler() else [])]


def _lacks_compiler() -> bool:
    """Return whether there is no compiler yet, and none is named."""
    try:
        build["compiler"]()
    except build["NotCompiled"]:
        return not os.environ.get("CC")
    return False


def name_packages(distribution: Distribution) -> None:
    """Give the packages found the names they are installed under, and add the folders of package-dir.

    With package-dir `bihdist = "app"`, `app.qt` becomes `bihdist.qt`; with `bihdist_core = "."`, `solver` becomes
    `bihdist_core.solver`.
    """
    if set(distribution.package_dir) <= set(distribution.packages):
        return  # another command named them
    names = {folder: name for name, folder in distribution.package_dir.items()}

    def named(package: str) -> str:
        top, dot, rest = package.partition(".")
        return f"{names['.']}.{package}" if "." in names else names.get(top, top) + dot + rest

    distribution.packages = sorted({*map(named, distribution.packages), *names.values()})


class NamedPackages(egg_info):
    """The description of a distribution, with the names its packages are installed under."""

    def initialize_options(self) -> None:
        """Name the packages before any file is listed."""
        name_packages(self.distribution)
        super().initialize_options()


class WheelWithKernel(bdist_wheel):
    """A wheel with a library in it is for one kind of machine, and for every Python."""

    def run(self) -> None:
        """Compile first: what the wheel is for depends on whether that works."""
        platform = self.plat_name if self.plat_name_supplied else None
        if platform not in (None, ANY, *TARGETS):
            raise PlatformError(f"Wheels are built for {', '.join([*TARGETS, ANY])}, not for {platform}.")
        build_lib = self.get_finalized_command("build").build_lib
        # What an earlier build left there would be in this wheel, too.
        shutil.rmtree(build_lib, ignore_errors=True)
        self.run_command("build")
        folder = Path(build_lib, "bihdist_core", "kernel")
        if platform != ANY:
            target = ["--target", TARGETS[platform]] if platform else []
            failed = build["main"](["--output", str(folder), *target])
            if failed and platform:
                raise PlatformError(f"The wheel for {platform} needs the compiled kernel.")
        if list(folder.glob("libbihdist*")):
            self.distribution.has_ext_modules = lambda: True
            self.root_is_pure = False
        super().run()

    def get_tag(self) -> tuple[str, str, str]:
        """Return the wheel's tags: Python, binary interface, platform."""
        return ("py3", "none", super().get_tag()[2])


class CheckoutWithKernel(build_py):
    """An editable installation has its library beside the sources."""

    def initialize_options(self) -> None:
        """Name the packages before any file is copied."""
        name_packages(self.distribution)
        super().initialize_options()

    def run(self) -> None:
        """Compile there; for a wheel that is done where it is put together."""
        super().run()
        if Path(self.build_lib, "bihdist", "guide").is_dir():
            # The guide has been built: its text would be in the wheel twice.
            shutil.rmtree(Path(self.build_lib, "bihdist_assets", "guide"))
        if self.editable_mode:
            build["main"](["--output", str(KERNEL)])
