#!/usr/bin/env bash
# Runs the README's two commands on a fresh, minimal system, as a user would: in a clone of the committed tree with nothing beside it,
# by a user who may call sudo. Prints exit codes, times, and which tests failed or were skipped. Exit code 1 if a command failed.
#
#     tests/systems/run.sh SYSTEM [COMMAND...]
#
#     SYSTEM     debian-12 or debian-13
#     COMMAND    run these commands of the clone instead; an empty one only makes the system
#
# Needs root, and apt with a Debian mirror. The system and the logs lie in build/systems, about 6 GB; a system from before is replaced.
# Takes about 40 minutes on two idle cores. It is mounted where only this script sees it, so that nothing stays mounted or running.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
here=$PWD

usage() {
  sed -n '2,/^set /s/^# \?//p' "$here/tests/systems/run.sh" >&2
  exit 2
}

case ${1:-} in
  debian-12) suite=bookworm ;;
  debian-13) suite=trixie ;;
  *) usage ;;
esac
system=$1 root=$here/build/systems/$1
shift
[ $# -gt 0 ] || set -- samples/run.sh tests/run.sh
[ "$(id -u)" -eq 0 ] || { echo "run.sh makes a system with debootstrap and chroot, which needs root" >&2; exit 2; }

# Mounts and processes of this script are in namespaces of its own, which end with it however it ends.
if [ "${WALR_SYSTEMS_INSIDE:-}" != yes ]; then
  WALR_SYSTEMS_INSIDE=yes exec unshare --mount --propagation private --pid --fork --kill-child "$0" "$system" "$@"
fi

command -v debootstrap >/dev/null || apt-get install --quiet --quiet --yes --no-install-recommends debootstrap
mirror=$(apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' | sed -n 's/^Debian //p' | head -1)
[ -n "$mirror" ] || { echo "apt of this machine knows no Debian mirror" >&2; exit 2; }
[ -z "$(git status --porcelain)" ] || echo "Changes that are not committed are left out."

rm -rf --one-file-system "$root"
mkdir -p "$root"
echo "Making $system ($suite) in $root"
debootstrap --variant=minbase --include=ca-certificates,sudo "$suite" "$root" "$mirror" >"$root.debootstrap.log" ||
  { tail -5 "$root.debootstrap.log" >&2; exit 2; }
# How apt reaches the mirror from this machine.
apt-config dump | grep -E '^Acquire::(https?|ftp)?(::|Check-|Retries)' >"$root/etc/apt/apt.conf.d/90machine" || true
cp /etc/hosts "$root/etc/hosts"
chroot "$root" useradd --create-home --shell /bin/bash user
echo 'user ALL=(ALL) NOPASSWD: ALL' >"$root/etc/sudoers.d/user"
git clone --quiet --no-hardlinks "$here" "$root/home/user/walr"
commit=$(git -C "$root/home/user/walr" rev-parse --short HEAD)
chroot "$root" chown -R user: /home/user/walr

mount -t proc proc "$root/proc"
mount --rbind /sys "$root/sys"
mount --rbind /dev "$root/dev"
# Keeps the tests' large files in memory off the machine's.
mount -t tmpfs tmpfs "$root/dev/shm"

as_user=(chroot "$root" sudo -u user -H env -i HOME=/home/user USER=user LANG=C.UTF-8 PATH=/usr/local/bin:/usr/bin:/bin
  bash -c 'cd ~/walr && exec bash -c "$0"')
failed=0 summary=()
for command in "$@"; do
  [ -n "$command" ] || continue
  log=$root.$(tr -c 'a-zA-Z0-9\n' '_' <<<"${command::40}").log
  echo "Running $command in $system; output: $log"
  code=0 start=$SECONDS
  "${as_user[@]}" "$command" >"$log" 2>&1 </dev/null || code=$?
  summary+=("$command: exit code $code, $(((SECONDS - start) / 60)) min $(((SECONDS - start) % 60)) s")
  [ "$code" -eq 0 ] || failed=1
  # What ctest says at its end: how many tests passed, and the lists of those that did not run, or failed.
  report=$(sed -n '/^[0-9]*% tests passed/,$p' "$log")
  [ -z "$report" ] || summary+=("$report")
  [ "$code" -eq 0 ] || summary+=("last lines:" "$(tail -20 "$log")")
done

echo
echo "$system: $(. "$root/etc/os-release" && echo "$PRETTY_NAME"), walr $commit, $(date +%Y-%m-%d), $(nproc) cores"
for package in g++ clang cmake libvulkan1 mesa-vulkan-drivers python3; do
  chroot "$root" dpkg-query --show --showformat='  ${Package} ${Version}\n' "$package" 2>/dev/null || true
done
printf '%s\n' "${summary[@]}"
exit $failed
