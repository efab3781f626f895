#pragma once
// The switches of packet traversal, for `gridreel bench`: what each part of it is worth.

#include "traversal/packet_options.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gridreel::tools {

/// Options as written; empty where nothing is.
struct PaperText {
    std::vector<std::string> sides, culling, mailbox;
    std::string macrocells;
};

/// --packet --culling --mailbox --macrocells.
void add_paper_options(CLI::App& app, PaperText& text);

/// Packets with a label that tells them from the others: "packet=8,culling=off".
struct LabelledPackets {
    std::string label;  ///< names only what is varied; empty when nothing is
    traversal::PacketOptions options;
};

/// Every combination of what is written, the first option's values slowest.
/// @throws sequences::UsageError
[[nodiscard]] std::vector<LabelledPackets> read_packets(const PaperText& text);

/// The first of the options that is written: "--culling"; empty: none is.
[[nodiscard]] std::string first_written(const PaperText& text);

}  // namespace gridreel::tools
