#include "sequences/whole_file.h"
#include "sequences/errors.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

using namespace gridreel::sequences;
using gridreel::test::bytes_of;
using gridreel::test::ScratchFolder;

TEST_CASE("a file is replaced whole, with the permissions of the umask", "[whole_file]") {
    const ScratchFolder folder;
    const mode_t before = umask(027);
    write_whole_file(folder / "a", "first");
    write_whole_file(folder / "a", "second");
    umask(before);
    CHECK(bytes_of(folder / "a") == "second");
    CHECK(folder.names() == std::vector<std::string>{"a"});
    struct stat status {};
    REQUIRE(stat((folder / "a").c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("writers of one file at one time never mix", "[whole_file]") {
    const ScratchFolder folder;
    constexpr std::size_t length = 1 << 20;
    std::atomic<int> failures = 0;
    std::vector<std::thread> writers;
    for (const char letter : {'a', 'b', 'c', 'd'}) {
        writers.emplace_back([&, letter] {
            try {
                for (int i = 0; i < 8; ++i) write_whole_file(folder / "f", std::string(length, letter));
            } catch (const OutputError&) {
                ++failures;
            }
        });
    }
    for (std::thread& writer : writers) writer.join();
    CHECK(failures == 0);
    const std::string bytes = bytes_of(folder / "f");
    REQUIRE(bytes.size() == length);
    CHECK(bytes == std::string(length, bytes.front()));
    CHECK(folder.names() == std::vector<std::string>{"f"});
}

TEST_CASE("a file that cannot be written leaves nothing behind", "[whole_file]") {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "taken/inside");
    CHECK_THROWS_AS(write_whole_file(folder / "taken", "text"), OutputError);
    CHECK_THROWS_AS(write_whole_file(folder / "missing/file", "text"), OutputError);
    CHECK(folder.names() == std::vector<std::string>{"taken"});
}
