# shellcheck shell=bash
# Sourced by the tests of the bundle.

failed=0
fail() {
  echo "FAILED: $*" >&2
  failed=1
}

finish() {
  [ "$failed" -eq 0 ] || exit 1
  echo "All checks passed."
}

# unpack ARCHIVE FOLDER: unpacks into FOLDER, and sets `bundle` to the folder of the bundle.
unpack() {
  mkdir -p "$2"
  tar -xzf "$1" -C "$2"
  bundle=$2/$(basename "$1" .tar.gz)
  [ -d "$bundle" ] || { fail "$1 does not hold one folder of its own name"; finish; }
}

# same_pixels FOLDER FOLDER: all denoised frames are equal, and there is at least one.
same_pixels() {
  local frame frames=0
  for frame in "$1"/denoised_*.exr; do
    [ -e "$frame" ] || break
    frames=$((frames + 1))
    cmp "$frame" "$2/$(basename "$frame")" || fail "the bundle's program computes other pixels"
  done
  [ "$frames" -gt 0 ] || fail "$1 has no denoised frames"
}
