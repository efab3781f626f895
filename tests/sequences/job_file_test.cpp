#include "sequences/job_file.h"
#include "sequences/errors.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace gridreel::sequences;
using Values = std::vector<std::string>;

TEST_CASE("a job file holds sections of keys and values", "[job_file]") {
    const auto entries = parse_job_file(R"(# A job.
fps = 24

[render]   # for gridreel render
input = "marbles.glb"
output = "out/m.####.png"  # the hashes are not a comment
'background' = '#102030'
size = "640x360"
spp = 1_000
exposure = -0.5
keep-going = true
aov = ["z",
       "n",  # both
]
[bake]
normals = false)",
                                        "job.toml");
    REQUIRE(entries.size() == 10);
    CHECK(entries[0].section.empty());
    CHECK(entries[0].key == "fps");
    CHECK(entries[0].values == Values{"24"});
    CHECK(entries[1].section == "render");
    CHECK(entries[1].key == "input");
    CHECK(entries[1].values == Values{"marbles.glb"});
    CHECK(entries[1].line == 5);
    CHECK(entries[2].values == Values{"out/m.####.png"});
    CHECK(entries[3].key == "background");
    CHECK(entries[3].values == Values{"#102030"});
    CHECK(entries[5].values == Values{"1000"});
    CHECK(entries[6].values == Values{"-0.5"});
    CHECK(entries[7].key == "keep-going");
    CHECK(entries[7].values == Values{"true"});
    CHECK(entries[8].values == Values{"z", "n"});
    CHECK(entries[9].section == "bake");
    CHECK(entries[9].line == 16);
}

TEST_CASE("strings know escapes in double quotes only", "[job_file]") {
    CHECK(parse_job_file(R"(a = "x\\y\"z\t")", "")[0].values == Values{"x\\y\"z\t"});
    CHECK(parse_job_file(R"(a = 'x\y')", "")[0].values == Values{"x\\y"});
    CHECK(parse_job_file("a = ''\r\nb = 1\r\n", "").size() == 2);
}

TEST_CASE("what is malformed or beyond us is refused with its line", "[job_file]") {
    for (const std::string text : {"a",
                                   "a =",
                                   "a = b",
                                   "a = \"x",
                                   "a = \"x\ny\"",
                                   "= 1",
                                   "a = 1 2",
                                   "a = [1",
                                   "a = [1 2]",
                                   "a = {b = 1}",
                                   "a.b = 1",
                                   "[a",
                                   "[[a]]",
                                   "[]",
                                   "a = 1979-05-27",
                                   "a = 1\na = 2",
                                   "[a]\n[a]",
                                   "a = \"\\q\"",
                                   "a = +",
                                   "a = \"\"\"x\"\"\"",
                                   "a = 0x10",
                                   "[a.b]",
                                   "a = _"}) {
        INFO(text);
        CHECK_THROWS_AS(parse_job_file(text, "job.toml"), UsageError);
    }
    CHECK_THROWS_WITH(parse_job_file("a = 1\n\nb = c\n", "job.toml"), Catch::StartsWith("job.toml:3: 'c'"));
    CHECK_THROWS_WITH(parse_job_file("a = 1\na = 2\n", "job.toml"), Catch::StartsWith("job.toml:2: 'a'"));
}

TEST_CASE("a job file that cannot be read is wrong usage", "[job_file]") {
    const gridreel::test::ScratchFolder folder;
    CHECK_THROWS_AS(read_job_file(folder / "none.toml"), UsageError);
    CHECK_THROWS_AS(read_job_file(folder.path()), UsageError);
    gridreel::test::write_file(folder / "job.toml", "fps = 24\n");
    CHECK(read_job_file(folder / "job.toml").size() == 1);
}
