#include "sequences/thread_count.h"

#include <catch2/catch.hpp>
#include <sched.h>

using namespace gridreel::sequences;

TEST_CASE("a control group's quota counts whole processors, rounded up", "[thread_count]") {
    CHECK(cpu_quota("200000 100000") == 2);
    CHECK(cpu_quota("150000 100000") == 2);
    CHECK(cpu_quota("5000 100000") == 1);
    CHECK_FALSE(cpu_quota("max 100000"));
    CHECK_FALSE(cpu_quota("-1 100000"));
    CHECK_FALSE(cpu_quota("100000 0"));
    CHECK_FALSE(cpu_quota(""));
    CHECK_FALSE(cpu_quota("100000"));
}

TEST_CASE("threads stay within the affinity mask", "[thread_count]") {
    cpu_set_t before;
    REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
    CHECK(allowed_threads() >= 1);
    CHECK(allowed_threads() <= CPU_COUNT(&before));

    int first = 0;
    while (!CPU_ISSET(first, &before)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
    CHECK(allowed_threads() == 1);
    REQUIRE(sched_setaffinity(0, sizeof before, &before) == 0);
}
