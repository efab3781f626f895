#include "anim/gltf/json.h"

#include "anim/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gridreel::anim::gltf {
namespace {

constexpr std::size_t max_depth = 128;

/// Builds our tree from the parser's events, so that depth is bounded while parsing.
class TreeBuilder final : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit TreeBuilder(std::string_view where) : where_(where) {}

    [[nodiscard]] Json take() { return std::move(root_); }

    bool null() override { return leaf({nullptr}); }
    bool boolean(bool value) override { return leaf({value}); }
    bool number_integer(std::int64_t value) override { return leaf({double(value)}); }
    bool number_unsigned(std::uint64_t value) override { return leaf({double(value)}); }
    bool number_float(double value, const std::string&) override { return leaf({value}); }
    bool string(std::string& value) override { return leaf({std::move(value)}); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open({Json::Object{}}); }
    bool start_array(std::size_t) override { return open({Json::Array{}}); }
    bool end_array() override { return close(); }

    bool key(std::string& name) override {
        name_ = std::move(name);
        return true;
    }

    bool end_object() override {
        std::vector<std::string_view> names;
        for (const auto& [name, value] : std::get<Json::Object>(open_.back()->value)) names.push_back(name);
        std::sort(names.begin(), names.end());
        if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
            throw Error(fmt::format("an object of the JSON has two properties named \"{}\"", *twice), where_,
                        "remove one of them or export the file again");
        return close();
    }

    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
        std::string_view text = error.what();
        if (const auto tag = text.find("] "); text.starts_with('[') && tag != text.npos)
            text.remove_prefix(tag + 2);
        throw Error(fmt::format("the JSON cannot be read ({})", text), where_,
                    "check that the file is complete, or export it again");
    }

private:
    Json* add(Json value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        if (auto* const array = std::get_if<Json::Array>(&open_.back()->value))
            return &array->emplace_back(std::move(value));
        auto& object = std::get<Json::Object>(open_.back()->value);
        return &object.emplace_back(std::move(name_), std::move(value)).second;
    }

    bool leaf(Json value) {
        add(std::move(value));
        return true;
    }

    // Only the innermost container grows, so the pointers to those around it stay valid.
    bool open(Json container) {
        if (open_.size() == max_depth)
            throw Error(fmt::format("the JSON is nested deeper than {} levels", max_depth), where_,
                        "export the file without deeply nested extras");
        open_.push_back(add(std::move(container)));
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    std::string_view where_;
    Json root_;
    std::vector<Json*> open_;
    std::string name_;
};

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump();
}

void append(std::string& out, const Json& json) {
    if (const auto* const truth = std::get_if<bool>(&json.value)) {
        out += *truth ? "true" : "false";
    } else if (const auto* const number = std::get_if<double>(&json.value)) {
        const bool integral = std::trunc(*number) == *number && std::abs(*number) <= exact_integers;
        out += integral ? fmt::format("{}", static_cast<std::int64_t>(*number)) : fmt::format("{}", *number);
    } else if (const auto* const text = std::get_if<std::string>(&json.value)) {
        out += quoted(*text);
    } else if (const auto* const array = std::get_if<Json::Array>(&json.value)) {
        out += '[';
        for (const Json& item : *array) {
            if (&item != array->data()) out += ',';
            append(out, item);
        }
        out += ']';
    } else if (const auto* const object = std::get_if<Json::Object>(&json.value)) {
        out += '{';
        for (const auto& property : *object) {
            if (&property != object->data()) out += ',';
            out += quoted(property.first) + ':';
            append(out, property.second);
        }
        out += '}';
    } else {
        out += "null";
    }
}

}  // namespace

const Json* Json::find(std::string_view name) const {
    const auto* const object = std::get_if<Object>(&value);
    if (!object) return nullptr;
    const auto found =
        std::find_if(object->begin(), object->end(), [&](const auto& entry) { return entry.first == name; });
    return found == object->end() ? nullptr : &found->second;
}

Json* Json::find(std::string_view name) {
    return const_cast<Json*>(std::as_const(*this).find(name));
}

Json parse_json(std::string_view text, std::string_view where) {
    TreeBuilder builder(where);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

std::string write_json(const Json& json) {
    std::string text;
    append(text, json);
    return text;
}

}  // namespace gridreel::anim::gltf
