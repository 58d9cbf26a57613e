# Systems of their own to install in: the smallest of Debian and Ubuntu, as chroots. To be sourced, in the folder of the checkout. They are kept in
# $NATATOR_ROOTS, else in build/roots.
readonly roots=${NATATOR_ROOTS:-$PWD/build/roots}
(( EUID == 0 )) || { echo "${0##*/}: must run as root: it makes systems of its own" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "${0##*/}: debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }

# Makes system NAME of SUITE, with these PACKAGES (a,b,…) besides its smallest, unless it is there, and `root` the folder of it.
make_root() {
    local name=$1 suite=$2 packages=${3:-} mirror=(http://deb.debian.org/debian)
    [[ $suite != noble ]] || mirror=(http://archive.ubuntu.com/ubuntu gutsy)  # the script of all later ones
    root=$roots/$name
    if [[ ! -e $root/complete ]]; then
        rm -rf "$root"
        mkdir -p "$(dirname "$root")"
        debootstrap --variant=minbase ${packages:+--include="$packages"} "$suite" "$root" "${mirror[@]}" >"$root.log"
        touch "$root/complete"
    fi
    # The network's name servers and certificates.
    cp /etc/resolv.conf "$root/etc/"
    mkdir -p "$root/etc/ssl/certs"
    cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
    cp -r /usr/local/share/ca-certificates "$root/usr/local/share/"
}

# Runs a command in it, after variables of its environment, with /proc, by which the program finds its scenes.
in_root() {
    unshare --mount sh -c 'mount -t proc none "$0/proc" && exec chroot "$0" "$@"' "$root" /usr/bin/env -i PATH=/usr/bin:/bin "$@"
}
