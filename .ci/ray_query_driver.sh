# Sourced by .ci/run. The software driver of Debian 12 has no ray queries. That of its backports does: this unpacks it
# into the build folder, beside the system's driver, for the tests that trace on the GPU (tests/gpu_render/CMakeLists.txt).

# If the driver cannot be had, it says so, and those tests skip.
walr_ray_query_driver() {
  local folder=$PWD/build/ray-query-driver keys=/usr/share/keyrings/debian-archive-keyring.gpg archive release apt
  if [ -e "$folder/driver.json" ]; then
    return
  fi
  # The archive that apt uses for the release itself also has its backports.
  read -r archive release < <(apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' 2>/dev/null |
    awk '$2 == "bookworm"') || true
  if [ -z "${archive:-}" ] || [ ! -e "$keys" ] || ! dpkg-query --show libllvm15 >/dev/null 2>&1; then
    echo "Tests that trace on the GPU use the system's Vulkan driver: only Debian 12 has another one in its backports."
    return
  fi
  mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
  echo "deb [signed-by=$keys] $archive $release-backports main" >"$folder/sources.list"
  apt=(timeout 50 apt-get --quiet --quiet -o Dir::Etc::SourceList="$folder/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o Dir::State::Lists="$folder/lists" -o Dir::Cache="$folder/cache")
  if ! (cd "$folder" && "${apt[@]}" update && "${apt[@]}" download mesa-vulkan-drivers &&
    dpkg-deb --extract mesa-vulkan-drivers_*.deb root); then
    echo "Tests that trace on the GPU use the system's Vulkan driver: that of $release-backports cannot be had."
    return
  fi
  printf '{"file_format_version": "1.0.0", "ICD": {"api_version": "1.3.0", "library_path": "%s"}}\n' \
    "$(find "$folder/root" -name libvulkan_lvp.so)" >"$folder/driver.json"
  echo "Tests that trace on the GPU use $(basename "$folder"/mesa-vulkan-drivers_*.deb .deb)."
}
