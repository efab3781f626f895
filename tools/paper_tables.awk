# Tables of tools/bench-paper, from what bench wrote of its experiments:
# awk -v form=markdown|json -f tools/paper_tables.awk experiment=packets FILE experiment=intersections FILE ...

function value(line) { sub(/^ *"[^"]*": "?/, "", line); sub(/"?,?$/, "", line); return line }
function times(ratio) { return ratio == 0 ? "" : sprintf(ratio < 9.95 ? "%.1f" : "%.0f", ratio) }
function note(claim, factor) {
    if (factor == 0) return  # a scene that failed
    if (!(claim in least) || factor < least[claim]) least[claim] = factor
    if (!(claim in most) || factor > most[claim]) most[claim] = factor
}
function range(claim) { return times(least[claim]) "–" times(most[claim]) "×" }
function key(experiment, scene, accel) { return experiment SUBSEP scene SUBSEP accel }
function ms(experiment, scene, accel) { return primary[key(experiment, scene, accel)] }
function ratio(above, below) { return below > 0 ? above / below : 0 }
# Figures stand one a line in the JSON of `gridreel bench`, the phase after the time.
/^   "scene":/ { name = value($0) }
/^   "accel":/ { accel = value($0) }
/^   "real_time":/ { time_ms = value($0) }
/^   "phase":/ { phase = value($0) }
/^   "cells_per_ray":/ && phase == "primary" { cells[key(experiment, name, accel)] = value($0) }
/^   "triangle_tests_per_ray":/ && phase == "primary" { tests[key(experiment, name, accel)] = value($0) }
/^   "times":/ && phase == "rebuild" { rebuild[key(experiment, name, accel)] = time_ms }
/^   "times":/ && phase == "primary" {
    primary[key(experiment, name, accel)] = time_ms
    measured[++count_measured] = key(experiment, name, accel)
    if (!(name in known)) { known[name] = 1; scene[++scenes] = name }
}

END {
    split("4 8 16 auto", side, " ")
    packets = "\n## Coherent packets over single rays\n\nTimes faster, primary rays, λ = 5.\n\n" \
        "| scene | single rays, ms | 4 × 4 | 8 × 8 | 16 × 16 | default |\n|---|--:|--:|--:|--:|--:|\n"
    split("culling=off,mailbox=off culling=off,mailbox=on culling=on,mailbox=off culling=on,mailbox=on", \
        switches, " ")
    intersections = "\n## Ray-triangle intersections\n\nPer primary ray, packets of 16 × 16, λ = 5.\n\n" \
        "| scene | neither | mailbox | culling | both | times fewer |\n|---|--:|--:|--:|--:|--:|\n"
    macrocells = "\n## Macrocells\n\nCells per primary ray, and times faster with them, λ = 5.\n\n" \
        "| scene | 16 × 16: without | with | faster | default: without | with | faster |\n" \
        "|---|--:|--:|--:|--:|--:|--:|\n"
    split("1 2 5 10", lambda, " ")
    sweep = "\n## λ\n\nMilliseconds of rebuild + primary rays, packets of 16 × 16.\n\n" \
        "| scene | λ = 1 | 2 | 5 | 10 | best |\n|---|--:|--:|--:|--:|--:|\n"
    for (i = 1; i <= scenes; ++i) {
        s = scene[i]

        single = ms("packets", s, "grid-single")
        packets = packets sprintf("| %s | %.1f |", s, single)
        for (j = 1; j <= 4; ++j) {
            r = ratio(single, ms("packets", s, "grid:packet=" side[j]))
            note("packet=" side[j], r)
            packets = packets " " times(r) " |"
        }
        packets = packets "\n"

        intersections = intersections "| " s " |"
        for (j = 1; j <= 4; ++j) {
            count[j] = tests[key("intersections", s, "grid:" switches[j])]
            intersections = intersections sprintf(" %.1f |", count[j])
        }
        fewer = ratio(count[1], count[4])
        note("intersections", fewer)
        intersections = intersections " " times(fewer) " |\n"

        macrocells = macrocells "| " s " |"
        for (j = 3; j <= 4; ++j) {
            off = "grid:packet=" side[j] ",macrocells=off"
            on = "grid:packet=" side[j] ",macrocells=on"
            r = ratio(ms("macrocells", s, off), ms("macrocells", s, on))
            note("macrocells " side[j], r)
            macrocells = macrocells sprintf(" %.2f | %.2f | %.2f |", cells[key("macrocells", s, off)], \
                cells[key("macrocells", s, on)], r)
        }
        macrocells = macrocells "\n"

        sweep = sweep "| " s " |"
        best = 0
        for (j = 1; j <= 4; ++j) {
            k = key("lambda", s, "grid:" lambda[j])
            sweep = sweep sprintf(" %.1f + %.1f |", rebuild[k], primary[k])
            if (best == 0 || rebuild[k] + primary[k] < least_ms) {
                best = lambda[j]
                least_ms = rebuild[k] + primary[k]
            }
        }
        ++won[best]
        sweep = sweep " " best " |\n"
    }
    for (j = 1; j <= 4; ++j) {
        if (won[lambda[j]] == 0) continue
        bests = bests (bests == "" ? "" : ", ") lambda[j] " on " won[lambda[j]]
        best_json = best_json (best_json == "" ? "" : ", ") "\"" lambda[j] "\": " won[lambda[j]]
    }

    if (form == "json") {
        printf "{\n \"claims\": [\n"
        line = "  {\"claim\": \"%s\", \"paper\": %s, \"least\": %.3f, \"most\": %.3f},\n"
        for (j = 1; j <= 4; ++j) {
            c = "packet=" side[j]
            printf line, "grid-single / grid:" c, "[6, 21]", least[c], most[c]
        }
        printf line, "intersections without / with culling and mailbox", "[8.5, 14]", \
            least["intersections"], most["intersections"]
        printf "  {\"claim\": \"best lambda\", \"paper\": 5, \"scenes\": {%s}}\n ],\n", best_json
        print " \"measured\": ["
        for (i = 1; i <= count_measured; ++i) {
            k = measured[i]
            split(k, part, SUBSEP)
            printf "  {\"experiment\": \"%s\", \"scene\": \"%s\", \"accel\": \"%s\", \"rebuild_ms\": %s, " \
                "\"primary_ms\": %s, \"cells_per_ray\": %s, \"triangle_tests_per_ray\": %s}%s\n", \
                part[1], part[2], part[3], rebuild[k], primary[k], cells[k] + 0, tests[k] + 0, \
                i < count_measured ? "," : ""
        }
        print " ]\n}"
    } else {
        print "| claim | Wald et al. 2006 | here |\n|---|--:|--:|"
        print "| coherent packets over single rays, 16 × 16 | 6–21× | " range("packet=16") " |"
        print "| the same, 8 × 8 | | " range("packet=8") " |"
        print "| the same, 4 × 4 | | " range("packet=4") " |"
        print "| the same, default packets | | " range("packet=auto") " |"
        print "| culling and mailbox: fewer ray-triangle intersections | 8.5–14× | " range("intersections") " |"
        print "| best λ of 1, 2, 5, 10 | 5 | " bests " |"
        print "| macrocells: faster, 16 × 16 | | " range("macrocells 16") " |"
        printf "%s%s%s%s", packets, intersections, macrocells, sweep
    }
}
