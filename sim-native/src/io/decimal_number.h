#pragma once

#include <optional>
#include <string_view>

namespace natator {

/// The number that a text is as a whole: finite, in decimal digits with or without an exponent; none if it is anything else, such
/// as 0x2, 1f, NaN, or a number with spaces.
std::optional<double> decimal_number(std::string_view text);

}  // namespace natator
