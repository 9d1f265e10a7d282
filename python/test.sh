#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh virtual environment and runs the tests of the Python package there.
# Needs cargo, Python 3.9 or later with venv, and once the network. RIEMAP names the command line program to compare with;
# without it target/release/riemap is built.
set -euo pipefail
cd "$(dirname "$0")"
target=${CARGO_TARGET_DIR:-$PWD/../target}
environment=$target/python

rm -rf "$environment"
python3 -m venv "$environment"
bin=$environment/bin
"$bin/pip" install --quiet --disable-pip-version-check --only-binary :all: --require-hashes -r tests/requirements.txt
"$bin/maturin" build --release --locked --quiet --interpreter "$bin/python" --out "$environment/wheels"
"$bin/pip" install --quiet --disable-pip-version-check --no-deps "$environment"/wheels/riemap-*.whl

if [ -z "${RIEMAP:-}" ]; then
    (cd .. && cargo build --locked --quiet --release)
    export RIEMAP=$target/release/riemap
fi
"$bin/mypy"
# The wheel is tested, not the folder beside this script.
"$bin/python" -m pytest -q -p no:cacheprovider tests "$@"
"$bin/python" -m pytest -q -p no:cacheprovider --doctest-modules --pyargs riemap
