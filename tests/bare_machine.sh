#!/usr/bin/env bash
# Runs the project's commands on bare machines: Debian 12 as debootstrap's "minbase" makes it, a clean clone of HEAD, and
# nothing else. Run it by hand, as root, whenever tools/setup.sh, the CMake presets or the dependencies change; CI does not
# have the time for it. Each step has a machine of its own:
#   figures  runs tools/figures.sh and compares the bytes of its films with those that this machine makes
#   test     runs tools/test.sh
#   package  runs tools/package.sh, and installs and tries the package where there are no compiler and no libraries
# Packages come from where this machine's apt gets them, with its proxies and certificates.
# Usage: bare_machine.sh [--only STEP]... [--commit COMMIT] [--films FOLDER] [--keep]
#   --only STEP      runs this step; may be given again; default: all three
#   --commit COMMIT  what is cloned instead of HEAD
#   --films FOLDER   where this machine's films are, default: out/; where one is missing, they are made anew
#   --keep           leaves the machines there and says where
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
release=bookworm

say() { echo "bare_machine: $*"; }
fail() { echo "bare_machine: error: $*" >&2; exit 1; }

steps=() commit=HEAD films=$repository/out keep=
while [ $# -gt 0 ]; do
    case $1 in
        --only | --commit | --films) [ $# -ge 2 ] || fail "$1 needs a value" ;;&
        --only) steps+=("$2"); shift 2 ;;
        --commit) commit=$2; shift 2 ;;
        --films) films=$(realpath -m "$2"); shift 2 ;;
        --keep) keep=yes; shift ;;
        --help) sed -n '2,/^set/{/^#/s/^# \?//p}' "$0"; exit ;;
        *) fail "there is no option $1; see --help" ;;
    esac
