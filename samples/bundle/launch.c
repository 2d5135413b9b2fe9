/* Starts the program of its own name in ../libexec of the bundle.

   A process can load a library of one name only once, and some libraries are used by the programs and by Vulkan
   drivers: the C++ runtime, zlib and those of X11. A driver that is newer than the bundle may need a newer one than the
   bundle's. So the machine's own are used. Each folder in ../lib/fallback holds libraries for a machine that lacks one
   of them. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <limits.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { kTextSize = 2 * PATH_MAX };

static void fail(const char* action, const char* name) {
  fprintf(stderr, "%s: ", action);
  perror(name);
  exit(1);
}

/* Writes formatted text, which must fit, into `text`. */
static void format(char text[kTextSize], const char* pattern, ...) {
  va_list values;
  va_start(values, pattern);
  const int length = vsnprintf(text, kTextSize, pattern, values);
  va_end(values);
  if (length < 0 || length >= kTextSize) {
    fputs("The paths of the bundle are too long. Move it to a shorter one.\n", stderr);
    exit(1);
  }
}

/* The machine has a library of this name, and a C++ runtime is as new as the one that the programs were linked with. */
static bool machine_has(const char* library) {
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (handle == NULL) return false;
  if (strcmp(library, "libstdc++.so.6") != 0) return true;
  dlerror();
  dlsym(handle, WALR_NEWEST_GLIBCXX); /* The library has a symbol of value zero for each version. */
  return dlerror() == NULL;
}

static bool machine_has_all(const char* folder) {
  DIR* const files = opendir(folder);
  if (files == NULL) fail("The bundle is incomplete", folder);
  bool has_all = true;
  for (const struct dirent* file = readdir(files); file != NULL && has_all; file = readdir(files)) {
    has_all = file->d_name[0] == '.' || machine_has(file->d_name);
  }
  closedir(files);
  return has_all;
}

/* Adds the folders of those libraries that the machine lacks behind the user's own in LD_LIBRARY_PATH. */
static void add_fallback_libraries(const char* bundle) {
  char fallback[kTextSize];
  format(fallback, "%s/lib/fallback", bundle);
  DIR* const folders = opendir(fallback);
  if (folders == NULL) fail("The bundle is incomplete", fallback);
  for (const struct dirent* entry = readdir(folders); entry != NULL; entry = readdir(folders)) {
    char folder[kTextSize];
    if (entry->d_name[0] == '.') continue;
    format(folder, "%s/%s", fallback, entry->d_name);
    if (machine_has_all(folder)) continue;
    char path[kTextSize];
    const char* const before = getenv("LD_LIBRARY_PATH");
    const bool first = before == NULL || before[0] == '\0';
    format(path, "%s%s%s", first ? "" : before, first ? "" : ":", folder);
    setenv("LD_LIBRARY_PATH", path, 1);
  }
  closedir(folders);
}

int main(int argc, char** argv) {
  (void)argc;
  char self[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", self, sizeof(self) - 1);
  if (length < 0) fail("Finding the bundle", "/proc/self/exe");
  self[length] = '\0';

  char* const name = strrchr(self, '/') + 1;
  name[-1] = '\0';
  char* const folder = strrchr(self, '/');
  if (folder == NULL || strcmp(folder, "/bin") != 0) {
    fprintf(stderr, "%s/%s must stay in the folder `bin` of the bundle. Make a symbolic link instead.\n", self, name);
    return 1;
  }
  *folder = '\0';

  add_fallback_libraries(self);
  char program[kTextSize];
  format(program, "%s/libexec/%s", self, name);
  execv(program, argv);
  fail("Starting", program);
}
