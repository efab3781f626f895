#include "tests/fuzz/mutate_json.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

namespace gridreel::test {
namespace {

using nlohmann::json;

/// Every value below `value`, and it; a stack of our own, since documents may be nested deeply.
std::vector<json*> all_values(json& root) {
    std::vector<json*> values{&root};
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i]->is_structured()) continue;
        for (json& item : *values[i]) values.push_back(&item);
    }
    return values;
}

template <class Items>
auto& any_of(Items& items, std::mt19937& random) {
    return items[random() % items.size()];
}

json other_number(const json& number, std::mt19937& random) {
    static const std::array<json, 16> limits{
        0, 1, -1, 2, 4, 5121, 5123, 5125, 5126, 255, 65535, 65536, 4294967295, 9007199254740992, 1e38, 1e-30};
    if (random() % 2 == 0) return any_of(limits, random);
    if (number.is_number_integer()) {
        static constexpr std::array<std::int64_t, 6> steps{-4, -1, 1, 2, 4, 64};
        // Limits of std::int64_t are no steps away from anything.
        const auto value = number.get<std::int64_t>();
        return std::abs(value) < (std::int64_t{1} << 53) ? json(value + any_of(steps, random)) : json(0);
    }
    return number.get<double>() * (random() % 2 == 0 ? -2.0 : 0.5);
}

/// One of them, copied; null for a large one, or documents would grow without end.
json copy_of_any(const std::vector<json*>& values, std::mt19937& random) {
    constexpr std::size_t longest = 2000;
    const json& value = *any_of(values, random);
    return value.dump().size() > longest ? json() : value;
}

void change_items(json& container, const std::vector<json*>& values, std::mt19937& random) {
    const auto way = random() % 4;
    if (container.is_array()) {
        const std::size_t place = container.empty() ? 0 : random() % container.size();
        if (way == 0 && !container.empty())
            container.erase(place);
        else if (way == 1 && !container.empty())
            container.push_back(json(container[place]));
        else
            container.push_back(copy_of_any(values, random));
        return;
    }
    if (container.empty()) return;
    auto place = container.begin();
    std::advance(place, random() % container.size());
    if (way == 0) {
        container.erase(place);
    } else if (way < 3) {
        place.value() = copy_of_any(values, random);
    } else if (!place.key().empty() && static_cast<unsigned char>(place.key().back()) < 0x80) {
        // The next attribute, target or extension of that kind: POSITION_1, TEXCOORD_1, ...
        std::string name = place.key();
        name.back() = static_cast<char>('0' + random() % 3);
        json copy = place.value();
        container[name] = std::move(copy);
    }
}

void mutate_once(json& root, std::mt19937& random) {
    const std::vector<json*> values = all_values(root);
    json& value = *any_of(values, random);
    if (value.is_structured()) return change_items(value, values, random);
    if (random() % 4 == 0) {
        value = copy_of_any(values, random);
    } else if (value.is_number()) {
        value = other_number(value, random);
    } else if (value.is_boolean()) {
        value = !value.get<bool>();
    } else if (value.is_string()) {
        std::vector<json*> words;
        for (json* const other : values)
            if (other->is_string()) words.push_back(other);
        value = copy_of_any(words, random);
    }
}

}  // namespace

void mutate_json(json& document, std::mt19937& random) {
    const auto changes = 1 + random() % 3;
    for (std::size_t i = 0; i < changes; ++i) mutate_once(document, random);
}

}  // namespace gridreel::test
