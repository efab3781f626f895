#pragma once
// What can be switched in packet traversal, to measure what each part of it is worth.

#include <optional>

namespace gridreel::traversal {

/// The switches of the paper's own measurements (Wald et al. 2006, sections 3.2 and 5). Answers never depend
/// on them.
struct PacketOptions {
    std::optional<int> side{};  ///< rays along the side of a square packet, 1 to 16; none: the fastest packet
    bool culling = true;        ///< of triangles against the packet's frustum and its blocks
    bool mailbox = true;        ///< a triangle that was met lately is not met again
    bool macrocells = false;    ///< skip slices whose cubes of cells are all empty
};

inline constexpr int widest_packet_side = 16;

}  // namespace gridreel::traversal
