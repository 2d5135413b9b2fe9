# Sourced by tests/run.sh and samples/run.sh. Installs the packages that the project needs, on Debian 12 and 13 and Ubuntu
# 24.04: prints their names, asks no questions, and does nothing if all packages are installed.

walr_packages=(
  # Build tools
  cmake dpkg-dev g++ ninja-build pkg-config
  # Vulkan: loader, shader compiler, SPIR-V reflection, validation layer, and a driver that needs no GPU
  libvulkan-dev glslang-tools libspirv-cross-c-shared-dev vulkan-validationlayers mesa-vulkan-drivers
  # Libraries
  libcli11-dev libembree-dev libglm-dev libimath-dev libopenexr-dev libpng-dev libstb-dev libtinygltf-dev
  libwebp-dev nlohmann-json3-dev
  # The window of walr-host (optional)
  libglfw3-dev libimgui-dev
  # Compressed meshes of glTF files (optional)
  libdraco-dev libmeshoptimizer-dev
  # Tests and benchmarks
  abigail-tools doxygen file graphviz libbenchmark-dev libgtest-dev libxml2-utils libxtst6 python3 python3-jsonschema
  python3-matplotlib python3-pyflakes python3-skimage xvfb
)
# What the tests on Windows need. .ci/windows.sh installs these alone.
walr_windows_packages=(g++-mingw-w64-x86-64-posix binutils-mingw-w64-x86-64 wine wine64 googletest lld llvm xvfb)

walr_setup() {
  local package missing=() as_root=()
  for package in "${walr_packages[@]}"; do
    if ! dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$'; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then
    echo "All packages are installed."
    return
  fi
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing and cannot be installed without root or sudo: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update --quiet --quiet
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --quiet --quiet --yes --no-install-recommends "${missing[@]}"
}

# The configure, build and test preset (CMakePresets.json). Continuous integration sets WALR_PRESET=ci, in which warnings are errors:
# what a newer compiler warns of must not keep anybody from running the tests.
walr_preset=${WALR_PRESET:-tests}

# walr_build [TARGET...]: configures, and builds the given targets or, without any, everything.
walr_build() {
  cmake --preset "$walr_preset"
  cmake --build --preset "$walr_preset" ${1:+--target "$@"}
}
