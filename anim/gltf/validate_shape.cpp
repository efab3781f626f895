#include "anim/gltf/schema.h"
#include "anim/gltf/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gridreel::anim::gltf {
namespace {

bool is_object(const Place& place) {
    return std::holds_alternative<Json::Object>(place.json().value);
}
bool is_array(const Place& place) {
    return std::holds_alternative<Json::Array>(place.json().value);
}

/// Items of the array an index points into.
std::size_t count_indexed(const Place& root, std::string_view array) {
    const Json* owner = &root.json();
    const std::string_view extension = array == "lights"     ? "KHR_lights_punctual"
                                       : array == "variants" ? "KHR_materials_variants"
                                                             : "";
    if (!extension.empty()) {
        owner = owner->find("extensions");
        if (owner) owner = owner->find(extension);
    }
    const Json* const found = owner ? owner->find(array) : nullptr;
    const auto* const items = found ? std::get_if<Json::Array>(&found->value) : nullptr;
    return items ? items->size() : 0;
}

void check_index(const Place& place, std::string_view array, const Place& root) {
    const std::size_t count = count_indexed(root, array), i = place.integer();
    if (i >= count)
        place.refuse(fmt::format("index {} is out of range: the file has {} {}", i, count, array));
}

void check_number(const Place& place, const Property& rule) {
    const double value = place.number();
    const bool too_low = rule.above_least ? value <= rule.least : value < rule.least;
    if (too_low || value > rule.most) {
        place.refuse(fmt::format("{} is out of range: \"{}\" must be {} {:.9g} and at most {:.9g}", value,
                                 rule.name, rule.above_least ? "above" : "at least", rule.least, rule.most));
    }
}

void check_integer(const Place& place, const Property& rule) {
    const std::size_t value = place.integer();
    const auto matches = [&](int code) { return static_cast<std::size_t>(code) == value; };
    if (!rule.codes.empty() && std::none_of(rule.codes.begin(), rule.codes.end(), matches)) {
        place.refuse(fmt::format("{} is not a \"{}\" of glTF, which has {}", value, rule.name,
                                 fmt::join(rule.codes, ", ")));
    }
    check_number(place, rule);
}

void check_text(const Place& place, const Property& rule) {
    const std::string& word = place.text();
    if (!rule.words.empty() && std::find(rule.words.begin(), rule.words.end(), word) == rule.words.end()) {
        place.refuse(fmt::format("\"{}\" is not a \"{}\" of glTF, which has {}", word, rule.name,
                                 fmt::join(rule.words, ", ")));
    }
}

/// Its properties. They are looked up one after another, and nothing has a tenth as many.
const Json::Object& entries_of(const Place& object) {
    constexpr std::size_t most_entries = 1024;
    const auto& entries = std::get<Json::Object>(object.json().value);
    if (entries.size() > most_entries)
        object.refuse(fmt::format("this has {} entries; at most {} are read", entries.size(), most_entries));
    return entries;
}

void check_index_map(const Place& place, const Property& rule, const Place& root) {
    if (!is_object(place)) place.refuse("this must be an object");
    for (const auto& [name, value] : entries_of(place)) check_index(place.at(name), rule.into, root);
}

void check_object(const Place& place, const Shape& shape, const Place& root);

void check_value(const Place& place, const Property& rule, const Place& root) {
    switch (rule.kind) {
        case Kind::boolean:
            static_cast<void>(place.boolean());
            break;
        case Kind::number:
            check_number(place, rule);
            break;
        case Kind::integer:
            check_integer(place, rule);
            break;
        case Kind::text:
            check_text(place, rule);
            break;
        case Kind::index:
            check_index(place, rule.into, root);
            break;
        case Kind::index_map:
            check_index_map(place, rule, root);
            break;
        case Kind::object:
            check_object(place, *rule.shape, root);
            break;
    }
}

void check_property(const Place& place, const Property& rule, const Place& root) {
    if (!rule.list) return check_value(place, rule, root);

    if (!is_array(place)) place.refuse("this must be an array");
    const std::size_t count = place.size();
    if (count < rule.length.least || count > rule.length.most) {
        const auto& [least, most] = rule.length;
        const auto bound = least == most   ? fmt::format("exactly {}", least)
                           : count < least ? fmt::format("at least {}", least)
                                           : fmt::format("at most {}", most);
        place.refuse(fmt::format("\"{}\" has {} items; it must have {}", rule.name, count, bound));
    }
    for (std::size_t i = 0; i < count; ++i) check_value(place[i], rule, root);
}

void check_object(const Place& place, const Shape& shape, const Place& root) {
    if (!is_object(place)) place.refuse("this must be an object");
    static_cast<void>(entries_of(place));
    if (const auto name = place.find("name")) static_cast<void>(name->text());
    for (const Property& rule : shape.properties) {
        if (const auto property = place.find(rule.name))
            check_property(*property, rule, root);
        else if (rule.required)
            place.refuse(fmt::format("the property \"{}\" is missing", rule.name));
    }
}

}  // namespace

void validate_shape(const Place& root) {
    check_object(root, root_shape(), root);
}

}  // namespace gridreel::anim::gltf
