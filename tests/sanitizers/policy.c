// Sanitizer settings of a WALR_SANITIZE build, made necessary by code outside this project. They are linked into every
// executable, so no environment variables are needed.

/// Keeps drivers and layers loaded, because a report at exit names the module of a leak or race only if it is loaded.
int dlclose(void* module) {
  (void)module;
  return 0;
}

/// The validation layer leaks states of images and pipelines in cycles of shared pointers (seen with 1.3.239). Mesa's
/// software driver leaks compiled variants of the input linter's shader (seen with 22.3.6); that layer, which reports
/// Vulkan objects left alive, finds none then.
const char* __lsan_default_suppressions(void) {
  return "leak:libVkLayer_khronos_validation\nleak:libvulkan_lvp\n";
}

/// Tests compare the output of programs, so the sanitizer must not add to it.
const char* __lsan_default_options(void) {
  return "print_suppressions=0";
}
