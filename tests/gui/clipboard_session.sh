#!/bin/bash
# Two running editors and the clipboard between them, with real keyboard events: what is copied in one is pasted into the
# other, also after the first has quit.
#
#   clipboard_session.sh JET OUTPUT_FOLDER
#
# Runs itself under Xvfb with a window manager. Screenshots go to the output folder. Exit 77: a needed program is missing.
set -u
jet=$1
out=$2

. "$(dirname "$0")/session_tools.sh"

declare -A editor window

# Waits, at most 20 s, until a command succeeds.
until_true() { for _ in $(seq 100); do "$@" && return 0; sleep 0.2; done; return 1; }
shown() { window[$1]=$(xdotool search --all --onlyvisible --pid "${editor[$1]}" --name JET 2>/dev/null | head -1); [ -n "${window[$1]}" ]; }
start() {  # NAME X: an editor with the project of that name, in a window at X
    "$jet" "$out/$1" >"$out/$1.log" 2>&1 &
    editor[$1]=$!
    until_true shown "$1" || { fail "editor $1 did not start: $(cat "$out/$1.log")"; exit 1; }
    xdotool windowsize --sync "${window[$1]}" 1000 700 windowmove "${window[$1]}" "$2" 0 2>/dev/null
    settle 1
}
active() { [ "$(xdotool getactivewindow 2>/dev/null)" = "${window[$1]}" ]; }
front() { xdotool windowactivate "${window[$1]}"; until_true active "$1" || fail "$1 did not come to the front"; settle; }
gone() { ! kill -0 "${editor[$1]}" 2>/dev/null; }
stop() {
    front "$1"
    xdotool key --clearmodifiers ctrl+q
    until_true gone "$1" || { fail "editor $1 did not close"; shot "stuck-$1"; kill "${editor[$1]}"; }
    wait "${editor[$1]}" || fail "editor $1 ended with $?: $(tail -3 "$out/$1.log")"
}
# How many shapes the saved scenes of a project have.
shapes() { cat "$out/$1"/scenes/* 2>/dev/null | grep -c '<item [^>]*type="shape"'; }
has() { [ "$(shapes "$1")" = "$2" ]; }

"$jet" project new "$out/first" && "$jet" project new "$out/second" || { fail "jet project new"; exit 1; }
start first 0
start second 420

front first
xdotool mousemove 300 300; xdotool click 2; settle  # a middle click: focus without drawing
key m; drag 200 250 320 330
key ctrl+s
until_true has first 1 || fail "the first editor did not draw"
key ctrl+c
shot 1-copied

front second
key ctrl+v; key ctrl+s
check "what one editor copied the other pastes" until_true has second 1
shot 2-pasted
stop first
front second
key ctrl+v; key ctrl+s
check "and also after the first one has quit" until_true has second 2
key ctrl+z; key ctrl+z; key ctrl+s
check "pasting can be undone" until_true has second 0
key ctrl+y; key ctrl+y; key ctrl+s
until_true has second 2 || fail "redo"
shot 3-after-the-first-quit
stop second
check "the project passes jet project check" "$jet" project check "$out/second"

finish
