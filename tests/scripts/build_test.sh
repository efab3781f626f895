#!/usr/bin/env bash
# tools/build, test, demo and .ci/run in a folder of their own, with programs that only note how they were called.
set -euo pipefail

# shellcheck source=tests/scripts/house.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/house.sh"
export CMAKE_BUILD_PARALLEL_LEVEL=3 CTEST_PARALLEL_LEVEL=5
mkdir -p "$house/tools" "$house/.ci" "$machine/bin"
cp "$project"/tools/{build,test,demo} "$house/tools/"
cp "$project/.ci/run" "$house/.ci/"
echo "{}" > "$house/CMakePresets.json"
export PATH=$machine/bin:$PATH

program "$house/tools/setup" ":"
program "$house/tools/lint" "echo lint >> '$calls'"
program "$machine/bin/cmake" "
    echo \"cmake \$*\" >> '$calls'
    if [[ \$1 == --preset ]]; then mkdir -p build/\$2; touch build/\$2/build.ninja; fi"
closing_lines="100% tests passed, 0 tests failed out of 7

Total Test time (real) =   0.12 sec"
program "$machine/bin/ctest" "
    echo \"ctest \$*\" >> '$calls'
    echo '$closing_lines'
    printf '\nThe following tests did not run:\n\t  3 - needs assets (Skipped)\n'"
program "$house/build/release/tools/gridreel" "echo \"\$PWD: gridreel \$*\" >> '$calls'"


a_second_build_does_not_configure_again() {
    cd /
    "$house/tools/build" dev
    "$house/tools/build" dev gridreel gridreel_anim
    expect_calls "cmake --preset dev" "cmake --build build/dev --parallel 3" \
        "cmake --build build/dev --parallel 3 --target gridreel gridreel_anim"
}

changed_presets_configure_again() {
    "$house/tools/build" dev
    touch -d "1 minute" "$house/CMakePresets.json"
    "$house/tools/build" dev
    expect_calls "cmake --preset dev" "cmake --build build/dev --parallel 3" \
        "cmake --preset dev" "cmake --build build/dev --parallel 3"
}

a_failed_build_is_named_and_nothing_is_tested() {
    program "$machine/bin/cmake" "[[ \$1 == --preset ]]"
    fails "$house/tools/test" 2> "$machine/errors"
    grep -qx "tools/build: failed: building preset dev" "$machine/errors"
    [[ ! -e $calls ]]
}

test_hands_its_arguments_to_ctest() {
    "$house/tools/test" -R "two words"
    expect_calls "cmake --preset dev" "cmake --build build/dev --parallel 3" \
        "ctest --test-dir build/dev --output-on-failure --no-tests=error --parallel 5 -R two words"
}

test_all_goes_through_every_preset() {
    "$house/tools/test" --all
    diff <(printf '%s\n' dev asan tsan clang) <(sed -n 's|^ctest --test-dir build/\([a-z]*\) .*|\1|p' "$calls")
}

demo_renders_the_marbles_from_any_folder() {
    cd /
    "$house/tools/demo" --frames 0-1 -o out/m.####.png
    expect_calls "cmake --preset release" "cmake --build build/release --parallel 3 --target gridreel" \
        "/: gridreel render --config $house/sequences/gallery/marbles/job.toml --frames 0-1 -o out/m.####.png"
    [[ -e $project/sequences/gallery/marbles/job.toml ]]
}

quick_demo_renders_a_few_small_frames() {
    "$house/tools/demo" --quick --frames 0-1
    grep -q "job.toml --frames 0-3 --size 320x180 --frames 0-1$" "$calls"
}

ci_ends_with_the_closing_lines_of_ctest() {
    cd /
    "$house/.ci/run" > "$machine/output"
    grep -qx lint "$calls"
    grep -q gridreel "$calls"
    diff <(echo "$closing_lines") <(tail -n 3 "$machine/output")
}

ci_fails_when_only_lint_fails() {
    program "$house/tools/lint" "exit 1"
    fails "$house/.ci/run" > "$machine/output"
    grep -qx ".ci/run: failed: tools/lint" "$machine/output"
    grep -q gridreel "$calls"
    diff <(echo "$closing_lines") <(tail -n 3 "$machine/output")
}

ci_fails_when_a_test_fails() {
    local closing="86% tests passed, 1 tests failed out of 7

Total Test time (real) =   0.12 sec"
    program "$machine/bin/ctest" "
        echo '$closing'
        printf '\nThe following tests FAILED:\n\t  2 - rays miss (Failed)\n'
        echo 'Errors while running CTest' >&2
        exit 8"
    fails "$house/.ci/run" > "$machine/output" 2>&1
    grep -qx ".ci/run: failed: tools/test" "$machine/output"
    diff <(echo "$closing") <(tail -n 3 "$machine/output")
}

"$1"
