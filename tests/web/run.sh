#!/usr/bin/env bash
# What is made for browsers and viewers, looked at with their own tools: the .glb files of `riemap map` by the Khronos validator,
# the page of `riemap reproduce` in headless Chromium. Installs what is missing on Debian and Ubuntu, as root; needs the network once.
# usage: tests/web/run.sh [RIEMAP [INDEX.html [SCREENSHOT-FOLDER]]]    by default target/release/riemap and results/index.html
set -euo pipefail
clone=$(realpath "$(dirname "$0")/../..")
riemap=$(realpath "${1:-$clone/target/release/riemap}")
page=$(realpath "${2:-$clone/results/index.html}")
screenshots=${3:+$(realpath -m "$3")}
cd "$(dirname "$0")"

missing=()
command -v node >/dev/null || missing+=(nodejs)
command -v npm >/dev/null || missing+=(npm)
export CHROMIUM=${CHROMIUM:-/usr/bin/chromium}
[ -x "$CHROMIUM" ] || missing+=(chromium)
if [ ${#missing[@]} -gt 0 ]; then
    if [ "$(id -u)" -ne 0 ] || ! command -v apt-get >/dev/null; then
        echo "missing: ${missing[*]}; on Debian and Ubuntu: apt-get install ${missing[*]} (Node 18 or later; CHROMIUM names the browser)" >&2
        exit 1
    fi
    apt-get -qq update
    DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends "${missing[@]}" >/dev/null
fi

# A lock made behind a mirror would send everybody else there.
if grep '"resolved"' package-lock.json | grep -v '"resolved": "https://registry.npmjs.org/'; then
    echo "package-lock.json names another registry than registry.npmjs.org" >&2
    exit 1
fi

# Installed beside the build, so that the sources stay clean.
modules=$clone/target/web
mkdir -p "$modules"
cp package.json package-lock.json ./*.js "$modules"
cd "$modules"
npm ci --silent --no-audit --no-fund

node glb.js "$riemap"
node page.js "$page" ${screenshots:+"$screenshots"}
