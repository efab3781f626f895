#include "anim/error.h"

namespace gridreel {
namespace {

std::string message(std::string_view what, std::string_view where, std::string_view remedy) {
    std::string text;
    if (!where.empty()) text.append(where).append(": ");
    text.append(what);
    if (!remedy.empty()) text.append("; ").append(remedy);
    return text;
}

}  // namespace

Error::Error(std::string_view what, std::string_view where, std::string_view remedy)
    : std::runtime_error(message(what, where, remedy)), where_(where), remedy_(remedy) {}

}  // namespace gridreel
