# Systems of their own to install in: the smallest of Debian and Ubuntu, as chroots. To be sourced, in the folder of the checkout. They are kept in
# $NATATOR_ROOTS, else in build/roots. With NATATOR_CCACHE=DIR they share that cache of compiled code, and times no longer tell how long one compiles.
readonly roots=${NATATOR_ROOTS:-$PWD/build/roots}
(( EUID == 0 )) || { echo "${0##*/}: must run as root: it makes systems of its own" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "${0##*/}: debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }

# Makes system NAME of SUITE, with these PACKAGES (a,b,…) besides its smallest, unless it is there, and `root` the folder of it.
make_root() {
    local name=$1 suite=$2 packages=${3:-} base=$roots/base/$2 mirror=(http://deb.debian.org/debian) components=main
    if [[ $suite == jammy || $suite == noble ]]; then
        mirror=(http://archive.ubuntu.com/ubuntu gutsy)  # the script of all later ones
        components=main,universe  # as Ubuntu's own sources.list
    fi
    root=$roots/$name
    if [[ -e $root/complete ]]; then
        give_network
        return
    fi
    if [[ ! -e $base/complete ]]; then
        rm -rf --one-file-system "$base"
        mkdir -p "$base/etc/dpkg/dpkg.cfg.d"
        echo force-unsafe-io >"$base/etc/dpkg/dpkg.cfg.d/unsafe-io"  # as in container images: does not wait for the disk
        # In a namespace, where its /proc is gone with it, even if it is killed.
        unshare --mount debootstrap --variant=minbase --components="$components" "$suite" "$base" "${mirror[@]}" >"$base.log"
        touch "$base/complete"
    fi
    rm -rf --one-file-system "$root"
    mkdir -p "$(dirname "$root")"
    cp --archive --reflink=auto "$base" "$root"
    rm "$root/complete"
    give_network
    if [[ -n $packages ]]; then
        apt_get update
        # shellcheck disable=SC2086
        apt_get install --no-install-recommends ${packages//,/ }
        give_network
    fi
    touch "$root/complete"
}

# This machine's name servers and certificates, to $root.
give_network() {
    cp /etc/resolv.conf "$root/etc/"
    mkdir -p "$root/etc/ssl/certs"
    cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
    cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
}

apt_get() {  # in $root; what it says is shown if it fails
    in_root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive apt-get -qq --yes -o Dpkg::Use-Pty=0 "$@" >"$root.apt.log" 2>&1 ||
        { cat "$root.apt.log" >&2; exit 1; }
}

# The host's ccache, with the libraries that it needs, in a folder that a system sees at /mnt while a command runs, and never after.
readonly cache=${NATATOR_CCACHE:+$roots/ccache}
cache_variables=()
if [[ -n $cache ]]; then
    command -v ccache >/dev/null || { echo "${0##*/}: NATATOR_CCACHE: ccache is missing: apt-get install ccache" >&2; exit 1; }
    mkdir -p "$NATATOR_CCACHE" "$roots"
    if [[ ! -d $cache ]]; then  # others may be using it
        making=$(mktemp -d "$roots/ccache.XXXX")
        mkdir "$making/bin" "$making/cache"
        ldd "$(command -v ccache)" | grep -o '/[^ ]*' | xargs cp --dereference --target-directory "$making/bin" "$(command -v ccache)"
        printf '#!/bin/sh\nexec /mnt/bin/ld-linux-x86-64.so.2 --library-path /mnt/bin /mnt/bin/ccache "$@"\n' >"$making/ccache"
        chmod 755 "$making" "$making/ccache"
        mv --no-target-directory "$making" "$cache"
    fi
    cache_variables=(CCACHE_DIR=/mnt/cache CCACHE_BASEDIR=/ CCACHE_NOHASHDIR=1 CCACHE_TEMPDIR=/tmp CMAKE_CXX_COMPILER_LAUNCHER=/mnt/ccache
        CCACHE_SLOPPINESS=pch_defines,time_macros CXXFLAGS=-fpch-preprocess)  # without them nothing that has a precompiled header is kept
fi

# Runs a command in it, after variables of its environment, with /proc, by which the program finds its scenes.
in_root() {
    # shellcheck disable=SC2016
    unshare --mount sh -c 'mount -t proc none "$0/proc"
        [ -z "$1" ] || { mount --bind "$1" "$0/mnt" && mount --bind "$2" "$0/mnt/cache"; } || exit
        shift 2; exec chroot "$0" "$@"' "$root" "$cache" "${NATATOR_CCACHE-}" /usr/bin/env -i PATH=/usr/bin:/bin "${cache_variables[@]}" "$@"
}
