#include "rebuild/huge_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace gridreel::rebuild {

void ask_for_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr std::size_t least = std::size_t{4} << 20;  // two huge pages of x86-64
    if (bytes < least) return;
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(memory), inside = (begin + page - 1) / page * page;
    const std::uintptr_t end = (begin + bytes) / page * page;
    (void)::madvise(reinterpret_cast<void*>(inside), end - inside, MADV_HUGEPAGE);
#endif
}

}  // namespace gridreel::rebuild
