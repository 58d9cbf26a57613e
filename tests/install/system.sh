# Sourced by the tests here, as root: Debian and Ubuntu systems of their own, in $NATATOR_ROOTS, else in build/roots.
readonly roots=${NATATOR_ROOTS:-$PWD/build/roots}
(( EUID == 0 )) || { echo "${0##*/}: must run as root: it makes systems of its own" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "${0##*/}: debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }

# system NAME SUITE PACKAGES: one with these packages besides the smallest, in $root; each test gets its own /tried.
system() {
    local name=$1 suite=$2 packages=$3 mirror=(http://deb.debian.org/debian)
    if [[ $suite == noble ]]; then
        mirror=(http://archive.ubuntu.com/ubuntu gutsy)  # the script of all later ones
    fi
    root=$roots/$name
    if [[ ! -e $root/complete ]]; then
        rm -rf "$root"
        debootstrap --variant=minbase --include="ca-certificates${packages:+,$packages}" "$suite" "$root" "${mirror[@]}" >"$root.log"
        touch "$root/complete"
    fi
    cp /etc/resolv.conf "$root/etc/"
    cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
    rm -rf "$root/tried"
    mkdir -p "$root/tried/elsewhere"
}

inside() {  # with /proc, by which the program finds its scenes
    unshare --mount sh -c 'mount -t proc none "$0/proc" && exec chroot "$0" "$@"' "$root" /usr/bin/env -i HOME=/tried PATH=/usr/bin:/bin PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_CERT=/etc/ssl/certs/ca-certificates.crt "$@"
}
