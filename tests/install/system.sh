# Sourced by the tests here, as root: systems of their own that things are installed in.
. tests/install/roots.sh

# system NAME SUITE PACKAGES: one with these packages besides the smallest, in $root; each test gets its own /tried.
system() {
    make_root "$1" "$2" "ca-certificates${3:+,$3}"
    rm -rf "$root/tried"
    mkdir -p "$root/tried/elsewhere"
}

inside() {
    in_root HOME=/tried PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_CERT=/etc/ssl/certs/ca-certificates.crt "$@"
}

clock() { awk -v a="$1" -v b="${2:-$EPOCHREALTIME}" 'BEGIN { printf "%.1f s", b - a }'; }  # BEGAN [ENDED]
