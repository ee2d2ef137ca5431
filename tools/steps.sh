# SPDX-License-Identifier: MIT
# Runs the steps of tools/setup, tools/render and tools/test, which source this file. On a terminal,
# the last line shows the step, its percentage and its time. If standard error is not a terminal, at
# least one line appears every 15 s.
set -o pipefail

on_terminal() {
    [ -t 2 ] && [ "${TERM-dumb}" != dumb ]
}

# Reads a command's output and shows its progress: ninja and ctest print N/M, apt-get prints a
# percentage (APT::Status-Fd). Also prints the lines that match the pattern $2, if given.
show_progress() {
    local name=$1 passed=${2-} percent= line= part status shown=$SECONDS
    local counts='^[ []*([0-9]+)/([0-9]+)[] ]' period=14 start= end='\n'
    ! on_terminal || { period=0 start='\r\033[K' end=; }
    while :; do
        status=0
        IFS= read -r -t 1 part || status=$?
        line+=$part
        [ $status -eq 0 ] || [ $status -gt 128 ] || break
        if [ $status -eq 0 ]; then
            if [[ $line =~ $counts ]]; then
                percent=", $((100 * BASH_REMATCH[1] / BASH_REMATCH[2])) %"
            elif [[ $line =~ ^(dl|pm)status:[^:]*:([0-9]+) ]]; then
                percent=", ${BASH_REMATCH[2]} %"
            fi
            if [ -n "$passed" ] && [[ $line =~ $passed ]]; then
                printf "$start%s\n" "$line"
                shown=$SECONDS
            fi
            line=
        fi
        if [ $((SECONDS - shown)) -ge $period ]; then
            printf "$start%s%s, %s s$end" "$name" "$percent" $((SECONDS - begun)) >&2
            shown=$SECONDS
        fi
    done
    printf "$start" >&2
}

# step NAME NEXT COMMAND...: runs the command and stores its output in the file $step_log. If the
# command fails, prints the output and exits.
step() {
    local name=$1 next=$2 begun=$SECONDS
    shift 2
    "$@" 2>&1 | tee "$step_log" | show_progress "$name" || {
        cat "$step_log" >&2
        echo "$name: failed after $((SECONDS - begun)) s" >&2
        exit 1
    }
    step_had_no_work || echo "$name: done in $((SECONDS - begun)) s; next: $next" >&2
}

# Returns whether the last step was a build that had nothing to do.
step_had_no_work() {
    grep -q "^ninja: no work to do" "$step_log"
}

step_log=$(mktemp)
trap 'rm -f "$step_log"' EXIT
