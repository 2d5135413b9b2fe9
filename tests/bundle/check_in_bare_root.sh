#!/usr/bin/env bash
# Runs the bundle's programs in a root folder with Debian's minimal system, the Vulkan loader and Mesa's drivers alone.
# Needs root, debootstrap and a Debian mirror.
#
#     check_in_bare_root.sh ARCHIVE PROGRAM ROOT [--suite NAME] [--mirror URL] [--other-driver]
#
#     PROGRAM         the build's own program `walr`, which must compute the same pixels
#     ROOT            made by debootstrap if it does not exist
#     --suite         version of Debian; default: this machine's
#     --mirror        where the packages come from; default: apt's
#     --other-driver  the root's driver is another one than this machine's, so that pixels differ
set -euo pipefail
archive=$(realpath "$1") program=$(realpath "$2") root=$(realpath --canonicalize-missing "$3")
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
source "$here/common.sh"
shift 3
suite='' mirror='' same_driver=true
while [ $# -gt 0 ]; do
  case $1 in
    --suite) suite=$2; shift 2 ;;
    --mirror) mirror=$2; shift 2 ;;
    --other-driver) same_driver=false; shift ;;
    *) echo "unknown option $1" >&2; exit 2 ;;
  esac
done

if [ ! -d "$root" ]; then
  suite=${suite:-$(source /etc/os-release && echo "$VERSION_CODENAME")}
  mirror=${mirror:-$(apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^Debian //p' | head -1)}
  [ -n "$mirror" ] || { echo "apt knows no Debian mirror: give --mirror" >&2; exit 2; }
  debootstrap --variant=minbase --include=libvulkan1,mesa-vulkan-drivers "$suite" "$root" "$mirror"
fi
place="/opt/a folder with spaces"
rm -rf "${root:?}$place" "${root:?}/home/results"
unpack "$archive" "$root$place"
inside=${bundle#"$root"}
scenes=$inside/samples/scenes
mkdir -p "$root/home/results"
# Mesa's software device counts processors, and exchanges shared memory with a window.
for folder in proc sys dev; do
  mount --rbind "/$folder" "$root/$folder"
  mount --make-rslave "$root/$folder"
done
away=$(mktemp --directory)
moved=()
put_back() {
  local library
  for library in "${moved[@]}"; do mv "$away/$(basename "$library")" "$library"; done
  moved=()
}
clean_up() {
  put_back
  for folder in proc sys dev; do umount --lazy --recursive "$root/$folder"; done
}
trap clean_up EXIT

# Runs what follows in the root, in the folder of results, with an empty environment.
in_root=(chroot "$root" /usr/bin/env --chdir=/home/results -i HOME=/home PATH=/usr/bin:/bin)

echo "== The programs, with this root's own C++ runtime"
"${in_root[@]}" "$inside/bin/walr" --version
"${in_root[@]}" "$inside/bin/walr-host" --help >/dev/null || fail "walr-host --help"
"${in_root[@]}" "$inside/bin/walr" render "$scenes/turntable.gltf" --output noisy --frames 0-1 --size 64x36
"${in_root[@]}" "$inside/try.sh" .
for file in noisy/noisy_0001.exr denoised/denoised_0005.exr denoised/comparison_0005.png bench/bench.json \
  host/frame_0003.png; do
  [ -s "$root/home/results/$file" ] || fail "there is no $file"
done
if $same_driver; then
  # The options of try.sh, because these decide what the files hold.
  "$program" denoise "$bundle/samples/box" --output "$root/home/results/expected" --composite \
    --direct-light reference >/dev/null
  same_pixels "$root/home/results/denoised" "$root/home/results/expected"
fi

if command -v Xvfb >/dev/null; then
  echo "== A window, on a virtual screen of this machine"
  /usr/bin/python3 "$here/check_window.py" "$root/home/results/host/frame_0003.png" \
    "${in_root[@]}" "DISPLAY={display}" "$inside/bin/walr-host" "$scenes/box.gltf" --once --frames 0-3 --size 256x144 ||
    fail "walr-host with a window"
fi

echo "== The programs without C++ runtime, zlib and X11's libraries"
# Mesa's driver needs them, so nothing that needs a device can run.
while IFS= read -r -d '' library; do
  moved+=("$library")
  mv "$library" "$away/"
done < <(find "$root"/usr/lib/x86_64-linux-gnu -maxdepth 1 -regextype posix-extended \
  -regex '.*/lib(stdc\+\+|gcc_s|z|X.*|xcb.*)\.so.*' -print0)
for tried in walr walr-host; do
  if "${in_root[@]}" "$inside/libexec/$tried" --version >/dev/null 2>&1; then
    fail "$tried starts without what was taken away, so this tests nothing"
  fi
  "${in_root[@]}" "$inside/bin/$tried" --version || fail "$tried without the machine's C++ runtime"
done
"${in_root[@]}" "$inside/bin/walr" render "$scenes/turntable.gltf" --output again --frames 0-1 --size 64x36
cmp "$root/home/results/again/noisy_0001.exr" "$root/home/results/noisy/noisy_0001.exr" || fail "another picture"
put_back
finish
