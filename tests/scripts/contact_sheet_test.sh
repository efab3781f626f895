#!/usr/bin/env bash
# tools/contact-sheet in a folder of its own, with a gridreel and an oiiotool that only say what they were asked.
set -euo pipefail

# shellcheck source=tests/scripts/house.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/house.sh"
touch "$calls"

program "$house/tools/build" "exit 0"
program "$house/tools/setup" "exit 0"
cp "$project/tools/contact-sheet" "$house/tools/"
mkdir -p "$house/build/release/tools" "$machine/models/below"
# Frames 0 to 9 of every model but the broken one; a picture for every frame.
program "$house/build/release/tools/gridreel" "
    echo \"gridreel \$*\" >> '$calls'
    if [[ \$2 == *broken* ]]; then echo 'gridreel: error: this is no model' >&2; exit 3; fi
    if [[ \$1 == info ]]; then echo 'clip        0.4 s, frames 0-9 at 24 fps'; exit 0; fi
    while [[ \$1 != -o ]]; do shift; done
    for frame in 0000000 0000003 0000006 0000009; do touch \"\${2/\#\#\#\#\#\#\#/\$frame}\"; done"
program "$machine/bin/oiiotool" "
    echo \"oiiotool \$*\" >> '$calls'
    while [[ \$# -gt 1 ]]; do shift; done
    touch \"\$1\""
touch "$machine/models/a.glb" "$machine/models/below/b.gltf" "$machine/models/broken.glb" "$machine/models/notes.txt"

contact_sheet() {
    (cd "$house" && PATH="$machine/bin:$PATH" tools/contact-sheet "$@") > "$machine/output" 2> "$machine/errors"
}

contact_sheet_has_a_row_for_every_model() {
    contact_sheet -o "$machine/new folder/sheet.png" "$machine/models"
    [[ -e "$machine/new folder/sheet.png" ]]
    expect "3 models" "$machine/output"
    expect "-f 0,3,6,9" "$calls"
    [[ $(grep -c "^gridreel render" "$calls") == 2 ]]
}

contact_sheet_gives_a_refused_model_its_message() {
    contact_sheet -o "$machine/sheet.png" "$machine/models/broken.glb"
    expect "this is no model" "$calls"
    expect "1 models" "$machine/output"
}

contact_sheet_refuses_what_it_does_not_know() {
    fails_with 2 contact_sheet --nonsense
    fails_with 2 contact_sheet --size 200
    fails_with 2 contact_sheet "$machine/nowhere"
    expect "there is no" "$machine/errors"
    rm -r "$machine/models" && mkdir "$machine/models"
    fails_with 2 contact_sheet "$machine/models"
    expect "no .glb or .gltf" "$machine/errors"
    [[ ! -s $calls ]]
}

"$1"
