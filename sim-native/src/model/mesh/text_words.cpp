#include "text_words.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "natator/error.h"
#include "polygon_mesh.h"

namespace natator {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view space = " \t\v\f\x1a\0"sv;  // with what some systems fill a file's end with

/// How a text begins that has more than a byte for each character, and where in these the lowest one is.
struct WideText {
    std::string_view mark;
    std::size_t width, lowest;
};

constexpr WideText wide_texts[] = {
    {"\xff\xfe\0\0"sv, 4, 0}, {"\0\0\xfe\xff"sv, 4, 3}, {"\xff\xfe"sv, 2, 0}, {"\xfe\xff"sv, 2, 1}};

std::string narrowed(std::string_view bytes, std::size_t width, std::size_t lowest) {
    std::string text;
    text.reserve(bytes.size() / width);
    for (std::size_t at = 0; at + width <= bytes.size(); at += width) {
        const std::string_view one = bytes.substr(at, width);
        const auto others =
            static_cast<std::size_t>(std::count(one.begin(), one.end(), '\0')) + (one[lowest] == '\0' ? 0 : 1);
        text += others == width && static_cast<unsigned char>(one[lowest]) < 0x80 ? one[lowest] : '?';
    }
    return text;
}

}  // namespace

std::string_view plain_text(std::string_view bytes, std::string& room) {
    if (bytes.starts_with("\xef\xbb\xbf")) return bytes.substr(3);
    for (const auto& [mark, width, lowest] : wide_texts)
        if (bytes.starts_with(mark)) return room = narrowed(bytes.substr(mark.size()), width, lowest);
    if (bytes.size() < 4) return bytes;
    const std::string zeros{bytes[0] == 0 ? '0' : '1', bytes[1] == 0 ? '0' : '1', bytes[2] == 0 ? '0' : '1',
                            bytes[3] == 0 ? '0' : '1'};
    if (zeros == "1010") return room = narrowed(bytes, 2, 0);
    if (zeros == "0101") return room = narrowed(bytes, 2, 1);
    return bytes;
}

std::string lower_case(std::string_view word) {
    std::string lower(word);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

bool TextWords::next_line() {
    if (rest_.empty()) return false;
    line_.clear();
    number_ = lines_ + 1;
    for (bool more = true; more && !rest_.empty();) {
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        std::string_view part = rest_.substr(0, end);
        rest_.remove_prefix(end);
        rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : rest_.empty() ? 0 : 1);
        ++lines_;
        part = part.substr(0, part.find('#'));
        part = part.substr(0, part.find_last_not_of(space) + 1);
        more = continued_ && part.ends_with('\\');
        if (more) part.remove_suffix(1);
        line_ += part;
        if (more) line_ += ' ';
    }
    left_ = line_;
    return true;
}

std::string_view TextWords::next() {
    const std::size_t begin = left_.find_first_not_of(space);
    if (begin == std::string_view::npos) return left_ = {};
    const std::size_t end = std::min(left_.find_first_of(space, begin), left_.size());
    const std::string_view word = left_.substr(begin, end - begin);
    left_ = left_.substr(end);
    return word;
}

std::string_view TextWords::next_of_text() {
    std::string_view word = next();
    while (word.empty() && next_line()) word = next();
    return word;
}

void TextWords::refuse(const std::string& what) const {
    throw InputError("line " + std::to_string(number_) + ": " + what);
}

double TextWords::coordinate(std::string_view word) const {
    const std::optional<double> value = decimal_number(word);
    if (!value || std::abs(*value) > max_coordinate)
        refuse((word.empty() ? "a coordinate is missing" : quoted(std::string(word)) + " is no coordinate") +
               "; must be three numbers within 1e9");
    return *value + 0.0;  // -0 is 0
}

}  // namespace natator
