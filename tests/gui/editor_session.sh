#!/bin/bash
# A session in the editor with real mouse and keyboard events: draw, move, undo, redo, save, reopen, play, stop, pan, zoom.
#
#   editor_session.sh JET OUTPUT_FOLDER [EXAMPLE_PROJECT]
#
# Runs itself under Xvfb with a window manager. Screenshots go to the output folder. Exit 77: a needed program is missing.
set -u
jet=$1
out=$2
example=${3:-}

. "$(dirname "$0")/session_tools.sh"
project=$out/project
play="216 40"  # buttons of the tool bar, pixels of the window
stop="314 40"
editor=0

start() {
    "$jet" "$@" >"$out/editor.log" 2>&1 &
    editor=$!
    for _ in $(seq 100); do
        window=$(xdotool search --all --onlyvisible --pid "$editor" --name JET 2>/dev/null | head -1)
        [ -n "$window" ] && break
        kill -0 "$editor" 2>/dev/null || { fail "the editor did not start: $(cat "$out/editor.log")"; exit 1; }
        sleep 0.2
    done
    xdotool windowmove --sync "$window" 0 0 windowsize --sync "$window" 1440 880 2>/dev/null
    xdotool windowactivate --sync "$window"
    settle 1
}
stop() {
    xdotool key --clearmodifiers ctrl+q
    for _ in $(seq 50); do kill -0 "$editor" 2>/dev/null || break; sleep 0.1; done
    kill -0 "$editor" 2>/dev/null && { fail "the editor did not close"; shot stuck; kill "$editor"; }
    wait "$editor"
    local code=$?
    [ $code -eq 0 ] || fail "the editor ended with $code: $(tail -3 "$out/editor.log")"
}
click() { xdotool mousemove "$1" "$2"; settle 0.2; xdotool click 1; settle 0.2; }
# The scene's part of two screenshots, pixel by pixel; true without ImageMagick.
pixels() { convert "$out/$1.png" -crop 800x400+100+150 rgba:- 2>/dev/null | sha256sum; }
same() { [ "$(pixels "$1")" = "$(pixels "$2")" ]; }
differ() { ! same "$1" "$2"; }
save() { key ctrl+s; settle 0.4; }
# All files of the project but the hidden ones (backups, the lock), names and bytes.
content() { (cd "$project" && find . -type f -not -path '*/.*' -print0 | sort -z | xargs -0 sha256sum) | sha256sum; }

settle

"$jet" project new "$project" || { fail "jet project new"; exit 1; }
start "$project"
empty=$(content)
shot 1-empty

xdotool mousemove 600 400; settle 0.2; xdotool click 2; settle 0.2  # a middle click: focus without drawing
key m; drag 400 300 560 400
key l; drag 620 320 760 460
shot 2-drawn
save
drawn=$(content)
check "drawing changes the files" [ "$drawn" != "$empty" ]

key ctrl+z; key ctrl+z; save
check "undo gives the empty project back" [ "$(content)" = "$empty" ]
key ctrl+shift+z; key ctrl+y; save
check "redo gives the drawing back" [ "$(content)" = "$drawn" ]

key v; drag 480 350 520 520
shot 3-moved
save
moved=$(content)
check "dragging moves a shape" [ "$moved" != "$drawn" ]

key f; drag 600 600 500 560 3
xdotool mousemove 600 400 click 4 click 4 click 4; settle
shot 4-zoomed
save
check "panning and zooming change nothing" [ "$(content)" = "$moved" ]

stop

start "$project"
shot 5-reopened
key ctrl+s; stop
check "a reopened project is saved to the same bytes" [ "$(content)" = "$moved" ]
check "the project passes jet project check" "$jet" project check "$project"

# An example game: play, steer, pause and stop from the tool bar; the files stay as they were.
if [ -n "$example" ] && [ -e "$example/project.jet" ]; then
    project=$out/game
    cp -r "$example" "$project"
    before=$(content)
    start "$project"
    shot 6-game
    click $play; settle 1
    xdotool keydown d; settle 1.5; xdotool keyup d
    shot 7-playing
    key F7; shot 8-paused
    key F10
    click $stop; settle 0.5
    shot 9-stopped
    key ctrl+s
    check "playing and stopping change nothing" [ "$(content)" = "$before" ]
    check "the pictures of play and of editing differ" differ 7-playing 9-stopped
    check "stop shows the scene as it was left" same 6-game 9-stopped
    stop
fi

finish
