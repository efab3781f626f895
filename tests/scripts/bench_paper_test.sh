#!/usr/bin/env bash
# tools/bench-paper in a folder of its own, with a bench-suite that makes figures up.
set -euo pipefail

# shellcheck source=tests/scripts/house.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/house.sh"
touch "$calls"

# Writes figures in the shape of `gridreel bench --json` for what each experiment compares, on two scenes: the second
# takes ten times as long.
program "$house/tools/bench-suite" "
    echo \"bench-suite \$*\" >> '$calls'
    arguments=\" \$* \"
    while [[ \$1 != --json ]]; do shift; done
    exec > \"\$2\"
    echo '{'
    figures() {  # ACCEL REBUILD PRIMARY CELLS TESTS
        for scene in small large; do
            zero=\$([[ \$scene == large ]] && echo 0 || true)
            printf '   \"real_time\": %s,\n   \"scene\": \"%s\",\n   \"accel\": \"%s\",\n' \"\$2\$zero\" \$scene \"\$1\"
            printf '   \"phase\": \"rebuild\",\n   \"times\": [\n'
            printf '   \"real_time\": %s,\n   \"scene\": \"%s\",\n   \"accel\": \"%s\",\n' \"\$3\$zero\" \$scene \"\$1\"
            printf '   \"phase\": \"primary\",\n   \"cells_per_ray\": %s,\n' \"\$4\"
            printf '   \"triangle_tests_per_ray\": %s,\n   \"times\": [\n' \"\$5\"
        done
    }
    case \$arguments in
        *grid-single*)
            figures grid-single 1 100 40 9
            for side in 4 8 16 auto; do figures grid:packet=\$side 1 \${side/auto/25} 1 2; done
            ;;
        *--culling*)
            figures grid:culling=off,mailbox=off 1 50 1 60
            figures grid:culling=off,mailbox=on 1 50 1 30
            figures grid:culling=on,mailbox=off 1 50 1 10
            figures grid:culling=on,mailbox=on 1 50 1 5
            ;;
        *--macrocells*)
            for side in 16 auto; do
                figures grid:packet=\$side,macrocells=off 1 30 2 1
                figures grid:packet=\$side,macrocells=on 1 20 1 1
            done
            ;;
        *) for lambda in 1 2 5 10; do figures grid:\$lambda \$lambda \$((50 / lambda)) 1 1; done ;;
    esac"
cp "$project/tools/bench-paper" "$project/tools/paper_tables.awk" "$house/tools/"

bench_paper() {
    "$house/tools/bench-paper" "$@" > "$machine/output" 2> "$machine/errors"
}

bench_paper_measures_on_one_thread_at_the_lambda_of_the_paper() {
    bench_paper
    [[ $(wc -l < "$calls") == 4 ]]
    [[ $(grep -c -- "--threads 1 --frames 20" "$calls") == 4 ]]
    [[ $(grep -c -- "--scenes sheet-80k,soup-80k,stadium-80k,needles-50k,kitchen,robots,museum5" "$calls") == 4 ]]
    expect "--accel grid-single,grid --lambda paper --packet 4,8,16,auto" "$calls"
    expect "--lambda paper --packet 16 --culling off,on --mailbox off,on" "$calls"
    expect "--lambda paper --packet 16,auto --macrocells off,on" "$calls"
    expect "--lambda 1,2,5,10 --packet 16" "$calls"
}

bench_paper_sets_claims_beside_measurements() {
    bench_paper
    expect "| coherent packets over single rays, 16 × 16 | 6–21× | 6.2–6.2× |" "$machine/output"
    expect "| culling and mailbox: fewer ray-triangle intersections | 8.5–14× | 12–12× |" "$machine/output"
    expect "| best λ of 1, 2, 5, 10 | 5 | 5 on 2 |" "$machine/output"
    expect "| small | 100.0 | 25 | 12 | 6.2 | 4.0 |" "$machine/output"
    expect "| large | 1000.0 | 25 | 12 | 6.2 | 4.0 |" "$machine/output"
    expect "| small | 60.0 | 30.0 | 10.0 | 5.0 | 12 |" "$machine/output"
    expect "| small | 2.00 | 1.00 | 1.50 | 2.00 | 1.00 | 1.50 |" "$machine/output"
    expect "| small | 1.0 + 50.0 | 2.0 + 25.0 | 5.0 + 10.0 | 10.0 + 5.0 | 5 |" "$machine/output"
}

bench_paper_writes_the_same_for_programs() {
    bench_paper -o "$machine/new folder/table.md" --json "$machine/new folder/figures.json"
    [[ ! -s $machine/output ]]
    expect "| claim | Wald et al. 2006 | here |" "$machine/new folder/table.md"
    local json="$machine/new folder/figures.json"
    expect '"paper": [8.5, 14], "least": 12.000, "most": 12.000}' "$json"
    expect '"best lambda", "paper": 5, "scenes": {"5": 2}}' "$json"
    expect '{"experiment": "lambda", "scene": "large", "accel": "grid:5", "rebuild_ms": 50, "primary_ms": 100, ' "$json"
    [[ $(grep -c '"experiment"' "$json") == 34 ]]
    if command -v jq > "$machine/jq"; then jq -e '.measured | length == 34' "$json"; fi
}

bench_paper_keeps_the_tables_when_a_scene_fails() {
    sed -i '$a exit 3' "$house/tools/bench-suite"
    fails_with 3 bench_paper
    expect "| small | 100.0 |" "$machine/output"
    program "$house/tools/bench-suite" "exit 2"
    fails_with 2 bench_paper
    expect "failed: measuring packets" "$machine/errors"
}

bench_paper_refuses_what_it_does_not_know() {
    fails_with 2 bench_paper --nonsense
    expect "unknown option --nonsense" "$machine/errors"
    fails_with 2 bench_paper --json
    [[ ! -s $calls ]]
    bench_paper --help
    for option in "-o FILE" "--json FILE"; do expect "$option" "$machine/output"; done
}

"$1"
