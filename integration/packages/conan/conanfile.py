"""Conan 2 recipe that builds the tree it lies in: conan create integration/packages/conan"""
import pathlib
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Walr(ConanFile):
    name = "walr"
    description = "Real-time denoiser for path-traced diffuse and specular light, as a frame-graph plug-in"
    license = "MIT"
    settings = "os", "arch", "compiler", "build_type"
    package_type = "shared-library"  # The static library and the C++ ones come along.
    default_options = {"spirv-cross/*:shared": False}

    @property
    def _tree(self):
        return pathlib.Path(self.recipe_folder).parents[2]

    def set_version(self):
        text = (self._tree / "CMakeLists.txt").read_text()
        self.version = re.search(r"project\(walr VERSION (\S+)", text).group(1)

    def export_sources(self):
        for folder in ("cmake", "framegraph", "integration", "passes", "shaders"):
            copy(self, "*", self._tree / folder, pathlib.Path(self.export_sources_folder) / folder)
        # The guides and examples that are installed.
        for pattern in ("README.md", "docs/*.md", "embedding/*.c", "embedding/*.cpp", "results/GPU.md",
                        "results/RATES.md"):
            copy(self, pattern, self._tree / "samples", pathlib.Path(self.export_sources_folder) / "samples")
        for file in ("CMakeLists.txt", "LICENSE"):
            copy(self, file, self._tree, self.export_sources_folder)

    def requirements(self):
        # The C++ libraries' users see these.
        self.requires("glm/1.0.1", transitive_headers=True)
        self.requires("nlohmann_json/3.11.3", transitive_headers=True)
        self.requires("vulkan-loader/1.3.290.0", transitive_headers=True, transitive_libs=True)
        self.requires("spirv-cross/1.3.296.0", visible=False)  # Of a program that the build runs.

    def build_requirements(self):
        self.tool_requires("glslang/1.3.296.0")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.variables["WALR_BUILD_SAMPLES"] = False
        toolchain.variables["WALR_BUILD_TESTS"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, pathlib.Path(self.package_folder) / "licenses")

    def package_info(self):
        # The project's own walrConfig.cmake has the targets.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs.append(str(pathlib.Path("lib") / "cmake" / "walr"))
        self.cpp_info.libs = ["walr"]
