#include "strict_json.h"

#include <array>
#include <cerrno>
#include <memory>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "natator/error.h"
#include "natator/limits.h"
#include "text.h"

namespace natator {
namespace {

using nlohmann::json;

constexpr int max_depth = 32;
constexpr std::size_t max_message = 300;  // of the library, which quotes what it read last, however long

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

/// The library's message without its own name in front, on one line, not too long.
std::string plain_message(const json::exception& error) {
    std::string text = error.what();
    if (const auto end = text.find("] "); text.starts_with('[') && end != std::string::npos) text.erase(0, end + 2);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return shortened(std::move(text), max_message);
}

}  // namespace

std::string read_all(std::FILE* file, const std::string& source) {
    std::string text;
    std::array<char, 65536> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) {
        text.append(buffer.data(), count);
        if (text.size() > limits::document_bytes) throw InputError(source + ": larger than 16 MiB");
    }
    if (std::ferror(file) != 0)
        throw InputError(source + ": cannot be read: " + std::generic_category().message(errno));
    return text;
}

json parse_json(const std::string& text, const std::string& source) {
    OpenObjects open(source);
    try {
        json value = json::parse(text, [&open](int depth, json::parse_event_t event, const json& parsed) {
            open.see(depth, event, parsed);
            return true;
        });
        if (const auto zero = text.find('\0'); zero != std::string::npos)  // which the library takes for the end
            throw InputError(source + ": not valid JSON: byte " + std::to_string(zero + 1) + " is 0; must be text");
        return value;
    } catch (const json::exception& error) {
        throw InputError(source + ": not valid JSON: " + plain_message(error));
    }
}

json read_json_file(const std::string& path) {
    const std::string source = "file " + quoted(path);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw InputError(source + ": cannot be read: " + std::generic_category().message(errno));
    return parse_json(read_all(file.get(), source), source);
}

}  // namespace natator
