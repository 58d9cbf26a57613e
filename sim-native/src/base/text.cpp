#include "text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace natator {
namespace {

using nlohmann::json;

constexpr std::size_t max_shown = 60;
constexpr std::size_t max_quoted = 400;  // paths and names are worth more room than values

/// Whether a character beyond ASCII shows as itself: not those that have no form, turn the line's direction or end it,
/// nor the one that stands for bytes that were no text.
bool is_seen(unsigned code) {
    constexpr std::pair<unsigned, unsigned> unseen[] = {
        {0x80, 0x9f},     {0xad, 0xad},     {0x61c, 0x61c},   {0x115f, 0x1160},   {0x17b4, 0x17b5}, {0x180b, 0x180f},
        {0x200b, 0x200f}, {0x2028, 0x202e}, {0x2060, 0x206f}, {0x3164, 0x3164},   {0xd800, 0xf8ff}, {0xfe00, 0xfe0f},
        {0xfeff, 0xfeff}, {0xffa0, 0xffa0}, {0xfff0, 0xffff}, {0xe0000, 0x10ffff}};
    return std::none_of(std::begin(unseen), std::end(unseen),
                        [code](const auto& range) { return range.first <= code && code <= range.second; });
}

void append_utf8(std::string& text, unsigned code) {
    const auto byte = [&text](unsigned value) { text += static_cast<char>(value); };
    if (code < 0x800) {
        byte(0xc0 | code >> 6);
    } else {
        if (code < 0x10000) {
            byte(0xe0 | code >> 12);
        } else {
            byte(0xf0 | code >> 18);
            byte(0x80 | (code >> 12 & 0x3f));
        }
        byte(0x80 | (code >> 6 & 0x3f));
    }
    byte(0x80 | (code & 0x3f));
}

/// A JSON text in ASCII, with characters beyond it in place of the escapes of those that show as themselves.
std::string with_characters(const std::string& ascii) {
    std::string text;
    const auto unit = [&ascii](std::size_t i) {
        unsigned value = 0;
        if (i + 6 <= ascii.size() && ascii[i] == '\\' && ascii[i + 1] == 'u')
            std::from_chars(ascii.data() + i + 2, ascii.data() + i + 6, value, 16);
        return value;
    };
    for (std::size_t i = 0; i < ascii.size();) {
        unsigned code = unit(i);
        std::size_t length = 6;
        if (const unsigned low = unit(i + 6); code >= 0xd800 && code < 0xdc00 && low >= 0xdc00 && low < 0xe000) {
            code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
            length = 12;
        }
        if (code >= 0x80 && is_seen(code)) {
            append_utf8(text, code);
        } else {
            if (code == 0) length = ascii[i] == '\\' ? 2 : 1;
            text += ascii.substr(i, length);
        }
        i += length;
    }
    return text;
}

std::string on_one_line(const json& value, std::size_t max_length) {
    return shortened(with_characters(value.dump(-1, ' ', true, json::error_handler_t::replace)), max_length);
}

template <class Real>
std::string shortest_text(Real value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
    std::array<char, 512> text;
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000  // which lacks to_chars of floating-point numbers
    const auto reads_back = [&] { return static_cast<Real>(std::strtod(text.data(), nullptr)) == value; };
    int digits = 0;
    do std::snprintf(text.data(), text.size(), "%.*e", digits, static_cast<double>(value));
    while (!reads_back() && ++digits);
    const std::string scientific = text.data();
    const int exponent = std::atoi(scientific.c_str() + scientific.find('e') + 1);
    std::snprintf(text.data(), text.size(), "%.*f", std::max(0, digits - exponent), static_cast<double>(value));
    return std::string(text.data()).size() <= scientific.size() ? text.data() : scientific;
#else
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
#endif
}

}  // namespace

std::optional<double> decimal_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
#if defined(__cpp_lib_to_chars)
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc() && end == text.data() + text.size();
#else  // as in libc++ before 20; strtod takes more, such as 0x2 and spaces in front
    if (text.empty() || text.starts_with('+') || text.find_first_not_of("0123456789+-.eE") != text.npos)
        return std::nullopt;
    const std::string whole(text);
    char* end = nullptr;
    errno = 0;
    value = std::strtod(whole.c_str(), &end);
    const bool is_whole = (errno == 0 || value != 0) && end == whole.c_str() + whole.size();
#endif
    return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string shortened(std::string text, std::size_t max_length) {
    if (text.size() <= max_length) return text;
    const auto continues = [&text](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
    while (max_length > 0 && continues(max_length)) --max_length;
    return text.substr(0, max_length) + "...";
}

std::string number_text(double value) {
    return shortest_text(value);
}

std::string number_text(float value) {
    return shortest_text(value);
}

std::string computed_text(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.12g", value);
    return text.data();
}

std::string figure_text(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.3g", value);
    const double rounded = std::strtod(text.data(), nullptr);
    return number_text(rounded == 0 ? 0 : rounded);
}

std::string shown(const json& value) {
    if (value.is_number_float() && !std::isfinite(value.get<double>())) return number_text(value.get<double>());
    return on_one_line(value, max_shown);
}

std::string quoted(const std::string& text) {
    return on_one_line(text, max_quoted);
}

std::string as_one_line(const std::string& text) {
    const std::string escaped = with_characters(json(text).dump(-1, ' ', true, json::error_handler_t::replace));
    std::string line;
    for (std::size_t i = 1; i + 1 < escaped.size(); ++i) {
        if (escaped[i] != '\\') {
            line += escaped[i];
        } else if (const char next = escaped[++i]; next == '"' || next == '\\') {
            line += next;
        } else if (next == 'n' || next == 'r') {
            line += ' ';
        } else {
            line += {'\\', next};
        }
    }
    return line;
}

}  // namespace natator
