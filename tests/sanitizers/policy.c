// What the sanitizers of a WALR_SANITIZE build are told about code that is not this project's. Part of every executable, so that a
// run needs no environment.

/// Keeps drivers and layers loaded, since a leak or a race reported at exit names its module only while that is there.
int dlclose(void* module) {
  (void)module;
  return 0;
}

/// The validation layer keeps states of images and pipelines in cycles of shared pointers (seen with 1.3.239).
const char* __lsan_default_suppressions(void) {
  return "leak:libVkLayer_khronos_validation\n";
}

/// Programs are tested to say nothing but what they mean to.
const char* __lsan_default_options(void) {
  return "print_suppressions=0";
}
