#!/usr/bin/env bash
# natator-core as the bundle that Maven Central is given, signed by a key for this once, with a clock; then what Central asks of it, and
# a program that is built against that bundle alone and swims. Needs gpg, Maven and build/release/bin/natator-sim.
#   tests/install/maven.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
command -v gpg >/dev/null || { echo "maven.sh: gpg is missing: apt-get install gpg" >&2; exit 1; }
[[ -x build/release/bin/natator-sim ]] || { echo "maven.sh: no build/release/bin/natator-sim: build it by mvn compile" >&2; exit 1; }

work=$(mktemp -d)
trap 'gpgconf --kill gpg-agent; rm -rf "$work"' EXIT
export GNUPGHOME=$work/gnupg NATATOR_SIM=$PWD/build/release/bin/natator-sim
version=$(tests/versions.py --show)
readonly bundle=ga-java/target/natator-core-$version-bundle.zip
seconds() { awk -v a="$1" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f s", b - a }'; }

mkdir --mode=700 "$GNUPGHOME"
gpg --batch --quiet --passphrase '' --quick-generate-key 'natator test' default sign 1d 2>/dev/null
rm -rf "$bundle" ga-java/target/central
began=$EPOCHREALTIME
mvn -q -f ga-java/pom.xml -Partefacts,central -pl core -Drevision="$version" -DskipTests deploy
printf '%s: %d bytes in %s\n' "$bundle" "$(stat -c %s "$bundle")" "$(seconds "$began")"

# https://central.sonatype.org/publish/requirements/
mkdir "$work/bundle"
(cd "$work/bundle" && jar --extract --file="$OLDPWD/$bundle")
folder=$work/bundle/io/natator/natator-core/$version
cd "$folder"
for kind in .jar -sources.jar -javadoc.jar .pom; do
    file=natator-core-$version$kind
    gpg --batch --quiet --verify "$file.asc" "$file" 2>/dev/null || { echo "maven.sh: $file: its signature is bad" >&2; exit 1; }
    for sum in md5 sha1; do
        printf '%s  %s\n' "$(<"$file.$sum")" "$file" | "${sum}sum" --check --quiet
    done
done
[[ $(ls) == "$(printf "natator-core-$version%s\n" {-javadoc.jar,-sources.jar,.jar,.pom}{,.asc,.md5,.sha1})" ]] || { ls; exit 1; }
for element in name description url licenses/license/name licenses/license/url developers/developer/name scm/url scm/connection \
        scm/developerConnection; do
    python3 - "natator-core-$version.pom" "$element" <<'PYTHON'
import sys
from xml.etree import ElementTree
maven = {"": "http://maven.apache.org/POM/4.0.0"}
if not ElementTree.parse(sys.argv[1]).findtext(sys.argv[2], namespaces=maven):
    sys.exit(f"maven.sh: {sys.argv[1]}: no {sys.argv[2]}, which Maven Central asks for")
PYTHON
done
grep -q -e '<parent>' -e '\${' -e SNAPSHOT "natator-core-$version.pom" && { echo "maven.sh: the POM needs another one" >&2; exit 1; }
cd "$OLDPWD"

# Nothing of Natator is in its local repository: there are only the links to what others have made.
readonly local=${MAVEN_LOCAL:-$HOME/.m2/repository}
mkdir -p "$work/local/io"
find "$local" -mindepth 1 -maxdepth 1 ! -name io -exec ln -s -t "$work/local" {} +
[[ ! -d $local/io ]] || find "$local/io" -mindepth 1 -maxdepth 1 ! -name natator -exec ln -s -t "$work/local/io" {} +
cp -r tests/install/consumer "$work/"
began=$EPOCHREALTIME
said=$(mvn -q -f "$work/consumer/pom.xml" -Dmaven.repo.local="$work/local" -Dnatator.bundle="$work/bundle" -Dnatator.version="$version" \
    compile exec:java 2>&1) || { echo "$said" >&2; exit 1; }
printf '%s\nbuilt against it and swum in %s\n' "$said" "$(seconds "$began")"
grep -Eq '^swim: OK 0\.[0-9]+$' <<<"$said"
