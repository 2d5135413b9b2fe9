"""Builds and runs the minimal embedding against the package: what tests/integration/package_test.cmake does with an installation."""
import pathlib

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout


class WalrTest(ConanFile):
    settings = "os", "arch", "compiler", "build_type"

    @property
    def _tree(self):
        return pathlib.Path(self.recipe_folder).parents[3]

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.variables["WALR_EMBEDDING"] = str(self._tree / "samples" / "embedding" / "embedding.c")
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder=str(self._tree / "tests" / "integration" / "package"))
        cmake.build()

    def test(self):
        if not can_run(self):
            return
        for program in ("c_shared", "c_static", "cpp_shared", "cpp_static", "cpp_libraries"):
            self.run(str(pathlib.Path(self.build_folder) / program), env="conanrun")
