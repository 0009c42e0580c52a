#!/bin/bash
# A plugin that crashes when it is used, in the editor with real mouse and keyboard events: the next start names it and
# goes on without it.
#
#   crash_session.sh JET OUTPUT_FOLDER FOLDER_OF_THE_CRASHING_PLUGIN
#
# Runs itself under Xvfb with a window manager. Exit 77: a needed program is missing.
set -u
jet=$1
out=$2
plugin=$3

for program in Xvfb xdotool openbox; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
if [ "${JET_SESSION_DISPLAY:-}" = "" ]; then
    JET_SESSION_DISPLAY=1 exec "$(dirname "$0")/../../scripts/with-display" --manager openbox "$0" "$@"
fi

rm -rf "$out"
mkdir -p "$out"
export XDG_CONFIG_HOME=$out/settings XDG_STATE_HOME=$out/state XDG_DATA_HOME=$out/data QT_QPA_PLATFORM=xcb
failures=0

check() { local what=$1; shift; if "$@"; then echo "ok: $what"; else echo "FAILED: $what"; failures=$((failures + 1)); fi; }
shot() { command -v import >/dev/null && import -window root "$out/$1.png"; }

start() {
    "$jet" --plugin-path "$plugin" "$@" >"$out/editor.log" 2>&1 &
    editor=$!
}
# The window of the running editor with that name.
find_window() {
    for _ in $(seq 150); do
        window=$(xdotool search --all --onlyvisible --pid "$editor" --name "$1" 2>/dev/null | head -1)
        [ -n "$window" ] && return 0
        kill -0 "$editor" 2>/dev/null || return 1
        sleep 0.2
    done
    return 1
}
ends() { for _ in $(seq 100); do kill -0 "$editor" 2>/dev/null || return 0; sleep 0.1; done; return 1; }
use_tool() {
    xdotool windowmove --sync "$window" 0 0 windowsize --sync "$window" 1440 880 2>/dev/null
    xdotool windowactivate --sync "$window"
    sleep 1
    xdotool mousemove 700 500 click 3; sleep 0.3; xdotool key Escape; sleep 0.3  # the scene has the focus
    xdotool key k; sleep 0.5
    xdotool click 1; sleep 1
}

draw_box() {
    xdotool windowmove --sync "$window" 0 0 windowsize --sync "$window" 1440 880 2>/dev/null
    xdotool windowactivate --sync "$window"
    sleep 1
    xdotool mousemove 700 500 click 3; sleep 0.3; xdotool key Escape; sleep 0.3  # the scene has the focus
    xdotool key m; sleep 0.5
    xdotool mousemove 500 350 mousedown 1; sleep 0.2; xdotool mousemove 560 400; sleep 0.1; xdotool mousemove 650 450
    sleep 0.2; xdotool mouseup 1; sleep 1
}
journals() { ls "$out/state/jet/journals" 2>/dev/null | wc -l; }

start
check "the editor starts" find_window "— JET"
draw_box
check "what is drawn is recorded" [ "$(journals)" -eq 1 ]
use_tool
check "the tool takes the editor down" ends
wait "$editor"; code=$?
check "by a segmentation fault (exit code $code)" [ "$code" -eq 139 ]
check "a ledger is left" [ "$(ls "$out/state/jet/ledger" | wc -l)" -eq 1 ]

start
check "the next start asks" find_window "JET ended unexpectedly"
shot 1-question
xdotool windowactivate --sync "$window"; sleep 0.5
xdotool key Return
check "and goes on with the work that was not saved" find_window "Untitled\* — JET"
check "which it does not ask for again" [ -z "$(xdotool search --all --onlyvisible --pid "$editor" --name "Recover unsaved")" ]
use_tool
shot 2-without
check "without the plugin: the same key and click do no harm" kill -0 "$editor"
xdotool key ctrl+q
ends || { xdotool key --clearmodifiers alt+d; ends || kill "$editor"; }
wait "$editor"; code=$?
check "it ends in order (exit code $code)" [ "$code" -eq 0 ]
check "no journal is left" [ "$(journals)" -eq 0 ]
check "no ledger is left" [ -z "$(ls "$out/state/jet/ledger")" ]

start
check "the start after that asks no more" find_window "— JET"
xdotool windowactivate --sync "$window"; sleep 0.5
xdotool key ctrl+q
ends || kill "$editor"

[ $failures -eq 0 ] && echo "all well" || { echo "$failures failure(s); screenshots in $out"; cat "$out/editor.log"; }
exit $((failures > 0))
