#!/usr/bin/env bash
# To be sourced: a machine of the test's own, with a project in it whose programs only note how they were called.
# shellcheck disable=SC2034  # whoever sources this uses them
set -euo pipefail

project=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
machine=$(mktemp -d)
trap 'rm -rf -- "$machine"' EXIT
house=$machine/"a house"
calls=$machine/calls

program() {  # PATH BODY
    mkdir -p "$(dirname -- "$1")"
    printf '#!%s\n%s\n' "$BASH" "$2" > "$1"
    chmod +x "$1"
}
fails() {  # COMMAND...
    if "$@"; then echo "did not fail: $*"; return 1; fi
}
fails_with() {  # STATUS COMMAND...
    local status=0
    "${@:2}" || status=$?
    [[ $status == "$1" ]] || { echo "exit $status instead of $1: ${*:2}"; return 1; }
}
expect() {  # TEXT FILE
    grep -qF -- "$1" "$2" || { echo "expected '$1' in:"; cat "$2"; return 1; }
}
expect_calls() {  # LINE...
    diff <(printf '%s\n' "$@") "$calls"
}
