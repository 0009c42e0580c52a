# Shared by the scripts in this folder. Sourced, not run.
set -euo pipefail

jet_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jet_started=$SECONDS

say() { printf '\033[1m[%3ds]\033[0m %s\n' "$((SECONDS - jet_started))" "$*"; }
fail() {
    printf 'error: %s\n' "$*" >&2
    exit 1
}
# Output that is no terminal gets no escape sequences.
[ -t 1 ] || say() { printf '[%3ds] %s\n' "$((SECONDS - jet_started))" "$*"; }

# Prints the packages of the given groups of packages.txt.
packages_of() {
    awk -v wanted=" $* " '
        { sub(/#.*/, "") }
        /^\[/ { match($0, /\[[a-z]+\]/); taken = index(wanted, " " substr($0, 2, RLENGTH - 2) " "); next }
        taken && NF { print $1 }' "$jet_root/scripts/packages.txt"
}

# Configures build/<preset> unless it is configured already; further arguments go to cmake.
configure() {
    local preset=$1
    shift
    if [ -f "$jet_root/build/$preset/build.ninja" ] && [ $# -eq 0 ]; then return; fi
    say "configuring build/$preset"
    local log="$jet_root/build/$preset-configure.log"
    mkdir -p "$jet_root/build"
    (cd "$jet_root" && cmake --preset "$preset" "$@" >"$log" 2>&1) || {
        cat "$log" >&2
        fail "CMake cannot configure build/$preset; the reason is above"
    }
}

# Builds the given targets of a preset (all if none), with ninja's progress.
build() {
    local preset=$1
    shift
    say "building build/$preset"
    (cd "$jet_root" && cmake --build "build/$preset" ${JET_JOBS:+-j"$JET_JOBS"} ${1:+--target "$@"}) ||
        fail "the build of build/$preset failed; the first error is above"
}

preset_names="release debug asan tsan"
check_preset() {
    case " $preset_names " in
        *" $1 "*) ;;
        *) fail "there is no preset '$1'; the presets are: $preset_names" ;;
    esac
}
