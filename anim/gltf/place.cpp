#include "anim/gltf/place.h"

#include "anim/error.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace gridreel::anim::gltf {

Place Place::step(const Json& json, std::string_view token) const {
    Place next(json, *file_);
    next.pointer_.reserve(pointer_.size() + 1 + token.size());
    next.pointer_ = pointer_;
    next.pointer_ += '/';
    for (const char c : token) {
        if (c == '~')
            next.pointer_ += "~0";
        else if (c == '/')
            next.pointer_ += "~1";
        else
            next.pointer_ += c;
    }
    return next;
}

std::optional<Place> Place::find(std::string_view name) const {
    const Json* const found = json_->find(name);
    if (!found) return {};
    return step(*found, name);
}

std::optional<Place> Place::find_extension(std::string_view name) const {
    const auto extensions = find("extensions");
    if (!extensions) return {};
    return extensions->find(name);
}

Place Place::at(std::string_view name) const {
    const Json* const found = json_->find(name);
    if (!found) refuse(fmt::format("the property \"{}\" is missing", name));
    return step(*found, name);
}

std::size_t Place::size() const {
    const auto* const array = std::get_if<Json::Array>(&json_->value);
    return array ? array->size() : 0;
}

std::size_t Place::count(std::string_view name) const {
    const auto found = find(name);
    return found ? found->size() : 0;
}

Place Place::operator[](std::size_t i) const {
    const auto& array = std::get<Json::Array>(json_->value);
    assert(i < array.size());
    return step(array[i], fmt::format_int(i).c_str());
}

bool Place::boolean() const {
    const auto* const value = std::get_if<bool>(&json_->value);
    if (!value) refuse("this must be true or false");
    return *value;
}

double Place::number() const {
    const auto* const value = std::get_if<double>(&json_->value);
    if (!value) refuse("this must be a number");
    return *value;
}

std::size_t Place::integer() const {
    const double value = number();
    if (std::trunc(value) != value || value < 0.0 || value > exact_integers)
        refuse(fmt::format("{} is not an integer between 0 and 2^53", value));
    return static_cast<std::size_t>(value);
}

const std::string& Place::text() const {
    const auto* const value = std::get_if<std::string>(&json_->value);
    if (!value) refuse("this must be a string");
    return *value;
}

bool Place::boolean_or(std::string_view name, bool otherwise) const {
    const auto property = find(name);
    return property ? property->boolean() : otherwise;
}

double Place::number_or(std::string_view name, double otherwise) const {
    const auto property = find(name);
    return property ? property->number() : otherwise;
}

std::size_t Place::integer_or(std::string_view name, std::size_t otherwise) const {
    const auto property = find(name);
    return property ? property->integer() : otherwise;
}

std::string Place::text_or(std::string_view name, std::string_view otherwise) const {
    const auto property = find(name);
    return property ? property->text() : std::string(otherwise);
}

std::optional<Index> Place::find_index(std::string_view name) const {
    const auto property = find(name);
    if (!property) return {};
    return property->index();
}

void Place::refuse(std::string_view what, std::string_view remedy) const {
    throw Error(what, pointer_.empty() ? *file_ : *file_ + ": " + pointer_, remedy);
}

}  // namespace gridreel::anim::gltf
