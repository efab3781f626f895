#!/usr/bin/env bash
# tools/bench-suite in a folder of its own, with programs that only note how they were called.
set -euo pipefail

# shellcheck source=tests/scripts/house.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/house.sh"
made=$house/build/bench-suite
touch "$calls"

program "$house/tools/build" "echo \"build \$*\" >> '$calls'"
# Writes the file after -o.
program "$house/build/release/tools/gallery/make_gallery" "
    echo \"make_gallery \$*\" >> '$calls'
    while [[ \$1 != -o ]]; do shift; done
    touch \"\$2\""
# Knows the options of bench but for --nonsense; writes the file after --markdown.
fake_gridreel() {  # STRUCTURES
    program "$house/build/release/tools/gridreel" "
        case \" \$* \" in
            *' --help '*) echo '  --accel LIST=grid            Structures: $1; the first is compared'; exit ;;
            *' --nonsense '*) echo 'no such option: --nonsense' >&2; exit 2 ;;
            *' /dev/null '*) echo 'null: the file is empty' >&2; exit 3 ;;
        esac
        echo \"gridreel \$*\" >> '$calls'
        echo 'long figures'
        while [[ \$1 != --markdown ]]; do shift; done
        echo '| a table |' > \"\$2\""
}
fake_gridreel "grid, grid-single, naive, embree"
cp "$project/tools/bench-suite" "$house/tools/"

assets() {  # FILE...
    local file
    for file in "$@"; do
        mkdir -p "$(dirname -- "$machine/shared/assets/$file")"
        touch "$machine/shared/assets/$file"
    done
}
bench_suite() {
    "$house/tools/bench-suite" "$@" > "$machine/output" 2> "$machine/errors"
}
expect_none() {  # TEXT FILE
    if grep -F -- "$1" "$2"; then echo "did not expect '$1'"; return 1; fi
}
measured() {  # the scenes of the one measurement
    grep '^gridreel bench' "$calls" | grep -o '[a-z0-9-]*\.glb' | sed 's/\.glb$//'
}

bench_suite_help_names_its_options_and_does_nothing() {
    bench_suite --help
    for option in --quick "--scenes LIST" --list "-o FILE" "--json FILE"; do expect "$option" "$machine/output"; done
    [[ ! -s $calls ]]
}

bench_suite_lists_every_scene_of_the_suite() {
    assets khronos/Fox.glb khronos/CesiumMan.glb characters/lumberjack.glb bart/{kitchen,robots,museum5}.glb
    bench_suite --list
    diff - <(cut -d ' ' -f 1 "$machine/output") <<'END'
sheet-10k
sheet-80k
sheet-1m
sheet-4m
soup-10k
soup-80k
soup-1m
stadium-80k
stadium-1m
exploding-250k
needles-50k
forest-174k
crowd-fox
crowd-lumberjack
crowd-cesium-man
kitchen
robots
museum5
END
    [[ ! -s $calls ]]
}

bench_suite_leaves_out_by_name_what_is_not_there() {
    assets khronos/Fox.glb
    bench_suite --list
    expect "crowd-fox 57600" "$machine/output"
    for name in kitchen robots museum5 crowd-lumberjack crowd-cesium-man; do
        expect "left out: $name (there is no ../shared/assets/" "$machine/output"
    done
    bench_suite
    expect "left out: kitchen (there is no ../shared/assets/bart/kitchen.glb)" "$machine/errors"
    expect "left out: kitchen" "$machine/output"
    expect_none kitchen "$calls"
}

quick_bench_suite_has_no_scene_beyond_200000_triangles() {
    bench_suite --list --quick
    expect "sheet-80k 80000" "$machine/output"
    expect "forest-174k 174000" "$machine/output"
    local name triangles
    while read -r name triangles; do
        [[ $name == left ]] || [[ $triangles -le 200000 ]] || { echo "$name has $triangles"; return 1; }
    done < "$machine/output"
}

quick_bench_suite_measures_one_frame_against_the_quickest_builder() {
    bench_suite --quick
    expect "--accel grid,embree --embree-quality low --threads 2 --frames 20 --size" "$calls"
}

bench_suite_measures_the_scenes_asked_for() {
    assets bart/kitchen.glb
    bench_suite --scenes sheet-80k,kitchen,museum5
    diff <(printf '%s\n' sheet-80k kitchen) <(measured)
    expect "left out: museum5" "$machine/errors"
    fails_with 2 bench_suite --scenes sheet-80k,sheet
    expect "no scene is called 'sheet'" "$machine/errors"
    fails_with 2 bench_suite --scenes
}

bench_suite_measures_all_scenes_in_one_run() {
    assets khronos/Fox.glb bart/kitchen.glb
    bench_suite
    expect "build release gridreel make_gallery" "$calls"
    expect "make_gallery sheet --triangles 4000000 -o $made/sheet-4m.glb" "$calls"
    expect "make_gallery crowd $house/../shared/assets/khronos/Fox.glb --count 100" "$calls"
    [[ $(grep -c '^gridreel bench' "$calls") == 1 ]]
    diff <(measured) <("$house/tools/bench-suite" --list | sed -n 's/ [0-9]*$//p')
    expect "--accel grid,embree --embree-quality low,medium,refit --threads 2 --frames 5,20,60,last" "$calls"
    expect "--size 1024x1024 --spp 1 --lights default" "$calls"
    diff <(echo "| a table |") <(grep '^|' "$machine/output")
    expect_none "long figures" "$machine/output"
}

bench_suite_hands_further_options_to_bench_in_place_of_its_own() {
    bench_suite --quick --json out.json -f7 --embree-quality refit --threads=1,2 --repeat 9 \
        -o "$machine/new folder/table.md"
    expect "--json out.json -f7 --embree-quality refit --threads=1,2 --repeat 9" "$calls"
    expect_none "--embree-quality low" "$calls"
    expect_none "--frames" "$calls"
    expect_none "--threads 2" "$calls"
    expect "--spp 1" "$calls"
    expect "| a table |" "$machine/new folder/table.md"
    [[ ! -s $machine/output ]]
}

bench_suite_refuses_an_unknown_option_before_it_makes_scenes() {
    fails_with 2 bench_suite --quick --nonsense
    expect "no such option: --nonsense" "$machine/errors"
    expect_none make_gallery <(grep -v '^build' "$calls")
    fails_with 2 bench_suite -o
}

bench_suite_makes_scenes_again_only_when_the_generator_changed() {
    bench_suite --quick
    rm "$calls"
    bench_suite --quick
    expect_none make_gallery <(grep -v '^build' "$calls")
    rm "$calls"
    touch -d "1 minute" "$house/build/release/tools/gallery/make_gallery"
    bench_suite --quick
    expect "make_gallery sheet --triangles 10000" "$calls"
}

bench_suite_without_embree_says_how_to_get_it() {
    fake_gridreel "grid, grid-single, naive"
    bench_suite --quick
    expect "--accel grid,grid-single" "$calls"
    expect "libembree-dev" "$machine/errors"
}

bench_suite_keeps_the_table_when_a_scene_fails() {
    sed -i '$a exit 3' "$house/build/release/tools/gridreel"
    fails_with 3 bench_suite --quick
    expect "| a table |" "$machine/output"
}

"$1"
