#!/usr/bin/env bash
# Unpacks the archive of the bundle into a folder with spaces in its name, and checks its contents and its programs.
#
#     check_bundle.sh ARCHIVE PROGRAM FOLDER [--release]
#
#     PROGRAM    the build's own program `walr`, which must compute the same pixels
#     --release  the build is one: no file may hold a path of the building machine
set -euo pipefail
archive=$(realpath "$1") program=$(realpath "$2") folder=$(realpath --canonicalize-missing "$3") release=${4:-}
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
source_folder=$(realpath "$here/../..")
source "$here/common.sh"

rm -rf "$folder"
unpack "$archive" "$folder/a folder with spaces"

size=$(stat --format=%s "$archive")
echo "Archive: $size bytes"
[ "$size" -le 40000000 ] || fail "the archive is larger than 40 MB"

# A bundle to pass on runs with the glibc that the manual tells. One that is only tested may need that of the machine which built it.
glibc=GLIBC_2.36
[ "$release" = --release ] || glibc=$(printf '%s\nGLIBC_%s\n' "$glibc" "$(getconf GNU_LIBC_VERSION | cut -d ' ' -f 2)" | sort -V | tail -1)

mapfile -d '' binaries < <(find "$bundle/bin" "$bundle/libexec" "$bundle/lib" -type f -print0)

# A library comes from the bundle, or is glibc's or the Vulkan loader, which is found without what walr brings along.
machine='^(ld-linux-x86-64\.so\.2|lib(c|dl|m|pthread|rt)\.so\.[0-9]+|libvulkan\.so\.1)$'
for binary in "${binaries[@]}"; do
  while read -r needed; do
    [[ $needed =~ $machine ]] && continue
    [ -n "$(find "$bundle/lib" -name "$needed")" ] || fail "$binary needs $needed, which is not in the bundle"
  done < <(objdump -p "$binary" | sed -n 's/^ *NEEDED *//p')
  newest=$(objdump -T "$binary" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -1 || true)
  [ "$(printf '%s\n%s\n' "$newest" "$glibc" | sort -V | tail -1)" = "$glibc" ] || fail "$binary needs $newest"
  path=$(objdump -p "$binary" | sed -n 's/^ *R\(UN\)\?PATH *//p')
  [[ -z $path || $path = '$ORIGIN/../lib' ]] || fail "$binary looks for libraries in '$path'"
done

# Every library has its package's licence, and the texts that licences refer to are there.
for file in "$bundle"/LICENSE "$bundle"/licenses/README.txt \
  "$bundle"/licenses/{libembree*,libopenexr*,libstdc++*,libx11-6,libglm-dev,nlohmann-json3-dev}.txt; do
  [ -s "$file" ] || fail "there is no $file"
done
while read -r text; do
  [ ! -e "$text" ] || [ -s "$bundle/licenses/common-licenses/$(basename "$text")" ] || fail "$text is missing"
done < <(grep -hoE '/usr/share/common-licenses/[A-Za-z0-9.-]*[A-Za-z0-9]' "$bundle"/licenses/*.txt | sort -u)

if [ "$release" = --release ]; then
  while IFS= read -r -d '' file; do
    if strings --all "$file" | grep -F -e "$source_folder" -e "$(dirname "$program")"; then
      fail "$file holds a path of the building machine"
    fi
  done < <(find "$bundle" -type f -print0)
fi

# The programs run from another folder, without anything of the environment.
cd "$folder"
clean=(env -i HOME="$folder" PATH=/usr/bin:/bin)
"${clean[@]}" "$bundle/bin/walr" --version
"${clean[@]}" "$bundle/bin/walr-host" --help >walr_host_help.txt || fail "walr-host --help"
ln -s "$bundle/bin/walr" linked
"${clean[@]}" ./linked graph --list-passes >passes.txt || fail "walr through a symbolic link"
opened=$("${clean[@]}" LD_TRACE_LOADED_OBJECTS=1 "$bundle/libexec/walr")
for library in libOpenEXR libembree; do
  grep -q "$library.*=> $bundle/libexec/../lib/" <<<"$opened" || fail "$library is not the bundle's: $opened"
done
"${clean[@]}" "$bundle/bin/walr" denoise "$bundle/samples/box" --output denoised
"${clean[@]}" "$program" denoise "$bundle/samples/box" --output expected >expected.txt
same_pixels denoised expected
finish
