#!/bin/sh
# Builds the plugin into build/ and runs its tests. JET is the one that made this project; JET_PREFIX names another.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
prefix=${JET_PREFIX:-'my-jet-prefix'}
[ -e "$prefix" ] || prefix=$(dirname "$(dirname "$(command -v jet || echo /usr/bin/jet)")")
if [ ! -f "$here/build/CMakeCache.txt" ] && command -v ninja >/dev/null; then
    export CMAKE_GENERATOR=Ninja
fi
cmake -S "$here" -B "$here/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" >"$here/.configure.log" 2>&1 || {
    cat "$here/.configure.log" >&2
    echo "error: CMake could not configure the project; if it did not find Jet, set JET_PREFIX to where it is installed" >&2
    exit 1
}
rm -f "$here/.configure.log"
cmake --build "$here/build" --parallel
ctest --test-dir "$here/build" --output-on-failure
echo "built: jet --plugin-path '$here/build/lib/jet/plugins'"
