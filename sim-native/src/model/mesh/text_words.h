#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace natator {

/// The text of a file without its byte-order mark, a character a byte: of UTF-16 and UTF-32 what is no ASCII becomes
/// '?', which is enough for numbers and keywords. Other text is as it is in `bytes`; `room` holds what had to be made.
std::string_view plain_text(std::string_view bytes, std::string& room);

/// Small letters for ASCII's large ones.
std::string lower_case(std::string_view word);

/// Words of a text, line by line. A line ends with LF, CR or both, a comment begins with #.
class TextWords {
public:
    /// `continued`: whether a backslash at the end of a line joins it to the next, as in .obj.
    TextWords(std::string_view text, bool continued) : rest_(text), continued_(continued) {}

    /// Goes to the next line. False at the end.
    bool next_line();
    /// The next word of the line; empty at its end.
    std::string_view next();
    /// The next word of this line or a later one; empty at the end of the text.
    std::string_view next_of_text();
    /// What is left of the line, to be looked at or cut.
    std::string_view& rest_of_line() { return left_; }
    /// Of the line's first part, from 1.
    long number() const { return number_; }

    [[noreturn]] void refuse(const std::string& what) const;
    /// A coordinate in a word.
    double coordinate(std::string_view word) const;

private:
    std::string_view rest_, left_;
    std::string line_;
    bool continued_;
    long number_ = 0, lines_ = 0;
};

}  // namespace natator