done
[ ${#steps[@]} -gt 0 ] || steps=(figures test package)
for step in "${steps[@]}"; do
    [[ $step =~ ^(figures|test|package)$ ]] || fail "there is no step $step; choose figures, test or package"
done
[ "$(id -u)" -eq 0 ] || fail "run it as root: it makes a system of its own and mounts /proc there"
name=$commit
commit=$(git -C "$repository" rev-parse --verify --quiet "$name^{commit}") || fail "there is no commit $name"

# In a mount namespace of its own nothing stays mounted, however the script ends.
if [ -z "${BARE_MACHINE_NAMESPACE:-}" ]; then
    unshare --mount --pid --fork true 2>/dev/null || fail "mount and process namespaces are not allowed here"
    arguments=(--commit "$commit" --films "$films" ${keep:+--keep})
    for step in "${steps[@]}"; do arguments+=(--only "$step"); done
    BARE_MACHINE_NAMESPACE=yes exec unshare --mount --propagation private "$0" "${arguments[@]}"
fi

work=$(mktemp -d "${TMPDIR:-/var/tmp}/globular-bare-XXXXXX")
chmod 755 "$work"
clean_up() {
    # debootstrap, where it is interrupted, leaves what it has mounted.
    findmnt --raw --noheadings --output TARGET | { grep "^$work/" || true; } | sort -r | xargs -r -n 1 umount --lazy
    if [ -n "$keep" ]; then
        say "the machines are in $work: chroot $work/NAME"
    else
        rm -rf --one-file-system "$work"
    fi
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# Debian's own archives in this machine's configuration, a line each: address, release, component.
archives() {
    apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' 'Origin: Debian' |
        awk -v name="$release" '$3 == "main" && ($2 == name || $2 == name "-updates" || $2 == name "-security")' | sort -u
}

# The proxies that apt and wget use, an assignment each line.
list_proxies() {
    local protocol proxy
    for protocol in http https; do
        eval "$(apt-config shell proxy "Acquire::$protocol::Proxy")"
        [ -z "${proxy:-}" ] || [ "$proxy" = DIRECT ] || echo "${protocol}_proxy=$proxy"
        unset proxy
    done
    env | grep -i -E '^(http|https|ftp|no)_proxy=' || true
}
mapfile -t proxies < <(list_proxies)

# How this machine reaches Debian's archives: names, apt's options with the files that these name, certificates.
copy_network() { # folder of a machine
    local file
    cp --dereference /etc/resolv.conf /etc/hosts "$1/etc/"
    archives | sed 's/^/deb /' >"$1/etc/apt/sources.list"
    apt-config dump --no-empty | grep '^Acquire::' | grep -v -E '^Acquire::(IndexTargets|Changelogs|CompressionTypes)' \
        >"$1/etc/apt/apt.conf.d/90-network" || true
    sed -n 's/.* "\(\/.*\)";$/\1/p' "$1/etc/apt/apt.conf.d/90-network" |
        cat - <(ls /etc/ssl/certs/ca-certificates.crt /usr/local/share/ca-certificates/*.crt 2>/dev/null) |
        while read -r file; do
            [ ! -f "$file" ] || install -D --mode=644 "$file" "$1$file"
        done
}

# A bare Debian, in the folder "bare" that the machines of the steps are copies of.
make_bare() {
    local mirror
    "$repository/tools/install_packages.sh" debootstrap debian-archive-keyring
    [ -n "$(archives)" ] || apt-get update -qq
    mirror=$(archives | awk -v name="$release" '$2 == name { print $1; exit }')
    [ -n "$mirror" ] || fail "this machine's apt knows no archive of Debian's $release"
    say "debootstrap of $release"
    env "${proxies[@]}" debootstrap --variant=minbase "$release" "$work/bare" "$mirror" >"$work/debootstrap.log" 2>&1 || {
        tail -20 "$work/debootstrap.log" >&2
        fail "debootstrap failed"
    }
    rm -f "$work"/bare/var/cache/apt/archives/*.deb
    copy_network "$work/bare"
}

make_machine() { # name
    cp --archive --reflink=auto "$work/bare" "$work/$1"
}

clone_into() { # folder
    git clone --quiet --no-checkout "$repository" "$1"
    git -C "$1" checkout --quiet --detach "$commit"
}

# Runs a command in a machine as if it had booted there: with root file system, processes and environment of its own. A
# chroot would not do, because no user namespaces can be made in one.
on_machine() { # name, command...
    local root=$work/$1
    shift
    unshare --mount --pid --fork --kill-child --propagation private bash -euc '
        mount --bind "$0" "$0"
        cd "$0"
        mount --rbind /dev dev
        mount --rbind /sys sys
        mount -t proc proc proc
        pivot_root . .
        umount --lazy .
        cd /root
        exec env --ignore-environment HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
    ' "$root" "${proxies[@]}" "$@" </dev/null
}

TIMEFORMAT='bare_machine: that took %0R s, %0U + %0S s of processor time'

run_script() { # machine, script
    say "$2 on a bare machine"
    make_machine "$1"
    clone_into "$work/$1/root/globular"
    time on_machine "$1" "globular/$2" || fail "$2 failed on a bare machine"
}

films_of() { (cd "$1" && find . -name '*.mp4' -printf '%P\n' | sort); }

figures() {
    run_script figures tools/figures.sh
    local made=$work/figures/root/globular/out film differ=0 count=0
    for film in $(films_of "$made"); do
        if [ ! -f "$films/$film" ]; then
            say "$films has no $film: tools/figures.sh on this machine"
            clone_into "$work/here"
            "$work/here/tools/figures.sh"
            films=$work/here/out
            break
        fi
    done
    for film in $(films_of "$made"); do
        count=$((count + 1))
        cmp "$films/$film" "$made/$film" || differ=$((differ + 1))
    done
    [ "$count" -gt 0 ] || fail "tools/figures.sh made no films"
    if [ "$differ" -gt 0 ]; then
        say "this machine: $(ffmpeg -version | head -1)"
        say "the bare one: $(on_machine figures ffmpeg -version | head -1)"
        fail "$differ of $count films differ from those in $films"
    fi
    say "figures: $count films have the bytes of those in $films"
}

run_tests() {
    run_script test tools/test.sh
    say "test: passed"
}

package() {
    run_script package-build tools/package.sh
    make_machine package
    cp "$work"/package-build/root/globular/build/release/globular_*.deb "$work/package/root/globular.deb"
    say "installing the package on a bare machine"
    on_machine package bash -euc '
        export DEBIAN_FRONTEND=noninteractive
        apt-get update -qq
        apt-get install -y -qq --no-install-recommends ./globular.deb >/dev/null
        for tool in cc c++ cmake ninja; do
            ! command -v $tool || { echo "this machine has $tool, so that it shows nothing" >&2; exit 1; }
        done
        dpkg --status globular
        dpkg --listfiles globular
        globular --version
        globular scenes
    ' || fail "the package does not install, or its program does not start"
    local render renderer
    for renderer in cpu opengl; do
        render="render measured/liquid --renderer $renderer --frames 0-9 --size 320x180 --quiet -o frames-$renderer --video $renderer.mp4"
        on_machine package globular $render || fail "the package's program does not render: $renderer"
        on_machine package-build globular/build/release/tools/globular $render ||
            fail "the build's program does not render: $renderer"
        cmp "$work"/{package,package-build}/root/$renderer.mp4 ||
            fail "the package's program draws other films than the build does: $renderer"
    done
    on_machine package apt-get purge -y -qq globular >/dev/null || fail "the package cannot be removed"
    [ -z "$(cd "$work/package" && find usr etc -path '*globular*')" ] || fail "the package leaves files behind"
    say "package: it installs, renders the films of the build with both renderers, and leaves nothing behind"
}

make_bare
for step in "${steps[@]}"; do
    case $step in
        figures) figures ;;
        test) run_tests ;;
        package) package ;;
    esac
done
say "all is well: ${steps[*]}, at commit $commit"
