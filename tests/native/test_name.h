#pragma once

#include <ostream>
#include <string>

namespace natator::test {

/// Writes text as (part of) the name of a parametrised test: the last 80 characters, only letters, digits, '.', '-',
/// '_'.
inline void print_name(const std::string& text, std::ostream* out) {
    for (const char c : text.substr(text.size() > 80 ? text.size() - 80 : 0)) {
        const bool plain = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
        *out << (plain || c == '.' || c == '-' ? c : '_');
    }
}

}  // namespace natator::test
