#pragma once
// A value of the file together with the JSON pointer that leads to it.

#include "anim/gltf/json.h"
#include "anim/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gridreel::anim::gltf {

/// A cursor into the file's JSON that knows its way back: every complaint names the file and the pointer
/// (RFC 6901). Reads refuse values of the wrong type. Refers to the JSON and to the file's name.
class Place {
public:
    Place(const Json& root, const std::string& file) : json_(&root), file_(&file) {}

    [[nodiscard]] const Json& json() const { return *json_; }
    [[nodiscard]] const std::string& pointer() const { return pointer_; }

    /// The property of that name, if there is one.
    [[nodiscard]] std::optional<Place> find(std::string_view name) const;
    /// The property of that name, which must be there.
    [[nodiscard]] Place at(std::string_view name) const;
    /// The extension of that name, if this object carries it.
    [[nodiscard]] std::optional<Place> find_extension(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const { return json_->find(name) != nullptr; }

    /// Items of an array; 0 for anything else.
    [[nodiscard]] std::size_t size() const;
    /// Items of the array of that name; 0 when it is absent.
    [[nodiscard]] std::size_t count(std::string_view name) const;
    /// Item `i` of an array, i < size().
    [[nodiscard]] Place operator[](std::size_t i) const;
    /// Item `i` of the array named `name`, which must be there and long enough.
    [[nodiscard]] Place at(std::string_view name, std::size_t i) const { return at(name)[i]; }

    [[nodiscard]] bool boolean() const;
    [[nodiscard]] double number() const;
    [[nodiscard]] std::size_t integer() const;  ///< 0 … 2^53
    [[nodiscard]] const std::string& text() const;
    [[nodiscard]] Index index() const { return static_cast<Index>(integer()); }

    /// The property's value, or the default when it is absent.
    [[nodiscard]] bool boolean_or(std::string_view name, bool otherwise) const;
    [[nodiscard]] double number_or(std::string_view name, double otherwise) const;
    [[nodiscard]] std::size_t integer_or(std::string_view name, std::size_t otherwise) const;
    [[nodiscard]] std::string text_or(std::string_view name, std::string_view otherwise) const;
    [[nodiscard]] std::optional<Index> find_index(std::string_view name) const;

    /// @throws Error here
    [[noreturn]] void refuse(std::string_view what, std::string_view remedy = "export the file again") const;

private:
    [[nodiscard]] Place step(const Json& json, std::string_view token) const;

    const Json* json_;
    const std::string* file_;
    std::string pointer_;
};

}  // namespace gridreel::anim::gltf
