#!/usr/bin/env bash
# All files of a release, from a clean clone of its tag to build/release-artefacts, with NOTES.md and SHA256SUMS; then tried in systems that have
# nothing else. Of a commit that is no tag it is a rehearsal. .github/workflows/release.yml runs it, and drafts the release.
#   tests/install/release.sh [--without PART]... [TAG|COMMIT]      # HEAD; PART: deb, central, site, trials
# Needs ./setup.sh --readers, a Debian mirror, PyPI and Maven Central; trials need root and debootstrap. $NATATOR_SIGNING_KEY names the key
# of gpg that signs for Maven Central; without it, it is a key for this once, and the bundle is no more than a rehearsal.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() { echo "usage: tests/install/release.sh [--without deb|central|site|trials]... [TAG|COMMIT]" >&2; exit 2; }
fail() { printf 'release.sh: %s\n' "$1" >&2; exit 1; }

named=HEAD without=' '
while (( $# )); do
    case $1 in
        --without) [[ ${2-} =~ ^(deb|central|site|trials)$ ]] || usage; without+="$2 "; shift ;;
        -*) usage ;;
        *) named=$1 ;;
    esac
    shift
done
with() { [[ $without != *" $1 "* ]]; }
commit=$(git rev-parse --quiet --verify "$named^{commit}") || { echo "release.sh: $named: must be a tag or a commit" >&2; exit 2; }
tag=
git show-ref --quiet --verify "refs/tags/$named" && tag=$named
[[ -x .readers/bin/python ]] || fail '.readers/bin/python is missing: ./setup.sh --readers'
with trials && (( EUID != 0 )) && fail 'trials need root: they make systems of their own; or --without trials'

# --- a clean clone ----------------------------------------------------------------------------------------------------

readonly out=$PWD/build/release-artefacts clone=$PWD/build/release-clone readers=$PWD/.readers
rm -rf "$out" "$clone"
mkdir -p "$out"
git clone --quiet --no-checkout . "$clone"
cd "$clone"
git -c advice.detachedHead=false checkout --quiet "$commit"
ln -s "$readers" .readers
export PATH=$readers/bin:$PATH SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
python3 tests/versions.py ${tag:+"$tag"} || fail "the versions of ${tag:-$named} do not agree"
version=$(tests/versions.py --show)
printf '%s of %s, %s\n' "$([[ -n $tag ]] && echo release || echo rehearsal)" "$version" "${commit:0:12}"

# What other scripts make needs these.
missing() { fail "${tag:-$named} has no $2, which makes part $1; to do without: --without $1"; }
with deb && { grep -qs '"name": "deb"' CMakePresets.json || missing deb 'package preset deb in CMakePresets.json'; }
with central && { [[ -x tests/install/maven.sh ]] || missing central tests/install/maven.sh; }
with deb && with trials && { [[ -x tests/install/deb.sh ]] || missing deb tests/install/deb.sh; }

# --- the program once, for wheel, package and jar ---------------------------------------------------------------------

cmake --preset release -DNATATOR_TESTS=OFF >/dev/null
mvn --quiet --batch-mode -DskipTests package
[[ $(build/release/bin/natator-sim --version) == "natator-sim $version, commit ${commit:0:12}"* ]] ||
    fail "the program says $(build/release/bin/natator-sim --version): must be $version, commit ${commit:0:12}"
said=$(java -jar ga-java/target/natator.jar --version)
[[ ${said%-SNAPSHOT} == "natator $version" && ( -z $tag || $said != *-SNAPSHOT ) ]] || fail "natator.jar says $said: must be natator $version"
cp ga-java/target/natator.jar ga-java/target/natator-spark.jar "$out"

python -m pip --quiet --disable-pip-version-check wheel --no-index --no-deps --no-build-isolation \
    --config-settings "cmake.define.NATATOR_BUILT=$PWD/build/release" --wheel-dir build/wheel .
python -m auditwheel repair --wheel-dir "$out" build/wheel/natator-"$version"-*-linux_*.whl 2>/dev/null
python -c 'import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])' "$out" >/dev/null
wheel=$(echo "$out"/natator-"$version"-*-manylinux_*.whl)
sdist=$out/natator-$version.tar.gz
[[ -s $wheel && -s $sdist ]] || fail "no wheel or sdist of $version"
python -m twine check --strict "$wheel" "$sdist" >/dev/null
python -m check_wheel_contents "$wheel" >/dev/null

# --- what other scripts make ------------------------------------------------------------------------------------------

if with deb; then
    cpack --preset deb >/dev/null
    cp build/deb/natator_"$version"_*.deb "$out"
fi
if with central; then
    tests/install/maven.sh
    bundle=natator-core-$version-bundle.zip
    if [[ -n ${NATATOR_SIGNING_KEY-} ]]; then
        mvn --quiet --batch-mode --file ga-java/pom.xml -Partefacts,central --projects core -Drevision="$version" -DskipTests \
            -Dgpg.keyname="$NATATOR_SIGNING_KEY" clean deploy
        cp "ga-java/target/$bundle" "$out"
    else
        cp "ga-java/target/$bundle" "$out/${bundle%.zip}-rehearsal.zip"
    fi
fi
if with site; then
    .ci/site
    tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 -czf "$out/natator-$version-site.tar.gz" --directory build site
fi

# --- tried, told ------------------------------------------------------------------------------------------------------

if with trials; then
    tests/install/wheel.sh --source "$wheel"
    tests/install/checkout.sh bookworm
    if with deb; then tests/install/deb.sh; fi
fi
awk '/^## \[/ && inside { exit } inside { print } /^## \[/ { inside = 1 }' CHANGELOG.md >"$out/NOTES.md"
grep -q '^- ' "$out/NOTES.md" || fail 'CHANGELOG.md says nothing of this version'
cd "$out"
sha256sum -- * >../SHA256SUMS
mv ../SHA256SUMS .
sha256sum --check --quiet SHA256SUMS
stat --printf '%12s  %n\n' -- *
