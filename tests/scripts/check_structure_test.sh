#!/usr/bin/env bash
# Feeds scripts/check-structure small trees, each with one fault, and expects it to be found at its place.
set -euo pipefail
checker="$1/scripts/check-structure"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

# A tree without faults: one plugin with its test, a bit of host and SDK.
good_tree() {
    rm -rf "$tree"
    mkdir -p "$tree"/{plugins/tools/star,plugins/io-abc,tests/plugins/tools,tests/plugins/io-abc,host/app,sdk/src/ui,sdk/include/jet/ui,docs/decisions}
    echo '{ "id": "org.a.star", "contributes": { "tools": [{ "id": "star", "label": "Star" }] } }' >"$tree/plugins/tools/star/plugin.json"
    echo 'jet_add_plugin(star SOURCES star.cpp)' >"$tree/plugins/tools/star/CMakeLists.txt"
    printf '#include "star.hpp"\n#include <jet/tool.hpp>\n#include <vector>\n' >"$tree/plugins/tools/star/star.cpp"
    echo '#pragma once' >"$tree/plugins/tools/star/star.hpp"
    echo '{ "id": "org.a.abc" }' >"$tree/plugins/io-abc/plugin.json"
    echo 'jet_add_plugin(io-abc SOURCES abc.cpp)' >"$tree/plugins/io-abc/CMakeLists.txt"
    echo '#pragma once' >"$tree/plugins/io-abc/abc.hpp"
    echo '// tests' >"$tree/tests/plugins/tools/star_test.cpp"
    echo '// tests' >"$tree/tests/plugins/io-abc/abc_test.cpp"
    echo '// a star is born: "star"' >"$tree/host/app/main.cpp"
    echo '#include <QWidget>' >"$tree/sdk/src/ui/widget.cpp"
    echo 'class QWidget;' >"$tree/sdk/include/jet/ui/panel.hpp"
    echo '#include <jet/ui/panel.hpp>' >"$tree/sdk/src/core.cpp"
}

# expect "what is tested" "the start of a line of the report"
expect() {
    local report
    report=$("$checker" "$tree" 2>/dev/null) && code=0 || code=$?
    if [ "$code" != 1 ] || ! grep -qF "$2" <<<"$report"; then
        printf 'FAILED: %s\n  expected: %s\n  got (exit %s): %s\n' "$1" "$2" "$code" "$report"
        failures=$((failures + 1))
    fi
}

good_tree
"$checker" "$tree" || { echo "FAILED: the good tree is not good"; failures=1; }

good_tree; echo '#include "host/app/editor.hpp"' >>"$tree/plugins/tools/star/star.cpp"
expect "a plugin including the host" "plugins/tools/star/star.cpp:4: a plugin includes only"
good_tree; echo '#include "../../io-abc/abc.hpp"' >>"$tree/plugins/tools/star/star.cpp"
expect "a plugin including another by path" "plugins/tools/star/star.cpp:4: a plugin includes only"
good_tree; echo '#include "abc.hpp"' >>"$tree/plugins/tools/star/star.cpp"
expect "a plugin including another by name" "plugins/tools/star/star.cpp:4: 'abc.hpp' belongs to the plugin io-abc"
good_tree; echo 'target_link_libraries(star PRIVATE jet-host-cli)' >>"$tree/plugins/tools/star/CMakeLists.txt"
expect "a plugin linking the host" "plugins/tools/star/CMakeLists.txt:2: a plugin is built from its own folder"
good_tree; echo 'auto tool = create("star");' >>"$tree/host/app/main.cpp"
expect "the host naming a tool" "host/app/main.cpp:2: the host names 'star'"
good_tree; echo 'load("org.a.abc");' >>"$tree/host/app/main.cpp"
expect "the host naming a plugin" "host/app/main.cpp:2: the host names 'org.a.abc'"
good_tree; echo 'warn("install org.a.abc first");' >>"$tree/host/app/main.cpp"
expect "the host naming a plugin in a sentence" "host/app/main.cpp:2: the host names 'org.a.abc'"
good_tree; echo '#include <QString>' >>"$tree/sdk/src/core.cpp"
expect "Qt in the core" "sdk/src/core.cpp:2: the core of the SDK has no Qt"
good_tree; echo '#include <QWidget>' >>"$tree/sdk/include/jet/ui/panel.hpp"
expect "Qt in the core through jet/ui" "sdk/src/core.cpp:1: the core of the SDK has no Qt"
good_tree; yes '// line' | head -n 601 >"$tree/host/app/long.cpp" || true
expect "a long file" "host/app/long.cpp:601: 601 lines"
echo 'host/app/long.cpp is long because' >"$tree/docs/decisions/0001-long.md"
"$checker" "$tree" || { echo "FAILED: a long file with a record is reported"; failures=$((failures + 1)); }
good_tree; printf 'open("/%s/main/data");\n' work >>"$tree/host/app/main.cpp"
expect "a machine's path" "host/app/main.cpp:2: a path of one machine"
good_tree; printf '// TO%s: later\n' DO >>"$tree/host/app/main.cpp"
expect "unfinished work" "host/app/main.cpp:2: a mark of unfinished work"
good_tree; printf 'See issue %s.\n' 12 >"$tree/docs/page.md"
expect "a tracker's number" "docs/page.md:1: a number of some tracker"
good_tree; rm "$tree/plugins/io-abc/CMakeLists.txt"
expect "a plugin without CMakeLists.txt" "plugins/io-abc/CMakeLists.txt:1: each plugin folder has"
good_tree; rm "$tree/plugins/io-abc/plugin.json"
expect "a plugin without manifest" "plugins/io-abc/plugin.json:1: each plugin folder has"
good_tree; rm -r "$tree/tests/plugins/io-abc"
expect "a plugin without tests" "plugins/io-abc:1: no test mirrors this plugin"

[ "$failures" = 0 ] && echo "all faults were found"
exit "$((failures > 0))"
