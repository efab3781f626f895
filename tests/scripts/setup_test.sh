#!/usr/bin/env bash
# tools/setup on invented machines: a list of our own, and a PATH that holds nothing but what a case puts there.
set -euo pipefail

# shellcheck source=tests/scripts/house.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/house.sh"
mkdir -p "$house/tools" "$machine/bin"
cp "$project/tools/setup" "$house/tools/"
cat > "$house/tools/packages.txt" <<'END'
# A list for tests.
[build]
alpha      # why
beta
# between
libgamma+1-dev

[dev]
delta
END

fake() {  # NAME BODY: a program on the machine's PATH
    program "$machine/bin/$1" "$2"
}
for program in bash dirname grep env cat; do ln -s "$(command -v "$program")" "$machine/bin/$program"; done

debian() {  # UID STATUS...: a Debian machine; each STATUS as dpkg-query prints it, "installed alpha"
    fake id "echo $1"
    shift
    printf '%s\n' "$@" > "$machine/status"
    fake dpkg-query "cat '$machine/status'; exit 1"
    fake apt-get "echo \"apt-get \$* [\$DEBIAN_FRONTEND]\" >> '$calls'"
}
setup() {
    PATH=$machine/bin bash "$house/tools/setup" "$@" > "$machine/output" 2>&1
}
expect_no_calls() {
    [[ ! -e $calls ]]
}
expect_output() {
    grep -qF -- "$1" "$machine/output" || { echo "expected '$1' in:"; cat "$machine/output"; return 1; }
}

setup_installs_exactly_the_missing_packages_of_the_list() {
    debian 0 "installed beta"
    setup
    expect_calls "apt-get --quiet update [noninteractive]" \
        "apt-get --quiet install --yes --no-install-recommends alpha libgamma+1-dev [noninteractive]"
}

setup_dev_installs_both_sections() {
    debian 0 "installed alpha"
    setup --dev
    expect_calls "apt-get --quiet update [noninteractive]" \
        "apt-get --quiet install --yes --no-install-recommends beta libgamma+1-dev delta [noninteractive]"
}

setup_calls_apt_for_nothing_when_all_is_there() {
    debian 1000 "installed libgamma+1-dev" "installed alpha" "installed beta"
    setup
    expect_no_calls
}

setup_takes_a_removed_package_for_missing() {
    debian 0 "installed alpha" "config-files beta" "installed libgamma+1-dev"
    setup
    expect_calls "apt-get --quiet update [noninteractive]" \
        "apt-get --quiet install --yes --no-install-recommends beta [noninteractive]"
}

setup_uses_sudo_only_when_not_root() {
    debian 1000 "installed alpha" "installed beta"
    fake sudo "echo \"sudo \$1\" >> '$calls'; \"\$@\""
    setup
    expect_calls "sudo env" "apt-get --quiet update [noninteractive]" \
        "sudo env" "apt-get --quiet install --yes --no-install-recommends libgamma+1-dev [noninteractive]"

    rm "$calls"
    fake id "echo 0"
    setup
    fails grep sudo "$calls"
}

setup_without_root_or_sudo_says_what_to_run() {
    debian 1000 "installed alpha"
    fails setup
    expect_no_calls
    expect_output "apt-get install --no-install-recommends beta libgamma+1-dev"
}

setup_without_apt_prints_what_is_needed_and_fails() {
    fails setup
    for package in alpha beta libgamma+1-dev; do expect_output "  $package"; done
    expect_output "has no apt-get"
    fails grep delta "$machine/output"
}

setup_names_the_apt_step_that_failed() {
    debian 0 "installed alpha" "installed beta"
    fake apt-get "[[ \$2 == update ]]"
    fails setup
    expect_output "failed: apt-get install --yes --no-install-recommends libgamma+1-dev"
}

only_setup_names_packages_to_apt() {
    cd "$project"
    local callers
    callers=$(grep -rlE '(apt|apt-get|aptitude)( -[a-z-]+)* (install|update)' .ci tools README.md CONTRIBUTING.md)
    [[ $callers == tools/setup ]] || { echo "these name packages themselves: $callers"; return 1; }
}

the_list_names_every_package_once() {
    local listed
    listed=$("$project/tools/setup" --dev --list)
    grep -qx cmake <<< "$listed"
    [[ -z $(sort <<< "$listed" | uniq -d) ]]
    # As Debian's policy 5.6.7 spells names.
    fails grep -vxE '[a-z0-9][a-z0-9+.-]+' <<< "$listed"
}

"$1"
