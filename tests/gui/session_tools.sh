# What sessions with real mouse and keyboard events share. Sourced with the session's own arguments, after jet, out:
# gives them a display with a window manager (the session is started anew on it), an empty output folder, settings of
# their own. Exit 77: a needed program is missing.
for program in Xvfb xdotool openbox import; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
if [ "${JET_SESSION_DISPLAY:-}" = "" ]; then
    JET_SESSION_DISPLAY=1 exec "$(dirname "$0")/../../scripts/with-display" --manager openbox "$0" "$@"
fi

rm -rf "$out"
mkdir -p "$out/settings" "$out/runtime"
chmod 700 "$out/runtime"
export XDG_CONFIG_HOME=$out/settings XDG_STATE_HOME=$out/state XDG_RUNTIME_DIR=$out/runtime QT_QPA_PLATFORM=xcb
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
check() { local what=$1; shift; if "$@"; then echo "ok: $what"; else fail "$what"; fi; }
shot() { import -window root "$out/$1.png"; }
settle() { sleep "${1:-0.4}"; }
key() { xdotool key --clearmodifiers "$@"; settle; }
drag() {  # x0 y0 x1 y1 [button]
    local button=${5:-1}
    xdotool mousemove "$1" "$2"; settle 0.1
    xdotool mousedown "$button"; settle 0.1
    xdotool mousemove $((($1 + $3) / 2)) $((($2 + $4) / 2)); settle 0.1
    xdotool mousemove "$3" "$4"; settle 0.1
    xdotool mouseup "$button"; settle
}
finish() {
    [ $failures -eq 0 ] && echo "all well" || echo "$failures failure(s); screenshots in $out"
    exit $((failures > 0))
}
