#!/bin/sh
# Rewrites tests/golden from what the program prints now. Usage: tests/update_golden.sh [BUILD_FOLDER]
# Then read the diff: git diff tests/golden
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build/release}
cmake --build "$build" --target cross_test
mkdir -p "$root/tests/golden"
find "$build" -name cross_test -type f -exec env VISPLINE_UPDATE_GOLDEN=1 {} --gtest_filter='CliGolden.*' \;
git -C "$root" diff --stat -- tests/golden
