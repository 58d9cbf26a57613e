#include "natator/strict_json.h"

#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "natator/error.h"

namespace natator {
namespace {

using nlohmann::json;

constexpr int max_depth = 32;
constexpr std::streamsize max_bytes = 16 << 20;
constexpr std::size_t max_shown = 60;

/// Keys seen so far in each object that is open.
class OpenObjects {
public:
    explicit OpenObjects(const std::string& source) : source_(source) {}

    void see(int depth, json::parse_event_t event, const json& parsed) {
        switch (event) {
            case json::parse_event_t::object_start:
            case json::parse_event_t::array_start:
                if (depth >= max_depth) {
                    throw InputError(source_ + ": JSON nested deeper than " + std::to_string(max_depth) + " levels");
                }
                keys_.emplace_back();
                break;
            case json::parse_event_t::object_end:
            case json::parse_event_t::array_end:
                keys_.pop_back();
                break;
            case json::parse_event_t::key:
                if (!keys_.back().insert(parsed.get<std::string>()).second) {
                    throw InputError(source_ + ": key " + shown(parsed) + " is given twice; must be given once");
                }
                break;
            case json::parse_event_t::value:
                break;
        }
    }

private:
    std::string source_;
    std::vector<std::set<std::string>> keys_;
};

/// The library's message without its own name in front, on one line.
std::string plain_message(const json::exception& error) {
    std::string text = error.what();
    if (const auto end = text.find("] "); text.starts_with('[') && end != std::string::npos) text.erase(0, end + 2);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return text;
}

}  // namespace

json parse_json(const std::string& text, const std::string& source) {
    OpenObjects open(source);
    try {
        return json::parse(text, [&open](int depth, json::parse_event_t event, const json& parsed) {
            open.see(depth, event, parsed);
            return true;
        });
    } catch (const json::exception& error) {
        throw InputError(source + ": not valid JSON: " + plain_message(error));
    }
}

json read_json_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError("file " + quoted(path) + ": cannot be read");
    std::string text(static_cast<std::size_t>(max_bytes) + 1, '\0');
    file.read(text.data(), max_bytes + 1);
    if (file.bad()) throw InputError("file " + quoted(path) + ": cannot be read");
    if (file.gcount() > max_bytes) throw InputError("file " + quoted(path) + ": larger than 16 MiB");
    text.resize(static_cast<std::size_t>(file.gcount()));
    return parse_json(text, "file " + quoted(path));
}

std::string shown(const json& value) {
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > max_shown) text = text.substr(0, max_shown) + "...";
    return text;
}

std::string quoted(const std::string& text) {
    return shown(json(text));
}

}  // namespace natator
