#!/usr/bin/env bash
# What is made for browsers and viewers, looked at with their own tools. Needs Node 18 or later with npm and, once, the network.
# usage: tests/web/run.sh [RIEMAP]    the program to be tested, by default target/release/riemap
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../.. && pwd)
riemap=$(realpath "${1:-$root/target/release/riemap}")

# Installed beside the build, so that the sources stay clean.
modules=$root/target/web
mkdir -p "$modules"
cp package.json package-lock.json ./*.js "$modules"
cd "$modules"
npm ci --silent --no-audit --no-fund

node glb.js "$riemap"
