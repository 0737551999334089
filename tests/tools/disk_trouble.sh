#!/usr/bin/env bash
# Tests runs on a disk that is full, that becomes read-only, and whose folder is removed. Each must print one line with the
# file and the reason, end with exit code 1, and leave only complete files, and --resume must complete it afterward. Needs to
# mount a small tmpfs in a mount namespace of its own, and a user namespace as well if it does not run as root. If neither is
# allowed, the script says so and exits with 77.
# Usage: disk_trouble.sh PROGRAM
set -euo pipefail

program=$1
if [ "${2:-}" != inside ]; then
    # Root needs no user namespace, which a chroot does not allow.
    for namespaces in "--mount" "--user --map-root-user --mount"; do
        if unshare $namespaces mount -t tmpfs tmpfs /tmp 2>/dev/null; then
            exec unshare $namespaces "$0" "$program" inside
        fi
    done
    echo "skipped: disk_trouble_tests: mount namespaces are not allowed here"
    exit 77
fi

work=$(mktemp -d)
trap 'umount "$work/disk" 2>/dev/null || true; cat "$work"/sanitizer.* >&2 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/disk"
# What a sanitizer has to say is not among the program's lines.
export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}exitcode=99:log_path=$work/sanitizer

fail() { echo "disk_trouble: $*" >&2; exit 1; }

run() { "$program" render measured/fountain --size 160x90 --frames 0-29 --quiet --checkpoint 0 "$@"; }

run -o "$work/whole" --video "$work/whole.mp4"

# Checks what a run printed and left.
check_trouble() { # what happened, exit code, reason
    [ "$2" -eq 1 ] || fail "$1: it ended with $2"
    [ "$(wc -l <"$work/log")" -eq 1 ] || fail "$1: it said: $(cat "$work/log")"
    grep -q "$3" "$work/log" || fail "$1: the reason is not in: $(cat "$work/log")"
    grep -q "$work/disk" "$work/log" || fail "$1: the file is not in: $(cat "$work/log")"
    local file
    for file in "$work"/disk/a/*.png; do
        [ -e "$file" ] || continue
        cmp -s "$file" "$work/whole/${file##*/}" || fail "$1: ${file##*/} is not whole"
    done
}

check_resume() { # what happened
    run -o "$work/disk/a" --video "$work/disk/a.mp4" --resume 2>"$work/log" || fail "$1: it did not go on: $(cat "$work/log")"
    local file
    for file in "$work"/whole/*.png; do
        cmp -s "$file" "$work/disk/a/${file##*/}" || fail "$1: ${file##*/} differs"
    done
    cmp -s "$work/whole.mp4" "$work/disk/a.mp4" || fail "$1: the video differs"
}

needed=$(du -sk "$work" | cut -f1)
for percent in 10 30 60 80; do
    size=$((needed * percent / 100))k
    mount -t tmpfs -o "size=$size" tmpfs "$work/disk"
    code=0
    run -o "$work/disk/a" --video "$work/disk/a.mp4" 2>"$work/log" || code=$?
    check_trouble "disk of $size" "$code" 'No space left on device'
    mount -o remount,size=50m "$work/disk"
    check_resume "disk of $size"
    umount "$work/disk"
done

# Most of a short video is written at its end, so the disk runs full there.
mount -t tmpfs -o size=$(($(stat -c %s "$work/whole.mp4") / 2)) tmpfs "$work/disk"
code=0
"$program" video "$work/whole" -o "$work/disk/a.mp4" --quiet 2>"$work/log" || code=$?
check_trouble 'disk too small for a video' "$code" 'No space left on device'
[ ! -e "$work/disk/a.mp4" ] || fail "a video that is not whole was left"
umount "$work/disk"

mount -t tmpfs -o size=50m tmpfs "$work/disk"
run -o "$work/disk/a" --video "$work/disk/a.mp4" 2>"$work/log" &
child=$!
while [ ! -e "$work/disk/a/frame-00005.png" ]; do sleep 0.02; done
until rm -rf "$work/disk/a" 2>/dev/null; do :; done  # the run may write meanwhile
code=0
wait "$child" || code=$?
check_trouble 'folder removed' "$code" 'No such file or directory'
check_resume 'folder removed'

mount -o remount,ro "$work/disk"
code=0
run -o "$work/disk/a" --resume 2>"$work/log" || code=$?
check_trouble 'read-only disk' "$code" 'Read-only file system'
mount -o remount,rw "$work/disk"
check_resume 'read-only disk'

# The disk becomes read-only during a run. That is possible only while no file is open for writing, so this run makes no
# video.
rm -rf "$work/disk/a" "$work/disk/a.mp4"
run -o "$work/disk/a" 2>"$work/log" &
child=$!
while [ ! -e "$work/disk/a/frame-00005.png" ]; do sleep 0.02; done
until mount -o remount,ro "$work/disk" 2>/dev/null; do :; done
code=0
wait "$child" || code=$?
check_trouble 'disk that became read-only' "$code" 'Read-only file system'
mount -o remount,rw "$work/disk"
check_resume 'disk that became read-only'

echo "eight troubles: every run said what it was, kept its frames, and went on"
