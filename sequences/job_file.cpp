#include "sequences/job_file.h"

#include "anim/parse_number.h"
#include "sequences/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace gridreel::sequences {
namespace {

bool is_bare(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

/// A cursor over the text; knows its line for messages.
class Reader {
public:
    Reader(std::string_view text, std::string_view name) : rest_(text), name_(name) {}

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    [[nodiscard]] char peek() const { return rest_.empty() ? '\0' : rest_.front(); }
    [[nodiscard]] std::size_t line() const { return line_; }

    char next() {
        const char c = peek();
        if (!rest_.empty()) rest_.remove_prefix(1);
        if (c == '\n') ++line_;
        return c;
    }

    bool take(char wanted) {
        if (rest_.empty() || peek() != wanted) return false;
        next();
        return true;
    }

    void skip_blanks() {
        while (peek() == ' ' || peek() == '\t' || peek() == '\r') next();
    }

    /// Blanks, line ends and comments.
    void skip_lines() {
        while (true) {
            skip_blanks();
            if (peek() == '#') skip_comment();
            if (!take('\n')) return;
        }
    }

    /// Nothing but a comment may follow on this line.
    void end_line() {
        skip_blanks();
        if (peek() == '#') skip_comment();
        if (!at_end() && !take('\n')) fail(fmt::format("unexpected '{}'", peek()));
    }

    [[noreturn]] void fail(std::string_view what) const {
        throw UsageError(what, fmt::format("{}:{}", name_, line_),
                         "write sections [render] and lines key = value, strings in quotes");
    }

private:
    void skip_comment() {
        while (!at_end() && peek() != '\n') next();
    }

    std::string_view rest_;
    std::string_view name_;
    std::size_t line_ = 1;
};

std::string read_quoted(Reader& reader) {
    const char quote = reader.next();
    std::string text;
    while (true) {
        if (reader.at_end() || reader.peek() == '\n') reader.fail("the string is not closed");
        char c = reader.next();
        if (c == quote) return text;
        if (c == '\\' && quote == '"') {
            c = reader.next();
            if (c == 'n') {
                c = '\n';
            } else if (c == 't') {
                c = '\t';
            } else if (c != '"' && c != '\\') {
                reader.fail(fmt::format("the escape \\{} is not supported", c));
            }
        }
        text += c;
    }
}

std::string read_key(Reader& reader) {
    if (reader.peek() == '"' || reader.peek() == '\'') return read_quoted(reader);
    std::string key;
    while (is_bare(reader.peek())) key += reader.next();
    if (key.empty()) reader.fail("a key is missing");
    return key;
}

/// A string, a number or a boolean.
std::string read_scalar(Reader& reader) {
    if (reader.peek() == '"' || reader.peek() == '\'') return read_quoted(reader);
    std::string word;
    while (is_bare(reader.peek()) || reader.peek() == '+' || reader.peek() == '.') word += reader.next();
    if (word == "true" || word == "false") return word;

    // TOML allows 1_000.
    std::erase(word, '_');
    const std::string_view unsigned_word = std::string_view(word).substr(word.starts_with('+') ? 1 : 0);
    if (!parse_number<double>(unsigned_word)) {
        reader.fail(word.empty() ? fmt::format("a value cannot begin with '{}'", reader.peek())
                                 : fmt::format("'{}' is not a number; strings stand in quotes", word));
    }
    return word;
}

std::vector<std::string> read_value(Reader& reader) {
    if (!reader.take('[')) return {read_scalar(reader)};
    std::vector<std::string> values;
    while (true) {
        reader.skip_lines();
        if (reader.take(']')) return values;
        values.push_back(read_scalar(reader));
        reader.skip_lines();
        if (!reader.take(',') && reader.peek() != ']') reader.fail("the array is not closed");
    }
}

}  // namespace

std::vector<JobFileEntry> parse_job_file(std::string_view text, std::string_view name) {
    std::vector<JobFileEntry> entries;
    std::vector<std::string> sections;
    Reader reader(text, name);
    for (reader.skip_lines(); !reader.at_end(); reader.skip_lines()) {
        if (reader.take('[')) {
            reader.skip_blanks();
            const std::string section = read_key(reader);
            reader.skip_blanks();
            if (!reader.take(']')) reader.fail("the section's name is not closed");
            if (std::find(sections.begin(), sections.end(), section) != sections.end()) {
                reader.fail(fmt::format("section [{}] stands here a second time", section));
            }
            sections.push_back(section);
            reader.end_line();
            continue;
        }

        JobFileEntry entry;
        entry.section = sections.empty() ? "" : sections.back();
        entry.line = reader.line();
        entry.key = read_key(reader);
        reader.skip_blanks();
        if (!reader.take('=')) reader.fail(fmt::format("'=' is missing after '{}'", entry.key));
        reader.skip_blanks();
        entry.values = read_value(reader);
        const bool repeated = std::any_of(entries.begin(), entries.end(), [&](const JobFileEntry& other) {
            return other.section == entry.section && other.key == entry.key;
        });
        if (repeated) reader.fail(fmt::format("'{}' is given a second time", entry.key));
        reader.end_line();
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::vector<JobFileEntry> read_job_file(const std::filesystem::path& file) {
    std::error_code error;
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file, error)) {
        throw UsageError("the job file cannot be read", file.string(), "check the path given to --config");
    }
    return parse_job_file(std::string(std::istreambuf_iterator<char>(stream), {}), file.string());
}

}  // namespace gridreel::sequences
