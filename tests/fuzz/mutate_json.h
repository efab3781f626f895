#pragma once
// One random change to a JSON document, of the kind that a faulty exporter makes.

#include <nlohmann/json_fwd.hpp>

#include <random>

namespace gridreel::test {

/// Changes one to three values, chosen evenly among all of the document: a number for another one (a
/// neighbour, a limit, zero), a word for another of the document, a value for a copy of some other value;
/// or takes an item away, or lists one twice. The root stays an object.
void mutate_json(nlohmann::json& document, std::mt19937& random);

}  // namespace gridreel::test
