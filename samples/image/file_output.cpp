#include "samples/image/file_output.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "samples/errors.h"

namespace walr {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

void writeAll(int file, std::span<const std::byte> bytes, const std::filesystem::path& target) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written < 0) {
      throw OutputError("cannot write " + target.string() + ": " + reason(errno));
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

/// Write to what is there already: a device, a pipe, or a link to nothing yet. Renaming would put a file in its place.
void writeInPlace(const std::filesystem::path& target, std::span<const std::byte> bytes) {
  const int file = open(target.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    throw OutputError("cannot open " + target.string() + ": " + reason(errno));
  }
  try {
    writeAll(file, bytes, target);
  } catch (const OutputError&) {
    close(file);
    throw;
  }
  if (close(file) != 0) {
    throw OutputError("cannot write " + target.string() + ": " + reason(errno));
  }
}

/// A temporary file in the directory of its final name; removed unless it is committed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target)
      : target_(target),
        name_(target.string() + "." + std::to_string(getpid()) + ".tmp"),
        file_(open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (file_ < 0) {
      fail("cannot make", errno);
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (file_ >= 0) {
      close(file_);
    }
    if (!committed_) {
      unlink(name_.c_str());
    }
  }

  void write(std::span<const std::byte> bytes) { writeAll(file_, bytes, target_); }

  void commit() {
    // Without this, a power failure after the renaming could leave an empty file under the final name.
    if (fdatasync(file_) != 0) {
      fail("cannot write", errno);
    }
    const int closed = close(file_);
    file_ = -1;
    if (closed != 0) {
      fail("cannot write", errno);
    }
    if (rename(name_.c_str(), target_.c_str()) != 0) {
      fail("cannot rename to", errno);
    }
    committed_ = true;
  }

 private:
  [[noreturn]] void fail(const std::string& what, int error) const {
    throw OutputError(what + " " + target_.string() + ": " + reason(error));
  }

  std::filesystem::path target_;
  std::string name_;
  int file_;
  bool committed_ = false;
};

}  // namespace

void prepareOutputDirectory(const std::filesystem::path& directory) {
  std::error_code error;
  if (std::filesystem::exists(directory, error) && !std::filesystem::is_directory(directory, error)) {
    throw OutputError("cannot write to " + directory.string() + ": it is not a directory");
  }
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw OutputError("cannot make the output directory " + directory.string() + ": " + error.message());
  }
  const TemporaryFile probe(directory / "write-test");
}

void prepareOutputFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) {
    throw OutputError("cannot write to " + path.string() + ": it is a folder; give the name of a file");
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return;
  const TemporaryFile probe(path);
}

void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  namespace fs = std::filesystem;
  std::error_code error;
  const bool isLink = fs::is_symlink(fs::symlink_status(path, error));
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) ? !fs::is_regular_file(status) : isLink) {
    writeInPlace(path, bytes);
    return;
  }
  TemporaryFile file(isLink ? fs::canonical(path) : path);
  file.write(bytes);
  file.commit();
}

void writeFileAtomically(const std::filesystem::path& path, std::string_view text) {
  writeFileAtomically(path, std::as_bytes(std::span(text)));
}

}  // namespace walr
